//! What can be wrong with a question to the free-rotation laboratory.

use std::error::Error;
use std::fmt;

/// Why a free rotation could not be set up or followed: the message gives the value, the limit and the remedy.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeTopError {
    kind: FreeTopErrorKind,
    message: String,
}

/// The kinds of [`FreeTopError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FreeTopErrorKind {
    /// Moments that no body has.
    Moments,
    /// A spin that is not finite, names an unknown plane or has the wrong number of components.
    Spin,
    /// A time step, duration, range or resolution out of bounds.
    Span,
    /// The name of no method.
    Method,
    /// The motion has no closed form here, or a spin is no rotation in principal planes.
    NoClosedForm,
    /// An implicit step has no solution within reach.
    NoConvergence,
}

impl FreeTopError {
    pub(crate) fn new(kind: FreeTopErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
    }

    /// The kind, for programs.
    #[must_use]
    pub fn kind(&self) -> FreeTopErrorKind {
        self.kind
    }
}

/// A number in a message: whole numbers without a point, very large and very small ones with an exponent.
pub(crate) fn shown(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// As [`shown`], with six significant digits at most.
pub(crate) fn rounded(value: f64) -> String {
    // Digits written and read again are the nearest number that needs no more of them.
    format!("{value:.5e}").parse().map_or_else(|_| shown(value), shown)
}

impl fmt::Display for FreeTopError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for FreeTopError {}

/// The result of asking the free-rotation laboratory.
pub type Result<T> = std::result::Result<T, FreeTopError>;

#[cfg(test)]
mod tests {
    use super::{rounded, shown};

    #[test]
    fn numbers_are_as_short_as_they_can_be() {
        assert_eq!([4.0, -0.25, 1e300, 1e-320].map(shown), ["4", "-0.25", "1e300", "1e-320"]);
        assert_eq!(
            [1.2000000000000002, 2.0 / 3.0, 123456789.0, f64::NAN].map(rounded),
            ["1.2", "0.666667", "123457000", "NaN"]
        );
    }
}

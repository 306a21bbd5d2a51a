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
    /// Error control does not reach its tolerance.
    Tolerance,
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
    let nearest = format!("{value:.5e}").parse().unwrap_or(value);
    if (1e-4..1e7).contains(&nearest.abs()) || nearest == 0.0 { shown(nearest) } else { format!("{nearest:e}") }
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
        let values = [1.200_000_000_000_000_2, 2.0 / 3.0, 0.0, 123_456_789.0, -1.5e-9, f64::NAN];
        assert_eq!(values.map(rounded), ["1.2", "0.666667", "0", "1.23457e8", "-1.5e-9", "NaN"]);
    }
}

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

impl fmt::Display for FreeTopError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for FreeTopError {}

/// The result of asking the free-rotation laboratory.
pub type Result<T> = std::result::Result<T, FreeTopError>;

//! What can be wrong with a shape.

use std::error::Error;
use std::fmt;

/// The result of making or reading a shape.
pub type Result<T> = std::result::Result<T, GeometryError>;

/// Why a shape could not be made: the message gives the value, the limit and the remedy.
#[derive(Clone, Debug, PartialEq)]
pub struct GeometryError {
    kind: GeometryErrorKind,
    message: String,
}

/// The kinds of [`GeometryError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GeometryErrorKind {
    /// A length, radius or offset is not finite, or not positive where it must be.
    BadNumber,
    /// The points do not span the space: the body would have no volume.
    Flat,
    /// Too few or too many points, parts or factors.
    BadCount,
    /// A name that stands for no shape.
    UnknownName,
    /// The shape cannot do this: a half-space has no mass, for example.
    Unsupported,
    /// A file or mesh breaks its own rules: open, wrong indices, truncated.
    BadMesh,
}

impl GeometryError {
    /// An error of the given kind.
    #[must_use]
    pub fn new(kind: GeometryErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
    }

    /// The kind, for programs.
    #[must_use]
    pub fn kind(&self) -> GeometryErrorKind {
        self.kind
    }
}

impl fmt::Display for GeometryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for GeometryError {}

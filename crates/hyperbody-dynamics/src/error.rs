//! What can be wrong with a call on a world.

use std::error::Error;
use std::fmt;

use hyperbody_geometry::GeometryError;

/// Why a call was refused: the message gives the value, the limit and the remedy. Nothing was changed.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldError {
    kind: WorldErrorKind,
    message: String,
}

/// The kinds of [`WorldError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WorldErrorKind {
    /// A number is not finite, or outside its range.
    BadNumber,
    /// The handle is of a body or joint that no longer exists.
    StaleHandle,
    /// The shape cannot be used this way: a dynamic half-space, for example.
    BadShape,
    /// The call does not fit this kind of body or joint.
    NotAllowed,
    /// No more room: 2³² − 1 bodies, joints or colliders, or the memory that a past may take.
    Full,
    /// The past does not hold that moment, or no longer.
    NotHeld,
}

impl WorldError {
    pub(crate) fn new(kind: WorldErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
    }

    pub(crate) fn bad_number(message: impl Into<String>) -> Self {
        Self::new(WorldErrorKind::BadNumber, message)
    }

    /// The kind, for programs.
    #[must_use]
    pub fn kind(&self) -> WorldErrorKind {
        self.kind
    }
}

impl fmt::Display for WorldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for WorldError {}

impl From<GeometryError> for WorldError {
    fn from(error: GeometryError) -> Self {
        Self::new(WorldErrorKind::BadShape, error.to_string())
    }
}

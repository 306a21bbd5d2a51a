//! What can be wrong with a recording.

use std::error::Error;
use std::fmt;
use std::io;

use crate::error::SceneError;

/// Why a recording could not be written or read. The message is one line that says where, what, and what would be right.
#[derive(Debug)]
pub struct RecordingError {
    kind: RecordingErrorKind,
    message: String,
}

/// The kinds of [`RecordingError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RecordingErrorKind {
    /// The file cannot be read or written.
    Io,
    /// The file is something else.
    Foreign,
    /// Another version of the format.
    Version,
    /// The file ends too early.
    CutOff,
    /// A checksum or a count does not fit.
    Damaged,
    /// The scene cannot be recorded or built, or a frame does not fit it.
    Content,
}

impl RecordingError {
    pub(super) fn new(kind: RecordingErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
    }

    pub(super) fn damaged(offset: u64, what: impl fmt::Display) -> Self {
        Self::new(
            RecordingErrorKind::Damaged,
            format!("the recording is damaged at byte {offset}: {what}; copy it again, or record it again"),
        )
    }

    pub(super) fn cut_off(offset: u64, what: impl fmt::Display) -> Self {
        Self::new(
            RecordingErrorKind::CutOff,
            format!("the recording is cut off at byte {offset}: {what}; copy it again, or record it again"),
        )
    }

    pub(super) fn content(message: impl Into<String>) -> Self {
        Self::new(RecordingErrorKind::Content, message)
    }

    /// The kind, for programs.
    #[must_use]
    pub fn kind(&self) -> RecordingErrorKind {
        self.kind
    }
}

impl fmt::Display for RecordingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for RecordingError {}

impl From<io::Error> for RecordingError {
    fn from(error: io::Error) -> Self {
        Self::new(RecordingErrorKind::Io, error.to_string())
    }
}

impl From<SceneError> for RecordingError {
    fn from(error: SceneError) -> Self {
        Self::content(error.to_string())
    }
}

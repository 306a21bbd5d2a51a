//! What can be wrong with a scene.

use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};

/// Why a scene could not be read or built. The message is one line that says where, what, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    kind: ErrorKind,
    file: Option<PathBuf>,
    place: String,
    message: String,
}

/// The kinds of [`SceneError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A file is missing, unreadable or too large.
    File,
    /// The text is not JSON; the place is a line and column.
    Syntax,
    /// A key is unknown, missing or of the wrong type.
    Structure,
    /// A value is outside its range, a list has the wrong length, or a name stands for nothing.
    Value,
    /// A shape cannot be made: flat, empty, or of an unknown name.
    Shape,
    /// The scene names something that this version cannot do.
    Unsupported,
}

impl SceneError {
    pub(crate) fn new(kind: ErrorKind, place: impl Into<String>, message: impl Into<String>) -> Self {
        Self { kind, file: None, place: place.into(), message: message.into() }
    }

    pub(crate) fn structure(place: impl Into<String>, message: impl Into<String>) -> Self {
        Self::new(ErrorKind::Structure, place, message)
    }

    pub(crate) fn value(place: impl Into<String>, message: impl Into<String>) -> Self {
        Self::new(ErrorKind::Value, place, message)
    }

    /// The error with the file in which it lies.
    #[must_use]
    pub(crate) fn in_file(mut self, file: Option<&Path>) -> Self {
        if self.file.is_none() {
            self.file = file.map(Path::to_path_buf);
        }
        self
    }

    /// The error of a file as a whole.
    #[must_use]
    pub(crate) fn without_place(mut self) -> Self {
        self.place.clear();
        self
    }

    /// The error with more said at its end, if its message begins so and does not say that already.
    #[must_use]
    pub(crate) fn explained(mut self, beginning: &str, more: &str) -> Self {
        if self.message.starts_with(beginning) && !self.message.contains(" inside this ") {
            self.message.push_str(more);
        }
        self
    }

    /// The kind, for programs.
    #[must_use]
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The file in which the error lies, if the scene came from one.
    #[must_use]
    pub fn file(&self) -> Option<&Path> {
        self.file.as_deref()
    }

    /// Where in the file: a path such as `bodies[3].shape.box.half_extents`, or a line and column where the text is not
    /// JSON. Empty where the file as a whole is meant.
    #[must_use]
    pub fn place(&self) -> &str {
        &self.place
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}: ", file.display())?;
        }
        if !self.place.is_empty() {
            write!(f, "{}: ", self.place)?;
        }
        f.write_str(&self.message)
    }
}

impl Error for SceneError {}

/// Likeness (Jaro and Winkler, from 0 to 1) from which a name may have been meant: "blal" for "ball" has 0.93, "nonsense"
/// for "density" 0.53.
const LIKE: f64 = 0.7;

/// The known name that is most like `name`.
#[must_use]
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    most_like(name, known).map(|(_, candidate)| candidate)
}

/// The known name that a person who typed `name` most likely meant, or `None` where nothing is like it: a wrong hint is
/// worse than none.
#[must_use]
pub fn meant<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    most_like(name, known).filter(|(likeness, _)| *likeness >= LIKE).map(|(_, candidate)| candidate)
}

fn most_like<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<(f64, &'a str)> {
    let lower = name.to_lowercase();
    let mut best: Option<(f64, &str)> = None;
    for candidate in known {
        let likeness = strsim::jaro_winkler(&lower, &candidate.to_lowercase());
        if best.is_none_or(|(highest, _)| likeness > highest) {
            best = Some((likeness, candidate));
        }
    }
    best
}

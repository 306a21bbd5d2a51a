//! Files that commands write: checked before the work, written aside and renamed after it.

use std::fs;
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// A file that can be written, as far as can be told beforehand.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    path: PathBuf,
    extension: String,
}

impl Target {
    /// A target for one of the given kinds of files.
    ///
    /// # Errors
    /// If the name ends otherwise, is a folder, or lies in a folder that is not there or takes no files.
    pub(crate) fn new(option: &str, path: &Path, extensions: &[&str]) -> Result<Self, Failure> {
        let refuse = |what: String| Err(Failure::Input(format!("{option}: {}: {what}", path.display())));
        let extension =
            path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default();
        if !extensions.contains(&extension.as_str()) {
            let wanted: Vec<String> = extensions.iter().map(|extension| format!(".{extension}")).collect();
            return refuse(format!("the name has to end in {}", wanted.join(" or ")));
        }
        if path.is_dir() {
            return refuse("is a folder; name a file".to_owned());
        }
        let folder = folder_of(path);
        if !folder.is_dir() {
            return refuse(format!("there is no folder {}; make it first", folder.display()));
        }
        let target = Self { path: path.to_path_buf(), extension };
        // Whether the folder takes files is seen by trying, before the work and not after it.
        match fs::write(target.aside(), []).and_then(|()| fs::remove_file(target.aside())) {
            Ok(()) => Ok(target),
            Err(error) => refuse(format!("cannot be written: {error}")),
        }
    }

    /// Where the file is written before it gets its name.
    fn aside(&self) -> PathBuf {
        let name = self.path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        folder_of(&self.path).join(format!(".{name}.{}.part", std::process::id()))
    }

    /// What the name ends in, in lower case and without the dot.
    pub(crate) fn extension(&self) -> &str {
        &self.extension
    }

    /// Writes the file aside and renames it, so that a reader never sees half of it, and a failure leaves the old one.
    pub(crate) fn write(&self, content: &[u8]) -> Result<(), Failure> {
        let aside = self.aside();
        fs::write(&aside, content).and_then(|()| fs::rename(&aside, &self.path)).map_err(|error| {
            // The error of the write is the one to report.
            let _ = fs::remove_file(&aside);
            Failure::Work(format!("{}: cannot be written: {error}", self.path.display()))
        })
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

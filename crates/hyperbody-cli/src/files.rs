//! Files that commands write: checked before the work, written aside and renamed after it, and removed if the program is told
//! to stop before.

use std::collections::BTreeSet;
use std::fmt::Display;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::failure::Failure;
use crate::stop;

/// Files in the making.
static DRAFTS: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Most bytes that a file in the making takes from its name: file systems end names at 255.
const MOST_NAME_BYTES: usize = 200;

fn drafts() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    DRAFTS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all files in the making. No file gets its name as long as what is given back lives.
pub(crate) fn remove_drafts() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    let drafts = drafts();
    for draft in drafts.iter() {
        // The program ends; there is nobody left to tell.
        let _ = fs::remove_file(draft);
    }
    drafts
}

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
        let extension = extension_of(path);
        let is_bare = |name: String| extensions.iter().any(|extension| name == format!(".{extension}"));
        if path.file_name().is_some_and(|name| is_bare(name.to_string_lossy().to_lowercase())) {
            return refuse("has no name before its ending; call it something".to_owned());
        }
        if !extensions.contains(&extension.as_str()) {
            let wanted: Vec<String> = extensions.iter().map(|extension| format!(".{extension}")).collect();
            return refuse(format!("the name has to end in {}", wanted.join(" or ")));
        }
        Self::anywhere(option, path)
    }

    /// A target with any ending.
    ///
    /// # Errors
    /// If the name is a folder, or lies in a folder that is not there or takes no files.
    pub(crate) fn anywhere(option: &str, path: &Path) -> Result<Self, Failure> {
        let refuse = |what: String| Err(Failure::Input(format!("{option}: {}: {what}", path.display())));
        let extension = extension_of(path);
        if path.is_dir() {
            return refuse("is a folder; name a file".to_owned());
        }
        let folder = folder_of(path);
        if !folder.is_dir() {
            return refuse(format!("there is no folder {}; make it first", folder.display()));
        }
        // A name that is too long would be refused after the work, when the file gets it.
        if let Err(error) = fs::symlink_metadata(path)
            && error.kind() != io::ErrorKind::NotFound
        {
            return refuse(format!("cannot be written: {error}"));
        }
        let target = Self { path: path.to_path_buf(), extension };
        if target.is_special() {
            return Ok(target);
        }
        // Whether the folder takes files is seen by trying, before the work and not after it.
        target.begin();
        let tried = fs::write(target.aside(), []);
        target.discard();
        match tried {
            Ok(()) => Ok(target),
            Err(error) => refuse(format!("cannot be written: {error}")),
        }
    }

    /// Refuses to write over what is read: the input, and after it the files that it names.
    ///
    /// # Errors
    /// If one of them is the target.
    pub(crate) fn refuse_inputs(&self, option: &str, inputs: &[PathBuf]) -> Result<(), Failure> {
        let whole = |path: &Path| path.canonicalize().ok();
        let place = whole(&self.path);
        match inputs.iter().position(|input| input.is_file() && whole(input) == place) {
            None => Ok(()),
            Some(number) => {
                let what = if number == 0 { "is the input itself" } else { "is a file that the input names" };
                let message = format!("{what}, which would be lost; name another file");
                Err(Failure::Input(format!("{option}: {}: {message}", self.path.display())))
            }
        }
    }

    /// Where the file is written before it gets its name; of a long name the beginning, so that there is room for the rest.
    fn aside(&self) -> PathBuf {
        let name = self.path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let ends = name.char_indices().map(|(start, letter)| start + letter.len_utf8());
        let kept = &name[..ends.take_while(|&end| end <= MOST_NAME_BYTES).last().unwrap_or(0)];
        // A table and a picture of one run may be called alike.
        let name = if kept.len() < name.len() { format!("{kept}….{}", self.extension) } else { name };
        folder_of(&self.path).join(format!(".{name}.{}.part", std::process::id()))
    }

    /// What the name ends in, in lower case and without the dot.
    pub(crate) fn extension(&self) -> &str {
        &self.extension
    }

    /// Writes the file at once.
    pub(crate) fn write(&self, content: &[u8]) -> Result<(), Failure> {
        let mut aside = self.open()?;
        aside.write_all(content).map_err(|error| self.unwritable(&error))?;
        aside.finish()
    }

    /// Opens the file for writing piece by piece.
    pub(crate) fn open(&self) -> Result<Aside<'_>, Failure> {
        let path = self.draft();
        self.begin();
        let file = if self.is_special() { File::options().write(true).open(&path) } else { File::create(&path) };
        let file = file.map_err(|error| self.unwritable(&error))?;
        Ok(Aside { target: self, writer: BufWriter::new(file), finished: false })
    }

    /// Has what is written aside removed if the program is told to stop; [`Target::publish`] or [`Target::discard`] ends that.
    pub(crate) fn begin(&self) {
        if !self.is_special() {
            stop::listen();
            drafts().insert(self.aside());
        }
    }

    /// Gives what another program wrote aside its name, once it is on the disk.
    pub(crate) fn publish_foreign(&self, program: &str) -> Result<(), Failure> {
        if self.is_special() {
            return Ok(());
        }
        let file = File::options().write(true).open(self.aside());
        let written = file.and_then(|file| file.sync_all().and_then(|()| file.metadata()));
        let nothing = format!("{program} says that it is done, and has written nothing");
        let why = match written {
            Ok(metadata) if metadata.len() > 0 => return self.publish(),
            Ok(_) => nothing,
            Err(error) if error.kind() == io::ErrorKind::NotFound => nothing,
            Err(error) => format!("{program}: {error}"),
        };
        self.discard();
        Err(self.unwritable(&why))
    }

    /// Where a program that writes the file itself has to write it, after [`Target::begin`].
    pub(crate) fn draft(&self) -> PathBuf {
        if self.is_special() { self.path.clone() } else { self.aside() }
    }

    /// Gives what was written aside its name.
    pub(crate) fn publish(&self) -> Result<(), Failure> {
        if self.is_special() {
            return Ok(());
        }
        let renamed = {
            let mut drafts = drafts();
            drafts.remove(&self.aside());
            fs::rename(self.aside(), &self.path)
        };
        renamed.map_err(|error| {
            self.discard();
            self.unwritable(&error)
        })
    }

    /// Removes what was written aside.
    pub(crate) fn discard(&self) {
        if !self.is_special() {
            drafts().remove(&self.aside());
            // There is an error to report already, or nothing was written.
            let _ = fs::remove_file(self.aside());
        }
    }

    /// What is said where writing fails.
    pub(crate) fn unwritable(&self, error: &dyn Display) -> Failure {
        Failure::Input(format!("{}: cannot be written: {error}", self.path.display()))
    }

    /// The name that the file gets.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The name, for messages.
    pub(crate) fn display(&self) -> impl Display {
        self.path.display()
    }

    /// Devices and pipes are written to; a file in their place would not be what was meant.
    fn is_special(&self) -> bool {
        fs::metadata(&self.path).is_ok_and(|metadata| !metadata.is_file())
    }
}

/// A file in the making. It is written aside and gets its name when it is finished, so that a reader never sees half of it, and
/// a failure leaves the old one.
pub(crate) struct Aside<'a> {
    target: &'a Target,
    writer: BufWriter<File>,
    finished: bool,
}

impl Aside<'_> {
    /// Gives the file its name.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        self.writer.flush().map_err(|error| self.target.unwritable(&error))?;
        if !self.target.is_special() {
            // Some file systems tell of a full disk only now.
            self.writer.get_ref().sync_all().map_err(|error| self.target.unwritable(&error))?;
        }
        self.finished = true;
        self.target.publish()
    }
}

impl Write for Aside<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl Drop for Aside<'_> {
    fn drop(&mut self) {
        if !self.finished {
            self.target.discard();
        }
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn extension_of(path: &Path) -> String {
    path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default()
}

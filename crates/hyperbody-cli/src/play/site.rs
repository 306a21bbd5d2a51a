//! The files of the page: those in the program, or those of a folder.

use std::collections::BTreeMap;
use std::fs;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use flate2::read::GzDecoder;

use crate::failure::Failure;

/// A file in the program.
pub(super) struct File {
    name: &'static str,
    /// With gzip.
    compressed: bool,
    bytes: &'static [u8],
}

include!(concat!(env!("OUT_DIR"), "/site.rs"));

/// Where the page comes from.
#[derive(Clone, Debug)]
pub(crate) struct Site {
    /// `None`: the program.
    folder: Option<PathBuf>,
    /// Short addresses and where they lead.
    ways: BTreeMap<String, String>,
}

/// The content of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Content {
    /// Compressed with gzip.
    pub(crate) compressed: bool,
    /// As they are sent.
    pub(crate) bytes: Vec<u8>,
    /// Its address changes when it does.
    pub(crate) immutable: bool,
}

impl Site {
    /// The page that the program was built with.
    pub(crate) fn built_in() -> Result<Self, Failure> {
        if FILES.is_empty() {
            return Err(Failure::Input(
                "this program was built without the playground's page; `cargo xtask play` in the repository builds \
                 everything and starts it, and --site DIR serves a page from a folder"
                    .to_owned(),
            ));
        }
        Ok(Self { folder: None, ways: BTreeMap::new() })
    }

    /// The page in a folder.
    pub(crate) fn in_folder(folder: &Path) -> Result<Self, Failure> {
        if !folder.join("index.html").is_file() {
            let message = format!("--site: {}: holds no index.html; name the folder of a built page", folder.display());
            return Err(Failure::Input(message));
        }
        Ok(Self { folder: Some(folder.to_path_buf()), ways: BTreeMap::new() })
    }

    /// Lets a short address lead to another one.
    pub(crate) fn lead(&mut self, from: &str, to: String) {
        self.ways.insert(from.to_owned(), to);
    }

    /// Where an address leads, if it is a short one.
    pub(crate) fn way(&self, from: &str) -> Option<&str> {
        self.ways.get(from).map(String::as_str)
    }

    /// The file of an address without its first slash; `None` if there is none.
    pub(crate) fn file(&self, name: &str) -> Option<Content> {
        let name = if name.is_empty() { "index.html" } else { name };
        // The page's builder puts a hash of their content into the names of these.
        let immutable = name.starts_with("assets/");
        match &self.folder {
            Some(folder) => {
                let relative = Path::new(name);
                let is_inside = relative.components().all(|part| matches!(part, Component::Normal(_)));
                let bytes = is_inside.then(|| fs::read(folder.join(relative)).ok()).flatten()?;
                Some(Content { compressed: false, bytes, immutable })
            }
            None => {
                let file = FILES.iter().find(|file| file.name == name)?;
                Some(Content { compressed: file.compressed, bytes: file.bytes.to_vec(), immutable })
            }
        }
    }

    /// The file of an address with brotli, if the page has it so: the page's builder puts it beside the file.
    pub(crate) fn with_brotli(&self, name: &str) -> Option<Vec<u8>> {
        let name = if name.is_empty() { "index.html" } else { name };
        let packed = self.file(&format!("{name}.br"))?;
        // Brotli's bytes do not shrink further; `compressed` would be gzip around them.
        (!packed.compressed).then_some(packed.bytes)
    }

    /// All files of the page with their names, as they are.
    pub(crate) fn files(&self) -> Result<Vec<(String, Vec<u8>)>, Failure> {
        if let Some(folder) = &self.folder {
            let message = format!("{} is a folder of files already; copy it", folder.display());
            return Err(Failure::Input(message));
        }
        FILES.iter().map(|file| Ok((file.name.to_owned(), plain(file.compressed, file.bytes)?))).collect()
    }
}

/// The bytes without compression.
pub(crate) fn plain(compressed: bool, bytes: &[u8]) -> Result<Vec<u8>, Failure> {
    if !compressed {
        return Ok(bytes.to_vec());
    }
    let mut out = Vec::new();
    match GzDecoder::new(bytes).read_to_end(&mut out) {
        Ok(_) => Ok(out),
        Err(error) => Err(Failure::Work(format!("a file of the page in this program is damaged: {error}"))),
    }
}

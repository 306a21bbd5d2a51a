//! What `SCENE` and `RECORDING` mean: a file, or the name of a built-in scene.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use hyperbody_scene::recording::{RecordingError, RecordingReader};
use hyperbody_scene::{BUILT_IN, Scene, built_in, meant};

use crate::failure::Failure;
use crate::numbers::shortened;

/// A recording in a file.
pub(crate) type Recording = RecordingReader<BufReader<File>>;

/// The scene of an argument. A file wins over a built-in scene of the same name.
pub(crate) fn scene(argument: &str) -> Result<Scene, Failure> {
    let path = Path::new(argument);
    if path.is_file() {
        if is_recording(path) {
            let message = "is a recording; `hyperbody render` and `hyperbody inspect` read those, this needs a scene";
            return Err(Failure::Input(format!("{argument}: {message}")));
        }
        return Ok(Scene::load(path)?);
    }
    built_in(argument).or_else(|_| {
        if path.exists() || path.extension().is_some() || path.components().count() > 1 {
            // It was meant as a file; reading it says why that fails.
            return Ok(Scene::load(path)?);
        }
        // A far-fetched hint is worse than none.
        let hint = meant(argument, BUILT_IN.iter().map(|scene| scene.name));
        let hint = hint.map_or(String::new(), |name| format!("; the nearest is \"{name}\""));
        let named = shortened(argument);
        Err(Failure::Input(format!(
            "there is no file \"{named}\", and no built-in scene of that name{hint} (`hyperbody scenes` lists them all)"
        )))
    })
}

/// The recording of an argument; `None` if the file begins otherwise, or there is none.
pub(crate) fn recording(argument: &str) -> Result<Option<Recording>, Failure> {
    let path = Path::new(argument);
    if !path.is_file() || !is_recording(path) {
        return Ok(None);
    }
    let refuse = |error: RecordingError| recording_failure(argument, &error);
    let file = File::open(path).map_err(|error| refuse(error.into()))?;
    RecordingReader::new(BufReader::new(file)).map(Some).map_err(refuse)
}

/// What is said of a recording that cannot be read.
pub(crate) fn recording_failure(argument: &str, error: &RecordingError) -> Failure {
    Failure::Input(format!("{argument}: {error}"))
}

/// Whether a file begins as recordings do, or is called like one.
fn is_recording(path: &Path) -> bool {
    let mut first = [0; 8];
    let read = File::open(path).and_then(|mut file| file.read(&mut first)).unwrap_or(0);
    let is_called_so = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(RECORDING_ENDING));
    is_called_so || Recording::is_recording(&first[..read])
}

/// What names of recordings end in, by habit; any name will do.
pub(crate) const RECORDING_ENDING: &str = "hbrec";

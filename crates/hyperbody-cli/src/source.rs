//! What `SCENE` and `RECORDING` mean: a file, or the name of a built-in scene.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use hyperbody_scene::recording::{RecordingError, RecordingReader};
use hyperbody_scene::{BUILT_IN, Body, Scene, ShapeFile, built_in, meant};

use crate::failure::Failure;
use crate::files::Target;
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

/// Refuses an argument that is neither a file nor the name of a shape nor of `others`, and cannot be meant as a file.
pub(crate) fn refuse_unknown_shape(argument: &str, others: &[&str]) -> Result<(), Failure> {
    let path = Path::new(argument);
    let symbol = argument.trim_start().starts_with('{');
    if path.exists()
        || others.contains(&argument)
        || (!symbol && (path.extension().is_some() || path.components().count() != 1))
    {
        return Ok(());
    }
    let hint = ShapeFile::hint(argument, others);
    let named = shortened(argument);
    let or_scene = if others.is_empty() { "" } else { " or built-in scene" };
    let message = format!("there is no file \"{named}\", and no regular polytope{or_scene} of that name{hint}");
    Err(Failure::Input(message))
}

/// What a shape file is refused with; the option is named where a dimension is missing.
pub(crate) fn with_dimension_hint(error: hyperbody_scene::SceneError) -> Failure {
    let message = error.to_string();
    if message.contains("does not tell its dimension") {
        return Failure::Input(format!("{message} (--dimension N)"));
    }
    Failure::Input(message)
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
    let is_called_so = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(RECORDING_ENDING));
    is_called_so || Recording::is_recording(&first_bytes(path))
}

/// The beginning of a file; nothing of one that cannot be read.
fn first_bytes(path: &Path) -> Vec<u8> {
    let mut first = Vec::new();
    let read = File::open(path).and_then(|file| file.take(LOOKED_AT).read_to_end(&mut first));
    read.map_or_else(|_| Vec::new(), |_| first)
}

/// Bytes by which files are told apart.
const LOOKED_AT: u64 = 64;

/// What a file is by its first bytes, if it is one of those that are likely to be named by mistake.
fn other_kind(first: &[u8]) -> Option<&'static str> {
    const KINDS: [(&[u8], &str); 6] = [
        (b"\x89PNG\r\n\x1a\n", "a PNG picture"),
        (b"GIF8", "a GIF film"),
        (b"\xff\xd8\xff", "a JPEG picture"),
        (b"PK\x03\x04", "a zip archive"),
        (b"\x1f\x8b", "a file packed by gzip"),
        (b"glTF", "a GLB model"),
    ];
    let is_mp4 = first.get(4..8) == Some(b"ftyp");
    KINDS.iter().find(|(start, _)| first.starts_with(start)).map(|(_, kind)| *kind).or(is_mp4.then_some("an MP4 film"))
}

/// Refuses an argument that is a picture, a film or the like, and says what is wanted.
pub(crate) fn refuse_other(wanted: &str, argument: &str) -> Result<(), Failure> {
    match other_kind(&first_bytes(Path::new(argument))) {
        Some(kind) => Err(Failure::Input(format!("{argument}: is {kind}; name {wanted}"))),
        None => Ok(()),
    }
}

/// Refuses to replace a file that is no recording by one: a recording may be called anything, and so a slip of the hand would
/// cost a picture or a scene. An empty file is no loss.
pub(crate) fn refuse_to_replace_other(option: &str, target: &Target) -> Result<(), Failure> {
    let path = target.path();
    let is_kept = path.is_file() && path.metadata().is_ok_and(|metadata| metadata.len() > 0);
    let first = first_bytes(path);
    if !is_kept || Recording::is_recording(&first) {
        return Ok(());
    }
    let kind = other_kind(&first).unwrap_or_else(|| {
        let is = |start: &[u8]| first.trim_ascii_start().starts_with(start);
        if is(b"{") {
            "a JSON file, such as a scene"
        } else if is(b"OFF") || is(b"4OFF") || is(b"nOFF") {
            "an OFF file"
        } else {
            "no recording"
        }
    });
    let message = format!("is {kind}, and would be lost; name another file, or remove this one");
    Err(Failure::Input(format!("{option}: {}: {message}", target.display())))
}

/// The files that a scene was read from: itself, and those that it names. None of a built-in one.
pub(crate) fn files_of(scene: &Scene) -> Result<Vec<PathBuf>, Failure> {
    let Some(file) = &scene.file else { return Ok(Vec::new()) };
    let mut whole = scene.clone();
    whole.carry_files()?;
    let folder = file.parent().unwrap_or(Path::new(""));
    Ok(std::iter::once(file.clone()).chain(whole.files.keys().map(|name| folder.join(name))).collect())
}

/// The files that a shape was read from, itself first.
pub(crate) fn files_of_shape(shape: &ShapeFile) -> Result<Vec<PathBuf>, Failure> {
    let mut scene = Scene::new("", shape.dimension);
    scene.bodies.push(Body::new(shape.shape.clone()));
    scene.file = Some(shape.file.clone());
    files_of(&scene)
}

/// What names of recordings end in, by habit; any name will do.
pub(crate) const RECORDING_ENDING: &str = "hbrec";

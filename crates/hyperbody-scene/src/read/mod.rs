//! From the text of a file to a [`Scene`]: syntax, keys and types. What the values mean is checked where the world is
//! built, for scenes made by programs as for those from files.

mod body;
mod cursor;
mod joint;
mod rotation;
mod shape;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use hyperbody::prelude::{CombineRule, Material};

use crate::dimension::DIMENSIONS;
use crate::error::{ErrorKind, SceneError, nearest};
use crate::json::Json;
use crate::model::{NamedMaterial, Scene};
pub(crate) use cursor::{At, join};
pub(crate) use shape::{made_as, shape};

pub(crate) type Result<T> = std::result::Result<T, SceneError>;

/// What the first key of a scene file says.
pub const FORMAT: &str = "hyperbody-scene";

/// The version of the format that this crate reads and writes.
pub const VERSION: u32 = 1;

/// Largest size of a scene file, bytes.
pub const MAX_FILE_BYTES: u64 = 64 << 20;

const KEYS: [&str; 12] = [
    "format",
    "version",
    "name",
    "description",
    "dimension",
    "gravity",
    "dt",
    "substeps",
    "sleeping",
    "materials",
    "bodies",
    "joints",
];

impl Scene {
    /// Reads a scene file.
    ///
    /// # Errors
    /// If the file cannot be read or is larger than [`MAX_FILE_BYTES`], its text is not JSON, or a key is unknown, missing
    /// or of the wrong type. What the values mean is checked by [`crate::AnyWorld::new`].
    pub fn load(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let stem = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let text = read_text(path, MAX_FILE_BYTES)?;
        let json = Json::parse(&text).map_err(|error| error.in_file(Some(path)))?;
        let mut scene = scene(&At::root(&json), stem).map_err(|error| error.in_file(Some(path)))?;
        scene.file = Some(path.to_path_buf());
        Ok(scene)
    }

    /// Reads a scene from text. Files that it names cannot be found: it lies in no folder.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn from_json(text: &str) -> Result<Self> {
        scene(&At::root(&Json::parse(text)?), String::new())
    }
}

/// First bytes of files that are likely to be named by mistake, and what they are.
const OTHER_FILES: [(&[u8], &str); 7] = [
    (b"\x89PNG\r\n\x1a\n", "a PNG picture"),
    (b"GIF8", "a GIF film"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"\x00\x00\x00\x20ftyp", "an MP4 film"),
    (b"PK\x03\x04", "a zip archive"),
    (b"\x1f\x8b", "a file packed by gzip"),
    (b"\x89HBREC", "a recording"),
];

/// The text of a file of at most `limit` bytes.
pub(crate) fn read_text(path: &Path, limit: u64) -> Result<String> {
    let refuse = |message: String| SceneError::new(ErrorKind::File, "", message).in_file(Some(path));
    let unreadable = |error: std::io::Error| refuse(format!("cannot be read: {error}"));
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(limit + 1).read_to_end(&mut bytes)).map_err(unreadable)?;
    if bytes.len() as u64 > limit {
        return Err(refuse(format!("is larger than {} MiB, the limit for such files; split it", limit >> 20)));
    }
    if let Some((_, kind)) = OTHER_FILES.iter().find(|(first, _)| bytes.starts_with(first)) {
        return Err(refuse(format!("is {kind}, and no text; name a scene or a shape, a .json or .off file")));
    }
    if bytes.split(|&byte| byte == b'\n').next().is_some_and(|line| line.trim_ascii().ends_with(b"OFF BINARY")) {
        return Err(refuse("is a binary OFF file; save it as text, which programs also call ASCII".to_owned()));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = valid.iter().filter(|&&byte| byte == b'\n').count() + 1;
        refuse(format!("line {line}: not UTF-8; save the file as UTF-8 text"))
    })
}

fn scene(at: &At<'_>, default_name: String) -> Result<Scene> {
    // A file of another format or version may hold keys that mean nothing here: say that first.
    let entries = at.entries("a scene: an object with \"format\", \"version\", \"dimension\", \"bodies\"")?;
    check_format(&entries)?;
    let fields = at.fields("a scene", &KEYS)?;
    let dimension = fields.required("dimension")?.count()? as usize;
    // A dimension out of range is refused where the world is built; nothing may grow with it before.
    let mut scene = Scene::new(default_name, dimension.min(*DIMENSIONS.end()));
    scene.dimension = dimension;
    scene.name = fields.or("name", scene.name, At::text)?;
    scene.description = fields.or("description", String::new(), At::text)?;
    scene.gravity = fields.or("gravity", scene.gravity, At::coordinates)?;
    scene.dt = fields.or("dt", scene.dt, At::number)?;
    scene.substeps = fields.or("substeps", scene.substeps, At::count)?;
    scene.sleeping = fields.or("sleeping", scene.sleeping, At::boolean)?;
    scene.materials = fields.or("materials", Vec::new(), materials)?;
    scene.bodies =
        fields.or("bodies", Vec::new(), |at| at.list("a list of bodies")?.iter().map(body::body).collect())?;
    scene.joints =
        fields.or("joints", Vec::new(), |at| at.list("a list of joints")?.iter().map(joint::joint).collect())?;
    Ok(scene)
}

fn check_format(entries: &[(String, At<'_>)]) -> Result<()> {
    let find = |key: &str| entries.iter().find(|(name, _)| name == key).map(|(_, at)| at);
    let Some(format) = find("format") else {
        let message =
            format!("has no \"format\"; a scene starts with \"format\": \"{FORMAT}\", \"version\": {VERSION}");
        return Err(SceneError::structure("", message));
    };
    let format_name = format.text()?;
    if format_name != FORMAT {
        let message = format!("is \"{format_name}\", expected \"{FORMAT}\"");
        return Err(SceneError::value(&format.path, message));
    }
    let Some(version) = find("version") else {
        return Err(SceneError::structure("", format!("has no \"version\"; this program reads version {VERSION}")));
    };
    let number = version.number()?;
    if number != f64::from(VERSION) {
        let message =
            format!("is {number}, but this program reads version {VERSION} only; a newer program may read it");
        return Err(SceneError::new(ErrorKind::Unsupported, &version.path, message));
    }
    Ok(())
}

const MATERIAL_KEYS: [&str; 7] = [
    "friction",
    "restitution",
    "density",
    "rolling_resistance",
    "twisting_resistance",
    "friction_rule",
    "restitution_rule",
];

/// Rules by which two materials combine, as files name them.
pub(crate) const RULES: [(&str, CombineRule); 5] = [
    ("geometric_mean", CombineRule::GeometricMean),
    ("average", CombineRule::Average),
    ("minimum", CombineRule::Minimum),
    ("multiply", CombineRule::Multiply),
    ("maximum", CombineRule::Maximum),
];

fn rule(at: &At<'_>) -> Result<CombineRule> {
    let text = at.text()?;
    RULES.iter().find(|(name, _)| *name == text).map(|(_, rule)| *rule).ok_or_else(|| {
        let names = RULES.map(|(name, _)| name);
        let near = nearest(&text, names).unwrap_or(names[0]);
        let message = format!("is \"{text}\", expected one of {}; the nearest is \"{near}\"", names.join(", "));
        SceneError::value(&at.path, message)
    })
}

fn materials(at: &At<'_>) -> Result<Vec<NamedMaterial>> {
    let material = |(name, at): (String, At<'_>)| {
        let fields = at.fields("a material", &MATERIAL_KEYS)?;
        let mut material = Material::default();
        material.friction = fields.or("friction", material.friction, At::number)?;
        material.restitution = fields.or("restitution", material.restitution, At::number)?;
        material.density = fields.or("density", material.density, At::number)?;
        material.rolling_resistance = fields.or("rolling_resistance", material.rolling_resistance, At::number)?;
        material.twisting_resistance = fields.or("twisting_resistance", material.twisting_resistance, At::number)?;
        material.friction_rule = fields.or("friction_rule", None, |at| rule(at).map(Some))?;
        material.restitution_rule = fields.or("restitution_rule", None, |at| rule(at).map(Some))?;
        Ok(NamedMaterial { name, material })
    };
    at.entries("an object of materials by name")?.into_iter().map(material).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::AnyWorld;

    fn documentation() -> String {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/scene-format.md");
        std::fs::read_to_string(path).expect("the format is described in docs/scene-format.md")
    }

    #[test]
    fn the_documented_example_is_a_good_scene() {
        let page = documentation();
        let example = page.split("```json").nth(1).and_then(|rest| rest.split("```").next()).expect("an example");
        let scene = Scene::from_json(example).unwrap();
        assert_eq!((scene.bodies.len(), scene.dimension), (4, 4));
        AnyWorld::new(&scene, 1).unwrap();
    }

    #[test]
    fn every_key_is_documented() {
        let page = documentation();
        let keys = KEYS
            .iter()
            .chain(&body::BODY_KEYS)
            .chain(&MATERIAL_KEYS)
            .chain(&shape::SHAPES)
            .chain(&joint::JOINTS)
            .chain(&joint::COMMON_KEYS)
            .chain(&joint::DRIVE_KEYS);
        for key in keys {
            assert!(page.contains(&format!("\n| `{key}` |")), "docs/scene-format.md has no row for `{key}`");
        }
    }
}

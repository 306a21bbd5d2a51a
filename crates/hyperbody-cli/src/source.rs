//! What `SCENE` means: a file, or the name of a built-in scene.

use std::path::Path;

use hyperbody_scene::{Scene, built_in};

use crate::failure::Failure;

/// The scene of an argument. A file wins over a built-in scene of the same name.
pub(crate) fn scene(argument: &str) -> Result<Scene, Failure> {
    let path = Path::new(argument);
    if path.is_file() {
        return Ok(Scene::load(path)?);
    }
    built_in(argument).or_else(|nearest| {
        if path.exists() || path.extension().is_some() || path.components().count() > 1 {
            // It was meant as a file; reading it says why that fails.
            return Ok(Scene::load(path)?);
        }
        Err(Failure::Input(format!(
            "there is no file \"{argument}\", and no built-in scene of that name; the nearest is \"{nearest}\" \
             (`hyperbody scenes` lists them all)"
        )))
    })
}

//! Scenes that carry the files they name along, to be built where these files are not.

use crate::build::read_beside;
use crate::error::SceneError;
use crate::model::{PolytopeSpec, Scene, ShapeSpec};

impl Scene {
    /// Reads every file that the scene names into [`Scene::files`]: from then on the scene needs nothing beside it.
    ///
    /// # Errors
    /// If a file cannot be read; the message says where the scene names it.
    pub fn carry_files(&mut self) -> Result<(), SceneError> {
        let mut named = Vec::new();
        for (index, body) in self.bodies.iter().enumerate() {
            files_of(&body.shape, &format!("bodies[{index}].shape"), &mut named);
        }
        for (name, path) in named {
            if !self.files.contains_key(&name) {
                let text = read_beside(self.beside(), &name, &path);
                let text = text.map_err(|error| error.in_file(self.file.as_deref()))?;
                self.files.insert(name, text);
            }
        }
        Ok(())
    }
}

/// Names of files in a shape, with the places where they stand.
fn files_of(shape: &ShapeSpec, path: &str, out: &mut Vec<(String, String)>) {
    let path = format!("{path}.{}", shape.key());
    match shape {
        ShapeSpec::Polytope(PolytopeSpec::File(file)) | ShapeSpec::Mesh { file } => {
            out.push((file.clone(), format!("{path}.file")));
        }
        ShapeSpec::Rounded { shape, .. } => files_of(shape, &format!("{path}.shape"), out),
        ShapeSpec::Product { factors } => {
            for (index, factor) in factors.iter().enumerate() {
                files_of(&factor.shape, &format!("{path}.factors[{index}].shape"), out);
            }
        }
        ShapeSpec::Pyramid { base, .. } => files_of(&base.shape, &format!("{path}.base.shape"), out),
        ShapeSpec::Compound { parts } => {
            for (index, part) in parts.iter().enumerate() {
                files_of(&part.shape, &format!("{path}.parts[{index}].shape"), out);
            }
        }
        ShapeSpec::Ball { .. }
        | ShapeSpec::Box { .. }
        | ShapeSpec::HalfSpace { .. }
        | ShapeSpec::Capsule { .. }
        | ShapeSpec::Star { .. }
        | ShapeSpec::Polytope(_) => {}
    }
}

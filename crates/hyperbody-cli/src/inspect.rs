//! `hyperbody inspect`: what is in a scene, a recording or a shape.

mod recording;
mod scene;
mod shape;

use std::path::Path;

use hyperbody_scene::{BUILT_IN, Scene, ShapeFile, built_in};

use crate::arguments::InspectArguments;
use crate::failure::Failure;
use crate::output::{print, print_json};
use crate::source;

pub(crate) fn inspect(arguments: &InspectArguments) -> Result<(), Failure> {
    let path = Path::new(&arguments.file);
    if let Some(recording) = source::recording(&arguments.file)? {
        let report = recording::report(recording, &arguments.file)?;
        check_dimension(arguments, report.dimension())?;
        return if arguments.json { print_json(&report) } else { print(report.as_text()) };
    }
    if path.is_file() && !ShapeFile::holds_scene(path)? {
        let file = ShapeFile::load(path, arguments.dimension.map(usize::from)).map_err(source::with_dimension_hint)?;
        return inspect_shape(arguments, &file);
    }
    if !path.exists()
        && built_in(&arguments.file).is_err()
        && let Some(shape) = ShapeFile::named(&arguments.file, arguments.dimension.map(usize::from))
    {
        return inspect_shape(arguments, &shape.map_err(source::with_dimension_hint)?);
    }
    source::refuse_unknown_shape(&arguments.file, &BUILT_IN.map(|scene| scene.name))?;
    let scene: Scene = source::scene(&arguments.file)?;
    check_dimension(arguments, scene.dimension)?;
    let report = scene::report(&scene)?;
    if arguments.json { print_json(&report) } else { print(scene::as_text(&report)) }
}

fn inspect_shape(arguments: &InspectArguments, shape: &ShapeFile) -> Result<(), Failure> {
    let report = shape::report(shape)?;
    if arguments.json { print_json(&report) } else { print(shape::as_text(&report, &arguments.file)) }
}

fn check_dimension(arguments: &InspectArguments, dimension: usize) -> Result<(), Failure> {
    match arguments.dimension {
        Some(said) if usize::from(said) != dimension => {
            Err(Failure::Input(format!("{} has {dimension} dimensions, not {said}", arguments.file)))
        }
        _ => Ok(()),
    }
}

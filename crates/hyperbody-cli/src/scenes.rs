//! `hyperbody scenes`: what there is to see.

use std::fs;
use std::path::Path;

use hyperbody_scene::{BUILT_IN, Scene};
use serde::Serialize;

use crate::arguments::ScenesArguments;
use crate::failure::Failure;
use crate::output::{print, print_json, table};

#[derive(Serialize)]
struct Report {
    scenes: Vec<Entry>,
}

#[derive(Serialize)]
struct Entry {
    name: String,
    dimension: usize,
    bodies: usize,
    joints: usize,
    description: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
}

pub(crate) fn scenes(arguments: &ScenesArguments) -> Result<(), Failure> {
    let mut report = Report { scenes: Vec::with_capacity(BUILT_IN.len()) };
    for built_in in &BUILT_IN {
        let scene = built_in.scene();
        let file = arguments.write.as_deref().map(|folder| write(&scene, folder)).transpose()?;
        report.scenes.push(Entry {
            dimension: scene.dimension,
            bodies: scene.bodies.len(),
            joints: scene.joints.len(),
            name: scene.name,
            description: scene.description,
            file,
        });
    }
    if arguments.json {
        return print_json(&report);
    }
    let mut table = table(&["name", "dim", "bodies", "what to see"], 4);
    table.set_content_arrangement(comfy_table::ContentArrangement::Dynamic);
    table.set_width(width());
    for scene in &report.scenes {
        table.add_row([&scene.name, &scene.dimension.to_string(), &scene.bodies.to_string(), &scene.description]);
    }
    print(table)?;
    if let Some(folder) = &arguments.write {
        print(format!("{} scenes written to {}", report.scenes.len(), folder.display()))?;
    }
    Ok(())
}

/// Columns of the terminal, as far as the environment tells.
fn width() -> u16 {
    std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok()).unwrap_or(120).clamp(60, 200)
}

fn write(scene: &Scene, folder: &Path) -> Result<String, Failure> {
    let path = folder.join(format!("{}.json", scene.name));
    fs::create_dir_all(folder)
        .and_then(|()| fs::write(&path, scene.to_json()))
        .map_err(|error| Failure::Work(format!("{}: cannot be written: {error}", path.display())))?;
    Ok(path.display().to_string())
}

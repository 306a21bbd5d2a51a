//! `hyperbody scenes`: what there is to see.

use std::fs;
use std::path::{Path, PathBuf};

use hyperbody_scene::{BUILT_IN, BuiltIn, Scene};
use serde::Serialize;

use crate::arguments::ScenesArguments;
use crate::failure::Failure;
use crate::files::Target;
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
    if let Some(folder) = &arguments.write {
        prepare(folder, arguments.force)?;
    }
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

/// Makes the folder, and sees to it before anything is written that no file which someone changed would be lost.
fn prepare(folder: &Path, force: bool) -> Result<(), Failure> {
    let refuse = |path: &Path, what: &str| Err(Failure::Input(format!("--write: {}: {what}", path.display())));
    if folder.exists() && !folder.is_dir() {
        return refuse(folder, "is a file; name a folder");
    }
    if let Err(error) = fs::create_dir_all(folder) {
        return refuse(folder, &format!("cannot be made: {error}"));
    }
    for scene in BUILT_IN.iter().map(BuiltIn::scene) {
        let path = path_of(&scene, folder);
        if !force && path.exists() && fs::read(&path).is_ok_and(|old| old != scene.to_json().as_bytes()) {
            return refuse(&path, "is there already and differs; name another folder, or add --force to overwrite it");
        }
    }
    Ok(())
}

fn path_of(scene: &Scene, folder: &Path) -> PathBuf {
    folder.join(format!("{}.json", scene.name))
}

fn write(scene: &Scene, folder: &Path) -> Result<String, Failure> {
    let path = path_of(scene, folder);
    Target::new("--write", &path, &["json"])?.write(scene.to_json().as_bytes())?;
    Ok(path.display().to_string())
}

//! `cargo xtask pictures`: the pictures of the README and of the gallery page, drawn from the built-in scenes.

use std::path::Path;
use std::process::Command;

use clap::Args;

use crate::Outcome;
use crate::process::{build_hyperbody, read, root, run as run_command};

/// Where the gallery's pictures are, seen from the repository's root.
const GALLERY: &str = "docs/pictures/gallery";

#[derive(Args)]
pub(crate) struct PicturesArguments {
    /// Only these: names of built-in scenes, "hero" and "film" for the README's picture and film
    names: Vec<String>,
}

/// The picture at the top of the README.
const HERO: [&str; 15] = [
    "dice4d",
    "--at",
    "1",
    "--slice",
    "w=-0.5",
    "--camera",
    "30,16,7.4",
    "--width",
    "1200",
    "--height",
    "560",
    "--quality",
    "8",
    "--output",
    "docs/pictures/dice4d.png",
];

/// A film of the same scene at rest, with the slice moving through it.
const FILM: [&str; 20] = [
    "dice4d",
    "--at",
    "3",
    "--seconds",
    "3.4",
    "--frame-rate",
    "12",
    "--slice",
    "w=-1.6",
    "--slice-to",
    "w=1.6",
    "--camera",
    "30,16,8",
    "--width",
    "480",
    "--height",
    "270",
    "--no-caption",
    "--output",
    "docs/pictures/through-w.gif",
];

/// What is better shown otherwise than after three seconds and cut at w = 0.
const MOMENTS: [(&str, &[&str]); 13] = [
    ("bounce2d", &["--at", "0.8"]),
    ("cradle2d", &["--at", "0.35"]),
    ("wing_nut3d", &["--at", "1.9"]),
    ("dominoes3d", &["--at", "3.5"]),
    ("chain3d", &["--at", "0.9"]),
    ("stack4d", &["--at", "1"]),
    ("dice4d", &["--at", "1", "--slice", "w=-0.5"]),
    ("balls4d", &["--at", "1.4"]),
    ("tumble4d", &["--at", "2.3"]),
    ("bowling4d", &["--at", "1.25"]),
    ("pendulum4d", &["--at", "1.2"]),
    ("clouds5d", &["--at", "1.5"]),
    ("balls6d", &["--at", "1.5"]),
];

pub(crate) fn run(arguments: &PicturesArguments) -> Outcome {
    let program = build_hyperbody(true)?;
    let wanted = |name: &str| arguments.names.is_empty() || arguments.names.iter().any(|other| other == name);
    let mut drawn = 0;
    if wanted("hero") {
        draw(&program, &HERO)?;
        drawn += 1;
    }
    if wanted("film") {
        draw(&program, &FILM)?;
        drawn += 1;
    }
    let folder = root().join(GALLERY);
    std::fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    for name in scenes(&program)?.iter().filter(|name| wanted(name)) {
        let file = format!("{GALLERY}/{name}.png");
        let moment = MOMENTS.iter().find(|(scene, _)| scene == name).map_or(&[][..], |(_, moment)| moment);
        let mut line = vec![name.as_str(), "--output", &file, "--width", "480", "--height", "270", "--no-caption"];
        line.extend(moment);
        draw(&program, &line)?;
        drawn += 1;
    }
    if drawn == 0 {
        return Err(format!("there is no built-in scene {}", arguments.names.join(" or ")));
    }
    println!("{drawn} pictures drawn under docs/pictures");
    Ok(())
}

fn draw(program: &Path, line: &[&str]) -> Outcome {
    println!("    {}", line.join(" "));
    run_command(Command::new(program).current_dir(root()).arg("render").args(line))
}

fn scenes(program: &Path) -> Outcome<Vec<String>> {
    let text = read(Command::new(program).args(["scenes", "--json"]))?;
    let answer: serde_json::Value =
        serde_json::from_str(&text).map_err(|error| format!("`hyperbody scenes --json` printed no JSON: {error}"))?;
    let scenes = answer["scenes"].as_array().ok_or("`hyperbody scenes --json` has no list `scenes`")?;
    Ok(scenes.iter().filter_map(|scene| scene["name"].as_str().map(str::to_owned)).collect())
}

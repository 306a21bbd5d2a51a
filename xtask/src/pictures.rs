//! `cargo xtask pictures`: the pictures and films of the README and of the gallery page, drawn from the built-in scenes.
//!
//! docs/pictures/inputs.json remembers what each was drawn from: the command, the scene, and how the renderer looks. The
//! check compares that with what is there now, and draws a single small picture for it. That a change of the solver moves
//! the bodies in a picture is not noticed; the pictures are then of an earlier engine, not of another scene.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use clap::Args;
use serde_json::{Value, json};

use crate::process::{build_hyperbody, read, root, run as run_command, target_directory};
use crate::{Outcome, scenes};

/// Where the pictures are, seen from the repository's root.
const FOLDER: &str = "docs/pictures";

/// What they were drawn from.
const INPUTS: &str = "docs/pictures/inputs.json";

/// Most bytes of all pictures together: they are part of every clone.
const MAX_BYTES: u64 = 6_000_000;

#[derive(Args)]
pub(crate) struct PicturesArguments {
    /// Only these: names of built-in scenes, or of files in docs/pictures
    names: Vec<String>,
    /// Only says whether the pictures are up to date
    #[arg(long)]
    check: bool,
}

/// One picture and how it is drawn.
struct Picture {
    /// In the folder of pictures.
    file: String,
    scene: String,
    options: Vec<String>,
}

/// The pictures and films of the README and of the chapters: file, scene, options.
const SHOWN: [(&str, &str, &str); 4] = [
    (
        "falling.gif",
        "pit4d",
        "--seconds 3.6 --speed 0.6 --frame-rate 13 --camera 34,13,12.5 --look-at 0,1.9,0 --width 512 --height 288 \
         --no-caption",
    ),
    ("dice4d.png", "dice4d", "--at 1 --slice w=-0.5 --camera 30,16,7.4 --width 1200 --height 560 --quality 8"),
    (
        "through-w.gif",
        "dice4d",
        "--at 3 --speed 0 --seconds 4 --frame-rate 10 --slice w=-1.6 --slice-to w=1.6 --camera 30,16,8 --width 400 \
         --height 225",
    ),
    (
        "turning.gif",
        "dice4d",
        "--at 3 --speed 0 --seconds 6 --frame-rate 8 --turn-to xw=360 --camera 30,16,8 --width 400 --height 225 --no-strip",
    ),
];

/// What is better shown otherwise than after three seconds and cut at w = 0.
const MOMENTS: [(&str, &str); 15] = [
    ("bounce2d", "--at 0.8"),
    ("cradle2d", "--at 0.35"),
    ("ramp3d", "--at 1.9"),
    ("wing_nut3d", "--at 1.9"),
    ("dominoes3d", "--at 3.5"),
    ("chain3d", "--at 0.9"),
    ("stack4d", "--at 1"),
    ("dice4d", "--at 1 --slice w=-0.5"),
    ("balls4d", "--at 1.4"),
    // The five stand in a row along w, which takes the place of z here.
    ("ramp4d", "--at 1.1 --turn zw=90"),
    ("tumble4d", "--at 2.3"),
    ("bowling4d", "--at 1.25"),
    ("pendulum4d", "--at 1.2"),
    ("clouds5d", "--at 1.5"),
    ("balls6d", "--at 1.5"),
];

/// How every picture of the gallery page is drawn.
const GALLERY_OPTIONS: &str = "--width 480 --height 270 --no-caption";

/// A picture of bodies before the first step: it changes with the look of pictures, and with nothing else.
const LOOK: &str = "render dice4d --at 0 --width 96 --height 54 --threads 1";

pub(crate) fn run(arguments: &PicturesArguments) -> Outcome {
    if arguments.check {
        return check();
    }
    let program = build_hyperbody(true)?;
    let now = Inputs::new(&program)?;
    let mut remembered = read_inputs();
    let is_wanted = |picture: &Picture| {
        let stem = Path::new(&picture.file).file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into());
        arguments.names.is_empty()
            || arguments.names.iter().any(|name| *name == picture.file || *name == stem || *name == picture.scene)
    };
    let wanted: Vec<&Picture> = now.pictures.iter().filter(|picture| is_wanted(picture)).collect();
    if wanted.is_empty() {
        return Err(format!("there is no picture of {}", arguments.names.join(" or ")));
    }
    let gallery = root().join(FOLDER).join("gallery");
    std::fs::create_dir_all(&gallery).map_err(|error| format!("cannot make {}: {error}", gallery.display()))?;
    for picture in &wanted {
        let file = format!("{FOLDER}/{}", picture.file);
        let mut line = vec!["render", &picture.scene, "--output", &file];
        line.extend(picture.options.iter().map(String::as_str));
        println!("    hyperbody {}", line.join(" "));
        run_command(Command::new(&program).current_dir(root()).args(line))?;
        remembered.insert(picture.file.clone(), now.of(picture)?);
    }
    remembered.retain(|file, _| now.pictures.iter().any(|picture| picture.file == *file));
    let text = serde_json::to_string_pretty(&remembered).map_err(|error| error.to_string())? + "\n";
    std::fs::write(root().join(INPUTS), text).map_err(|error| format!("cannot write {INPUTS}: {error}"))?;
    scenes::write()?;
    println!("{} pictures drawn; {} kB in {FOLDER}", wanted.len(), total_bytes(&now.pictures) / 1000);
    check()
}

/// Whether every picture is there and was drawn from what is there now.
pub(crate) fn check() -> Outcome {
    let now = Inputs::new(&build_hyperbody(true)?)?;
    let remembered = read_inputs();
    let mut stale: Vec<&str> = Vec::new();
    for picture in &now.pictures {
        let is_there = root().join(FOLDER).join(&picture.file).is_file();
        if !is_there || remembered.get(&picture.file) != Some(&now.of(picture)?) {
            stale.push(&picture.file);
        }
    }
    if !stale.is_empty() {
        let names: Vec<&str> = stale
            .iter()
            .map(|file| file.rsplit('/').next().unwrap_or(file).split('.').next().unwrap_or(file))
            .collect();
        return Err(format!("pictures are out of date; `cargo xtask pictures {}` draws them", names.join(" ")));
    }
    let bytes = total_bytes(&now.pictures);
    if bytes > MAX_BYTES {
        return Err(format!("the pictures in {FOLDER} take {bytes} bytes; make them smaller, to {MAX_BYTES} at most"));
    }
    Ok(())
}

/// What pictures are drawn from now.
struct Inputs {
    pictures: Vec<Picture>,
    /// Hash of each scene by name.
    scenes: BTreeMap<String, u64>,
    /// Hash of the picture that shows the look.
    look: u64,
}

impl Inputs {
    fn new(program: &Path) -> Outcome<Self> {
        let folder = target_directory()?.join("pictures-check");
        let text = |path: &Path| path.to_str().map(str::to_owned).ok_or("the target folder has a name beyond UTF-8");
        read(Command::new(program).args(["scenes", "--force", "--write", &text(&folder)?]))?;
        let mut scenes = BTreeMap::new();
        for name in scene_names(program)? {
            scenes.insert(name.clone(), hash(&read_bytes(&folder.join(format!("{name}.json")))?));
        }
        let look = folder.join("look.png");
        read(Command::new(program).args(LOOK.split(' ')).args(["--output", &text(&look)?]))?;
        let words = |options: &str| options.split_whitespace().map(str::to_owned).collect::<Vec<String>>();
        let mut pictures: Vec<Picture> = SHOWN
            .iter()
            .map(|&(file, scene, options)| Picture {
                file: file.to_owned(),
                scene: scene.to_owned(),
                options: words(options),
            })
            .collect();
        for name in scenes.keys() {
            let moment = MOMENTS.iter().find(|(scene, _)| scene == name).map_or("", |(_, moment)| moment);
            let options = words(&format!("{GALLERY_OPTIONS} {moment}"));
            pictures.push(Picture { file: format!("gallery/{name}.png"), scene: name.clone(), options });
        }
        Ok(Self { pictures, scenes, look: hash(&read_bytes(&look)?) })
    }

    /// What is remembered of a picture.
    fn of(&self, picture: &Picture) -> Outcome<Value> {
        let scene = self.scenes.get(&picture.scene).ok_or_else(|| format!("there is no scene {}", picture.scene))?;
        Ok(json!({
            "line": format!("{} {}", picture.scene, picture.options.join(" ")),
            "scene": format!("{scene:016x}"),
            "look": format!("{:016x}", self.look),
        }))
    }
}

fn read_inputs() -> BTreeMap<String, Value> {
    // A file that is missing or makes no sense is one in which nothing is remembered.
    let text = std::fs::read_to_string(root().join(INPUTS)).unwrap_or_default();
    serde_json::from_str(&text).unwrap_or_default()
}

fn read_bytes(path: &Path) -> Outcome<Vec<u8>> {
    std::fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}

fn total_bytes(pictures: &[Picture]) -> u64 {
    let size =
        |picture: &Picture| std::fs::metadata(root().join(FOLDER).join(&picture.file)).map_or(0, |file| file.len());
    pictures.iter().map(size).sum()
}

/// Fowler–Noll–Vo 1a, 64 bits (G. Fowler, L. Noll, K.-P. Vo, 1991).
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

fn scene_names(program: &Path) -> Outcome<Vec<String>> {
    let text = read(Command::new(program).args(["scenes", "--json"]))?;
    let answer: Value =
        serde_json::from_str(&text).map_err(|error| format!("`hyperbody scenes --json` printed no JSON: {error}"))?;
    let scenes = answer["scenes"].as_array().ok_or("`hyperbody scenes --json` has no list `scenes`")?;
    Ok(scenes.iter().filter_map(|scene| scene["name"].as_str().map(str::to_owned)).collect())
}

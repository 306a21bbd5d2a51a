//! `cargo xtask pictures`: the pictures and films of the README and of the gallery page, drawn from the built-in scenes.
//!
//! docs/pictures/inputs.json remembers for each what it was drawn from: the command, the hash of the simulation's state at
//! the last moment it shows, how it looks, by the hash of a small picture or film by the same command, and the hash of the
//! file. The check does all but draw the large ones, and so sees a change of the scene, of the solver, of the renderer, of
//! the encoders and of the files, in some seconds.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;
use serde_json::{Value, json};

use crate::process::{build_hyperbody, read, root, target_directory};
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
    /// Pixels across and down.
    size: (u32, u32),
    options: Vec<String>,
}

/// The pictures and films of the README and of the chapters: file, scene, size, options.
const SHOWN: [(&str, &str, (u32, u32), &str); 6] = [
    (
        "falling.gif",
        "pit4d",
        (512, 288),
        "--seconds 3.6 --speed 0.6 --frame-rate 13 --camera 34,13,12.5 --look-at 0,1.9,0 --no-caption",
    ),
    ("dice4d.png", "dice4d", (1200, 560), "--at 1 --slice w=-0.5 --camera 30,16,7.4 --quality 8"),
    ("sheet-w.png", "dice4d", (320, 180), "--at 3 --sheet w=-1..1,6 --columns 3 --camera 30,16,8"),
    ("sheet-t.png", "pit4d", (320, 180), "--sheet t=0..2,6 --columns 3"),
    (
        "through-w.gif",
        "dice4d",
        (400, 225),
        "--at 3 --speed 0 --seconds 4 --frame-rate 10 --slice w=-1.6 --slice-to w=1.6 --camera 30,16,8",
    ),
    (
        "turning.gif",
        "dice4d",
        (400, 225),
        "--at 3 --speed 0 --seconds 6 --frame-rate 8 --turn-to xw=360 --camera 30,16,8 --no-strip",
    ),
];

/// What is better shown otherwise than after three seconds and cut at w = 0.
const MOMENTS: [(&str, &str); 21] = [
    ("bounce2d", "--at 0.8"),
    ("cradle2d", "--at 0.35"),
    ("ramp3d", "--at 1.9"),
    ("wing_nut3d", "--at 2.6 --camera 34,17,3.2"),
    ("dominoes3d", "--at 3.5"),
    ("chain3d", "--at 0.9"),
    ("seesaw3d", "--at 0.75"),
    ("gyroscope3d", "--at 1"),
    ("car3d", "--at 2.2"),
    ("stack4d", "--at 1"),
    ("dice4d", "--at 1 --slice w=-0.5"),
    ("balls4d", "--at 1.4"),
    // The five stand in a row along w, which takes the place of z here.
    ("ramp4d", "--at 1.1 --turn zw=90"),
    ("tumble4d", "--at 2.3"),
    // Ten of the twenty pins stand in the face of the tetrahedron that this slice runs along.
    ("bowling4d", "--at 0.92 --turn xw=-18.435 --camera -40,24,6 --look-at 1.4,0.6,0.4"),
    ("pendulum4d", "--at 1 --camera 34,17,5.6 --look-at -0.6,2.95,0"),
    ("door4d", "--at 1.1"),
    ("mixer4d", "--at 2"),
    ("wrecking_ball4d", "--at 1.75"),
    // Half of the cubes of each cloud are there on the positive sides of w and v.
    ("clouds5d", "--at 1.4 --slice w=0.7,v=0.7"),
    ("balls6d", "--at 1.5"),
];

/// Size of the pictures of the gallery page.
const GALLERY_SIZE: (u32, u32) = (480, 270);

/// How every picture of the gallery page is drawn.
const GALLERY_OPTIONS: &str = "--no-caption";

/// Pixels across of the small pictures of the check.
const CHECKED_WIDTH: u32 = 96;

pub(crate) fn run(arguments: &PicturesArguments) -> Outcome {
    if arguments.check {
        return check();
    }
    let studio = Studio::new()?;
    let mut remembered = read_inputs();
    let is_wanted = |picture: &Picture| {
        let stem = Path::new(&picture.file).file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into());
        arguments.names.is_empty()
            || arguments.names.iter().any(|name| *name == picture.file || *name == stem || *name == picture.scene)
    };
    let wanted: Vec<&Picture> = studio.pictures.iter().filter(|picture| is_wanted(picture)).collect();
    if wanted.is_empty() {
        return Err(format!("there is no picture of {}", arguments.names.join(" or ")));
    }
    let gallery = root().join(FOLDER).join("gallery");
    std::fs::create_dir_all(&gallery).map_err(|error| format!("cannot make {}: {error}", gallery.display()))?;
    for picture in &wanted {
        let file = format!("{FOLDER}/{}", picture.file);
        println!("    hyperbody {}", studio.line(picture, picture.size, &file).join(" "));
        studio.draw(picture, picture.size, &file)?;
        remembered.insert(picture.file.clone(), studio.inputs(picture)?);
    }
    remembered.retain(|file, _| studio.pictures.iter().any(|picture| picture.file == *file));
    let text = serde_json::to_string_pretty(&remembered).map_err(|error| error.to_string())? + "\n";
    std::fs::write(root().join(INPUTS), text).map_err(|error| format!("cannot write {INPUTS}: {error}"))?;
    scenes::write()?;
    println!("{} pictures drawn; {} kB in {FOLDER}", wanted.len(), total_bytes(&studio.pictures) / 1000);
    Ok(())
}

/// Whether every picture is there and is what would be drawn now.
pub(crate) fn check() -> Outcome {
    let studio = Studio::new()?;
    let remembered = read_inputs();
    let mut stale: Vec<String> = Vec::new();
    for picture in &studio.pictures {
        let then = remembered.get(&picture.file).cloned().unwrap_or_default();
        let changed = match studio.inputs(picture) {
            Ok(now) => REASONS.iter().find(|(key, _)| now[*key] != then[*key]).map(|(_, reason)| *reason),
            Err(_) if !root().join(FOLDER).join(&picture.file).is_file() => Some("is not there"),
            Err(message) => return Err(message),
        };
        if let Some(reason) = changed {
            let name = picture.file.rsplit('/').next().and_then(|name| name.split('.').next()).unwrap_or_default();
            println!("    {}: {reason}", picture.file);
            stale.push(name.to_owned());
        }
    }
    if !stale.is_empty() {
        return Err(format!("pictures are out of date; `cargo xtask pictures {}` draws them", stale.join(" ")));
    }
    let bytes = total_bytes(&studio.pictures);
    if bytes > MAX_BYTES {
        return Err(format!("the pictures in {FOLDER} take {bytes} bytes; make them smaller, to {MAX_BYTES} at most"));
    }
    Ok(())
}

/// What is remembered of a picture, and what it means that it differs.
const REASONS: [(&str, &str); 4] = [
    ("line", "is drawn by another command now"),
    ("state", "the bodies are elsewhere now: the scene or the solver has changed"),
    ("look", "the same bodies look otherwise now: colours, the renderer or an encoder has changed"),
    ("file", "is another file than the one that was drawn"),
];

/// The program, and what it has to draw.
struct Studio {
    program: PathBuf,
    pictures: Vec<Picture>,
    /// Where the small pictures of the check go.
    folder: PathBuf,
}

impl Studio {
    fn new() -> Outcome<Self> {
        let program = build_hyperbody(true)?;
        let words = |options: &str| options.split_whitespace().map(str::to_owned).collect::<Vec<String>>();
        let mut pictures: Vec<Picture> = SHOWN
            .iter()
            .map(|&(file, scene, size, options)| Picture {
                file: file.to_owned(),
                scene: scene.to_owned(),
                size,
                options: words(options),
            })
            .collect();
        for name in scene_names(&program)? {
            let moment = MOMENTS.iter().find(|(scene, _)| *scene == name).map_or("", |(_, moment)| moment);
            let options = words(&format!("{GALLERY_OPTIONS} {moment}"));
            pictures.push(Picture { file: format!("gallery/{name}.png"), scene: name, size: GALLERY_SIZE, options });
        }
        let folder = target_directory()?.join("pictures-check");
        std::fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
        Ok(Self { program, pictures, folder })
    }

    /// The arguments that draw a picture.
    fn line(&self, picture: &Picture, (width, height): (u32, u32), file: &str) -> Vec<String> {
        let mut line: Vec<String> = ["render", &picture.scene, "--output", file].map(str::to_owned).into();
        line.extend(["--width".to_owned(), width.to_string(), "--height".to_owned(), height.to_string()]);
        line.extend(picture.options.iter().cloned());
        line
    }

    /// Draws a picture, and gives what the program says of it.
    fn draw(&self, picture: &Picture, size: (u32, u32), file: &str) -> Outcome<Value> {
        let mut command = Command::new(&self.program);
        command.current_dir(root()).args(self.line(picture, size, file)).arg("--json");
        let text = read(&mut command)?;
        serde_json::from_str(&text).map_err(|error| format!("`hyperbody render --json` printed no JSON: {error}"))
    }

    /// What there is to remember of a picture, whose file has to be there.
    fn inputs(&self, picture: &Picture) -> Outcome<Value> {
        let file = hash(&read_bytes(&root().join(FOLDER).join(&picture.file))?);
        let (width, height) = picture.size;
        let line = format!("{} {width}x{height} {}", picture.scene, picture.options.join(" "));
        let small = self.folder.join(picture.file.replace('/', "-"));
        let path = small.to_str().ok_or("the target folder has a name beyond UTF-8")?;
        let size = (CHECKED_WIDTH, (CHECKED_WIDTH * height / width).max(16));
        let said = self.draw(picture, size, path)?;
        let look = hash(&read_bytes(&small)?);
        Ok(json!({
            "line": line,
            "state": said["hash"],
            "look": format!("{look:016x}"),
            "file": format!("{file:016x}"),
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

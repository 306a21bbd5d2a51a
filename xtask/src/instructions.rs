//! `cargo xtask instructions`: how many instructions a step takes, counted, not timed: the same from one run to the next on
//! a machine that does other things beside, so that a change of one percent shows.

use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;
use serde_json::{Map, Value, json};

use crate::Outcome;
use crate::process::{build_hyperbody, root, succeeds, target_directory};

/// A few scenes that stand for what people simulate: walls, joints, rubble, balls, each in its dimension.
const SCENES: [&str; 6] = ["pyramid2d", "pyramid3d", "chain3d", "pit4d", "balls4d", "stack5d"];

#[derive(Args)]
pub(crate) struct InstructionsArguments {
    /// Scene files or names of built-in scenes; six of the built-in ones if none is given
    scenes: Vec<String>,
    /// Step from which to count
    #[arg(long, default_value_t = 60)]
    warmup: u32,
    /// Steps to count
    #[arg(long, default_value_t = 20)]
    steps: u32,
    /// An earlier file of counts: prints how many times as many each scene takes now
    #[arg(long, value_name = "FILE")]
    compare: Option<PathBuf>,
}

pub(crate) fn run(arguments: &InstructionsArguments) -> Outcome {
    if !succeeds(Command::new("valgrind").arg("--version")) {
        return Err("counting instructions takes valgrind: install it (Debian: apt install valgrind)".to_owned());
    }
    let program = build_hyperbody(true)?;
    let earlier = arguments.compare.as_deref().map(read).transpose()?;
    let named: Vec<String> = match arguments.scenes.as_slice() {
        [] => SCENES.iter().map(ToString::to_string).collect(),
        scenes => scenes.to_vec(),
    };
    let mut counts = Map::new();
    println!("{:24} {:>16}   now/then", "scene", "a step");
    for scene in &named {
        // Twice, so that what reading and building the scene takes drops out.
        let until = count(&program, scene, arguments.warmup)?;
        let all = count(&program, scene, arguments.warmup + arguments.steps)?;
        let a_step = (all - until) / f64::from(arguments.steps.max(1));
        let ratio = earlier.as_ref().and_then(|earlier| earlier[scene].as_f64());
        let ratio = ratio.map_or_else(String::new, |then| format!("{:8.4}", a_step / then));
        println!("{scene:24} {a_step:16.0}   {ratio}");
        counts.insert(scene.clone(), json!(a_step));
    }
    let path = target_directory()?.join("bench").join("instructions.json");
    let directory = path.parent().unwrap_or(root());
    std::fs::create_dir_all(directory)
        .and_then(|()| std::fs::write(&path, format!("{:#}\n", Value::Object(counts))))
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    println!("saved as {}", path.display());
    Ok(())
}

fn read(path: &Path) -> Outcome<Value> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    serde_json::from_str(&text).map_err(|error| format!("{} holds no JSON: {error}", path.display()))
}

/// Instructions of a run of so many steps.
fn count(program: &Path, scene: &str, steps: u32) -> Outcome<f64> {
    let steps = steps.to_string();
    let mut command = Command::new("valgrind");
    command.current_dir(root()).args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]).arg(program);
    command.args(["bench", scene, "--steps", &steps, "--warmup", "0", "--threads", "1", "--awake", "--json"]);
    let output = command.output().map_err(|error| format!("cannot start valgrind: {error}"))?;
    let text = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!("counting {scene} ended with {}:\n{text}", output.status));
    }
    let collected = text.lines().find_map(|line| line.split_once("Collected :"));
    let number = collected.and_then(|(_, number)| number.trim().parse::<f64>().ok());
    number.ok_or_else(|| format!("valgrind printed no count for {scene}:\n{text}"))
}

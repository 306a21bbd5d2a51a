//! The same scene gives the same bits: twice, on one thread and on two, in debug and in release, and from a snapshot.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::Outcome;
use crate::process::{build_hyperbody, cargo, read, run};

/// Long enough that every built-in scene has met its floor.
const STEPS: &str = "90";

/// Compares the state hash of every built-in scene across builds, thread counts and repetitions.
pub(crate) fn check() -> Outcome {
    let debug = build_hyperbody(false)?;
    let release = build_hyperbody(true)?;
    let names = scene_names(&release)?;
    if names.is_empty() {
        return Err("`hyperbody scenes --json` lists no scene".to_owned());
    }
    let mut wrong = Vec::new();
    for name in &names {
        let runs = [("release, 1 thread", &release, "1"), ("release, 1 thread, again", &release, "1")]
            .into_iter()
            .chain([("release, 2 threads", &release, "2"), ("debug, 1 thread", &debug, "1")])
            .chain([("debug, 2 threads", &debug, "2")]);
        let mut expected: Option<String> = None;
        for (what, program, threads) in runs {
            let hash = state_hash(program, name, threads)?;
            let first = expected.get_or_insert_with(|| hash.clone());
            if hash != *first {
                wrong.push(format!("{name}: {what} gives {hash}, the first run {first}"));
            }
        }
    }
    if wrong.is_empty() {
        println!("    {} scenes, five runs each: every hash equal", names.len());
        run(&mut cargo(&["run", "--release", "--package", "hyperbody-scene", "--example", "snapshots"]))
    } else {
        Err(format!("runs of one scene differ:\n  {}", wrong.join("\n  ")))
    }
}

fn scene_names(program: &Path) -> Outcome<Vec<String>> {
    let answer = parse(&read(Command::new(program).args(["scenes", "--json"]))?)?;
    let scenes = answer["scenes"].as_array().ok_or("`hyperbody scenes --json` has no list `scenes`")?;
    scenes.iter().map(|scene| text_of(&scene["name"], "name")).collect()
}

fn state_hash(program: &Path, scene: &str, threads: &str) -> Outcome<String> {
    let arguments = ["run", scene, "--steps", STEPS, "--threads", threads, "--json"];
    let answer = parse(&read(Command::new(program).args(arguments))?)?;
    text_of(&answer["hash"], "hash")
}

fn parse(text: &str) -> Outcome<Value> {
    serde_json::from_str(text).map_err(|error| format!("hyperbody printed no JSON: {error}"))
}

fn text_of(value: &Value, key: &str) -> Outcome<String> {
    Ok(value.as_str().ok_or_else(|| format!("hyperbody printed no text under `{key}`"))?.to_owned())
}

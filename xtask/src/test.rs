//! `cargo xtask test`: the one command that says whether the tree is sound; `.ci/run` calls it too.

use std::process::Command;
use std::time::Instant;

use clap::Args;

use crate::process::{build_example, cargo, is_ci, run as run_command, succeeds};
use crate::{Outcome, figures, hashes, pictures, playground, scenes};

#[derive(Args)]
pub(crate) struct TestArguments {
    /// Only format, lints, the tests in debug and the tour: for the minutes between two edits
    #[arg(long)]
    quick: bool,
    /// Begins with the stage whose name starts like this, such as "pictures": to go on after one that failed
    #[arg(long, value_name = "STAGE")]
    from: Option<String>,
}

/// One stage: what it is called, and what it does.
struct Stage {
    name: &'static str,
    /// The rustup component that it needs beyond a minimal toolchain.
    component: Option<&'static str>,
    /// Whether `--quick` has it.
    quick: bool,
    action: fn() -> Outcome,
}

const STAGES: [Stage; 11] = [
    Stage {
        name: "format",
        component: Some("rustfmt"),
        quick: true,
        action: || cargo_run(&["fmt", "--all", "--check"]),
    },
    Stage { name: "lints", component: Some("clippy"), quick: true, action: lints },
    Stage { name: "documentation", component: None, quick: false, action: documentation },
    Stage { name: "tests, debug", component: None, quick: true, action: || cargo_run(&["test", "--workspace"]) },
    Stage { name: "tour of examples", component: None, quick: true, action: tour },
    Stage { name: "tests, release", component: None, quick: false, action: engine_in_release },
    Stage { name: "generated files", component: None, quick: false, action: scenes::check },
    Stage { name: "pictures", component: None, quick: false, action: pictures::check },
    Stage { name: "figures", component: None, quick: false, action: figures::check },
    Stage { name: "state hashes", component: None, quick: false, action: hashes::check },
    Stage { name: "playground", component: None, quick: false, action: playground::check },
];

pub(crate) fn run(arguments: &TestArguments) -> Outcome {
    let stages: Vec<&Stage> = STAGES.iter().filter(|stage| stage.quick || !arguments.quick).collect();
    let first = match &arguments.from {
        None => 0,
        Some(from) => stages.iter().position(|stage| stage.name.starts_with(from.as_str())).ok_or_else(|| {
            let names: Vec<&str> = stages.iter().map(|stage| stage.name).collect();
            format!("no stage is called {from}; there are {}", names.join("; "))
        })?,
    };
    let start = Instant::now();
    let mut skipped = Vec::new();
    for (position, stage) in stages.iter().enumerate().skip(first) {
        println!("==> [{}/{}] {}", position + 1, stages.len(), stage.name);
        if let Some(component) = stage.component
            && !component_is_there(component)?
        {
            println!("    skipped: this toolchain has no {component}; `rustup component add {component}` installs it");
            skipped.push(stage.name);
            continue;
        }
        let stage_start = Instant::now();
        (stage.action)().map_err(|message| format!("stage \"{}\" failed: {message}", stage.name))?;
        println!("    ok, {:.1} s", stage_start.elapsed().as_secs_f64());
    }
    let seconds = start.elapsed().as_secs_f64();
    if skipped.is_empty() {
        println!("==> all {} stages passed, {seconds:.0} s", stages.len() - first);
    } else {
        println!(
            "==> {} stages passed, {seconds:.0} s; skipped: {}",
            stages.len() - first - skipped.len(),
            skipped.join(", ")
        );
    }
    Ok(())
}

fn cargo_run(arguments: &[&str]) -> Outcome {
    run_command(&mut cargo(arguments))
}

fn lints() -> Outcome {
    cargo_run(&["clippy", "--workspace", "--all-targets", "--", "--deny", "warnings"])
}

/// What optimisation could change: the crates that compute. Of the simulation, whose tests take as long to compile as all others
/// together, the stage of state hashes compares whole runs in debug and in release; the rest runs in release in the stages after
/// this one.
fn engine_in_release() -> Outcome {
    let packages = ["hyperbody-math", "hyperbody-geometry", "hyperbody-collision"];
    let arguments: Vec<&str> = packages.iter().flat_map(|package| ["--package", package]).collect();
    cargo_run(&[&["test", "--release"], arguments.as_slice()].concat())
}

fn tour() -> Outcome {
    run_command(&mut Command::new(build_example("tour")?))
}

fn documentation() -> Outcome {
    run_command(cargo(&["doc", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "--deny warnings"))
}

/// Whether the toolchain has a component; under CI a missing one is installed, and never skipped.
fn component_is_there(component: &str) -> Outcome<bool> {
    let subcommand = if component == "rustfmt" { "fmt" } else { component };
    let is_there = || succeeds(&mut cargo(&[subcommand, "--version"]));
    if is_there() {
        return Ok(true);
    }
    if !is_ci() {
        return Ok(false);
    }
    let installed = succeeds(Command::new("rustup").args(["component", "add", component]));
    if installed && is_there() {
        return Ok(true);
    }
    Err(format!("this toolchain has no {component}, and `rustup component add {component}` did not help"))
}

//! The stage "playground" of `cargo xtask test`: the engine gives the same bits in the browser's program as natively, the page
//! compiles, and its tests pass in a browser. Also `cargo xtask play --check-hashes`, for all scenes.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::Outcome;
use crate::play::{engine, npm, packages, page, web};
use crate::process::{build_hyperbody, is_ci, read, root, run as run_command, succeeds};

/// Steps after which hashes are compared.
const STEPS: &str = "300";

/// Where Chromium is looked for.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// The stage. What is missing is named and left out, and under CI installed instead.
pub(crate) fn check() -> Outcome {
    if !succeeds(Command::new("node").arg("--version")) {
        return or_skip("Node.js 20 or newer (on Debian: `apt-get install nodejs npm`)");
    }
    engine()?;
    check_hashes()?;
    packages()?;
    run_command(npm()?.args(["run", "--silent", "check"]))?;
    page()?;
    if !web().join("tests/run.mjs").is_file() {
        return Ok(());
    }
    if !has_browser() {
        if !is_ci() {
            println!("    skipped: the page's tests in a browser need Chromium; on Debian: `apt-get install chromium`");
            return Ok(());
        }
        run_command(Command::new("apt-get").args(["update", "--quiet", "--quiet"]))?;
        run_command(Command::new("apt-get").args(["install", "--yes", "--no-install-recommends", "chromium"]))?;
    }
    // The page's tests ask the program that serves it, with the page in it.
    build_hyperbody(true)?;
    run_command(npm()?.args(["test", "--silent"]))
}

/// Compares the state hashes of the browser's engine with those of the native program, for every scene of the gallery.
pub(crate) fn check_hashes() -> Outcome {
    let program = build_hyperbody(true)?;
    let script = web().join("tests/engine/hashes.mjs");
    let text = read(Command::new("node").current_dir(root()).arg(script).arg(STEPS))?;
    let hashes: Value = serde_json::from_str(&text).map_err(|error| format!("hashes.mjs printed no JSON: {error}"))?;
    let hashes = hashes.as_object().ok_or("hashes.mjs printed no object")?;
    let of_page = hashes.keys().filter(|name| is_file(name)).count();
    if of_page == 0 || of_page == hashes.len() {
        return Err("hashes.mjs has to run both the built-in scenes and those of the page".to_owned());
    }
    let mut differing = Vec::new();
    for (name, hash) in hashes {
        let line = ["run", name, "--steps", STEPS, "--json"];
        let answer: Value = serde_json::from_str(&read(Command::new(&program).current_dir(root()).args(line))?)
            .map_err(|error| format!("`hyperbody {}` printed no JSON: {error}", line.join(" ")))?;
        if &answer["hash"] != hash {
            differing.push(format!("{name} ({} in the browser's engine, {} natively)", hash, answer["hash"]));
        }
    }
    if !differing.is_empty() {
        return Err(format!("state hashes after {STEPS} steps differ: {}", differing.join(", ")));
    }
    println!(
        "    {} built-in scenes and {of_page} of the page have the same state hash in the browser's engine after {STEPS} steps",
        hashes.len() - of_page
    );
    Ok(())
}

/// Whether a scene is one of the page, which goes by its file.
fn is_file(scene: &str) -> bool {
    Path::new(scene).extension().is_some()
}

fn has_browser() -> bool {
    BROWSERS.iter().any(|name| succeeds(Command::new(name).arg("--version")))
}

/// Under CI nothing is skipped.
fn or_skip(missing: &str) -> Outcome {
    if is_ci() {
        return Err(format!("the playground's tests need {missing}"));
    }
    println!("    skipped: the playground's tests need {missing}");
    Ok(())
}

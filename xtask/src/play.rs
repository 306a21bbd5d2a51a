//! `cargo xtask play`: builds the engine for the browser, the page around it, and the program that serves both, and starts it.
//!
//! Every stage looks first whether its result is newer than what it is made from, so that a second start takes seconds.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

use clap::Args;

use crate::play_target::{self, TARGET};
use crate::process::{build_hyperbody, cargo, root, run as run_command, succeeds, target_directory};
use crate::{Outcome, playground};

#[derive(Args)]
pub(crate) struct PlayArguments {
    /// Only builds the engine for the browser, into web/src/engine/pkg, for work on the page
    #[arg(long)]
    engine_only: bool,
    /// Builds everything and starts nothing
    #[arg(long, conflicts_with = "engine_only")]
    build_only: bool,
    /// Compares the state hashes of all scenes of the gallery between the browser's engine and the native program
    #[arg(long, conflicts_with_all = ["engine_only", "build_only"])]
    check_hashes: bool,
    /// What `hyperbody play` takes: SCENE, --port, --host, --no-open, --export DIR; see `hyperbody help play`
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    play: Vec<String>,
}

pub(crate) fn run(arguments: &PlayArguments) -> Outcome {
    engine()?;
    if arguments.engine_only {
        return Ok(());
    }
    if arguments.check_hashes {
        return playground::check_hashes();
    }
    page()?;
    println!("==> the program that serves it");
    let program = build_hyperbody(true)?;
    if arguments.build_only {
        return Ok(());
    }
    run_command(Command::new(program).arg("play").args(&arguments.play))
}

/// The folder of the page.
pub(crate) fn web() -> PathBuf {
    root().join("web")
}

/// Builds the engine into web/src/engine/pkg.
pub(crate) fn engine() -> Outcome {
    println!("==> the engine for the browser");
    run_command(play_target::build()?.args(["--package", "hyperbody-wasm", "--profile", "wasm"]))?;
    let built = target_directory()?.join(TARGET).join("wasm/hyperbody_wasm.wasm");
    let package = web().join("src/engine/pkg");
    if is_newer(&package.join("hyperbody_wasm_bg.wasm"), newest(&built)) {
        return Ok(());
    }
    let bindgen = ["run", "--quiet", "--package", "xtask-bindgen", "--features", "run", "--"];
    run_command(cargo(&bindgen).arg(&built).arg(&package))
}

/// Builds the page into web/dist.
pub(crate) fn page() -> Outcome {
    println!("==> the page");
    packages()?;
    let web = web();
    let sources = ["src", "public", "index.html", "package-lock.json", "tsconfig.json", "vite.config.ts", "tools"];
    let changed = sources.iter().filter_map(|name| newest(&web.join(name))).max();
    if is_newer(&web.join("dist/index.html"), changed) {
        return Ok(());
    }
    run_command(npm()?.args(["run", "--silent", "build"]))?;
    // The build script of the program watches the page only once it has seen it.
    let script = root().join("crates/hyperbody-cli/build.rs");
    let touched = fs::File::options().append(true).open(&script).and_then(|file| file.set_modified(SystemTime::now()));
    touched.map_err(|error| format!("{}: {error}", script.display()))?;
    let (plain, sent) = weight(&web.join("dist"))?;
    println!("    {:.2} MB, {:.2} MB as it is sent", plain as f64 / 1e6, sent as f64 / 1e6);
    Ok(())
}

/// Installs the page's packages as the lock file names them, where that has not been done.
pub(crate) fn packages() -> Outcome {
    let web = web();
    if is_newer(&web.join("node_modules/.package-lock.json"), newest(&web.join("package-lock.json"))) {
        return Ok(());
    }
    run_command(npm()?.args(["ci", "--no-audit", "--no-fund"]))
}

/// `npm` in the folder of the page, with a Node.js that the page's tools run on.
pub(crate) fn npm() -> Outcome<Command> {
    let name = if cfg!(windows) { "npm.cmd" } else { "npm" };
    let needed = node_needed()?;
    let get = "https://nodejs.org has it, and on Debian 13 or later `apt-get install nodejs npm`";
    if !succeeds(Command::new(name).arg("--version")) {
        return Err(format!("the page is built with Node.js {needed} or newer and its npm, which are not here; {get}"));
    }
    let found = Command::new("node").arg("--version").output().ok();
    let found = found.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned()).unwrap_or_default();
    if version(&found) < version(&needed) {
        return Err(format!("the page is built with Node.js {needed} or newer; here is {found}; {get}"));
    }
    let mut command = Command::new(name);
    command.current_dir(web());
    Ok(command)
}

/// The oldest Node.js that the page's package.json allows, such as "20.19".
fn node_needed() -> Outcome<String> {
    let path = web().join("package.json");
    let broken = |why: String| format!("{}: {why}", path.display());
    let text = fs::read_to_string(&path).map_err(|error| broken(error.to_string()))?;
    let package: serde_json::Value = serde_json::from_str(&text).map_err(|error| broken(error.to_string()))?;
    let engines = package["engines"]["node"].as_str().and_then(|range| range.strip_prefix(">="));
    engines.map(str::to_owned).ok_or_else(|| broken("engines.node is not a text like \">=20.19\"".to_owned()))
}

/// The numbers of a version, such as "v20.20.2"; what is no number counts as 0.
fn version(text: &str) -> Vec<u32> {
    text.trim_start_matches('v').split('.').map(|part| part.parse().unwrap_or(0)).collect()
}

/// Bytes of all files of a folder, and of what is sent of them: the page's build puts what brotli makes of a file beside it.
fn weight(folder: &Path) -> Outcome<(u64, u64)> {
    let broken = |error: std::io::Error| format!("{}: {error}", folder.display());
    let (mut plain, mut sent) = (0, 0);
    for entry in fs::read_dir(folder).map_err(broken)? {
        let path = entry.map_err(broken)?.path();
        if path.is_dir() {
            let (more_plain, more_sent) = weight(&path)?;
            plain += more_plain;
            sent += more_sent;
        } else if path.extension().is_none_or(|extension| extension != "br") {
            let size = fs::metadata(&path).map_err(broken)?.len();
            let packed = PathBuf::from(format!("{}.br", path.display()));
            plain += size;
            sent += fs::metadata(packed).map_or(size, |data| data.len());
        }
    }
    Ok((plain, sent))
}

/// When a file, or the newest file of a folder, was changed; `None` if there is none.
fn newest(path: &Path) -> Option<SystemTime> {
    if !path.is_dir() {
        return fs::metadata(path).and_then(|data| data.modified()).ok();
    }
    let entries = fs::read_dir(path).ok()?.flatten();
    entries.filter_map(|entry| newest(&entry.path())).max()
}

/// Whether a result is there and not older than what it is made from.
fn is_newer(result: &Path, made_from: Option<SystemTime>) -> bool {
    newest(result).is_some_and(|made| made_from.is_some_and(|changed| made >= changed))
}

#[cfg(test)]
mod tests {
    use super::{node_needed, version};

    #[test]
    fn versions_are_compared_by_their_numbers() {
        assert!(version("v20.20.2") >= version("20.19"));
        assert!(version("v20.19.0") >= version("20.19"));
        assert!(version("v100.0.0") >= version("20.19"), "by numbers, not by letters");
        assert!(version("v18.19.0") < version("20.19"));
        assert!(version("v20.9.0") < version("20.19"));
        assert!(version("") < version("20.19"));
        assert!(node_needed().is_ok_and(|needed| version(&needed) > version("20")), "package.json names a version");
    }
}

//! Starting cargo and its kin from the workspace root.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Outcome;

/// The root of the workspace.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask lies one level below the workspace root")
}

/// `cargo` with the given arguments, in the workspace root.
pub(crate) fn cargo(arguments: &[&str]) -> Command {
    // Cargo tells its children which cargo they run under.
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root()).args(arguments);
    if is_ci() {
        // Nobody edits or debugs what is built once and thrown away.
        command.env("CARGO_INCREMENTAL", "0");
        for profile in ["DEV", "TEST", "RELEASE"] {
            command.env(format!("CARGO_PROFILE_{profile}_DEBUG"), "0");
        }
    }
    command
}

/// Whether a machine asks, for which nothing may be skipped.
pub(crate) fn is_ci() -> bool {
    std::env::var_os("CI").is_some_and(|value| value == "true")
}

/// Runs a command, its output going to the terminal.
pub(crate) fn run(command: &mut Command) -> Outcome {
    let line = line_of(command);
    let status = command.status().map_err(|error| format!("cannot start `{line}`: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("`{line}` ended with {status}")) }
}

/// Runs a command and returns what it printed on standard output; its standard error goes to the terminal.
pub(crate) fn read(command: &mut Command) -> Outcome<String> {
    let line = line_of(command);
    command.stderr(std::process::Stdio::inherit());
    let output = command.output().map_err(|error| format!("cannot start `{line}`: {error}"))?;
    if !output.status.success() {
        return Err(format!("`{line}` ended with {}", output.status));
    }
    String::from_utf8(output.stdout).map_err(|_| format!("`{line}` printed something that is not UTF-8"))
}

/// Whether a command starts and succeeds; prints nothing.
pub(crate) fn succeeds(command: &mut Command) -> bool {
    command.output().is_ok_and(|output| output.status.success())
}

/// The folder that cargo builds into.
pub(crate) fn target_directory() -> Outcome<PathBuf> {
    let text = read(&mut cargo(&["metadata", "--no-deps", "--format-version", "1"]))?;
    let metadata: serde_json::Value =
        serde_json::from_str(&text).map_err(|error| format!("cargo metadata printed no JSON: {error}"))?;
    let directory = metadata["target_directory"].as_str().ok_or("cargo metadata names no target_directory")?;
    Ok(directory.into())
}

/// Builds the program `hyperbody` and returns its path.
pub(crate) fn build_hyperbody(release: bool) -> Outcome<PathBuf> {
    build(&["--bin", "hyperbody"], release)
}

/// Builds an example as the tests in debug have it, and returns its path.
pub(crate) fn build_example(name: &str) -> Outcome<PathBuf> {
    build(&["--example", name], false)
}

/// Out of the whole workspace, as the tests are: chosen by its package alone, a program's dependencies would have fewer features,
/// and everything would be built a second time.
fn build([kind, name]: &[&str; 2], release: bool) -> Outcome<PathBuf> {
    let mut arguments = vec!["build", "--quiet", "--workspace", kind, name];
    if release {
        arguments.push("--release");
    }
    run(&mut cargo(&arguments))?;
    let mut path = target_directory()?.join(if release { "release" } else { "debug" });
    if *kind == "--example" {
        path.push("examples");
    }
    Ok(path.join(format!("{name}{}", std::env::consts::EXE_SUFFIX)))
}

fn line_of(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}

//! How the engine is compiled for the browser: by the toolchain at hand where it has, or rustup gets, the standard library for it;
//! otherwise by Debian's, with the library built from the source that Debian packs.

use std::path::Path;
use std::process::Command;
use std::{env, fs};

use crate::Outcome;
use crate::process::{cargo, root, run as run_command, succeeds};

/// What the engine is built for.
pub(crate) const TARGET: &str = "wasm32-unknown-unknown";

/// What Debian calls its newest compiler, the one that browsers are built with, and the linker that it lacks.
const DEBIAN_PACKAGES: [&str; 4] = ["rustc-web", "cargo-web", "rust-web-src", "lld"];

/// Where those packages put what is needed.
const DEBIAN_FILES: [&str; 4] =
    ["/usr/bin/rustc", "/usr/bin/cargo", "/usr/lib/rustlib/src/rust/library/Cargo.toml", "/usr/bin/wasm-ld"];

/// Variables by which the cargo that started this program would lead another one astray.
const OWN_VARIABLES: [&str; 5] = ["RUSTC", "RUSTDOC", "CARGO", "RUSTUP_TOOLCHAIN", "RUSTC_WRAPPER"];

/// `cargo build` for the browser, without what is to be built; gets the standard library where it is missing, and says so.
pub(crate) fn build() -> Outcome<Command> {
    if has_library() {
        return Ok(own());
    }
    println!("    this toolchain has no standard library for {TARGET}; `rustup target add {TARGET}` gets it");
    let added = Command::new("rustup").current_dir(root()).args(["target", "add", TARGET]).status();
    if added.is_ok_and(|status| status.success()) && has_library() {
        return Ok(own());
    }
    println!("    rustup could not get it; Debian's packages {} do as well", DEBIAN_PACKAGES.join(", "));
    if !has_debian() {
        install()?;
    }
    Ok(debian())
}

fn own() -> Command {
    cargo(&["build", "--target", TARGET])
}

/// Debian's cargo, which builds the standard library too. What asks for that is meant for nightly compilers.
fn debian() -> Command {
    let [rustc, cargo, _, linker] = DEBIAN_FILES;
    let mut command = Command::new(cargo);
    for name in OWN_VARIABLES {
        command.env_remove(name);
    }
    command.current_dir(root()).env("RUSTC", rustc).env("RUSTC_BOOTSTRAP", "1");
    command.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker);
    command.args(["build", "-Z", "build-std=std,panic_abort", "--target", TARGET]);
    command
}

fn has_debian() -> bool {
    DEBIAN_FILES.iter().all(|file| Path::new(file).exists())
}

/// Installs Debian's packages where this program may; otherwise says how.
fn install() -> Outcome {
    let packages = DEBIAN_PACKAGES.join(" ");
    let by_hand = format!(
        "there is no standard library for {TARGET}, and rustup could not get it. On Debian, install what builds it from \
         its source and start again: `apt-get install {packages}`"
    );
    if !succeeds(Command::new("id").arg("-u")) || !is_root() || !succeeds(Command::new("apt-get").arg("--version")) {
        return Err(by_hand);
    }
    run_command(Command::new("apt-get").args(["update", "--quiet", "--quiet"]))?;
    let install = ["install", "--yes", "--no-install-recommends"];
    run_command(Command::new("apt-get").args(install).args(DEBIAN_PACKAGES))?;
    if has_debian() {
        Ok(())
    } else {
        Err(format!("{by_hand}; they are installed, but {} are not all there", DEBIAN_FILES.join(", ")))
    }
}

fn is_root() -> bool {
    let output = Command::new("id").arg("-u").output();
    output.is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}

/// Whether the toolchain at hand has the standard library for the browser.
fn has_library() -> bool {
    let mut rustc = Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
    let output = rustc.current_dir(root()).args(["--print", "target-libdir", "--target", TARGET]).output();
    let text = output.ok().and_then(|output| String::from_utf8(output.stdout).ok());
    text.is_some_and(|folder| fs::read_dir(folder.trim()).is_ok_and(|mut files| files.next().is_some()))
}

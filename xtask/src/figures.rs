//! `cargo xtask figures`: the figures of docs/free-rotation.md, made by the program itself.

use std::path::Path;
use std::process::Command;

use clap::Args;

use crate::Outcome;
use crate::process::{build_hyperbody, read, root, target_directory};

const FOLDER: &str = "docs/free-rotation";

/// File names, and what `hyperbody spin` draws into them. Maps are PNG, since as SVG they take a megabyte.
const FIGURES: [(&str, &str); 11] = [
    (
        "wing-nut.svg",
        "--inertia xy=3.2,xz=2.5,yz=1.7 --spin xy=0.02,zx=1,yz=0.02 --seconds 150 --method splitting6 --samples 1000 \
         --show spins",
    ),
    (
        "wing-nut-path.svg",
        "--inertia xy=3.2,xz=2.5,yz=1.7 --spin xy=0.02,zx=1,yz=0.02 --seconds 66.4 --method splitting6 --samples 1000 \
         --show path",
    ),
    ("map-outer-inner.png", "--moments 4,3,2,1 --map xw,yz --cells 400"),
    ("map-alternating.png", "--moments 4,3,2,1 --map xz,yw --cells 400"),
    ("map-moments.png", "--moments 4,3,2,1 --map y,z --spin xw=1,yz=0.9 --range 0.02,5.5 --cells 400"),
    ("tumble.svg", "--moments 4,3,2,1 --spin xz=1 --disturb 0.001 --seconds 250 --samples 1000 --show spins"),
    (
        "double-tumble.svg",
        "--moments 4,3,2,1 --spin xz=1,yw=0.3 --disturb 0.001 --seconds 300 --samples 1000 --show spins",
    ),
    ("irregular.svg", "--moments 4,3,2,1 --spin xw=1 --disturb 0.001 --seconds 250 --samples 1000 --show spins"),
    ("irregular-path.svg", "--moments 4,3,2,1 --spin xw=1 --disturb 0.001 --seconds 600 --samples 6000 --show path"),
    (
        "below-threshold.svg",
        "--moments 4,3,2,1 --spin xw=1,yz=0.9 --disturb 0.001 --seconds 300 --samples 1000 --show spins",
    ),
    (
        "drift.svg",
        "--moments 4,3,2,1 --spin xz=1 --disturb 0.01 --dt 0.016666666666666666 --method splitting2 \
         --compare splitting4,splitting6,midpoint,gyroscopic,explicit --samples 500 --show drift",
    ),
];

#[derive(Args)]
pub(crate) struct FiguresArguments {
    /// Only says whether the figures are up to date
    #[arg(long)]
    check: bool,
}

pub(crate) fn run(arguments: &FiguresArguments) -> Outcome {
    if arguments.check { check() } else { draw_all(&root().join(FOLDER)) }
}

/// Whether the figures are what would be drawn now, to the byte. SVG has the same bytes on every machine; what turns it into
/// PNG promises that for one kind of processor only, and the figures were drawn on the most common.
pub(crate) fn check() -> Outcome {
    let fresh = target_directory()?.join("figures");
    draw_all(&fresh)?;
    let comparable = |name: &str| name.ends_with(".svg") || cfg!(target_arch = "x86_64");
    for (name, _) in FIGURES.into_iter().filter(|(name, _)| comparable(name)) {
        let contents = |folder: &Path| std::fs::read(folder.join(name)).unwrap_or_default();
        if contents(&fresh) != contents(&root().join(FOLDER)) {
            return Err(format!("{FOLDER}/{name} is out of date; `cargo xtask figures` draws it"));
        }
    }
    Ok(())
}

fn draw_all(folder: &Path) -> Outcome {
    let program = build_hyperbody(true)?;
    std::fs::create_dir_all(folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    for (name, arguments) in FIGURES {
        println!("hyperbody spin {arguments} --plot {name}");
        let mut command = Command::new(&program);
        read(command.arg("spin").args(arguments.split_whitespace()).arg("--plot").arg(folder.join(name)))?;
    }
    Ok(())
}

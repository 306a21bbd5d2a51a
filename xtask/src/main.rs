//! The chores of this workspace in Rust, so that they run wherever the project builds: `cargo xtask --help`.

mod bench;
mod compare;
mod figures;
mod hashes;
mod instructions;
mod pictures;
mod play;
mod play_target;
mod playground;
mod process;
mod scenes;
mod test;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// What a chore ends with; the message is for a person.
type Outcome<T = ()> = Result<T, String>;

/// Chores of the Hyperbody workspace.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", disable_help_subcommand = true)]
struct Arguments {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Checks everything: format, lints, documentation, tests in debug and in release, and that every build, thread
    /// count and repetition gives the same bits on the built-in scenes
    Test(test::TestArguments),
    /// Times the built-in scenes (or others) and saves the figures under target/bench, with machine and commit
    Bench(bench::BenchArguments),
    /// Counts the instructions of a step of a few scenes, under valgrind: the same on a busy machine
    Instructions(instructions::InstructionsArguments),
    /// Runs a comparison with other engines against this one
    Compare(compare::CompareArguments),
    /// Builds the playground (engine, page, program) and starts it
    Play(play::PlayArguments),
    /// Draws the pictures of the README and of the gallery page from the built-in scenes
    Pictures(pictures::PicturesArguments),
    /// Writes the files that are generated from the built-in scenes
    Scenes(scenes::ScenesArguments),
    /// Draws the figures of docs/free-rotation.md
    Figures(figures::FiguresArguments),
}

fn main() -> ExitCode {
    let result = match Arguments::parse().chore {
        Chore::Test(arguments) => test::run(&arguments),
        Chore::Bench(arguments) => bench::run(&arguments),
        Chore::Instructions(arguments) => instructions::run(&arguments),
        Chore::Compare(arguments) => compare::run(&arguments),
        Chore::Play(arguments) => play::run(&arguments),
        Chore::Pictures(arguments) => pictures::run(&arguments),
        Chore::Scenes(arguments) => scenes::run(&arguments),
        Chore::Figures(arguments) => figures::run(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

//! The program `hyperbody`: scenes of two to six dimensions from the command line.
//!
//! Results go to standard output, everything else to standard error. Exit status: 0 on success, 1 if a run failed, 2 for
//! bad arguments or bad input.

mod arguments;
mod bench;
mod failure;
mod files;
mod inspect;
mod numbers;
mod output;
mod play;
mod progress;
mod render;
mod run;
mod scenes;
mod slice;
mod source;
mod spin;
mod step_times;
mod stop;

use std::process::ExitCode;

use clap::Parser;

use arguments::{Arguments, Command};

fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Play(arguments) => play::play(&arguments),
        Command::Run(arguments) => run::run(&arguments),
        Command::Render(arguments) => render::render(&arguments),
        Command::Inspect(arguments) => inspect::inspect(&arguments),
        Command::Bench(arguments) => bench::bench(&arguments),
        Command::Scenes(arguments) => scenes::scenes(&arguments),
        Command::Slice(arguments) => slice::slice(&arguments),
        Command::Spin(arguments) => spin::spin(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

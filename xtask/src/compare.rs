//! `cargo xtask compare`: this engine beside others, on the same bodies in one run.

use std::path::PathBuf;
use std::process::Command;

use clap::Args;

use crate::Outcome;
use crate::process::{build_hyperbody, root, run as run_command};

#[derive(Args)]
pub(crate) struct CompareArguments {
    /// The program of the comparison, in Python: it builds the other engines, runs all on the same scenes, and takes
    /// `--hyperbody` with the path of this engine's program
    #[arg(value_name = "COMPARE.PY")]
    program: PathBuf,
    /// What to hand on to it, such as `--scene box_pile1000 --rounds 3 --threads 1`
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<String>,
}

pub(crate) fn run(arguments: &CompareArguments) -> Outcome {
    if !arguments.program.is_file() {
        return Err(format!(
            "there is no file {}; give the path of the comparison's program",
            arguments.program.display()
        ));
    }
    let program = arguments.program.canonicalize().map_err(|error| error.to_string())?;
    let hyperbody = build_hyperbody(true)?;
    let mut command = Command::new("python3");
    command.current_dir(root()).arg(program).arg("--hyperbody").arg(hyperbody).args(&arguments.arguments);
    run_command(&mut command)
}

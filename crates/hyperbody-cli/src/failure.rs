//! How a command ends when it does not succeed.

use std::io;
use std::process::ExitCode;

use hyperbody_scene::SceneError;

/// Why a command did not succeed.
#[derive(Debug)]
pub(crate) enum Failure {
    /// Bad arguments or bad input: exit status 2.
    Input(String),
    /// The work itself failed: exit status 1.
    Work(String),
    /// The reader of standard output went away, as `head` does: nothing is wrong.
    OutputClosed,
}

impl Failure {
    /// Says it in one line on standard error, and gives the exit status.
    pub(crate) fn report(&self) -> ExitCode {
        match self {
            Self::Input(message) => {
                eprintln!("error: {message}");
                ExitCode::from(2)
            }
            Self::Work(message) => {
                eprintln!("error: {message}");
                ExitCode::FAILURE
            }
            Self::OutputClosed => ExitCode::SUCCESS,
        }
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::OutputClosed,
            _ => Self::Work(format!("cannot write the results: {error}")),
        }
    }
}

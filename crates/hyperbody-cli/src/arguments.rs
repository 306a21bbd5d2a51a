//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use crate::numbers::{seconds, whole};
use crate::play::PlayArguments;
use crate::render::arguments::RenderArguments;
use crate::slice::SliceArguments;
use crate::spin::SpinArguments;

/// Most steps of a run: two days of simulated time at 60 steps a second, whose step times still fit into memory.
pub(crate) const MAX_STEPS: u32 = 10_000_000;

/// Rigid-body physics in two to six dimensions.
#[derive(Debug, Parser)]
#[command(
    name = "hyperbody",
    version,
    after_help = "Start with:\n  \
        hyperbody play                       the fourth dimension in a browser, to take into the hand\n  \
        hyperbody scenes                     what there is to see\n  \
        hyperbody run stack4d                ten tesseracts on each other, for ten seconds\n  \
        hyperbody render dice4d -o dice.png  a picture of it\n  \
        hyperbody scenes --write my-scenes   the built-in scenes as files, to change and run\n\n\
        `hyperbody help COMMAND` explains a command. SCENE is always a file or the name of a built-in scene."
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Serves the playground on this machine and opens it in a browser
    Play(PlayArguments),
    /// Simulates a scene and says where everything ended up
    Run(RunArguments),
    /// Draws a scene or a recording: a slice of it as a picture, a film or a sheet of pictures
    Render(Box<RenderArguments>),
    /// Says what is in a scene, a recording or a shape: mass properties, face counts
    Inspect(InspectArguments),
    /// Times scenes: median, 95th percentile and maximum per step
    Bench(BenchArguments),
    /// Writes the 3D section of a shape of 4 to 6 dimensions as .stl, .obj, .off or .glb
    Slice(SliceArguments),
    /// Lists the built-in scenes, or writes them as files
    Scenes(ScenesArguments),
    /// The free-rotation laboratory: how a free body tumbles, and whether its rotation is stable
    Spin(Box<SpinArguments>),
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    hyperbody run dice4d                        ten seconds of four-dimensional dice\n  \
    hyperbody run my-scene.json --steps 600     a scene from a file\n  \
    hyperbody run balls6d --threads 2 --json    everything as one JSON object\n  \
    hyperbody run pit4d --record pit.hbrec      a recording, for `hyperbody render pit.hbrec -o pit.gif`\n\n\
    The same scene gives the same bits, and so the same hash, for every number of threads and on every machine.")]
pub(crate) struct RunArguments {
    /// A scene file or the name of a built-in scene
    pub(crate) scene: String,
    /// How long to simulate, in simulated seconds [default: 10]
    #[arg(long, value_name = "S", value_parser = seconds, conflicts_with = "steps", allow_hyphen_values = true)]
    pub(crate) seconds: Option<f64>,
    /// How many steps to simulate, instead of --seconds
    #[arg(long, value_name = "K", value_parser = whole::<u32>(0..=i64::from(MAX_STEPS)), allow_negative_numbers = true)]
    pub(crate) steps: Option<u32>,
    /// Threads to compute on; changes the time only, never the result
    #[arg(long, value_name = "T", default_value_t = 1, value_parser = whole::<u16>(1..=256), allow_negative_numbers = true)]
    pub(crate) threads: u16,
    /// Start every dynamic body up to 0.1 mm off its place, chosen by this number: the same scene with another
    /// history. Without it nothing is random
    #[arg(long, value_name = "SEED")]
    pub(crate) seed: Option<u64>,
    /// Write a recording: the scene, and where every body is at every step, to the bit. `hyperbody render` makes pictures
    /// and films of it without simulating again
    #[arg(long, value_name = "FILE")]
    pub(crate) record: Option<PathBuf>,
    /// Record every K-th step only; the first and the last are always recorded
    #[arg(long, value_name = "K", default_value_t = 1, requires = "record", value_parser = whole::<u32>(1..=i64::from(MAX_STEPS)), allow_negative_numbers = true)]
    pub(crate) record_every: u32,
    /// Print one JSON object and nothing else
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    hyperbody inspect stack4d                            a built-in scene\n  \
    hyperbody inspect pit.hbrec                          a recording, checked to the last byte\n  \
    hyperbody inspect 24-cell                            a regular polytope; also \"{5/2,5}\" or \"great icosahedron\"\n  \
    hyperbody inspect crystal.off                        a polytope from an OFF file\n  \
    echo '{\"box\": {\"half_extents\": [1, 2, 3, 4]}}' > box.json && hyperbody inspect box.json\n\n\
    A shape file holds what stands under \"shape\" in a scene.")]
pub(crate) struct InspectArguments {
    /// A scene (file or built-in name), a recording, or a shape: an OFF file, the shape of a scene as .json, or the name of a
    /// regular polytope of circumradius 1
    pub(crate) file: String,
    /// Dimension of a shape that does not tell, such as a ball
    #[arg(long, value_name = "N", value_parser = whole::<u8>(2..=6), allow_negative_numbers = true)]
    pub(crate) dimension: Option<u8>,
    /// Print one JSON object and nothing else
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    hyperbody bench stack4d pit4d                       two scenes\n  \
    hyperbody bench pile.json --steps 600 --warmup 300  the last 300 of 600 steps, when the pile has settled\n\n\
    Times depend on the machine and on what else it does; the hash does not.")]
pub(crate) struct BenchArguments {
    /// Scene files or names of built-in scenes; all built-in scenes if none is given
    pub(crate) scenes: Vec<String>,
    /// Steps to run
    #[arg(long, value_name = "K", default_value_t = 600, value_parser = whole::<u32>(1..=i64::from(MAX_STEPS)), allow_negative_numbers = true)]
    pub(crate) steps: u32,
    /// How many of these steps, the first ones, to leave out of the figures [default: a fifth of the steps]
    #[arg(long, value_name = "K")]
    pub(crate) warmup: Option<u32>,
    /// Threads to compute on
    #[arg(long, value_name = "T", default_value_t = 1, value_parser = whole::<u16>(1..=256), allow_negative_numbers = true)]
    pub(crate) threads: u16,
    /// Keep bodies awake even where the scene lets them sleep, so that resting bodies cost what they can cost
    #[arg(long)]
    pub(crate) awake: bool,
    /// Print one JSON object and nothing else
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    hyperbody scenes                     a list with what to see\n  \
    hyperbody scenes --write my-scenes   writes my-scenes/stack4d.json and so on")]
pub(crate) struct ScenesArguments {
    /// Write every built-in scene as a file into this folder, which is made if it is not there
    #[arg(long, value_name = "DIR")]
    pub(crate) write: Option<PathBuf>,
    /// Overwrite files that are there already and have been changed
    #[arg(long, requires = "write")]
    pub(crate) force: bool,
    /// Print one JSON object and nothing else
    #[arg(long)]
    pub(crate) json: bool,
}

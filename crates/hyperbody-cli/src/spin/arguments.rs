//! The command line of `hyperbody spin`.

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use crate::numbers::whole;

#[derive(Args, Debug)]
#[command(
    group = ArgGroup::new("body").required(true).args(["moments", "inertia", "shape"]),
    after_help = "Examples:\n  \
    hyperbody spin --moments 4,3,2,1 --spin xz=1 --disturb 0.001 --plot tumble.svg\n      \
        a four-dimensional body spun in an unstable plane, with pictures\n  \
    hyperbody spin --moments 4,3,2,1 --spin xw=1,yz=0.95 --json\n      \
        a double rotation just below the threshold of stability\n  \
    hyperbody spin --inertia xy=3.2,xz=2.5,yz=1.7 --spin xy=0.02,xz=-1,yz=0.02 --seconds 300\n      \
        the wing nut of three dimensions, beside its exact period\n  \
    hyperbody spin --shape brick.json --spin xy=2 --method midpoint --compare splitting2,gyroscopic\n      \
        the same run by three methods; brick.json holds {\"box\":{\"half_extents\":[1,4,2,3]}}\n  \
    hyperbody spin --moments 4,3,2,1 --map xw,yz --plot map.png\n      \
        which double rotations are stable, measured, with the exact boundary\n\n\
    Axes are called x y z w v u and are principal axes of the body; a plane is two of them. Positive spin in plane xy \
    turns x towards y. Moments are second moments J_i, the integral of density times the square of coordinate i, so \
    that plane xy has the moment of inertia J_x + J_y.\n\n\
    Measured growth is read off a second run, of the steady rotation disturbed by 1e-10, until it is off by 1e-4; where it \
    never is, the report says below what rate growth would not have shown. Drifts are relative: of energy and |L|² to \
    themselves, of L in the world to |L|, of the Pfaffian to |L|²/2, the most it can be, and of each of Manakov's integrals \
    to the sum of the sizes of its terms at the start, or to the mean of those sums if that is more.\n\n\
    docs/free-rotation.md tells the whole story."
)]
pub(crate) struct SpinArguments {
    /// Second moments of the body, one for each axis, which also says how many dimensions there are
    #[arg(long, value_name = "J1,J2,…", allow_hyphen_values = true)]
    pub(super) moments: Option<String>,
    /// Moments of inertia instead, one for each plane, as tables for three dimensions list them (xy is the one about z)
    #[arg(long, value_name = "xy=I,…", allow_hyphen_values = true)]
    pub(super) inertia: Option<String>,
    /// A body by its shape: an OFF file, the shape of a scene as .json, or a regular polytope such as 24-cell. Its
    /// principal axes become x, y, …, the one of the largest second moment first
    #[arg(long, value_name = "SHAPE")]
    pub(super) shape: Option<String>,
    /// Dimension of a shape that does not tell, such as a ball or a cube
    #[arg(long, value_name = "N", value_parser = whole::<u8>(2..=6), allow_negative_numbers = true)]
    pub(super) dimension: Option<u8>,
    /// Spin at the start, plane by plane, in rad/s; planes that are not named do not turn
    #[arg(long, value_name = "xy=1,…", allow_hyphen_values = true, required_unless_present = "map")]
    pub(super) spin: Option<String>,
    /// Adds this fraction of the spin to every plane that does not turn: a push without which a steady spin stays steady
    #[arg(long, value_name = "FRACTION", default_value_t = 0.0, allow_hyphen_values = true)]
    pub(super) disturb: f64,
    /// How long to follow the body
    #[arg(long, value_name = "S", default_value_t = 60.0, allow_hyphen_values = true)]
    pub(super) seconds: f64,
    /// Time step in seconds [default: 1/240]
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub(super) dt: Option<f64>,
    /// How to follow it: splitting2, splitting4, splitting6, midpoint, gyroscopic, explicit, or exact where there is a
    /// closed form
    #[arg(long, value_name = "NAME", default_value = "splitting4")]
    pub(super) method: String,
    /// Divide steps until halving them once more changes attitude and momentum by no more than this
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub(super) tolerance: Option<f64>,
    /// Also run these methods, and set their drift beside
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(super) compare: Vec<String>,
    /// About how many moments of the run to keep for series and pictures; drift and flips see every step
    #[arg(long, value_name = "K", default_value_t = 2000, value_parser = whole::<u32>(1..=100_000), allow_negative_numbers = true)]
    pub(super) samples: u32,
    /// Draw a picture into this file, .svg or .png
    #[arg(long, value_name = "FILE")]
    pub(super) plot: Option<PathBuf>,
    /// What the picture of a run shows: spins against time, drift of what is conserved, the path of the momentum
    #[arg(long, value_name = "PANELS", value_delimiter = ',', requires = "plot", default_value = "spins,drift,path")]
    pub(super) show: Vec<super::picture::Panel>,
    /// Write every number of the run (or of the map) into this file, .csv
    #[arg(long, value_name = "FILE")]
    pub(super) csv: Option<PathBuf>,
    /// A map of stability instead of a run: over the spins in two planes (xw,yz), or over the second moments of two axes
    /// (y,z) at the given --spin
    #[arg(
        long,
        value_name = "AXES",
        conflicts_with_all = ["disturb", "seconds", "dt", "method", "tolerance", "compare", "samples", "show"]
    )]
    pub(super) map: Option<String>,
    /// Range of a map, FROM,TO for both sides or X1,X2,Y1,Y2 [default: spins from -1.5 to 1.5, moments up to 1.25 times the
    /// largest]
    #[arg(long, value_name = "FROM,TO", requires = "map", allow_hyphen_values = true)]
    pub(super) range: Option<String>,
    /// Cells along each side of a map
    #[arg(long, value_name = "K", requires = "map", default_value_t = 200, value_parser = whole::<u16>(2..=2000), allow_negative_numbers = true)]
    pub(super) cells: u16,
    /// Print one JSON object and nothing else
    #[arg(long)]
    pub(super) json: bool,
}

//! The arguments of `hyperbody render`, and what their texts mean.

use std::path::PathBuf;

use clap::Args;
use hyperbody::math::planes::AXIS_NAMES;
use hyperbody_render::picture::MAX_SIDE;

use crate::arguments::seconds;

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    hyperbody render dice4d -o dice.png                      three seconds into the scene, cut at w = 0\n  \
    hyperbody render dice4d -o dice.png --at 1 --slice w=0.5 another moment, another slice\n  \
    hyperbody render pit4d -o turned.png --turn xw=30        a slice turned by 30° from x towards w\n  \
    hyperbody render pyramid3d -o front.png --camera 0,10    seen from the front, 10° from above\n  \
    hyperbody render dice4d -o dice.gif --at 0 --seconds 3 --width 480 --height 270\n  \
    hyperbody render pit4d -o through.gif --at 3 --seconds 4 --slice w=-2 --slice-to w=2\n\n\
    In four and more dimensions a picture shows a three-dimensional slice. Bodies beside it appear as glass, blue on the \
    positive side of w and orange on the negative; the strip on the right shows where every body is along w, and the slice \
    as a line.")]
pub(crate) struct RenderArguments {
    /// A scene file or the name of a built-in scene
    pub(crate) scene: String,
    /// Where to: a .png file for a picture, .gif or .apng for a film
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// The moment to show, in simulated seconds
    #[arg(long, value_name = "S", default_value_t = 3.0, value_parser = seconds, allow_hyphen_values = true)]
    pub(crate) at: f64,
    /// Length of a film that begins at that moment, in simulated seconds
    #[arg(long, value_name = "S", default_value_t = 4.0, value_parser = seconds, allow_hyphen_values = true)]
    pub(crate) seconds: f64,
    /// Pictures per second of a film
    #[arg(long, value_name = "N", default_value_t = 25, value_parser = clap::value_parser!(u16).range(1..=50))]
    pub(crate) frame_rate: u16,
    /// Pixels across
    #[arg(long, value_name = "PIXELS", default_value_t = 1280, value_parser = clap::value_parser!(u32).range(16..=i64::from(MAX_SIDE)))]
    pub(crate) width: u32,
    /// Pixels down
    #[arg(long, value_name = "PIXELS", default_value_t = 720, value_parser = clap::value_parser!(u32).range(16..=i64::from(MAX_SIDE)))]
    pub(crate) height: u32,
    /// A point that the slice goes through, by axes, in metres; axes left out are 0
    #[arg(long, value_name = "w=0.5,…", value_parser = assignments, allow_hyphen_values = true)]
    pub(crate) slice: Option<Assignments>,
    /// Where the slice is at the end of a film; it goes there evenly
    #[arg(long, value_name = "w=1,…", value_parser = assignments, allow_hyphen_values = true)]
    pub(crate) slice_to: Option<Assignments>,
    /// Turns of the slice by planes, in degrees, one after the other
    #[arg(long, value_name = "xw=30,…", value_parser = assignments, allow_hyphen_values = true)]
    pub(crate) turn: Option<Assignments>,
    /// Where the eye is: degrees around the vertical, degrees above the horizon, and if wanted the distance in metres
    #[arg(long, value_name = "AROUND,ABOVE[,DISTANCE]", value_parser = numbers, allow_hyphen_values = true)]
    pub(crate) camera: Option<Numbers>,
    /// What is in the middle of the picture, in coordinates of the slice
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers, allow_hyphen_values = true)]
    pub(crate) look_at: Option<Numbers>,
    /// Angle from the lower to the upper edge, in degrees
    #[arg(long, value_name = "DEGREES", value_parser = angle_of_view)]
    pub(crate) field_of_view: Option<f64>,
    /// Rays of light per pixel: 1 for a draft, 16 for print
    #[arg(long, value_name = "RAYS", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub(crate) quality: u32,
    /// Leave out the bodies beside the slice
    #[arg(long)]
    pub(crate) no_ghosts: bool,
    /// Leave out the strip that shows where bodies are along the hidden axes
    #[arg(long)]
    pub(crate) no_strip: bool,
    /// Leave out the caption
    #[arg(long)]
    pub(crate) no_caption: bool,
    /// Threads to draw on [default: one per core]; changes the time only, never the picture
    #[arg(long, value_name = "T", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
}

/// Names with numbers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Assignments(pub(crate) Vec<(String, f64)>);

/// Numbers with commas between them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Numbers(pub(crate) Vec<f64>);

fn finite(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("\"{text}\" is not a finite number")),
    }
}

fn assignments(text: &str) -> Result<Assignments, String> {
    let parse = |part: &str| {
        let (name, value) = part.split_once('=').ok_or_else(|| format!("\"{part}\" is not of the form NAME=NUMBER"))?;
        Ok((name.trim().to_owned(), finite(value)?))
    };
    text.split(',').map(parse).collect::<Result<_, String>>().map(Assignments)
}

fn numbers(text: &str) -> Result<Numbers, String> {
    text.split(',').map(finite).collect::<Result<_, _>>().map(Numbers)
}

fn angle_of_view(text: &str) -> Result<f64, String> {
    let degrees = finite(text)?;
    if (1.0..=150.0).contains(&degrees) {
        Ok(degrees)
    } else {
        Err(format!("{degrees}° is not between 1° and 150°"))
    }
}

/// The number of an axis by its name, among `dimension` axes.
pub(crate) fn axis(name: &str, dimension: usize) -> Result<usize, String> {
    let mut letters = name.chars();
    let place = letters.next().and_then(|letter| AXIS_NAMES[..dimension].iter().position(|&axis| axis == letter));
    match (place, letters.next()) {
        (Some(place), None) => Ok(place),
        _ => {
            let names: Vec<String> = AXIS_NAMES[..dimension].iter().map(char::to_string).collect();
            Err(format!("there is no axis \"{name}\" in {dimension} dimensions; the axes are {}", names.join(" ")))
        }
    }
}

/// The axes of a plane by its name, in the order of the name: "xw" turns x towards w, "wx" w towards x.
pub(crate) fn plane(name: &str, dimension: usize) -> Result<(usize, usize), String> {
    let letters: Vec<String> = name.chars().map(String::from).collect();
    let [first, second] = letters.as_slice() else {
        return Err(format!("\"{name}\" is no plane; planes are named by two axes, such as xw"));
    };
    let (i, j) = (axis(first, dimension)?, axis(second, dimension)?);
    if i == j { Err(format!("\"{name}\" names one axis twice; a plane has two")) } else { Ok((i, j)) }
}

//! The arguments of `hyperbody render`, and what their texts mean.

use std::path::PathBuf;

use clap::Args;
use hyperbody::math::planes::AXIS_NAMES;
use hyperbody_render::film::FRAME_RATES;
use hyperbody_render::picture::{MAX_SIDE, MIN_SIDE};

use crate::numbers::{LARGEST_PLACE, LARGEST_TIME, LARGEST_TURN, place, seconds, shortened, turn, whole, within};

/// Pixels across or down.
const SIDES: std::ops::RangeInclusive<i64> = MIN_SIDE as i64..=MAX_SIDE as i64;

#[derive(Args, Debug)]
#[command(after_help = "Pictures:\n  \
    hyperbody render dice4d -o dice.png                      after three seconds, cut at w = 0\n  \
    hyperbody render dice4d -o dice.png --at 1 --slice w=0.5 another moment, another slice\n  \
    hyperbody render pit4d -o turned.png --turn xw=30        a slice turned by 30° from x towards w\n  \
    hyperbody render pyramid3d -o front.png --camera 0,10    seen from the front, 10° from above\n\n\
    Films, by their ending (.mp4 is made by the program ffmpeg, if it is installed):\n  \
    hyperbody render dice4d -o dice.gif                      the first four seconds\n  \
    hyperbody render dice4d -o slow.apng --speed 0.25        at a quarter of the speed\n  \
    hyperbody render pit4d -o through.mp4 --at 3 --speed 0 --slice w=-2 --slice-to w=2\n  \
    hyperbody render pit4d -o turning.gif --at 3 --speed 0 --turn-to xw=360\n\n\
    Sheets, of pictures that differ in one thing:\n  \
    hyperbody render dice4d -o places.png --sheet w=-1..1,9  the same moment, nine places along w\n  \
    hyperbody render dice4d -o moments.png --sheet t=0..4,6  six moments\n  \
    hyperbody render dice4d -o turns.png --sheet xw=0..90,4  four turns of the slice\n\n\
    A long simulation is computed once and shown many times:\n  \
    hyperbody run pit4d --seconds 60 --record pit.hbrec\n  \
    hyperbody render pit.hbrec -o end.png --at 60\n\n\
    In four and more dimensions a picture shows a three-dimensional slice. Bodies beside it appear as glass, blue on the \
    positive side of w and orange on the negative; the strip on the right shows where every body is along w, and the slice \
    as a line.")]
pub(crate) struct RenderArguments {
    /// A scene file, the name of a built-in scene, or a recording
    pub(crate) scene: String,
    /// Where to: a .png file for a picture or a sheet; .gif, .apng or .mp4 for a film
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// The moment to show, in simulated seconds; of a film, the first one [default: 3 for pictures, 0 for films]
    #[arg(long, value_name = "S", value_parser = seconds, allow_hyphen_values = true)]
    pub(crate) at: Option<f64>,
    /// How long a film plays, in seconds [default: 4; of a recording, all that is left]
    #[arg(long, value_name = "S", value_parser = seconds, allow_hyphen_values = true)]
    pub(crate) seconds: Option<f64>,
    /// Simulated seconds per second of a film: 0.25 is slow motion, at 0 time stands still [default: 1]
    #[arg(long, value_name = "FACTOR", value_parser = speed, allow_hyphen_values = true)]
    pub(crate) speed: Option<f64>,
    /// Pictures per second of a film, at most 50 for a GIF [default: 25]
    #[arg(long, value_name = "N", value_parser = whole::<u16>(i64::from(*FRAME_RATES.start())..=i64::from(*FRAME_RATES.end())), allow_negative_numbers = true)]
    pub(crate) frame_rate: Option<u16>,
    /// A sheet of COUNT pictures in which an axis (w=-1..1), a turn (xw=0..90) or the time (t=0..4) goes from one value to
    /// another
    #[arg(long, value_name = "w=FROM..TO,COUNT", value_parser = sheet_axis, allow_hyphen_values = true)]
    pub(crate) sheet: Option<SheetAxis>,
    /// Pictures in a row of a sheet [default: about as many as rows]
    #[arg(long, value_name = "N", value_parser = whole::<u32>(1..=64), allow_negative_numbers = true)]
    pub(crate) columns: Option<u32>,
    /// Pixels across [default: 1280; 640 for films, 480 for each picture of a sheet]
    #[arg(long, value_name = "PIXELS", value_parser = whole::<u32>(SIDES), allow_negative_numbers = true)]
    pub(crate) width: Option<u32>,
    /// Pixels down [default: 9/16 of those across]
    #[arg(long, value_name = "PIXELS", value_parser = whole::<u32>(SIDES), allow_negative_numbers = true)]
    pub(crate) height: Option<u32>,
    /// A point that the slice goes through, by axes, in metres; axes left out are 0
    #[arg(long, value_name = "w=0.5,…", value_parser = places, allow_hyphen_values = true)]
    pub(crate) slice: Option<Assignments>,
    /// Where the slice is at the end of a film; it goes there evenly
    #[arg(long, value_name = "w=1,…", value_parser = places, allow_hyphen_values = true)]
    pub(crate) slice_to: Option<Assignments>,
    /// Turns of the slice by planes, in degrees, one after the other
    #[arg(long, value_name = "xw=30,…", value_parser = turns, allow_hyphen_values = true)]
    pub(crate) turn: Option<Assignments>,
    /// How far the slice is turned at the end of a film; it turns evenly
    #[arg(long, value_name = "xw=90,…", value_parser = turns, allow_hyphen_values = true)]
    pub(crate) turn_to: Option<Assignments>,
    /// Where the eye is: degrees around the vertical, degrees above the horizon, and if wanted the distance in metres
    #[arg(long, value_name = "AROUND,ABOVE[,DISTANCE]", value_parser = eye, allow_hyphen_values = true)]
    pub(crate) camera: Option<Numbers>,
    /// What is in the middle of the picture, beside the strips, in coordinates of the slice
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    pub(crate) look_at: Option<Numbers>,
    /// Angle from the lower to the upper edge, in degrees
    #[arg(long, value_name = "DEGREES", value_parser = angle_of_view, allow_negative_numbers = true)]
    pub(crate) field_of_view: Option<f64>,
    /// Rays of light per pixel: 1 for a draft, 16 for print
    #[arg(long, value_name = "RAYS", default_value_t = 3, value_parser = whole::<u32>(1..=64), allow_negative_numbers = true)]
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
    #[arg(long, value_name = "T", value_parser = whole::<u16>(1..=256), allow_negative_numbers = true)]
    pub(crate) threads: Option<u16>,
    /// Print one JSON object that says what was drawn: moments, size, the camera that was chosen, the hash of the state
    #[arg(long)]
    pub(crate) json: bool,
}

/// Names with numbers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Assignments(pub(crate) Vec<(String, f64)>);

/// Numbers with commas between them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Numbers(pub(crate) Vec<f64>);

/// What differs between the pictures of a sheet, and how.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SheetAxis {
    /// An axis, a plane, or t.
    pub(crate) name: String,
    from: f64,
    to: f64,
    count: u32,
}

/// Most pictures of a sheet.
const MAX_PICTURES: u32 = 64;

/// Pictures of a sheet if no number is said.
const DEFAULT_PICTURES: u32 = 9;

impl SheetAxis {
    /// Whether it is the moment that differs.
    pub(crate) fn is_time(&self) -> bool {
        self.name == "t"
    }

    /// Whether it begins where it ends.
    pub(crate) fn is_constant(&self) -> bool {
        self.from == self.to
    }

    /// The value for each picture: evenly from the first to the last.
    pub(crate) fn values(&self) -> Vec<f64> {
        let share = |index: u32| f64::from(index) / f64::from(self.count.max(2) - 1);
        (0..self.count).map(|index| self.from * (1.0 - share(index)) + self.to * share(index)).collect()
    }
}

fn sheet_axis(text: &str) -> Result<SheetAxis, String> {
    let form = || format!("\"{}\" is not of the form NAME=FROM..TO,COUNT, such as w=-1..1,9", shortened(text));
    let (name, range) = text.split_once('=').ok_or_else(form)?;
    let (range, count) = match range.split_once(',') {
        Some((range, count)) => (range, count.trim().parse().map_err(|_| form())?),
        None => (range, DEFAULT_PICTURES),
    };
    let (from, to) = range.split_once("..").ok_or_else(form)?;
    if !(2..=MAX_PICTURES).contains(&count) {
        return Err(format!("a sheet has 2 to {MAX_PICTURES} pictures, not {count}"));
    }
    if to.starts_with('.') {
        return Err(too_many_dots(text, from, to));
    }
    let name = name.trim().to_owned();
    let value = |text: &str| match name.chars().count() {
        1 if name == "t" => within(text, -LARGEST_TIME..=LARGEST_TIME, " s"),
        1 => within(text, -LARGEST_PLACE..=LARGEST_PLACE, " m"),
        _ => within(text, -LARGEST_TURN..=LARGEST_TURN, "°"),
    };
    Ok(SheetAxis { from: value(from)?, to: value(to)?, count, name })
}

/// What is said of `0...5`: what may have been meant, if anything.
fn too_many_dots(text: &str, from: &str, to: &str) -> String {
    let digits = to.trim_start_matches('.');
    // A hint that is cut off would be none.
    let hint = if digits.is_empty() || shortened(text) != text {
        "write FROM..TO, two numbers with two dots between them".to_owned()
    } else {
        format!("write {from}..{digits}, or {from}..0.{digits}")
    };
    format!("\"{}\" has more than two dots; {hint}", shortened(text))
}

fn speed(text: &str) -> Result<f64, String> {
    within(text, 0.0..=1000.0, "; at 0 time stands still")
}

fn assignments(text: &str, value_of: impl Fn(&str) -> Result<f64, String>) -> Result<Assignments, String> {
    let parse = |part: &str| {
        let form = || format!("\"{}\" is not of the form NAME=NUMBER", shortened(part));
        let (name, value) = part.split_once('=').ok_or_else(form)?;
        Ok((name.trim().to_owned(), value_of(value)?))
    };
    text.split(',').map(parse).collect::<Result<_, String>>().map(Assignments)
}

fn places(text: &str) -> Result<Assignments, String> {
    assignments(text, place)
}

fn turns(text: &str) -> Result<Assignments, String> {
    assignments(text, turn)
}

fn point(text: &str) -> Result<Numbers, String> {
    text.split(',').map(place).collect::<Result<_, _>>().map(Numbers)
}

/// Degrees around, degrees above, and maybe a distance; how many there are is checked elsewhere.
fn eye(text: &str) -> Result<Numbers, String> {
    let number = |(index, text): (usize, &str)| match index {
        0 => turn(text),
        1 => within(text, -90.0..=90.0, "° above the horizon"),
        _ => within(text, MIN_DISTANCE..=LARGEST_PLACE, " m away (without a distance one that fits is chosen)"),
    };
    text.split(',').enumerate().map(number).collect::<Result<_, _>>().map(Numbers)
}

/// Least distance of the camera, m.
const MIN_DISTANCE: f64 = 0.001;

fn angle_of_view(text: &str) -> Result<f64, String> {
    within(text, 1.0..=150.0, "°")
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

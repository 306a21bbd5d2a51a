//! What is to be drawn: a picture, a film or a sheet, and whether the options go with it.

use hyperbody_render::picture::{MAX_SIDE, MIN_SIDE};

use crate::failure::Failure;
use crate::files::Target;

use super::arguments::{RenderArguments, SheetAxis};

/// What the arguments ask for.
pub(super) struct Plan {
    pub(super) target: Target,
    /// Pixels across and down, of each picture.
    pub(super) size: (u32, u32),
    pub(super) work: Work,
}

/// The kinds of output.
pub(super) enum Work {
    /// One picture.
    Still {
        /// Simulated time, s, if said.
        at: Option<f64>,
    },
    /// Pictures beside each other.
    Sheet(Sheet),
    /// Pictures one after the other.
    Film(Film),
}

/// A sheet of pictures that differ in one thing.
pub(super) struct Sheet {
    pub(super) axis: SheetAxis,
    pub(super) at: Option<f64>,
    pub(super) columns: Option<u32>,
}

/// A film.
pub(super) struct Film {
    pub(super) format: Format,
    /// Simulated time of its first picture, s.
    pub(super) at: f64,
    /// How long it plays, s, if said.
    pub(super) seconds: Option<f64>,
    /// Pictures per second.
    pub(super) rate: u16,
    /// Simulated seconds per second of the film.
    pub(super) speed: f64,
}

/// How a film is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Gif,
    Apng,
    Mp4,
}

/// Pictures per second if nothing is said.
const DEFAULT_RATE: u16 = 25;

impl Plan {
    /// Checks what can be checked without the scene.
    pub(super) fn new(arguments: &RenderArguments) -> Result<Self, Failure> {
        let target = Target::new("--output", &arguments.output, &["png", "gif", "apng", "mp4"])?;
        let format = match target.extension() {
            "gif" => Some(Format::Gif),
            "apng" => Some(Format::Apng),
            "mp4" => Some(Format::Mp4),
            _ => None,
        };
        check_combination(arguments, &target, format.is_some())?;
        let default_size = match (format, &arguments.sheet) {
            (Some(_), _) => (640, 360),
            (None, Some(_)) => (480, 270),
            (None, None) => (1280, 720),
        };
        let size = size(arguments, default_size)?;
        if format == Some(Format::Mp4) && (size.0 % 2 == 1 || size.1 % 2 == 1) {
            let (width, height) = size;
            let (even_width, even_height) = (width & !1, height & !1);
            return Err(Failure::Input(format!(
                "an MP4 of {width} × {height} pixels cannot be: players want even numbers, such as \
                 --width {even_width} --height {even_height}"
            )));
        }
        let work = match (format, &arguments.sheet) {
            (Some(format), _) => Work::Film(Film {
                format,
                at: arguments.at.unwrap_or(0.0),
                seconds: arguments.seconds,
                rate: arguments.frame_rate.unwrap_or(DEFAULT_RATE),
                speed: arguments.speed.unwrap_or(1.0),
            }),
            (None, Some(axis)) => {
                Work::Sheet(Sheet { axis: axis.clone(), at: arguments.at, columns: arguments.columns })
            }
            (None, None) => Work::Still { at: arguments.at },
        };
        Ok(Self { target, size, work })
    }
}

/// Pixels across and down. Where one is said, the other keeps the proportions of a screen.
fn size(arguments: &RenderArguments, default: (u32, u32)) -> Result<(u32, u32), Failure> {
    match (arguments.width, arguments.height) {
        (None, None) => Ok(default),
        (Some(width), None) => Ok((width, (width * 9 / 32 * 2).max(MIN_SIDE))),
        (Some(width), Some(height)) => Ok((width, height)),
        (None, Some(height)) => {
            let width = (height * 8 / 9 * 2).max(MIN_SIDE);
            if width > MAX_SIDE {
                return Err(Failure::Input(format!(
                    "--height {height} makes pictures of {width} × {height} pixels, and {MAX_SIDE} across are the most; \
                     give a --width too, or a --height of {} at most",
                    MAX_SIDE * 9 / 16
                )));
            }
            Ok((width, height))
        }
    }
}

/// Options that would be without effect are refused: they were meant to have one.
fn check_combination(arguments: &RenderArguments, target: &Target, is_film: bool) -> Result<(), Failure> {
    let of_films = [
        ("--seconds", arguments.seconds.is_some()),
        ("--frame-rate", arguments.frame_rate.is_some()),
        ("--speed", arguments.speed.is_some()),
        ("--slice-to", arguments.slice_to.is_some()),
        ("--turn-to", arguments.turn_to.is_some()),
    ];
    if let Some((option, _)) = of_films.iter().find(|(_, given)| *given && !is_film) {
        return Err(Failure::Input(format!(
            "{option} is for films, and {} is a picture; name a .gif, .apng or .mp4, or leave {option} out",
            target.display()
        )));
    }
    if arguments.sheet.is_some() && is_film {
        return Err(Failure::Input(format!(
            "--sheet makes one picture of many, and {} is a film; name a .png, or leave --sheet out (--slice-to and \
             --turn-to move the slice in a film)",
            target.display()
        )));
    }
    if arguments.columns.is_some() && arguments.sheet.is_none() {
        return Err(Failure::Input("--columns arranges the pictures of a sheet; say which with --sheet".to_owned()));
    }
    if arguments.at.is_some() && arguments.sheet.as_ref().is_some_and(SheetAxis::is_time) {
        return Err(Failure::Input("--at and --sheet t=… both say the moments; leave one of them out".to_owned()));
    }
    Ok(())
}

//! Films: pictures of a span, all by the camera that the first one chose.

use hyperbody_render::{Film as Encoder, FilmFormat, Image};

use super::mp4::{self, Mp4};
use super::plan::{Film, Format, Plan};
use super::timeline::Timeline;
use super::view::{Sight, View};
use crate::failure::Failure;
use crate::files::{Aside, Target};
use crate::progress::Progress;

/// Most pictures of a film: three minutes at 20 a second.
const MAX_FRAMES: f64 = 3600.0;

/// How long a film plays if nothing is said, s.
const DEFAULT_SECONDS: f64 = 4.0;

/// Where the pictures go.
enum Output<'a, 'b> {
    /// Stored by this program.
    File { encoder: Box<Encoder<&'a mut Aside<'b>>>, target: &'a Target },
    /// Stored by ffmpeg.
    Mp4(Mp4<'a>),
}

pub(super) fn write(film: &Film, plan: &Plan, view: &View<'_>, timeline: &mut Timeline) -> Result<(), Failure> {
    let frames = frames(film, timeline)?;
    match film.format {
        Format::Gif => store(film, frames, FilmFormat::Gif, (&plan.target, plan.size), view, timeline),
        Format::Apng => store(film, frames, FilmFormat::Apng, (&plan.target, plan.size), view, timeline),
        Format::Mp4 if mp4::is_there() => {
            let output = Output::Mp4(Mp4::new(&plan.target, plan.size, film.rate)?);
            draw(film, frames, output, view, timeline)
        }
        Format::Mp4 => {
            let target = Target::new("--output", &plan.target.path().with_extension("apng"), &["apng"])?;
            eprintln!(
                "warning: there is no program ffmpeg on the PATH, which makes .mp4 files; the film is written to {} \
                 instead, an animated PNG, which browsers play",
                target.display()
            );
            store(film, frames, FilmFormat::Apng, (&target, plan.size), view, timeline)
        }
    }
}

/// Draws a film and stores it without the help of others.
fn store(
    film: &Film,
    frames: u32,
    format: FilmFormat,
    (target, size): (&Target, (u32, u32)),
    view: &View<'_>,
    timeline: &mut Timeline,
) -> Result<(), Failure> {
    let mut aside = target.open()?;
    let encoder = Box::new(Encoder::new(&mut aside, format, size, frames, film.rate)?);
    draw(film, frames, Output::File { encoder, target }, view, timeline)?;
    aside.finish()
}

/// How many pictures the film has; whether there are such moments.
fn frames(film: &Film, timeline: &Timeline) -> Result<u32, Failure> {
    let rate = f64::from(film.rate);
    timeline.check(film.at)?;
    let seconds = film.seconds.unwrap_or_else(|| {
        let left = timeline.up_to(film.at + DEFAULT_SECONDS * film.speed) - film.at;
        if film.speed > 0.0 { left.max(0.0) / film.speed } else { DEFAULT_SECONDS }
    });
    let frames = (seconds * rate).round().max(1.0);
    if frames > MAX_FRAMES {
        return Err(Failure::Input(format!(
            "--seconds {seconds} at {rate} pictures a second are {frames} pictures; at most {MAX_FRAMES} make a film"
        )));
    }
    timeline.check(film.at + (frames - 1.0) / rate * film.speed)?;
    Ok(frames as u32)
}

fn draw(
    film: &Film,
    frames: u32,
    mut output: Output<'_, '_>,
    view: &View<'_>,
    timeline: &mut Timeline,
) -> Result<(), Failure> {
    let moment = |share: f64| film.at + share * f64::from(frames - 1) / f64::from(film.rate) * film.speed;
    // One camera for the whole film, which has in view what it shows at its start, at its end and between.
    let moments = PREVIEWS.map(moment);
    let slices = PREVIEWS.iter().map(|&share| view.slice(share));
    let sights: Vec<Sight> = timeline.preview(&moments)?.into_iter().zip(slices).collect();
    let camera = view.camera(timeline, &sights)?;
    let mut progress = Progress::new("pictures of the film", u64::from(frames));
    for number in 0..frames {
        let share = f64::from(number) / f64::from(frames.max(2) - 1);
        let frame = timeline.moment(moment(share))?;
        output.add(&view.picture(timeline, &frame, share, &camera)?)?;
        progress.advance();
    }
    output.finish()
}

/// The parts of a film that the camera is chosen for.
const PREVIEWS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

impl Output<'_, '_> {
    fn add(&mut self, image: &Image) -> Result<(), Failure> {
        match self {
            Self::File { encoder, target } => encoder.add(image).map_err(|error| target.unwritable(&error)),
            Self::Mp4(mp4) => mp4.add(image),
        }
    }

    fn finish(self) -> Result<(), Failure> {
        match self {
            Self::File { encoder, target } => encoder.finish().map_err(|error| target.unwritable(&error)),
            Self::Mp4(mp4) => mp4.finish(),
        }
    }
}

//! Films: pictures of a span, all by one camera.

use hyperbody_render::{Film as Encoder, FilmFormat, Image};

use hyperbody_scene::recording::Frame;

use super::mp4::{self, Mp4};
use super::plan::{Film, Format, Plan};
use super::report::Report;
use super::timeline::Timeline;
use super::view::{Drawing, Sight, View};
use crate::failure::Failure;
use crate::files::{Aside, Target};
use crate::output::number;

/// Most pictures of a film: three minutes at 20 a second.
const MAX_FRAMES: f64 = 3600.0;

/// How long a film of a simulation, which has no end, plays if nothing is said, s.
const DEFAULT_SECONDS: f64 = 4.0;

/// Where the pictures go.
enum Output<'a, 'b> {
    /// Stored by this program.
    File { encoder: Box<Encoder<&'a mut Aside<'b>>>, target: &'a Target },
    /// Stored by ffmpeg.
    Mp4(Mp4<'a>),
}

pub(super) fn write(film: &Film, plan: &Plan, view: &View<'_>, timeline: &mut Timeline) -> Result<Report, Failure> {
    let frames = frames(film, timeline)?;
    match film.format {
        Format::Gif => store(film, frames, FilmFormat::Gif, (&plan.target, plan.size), view, timeline),
        Format::Apng => store(film, frames, FilmFormat::Apng, (&plan.target, plan.size), view, timeline),
        Format::Mp4 if mp4::is_there()? => {
            let output = Output::Mp4(Mp4::new(&plan.target, plan.size, film.rate)?);
            Ok(draw(film, frames, output, view, timeline)?.of(&plan.target, plan.size))
        }
        Format::Mp4 => {
            let target = Target::new("--output", &plan.target.path().with_extension("apng"), &["apng"])?;
            if target.path().exists() {
                return Err(Failure::Input(format!(
                    "there is no program ffmpeg on the PATH, which makes .mp4 files, and {} is there already, which would be \
                     written instead; install ffmpeg, or name that file with --output to overwrite it",
                    target.display()
                )));
            }
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
) -> Result<Report, Failure> {
    let mut aside = target.open()?;
    let encoder = Box::new(Encoder::new(&mut aside, format, size, frames, film.rate)?);
    let report = draw(film, frames, Output::File { encoder, target }, view, timeline)?;
    aside.finish()?;
    Ok(report.of(target, size))
}

/// How many pictures the film has; whether there are such moments.
fn frames(film: &Film, timeline: &Timeline) -> Result<u32, Failure> {
    let rate = f64::from(film.rate);
    timeline.check(film.at)?;
    let left = timeline.left_after(film.at).filter(|_| film.speed > 0.0).map(|left| left / film.speed);
    let seconds = film.seconds.or(left).unwrap_or(DEFAULT_SECONDS);
    let frames = (seconds * rate).round().max(1.0);
    if frames > MAX_FRAMES {
        let whose = if film.seconds.is_some() { "--seconds" } else { "what is left of the recording lasts" };
        return Err(Failure::Input(format!(
            "{whose} {} s; at {rate} pictures a second these are {frames} pictures, and {MAX_FRAMES} at most make a film: give \
             fewer --seconds, a higher --speed or a lower --frame-rate",
            number(seconds)
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
) -> Result<Report, Failure> {
    let share = |number: u32| f64::from(number) / f64::from(frames.max(2) - 1);
    let moment = |number: u32| film.at + f64::from(number) / f64::from(film.rate) * film.speed;
    let moments: Vec<f64> = (0..frames).map(moment).collect();
    let mut kept = Kept::new(timeline, &moments)?;
    // One camera for the whole film, which has in view what it shows at its start, at its end and between.
    let previews: Vec<u32> = (0..PREVIEWS).map(|index| (frames - 1) * index / (PREVIEWS - 1)).collect();
    let ahead = kept.look_ahead(timeline, &moments, &previews)?;
    let slices = previews.iter().map(|&number| view.slice(share(number)));
    let sights: Vec<Sight> = ahead.into_iter().zip(slices).collect();
    let camera = view.camera(timeline, &sights)?;
    let drawing = Drawing::new(view, frames);
    let mut last = None;
    for number in 0..frames {
        let frame = kept.next(timeline, moments[number as usize])?;
        output.add(&drawing.picture(view, timeline, &frame, share(number), &camera)?)?;
        last = Some(frame);
    }
    output.finish()?;
    Ok(Report::new(timeline, &camera, &moments, last.as_ref()))
}

/// The parts of a film that the camera is chosen for.
const PREVIEWS: u32 = 9;

/// Most bytes of poses that are kept in memory; the bodies of a longer film are simulated twice, once for the camera.
const MAX_KEPT_BYTES: u64 = 256 << 20;

/// The bodies of a film, kept if they have been simulated already.
struct Kept(Option<std::collections::VecDeque<Frame>>);

impl Kept {
    fn new(timeline: &mut Timeline, moments: &[f64]) -> Result<Self, Failure> {
        match timeline.bytes_per_moment() {
            Some(bytes) if bytes * moments.len() as u64 <= MAX_KEPT_BYTES => {
                Ok(Self(Some(timeline.moments(moments)?.into())))
            }
            _ => Ok(Self(None)),
        }
    }

    /// The bodies in the pictures with these numbers.
    fn look_ahead(&self, timeline: &mut Timeline, moments: &[f64], numbers: &[u32]) -> Result<Vec<Frame>, Failure> {
        match &self.0 {
            Some(frames) => Ok(numbers.iter().map(|&number| frames[number as usize].clone()).collect()),
            None => timeline.look_ahead(&numbers.iter().map(|&number| moments[number as usize]).collect::<Vec<_>>()),
        }
    }

    /// The bodies in the next picture, whose moment this is.
    fn next(&mut self, timeline: &mut Timeline, moment: f64) -> Result<Frame, Failure> {
        match self.0.as_mut().and_then(std::collections::VecDeque::pop_front) {
            Some(frame) => Ok(frame),
            None => timeline.moment(moment),
        }
    }
}

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

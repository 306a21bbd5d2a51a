//! `hyperbody render`: pictures, films and sheets of slices, without a window.

pub(crate) mod arguments;
mod eye;
mod film;
mod mp4;
mod plan;
mod report;
mod sheet;
mod timeline;
mod view;

use std::path::PathBuf;

use hyperbody_render::RenderError;

use crate::failure::Failure;
use crate::output::print_json;
use arguments::RenderArguments;
use plan::{Plan, Work};
use report::Report;
use timeline::Timeline;
use view::{Drawing, Sight, View};

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        Self::Input(error.to_string())
    }
}

pub(crate) fn render(arguments: &RenderArguments) -> Result<(), Failure> {
    let plan = Plan::new(arguments)?;
    plan.target.refuse_inputs("--output", &[PathBuf::from(&arguments.scene)])?;
    let mut timeline = Timeline::open(&arguments.scene, arguments.threads)?;
    plan.target.refuse_inputs("--output", &timeline.files()?)?;
    let view = View::new(arguments, timeline.dimension(), plan.size)?;
    let report = match &plan.work {
        Work::Still { at } => still(*at, &plan, &view, &mut timeline)?,
        Work::Sheet(sheet) => sheet::write(sheet, &plan, &view, &mut timeline)?,
        Work::Film(film) => film::write(film, &plan, &view, &mut timeline)?,
    };
    if arguments.json { print_json(&report) } else { Ok(()) }
}

/// One picture.
fn still(at: Option<f64>, plan: &Plan, view: &View<'_>, timeline: &mut Timeline) -> Result<Report, Failure> {
    let at = at.unwrap_or_else(|| timeline.up_to(DEFAULT_MOMENT));
    let sights: Vec<Sight> = timeline.moments(&[at])?.into_iter().map(|frame| (frame, view.slice(0.0))).collect();
    let camera = view.camera(timeline, &sights)?;
    let mut bytes = Vec::new();
    for (frame, _) in &sights {
        Drawing::new(view, 1).picture(view, timeline, frame, 0.0, &camera)?.write_png(&mut bytes)?;
    }
    plan.target.write(&bytes)?;
    Ok(Report::new(timeline, &camera, &[at], sights.last().map(|(frame, _)| frame)).of(&plan.target, plan.size))
}

/// The moment of a picture if none is said, s: by then something has happened.
const DEFAULT_MOMENT: f64 = 3.0;

//! `hyperbody render`: pictures, films and sheets of slices, without a window.

pub(crate) mod arguments;
mod film;
mod mp4;
mod plan;
mod sheet;
mod timeline;
mod view;

use hyperbody_render::RenderError;

use crate::failure::Failure;
use arguments::RenderArguments;
use plan::{Plan, Work};
use timeline::Timeline;
use view::View;

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        Self::Input(error.to_string())
    }
}

pub(crate) fn render(arguments: &RenderArguments) -> Result<(), Failure> {
    let plan = Plan::new(arguments)?;
    let mut timeline = Timeline::open(&arguments.scene, arguments.threads)?;
    let view = View::new(arguments, timeline.dimension(), plan.size)?;
    match &plan.work {
        Work::Still { at } => {
            let moment = timeline.moment(at.unwrap_or_else(|| timeline.up_to(DEFAULT_MOMENT)))?;
            let sights = [(moment, view.slice(0.0))];
            let camera = view.camera(&timeline, &sights)?;
            let mut bytes = Vec::new();
            view.picture(&timeline, &sights[0].0, 0.0, &camera)?.write_png(&mut bytes)?;
            plan.target.write(&bytes)
        }
        Work::Sheet(sheet) => sheet::write(sheet, &plan, &view, &mut timeline),
        Work::Film(film) => film::write(film, &plan, &view, &mut timeline),
    }
}

/// The moment of a picture if none is said, s: by then something has happened.
const DEFAULT_MOMENT: f64 = 3.0;

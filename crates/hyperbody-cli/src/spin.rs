//! `hyperbody spin`: the free-rotation laboratory.

mod arguments;
mod body;
mod boundary;
mod csv;
mod map;
mod picture;
mod report;
mod text;
mod trial;

use hyperbody_scene::visit_dimension;

pub(crate) use arguments::SpinArguments;

use crate::failure::Failure;
use crate::files::Target;
use crate::output::{as_json, print};
use body::{Body, no_such_dimension};
use map::Map;
use trial::Trial;

pub(crate) fn spin(arguments: &SpinArguments) -> Result<(), Failure> {
    // Everything that can be refused is refused before the work begins.
    let body = Body::from_arguments(arguments)?;
    let target = |option, path: &Option<std::path::PathBuf>, extensions: &[&str]| {
        path.as_deref().map(|path| Target::new(option, path, extensions)).transpose()
    };
    let plot = target("--plot", &arguments.plot, &["svg", "png"])?;
    let csv = target("--csv", &arguments.csv, &["csv"])?;
    let dimension = body.dimension();
    let unknown = || Err(no_such_dimension(dimension));
    let (picture, table, text) = if arguments.map.is_some() {
        let report = visit_dimension(dimension, Map { body: &body, arguments }).unwrap_or_else(unknown)?;
        let picture = plot.as_ref().map(|_| picture::draw_map(&report)).transpose()?;
        let table = csv.as_ref().map(|_| map::as_csv(&report));
        (picture, table, if arguments.json { as_json(&report)? } else { map::as_text(&report) })
    } else {
        let unknown = || Err(no_such_dimension(dimension));
        let report = visit_dimension(dimension, Trial { body: &body, arguments }).unwrap_or_else(unknown)?;
        let picture = plot.as_ref().map(|_| picture::draw_run(&report, &arguments.show)).transpose()?;
        let table = csv.as_ref().map(|_| csv::table(&report));
        (picture, table, if arguments.json { as_json(&report)? } else { text::as_text(&report) })
    };
    if let (Some(plot), Some(picture)) = (&plot, &picture) {
        picture::write(plot, picture)?;
    }
    if let (Some(csv), Some(table)) = (&csv, &table) {
        csv.write(table.as_bytes())?;
    }
    print(text)
}

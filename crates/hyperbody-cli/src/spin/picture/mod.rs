//! Pictures of free rotations as SVG and PNG.
//!
//! Drawn by plotters into SVG alone: its bitmaps need a system font and leave thick lines jagged. PNG is the same SVG,
//! rasterised by resvg (pure Rust, no graphics driver) with DejaVu Sans, which comes as a crate: no system font is asked
//! for, so that pictures have the same bytes on a bare machine, and no font lies in this repository. In SVG text stays
//! text, in whatever sans-serif font the viewer has; so texts stand where a wider or narrower font does no harm, and no
//! layout depends on their width.
//!
//! plotters rounds to whole units; with [`UNITS`] units to a pixel that does not show. Colours tell series apart for the
//! colour-blind, too (M. Okabe and K. Ito, 2008), and dashes tell apart more series than there are colours.

mod axis;
mod chart;
mod heat;
mod map;
mod path;
mod run;
mod style;

use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, IntoDrawingArea, SVGBackend, WHITE};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

pub(super) use map::draw as draw_map;
pub(super) use run::draw as draw_run;

use crate::failure::Failure;
use crate::files::Target;

/// What a picture of a run can show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Panel {
    /// Angular velocity of each plane against time
    Spins,
    /// Drift of the conserved quantities against time, on a logarithmic axis
    Drift,
    /// The path of the momentum in the body on its sphere
    Path,
}

/// What plotters draws on.
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// What drawing ends with.
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Units of the SVG to a pixel: the precision of its whole numbers.
const UNITS: f64 = 4.0;

/// Width of every picture in pixels.
const WIDTH: f64 = 1600.0;

/// An SVG of the given height in pixels.
fn svg(height: f64, paint: impl FnOnce(&Area<'_>) -> Drawn) -> Result<String, Failure> {
    let mut text = String::new();
    let size = ((WIDTH * UNITS) as u32, (height * UNITS) as u32);
    let draw = |text: &mut String| -> Drawn {
        let area = SVGBackend::with_string(text, size).into_drawing_area();
        area.fill(&WHITE)?;
        paint(&area)?;
        area.present()?;
        Ok(())
    };
    draw(&mut text).map_err(|error| Failure::Work(format!("cannot draw the picture: {error}")))?;
    // Shown in pixels, addressed in units.
    let (wide, narrow) =
        (format!("width=\"{}\" height=\"{}\"", size.0, size.1), format!("width=\"{WIDTH}\" height=\"{height}\""));
    let text = text.replacen(&wide, &narrow, 1);
    // Without this, hairlines of white show between rectangles that touch.
    Ok(text.replacen('>', "><style>rect{shape-rendering:crispEdges}</style>", 1))
}

/// Writes an SVG as what the target's name ends in.
pub(super) fn write(target: &Target, svg: &str) -> Result<(), Failure> {
    if target.extension() == "svg" {
        return target.write(svg.as_bytes());
    }
    let failed = |what: &dyn std::fmt::Display| Failure::Work(format!("cannot rasterise the picture: {what}"));
    let mut options = Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    let tree = Tree::from_str(svg, &options).map_err(|error| failed(&error))?;
    let size = tree.size().to_int_size();
    let mut pixels = Pixmap::new(size.width(), size.height()).ok_or_else(|| failed(&"it has no size"))?;
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
    let png = pixels.encode_png().map_err(|error| failed(&error))?;
    target.write(&png)
}

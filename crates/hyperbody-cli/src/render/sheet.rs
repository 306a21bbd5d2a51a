//! Sheets: pictures beside each other that differ in one thing, a place of the slice, a turn of it, or the moment.

use hyperbody::math::planes::AXIS_NAMES;
use hyperbody_render::Sheet as Canvas;

use super::DEFAULT_MOMENT;
use super::arguments::{self, SheetAxis};
use super::plan::{Plan, Sheet};
use super::report::Report;
use super::timeline::Timeline;
use super::view::{Drawing, Sight, View};
use crate::failure::Failure;
use crate::output::number;

/// What differs.
enum Varied {
    Time,
    Place(usize),
    Turn((usize, usize)),
}

pub(super) fn write(sheet: &Sheet, plan: &Plan, view: &View<'_>, timeline: &mut Timeline) -> Result<Report, Failure> {
    let bad = |message: String| Failure::Input(format!("--sheet: {message}"));
    let SheetAxis { name, .. } = &sheet.axis;
    let dimension = timeline.dimension();
    let varied = if sheet.axis.is_time() {
        Varied::Time
    } else if name.chars().count() == 1 {
        Varied::Place(arguments::axis(name, dimension).map_err(|message| bad(format!("{message}, and t is the time")))?)
    } else {
        Varied::Turn(arguments::plane(name, dimension).map_err(bad)?)
    };
    if view.hides_strip() && !matches!(varied, Varied::Place(3..)) {
        eprintln!("warning: --no-strip changes nothing: only sheets of places along a hidden axis have strips");
    }
    if sheet.axis.is_constant() {
        eprintln!(
            "warning: --sheet: {name} ends where it begins: all pictures are the same; FROM..TO goes from one to another"
        );
    }
    match varied {
        Varied::Time => {}
        Varied::Place(axis) => view.check_unsaid_axis(axis, name)?,
        Varied::Turn(plane) => view.check_unsaid_plane(plane, name)?,
    }
    let values = sheet.axis.values();
    let count = values.len() as u32;
    // Made before the work: it knows whether it would be too large.
    let mut canvas = Canvas::new(plan.size, count, sheet.columns.unwrap_or_else(|| columns(count)))
        .map_err(|error| bad(error.to_string()))?;
    let at = sheet.at.unwrap_or_else(|| timeline.up_to(DEFAULT_MOMENT));
    let moment = |value: f64| if let Varied::Time = varied { value } else { at };
    // A simulation goes forwards only, whatever the order on the sheet.
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| moment(values[a]).total_cmp(&moment(values[b])).then(a.cmp(&b)));
    let ordered: Vec<f64> = order.iter().map(|&index| moment(values[index])).collect();
    if let Some(early) = ordered.first().filter(|first| **first < 0.0) {
        return Err(bad(format!("there is no moment {early} s; time begins at 0")));
    }
    let views: Vec<View<'_>> = values.iter().map(|&value| varied.view(view, value)).collect();
    // One camera for all pictures, so that they can be compared.
    let frames = timeline.moments(&ordered)?;
    let sights: Vec<Sight> =
        frames.into_iter().zip(&order).map(|(frame, &index)| (frame, views[index].slice(0.0))).collect();
    let camera = views[0].camera(timeline, &sights)?;
    let drawing = Drawing::new(view, count);
    for ((frame, _), &index) in sights.iter().zip(&order) {
        canvas.place(index as u32, &drawing.picture(&views[index], timeline, frame, 0.0, &camera)?)?;
    }
    let image = canvas.into_image();
    let mut bytes = Vec::new();
    image.write_png(&mut bytes)?;
    plan.target.write(&bytes)?;
    Ok(Report::new(timeline, &camera, &ordered, sights.last().map(|(frame, _)| frame))
        .of(&plan.target, (image.width(), image.height())))
}

impl Varied {
    /// The view with one value of what differs, and that in the caption.
    fn view<'a>(&self, view: &View<'a>, value: f64) -> View<'a> {
        let mut own = view.clone();
        // A strip on each would repeat itself; where the slice moves, it is what shows how.
        own.strip = view.strip && matches!(self, Self::Place(3..));
        own.caption = Some(match *self {
            Self::Time => format!("t = {value:.2} s"),
            Self::Place(axis) => {
                own.move_to(axis, value);
                format!("{} = {}", AXIS_NAMES[axis], number(value))
            }
            Self::Turn((i, j)) => {
                own.turn_to((i, j), value.to_radians());
                format!("{}{} turned {}°", AXIS_NAMES[i], AXIS_NAMES[j], number(value))
            }
        });
        own
    }
}

/// As many columns as rows, or one more.
fn columns(count: u32) -> u32 {
    (1..=count).find(|columns| columns * columns >= count).unwrap_or(1)
}

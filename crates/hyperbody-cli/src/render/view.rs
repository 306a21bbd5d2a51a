//! How to look: the slice, the camera, and what is written on the picture.

use std::cell::Cell;
use std::sync::Mutex;

use hyperbody::math::{Dim, EvenAlgebra, Vector, planes};
use hyperbody_render::picture::parts;
use hyperbody_render::{Camera, Image, Settings, Slice, render as draw, strips_share};
use hyperbody_scene::recording::Frame;
use hyperbody_scene::{DimensionVisitor, visit_dimension};

use super::arguments::{self, Assignments, RenderArguments};
use super::timeline::Timeline;
use crate::failure::Failure;
use crate::output::number;
use crate::progress::Progress;

/// A slice of a dimension known at run time only.
#[derive(Clone)]
pub(super) struct SliceAt {
    /// By axes, m.
    point: Vec<f64>,
    /// Planes and angles, rad.
    turns: Vec<(usize, usize, f64)>,
}

impl SliceAt {
    pub(super) fn in_dimension<const N: usize>(&self) -> Slice<N> {
        let point = Vector::from_fn(|axis| self.point.get(axis).copied().unwrap_or(0.0));
        self.turns.iter().fold(Slice::natural().moved(point), |slice, &(i, j, angle)| slice.turned(i, j, angle))
    }
}

/// One moment and the slice by which it is seen.
pub(super) type Sight = (Frame, SliceAt);

/// What the arguments say about how to look.
#[derive(Clone)]
pub(super) struct View<'a> {
    pub(super) arguments: &'a RenderArguments,
    size: (u32, u32),
    /// Where the slice is by axes, at the start and at the end of a film, m.
    points: [Vec<f64>; 2],
    /// Planes, with angles in radians at the start and at the end of a film.
    turns: Vec<Turn>,
    /// What a sheet writes on its pictures in place of the usual caption.
    pub(super) caption: Option<String>,
    /// Whether the strip of hidden axes is drawn.
    pub(super) strip: bool,
    /// Threads to draw on; 0 for one per core.
    threads: usize,
}

#[derive(Clone, Copy)]
struct Turn {
    i: usize,
    j: usize,
    angles: [f64; 2],
}

fn bad(option: &str, message: impl Into<String>) -> Failure {
    Failure::Input(format!("{option}: {}", message.into()))
}

impl<'a> View<'a> {
    /// Checks the options against the dimension of the scene.
    pub(super) fn new(arguments: &'a RenderArguments, dimension: usize, size: (u32, u32)) -> Result<Self, Failure> {
        let mut view = Self {
            arguments,
            size,
            points: [vec![0.0; dimension], vec![0.0; dimension]],
            turns: Vec::new(),
            caption: None,
            strip: !arguments.no_strip,
            threads: arguments.threads.map_or(0, usize::from),
        };
        for (axis, value) in axes("--slice", &arguments.slice, dimension)? {
            view.move_to(axis, value);
        }
        for (axis, value) in axes("--slice-to", &arguments.slice_to, dimension)? {
            view.points[1][axis] = value;
        }
        for ((i, j), degrees) in planes_of("--turn", &arguments.turn, dimension)? {
            view.turns.push(Turn { i, j, angles: [degrees.to_radians(); 2] });
        }
        for ((i, j), degrees) in planes_of("--turn-to", &arguments.turn_to, dimension)? {
            // From y to x is from x to y backwards.
            let backwards = view.turns.iter().any(|turn| (turn.i, turn.j) == (j, i));
            let (plane, degrees) = if backwards { ((j, i), -degrees) } else { ((i, j), degrees) };
            view.turn_in(plane).angles[1] = degrees.to_radians();
        }
        view.check_camera()?;
        view.warn_of_idle_options(dimension);
        Ok(view)
    }

    /// Whether `--no-strip` is said of a scene that has strips.
    pub(super) fn hides_strip(&self) -> bool {
        self.arguments.no_strip && self.points[0].len() > 3
    }

    /// Says which options change nothing in this scene.
    fn warn_of_idle_options(&self, dimension: usize) {
        let idle = [("--no-ghosts", self.arguments.no_ghosts), ("--no-strip", self.arguments.no_strip)];
        for (option, _) in idle.iter().filter(|(_, given)| *given && dimension < 4) {
            eprintln!("warning: {option} changes nothing: {dimension} dimensions have no hidden axis");
        }
        let (width, height) = self.size;
        let sheet = self.arguments.sheet.as_ref();
        let has_strips = sheet.is_none_or(|sheet| arguments::axis(&sheet.name, dimension).is_ok_and(|axis| axis > 2));
        if self.strip && has_strips && dimension > 3 && strips_share(dimension, width, height) == 0.0 {
            eprintln!(
                "warning: the strip of hidden axes is left out: in {width} × {height} pixels it would be too narrow to read"
            );
        }
        if self.arguments.speed == Some(0.0) && self.is_still() {
            eprintln!(
                "warning: with --speed 0 time stands still, and the slice ends where it begins: all pictures are the same; \
                 --slice-to or --turn-to moves the slice"
            );
        }
    }

    /// Whether the slice is the same from the beginning to the end of a film.
    fn is_still(&self) -> bool {
        self.points[0] == self.points[1] && self.turns.iter().all(|turn| turn.angles[0] == turn.angles[1])
    }

    fn check_camera(&self) -> Result<(), Failure> {
        for (option, list, counts) in
            [("--camera", &self.arguments.camera, 2..=3), ("--look-at", &self.arguments.look_at, 3..=3)]
        {
            if let Some(list) = list
                && !counts.contains(&list.0.len())
            {
                let (low, high) = (counts.start(), counts.end());
                let wanted = if low == high { low.to_string() } else { format!("{low} or {high}") };
                return Err(bad(option, format!("has {} numbers, expected {wanted}", list.0.len())));
            }
        }
        Ok(())
    }

    /// Refuses a sheet along an axis of which `--slice` says where the slice is.
    pub(super) fn check_unsaid_axis(&self, axis: usize, name: &str) -> Result<(), Failure> {
        let said = axes("--slice", &self.arguments.slice, self.points[0].len())?;
        match said.iter().find(|(said, _)| *said == axis) {
            Some((_, value)) => Err(bad("--slice", both(&format!("{name}={}", number(*value)), name))),
            None => Ok(()),
        }
    }

    /// Refuses a sheet of turns in a plane of which `--turn` says how far the slice is turned.
    pub(super) fn check_unsaid_plane(&self, (i, j): (usize, usize), name: &str) -> Result<(), Failure> {
        match self.turns.iter().find(|turn| [(i, j), (j, i)].contains(&(turn.i, turn.j))) {
            Some(turn) => {
                let plane = [turn.i, turn.j].map(|axis| planes::AXIS_NAMES[axis]);
                let degrees = number(turn.angles[0].to_degrees());
                Err(bad("--turn", both(&format!("{}{}={degrees}", plane[0], plane[1]), name)))
            }
            None => Ok(()),
        }
    }

    /// Moves the slice along an axis, for the whole film.
    pub(super) fn move_to(&mut self, axis: usize, value: f64) {
        for point in &mut self.points {
            point[axis] = value;
        }
    }

    /// Turns the slice in a plane, for the whole film, in place of what was said of that plane.
    pub(super) fn turn_to(&mut self, plane: (usize, usize), angle: f64) {
        self.turn_in(plane).angles = [angle; 2];
    }

    /// The last turn in a plane, or one by nothing.
    fn turn_in(&mut self, (i, j): (usize, usize)) -> &mut Turn {
        let place = self.turns.iter().rposition(|turn| (turn.i, turn.j) == (i, j)).unwrap_or_else(|| {
            self.turns.push(Turn { i, j, angles: [0.0; 2] });
            self.turns.len() - 1
        });
        &mut self.turns[place]
    }

    /// The slice when `share` of a film is over.
    pub(super) fn slice(&self, share: f64) -> SliceAt {
        let [from, to] = &self.points;
        let angle = |turn: &Turn| (turn.i, turn.j, mix(turn.angles[0], turn.angles[1], share));
        SliceAt {
            point: from.iter().zip(to).map(|(from, to)| mix(*from, *to, share)).collect(),
            turns: self.turns.iter().map(angle).collect(),
        }
    }

    /// The share of the width that strips take up, and width over height.
    pub(super) fn room(&self, dimension: usize) -> (f64, f64) {
        let (width, height) = self.size;
        let share = if self.strip { strips_share(dimension, width, height) } else { 0.0 };
        (share, f64::from(width) / f64::from(height))
    }

    fn caption(&self, timeline: &Timeline, frame: &Frame, share: f64) -> Vec<String> {
        if self.arguments.no_caption {
            return Vec::new();
        }
        if let Some(caption) = &self.caption {
            return vec![caption.clone()];
        }
        let dimension = timeline.dimension();
        let slice = self.slice(share);
        let mut second = format!("t = {:.2} s", frame.time);
        for hidden in 3..dimension {
            second += &format!("   {} = {:.2}", planes::AXIS_NAMES[hidden], slice.point[hidden]);
        }
        for (turn, (i, j, angle)) in self.turns.iter().zip(slice.turns) {
            let degrees = angle.to_degrees();
            let degrees = if turn.angles[0] == turn.angles[1] { number(degrees) } else { format!("{degrees:.0}") };
            second += &format!("   {}{} turned {degrees}°", planes::AXIS_NAMES[i], planes::AXIS_NAMES[j]);
        }
        vec![format!("{}, {dimension}D", timeline.name()), second]
    }
}

fn named(list: &Option<Assignments>) -> &[(String, f64)] {
    list.as_ref().map_or(&[], |list| &list.0)
}

/// What is said where the sheet says it already.
fn both(said: &str, sheet: &str) -> String {
    format!("{said} and --sheet {sheet}=… both say where the slice is; leave one of them out")
}

/// Axes by name with their values, each axis once.
fn axes(option: &str, list: &Option<Assignments>, dimension: usize) -> Result<Vec<(usize, f64)>, Failure> {
    let mut found: Vec<(usize, f64)> = Vec::new();
    for (name, value) in named(list) {
        let axis = arguments::axis(name, dimension).map_err(|message| bad(option, message))?;
        if found.iter().any(|(other, _)| *other == axis) {
            return Err(bad(option, format!("{name} is named twice; name every axis once")));
        }
        found.push((axis, *value));
    }
    Ok(found)
}

/// A plane, from its first axis towards its second, and degrees.
type PlaneAngle = ((usize, usize), f64);

/// Planes by name with their values, each plane once.
fn planes_of(option: &str, list: &Option<Assignments>, dimension: usize) -> Result<Vec<PlaneAngle>, Failure> {
    let mut found: Vec<PlaneAngle> = Vec::new();
    for (name, value) in named(list) {
        let (i, j) = arguments::plane(name, dimension).map_err(|message| bad(option, message))?;
        if found.iter().any(|(other, _)| [(i, j), (j, i)].contains(other)) {
            return Err(bad(option, format!("the plane {name} is named twice; name every plane once")));
        }
        found.push(((i, j), *value));
    }
    Ok(found)
}

fn mix(from: f64, to: f64, share: f64) -> f64 {
    from + (to - from) * share
}

pub(super) fn no_such<T>(timeline: &Timeline) -> Result<T, Failure> {
    Err(Failure::Work(format!("no pictures in {} dimensions", timeline.dimension())))
}

/// Pictures in the making, with one bar for all of them.
pub(super) struct Drawing {
    progress: Mutex<Progress>,
    pictures: u32,
    drawn: Cell<u32>,
}

impl Drawing {
    /// So many pictures.
    pub(super) fn new(view: &View<'_>, pictures: u32) -> Self {
        let parts = parts(view.size.1) * u64::from(pictures);
        Self { progress: Mutex::new(Progress::in_percent("drawing", parts)), pictures, drawn: Cell::new(0) }
    }

    /// The bodies of a frame when `share` of a film is over.
    pub(super) fn picture(
        &self,
        view: &View<'_>,
        timeline: &Timeline,
        frame: &Frame,
        share: f64,
        camera: &Camera,
    ) -> Result<Image, Failure> {
        self.drawn.set(self.drawn.get() + 1);
        if self.pictures > 1
            && let Ok(progress) = self.progress.lock()
        {
            progress.say(format!("drawing picture {} of {}", self.drawn.get(), self.pictures));
        }
        let progress = &self.progress;
        let tell = |more: u64| {
            if let Ok(mut progress) = progress.lock() {
                progress.advance_by(more);
            }
        };
        let (slice, caption) = (view.slice(share), view.caption(timeline, frame, share));
        let task = Draw { view, timeline, frame, slice, camera, caption, tell: &tell };
        visit_dimension(timeline.dimension(), task).unwrap_or_else(|| no_such(timeline))
    }
}

/// Drawing, in the dimension of the world.
struct Draw<'a> {
    view: &'a View<'a>,
    timeline: &'a Timeline,
    frame: &'a Frame,
    slice: SliceAt,
    camera: &'a Camera,
    caption: Vec<String>,
    tell: &'a (dyn Fn(u64) + Sync),
}

impl DimensionVisitor for Draw<'_> {
    type Output = Result<Image, Failure>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        let bodies = self.timeline.bodies::<N>(self.frame)?;
        let (width, height) = self.view.size;
        let settings = Settings {
            width,
            height,
            light_rays: self.view.arguments.quality,
            ghosts: !self.view.arguments.no_ghosts,
            strip: self.view.strip,
            caption: self.caption,
            threads: self.view.threads,
            ..Settings::default()
        };
        let (share, aspect) = self.view.room(N);
        let camera = self.camera.with_room(share, aspect);
        Ok(draw(&bodies, &self.slice.in_dimension::<N>(), Some(&camera), &settings, self.tell)?)
    }
}

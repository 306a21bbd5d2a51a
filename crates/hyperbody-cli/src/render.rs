//! `hyperbody render`: pictures of slices without a window.

pub(crate) mod arguments;

use std::sync::Mutex;

use hyperbody::math::{Dim, EvenAlgebra, Vector, planes};
use hyperbody_render::{Camera, Film, FilmFormat, Image, RenderError, Settings, Slice, frame_bodies, render as draw};
use hyperbody_scene::{AnyWorld, DimensionVisitor, Scene, visit_dimension};

use crate::arguments::MAX_STEPS;
use crate::failure::Failure;
use crate::files::Target;
use crate::output::number;
use crate::progress::Progress;
use crate::source;
use arguments::RenderArguments;

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        Self::Input(error.to_string())
    }
}

pub(crate) fn render(arguments: &RenderArguments) -> Result<(), Failure> {
    let scene = source::scene(&arguments.scene)?;
    let mut world = AnyWorld::new(&scene, usize::from(arguments.threads.unwrap_or(1)))?;
    let target = Target::new("--output", &arguments.output, &["png", "gif", "apng"])?;
    let bytes = match target.extension() {
        "gif" => film(arguments, &scene, &mut world, FilmFormat::Gif)?,
        "apng" => film(arguments, &scene, &mut world, FilmFormat::Apng)?,
        _ => {
            let view = View::new(arguments, scene.dimension, 0.0)?;
            advance(&scene, &mut world, arguments.at)?;
            let mut bytes = Vec::new();
            view.picture(&scene, &world, None)?.image.write_png(&mut bytes)?;
            bytes
        }
    };
    target.write(&bytes)
}

/// Most pictures of a film: three minutes at 20 a second.
const MAX_FRAMES: f64 = 3600.0;

/// Pictures of a span, all by the camera that the first one chose.
fn film(
    arguments: &RenderArguments,
    scene: &Scene,
    world: &mut AnyWorld,
    format: FilmFormat,
) -> Result<Vec<u8>, Failure> {
    let rate = f64::from(arguments.frame_rate);
    let frames = (arguments.seconds * rate).round().max(1.0);
    if frames > MAX_FRAMES {
        return Err(Failure::Input(format!(
            "--seconds {} at {rate} pictures a second are {frames} pictures; at most {MAX_FRAMES} make a film",
            arguments.seconds
        )));
    }
    View::new(arguments, scene.dimension, 1.0)?;
    let mut bytes = Vec::new();
    let size = (arguments.width, arguments.height);
    let mut film = Film::new(&mut bytes, format, size, frames as u32, arguments.frame_rate)?;
    let mut progress = Progress::new("pictures of the film", frames as u64);
    let mut camera = None;
    for frame in 0..frames as u32 {
        let share = f64::from(frame) / (frames - 1.0).max(1.0);
        advance(scene, world, arguments.at + f64::from(frame) / rate)?;
        let drawn = View::new(arguments, scene.dimension, share)?.picture(scene, world, camera)?;
        film.add(&drawn.image)?;
        camera = Some(drawn.camera);
        progress.advance();
    }
    film.finish()?;
    Ok(bytes)
}

/// A picture and the camera that saw it.
struct Drawn {
    image: Image,
    camera: Camera,
}

/// Simulates up to a moment.
fn advance(scene: &Scene, world: &mut AnyWorld, seconds: f64) -> Result<(), Failure> {
    let steps = (seconds / scene.dt).round();
    if steps > f64::from(MAX_STEPS) {
        return Err(Failure::Input(format!(
            "{seconds} s are {steps} steps of {} s; at most {MAX_STEPS} steps are simulated at once",
            scene.dt
        )));
    }
    let mut progress = Progress::new(&scene.name, steps as u64);
    while world.step_count() < steps as u64 {
        world.step();
        progress.advance();
    }
    Ok(())
}

/// What the arguments say about how to look.
struct View<'a> {
    arguments: &'a RenderArguments,
    /// By the axis.
    point: Vec<f64>,
    /// Planes with angles in radians.
    turns: Vec<(usize, usize, f64)>,
}

impl<'a> View<'a> {
    /// `share` of the way from --slice to --slice-to is done.
    fn new(arguments: &'a RenderArguments, dimension: usize, share: f64) -> Result<Self, Failure> {
        let bad = |option: &str, message: String| Failure::Input(format!("{option}: {message}"));
        let mut point = vec![0.0; dimension];
        for (name, value) in arguments.slice.iter().flat_map(|list| &list.0) {
            point[arguments::axis(name, dimension).map_err(|message| bad("--slice", message))?] = *value;
        }
        let from = point.clone();
        for (name, value) in arguments.slice_to.iter().flat_map(|list| &list.0) {
            let axis = arguments::axis(name, dimension).map_err(|message| bad("--slice-to", message))?;
            point[axis] = from[axis] + (value - from[axis]) * share;
        }
        let mut turns = Vec::new();
        for (name, degrees) in arguments.turn.iter().flat_map(|list| &list.0) {
            let (i, j) = arguments::plane(name, dimension).map_err(|message| bad("--turn", message))?;
            turns.push((i, j, degrees.to_radians()));
        }
        for (option, list, counts) in [("--camera", &arguments.camera, 2..=3), ("--look-at", &arguments.look_at, 3..=3)]
        {
            if let Some(list) = list
                && !counts.contains(&list.0.len())
            {
                let (low, high) = (counts.start(), counts.end());
                let wanted = if low == high { low.to_string() } else { format!("{low} or {high}") };
                return Err(bad(option, format!("has {} numbers, expected {wanted}", list.0.len())));
            }
        }
        Ok(Self { arguments, point, turns })
    }

    /// The world as it is now; without a camera, with one that fits.
    fn picture(&self, scene: &Scene, world: &AnyWorld, camera: Option<Camera>) -> Result<Drawn, Failure> {
        let rows = 3 * u64::from(self.arguments.height);
        let progress = Mutex::new((Progress::new("drawing", rows), 0));
        let tell = |more: u64| {
            if let Ok(mut progress) = progress.lock() {
                progress.1 += more;
                let done = progress.1;
                progress.0.reach(done);
            }
        };
        let task = Draw { view: self, world, camera, caption: self.caption(scene, world), tell: &tell };
        let nothing = || Err(Failure::Work(format!("no pictures in {} dimensions", world.dimension())));
        visit_dimension(world.dimension(), task).unwrap_or_else(nothing)
    }

    fn caption(&self, scene: &Scene, world: &AnyWorld) -> Vec<String> {
        if self.arguments.no_caption {
            return Vec::new();
        }
        let mut second = format!("t = {:.2} s", world.time());
        for hidden in 3..scene.dimension {
            second += &format!("   {} = {:.2}", planes::AXIS_NAMES[hidden], self.point[hidden]);
        }
        for (i, j, angle) in &self.turns {
            second += &format!("   {} turned {}°", planes::name(*i, *j), number(angle.to_degrees()));
        }
        vec![format!("{}, {}D", scene.name, scene.dimension), second]
    }

    fn slice<const N: usize>(&self) -> Slice<N> {
        let point = Vector::from_fn(|axis| self.point.get(axis).copied().unwrap_or(0.0));
        self.turns.iter().fold(Slice::natural().moved(point), |slice, &(i, j, angle)| slice.turned(i, j, angle))
    }

    fn camera(&self, chosen: Camera) -> Camera {
        let mut camera = chosen;
        if let Some(point) = self.arguments.look_at.as_ref().and_then(|list| Vector::from_slice(&list.0)) {
            camera.eye += point - camera.target;
            camera.target = point;
        }
        let mut distance = camera.eye.distance(camera.target);
        if let Some(degrees) = self.arguments.field_of_view {
            let tangent = |angle: f64| hyperbody::math::scalar::tan(0.5 * angle);
            distance *= tangent(camera.field_of_view) / tangent(degrees.to_radians());
            camera.eye = camera.target + (camera.eye - camera.target).normalize_or_zero() * distance;
            camera.field_of_view = degrees.to_radians();
        }
        if let Some(list) = &self.arguments.camera {
            let distance = list.0.get(2).copied().unwrap_or(distance);
            let (around, above) = (list.0[0].to_radians(), list.0[1].to_radians());
            let field_of_view = camera.field_of_view;
            camera = Camera { field_of_view, ..Camera::around(camera.target, camera.up, distance, around, above) };
        }
        camera
    }
}

/// Drawing, in the dimension of the world.
struct Draw<'a> {
    view: &'a View<'a>,
    world: &'a AnyWorld,
    camera: Option<Camera>,
    caption: Vec<String>,
    tell: &'a (dyn Fn(u64) + Sync),
}

impl DimensionVisitor for Draw<'_> {
    type Output = Result<Drawn, Failure>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        let arguments = self.view.arguments;
        let world = self.world.get::<N>().ok_or_else(|| Failure::Work("the world has another dimension".to_owned()))?;
        let slice = self.view.slice::<N>();
        let aspect = f64::from(arguments.width) / f64::from(arguments.height);
        let camera = self.camera.unwrap_or_else(|| self.view.camera(frame_bodies(world, &slice, aspect)));
        let settings = Settings {
            width: arguments.width,
            height: arguments.height,
            light_rays: arguments.quality,
            ghosts: !arguments.no_ghosts,
            strip: !arguments.no_strip,
            caption: self.caption,
            threads: arguments.threads.map_or(0, usize::from),
            ..Settings::default()
        };
        let image = draw(world, &slice, Some(&camera), &settings, self.tell)?;
        Ok(Drawn { image, camera })
    }
}

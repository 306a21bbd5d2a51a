//! Where the bodies are when: from a scene that is simulated, or from a recording.

use std::path::PathBuf;

use hyperbody::math::{Dim, EvenAlgebra, Pose};
use hyperbody_render::Bodies;
use hyperbody_scene::recording::Frame;
use hyperbody_scene::{AnyWorld, Scene};

use crate::arguments::MAX_STEPS;
use crate::failure::Failure;
use crate::output::number;
use crate::progress::Progress;
use crate::source::{self, Recording, recording_failure};

/// A simulation at any moment.
pub(super) struct Timeline {
    name: String,
    argument: String,
    /// The world before its first step: what there is. A recording and a simulation then differ in nothing but where the
    /// poses come from, and give the same pictures to the last bit.
    start: AnyWorld,
    /// Of the bodies, as far as the scene gives them.
    colours: Vec<Option<[f64; 3]>>,
    kind: Kind,
}

enum Kind {
    /// Steps forwards only.
    Simulated {
        scene: Box<Scene>,
        world: Box<AnyWorld>,
        threads: usize,
    },
    Recorded(Box<Recording>),
}

impl Timeline {
    /// The timeline of a scene or a recording.
    pub(super) fn open(argument: &str, threads: Option<u16>) -> Result<Self, Failure> {
        let threads = usize::from(threads.unwrap_or(1));
        if let Some(recording) = source::recording(argument)? {
            if recording.frame_count() == 0 {
                return Err(Failure::Input(format!("{argument}: the recording holds no frame")));
            }
            let start = AnyWorld::new(recording.scene(), 1)
                .map_err(|error| Failure::Input(format!("{argument}: the scene in the recording: {error}")))?;
            let (name, colours) = (recording.scene().name.clone(), colours(recording.scene()));
            let kind = Kind::Recorded(Box::new(recording));
            return Ok(Self { name, argument: argument.to_owned(), start, colours, kind });
        }
        source::refuse_other("a scene, a .json file, or a recording", argument)?;
        let scene = source::scene(argument)?;
        let start = AnyWorld::new(&scene, 1)?;
        let world = Box::new(AnyWorld::new(&scene, threads)?);
        let kind = Kind::Simulated { scene: Box::new(scene.clone()), world, threads };
        let colours = colours(&scene);
        Ok(Self { name: scene.name, argument: argument.to_owned(), start, colours, kind })
    }

    /// The files that the scene was read from, itself first; of a recording none beside it.
    pub(super) fn files(&self) -> Result<Vec<PathBuf>, Failure> {
        match &self.kind {
            Kind::Simulated { scene, .. } => source::files_of(scene),
            Kind::Recorded(_) => Ok(vec![PathBuf::from(&self.argument)]),
        }
    }

    /// What the scene is called.
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    pub(super) fn dimension(&self) -> usize {
        self.start.dimension()
    }

    /// What a body is called, by its number.
    pub(super) fn body_name(&self, body: usize) -> &str {
        self.start.body_names().get(body).map_or("", String::as_str)
    }

    /// From a moment to the end, s; a simulation has none.
    pub(super) fn left_after(&self, seconds: f64) -> Option<f64> {
        let (_, last) = self.span();
        last.is_finite().then(|| (last - seconds).max(0.0))
    }

    /// The first and the last moment that there is, s; a simulation has no last one.
    fn span(&self) -> (f64, f64) {
        match &self.kind {
            Kind::Simulated { .. } => (0.0, f64::INFINITY),
            Kind::Recorded(recording) => {
                let (first, last) = recording.steps().unwrap_or_default();
                (first as f64 * self.start.dt(), last as f64 * self.start.dt())
            }
        }
    }

    /// This moment, or the last one that there is.
    pub(super) fn up_to(&self, seconds: f64) -> f64 {
        let (first, last) = self.span();
        seconds.clamp(first, last)
    }

    /// Says whether there is a moment, before the work.
    pub(super) fn check(&self, seconds: f64) -> Result<(), Failure> {
        let (first, last) = self.span();
        let dt = self.start.dt();
        // Half a step beyond an end is still nearest to it.
        if !(first - 0.5 * dt..=last + 0.5 * dt).contains(&seconds) {
            return Err(Failure::Input(format!(
                "{}: the recording goes from {} s to {} s, and {} s is not in it",
                self.argument,
                number(first),
                number(last),
                number(seconds)
            )));
        }
        let steps = (seconds / dt).round();
        if steps > f64::from(MAX_STEPS) {
            return Err(Failure::Input(format!(
                "{seconds} s are {steps} steps of {dt} s; at most {MAX_STEPS} steps are simulated at once"
            )));
        }
        Ok(())
    }

    /// The number of the step at a moment.
    fn step_at(&self, seconds: f64) -> Result<u64, Failure> {
        self.check(seconds)?;
        Ok((seconds / self.start.dt()).round() as u64)
    }

    /// The bodies at a moment, or at the nearest step that there is. A simulation cannot go back.
    pub(super) fn moment(&mut self, seconds: f64) -> Result<Frame, Failure> {
        let step = self.step_at(seconds)?;
        match &mut self.kind {
            Kind::Simulated { world, .. } => {
                step_to(world, step, None);
                Ok(Frame::of(world))
            }
            Kind::Recorded(recording) => {
                let frame =
                    recording.nearest_to_step(step).map_err(|error| recording_failure(&self.argument, &error))?;
                frame.ok_or_else(|| Failure::Input(format!("{}: the recording holds no frame", self.argument)))
            }
        }
    }

    /// The bodies at moments in ascending order.
    pub(super) fn moments(&mut self, moments: &[f64]) -> Result<Vec<Frame>, Failure> {
        let steps = moments.iter().map(|&moment| self.step_at(moment)).collect::<Result<Vec<u64>, Failure>>()?;
        match &mut self.kind {
            Kind::Simulated { world, .. } => Ok(simulate(world, &steps, &self.name)),
            Kind::Recorded(_) => moments.iter().map(|&moment| self.moment(moment)).collect(),
        }
    }

    /// As [`Timeline::moments`], while the simulation itself stays where it is.
    pub(super) fn look_ahead(&mut self, moments: &[f64]) -> Result<Vec<Frame>, Failure> {
        let Kind::Simulated { scene, threads, .. } = &self.kind else { return self.moments(moments) };
        let mut ahead = AnyWorld::new(scene, *threads)?;
        let steps = moments.iter().map(|&moment| self.step_at(moment)).collect::<Result<Vec<u64>, Failure>>()?;
        Ok(simulate(&mut ahead, &steps, &self.name))
    }

    /// Bytes of the poses at one moment, if looking there again means simulating again.
    pub(super) fn bytes_per_moment(&self) -> Option<u64> {
        let numbers = self.start.body_names().len() * Frame::numbers(self.dimension());
        matches!(self.kind, Kind::Simulated { .. }).then_some(8 * numbers as u64)
    }

    /// The hash of the simulation's state at the last moment that was asked for; a recording has none.
    pub(super) fn state_hash(&self) -> Option<u64> {
        match &self.kind {
            Kind::Simulated { world, .. } => Some(world.state_hash()),
            Kind::Recorded(_) => None,
        }
    }

    /// What there is to see, where it is in a frame.
    pub(super) fn bodies<const N: usize>(&self, frame: &Frame) -> Result<Bodies<N>, Failure>
    where
        Dim<N>: EvenAlgebra,
    {
        let world = self.start.get::<N>();
        let world = world.ok_or_else(|| Failure::Work("the world has another dimension".to_owned()))?;
        let mut bodies = Bodies::of(world).coloured(self.colours.iter().copied());
        let poses: Option<Vec<Pose<N>>> = (0..frame.body_count()).map(|body| frame.pose(body)).collect();
        let poses = poses.ok_or_else(|| {
            Failure::Input(format!("{}: step {} holds a matrix that is no rotation", self.argument, frame.step))
        })?;
        bodies.place(&poses)?;
        Ok(bodies)
    }
}

fn colours(scene: &Scene) -> Vec<Option<[f64; 3]>> {
    scene.bodies.iter().map(|body| body.colour).collect()
}

/// The bodies at these steps, which ascend.
fn simulate(world: &mut AnyWorld, steps: &[u64], name: &str) -> Vec<Frame> {
    let last = steps.last().copied().unwrap_or(0);
    let mut progress = Progress::new(&format!("simulating {name}"), last.saturating_sub(world.step_count()));
    let at = |&step: &u64| {
        step_to(world, step, Some(&mut progress));
        Frame::of(world)
    };
    steps.iter().map(at).collect()
}

fn step_to(world: &mut AnyWorld, step: u64, mut progress: Option<&mut Progress>) {
    while world.step_count() < step {
        world.step();
        if let Some(progress) = &mut progress {
            progress.advance();
        }
    }
}

//! A world whose dimension is known at run time only.

use std::any::Any;

use hyperbody::math::{Dim, EvenAlgebra, planes};
use hyperbody::prelude::{Bivector, BodyHandle, Energy, Snapshot, StageTimings, World};
use serde::ser::{Serialize, Serializer};

use crate::build;
use crate::dimension::{DIMENSIONS, DimensionVisitor, visit_dimension};
use crate::error::SceneError;
use crate::model::Scene;

/// A world of two to six dimensions, built from a [`Scene`]: what programs that read scenes step and ask. For what only
/// a [`World`] offers, see [`AnyWorld::get`].
pub struct AnyWorld {
    dimension: usize,
    names: Vec<String>,
    simulation: Box<dyn Simulation>,
}

/// Numbers by plane, in lexicographic order of the planes; serialised as an object with a key per plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Planes(pub Vec<(String, f64)>);

/// Where a body is and how it moves, in lists as long as the dimension.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct BodyState {
    /// Its name, or "body N".
    pub name: String,
    /// Of the origin of its frame, m.
    pub position: Vec<f64>,
    /// Of its centre of mass, m/s.
    pub velocity: Vec<f64>,
    /// Rows of the matrix that turns body axes into world axes.
    pub rotation: Vec<Vec<f64>>,
    /// By world planes, rad/s.
    pub angular_velocity: Planes,
    /// Whether it is asleep.
    pub sleeping: bool,
}

/// The whole state of an [`AnyWorld`] at one moment; see [`Snapshot`].
pub struct AnySnapshot {
    pub(crate) dimension: usize,
    pub(crate) state: Box<dyn Any + Send>,
}

/// What a world of any dimension can do.
trait Simulation: Send {
    fn as_any(&self) -> &dyn Any;
    fn as_any_mut(&mut self) -> &mut dyn Any;
    fn step(&mut self);
    fn measure_penetration(&mut self) -> f64;
    fn set_clock(&mut self, clock: Option<fn() -> f64>);
    fn summary(&self) -> Summary;
    fn momentum(&self) -> Vec<f64>;
    fn angular_momentum(&self) -> Planes;
    fn state_hash(&self) -> u64;
    fn snapshot(&self) -> Box<dyn Any + Send>;
    /// Whether the state was one of this dimension, and is the world's now.
    fn restore(&mut self, state: &dyn Any) -> bool;
    fn quarantined(&self) -> Vec<usize>;
    fn body_state(&self, index: usize, name: &str) -> Option<BodyState>;
}

/// The numbers that do not depend on the dimension.
struct Summary {
    time: f64,
    step_count: u64,
    dt: f64,
    energy: Energy,
    contact_count: usize,
    max_penetration: f64,
    timings: StageTimings,
}

/// A world and the handles of the scene's bodies, in the order of the scene.
struct Simulated<const N: usize> {
    world: World<N>,
    handles: Vec<BodyHandle>,
}

struct Build<'a> {
    scene: &'a Scene,
    threads: usize,
}

impl DimensionVisitor for Build<'_> {
    type Output = Result<Box<dyn Simulation>, SceneError>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        let (world, handles) = build::world::<N>(self.scene, self.threads)?;
        Ok(Box::new(Simulated { world, handles }))
    }
}

impl AnyWorld {
    /// Checks a scene and builds its world, on `threads` threads; the results are the same bits for every number.
    ///
    /// # Errors
    /// If the dimension is not in 2..=6, a list has the wrong length, a number is out of range, a name stands for nothing
    /// or for two things, or a shape cannot be made. The message says where in the scene, what, and what would be right.
    pub fn new(scene: &Scene, threads: usize) -> Result<Self, SceneError> {
        let build = Build { scene, threads };
        let simulation = visit_dimension(scene.dimension, build).unwrap_or_else(|| {
            let (lowest, highest) = (DIMENSIONS.start(), DIMENSIONS.end());
            let message = format!("is {}, expected a whole number from {lowest} to {highest}", scene.dimension);
            Err(SceneError::value("dimension", message))
        });
        let simulation = simulation.map_err(|error| error.in_file(scene.file.as_deref()))?;
        Ok(Self { dimension: scene.dimension, names: scene.body_names(), simulation })
    }

    /// Number of axes.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The world itself, if it has `N` dimensions. Code for every dimension calls this inside
    /// [`visit_dimension`](crate::visit_dimension).
    #[must_use]
    pub fn get<const N: usize>(&self) -> Option<&World<N>> {
        self.simulation.as_any().downcast_ref::<Simulated<N>>().map(|simulated| &simulated.world)
    }

    /// The world itself, if it has `N` dimensions, to push its bodies about.
    #[must_use]
    pub fn get_mut<const N: usize>(&mut self) -> Option<&mut World<N>> {
        self.simulation.as_any_mut().downcast_mut::<Simulated<N>>().map(|simulated| &mut simulated.world)
    }

    /// The handles of the scene's bodies in the order of the scene, if the world has `N` dimensions.
    #[must_use]
    pub fn handles<const N: usize>(&self) -> Option<&[BodyHandle]> {
        self.simulation.as_any().downcast_ref::<Simulated<N>>().map(|simulated| simulated.handles.as_slice())
    }

    /// The names of the scene's bodies in the order of the scene.
    #[must_use]
    pub fn body_names(&self) -> &[String] {
        &self.names
    }

    /// Moves the world on by one step; see [`World::step`].
    pub fn step(&mut self) {
        self.simulation.step();
    }

    /// Simulated time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.simulation.summary().time
    }

    /// Number of steps taken.
    #[must_use]
    pub fn step_count(&self) -> u64 {
        self.simulation.summary().step_count
    }

    /// Length of a step, s.
    #[must_use]
    pub fn dt(&self) -> f64 {
        self.simulation.summary().dt
    }

    /// Energy of the dynamic bodies, J.
    #[must_use]
    pub fn energy(&self) -> Energy {
        self.simulation.summary().energy
    }

    /// Momentum of the dynamic bodies, kg·m/s.
    #[must_use]
    pub fn momentum(&self) -> Vec<f64> {
        self.simulation.momentum()
    }

    /// Angular momentum of the dynamic bodies about the origin, kg·m²/s.
    #[must_use]
    pub fn angular_momentum(&self) -> Planes {
        self.simulation.angular_momentum()
    }

    /// Number of touching contact points in the last step.
    #[must_use]
    pub fn contact_count(&self) -> usize {
        self.simulation.summary().contact_count
    }

    /// Deepest overlap at the start of the last step, m.
    #[must_use]
    pub fn max_penetration(&self) -> f64 {
        self.simulation.summary().max_penetration
    }

    /// Deepest overlap at the present positions, m.
    pub fn measure_penetration(&mut self) -> f64 {
        self.simulation.measure_penetration()
    }

    /// Names of the bodies whose state turned non-finite, in the order in which it happened.
    #[must_use]
    pub fn quarantined(&self) -> Vec<&str> {
        self.simulation.quarantined().into_iter().map(|index| self.names[index].as_str()).collect()
    }

    /// Hash of the whole state, equal for equal bits.
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        self.simulation.state_hash()
    }

    /// The state as it is now, to go back to.
    #[must_use]
    pub fn snapshot(&self) -> AnySnapshot {
        AnySnapshot { dimension: self.dimension, state: self.simulation.snapshot() }
    }

    /// Goes back, or on, to a snapshot of a world of the same scene: from here this world does to the bit what that one did. A
    /// snapshot of another scene is taken, too, and the names of bodies stand for nothing then.
    ///
    /// # Errors
    /// If the snapshot is of a world of another dimension; this world stays as it is.
    pub fn restore(&mut self, snapshot: &AnySnapshot) -> Result<(), SceneError> {
        if self.simulation.restore(snapshot.state.as_ref()) {
            return Ok(());
        }
        let message = format!("of the snapshot is {}, of this world {}", snapshot.dimension, self.dimension);
        Err(SceneError::value("dimension", message))
    }

    /// Gives the world a clock in seconds, from which [`AnyWorld::timings`] are taken.
    pub fn set_clock(&mut self, clock: Option<fn() -> f64>) {
        self.simulation.set_clock(clock);
    }

    /// Where the time of the last step went.
    #[must_use]
    pub fn timings(&self) -> StageTimings {
        self.simulation.summary().timings
    }

    /// The state of every body in the order of the scene; bodies that were removed are left out.
    #[must_use]
    pub fn body_states(&self) -> Vec<BodyState> {
        let states = self.names.iter().enumerate().map(|(index, name)| self.simulation.body_state(index, name));
        states.flatten().collect()
    }
}

impl<const N: usize> Simulation for Simulated<N> {
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }

    fn step(&mut self) {
        self.world.step();
    }

    fn measure_penetration(&mut self) -> f64 {
        self.world.measure_penetration()
    }

    fn set_clock(&mut self, clock: Option<fn() -> f64>) {
        self.world.set_clock(clock);
    }

    fn summary(&self) -> Summary {
        Summary {
            time: self.world.time(),
            step_count: self.world.step_count(),
            dt: self.world.dt(),
            energy: self.world.energy(),
            contact_count: self.world.contact_count(),
            max_penetration: self.world.max_penetration(),
            timings: self.world.timings(),
        }
    }

    fn momentum(&self) -> Vec<f64> {
        self.world.momentum().iter().collect()
    }

    fn angular_momentum(&self) -> Planes {
        Planes::from_bivector(&self.world.angular_momentum())
    }

    fn state_hash(&self) -> u64 {
        self.world.state_hash()
    }

    fn snapshot(&self) -> Box<dyn Any + Send> {
        Box::new(self.world.snapshot())
    }

    fn restore(&mut self, state: &dyn Any) -> bool {
        let snapshot = state.downcast_ref::<Snapshot<N>>();
        if let Some(snapshot) = snapshot {
            self.world.restore(snapshot);
        }
        snapshot.is_some()
    }

    fn quarantined(&self) -> Vec<usize> {
        let index = |handle: &BodyHandle| self.handles.iter().position(|known| known == handle);
        self.world.quarantined().iter().filter_map(index).collect()
    }

    fn body_state(&self, index: usize, name: &str) -> Option<BodyState> {
        let body = self.world.body(*self.handles.get(index)?)?;
        let rotation = body.rotation();
        Some(BodyState {
            name: name.to_owned(),
            position: body.position().iter().collect(),
            velocity: body.velocity().iter().collect(),
            rotation: (0..N).map(|row| rotation.matrix().row(row).iter().collect()).collect(),
            angular_velocity: Planes::from_bivector(&body.angular_velocity()),
            sleeping: body.is_sleeping(),
        })
    }
}

impl Planes {
    /// The numbers of a bivector.
    #[must_use]
    pub fn from_bivector<const N: usize>(bivector: &Bivector<N>) -> Self {
        Self(planes::all(N).map(|(i, j)| (planes::name(i, j), bivector.get(i, j))).collect())
    }
}

impl Serialize for Planes {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(plane, value)| (plane, value)))
    }
}

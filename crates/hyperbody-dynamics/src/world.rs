//! The world: what goes in, what can be asked.

use std::sync::Arc;

use hyperbody_collision::{DynamicTree, Scratch};
use hyperbody_geometry::Aabb;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Pose, Vector};

use crate::balls::Plain;
use crate::body::{Body, prepare};
use crate::continuous::{Continuous, PieceCore};
use crate::events::Events;
use crate::filter::IgnoredPairs;
use crate::handle::Arena;
use crate::integrate::Integrated;
use crate::islands::Islands;
use crate::joint::Joint;
use crate::narrow_phase::Found;
use crate::near::Near;
use crate::pairs::{Pair, PairRole, Pairs};
use crate::rules::Hook;
use crate::seams::Seams;
use crate::solver::Solver;
use crate::threads::{Pool, pieces};
use crate::vetting::POSITION_LIMIT;
use crate::{
    BodyDef, BodyHandle, BodyKind, BodyMut, BodyRef, JointHandle, StageTimings, Tuning, WorldError, WorldErrorKind,
};

/// Everything needed to make a world.
#[derive(Clone, Debug)]
pub struct WorldDef<const N: usize> {
    /// m/s². Default: 9.81 downwards along the second axis.
    pub gravity: Vector<N>,
    /// Length of a step in seconds, 1e-6..=1, and at most 0.04 a substep. Default 1/60.
    pub dt: f64,
    /// Parts into which the solver divides a step, 1..=64. Default 4. More make stacks stiffer, at proportional cost.
    pub substeps: u32,
    /// Whether bodies at rest may fall asleep. Default true.
    pub sleeping: bool,
    /// Threads, 1..=256. Default 1. The results are the same bits for every number.
    pub threads: usize,
    /// See [`Tuning`].
    pub tuning: Tuning,
}

impl<const N: usize> Default for WorldDef<N> {
    fn default() -> Self {
        Self {
            gravity: Vector::from_fn(|i| if i == 1 { -9.81 } else { 0.0 }),
            dt: 1.0 / 60.0,
            substeps: 4,
            sleeping: true,
            threads: 1,
            tuning: Tuning::default(),
        }
    }
}

/// Longest substep, s. The contact spring can be no stiffer than a quarter of the substep rate: with longer ones, resting
/// bodies would sink by more than a centimetre.
const LONGEST_SUBSTEP: f64 = 0.04;

/// A convex piece of a body, as collision sees it.
#[derive(Clone, Debug)]
pub(crate) struct Collider<const N: usize> {
    pub(crate) body: u32,
    pub(crate) piece: Piece<N>,
    pub(crate) body_from_collider: Pose<N>,
    /// At the start of the current step.
    pub(crate) world_from_collider: Pose<N>,
    /// Largest distance of a point of the piece from the origin of its frame, m; zero for half-spaces.
    pub(crate) reach: f64,
    /// What must not pass through others.
    pub(crate) core: PieceCore<N>,
    /// In the tree; `None` for half-spaces, which are unbounded and kept in a list.
    pub(crate) proxy: Option<u32>,
    /// The fattened box that the tree holds.
    pub(crate) fat_aabb: Aabb<N>,
}

impl<const N: usize> Collider<N> {
    /// Radius by which its core is rounded, m.
    pub(crate) fn rounding(&self) -> f64 {
        match &self.piece {
            Piece::Convex(convex) => convex.radius,
            Piece::HalfSpace { .. } => 0.0,
        }
    }
}

/// How a collider moves, beside it: the pairs ask for this at every step, and for the rest seldom.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<const N: usize> {
    /// Length of the way that the farthest-going of its points has come, at most, m; only grows.
    pub(crate) way: f64,
    /// Speed of its fastest point, at most, m/s; infinite in quarantine, where nothing that was known holds.
    pub(crate) speed: f64,
    /// Of its body, m/s; of this step alone.
    pub(crate) velocity: Vector<N>,
    /// Whether its body may move in this step.
    pub(crate) awake: bool,
    /// Whether it is a ball or a half-space, and stands in `World::plain` as it is in this step.
    pub(crate) plain: bool,
    /// Whether its pairs must be looked for: it is new, or out of its fattened box.
    pub(crate) moved: bool,
}

/// Bodies, joints, and the law that moves them, in `N` dimensions.
pub struct World<const N: usize> {
    pub(crate) gravity: Vector<N>,
    pub(crate) dt: f64,
    pub(crate) substeps: u32,
    pub(crate) sleeping: bool,
    pub(crate) tuning: Tuning,

    pub(crate) bodies: Arena<Body<N>, BodyHandle>,
    pub(crate) joints: Arena<Joint<N>, JointHandle>,
    pub(crate) colliders: Vec<Option<Collider<N>>>,
    /// One a collider.
    pub(crate) motions: Vec<Motion<N>>,
    /// One a collider; of this step alone.
    pub(crate) plain: Vec<Plain<N>>,
    pub(crate) free_colliders: Vec<u32>,
    /// Slots of half-space colliders, ascending.
    pub(crate) half_spaces: Vec<u32>,
    pub(crate) tree: DynamicTree<N>,
    pub(crate) pairs: Pairs<N>,
    /// Pairs of bodies that were switched off.
    pub(crate) ignored: IgnoredPairs,
    pub(crate) islands: Islands,
    pub(crate) events: Events<N>,

    pub(crate) step_count: u64,
    pub(crate) max_penetration: f64,
    pub(crate) contact_count: usize,
    pub(crate) quarantined: Vec<BodyHandle>,
    /// Slots of bodies to wake at the start of the next step.
    pub(crate) wake_requests: Vec<u32>,
    pub(crate) timings: StageTimings,
    pub(crate) clock: Option<fn() -> f64>,
    pub(crate) hook: Option<Hook<N>>,

    pub(crate) pool: Option<Arc<Pool>>,
    pub(crate) solver: Solver<N>,
    pub(crate) scratch: Vec<Scratch<N>>,
    /// One a piece of work: see [`pieces`].
    pub(crate) found: Vec<Found>,
    pub(crate) integrated: Vec<Integrated>,
    /// Buffers of the search for neighbours.
    pub(crate) near: Near<N>,
    pub(crate) seams: Seams<N>,
    /// Buffers of the sweeps.
    pub(crate) continuous: Continuous<N>,
    /// Buffer of the broad phase.
    pub(crate) new_pairs: Vec<(u32, u32)>,
}

impl<const N: usize> World<N> {
    /// An empty world.
    ///
    /// # Errors
    /// If a number of the definition is outside its range, or the threads cannot be started.
    pub fn new(def: WorldDef<N>) -> Result<Self, WorldError> {
        const { assert!(N >= 2 && N <= 6, "worlds have two to six dimensions") };
        if !def.gravity.is_finite() {
            return Err(WorldError::bad_number(format!("gravity is {:?}; it must be finite", def.gravity.0)));
        }
        if !(1e-6..=1.0).contains(&def.dt) {
            return Err(WorldError::bad_number(format!("dt is {} s; it must lie between 1e-6 and 1", def.dt)));
        }
        if !(1..=64).contains(&def.substeps) {
            return Err(WorldError::bad_number(format!("substeps is {}; it must lie between 1 and 64", def.substeps)));
        }
        if def.dt / f64::from(def.substeps) > LONGEST_SUBSTEP {
            return Err(WorldError::bad_number(format!(
                "dt is {} s in {} substeps; contacts need substeps of at most {LONGEST_SUBSTEP} s: take {} substeps or a shorter dt",
                def.dt,
                def.substeps,
                (def.dt / LONGEST_SUBSTEP).ceil()
            )));
        }
        if !(1..=256).contains(&def.threads) {
            return Err(WorldError::bad_number(format!("threads is {}; it must lie between 1 and 256", def.threads)));
        }
        def.tuning.validate()?;
        let pool = if def.threads > 1 {
            Some(Arc::new(Pool::new(def.threads).map_err(|error| {
                WorldError::new(WorldErrorKind::NotAllowed, format!("{} threads: {error}", def.threads))
            })?))
        } else {
            None
        };
        let pieces = pieces(def.threads);
        Ok(Self {
            gravity: def.gravity,
            dt: def.dt,
            substeps: def.substeps,
            sleeping: def.sleeping,
            tuning: def.tuning,
            bodies: Arena::new(),
            joints: Arena::new(),
            colliders: Vec::new(),
            motions: Vec::new(),
            plain: Vec::new(),
            free_colliders: Vec::new(),
            half_spaces: Vec::new(),
            tree: DynamicTree::new(),
            pairs: Pairs::new(),
            ignored: IgnoredPairs::new(),
            islands: Islands::new(),
            events: Events::new(),
            step_count: 0,
            max_penetration: 0.0,
            contact_count: 0,
            quarantined: Vec::new(),
            wake_requests: Vec::new(),
            timings: StageTimings::default(),
            clock: None,
            hook: None,
            pool,
            solver: Solver::new(),
            scratch: (0..pieces).map(|_| Scratch::default()).collect(),
            found: (0..pieces).map(|_| Found::default()).collect(),
            integrated: (0..pieces).map(|_| Integrated::default()).collect(),
            near: Near::default(),
            seams: Seams::default(),
            continuous: Continuous::default(),
            new_pairs: Vec::new(),
        })
    }

    /// Adds a body.
    ///
    /// # Errors
    /// If the definition is not valid (see [`BodyDef`]); nothing is added then.
    pub fn add_body(&mut self, def: BodyDef<N>) -> Result<BodyHandle, WorldError> {
        let (body, pieces) = prepare(def)?;
        let full = || WorldError::new(WorldErrorKind::Full, "the world has no more room for bodies");
        let handle = self.bodies.insert(body).map_err(|_| full())?;
        for (body_from_collider, piece) in pieces {
            self.add_collider(handle.index, body_from_collider, piece);
        }
        Ok(handle)
    }

    pub(crate) fn add_collider(&mut self, body_slot: u32, body_from_collider: Pose<N>, piece: Piece<N>) {
        let Some(body) = self.bodies.at_mut(body_slot) else { return };
        let slot = self.free_colliders.pop().unwrap_or_else(|| {
            self.colliders.push(None);
            let velocity = Vector::ZERO;
            self.motions.push(Motion { way: 0.0, speed: 0.0, velocity, awake: false, plain: false, moved: true });
            #[expect(clippy::cast_possible_truncation, reason = "fewer colliders than fit into memory")]
            let last = (self.colliders.len() - 1) as u32;
            last
        });
        body.colliders.push(slot);
        let world_from_collider = body.world_from_body() * body_from_collider;
        let (fat_aabb, proxy) = match &piece {
            Piece::Convex(convex) => {
                let aabb = convex.aabb(&world_from_collider).grown(self.tuning.tree_margin);
                (aabb, Some(self.tree.insert(aabb, slot)))
            }
            Piece::HalfSpace { .. } => {
                let position = self.half_spaces.partition_point(|&other| other < slot);
                self.half_spaces.insert(position, slot);
                (Aabb { lower: Vector::ZERO, upper: Vector::ZERO }, None)
            }
        };
        let core = PieceCore::of(&piece);
        body.core_radius = body.core_radius.min(core.radius);
        let reach = match &piece {
            Piece::Convex(convex) => convex.bounding_radius(),
            Piece::HalfSpace { .. } => 0.0,
        };
        self.colliders[slot as usize] = Some(Collider {
            body: body_slot,
            piece,
            body_from_collider,
            world_from_collider,
            reach,
            core,
            proxy,
            fat_aabb,
        });
        self.motions[slot as usize].moved = true;
    }

    /// Removes a body with its joints and contacts; what rested on it wakes.
    ///
    /// # Errors
    /// If there is no such body.
    pub fn remove_body(&mut self, handle: BodyHandle) -> Result<(), WorldError> {
        let Some(body) = self.bodies.get(handle) else { return Err(stale("body")) };
        let joints: Vec<JointHandle> = body.joints.iter().filter_map(|&slot| self.joints.handle_at(slot)).collect();
        for joint in joints {
            self.remove_joint(joint)?;
        }
        self.forget_contacts_of(handle.index);
        let Some(body) = self.bodies.remove(handle) else { return Err(stale("body")) };
        self.remove_colliders(body.colliders);
        self.ignored.forget_body(handle.index);
        self.quarantined.retain(|&other| other != handle);
        Ok(())
    }

    /// Drops the pairs of a body, and wakes it and what it touched.
    pub(crate) fn forget_contacts_of(&mut self, slot: u32) {
        let touches = |pair: &&Pair<N>| pair.role != PairRole::Sensor && (pair.body_a == slot || pair.body_b == slot);
        for pair in self.pairs.iter().filter(touches) {
            let partner = if pair.body_a == slot { pair.body_b } else { pair.body_a };
            if self.bodies.at(partner).is_some_and(|body| body.kind == BodyKind::Dynamic) {
                self.wake_requests.push(partner);
            }
        }
        self.drop_pairs(|_, pair| pair.body_a != slot && pair.body_b != slot);
        self.islands.wake_body(slot, &mut self.bodies);
    }

    pub(crate) fn remove_colliders(&mut self, slots: Vec<u32>) {
        for slot in slots {
            self.motions[slot as usize].moved = false;
            if let Some(collider) = self.colliders[slot as usize].take() {
                match collider.proxy {
                    Some(proxy) => self.tree.remove(proxy),
                    None => self.half_spaces.retain(|&other| other != slot),
                }
            }
            self.free_colliders.push(slot);
        }
    }

    /// A body to read, or `None` if the handle is stale.
    #[must_use]
    pub fn body(&self, handle: BodyHandle) -> Option<BodyRef<'_, N>> {
        self.bodies.get(handle).map(|body| BodyRef { body })
    }

    /// A body to change, or `None` if the handle is stale.
    #[must_use]
    pub fn body_mut(&mut self, handle: BodyHandle) -> Option<BodyMut<'_, N>> {
        let body = self.bodies.get_mut(handle)?;
        body.vetted = false;
        let (wake, quarantined) = (&mut self.wake_requests, &mut self.quarantined);
        Some(BodyMut { body, wake, quarantined, slot: handle.index })
    }

    /// All bodies in the order of their slots.
    pub fn bodies(&self) -> impl Iterator<Item = (BodyHandle, BodyRef<'_, N>)> {
        self.bodies.iter().map(|(handle, body)| (handle, BodyRef { body }))
    }

    /// Number of bodies.
    #[must_use]
    pub fn body_count(&self) -> usize {
        self.bodies.len()
    }

    /// Gravity, m/s².
    #[must_use]
    pub fn gravity(&self) -> Vector<N> {
        self.gravity
    }

    /// Sets gravity, m/s², and wakes everything.
    ///
    /// # Errors
    /// If it is not finite.
    pub fn set_gravity(&mut self, gravity: impl Into<Vector<N>>) -> Result<(), WorldError> {
        let gravity = gravity.into();
        if !gravity.is_finite() {
            return Err(WorldError::bad_number(format!("gravity is {:?}; it must be finite", gravity.0)));
        }
        self.gravity = gravity;
        self.islands.wake_all(&mut self.bodies);
        Ok(())
    }

    /// Length of a step, s.
    #[must_use]
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// Number of steps taken.
    #[must_use]
    pub fn step_count(&self) -> u64 {
        self.step_count
    }

    /// Simulated time, s: steps taken times their length.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.step_count as f64 * self.dt
    }

    /// Number of contact points that touched (separation ≤ 0) when the last step looked.
    #[must_use]
    pub fn contact_count(&self) -> usize {
        self.contact_count
    }

    /// Deepest overlap of two bodies that the last step found at its start, m.
    #[must_use]
    pub fn max_penetration(&self) -> f64 {
        self.max_penetration
    }

    /// Bodies whose state turned non-finite, in the order in which it happened. They stay where they last were, out
    /// of the simulation, until they are given a new pose or removed.
    #[must_use]
    pub fn quarantined(&self) -> &[BodyHandle] {
        &self.quarantined
    }

    /// Sets the clock, in seconds, that stage timings are taken with; `None` takes none. The crate reads no clock of
    /// its own, so that it runs where there is none.
    pub fn set_clock(&mut self, clock: Option<fn() -> f64>) {
        self.clock = clock;
    }

    /// Where the time of the last step went.
    #[must_use]
    pub fn timings(&self) -> StageTimings {
        self.timings
    }
}

pub(crate) fn is_pair_of(pair_a: u32, pair_b: u32, a: u32, b: u32) -> bool {
    (pair_a == a && pair_b == b) || (pair_a == b && pair_b == a)
}

/// Largest distance of a point of the pieces from `centre`, all in the body's frame.
pub(crate) fn reach<const N: usize>(pieces: &[(Pose<N>, Piece<N>)], centre: Vector<N>) -> f64 {
    pieces.iter().fold(0.0, |reach, (pose, piece)| match piece {
        Piece::Convex(convex) => f64::max(reach, pose.translation.distance(centre) + convex.bounding_radius()),
        Piece::HalfSpace { .. } => reach,
    })
}

pub(crate) fn out_of_bounds<const N: usize>(centre: Vector<N>) -> WorldError {
    WorldError::bad_number(format!(
        "the centre of mass comes to {:?}; coordinates must lie within ±{POSITION_LIMIT:e} m",
        centre.0
    ))
}

pub(crate) fn stale(what: &str) -> WorldError {
    WorldError::new(
        WorldErrorKind::StaleHandle,
        format!(
            "there is no such {what} in this world: it was removed (handles are good only in the world that gave them)"
        ),
    )
}

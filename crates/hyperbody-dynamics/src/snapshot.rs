//! Snapshots: the whole state of a world, to go back to.
//!
//! A snapshot holds everything that the future depends on, to the bit: bodies with their momenta and timers, joints and
//! contacts with the impulses that start the next step, the shape of the dynamic tree and the order of pairs, who sleeps
//! with whom, the slots and generations from which the next handles come. What it leaves out is remade by each step (buffers of
//! the solver) or is not the world's (threads, clock, contact hook).
//!
//! [`bytes`] makes it a save game: bytes with a version and a checksum, from which any process goes on to the bit. [`Rewind`] holds one a step, to go back by so many steps.

mod assemble;
pub mod bytes;
mod check;
mod parts;
mod rewind;

use hyperbody_collision::DynamicTree;
use hyperbody_math::Vector;

use crate::body::Body;
use crate::events::Events;
use crate::filter::IgnoredPairs;
use crate::handle::Arena;
use crate::islands::Islands;
use crate::joint::Joint;
use crate::pairs::Pairs;
use crate::world::{Collider, Motion};
use crate::{BodyHandle, JointHandle, Tuning, World};
pub use rewind::Rewind;

/// The state of a world at one moment, between two steps.
///
/// Its size is about that of the world itself; shapes are shared, not copied.
#[derive(Clone, Debug)]
pub struct Snapshot<const N: usize> {
    gravity: Vector<N>,
    dt: f64,
    substeps: u32,
    sleeping: bool,
    tuning: Tuning,
    bodies: Arena<Body<N>, BodyHandle>,
    joints: Arena<Joint<N>, JointHandle>,
    colliders: Vec<Option<Collider<N>>>,
    motions: Vec<Motion<N>>,
    free_colliders: Vec<u32>,
    half_spaces: Vec<u32>,
    tree: DynamicTree<N>,
    pairs: Pairs<N>,
    ignored: IgnoredPairs,
    islands: Islands,
    events: Events<N>,
    step_count: u64,
    max_penetration: f64,
    contact_count: usize,
    quarantined: Vec<BodyHandle>,
    wake_requests: Vec<u32>,
}

impl<const N: usize> Snapshot<N> {
    /// Simulated time at which it was taken, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.step_count as f64 * self.dt
    }

    /// Number of steps taken before it.
    #[must_use]
    pub fn step_count(&self) -> u64 {
        self.step_count
    }
}

impl<const N: usize> World<N> {
    /// The state as it is now.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot<N> {
        Snapshot {
            gravity: self.gravity,
            dt: self.dt,
            substeps: self.substeps,
            sleeping: self.sleeping,
            tuning: self.tuning,
            bodies: self.bodies.clone(),
            joints: self.joints.clone(),
            colliders: self.colliders.clone(),
            motions: self.motions.clone(),
            free_colliders: self.free_colliders.clone(),
            half_spaces: self.half_spaces.clone(),
            tree: self.tree.clone(),
            pairs: self.pairs.clone(),
            ignored: self.ignored.clone(),
            islands: self.islands.clone(),
            events: self.events.clone(),
            step_count: self.step_count,
            max_penetration: self.max_penetration,
            contact_count: self.contact_count,
            quarantined: self.quarantined.clone(),
            wake_requests: self.wake_requests.clone(),
        }
    }

    /// Goes back, or on, to a snapshot, of this world or another one: from here the world does to the bit what that one did.
    /// Handles are good again as they were then; those that were given out later are to be dropped, since what is added next may
    /// get the same ones. Threads, clock and contact hook stay as they are.
    pub fn restore(&mut self, snapshot: &Snapshot<N>) {
        self.gravity = snapshot.gravity;
        self.dt = snapshot.dt;
        self.substeps = snapshot.substeps;
        self.sleeping = snapshot.sleeping;
        self.tuning = snapshot.tuning;
        self.bodies.clone_from(&snapshot.bodies);
        self.joints.clone_from(&snapshot.joints);
        self.colliders.clone_from(&snapshot.colliders);
        self.motions.clone_from(&snapshot.motions);
        self.free_colliders.clone_from(&snapshot.free_colliders);
        self.half_spaces.clone_from(&snapshot.half_spaces);
        self.tree.clone_from(&snapshot.tree);
        self.pairs.clone_from(&snapshot.pairs);
        self.ignored.clone_from(&snapshot.ignored);
        self.islands.clone_from(&snapshot.islands);
        self.events.clone_from(&snapshot.events);
        self.step_count = snapshot.step_count;
        self.max_penetration = snapshot.max_penetration;
        self.contact_count = snapshot.contact_count;
        self.quarantined.clone_from(&snapshot.quarantined);
        self.wake_requests.clone_from(&snapshot.wake_requests);
    }
}

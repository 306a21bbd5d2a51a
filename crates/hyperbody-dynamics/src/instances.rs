//! The engine of every dimension, compiled with this crate where builds are not optimised much.
//!
//! Generic code is compiled by whoever uses it: without this, each program of tests and each crate above would compile the
//! whole step five times for itself. At low optimisation the compiler takes what a crate below it has already. Fully
//! optimised builds do not share, and have nothing of this.

use crate::{BodyDef, BodyHandle, JointDef, JointHandle, Snapshot, World, WorldDef, WorldError};

/// What nearly everybody calls.
pub struct Instances<const N: usize> {
    new: fn(WorldDef<N>) -> Result<World<N>, WorldError>,
    step: fn(&mut World<N>),
    add_body: fn(&mut World<N>, BodyDef<N>) -> Result<BodyHandle, WorldError>,
    add_joint: fn(&mut World<N>, JointDef<N>) -> Result<JointHandle, WorldError>,
    remove_body: fn(&mut World<N>, BodyHandle) -> Result<(), WorldError>,
    snapshot: fn(&World<N>) -> Snapshot<N>,
    restore: fn(&mut World<N>, &Snapshot<N>),
    state_hash: fn(&World<N>) -> u64,
}

impl<const N: usize> Instances<N> {
    const ALL: Self = Self {
        new: World::new,
        step: World::step,
        add_body: World::add_body,
        add_joint: World::add_joint,
        remove_body: World::remove_body,
        snapshot: World::snapshot,
        restore: World::restore,
        state_hash: World::state_hash,
    };
}

#[doc(hidden)]
pub static PLANE: Instances<2> = Instances::ALL;
#[doc(hidden)]
pub static SPACE: Instances<3> = Instances::ALL;
#[doc(hidden)]
pub static FOUR: Instances<4> = Instances::ALL;
#[doc(hidden)]
pub static FIVE: Instances<5> = Instances::ALL;
#[doc(hidden)]
pub static SIX: Instances<6> = Instances::ALL;

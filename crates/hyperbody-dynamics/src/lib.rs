//! Rigid-body worlds in `N` dimensions, `N` = 2..=6, from one source.
//!
//! | module | holds |
//! |---|---|
//! | [`world`] | [`World`]: bodies and joints go in, `step` moves them, results are read |
//! | [`body`] | what a body is, how it is defined, read and pushed |
//! | [`queries`] | what is where: rays, points, boxes, shapes at rest and in motion |
//! | [`joint`] | what ties bodies together |
//! | [`events`] | touches, sleep and broken joints of the last step |
//! | [`filter`] | who may touch whom: groups and masks, pairs switched off |
//! | [`rules`] | sensors, one-way bodies, a say in contacts |
//! | [`snapshot`] | the whole state, to go back to, by so many steps, and as bytes |
//! | [`material`] | friction, restitution, density, resistance to rolling and twisting, rules by which two combine |
//! | [`tuning`] | every tunable number, with its reason |
//! | `step` | the stages of one step, in order |
//! | `steering` | kinematic bodies led from pose to pose |
//! | `vetting` | what users set is brought within limits |
//! | `broad_phase`, `pairs`, `narrow_phase` | who may touch whom, and where |
//! | `seams` | ghost contacts where bodies slide from one to the next |
//! | `islands`, `waking` | who rests together and falls asleep together; who wakes, and why |
//! | `solver` | contacts and joints become impulses |
//! | `continuous` | fast bodies that went through something are put back |
//! | `integrate` | impulses and forces become motion |
//!
//! Data goes one way through the step; `step.rs` is its list of stages.

mod ahead;
mod balls;
pub mod body;
mod broad_phase;
mod continuous;
mod counting;
pub mod error;
pub mod events;
pub mod filter;
pub mod free_top;
mod handle;
mod hash;
#[cfg(all(debug_assertions, not(test)))]
#[doc(hidden)]
#[expect(dead_code, reason = "it is there to be compiled")]
pub mod instances;
mod integrate;
mod islands;
pub mod joint;
pub mod material;
mod measure;
mod meetings;
mod narrow_phase;
mod near;
mod pairs;
pub mod queries;
pub mod rules;
mod seams;
pub mod snapshot;
mod solver;
mod steering;
mod step;
mod threads;
pub mod timings;
mod touches;
pub mod tuning;
mod vetting;
mod waking;
mod wandering;
pub mod world;

pub use body::{BodyDef, BodyKind, BodyMut, BodyRef};
pub use error::{WorldError, WorldErrorKind};
pub use events::{BrokenJoint, ContactEvent, ContactPhase, Events, SensorEvent, SensorPhase};
pub use filter::Groups;
pub use handle::{BodyHandle, JointHandle};
pub use joint::{Coupling, Freedom, JointDef, JointRef, Motor, Spring};
pub use material::{CombineRule, Material};
pub use measure::Energy;
pub use narrow_phase::ContactRef;
pub use queries::{BodyHit, BodyProjection, BodySeparation, BodyShapeHit, Queries, QueryFilter, QueryScratch};
pub use rules::{ContactHook, HookedContact};
pub use snapshot::bytes::{SnapshotError, SnapshotErrorKind};
pub use snapshot::{Rewind, Snapshot};
pub use timings::StageTimings;
pub use tuning::Tuning;
pub use vetting::POSITION_LIMIT;
pub use world::{World, WorldDef};

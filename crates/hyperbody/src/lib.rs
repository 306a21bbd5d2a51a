//! Rigid-body physics in any number of dimensions, two to six, from one source.
//!
//! Twenty lines from nothing to a tesseract that falls, lands and comes to rest:
//!
//! ```
//! use hyperbody::prelude::*;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut world = World::<4>::new(WorldDef::default())?;
//!
//! // The ground: all points with y ≤ 0.
//! let ground = Shape::half_space([0.0, 1.0, 0.0, 0.0], 0.0)?;
//! world.add_body(BodyDef::fixed(ground))?;
//!
//! // A tesseract with edges of one metre, turned a little into the fourth dimension.
//! let tesseract = Shape::cuboid([0.5; 4])?;
//! let dropped = world.add_body(
//!     BodyDef::new(tesseract)
//!         .position([0.0, 3.0, 0.0, 0.0])
//!         .rotation(Rotation::in_plane(0, 3, 0.4)),
//! )?;
//!
//! for _ in 0..300 {
//!     world.step();
//! }
//! let body = world.body(dropped).ok_or("it is still there")?;
//! assert!((body.position()[1] - 0.5).abs() < 0.01);
//! assert!(body.is_sleeping());
//! # Ok(())
//! # }
//! ```
//!
//! Every capability in a program of thirty lines that can be run: `cargo run --release -p hyperbody --example tour`, its source
//! in `examples/tour`. What a world can be asked is listed in `docs/queries.md`.
//!
//! | crate | holds |
//! |---|---|
//! | [`math`] | vectors, bivectors, rotors, rotations, poses |
//! | [`geometry`] | shapes, polytopes, mass properties |
//! | [`collision`] | contacts of pairs of shapes, the dynamic tree |
//! | [`dynamics`] | worlds, bodies, joints, the step, free rotation |

pub use hyperbody_collision as collision;
pub use hyperbody_dynamics as dynamics;
pub use hyperbody_geometry as geometry;
pub use hyperbody_math as math;

/// The examples of the page on queries, which have to run.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/queries.md")]
mod queries_page {}

/// What most programs need.
pub mod prelude {
    pub use hyperbody_collision::Ray;
    pub use hyperbody_collision::query::Motion;
    pub use hyperbody_dynamics::{
        BodyDef, BodyHandle, BodyKind, BodyMut, BodyRef, CombineRule, ContactEvent, ContactHook, ContactPhase,
        Coupling, Energy, Events, Freedom, Groups, HookedContact, JointDef, JointHandle, JointRef, Material, Motor,
        QueryFilter, QueryScratch, Rewind, SensorEvent, SensorPhase, Snapshot, SnapshotError, Spring, StageTimings,
        Tuning, World, WorldDef, WorldError,
    };
    pub use hyperbody_geometry::{GeometryError, Polytope, Shape};
    pub use hyperbody_math::{Bivector, Matrix, Pose, Rotation, Rotor, Vector};
}

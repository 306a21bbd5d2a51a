//! What two shapes have to do with each other, and a shape with a point: questions that leave no trace.
//!
//! | question | function |
//! |---|---|
//! | do they have a point in common? | [`overlap`] |
//! | how far apart are they, and where? | [`closest`] |
//! | how far apart, or how deep in each other? | [`separation`] |
//! | which point of a shape is nearest to a given one? | [`project`] |
//! | when does a moving and turning shape meet another? | [`shape_cast`], [`time_of_impact`] |
//! | where does a ray meet a shape? | [`crate::ray::cast`] |
//! | does a shape hold a point, or meet an axis-aligned box? | [`crate::point`] |
//!
//! Each comes for whole shapes, compounds included, and most for pieces, for callers who walk the pieces themselves.
//! All take world poses and answer in the world. Shapes are closed solids: touching is having a point in common, to the
//! rounding of the search ([`crate::limits::TOUCHING`] of the size of both shapes).
//!
//! Coordinates of poses and points go up to ±[`FARTHEST`] (1e30 m); what is beyond, or not
//! finite, has nothing in common with anything. Nothing panics.

mod cast;
mod half_spaces;
mod motion;
mod project;
mod separation;
mod unsure;

pub use cast::{ShapeHit, shape_cast, shape_cast_on_piece, time_of_impact};
pub use motion::Motion;
pub use project::{Projection, project, project_on_piece};
pub(crate) use separation::separation_by_difference;
pub use separation::{
    Closest, Separation, closest, closest_of_pieces, overlap, pieces_overlap, separation, separation_of_pieces,
};

use hyperbody_math::Pose;

use crate::limits::FARTHEST;

/// Whether a pose is one that queries answer for: finite, and not beyond [`FARTHEST`].
pub(crate) fn in_range<const N: usize>(pose: &Pose<N>) -> bool {
    pose.translation.max_abs() <= FARTHEST && pose.rotation.matrix().is_finite()
}

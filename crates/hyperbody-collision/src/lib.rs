//! Collision detection in `N` dimensions, `N` = 2..=6, written once for every `N`.
//!
//! | module | holds |
//! |---|---|
//! | [`tree`] | [`DynamicTree`]: which axis-aligned boxes overlap |
//! | [`narrow`] | [`collide`]: the contacts of one pair of pieces; picks the method for the pair |
//! | [`manifold`] | [`Manifold`]: a normal and the few points that hold a contact |
//! | [`box_sat`] | separating axes of two boxes, all C(2N, N−1) of them |
//! | [`ray`] | [`cast`](ray::cast): where a ray first meets a shape |
//! | [`point`] | whether a point, or an axis-aligned box, is in a shape |
//! | [`detect`] | the three detectors of the paper, each by itself |
//! | [`query`] | distance, depth, overlap, nearest point, and casts of shapes that move and turn |
//! | [`limits`] | every tolerance and every bound on a loop, each with its reason |
//!
//! Every shape is a polyhedral core rounded by a radius ([`hyperbody_geometry::Convex`]), or a half-space. Touching,
//! parallel, nested, coincident and nearly flat inputs are ordinary inputs; poses that are not finite give no contact.

pub mod box_sat;
mod clip;
mod descent;
pub mod detect;
mod difference;
mod epa;
mod faces;
mod general;
mod gjk;
mod half_space;
mod inner_hull;
pub mod limits;
pub mod manifold;
pub mod narrow;
mod overlap;
mod pair;
mod patch;
pub mod point;
pub mod query;
pub mod ray;
mod reduce;
mod round;
mod simplex;
mod stored;
pub mod tree;

pub use manifold::{ContactPoint, MAX_POINTS, Manifold, max_points};
pub use narrow::{Effort, PairCache, Scratch, collide};
pub use ray::{Ray, RayHit};
pub use tree::{DynamicTree, RayStack, RayTree};

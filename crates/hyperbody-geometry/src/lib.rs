//! Shapes of `N`-dimensional bodies: what they are, their supports, and their mass properties.
//!
//! | module | holds |
//! |---|---|
//! | [`shape`] | [`Shape`]: everything a body can be made of |
//! | [`convex`] | [`Convex`]: a core rounded by a radius, the form in which collision sees every convex shape |
//! | [`polytope`] | [`Polytope`]: vertices, facets and their incidences |
//! | [`hull`] | the convex hull of points |
//! | [`mass`] | [`MassProperties`]: volume, centre, second moments, principal frame |
//! | [`aabb`] | [`Aabb`]: axis-aligned boxes |
//! | [`tolerances`] | every limit and tolerance, with its reason |
//! | [`error`] | [`GeometryError`] |

pub mod aabb;
pub mod convex;
pub mod error;
pub mod hull;
mod incidence;
pub mod mass;
pub mod polytope;
pub mod shape;
pub mod tolerances;

pub use aabb::Aabb;
pub use convex::{Convex, Core};
pub use error::{GeometryError, GeometryErrorKind, Result};
pub use mass::MassProperties;
pub use polytope::Polytope;
pub use shape::{Piece, Shape};

//! The three ways to detect a collision of M. ten Bosch, "N-Dimensional Rigid Body Dynamics" (2020), §7, complete and each
//! by itself.
//!
//! | detector | for | how |
//! |---|---|---|
//! | [`NearestFeatures`] | balls against polytopes | the nearest face, down the ranks: facet, ridge, …, vertex |
//! | [`SeparatingAxes`] | polytopes against polytopes | every direction orthogonal to a face of each, m_a + m_b = N − 1 |
//! | [`by_minkowski_difference`] | everything | GJK, and the penetration search behind it |
//!
//! The simulation ([`crate::collide`]) and the queries ([`crate::query`]) take the fastest way that is right for a pair:
//! closed forms, separating axes for boxes, the Minkowski difference for the rest. The other ways are here to be used, and
//! to check these: they share no search with each other.

mod minkowski;
mod nearest_feature;
mod separating_axes;

pub use minkowski::by_minkowski_difference;
pub use nearest_feature::{NearestFeature, NearestFeatures};
pub use separating_axes::{AxisSeparation, SeparatingAxes};

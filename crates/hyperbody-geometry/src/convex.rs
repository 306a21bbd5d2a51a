//! The form in which collision detection sees every convex shape: a polyhedral core, rounded by a radius.
//!
//! A ball is a rounded point, a capsule a rounded segment. Resting contacts of rounded shapes are then contacts of
//! separated cores, where the closest points are well defined.

use std::sync::Arc;

use hyperbody_math::{Pose, Vector};

use crate::{Aabb, Polytope};

/// The set that is rounded: flat-faced, or lower-dimensional. In the frame of its collider.
#[derive(Clone, Debug)]
pub enum Core<const N: usize> {
    /// The origin.
    Point,
    /// From −`half` to +`half`.
    Segment {
        /// Half of the segment as a vector.
        half: Vector<N>,
    },
    /// All points with |p_i| ≤ h_i.
    Box {
        /// h_i > 0.
        half_extents: Vector<N>,
    },
    /// A convex polytope.
    Polytope(Arc<Polytope<N>>),
}

/// All points at most `radius` away from the core.
#[derive(Clone, Debug)]
pub struct Convex<const N: usize> {
    /// The core.
    pub core: Core<N>,
    /// ≥ 0, in metres; > 0 for points and segments.
    pub radius: f64,
}

impl<const N: usize> Core<N> {
    /// A point of the core that lies farthest in `direction` (any length); ties go to the smallest vertex index and,
    /// for boxes and segments, to the positive side.
    #[must_use]
    pub fn support(&self, direction: Vector<N>) -> Vector<N> {
        match self {
            Self::Point => Vector::ZERO,
            Self::Segment { half } => {
                if half.dot(direction) < 0.0 {
                    -*half
                } else {
                    *half
                }
            }
            Self::Box { half_extents } => {
                Vector::from_fn(|i| if direction[i] < 0.0 { -half_extents[i] } else { half_extents[i] })
            }
            Self::Polytope(polytope) => polytope.vertices()[polytope.support_vertex(direction)],
        }
    }

    /// The points whose hull the core is.
    pub(crate) fn corners(&self) -> Vec<Vector<N>> {
        match self {
            Self::Point => vec![Vector::ZERO],
            Self::Segment { half } => vec![-*half, *half],
            Self::Box { half_extents } => {
                let corner = |bits: u32| {
                    Vector::from_fn(|i| if bits >> i & 1 == 0 { -half_extents[i] } else { half_extents[i] })
                };
                (0..1 << N).map(corner).collect()
            }
            Self::Polytope(polytope) => polytope.vertices().to_vec(),
        }
    }

    /// Radius of the smallest ball about the origin of the collider's frame that holds the core.
    #[must_use]
    pub fn bounding_radius(&self) -> f64 {
        match self {
            Self::Point => 0.0,
            Self::Segment { half } => half.norm(),
            Self::Box { half_extents } => half_extents.norm(),
            Self::Polytope(polytope) => polytope.bounding_radius(),
        }
    }
}

impl<const N: usize> Convex<N> {
    /// The smallest axis-aligned box around the shape at `world_from_collider`.
    #[inline]
    #[must_use]
    pub fn aabb(&self, world_from_collider: &Pose<N>) -> Aabb<N> {
        let rotation = world_from_collider.rotation.matrix();
        let (lower, upper) = match &self.core {
            Core::Point => (Vector::ZERO, Vector::ZERO),
            Core::Segment { half } => {
                let reach = world_from_collider.rotation.rotate(*half).abs();
                (-reach, reach)
            }
            Core::Box { half_extents } => {
                let reach = Vector::from_fn(|i| rotation.row(i).abs().dot(*half_extents));
                (-reach, reach)
            }
            Core::Polytope(polytope) => {
                let mut lower = Vector::splat(f64::INFINITY);
                let mut upper = Vector::splat(f64::NEG_INFINITY);
                for &vertex in polytope.vertices() {
                    let p = world_from_collider.rotation.rotate(vertex);
                    lower = lower.min(p);
                    upper = upper.max(p);
                }
                (lower, upper)
            }
        };
        let centre = world_from_collider.translation;
        Aabb { lower: lower + centre, upper: upper + centre }.grown(self.radius)
    }

    /// Radius of the smallest ball about the origin of the collider's frame that holds the shape.
    #[must_use]
    pub fn bounding_radius(&self) -> f64 {
        self.core.bounding_radius() + self.radius
    }
}

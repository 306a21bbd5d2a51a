//! What is true of two shapes, found from vertices and facets alone: no distance search, no separating axes, no
//! penetration search.

use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Convex, Core, Polytope};
use hyperbody_math::{Pose, Vector};

use super::Random;

/// The vertices of a core in the world.
pub fn vertices<const N: usize>(core: &Core<N>, pose: &Pose<N>) -> Vec<Vector<N>> {
    let local: Vec<Vector<N>> = match core {
        Core::Point => vec![Vector::ZERO],
        Core::Segment { half } => vec![*half, -*half],
        Core::Box { half_extents } => (0..1 << N)
            .map(|bits: usize| Vector::from_fn(|i| if bits >> i & 1 == 0 { half_extents[i] } else { -half_extents[i] }))
            .collect(),
        Core::Polytope(polytope) => polytope.vertices().to_vec(),
    };
    local.into_iter().map(|v| pose.transform_point(v)).collect()
}

/// Two convex pieces in the world, by their vertices.
pub struct Truth<'a, const N: usize> {
    pub a: &'a Convex<N>,
    pub b: &'a Convex<N>,
    pub pose_a: Pose<N>,
    pub pose_b: Pose<N>,
    vertices_a: Vec<Vector<N>>,
    vertices_b: Vec<Vector<N>>,
    pub rounding: f64,
    /// Sum of the bounding radii.
    pub scale: f64,
}

pub fn convex<const N: usize>(piece: &Piece<N>) -> &Convex<N> {
    match piece {
        Piece::Convex(convex) => convex,
        Piece::HalfSpace { .. } => panic!("the oracle is for bounded shapes"),
    }
}

impl<'a, const N: usize> Truth<'a, N> {
    pub fn new(a: &'a Convex<N>, pose_a: &Pose<N>, b: &'a Convex<N>, pose_b: &Pose<N>) -> Self {
        Self {
            a,
            b,
            pose_a: *pose_a,
            pose_b: *pose_b,
            vertices_a: vertices(&a.core, pose_a),
            vertices_b: vertices(&b.core, pose_b),
            rounding: a.radius + b.radius,
            scale: a.bounding_radius() + b.bounding_radius(),
        }
    }

    /// Separation of the cores along a unit direction from a to b.
    pub fn separation(&self, n: Vector<N>) -> f64 {
        let lowest_b = self.vertices_b.iter().map(|v| v.dot(n)).fold(f64::INFINITY, f64::min);
        let highest_a = self.vertices_a.iter().map(|v| v.dot(n)).fold(f64::NEG_INFINITY, f64::max);
        lowest_b - highest_a
    }

    /// The exact least depth of the cores, from the hull of all differences of vertices; `None` if that hull has too
    /// many points for a test, is flat, or does not hold the origin.
    pub fn least_depth(&self, most_points: usize) -> Option<f64> {
        if self.vertices_a.len() * self.vertices_b.len() > most_points {
            return None;
        }
        let mut points = Vec::new();
        for a in &self.vertices_a {
            points.extend(self.vertices_b.iter().map(|b| *a - *b));
        }
        let hull = Polytope::from_points(&points).ok()?;
        let depth = hull.facets().iter().map(|facet| facet.offset).fold(f64::INFINITY, f64::min);
        (depth > 0.0).then_some(depth)
    }

    /// The least depth of the cores that a descent finds from random directions, and from those of the axes: steps against
    /// the gradient of the support value on the sphere, ever shorter. An upper bound on the least depth.
    pub fn least_depth_nearby(&self, random: &mut Random, starts: usize) -> f64 {
        let mut least = f64::INFINITY;
        for start in 0..starts + N {
            let mut n = if start < starts {
                random.direction()
            } else {
                self.pose_a.rotation.rotate(Vector::unit(start - starts))
            };
            if start >= starts && (self.pose_b.translation - self.pose_a.translation).dot(n) < 0.0 {
                n = -n;
            }
            let mut step = 0.5;
            for _ in 0..24 {
                let farthest = self.farthest_difference(n);
                let depth = farthest.dot(n);
                least = least.min(depth);
                let Some(uphill) = (farthest - n * depth).try_normalize() else { break };
                let Some(next) = (n - uphill * step).try_normalize() else { break };
                if self.farthest_difference(next).dot(next) < depth {
                    n = next;
                } else {
                    step *= 0.5;
                }
            }
        }
        least
    }

    /// The difference of vertices farthest along a direction.
    fn farthest_difference(&self, n: Vector<N>) -> Vector<N> {
        let farthest = |vertices: &[Vector<N>], n: Vector<N>| {
            vertices.iter().copied().fold(vertices[0], |best, v| if v.dot(n) > best.dot(n) { v } else { best })
        };
        farthest(&self.vertices_a, n) - farthest(&self.vertices_b, -n)
    }

    /// The lesser inner radius about the origins of those cores that have one.
    pub fn thickness(&self) -> f64 {
        let solid =
            [self.a, self.b].into_iter().filter(|convex| matches!(convex.core, Core::Box { .. } | Core::Polytope(_)));
        let least = solid.map(|convex| (-outside(&convex.core, Vector::ZERO)).max(0.0)).fold(f64::INFINITY, f64::min);
        if least.is_finite() { least } else { 0.0 }
    }

    /// How far a point of the world is outside shape a, at least.
    pub fn outside_a(&self, point: Vector<N>) -> f64 {
        outside(&self.a.core, self.pose_a.inverse_transform_point(point)) - self.a.radius
    }

    /// How far a point of the world is outside shape b, at least.
    pub fn outside_b(&self, point: Vector<N>) -> f64 {
        outside(&self.b.core, self.pose_b.inverse_transform_point(point)) - self.b.radius
    }
}

/// How far a point in the frame of a core is outside it, at least; minus the depth inside those with an inside.
pub fn outside<const N: usize>(core: &Core<N>, p: Vector<N>) -> f64 {
    match core {
        Core::Point => p.norm(),
        Core::Segment { half } => {
            let t = (p.dot(*half) / half.norm_sq()).clamp(-1.0, 1.0);
            p.distance(*half * t)
        }
        Core::Box { half_extents } => (0..N).map(|i| p[i].abs() - half_extents[i]).fold(f64::NEG_INFINITY, f64::max),
        Core::Polytope(polytope) => {
            polytope.facets().iter().map(|f| f.normal.dot(p) - f.offset).fold(f64::NEG_INFINITY, f64::max)
        }
    }
}

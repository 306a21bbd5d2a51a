//! The Minkowski difference D = A − B of two cores, known by its support function alone.
//!
//! The cores overlap where D holds the origin; their distance is that of D from the origin; and for every unit vector n
//! the support value h(n) = max over D of n·w is minus the separation along n: moving b by h(n)·n pulls the two apart.
//! Everything is in a's frame.

use hyperbody_geometry::{Core, Polytope};
use hyperbody_math::{Pose, Vector};

/// A vertex of D: a vertex of A minus one of B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex<const N: usize> {
    pub(crate) point: Vector<N>,
    /// Which vertices of A and of B; the bits of a box corner say on which axes it is negative.
    pub(crate) key: [u32; 2],
}

impl<const N: usize> Vertex<N> {
    pub(crate) const ORIGIN: Self = Self { point: Vector::ZERO, key: [0; 2] };
}

/// Two cores and how they lie.
#[derive(Clone, Copy)]
pub(crate) struct Difference<'a, const N: usize> {
    pub(crate) a: &'a Core<N>,
    pub(crate) b: &'a Core<N>,
    pub(crate) a_from_b: &'a Pose<N>,
    /// Sum of the bounding radii: the size against which rounding is measured.
    pub(crate) scale: f64,
    /// The lesser bounding radius that is not zero: the size of the smaller shape, or of the only one with a size.
    pub(crate) smaller: f64,
}

impl<'a, const N: usize> Difference<'a, N> {
    pub(crate) fn new(a: &'a Core<N>, b: &'a Core<N>, a_from_b: &'a Pose<N>) -> Self {
        let (size_a, size_b) = (a.bounding_radius(), b.bounding_radius());
        let smaller = if size_a > 0.0 && (size_a < size_b || size_b == 0.0) { size_a } else { size_b };
        Self { a, b, a_from_b, scale: size_a + size_b, smaller }
    }

    /// The vertex of D farthest along `direction`, of any length.
    #[inline]
    pub(crate) fn support(&self, direction: Vector<N>) -> Vertex<N> {
        let toward_a = -self.a_from_b.rotation.inverse_rotate(direction);
        let (key_a, on_a) = support(self.a, direction);
        let (key_b, on_b) = support(self.b, toward_a);
        Vertex { point: on_a - self.a_from_b.transform_point(on_b), key: [key_a, key_b] }
    }

    /// The vertex of D with the given key.
    pub(crate) fn vertex(&self, key: [u32; 2]) -> Vertex<N> {
        let [on_a, on_b] = self.vertices(key);
        Vertex { point: on_a - on_b, key }
    }

    /// The vertices of A and of B with the given key, in a's frame.
    pub(crate) fn vertices(&self, key: [u32; 2]) -> [Vector<N>; 2] {
        [corner(self.a, key[0]), self.a_from_b.transform_point(corner(self.b, key[1]))]
    }

    /// The support value h(n): for a unit vector minus the separation along it.
    #[inline]
    pub(crate) fn reach(&self, n: Vector<N>) -> f64 {
        self.support(n).point.dot(n)
    }
}

/// Key and place of the vertex of a core farthest in `direction`.
#[inline]
fn support<const N: usize>(core: &Core<N>, direction: Vector<N>) -> (u32, Vector<N>) {
    match core {
        Core::Point => (0, Vector::ZERO),
        Core::Segment { half } => {
            if half.dot(direction) < 0.0 {
                (1, -*half)
            } else {
                (0, *half)
            }
        }
        Core::Box { half_extents } => {
            let mut key = 0;
            let mut point = *half_extents;
            for axis in 0..N {
                if direction[axis] < 0.0 {
                    key |= 1 << axis;
                    point[axis] = -point[axis];
                }
            }
            (key, point)
        }
        Core::Polytope(polytope) => {
            let vertex = polytope.support_vertex(direction);
            (vertex as u32, polytope.vertices()[vertex])
        }
    }
}

/// The vertex of a core with the given key.
fn corner<const N: usize>(core: &Core<N>, key: u32) -> Vector<N> {
    match core {
        Core::Point => Vector::ZERO,
        Core::Segment { half } => *half * if key == 0 { 1.0 } else { -1.0 },
        Core::Box { half_extents } => {
            Vector::from_fn(|axis| if key >> axis & 1 == 0 { half_extents[axis] } else { -half_extents[axis] })
        }
        Core::Polytope(polytope) => polytope.vertices().get(key as usize).copied().unwrap_or(Vector::ZERO),
    }
}

/// Radius of the largest ball about `point` inside the core, negative outside. Zero for cores without inside.
pub(crate) fn inner_radius<const N: usize>(core: &Core<N>, point: Vector<N>) -> f64 {
    match core {
        Core::Point | Core::Segment { .. } => 0.0,
        Core::Box { half_extents } => {
            (0..N).map(|axis| half_extents[axis] - point[axis].abs()).fold(f64::INFINITY, f64::min)
        }
        Core::Polytope(polytope) => inner_radius_of_polytope(polytope, point),
    }
}

fn inner_radius_of_polytope<const N: usize>(polytope: &Polytope<N>, point: Vector<N>) -> f64 {
    let depths = polytope.facets().iter().map(|facet| facet.offset - facet.normal.dot(point));
    depths.fold(f64::INFINITY, f64::min)
}

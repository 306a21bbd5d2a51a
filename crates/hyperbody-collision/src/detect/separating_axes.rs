//! Two polytopes by separating axes: all pairs of faces with m_a + m_b = N − 1.
//!
//! A facet of the Minkowski difference is the difference of a face of a and a face of b whose dimensions add up to N − 1
//! (or more, if they are partly parallel; then it is bounded by faces that do). Its normal is orthogonal to both. So the
//! directions orthogonal to such pairs are all that can separate two polytopes best: disjoint ones are separated by one of
//! them, and of overlapping ones the least depth is along one of them. For boxes these are the C(2N, N−1) axes that
//! [`crate::box_sat`] walks in closed form; here the faces are those of any polytope, and only those that are not parallel
//! to one before count.

use hyperbody_geometry::{Convex, Core, Polytope};
use hyperbody_math::{Pose, Vector};

use super::nearest_feature::span;
use crate::difference::Difference;
use crate::limits;

/// A polytope prepared for separating axes: the directions of its faces.
#[derive(Clone, Debug)]
pub struct SeparatingAxes<const N: usize> {
    core: Core<N>,
    /// For each rank the orthonormal bases of the spaces that its faces are parallel to, each space once.
    spaces: Vec<Vec<Vec<Vector<N>>>>,
}

/// The direction along which two polytopes are farthest apart, or overlap least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisSeparation<const N: usize> {
    /// Unit, in the world, from a to b.
    pub normal: Vector<N>,
    /// Along the normal, m. Minus the least depth of overlapping polytopes; of disjoint ones a lower bound on their distance,
    /// positive.
    pub separation: f64,
    /// Directions looked at.
    pub axes: u64,
}

impl<const N: usize> SeparatingAxes<N> {
    /// Prepares a convex polytope.
    #[must_use]
    pub fn new(polytope: &std::sync::Arc<Polytope<N>>) -> Self {
        let lattice = polytope.face_lattice();
        let vertex = |v: u32| polytope.vertices()[v as usize];
        let spaces = (0..N)
            .map(|rank| {
                let faces = lattice.faces(rank).iter();
                distinct(faces.map(|face| {
                    let base = vertex(face.vertices[0]);
                    span(face.vertices.iter().map(|&v| vertex(v) - base), rank)
                }))
            })
            .collect();
        Self { core: Core::Polytope(std::sync::Arc::clone(polytope)), spaces }
    }

    /// Prepares the core of a convex piece: of points and segments too, whose faces are fewer.
    #[must_use]
    pub fn of_core(convex: &Convex<N>) -> Self {
        Self::prepare(&convex.core)
    }

    pub(crate) fn prepare(core: &Core<N>) -> Self {
        match core {
            Core::Polytope(polytope) => Self::new(polytope),
            core => Self { core: core.clone(), spaces: (0..N).map(|rank| spaces_of(core, rank)).collect() },
        }
    }

    /// Number of pairs of faces that [`SeparatingAxes::separate`] would look at.
    #[must_use]
    pub fn pairs_with(&self, other: &Self) -> u64 {
        (0..N).map(|rank| self.spaces[rank].len() as u64 * other.spaces[N - 1 - rank].len() as u64).sum()
    }

    /// The best separating axis of a (this) and b. `None` if there is none because poses are not finite or both are flat.
    #[must_use]
    pub fn separate(&self, world_from_a: &Pose<N>, b: &Self, world_from_b: &Pose<N>) -> Option<AxisSeparation<N>> {
        let a_from_b = world_from_a.relative(world_from_b);
        let difference = Difference::new(&self.core, &b.core, &a_from_b);
        let mut best: Option<AxisSeparation<N>> = None;
        let mut axes = 0;
        for rank in 0..N {
            for space_b in &b.spaces[N - 1 - rank] {
                let mut turned = [Vector::ZERO; N];
                for (slot, direction) in turned.iter_mut().zip(space_b) {
                    *slot = a_from_b.rotation.rotate(*direction);
                }
                for space_a in &self.spaces[rank] {
                    let Some(normal) = orthogonal(space_a, &turned[..space_b.len()]) else { continue };
                    axes += 1;
                    for normal in [normal, -normal] {
                        let separation = -difference.reach(normal);
                        if best.is_none_or(|best| separation > best.separation) {
                            best = Some(AxisSeparation { normal, separation, axes });
                        }
                    }
                }
            }
        }
        best.filter(|best| best.separation.is_finite()).map(|best| AxisSeparation {
            normal: world_from_a.rotation.rotate(best.normal),
            axes,
            ..best
        })
    }
}

/// The spaces that the faces of a rank are parallel to: of a box all choices of axes, of a segment itself.
fn spaces_of<const N: usize>(core: &Core<N>, rank: usize) -> Vec<Vec<Vector<N>>> {
    match core {
        Core::Box { .. } => (0..1_usize << N)
            .filter(|axes| axes.count_ones() as usize == rank)
            .map(|axes| (0..N).filter(|axis| axes >> axis & 1 == 1).map(Vector::unit).collect())
            .collect(),
        Core::Segment { half } if rank == 1 => vec![vec![half.normalize_or_zero()]],
        _ if rank == 0 => vec![Vec::new()],
        _ => Vec::new(),
    }
}

/// Each space once.
fn distinct<const N: usize>(bases: impl Iterator<Item = Vec<Vector<N>>>) -> Vec<Vec<Vector<N>>> {
    let mut kept: Vec<Vec<Vector<N>>> = Vec::new();
    for basis in bases {
        let parallel = |other: &Vec<Vector<N>>| {
            basis.iter().all(|&v| {
                let rest = other.iter().fold(v, |rest, &direction| rest - direction * direction.dot(rest));
                rest.norm_sq() < limits::PARALLEL_SQ
            })
        };
        if !kept.iter().any(parallel) {
            kept.push(basis);
        }
    }
    kept
}

/// The unit vector orthogonal to N − 1 vectors, of which the first ones are orthonormal, and the others among themselves.
/// `None` if they are dependent.
fn orthogonal<const N: usize>(first: &[Vector<N>], others: &[Vector<N>]) -> Option<Vector<N>> {
    let mut basis = [Vector::ZERO; N];
    let mut len = first.len();
    basis[..len].copy_from_slice(first);
    let rest_of = |v: Vector<N>, basis: &[Vector<N>]| {
        // Twice is enough (Kahan, in Parlett 1980).
        let once = basis.iter().fold(v, |rest, &direction| rest - direction * direction.dot(rest));
        basis.iter().fold(once, |rest, &direction| rest - direction * direction.dot(rest))
    };
    for &other in others {
        let rest = rest_of(other, &basis[..len]);
        if rest.norm_sq() < limits::PARALLEL_SQ {
            return None;
        }
        basis[len] = rest.normalize_or_zero();
        len += 1;
    }
    let mut best = Vector::ZERO;
    for axis in 0..N {
        let rest = rest_of(Vector::unit(axis), &basis[..len]);
        if rest.norm_sq() > best.norm_sq() {
            best = rest;
        }
    }
    best.try_normalize()
}

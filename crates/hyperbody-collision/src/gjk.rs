//! Distance of two cores, in any dimension.
//!
//! Gilbert, Johnson and Keerthi (1988) with Wolfe's inner step (see [`crate::simplex`]): x is the point of a small
//! simplex in D nearest to the origin; the vertex s of D farthest against x either shows that x is the nearest point of
//! all of D (x·s = x·x), or joins the simplex and brings it closer. x·s / |x| is a lower bound on the distance at any
//! time and the direction −x/|x| a certificate of it.
//!
//! The loop ends: every turn but at most N strictly shortens x, a simplex determines its x, and D has finitely many
//! vertices, so no simplex comes back for ever. [`limits::MAX_GJK_TURNS`] bounds it far below that; what is known then is returned.

use hyperbody_math::Vector;

use crate::difference::{Difference, Vertex};
use crate::limits;
use crate::simplex::{MAX_SIMPLEX, Simplex};

/// What is known about two cores.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Proximity<const N: usize> {
    /// Farther apart than was asked, shown by this unit direction from a to b.
    Apart { normal: Vector<N> },
    /// Disjoint.
    Near(Closest<N>),
    /// The origin lies in this simplex, or as good as.
    Overlap(Simplex<N>),
}

/// The closest points of disjoint cores, in a's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closest<const N: usize> {
    /// Unit, from a to b.
    pub(crate) normal: Vector<N>,
    pub(crate) distance: f64,
    pub(crate) simplex: Simplex<N>,
}

/// The vertices that made up the last answer: where the next search starts.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Seeds {
    pub(crate) keys: [[u32; 2]; MAX_SIMPLEX],
    pub(crate) len: u32,
}

impl Seeds {
    pub(crate) fn of<const N: usize>(vertices: &[Vertex<N>]) -> Self {
        let mut seeds = Self::default();
        for (slot, vertex) in seeds.keys.iter_mut().zip(vertices) {
            *slot = vertex.key;
            seeds.len += 1;
        }
        seeds
    }

    pub(crate) fn keys(&self) -> &[[u32; 2]] {
        &self.keys[..self.len as usize]
    }
}

/// Searches the closest points, starting from the seeds or else from the vertex along `toward_b`. Stops once the
/// distance is known to exceed `stop_above`. `turns` is raised by the number of vertices asked for.
pub(crate) fn closest<const N: usize>(
    difference: &Difference<'_, N>,
    seeds: &Seeds,
    toward_b: Vector<N>,
    stop_above: f64,
    turns: &mut u32,
) -> Proximity<N> {
    let mut simplex = start(difference, seeds, toward_b);
    let touching = limits::TOUCHING * difference.scale;
    // Of simplices equally close to rounding, the one whose normal certifies most.
    let mut certified: Option<(f64, Simplex<N>)> = None;
    let mut stalls = 0;
    for _ in 0..limits::MAX_GJK_TURNS {
        let distance = simplex.nearest.norm();
        if simplex.is_full() || distance <= touching {
            return Proximity::Overlap(simplex);
        }
        let normal = simplex.nearest * (-1.0 / distance);
        *turns += 1;
        let vertex = difference.support(normal);
        let at_least = -vertex.point.dot(normal);
        if at_least > stop_above {
            return Proximity::Apart { normal };
        }
        if certified.as_ref().is_some_and(|(most, _)| at_least > *most) {
            certified = Some((at_least, simplex));
        }
        let gap = distance - at_least;
        let tolerance = limits::GJK_RELATIVE_GAP * distance + limits::GJK_ABSOLUTE_GAP * difference.scale;
        if gap <= tolerance || simplex.holds(vertex.key) {
            break;
        }
        let Some(mut next) = simplex.with(vertex) else { break };
        // Turning by a small angle brings x closer by its square, which rounding may eat, while the bound gains by the
        // angle itself. That is how small shapes lie against large ones.
        if next.nearest.norm_sq() >= simplex.nearest.norm_sq() {
            stalls += 1;
            if stalls > N || gap <= limits::GJK_STALL_GAP * difference.scale {
                break;
            }
            certified = certified.or(Some((at_least, simplex)));
            if !next.holds(vertex.key) {
                let Some(joined) = simplex.joined(vertex) else { break };
                next = joined;
            }
        }
        simplex = next;
    }
    let simplex = certified.map_or(simplex, |(_, simplex)| simplex);
    let distance = simplex.nearest.norm();
    let normal = simplex.nearest * (-1.0 / distance.max(f64::MIN_POSITIVE));
    Proximity::Near(Closest { normal, distance, simplex })
}

/// The simplex of the seeds if it is a valid start, or else one vertex.
fn start<const N: usize>(difference: &Difference<'_, N>, seeds: &Seeds, toward_b: Vector<N>) -> Simplex<N> {
    let mut vertices = [Vertex::ORIGIN; MAX_SIMPLEX];
    let keys = seeds.keys();
    for (slot, &key) in vertices.iter_mut().zip(keys) {
        *slot = difference.vertex(key);
    }
    Simplex::of(&vertices[..keys.len()]).unwrap_or_else(|| Simplex::new(difference.support(toward_b)))
}

impl<const N: usize> Simplex<N> {
    /// The points of A and of B that the weights make, in a's frame.
    pub(crate) fn witnesses(&self, difference: &Difference<'_, N>) -> [Vector<N>; 2] {
        let mut result = [Vector::ZERO; 2];
        for (vertex, &weight) in self.vertices().iter().zip(self.weights()) {
            let [on_a, on_b] = difference.vertices(vertex.key);
            result[0] += on_a * weight;
            result[1] += on_b * weight;
        }
        result
    }
}

//! Penetration of two overlapping cores: a polytope inside D = A − B that grows until its nearest facet is one of D's.
//!
//! G. van den Bergen (2001), in any dimension. The inner polytope is simplicial and holds the origin; the facet nearest
//! to the origin is pushed out to the vertex of D farthest along its normal, until there is nothing farther. Then its
//! distance is the depth and its normal the way out.
//!
//! Two bounds hold at any time: the distance of the nearest facet from below (the inner polytope lies in D), and the
//! least support value seen from above (moving b that far along that direction does separate the two). The search can
//! therefore be cut off anywhere, by [`limits::MAX_EPA_VERTICES`] and [`limits::MAX_EPA_FACETS`], and still returns a
//! translation that separates; local descents ([`crate::descent`]) from the facets nearest then make it one that is the
//! shortest among its neighbours. It also ends early once the lower bound shows a depth known before to be good enough.

use hyperbody_math::Vector;

use crate::difference::{Difference, Vertex};
use crate::inner_hull::{InnerHull, Insertion};
use crate::simplex::Simplex;
use crate::{descent, limits};

/// The least depth of two overlapping cores.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Penetration<const N: usize> {
    /// Unit, in a's frame, from a to b.
    pub(crate) normal: Vector<N>,
    /// Moving b by this along the normal separates the cores: an upper bound on the least depth.
    pub(crate) depth: f64,
    /// No direction has less depth than this.
    pub(crate) at_least: f64,
    /// The vertices of the facet whose normal it is, if the normal comes from one.
    pub(crate) facet: Option<[Vertex<N>; N]>,
    /// The deepest points of A and B, if the search ended at its bounds and a descent found the normal.
    pub(crate) points: Option<[Vector<N>; 2]>,
}

/// What the search took.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cost {
    pub(crate) vertices: u32,
    pub(crate) facets: u32,
    /// Most turns of one descent; zero if the search was carried to its end.
    pub(crate) descent_turns: u32,
}

/// Searches the least depth. `start` are vertices of D whose hull holds the origin, `good_enough` a lower bound at
/// which to stop because the caller has an answer for that case.
pub(crate) fn penetrate<const N: usize>(
    difference: &Difference<'_, N>,
    start: &[Vertex<N>],
    good_enough: f64,
    hull: &mut InnerHull<N>,
) -> (Penetration<N>, Cost) {
    let gap = limits::EPA_GAP * difference.scale;
    let mut best = Penetration {
        normal: Vector::unit(0),
        depth: f64::INFINITY,
        at_least: f64::NEG_INFINITY,
        facet: None,
        points: None,
    };
    if let Err(flat) = first_simplex(difference, start, hull, gap) {
        // D has no inside: the direction across it separates at no depth to speak of.
        let depth = difference.reach(flat);
        return (Penetration { normal: flat, depth, at_least: 0.0, ..best }, Cost::default());
    }
    // Least distance of the facets that are not pushed out any more.
    let mut settled = f64::INFINITY;
    // Least weight of the foot of the origin on the best facet: negative while it lies outside.
    let mut foot_weight = f64::NEG_INFINITY;
    for _ in 0..limits::MAX_EPA_VERTICES {
        let Some((offset, index)) = hull.nearest_facet() else {
            best.at_least = settled;
            break;
        };
        best.at_least = offset.min(settled);
        // A facet of D may come in several simplices: the one wanted holds the foot of the origin.
        let foot_found = foot_weight >= 0.0 || (best.facet.is_some() && offset > best.depth + gap);
        if best.at_least >= good_enough || (best.at_least >= best.depth - gap && foot_found) {
            break;
        }
        let normal = hull.normal(index);
        let vertex = difference.support(normal);
        let reach = vertex.point.dot(normal);
        if reach < best.depth {
            (best.depth, best.normal) = (reach, normal);
        }
        if reach - offset <= gap {
            settled = settled.min(offset);
            let vertices = hull.vertices_of(index);
            let weight = Simplex::foot_on(&vertices).map_or(f64::NEG_INFINITY, |foot| foot.least_weight());
            if reach <= best.depth + gap && (best.facet.is_none() || weight > foot_weight) {
                (best.facet, foot_weight) = (Some(vertices), weight);
                best.normal = normal;
            }
            continue;
        }
        match hull.insert(index, vertex) {
            Insertion::Done => {}
            // Rounding is at work; the facet bounds the depth from below all the same.
            Insertion::Refused => settled = settled.min(offset),
            Insertion::Full => break,
        }
    }
    let mut cost = hull.cost();
    if best.at_least < good_enough.min(best.depth - gap) {
        descend_from_nearest(difference, hull, &mut best, &mut cost);
    }
    (best, cost)
}

/// Where the search ended at its bounds, the way out lies beyond one of the facets that are nearest then: the best of what
/// descents from these find, and from the best direction so far.
fn descend_from_nearest<const N: usize>(
    difference: &Difference<'_, N>,
    hull: &mut InnerHull<N>,
    best: &mut Penetration<N>,
    cost: &mut Cost,
) {
    let mut start = best.normal;
    for _ in 0..=limits::DESCENT_STARTS {
        let found = descent::descend(difference, start, &mut cost.descent_turns);
        if best.points.is_none() || -found.separation < best.depth {
            (best.normal, best.depth) = (found.normal, -found.separation);
            (best.points, best.facet) = (Some([found.on_a, found.on_b]), None);
        }
        let Some((_, facet)) = hull.nearest_facet() else { return };
        start = hull.normal(facet);
    }
}

/// Completes the start to a simplex of full dimension. On failure the direction in which D is flat.
fn first_simplex<const N: usize>(
    difference: &Difference<'_, N>,
    start: &[Vertex<N>],
    hull: &mut InnerHull<N>,
    gap: f64,
) -> Result<(), Vector<N>> {
    let mut vertices: Vec<Vertex<N>> = std::mem::take(&mut hull.start);
    vertices.clear();
    let mut span = Span::default();
    for &vertex in start {
        if vertices.is_empty() || span.extend(vertex.point - vertices[0].point, gap) {
            vertices.push(vertex);
        }
    }
    let mut flat = None;
    // Every turn adds a dimension.
    while vertices.len() <= N && flat.is_none() {
        let direction = span.outside();
        let ahead = difference.support(direction);
        let behind = difference.support(-direction);
        let base = vertices.first().map_or(Vector::ZERO, |vertex| vertex.point);
        let reach = |vertex: &Vertex<N>| (vertex.point - base).dot(direction).abs();
        let next = if reach(&behind) > reach(&ahead) { behind } else { ahead };
        if vertices.is_empty() || span.extend(next.point - base, gap) {
            vertices.push(next);
        } else {
            flat = Some(direction);
        }
    }
    if flat.is_none() && !hull.begin(&vertices, gap) {
        flat = Some(span.outside());
    }
    hull.start = vertices;
    flat.map_or(Ok(()), Err)
}

/// An orthonormal basis that grows.
struct Span<const N: usize> {
    basis: [Vector<N>; N],
    len: usize,
}

impl<const N: usize> Default for Span<N> {
    fn default() -> Self {
        Self { basis: [Vector::ZERO; N], len: 0 }
    }
}

impl<const N: usize> Span<N> {
    fn rest(&self, v: Vector<N>) -> Vector<N> {
        let mut rest = v;
        // Twice is enough (Kahan, in Parlett 1980).
        for _ in 0..2 {
            for &direction in &self.basis[..self.len] {
                rest -= direction * direction.dot(rest);
            }
        }
        rest
    }

    /// Takes a vector in if it reaches out of the span by more than `least`.
    fn extend(&mut self, v: Vector<N>, least: f64) -> bool {
        let rest = self.rest(v);
        let length = rest.norm();
        if self.len == N || length.is_nan() || length <= least {
            return false;
        }
        self.basis[self.len] = rest / length;
        self.len += 1;
        true
    }

    /// A unit vector orthogonal to the span.
    fn outside(&self) -> Vector<N> {
        let mut best = Vector::ZERO;
        for axis in 0..N {
            let rest = self.rest(Vector::unit(axis));
            if rest.norm_sq() > best.norm_sq() {
                best = rest;
            }
        }
        best.normalize_or_zero()
    }
}

//! The round parts of a polytope that stands for a curved shape.
//!
//! Contacts see products with curved factors as polytopes, and a polytope rolls on its edges. But balls and discs look the same
//! however they are turned: turned so that a vertex lies exactly where the ball is met, its polytope touches a plane where the ball
//! does, at every moment, and rolls as smoothly.

use hyperbody_math::Vector;

use crate::Polytope;
use crate::polytope::Facet;

/// A ball about the origin on some of the axes, as one factor of the vertices of a polytope.
#[derive(Clone, Debug)]
pub(crate) struct RoundPart {
    pub(crate) axes: Vec<usize>,
    /// Vertex number v of the polytope has vertex v / stride % count of the part, for v below `total`.
    pub(crate) stride: usize,
    pub(crate) count: usize,
    pub(crate) total: usize,
    /// m.
    pub(crate) radius: f64,
}

/// A part of the direction shorter than this, of a unit direction, turns nothing: there the ball stands on its flat side, where
/// turning it would only move its points about. What a disc of 32 sides is off by at this tilt is 1e-4 of its radius.
const LEAST_PART: f64 = 0.02;

/// A facet whose normal has more than this of a round part, of one, is made of it.
const LEAST_OF_NORMAL: f64 = 1e-9;

/// Most round parts: each takes two axes of six.
const MAX_PARTS: usize = 3;

/// The turn of one part, in coordinates of the space.
#[derive(Clone, Copy)]
struct Turn<'a, const N: usize> {
    part: &'a RoundPart,
    /// The vertex of the part that is the lowest.
    lowest: usize,
    /// From this unit vector, of that vertex, to that, of the direction.
    from: Vector<N>,
    to: Vector<N>,
}

impl RoundPart {
    fn own<const N: usize>(&self, point: Vector<N>) -> Vector<N> {
        let mut own = Vector::ZERO;
        self.axes.iter().for_each(|&axis| own[axis] = point[axis]);
        own
    }

    fn turn<const N: usize>(&self, vertices: &[Vector<N>], direction: Vector<N>) -> Option<Turn<'_, N>> {
        let own = self.own(direction);
        if own.norm() < LEAST_PART * direction.norm() {
            return None;
        }
        let to = own.normalize_or_zero();
        let mut nearest = (0, Vector::ZERO, f64::NEG_INFINITY);
        for number in 0..self.count {
            let from = self.own(vertices[number * self.stride]).normalize_or_zero();
            if from.dot(to) > nearest.2 {
                nearest = (number, from, from.dot(to));
            }
        }
        Some(Turn { part: self, lowest: nearest.0, from: nearest.1, to })
    }
}

impl<const N: usize> Turn<'_, N> {
    /// The vertex with this part turned and on the sphere.
    fn apply(&self, vertex: Vector<N>) -> Vector<N> {
        let own = self.part.own(vertex);
        let unit = own.normalize_or_zero();
        let sum = self.from + self.to;
        // The shortest rotation from one unit vector to another.
        let turned =
            unit - sum * (sum.dot(unit) / (1.0 + self.from.dot(self.to))) + self.to * (2.0 * self.from.dot(unit));
        vertex - own + turned * self.part.radius
    }
}

/// A polytope as seen from one direction, its round parts turned so that they reach exactly as far there as the shape that
/// the polytope stands for.
pub struct TurnedToward<'a, const N: usize> {
    polytope: &'a Polytope<N>,
    parts: &'a [RoundPart],
    turns: [Option<Turn<'a, N>>; MAX_PARTS],
}

impl<'a, const N: usize> TurnedToward<'a, N> {
    pub(crate) fn new(polytope: &'a Polytope<N>, parts: &'a [RoundPart], direction: Vector<N>) -> Self {
        let turn = |index: usize| parts.get(index).and_then(|part| part.turn(polytope.vertices(), direction));
        Self { polytope, parts, turns: std::array::from_fn(turn) }
    }

    /// The places of all vertices, in their order.
    pub fn vertices(&self) -> impl Iterator<Item = Vector<N>> + '_ {
        self.polytope.vertices().iter().enumerate().map(|(number, &vertex)| {
            let turns = self.turns.iter().flatten().filter(|turn| number < turn.part.total);
            turns.fold(vertex, |vertex, turn| turn.apply(vertex))
        })
    }

    /// Whether a facet stands for something round, where the shape has no facet.
    #[must_use]
    pub fn is_round(&self, facet: usize) -> bool {
        self.parts.iter().any(|part| made_of(&self.polytope.facets()[facet], part))
    }

    /// Whether a vertex lies where the shape is met, on a facet that stands for something round: it is the lowest in
    /// all parts that the facet is made of.
    #[must_use]
    pub fn meets(&self, vertex: usize, facet: usize) -> bool {
        let turns = self.turns.iter().flatten().filter(|turn| made_of(&self.polytope.facets()[facet], turn.part));
        turns.into_iter().all(|turn| {
            let part = turn.part;
            vertex >= part.total || vertex / part.stride % part.count == turn.lowest
        })
    }
}

fn made_of<const N: usize>(facet: &Facet<N>, part: &RoundPart) -> bool {
    part.own(facet.normal).norm() > LEAST_OF_NORMAL
}

//! The round parts of a polytope that stands for a curved shape.
//!
//! Contacts see products with curved factors as polytopes, and a polytope rolls on its edges. But balls and discs look the same
//! however they are turned: turned so that a vertex lies exactly where the ball is met, its polytope touches a plane where the ball
//! does, at every moment, and rolls as smoothly.

use hyperbody_math::Vector;

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

/// The turn of one part, in coordinates of the space.
struct Turn<'a, const N: usize> {
    part: &'a RoundPart,
    /// From this unit vector, of a vertex, to that, of the direction.
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
        let first = |number: usize| self.own(vertices[number * self.stride]).normalize_or_zero();
        let nearest = (0..self.count).map(first).fold(Vector::ZERO, |best: Vector<N>, v| {
            if v.dot(to) > best.dot(to) || best == Vector::ZERO { v } else { best }
        });
        Some(Turn { part: self, from: nearest, to })
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

/// Calls `f` with the number and place of every vertex, the round parts turned so that they reach exactly as far in
/// `direction` as the shape that the polytope stands for.
pub(crate) fn for_each_vertex_toward<const N: usize>(
    vertices: &[Vector<N>],
    parts: &[RoundPart],
    direction: Vector<N>,
    mut f: impl FnMut(usize, Vector<N>),
) {
    let turns: Vec<Turn<'_, N>> = parts.iter().filter_map(|part| part.turn(vertices, direction)).collect();
    for (number, &vertex) in vertices.iter().enumerate() {
        let counted = turns.iter().filter(|turn| number < turn.part.total);
        f(number, counted.fold(vertex, |vertex, turn| turn.apply(vertex)));
    }
}

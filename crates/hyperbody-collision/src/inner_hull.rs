//! A simplicial polytope that grows by one vertex at a time: the inside of the penetration search.
//!
//! Facets have `N` vertices and, opposite each, one neighbour. A new vertex sees the facets it lies above; those go, and
//! it is joined to their rim. New facets find each other by turning around their common ridges through the facets that
//! went, so that no search by content is needed. The surface stays closed whatever rounding does: what is seen is grown
//! from one facet by adjacency alone.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use hyperbody_math::Vector;

use crate::difference::Vertex;
use crate::epa::Cost;
use crate::limits;

#[derive(Clone, Debug)]
struct HullFacet<const N: usize> {
    vertices: [u32; N],
    /// Opposite each vertex. For facets that went in the current insertion: on the rim, the facet that came instead.
    neighbours: [u32; N],
    /// Outward; zero for a sliver whose plane rounding has eaten.
    normal: Vector<N>,
    offset: f64,
    alive: bool,
}

/// A facet in the queue, nearest first; among equals the older.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Queued {
    offset: f64,
    facet: u32,
}

impl Eq for Queued {}

impl PartialOrd for Queued {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Queued {
    /// Reversed: the heap's greatest is the nearest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.offset.total_cmp(&self.offset).then(other.facet.cmp(&self.facet))
    }
}

/// What became of a new vertex.
pub(crate) enum Insertion {
    Done,
    /// The vertex was there already, or sees everything: rounding is at work, the hull stays as it is.
    Refused,
    /// No more facets allowed.
    Full,
}

/// The growing polytope, with its memory for reuse.
#[derive(Clone, Debug, Default)]
pub(crate) struct InnerHull<const N: usize> {
    vertices: Vec<Vertex<N>>,
    facets: Vec<HullFacet<N>>,
    queue: BinaryHeap<Queued>,
    seen: Vec<u32>,
    inside: Vector<N>,
    gap: f64,
    /// Memory of the caller's for the first simplex.
    pub(crate) start: Vec<Vertex<N>>,
}

impl<const N: usize> InnerHull<N> {
    /// Starts with a simplex; `false` if it is flat.
    pub(crate) fn begin(&mut self, simplex: &[Vertex<N>], gap: f64) -> bool {
        self.vertices.clear();
        self.vertices.extend_from_slice(simplex);
        self.facets.clear();
        self.queue.clear();
        self.gap = gap;
        self.inside = Vector::ZERO;
        for vertex in simplex {
            self.inside += vertex.point * (1.0 / simplex.len() as f64);
        }
        let mut solid = simplex.len() == N + 1;
        // Facet k leaves out vertex k, and so lies opposite it for all others.
        for left_out in 0..=N as u32 {
            let mut vertices = [0; N];
            let others = (0..=N as u32).filter(|&other| other != left_out);
            for (slot, other) in vertices.iter_mut().zip(others) {
                *slot = other;
            }
            solid = solid && self.add(vertices, vertices);
        }
        solid
    }

    /// Offset and number of the facet nearest to the origin, taken off the queue.
    pub(crate) fn nearest_facet(&mut self) -> Option<(f64, u32)> {
        // Every facet is queued once.
        while let Some(Queued { offset, facet }) = self.queue.pop() {
            if self.facets[facet as usize].alive {
                return Some((offset, facet));
            }
        }
        None
    }

    pub(crate) fn normal(&self, facet: u32) -> Vector<N> {
        self.facets[facet as usize].normal
    }

    pub(crate) fn vertices_of(&self, facet: u32) -> [Vertex<N>; N] {
        self.facets[facet as usize].vertices.map(|vertex| self.vertices[vertex as usize])
    }

    pub(crate) fn cost(&self) -> Cost {
        Cost { vertices: self.vertices.len() as u32, facets: self.facets.len() as u32, descent_turns: 0 }
    }

    /// Pushes facet `from` out to a vertex that lies above it.
    pub(crate) fn insert(&mut self, from: u32, vertex: Vertex<N>) -> Insertion {
        if self.vertices.iter().any(|known| known.key == vertex.key) {
            return Insertion::Refused;
        }
        if self.facets.len() >= limits::MAX_EPA_FACETS {
            return Insertion::Full;
        }
        let first_new = self.facets.len() as u32;
        self.mark_seen(from, vertex.point);
        let apex = self.vertices.len() as u32;
        self.vertices.push(vertex);
        self.cover_rim(apex);
        if self.facets.len() as u32 == first_new {
            // Everything was seen: undo.
            self.vertices.pop();
            for &facet in &self.seen {
                self.facets[facet as usize].alive = true;
            }
            return Insertion::Refused;
        }
        self.join_new(first_new);
        Insertion::Done
    }

    /// Collects the facets that the point lies above, from `from` on by adjacency, and marks them as gone.
    fn mark_seen(&mut self, from: u32, point: Vector<N>) {
        self.seen.clear();
        self.seen.push(from);
        self.facets[from as usize].alive = false;
        let mut next = 0;
        while next < self.seen.len() {
            let neighbours = self.facets[self.seen[next] as usize].neighbours;
            next += 1;
            for neighbour in neighbours {
                let facet = &mut self.facets[neighbour as usize];
                // Slivers, whose normal is zero, go with their neighbours.
                let sees = facet.normal.dot(point) > facet.offset + VISIBLE * self.gap || facet.offset.is_infinite();
                if facet.alive && sees {
                    facet.alive = false;
                    self.seen.push(neighbour);
                }
            }
        }
    }

    /// Makes a facet from every ridge between a facet that went and one that stays to the apex.
    fn cover_rim(&mut self, apex: u32) {
        for index in 0..self.seen.len() {
            let gone = self.seen[index];
            for slot in 0..N {
                let beyond = self.facets[gone as usize].neighbours[slot];
                if !self.facets[beyond as usize].alive {
                    continue;
                }
                let new = self.facets.len() as u32;
                let mut vertices = self.facets[gone as usize].vertices;
                vertices[slot] = apex;
                // The other slots are filled in by `join_new`, which finds the rim again through `gone`.
                let mut neighbours = [gone; N];
                neighbours[slot] = beyond;
                self.add(vertices, neighbours);
                let back = slot_of(&self.facets[beyond as usize].neighbours, gone);
                self.facets[beyond as usize].neighbours[back] = new;
                self.facets[gone as usize].neighbours[slot] = new;
            }
        }
    }

    /// Finds the neighbours of the new facets among each other.
    fn join_new(&mut self, first_new: u32) {
        for new in first_new..self.facets.len() as u32 {
            let facet = &self.facets[new as usize];
            let apex_slot = slot_of(&facet.vertices, self.vertices.len() as u32 - 1);
            for slot in (0..N).filter(|&slot| slot != apex_slot) {
                let gone = self.facets[new as usize].neighbours[slot];
                let neighbour = self.turn_to_rim(gone, apex_slot, slot, first_new);
                self.facets[new as usize].neighbours[slot] = neighbour;
            }
        }
    }

    /// From the facet that went on whose ridge opposite `rim_slot` a new facet stands, turns around the part of that
    /// ridge without vertex `slot`, through facets that went, to the other rim ridge and the new facet on it.
    fn turn_to_rim(&self, gone: u32, rim_slot: usize, slot: usize, first_new: u32) -> u32 {
        let mut here = gone;
        let mut crossing = slot;
        let mut carried = self.facets[gone as usize].vertices[rim_slot];
        // Around a ridge's boundary every facet that went is passed at most once.
        for _ in 0..=self.seen.len() {
            let next = self.facets[here as usize].neighbours[crossing];
            if next >= first_new {
                return next;
            }
            let entered = slot_of(&self.facets[next as usize].neighbours, here);
            crossing = slot_of(&self.facets[next as usize].vertices, carried);
            carried = self.facets[next as usize].vertices[entered];
            here = next;
        }
        first_new
    }

    /// Adds a facet and queues it; `false` for a sliver, which is kept but never pushed out.
    fn add(&mut self, vertices: [u32; N], neighbours: [u32; N]) -> bool {
        let points = vertices.map(|vertex| self.vertices[vertex as usize].point);
        let plane = hyperplane(&points).and_then(|normal| {
            let height = normal.dot(points[0] - self.inside);
            let sign = if height < 0.0 { -1.0 } else { 1.0 };
            (height.abs() > limits::ON_PLANE * self.gap / limits::EPA_GAP).then_some(normal * sign)
        });
        let (normal, offset) = match plane {
            Some(normal) => (normal, normal.dot(points[0])),
            None => (Vector::ZERO, f64::INFINITY),
        };
        let facet = self.facets.len() as u32;
        self.facets.push(HullFacet { vertices, neighbours, normal, offset, alive: true });
        if plane.is_some() {
            self.queue.push(Queued { offset, facet });
        }
        plane.is_some()
    }
}

/// Height above a facet, in parts of the gap, from which it is seen: well below the gap, so that what is worth pushing
/// out is seen, and well above rounding.
const VISIBLE: f64 = 0.01;

fn slot_of<const N: usize>(list: &[u32; N], wanted: u32) -> usize {
    list.iter().position(|&entry| entry == wanted).unwrap_or(0)
}

/// A unit normal of the hyperplane through `N` points, by elimination with full pivoting on their `N − 1` differences.
/// `None` if they span less than a hyperplane.
pub(crate) fn hyperplane<const N: usize>(points: &[Vector<N>; N]) -> Option<Vector<N>> {
    let mut rows = [[0.0; N]; N];
    for k in 1..N {
        rows[k - 1] = (points[k] - points[0]).0;
    }
    // columns[i]: which coordinate stands in column i after the exchanges.
    let mut columns: [usize; N] = std::array::from_fn(|i| i);
    let mut largest = 0.0_f64;
    for k in 0..N - 1 {
        let mut pivot = (k, k);
        for i in k..N - 1 {
            for j in k..N {
                if rows[i][columns[j]].abs() > rows[pivot.0][columns[pivot.1]].abs() {
                    pivot = (i, j);
                }
            }
        }
        rows.swap(k, pivot.0);
        columns.swap(k, pivot.1);
        let value = rows[k][columns[k]];
        largest = largest.max(value.abs());
        if value.is_nan() || value.abs() <= limits::FLAT_SIMPLEX * largest {
            return None;
        }
        for i in k + 1..N - 1 {
            let factor = rows[i][columns[k]] / value;
            for j in k + 1..N {
                rows[i][columns[j]] -= factor * rows[k][columns[j]];
            }
        }
    }
    let mut normal = Vector::ZERO;
    normal[columns[N - 1]] = 1.0;
    for k in (0..N - 1).rev() {
        let mut sum = 0.0;
        for j in k + 1..N {
            sum += rows[k][columns[j]] * normal[columns[j]];
        }
        normal[columns[k]] = -sum / rows[k][columns[k]];
    }
    normal.try_normalize()
}

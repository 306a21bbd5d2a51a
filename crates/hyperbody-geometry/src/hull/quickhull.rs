//! The simplicial hull: quickhull over facets that are simplices, with the points outside each facet kept in its list.
//!
//! A point that is in the hyperplane of a facet does not see it. So a new facet, over a ridge between one that the new
//! point sees and one that it does not, is never degenerate as long as these answers are consistent.

use std::collections::VecDeque;

use hyperbody_math::Vector;

use super::kernel::Kernel;
use crate::tolerances::MAX_HULL_SIMPLICES;

/// Why an attempt broke off; another tolerance may succeed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Failure {
    /// The points span only this many dimensions.
    Flat(usize),
    /// More than [`MAX_HULL_SIMPLICES`].
    TooManyFacets,
    /// Rounding made the facets contradict each other.
    Inconsistent(&'static str),
}

/// One facet of the simplicial hull.
#[derive(Clone, Debug)]
pub(super) struct Simplex<P, const N: usize> {
    /// Indices of its points.
    pub(super) vertices: [u32; N],
    /// The simplex across the ridge that leaves out vertex i.
    pub(super) neighbours: [u32; N],
    /// Outward.
    pub(super) plane: P,
    /// Points that see this simplex, each in the list of one simplex only.
    outside: Vec<u32>,
    removed: bool,
    /// The last point whose search for visible facets came here.
    visited_for: u32,
}

/// The hull of `points` as simplices that close up. Hyperplanes closer together than `tie` count as equally far when
/// the farthest point is sought.
///
/// Every point is added or dropped once, so the work is bounded by the number of points times that of facets.
pub(super) fn simplicial_hull<const N: usize, K: Kernel<N>>(
    kernel: &K,
    points: &[Vector<N>],
    corners: &[u32],
    tie: f64,
) -> Result<Vec<Simplex<K::Plane, N>>, Failure> {
    let mut hull = Builder::new(kernel, points, corners, tie)?;
    while let Some(simplex) = hull.pending.pop_front() {
        if let Some(point) = hull.take_farthest(simplex) {
            hull.add(point, simplex)?;
        }
        // Memory stays in proportion to the facets that are left; the cost is spread over the removals.
        if hull.removed_count > 1024 && hull.removed_count > hull.simplices.len() / 2 {
            hull.compact();
        }
    }
    hull.compact();
    Ok(hull.simplices)
}

/// `N + 1` points that span the space, each the farthest from the flat through those before it.
pub(super) fn spanning_corners<const N: usize>(points: &[Vector<N>], flatness: f64) -> Result<Vec<u32>, Failure> {
    let mut farthest = 0;
    for (index, point) in points.iter().enumerate() {
        if point.norm_sq() > points[farthest].norm_sq() {
            farthest = index;
        }
    }
    let base = points[farthest];
    let mut corners = vec![farthest as u32];
    // Each point's offset from the flat; projected out one direction at a time, twice for orthogonality.
    let mut residuals: Vec<Vector<N>> = points.iter().map(|&p| p - base).collect();
    for dimension in 0..N {
        let mut best = 0;
        for index in 1..residuals.len() {
            if residuals[index].norm_sq() > residuals[best].norm_sq() {
                best = index;
            }
        }
        let Some(direction) = residuals[best].try_normalize().filter(|_| residuals[best].norm() > flatness) else {
            return Err(Failure::Flat(dimension));
        };
        corners.push(best as u32);
        for residual in &mut residuals {
            for _ in 0..2 {
                *residual -= direction * direction.dot(*residual);
            }
        }
    }
    Ok(corners)
}

struct Builder<'a, K: Kernel<N>, const N: usize> {
    kernel: &'a K,
    points: &'a [Vector<N>],
    tie: f64,
    simplices: Vec<Simplex<K::Plane, N>>,
    removed_count: usize,
    /// Simplices that may have points outside.
    pending: VecDeque<u32>,
    // Scratch of `add`.
    visible: Vec<u32>,
    horizon: Vec<(u32, usize)>,
    ridges: Vec<([u32; N], u32, usize)>,
}

impl<'a, K: Kernel<N>, const N: usize> Builder<'a, K, N> {
    fn new(kernel: &'a K, points: &'a [Vector<N>], corners: &[u32], tie: f64) -> Result<Self, Failure> {
        let mut builder = Self {
            kernel,
            points,
            tie,
            simplices: Vec::new(),
            removed_count: 0,
            pending: VecDeque::new(),
            visible: Vec::new(),
            horizon: Vec::new(),
            ridges: Vec::new(),
        };
        for left_out in 0..=N {
            // Leaving out corner k: the simplex across the ridge without corner i is the one that leaves out i.
            let others: [usize; N] = std::array::from_fn(|i| if i < left_out { i } else { i + 1 });
            let simplex = builder.push(others.map(|i| corners[i]))?;
            builder.simplices[simplex as usize].neighbours = others.map(|i| i as u32);
        }
        let all: Vec<u32> = (0..points.len() as u32).filter(|index| !corners.contains(index)).collect();
        builder.distribute(&all, 0);
        Ok(builder)
    }

    /// Appends the simplex on these points, facing away from the interior.
    fn push(&mut self, vertices: [u32; N]) -> Result<u32, Failure> {
        if self.simplices.len() - self.removed_count >= MAX_HULL_SIMPLICES {
            return Err(Failure::TooManyFacets);
        }
        let plane = self.kernel.plane(vertices)?;
        self.simplices.push(Simplex {
            vertices,
            neighbours: [u32::MAX; N],
            plane,
            outside: Vec::new(),
            removed: false,
            visited_for: u32::MAX,
        });
        Ok(self.simplices.len() as u32 - 1)
    }

    /// Puts each point into the list of the first simplex from `first` on that it is outside of, if there is one.
    fn distribute(&mut self, indices: &[u32], first: usize) {
        for &index in indices {
            let kernel = self.kernel;
            if let Some(simplex) = self.simplices[first..].iter_mut().find(|s| kernel.sees(&s.plane, index)) {
                simplex.outside.push(index);
            }
        }
        for simplex in first..self.simplices.len() {
            if !self.simplices[simplex].outside.is_empty() {
                self.pending.push_back(simplex as u32);
            }
        }
    }

    /// Removes and returns the point farthest outside of a simplex. Of points equally far, which a flat facet of the
    /// final hull makes the rule, the one farthest from the centre: it is a true vertex, where others may lie inside
    /// the facet.
    fn take_farthest(&mut self, simplex: u32) -> Option<u32> {
        let simplex = &mut self.simplices[simplex as usize];
        if simplex.removed {
            return None;
        }
        let plane = K::hyperplane(&simplex.plane);
        let mut best: Option<(usize, f64, f64)> = None;
        for (position, &index) in simplex.outside.iter().enumerate() {
            let point = self.points[index as usize];
            let (distance, reach) = (plane.distance(point), point.norm_sq());
            let better = best.is_none_or(|(_, farthest, farthest_reach)| {
                distance > farthest + self.tie || (distance >= farthest - self.tie && reach > farthest_reach)
            });
            if better {
                best = Some((position, distance, reach));
            }
        }
        best.map(|(position, ..)| simplex.outside.swap_remove(position))
    }

    /// Replaces the simplices that see `point`, of which `first` is one, by the cone from it over their horizon.
    fn add(&mut self, point: u32, first: u32) -> Result<(), Failure> {
        self.find_horizon(point, first);
        let start = self.simplices.len();
        for position in 0..self.horizon.len() {
            let (old, slot) = self.horizon[position];
            let mut vertices = self.simplices[old as usize].vertices;
            let across = self.simplices[old as usize].neighbours[slot];
            // The apex takes the place of the vertex that the ridge leaves out, so its slot leads across the horizon.
            vertices[slot] = point;
            let new = self.push(vertices)?;
            self.simplices[new as usize].neighbours[slot] = across;
            let back = self.slot_back(across, old).ok_or(Failure::Inconsistent("a one-sided ridge"))?;
            self.simplices[across as usize].neighbours[back] = new;
        }
        self.join_new(start, point)?;
        let mut orphans = Vec::new();
        for position in 0..self.visible.len() {
            let simplex = &mut self.simplices[self.visible[position] as usize];
            simplex.removed = true;
            orphans.append(&mut simplex.outside);
        }
        self.removed_count += self.visible.len();
        self.distribute(&orphans, start);
        Ok(())
    }

    /// The slot of `across` that leads to its neighbour `old`: that of the only vertex that is not one of `old`.
    fn slot_back(&self, across: u32, old: u32) -> Option<usize> {
        let (across, old_vertices) = (&self.simplices[across as usize], &self.simplices[old as usize].vertices);
        (0..N).find(|&i| across.neighbours[i] == old && !old_vertices.contains(&across.vertices[i]))
    }

    /// Fills `visible` with the simplices that see the point, and `horizon` with their ridges to those that do not.
    fn find_horizon(&mut self, point: u32, first: u32) {
        self.visible.clear();
        self.horizon.clear();
        self.visible.push(first);
        self.simplices[first as usize].visited_for = point;
        let mut next = 0;
        while next < self.visible.len() {
            let current = self.visible[next];
            next += 1;
            for slot in 0..N {
                let neighbour = self.simplices[current as usize].neighbours[slot];
                let simplex = &mut self.simplices[neighbour as usize];
                let sees = simplex.visited_for == point || self.kernel.sees(&simplex.plane, point);
                if !sees {
                    self.horizon.push((current, slot));
                } else if simplex.visited_for != point {
                    simplex.visited_for = point;
                    self.visible.push(neighbour);
                }
            }
        }
    }

    /// Makes neighbours of the new simplices, from index `start` on, that share a ridge through the new point.
    fn join_new(&mut self, start: usize, point: u32) -> Result<(), Failure> {
        self.ridges.clear();
        for index in start..self.simplices.len() {
            let vertices = self.simplices[index].vertices;
            for slot in (0..N).filter(|&slot| vertices[slot] != point) {
                let mut key = vertices;
                key[slot] = u32::MAX;
                key.sort_unstable();
                self.ridges.push((key, index as u32, slot));
            }
        }
        self.ridges.sort_unstable();
        let (pairs, rest) = self.ridges.as_chunks::<2>();
        if !rest.is_empty() {
            return Err(Failure::Inconsistent("an open horizon"));
        }
        let mut previous = None;
        for [(key, a, slot_a), (other_key, b, slot_b)] in pairs {
            if key != other_key || previous == Some(key) {
                return Err(Failure::Inconsistent("a horizon that touches itself"));
            }
            previous = Some(key);
            self.simplices[*a as usize].neighbours[*slot_a] = *b;
            self.simplices[*b as usize].neighbours[*slot_b] = *a;
        }
        Ok(())
    }

    /// Drops the removed simplices and renumbers the rest.
    fn compact(&mut self) {
        let mut number = 0;
        let mut renumbered = vec![u32::MAX; self.simplices.len()];
        for (new, simplex) in renumbered.iter_mut().zip(&self.simplices) {
            if !simplex.removed {
                *new = number;
                number += 1;
            }
        }
        self.simplices.retain(|simplex| !simplex.removed);
        for simplex in &mut self.simplices {
            simplex.neighbours = simplex.neighbours.map(|n| renumbered[n as usize]);
        }
        self.pending.retain_mut(|simplex| {
            *simplex = renumbered[*simplex as usize];
            *simplex != u32::MAX
        });
        self.removed_count = 0;
    }
}

//! The point of a simplex closest to the origin.
//!
//! P. Wolfe, "Finding the nearest point in a polytope" (1976): keep points whose affine hull has its nearest point
//! inside their simplex; add one; go from the old nearest point towards the new hull's, drop the points whose weight
//! vanishes on the way, and repeat. Every turn drops a point, so it ends after at most as many as there are.

use hyperbody_math::Vector;

use crate::difference::Vertex;
use crate::limits;

/// Most points of a simplex: one more than the dimension, at most six.
pub(crate) const MAX_SIMPLEX: usize = 7;

/// Affinely independent vertices with positive weights of sum one, and the point they make.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simplex<const N: usize> {
    vertices: [Vertex<N>; MAX_SIMPLEX],
    weights: [f64; MAX_SIMPLEX],
    len: usize,
    /// Of the simplex, the point nearest to the origin.
    pub(crate) nearest: Vector<N>,
}

/// The point of an affine hull nearest to the origin.
#[derive(Clone, Copy, Debug)]
struct AffineMinimum<const N: usize> {
    weights: [f64; MAX_SIMPLEX],
    nearest: Vector<N>,
}

impl<const N: usize> Simplex<N> {
    pub(crate) fn new(vertex: Vertex<N>) -> Self {
        let mut simplex = Self {
            vertices: [Vertex::ORIGIN; MAX_SIMPLEX],
            weights: [0.0; MAX_SIMPLEX],
            len: 1,
            nearest: vertex.point,
        };
        simplex.vertices[0] = vertex;
        simplex.weights[0] = 1.0;
        simplex
    }

    /// The simplex of all the given vertices, if they are affinely independent and the point of their affine hull
    /// nearest to the origin lies strictly inside it.
    pub(crate) fn of(vertices: &[Vertex<N>]) -> Option<Self> {
        Self::foot_on(vertices).filter(|simplex| simplex.least_weight() > SMALLEST_WEIGHT)
    }

    /// The simplex of all the given vertices with the weights of the point of their affine hull nearest to the origin,
    /// negative ones included. `None` if they are affinely dependent.
    pub(crate) fn foot_on(vertices: &[Vertex<N>]) -> Option<Self> {
        let mut simplex = Self::new(*vertices.first()?);
        simplex.len = vertices.len().min(N + 1);
        simplex.vertices[..simplex.len].copy_from_slice(&vertices[..simplex.len]);
        let minimum = simplex.affine_minimum()?;
        (simplex.weights, simplex.nearest) = (minimum.weights, minimum.nearest);
        Some(simplex)
    }

    /// The simplex with negative weights set to zero: its point moved inside.
    pub(crate) fn clamped(mut self) -> Self {
        let positive = self.weights.map(|weight| weight.max(0.0));
        let sum: f64 = positive[..self.len].iter().sum();
        self.weights = positive.map(|weight| weight / sum);
        self
    }

    pub(crate) fn least_weight(&self) -> f64 {
        self.weights().iter().copied().fold(f64::INFINITY, f64::min)
    }

    pub(crate) fn vertices(&self) -> &[Vertex<N>] {
        &self.vertices[..self.len]
    }

    pub(crate) fn weights(&self) -> &[f64] {
        &self.weights[..self.len]
    }

    pub(crate) fn holds(&self, key: [u32; 2]) -> bool {
        self.vertices().iter().any(|vertex| vertex.key == key)
    }

    /// Whether the simplex has full dimension and therefore, its nearest point being inside, holds the origin.
    pub(crate) fn is_full(&self) -> bool {
        self.len == N + 1
    }

    /// The simplex with one more vertex, reduced to the face that holds its point nearest to the origin. `None` if
    /// the vertex depends on the others, to rounding.
    pub(crate) fn with(&self, vertex: Vertex<N>) -> Option<Self> {
        if self.len > N {
            return None;
        }
        let mut next = *self;
        next.vertices[next.len] = vertex;
        next.weights[next.len] = 0.0;
        next.len += 1;
        // Every turn but the last drops a vertex.
        for _ in 0..=N {
            let minimum = next.affine_minimum()?;
            let leaves = minimum.weights[..next.len].iter().any(|&weight| weight <= SMALLEST_WEIGHT);
            if !leaves {
                next.weights = minimum.weights;
                next.nearest = minimum.nearest;
                break;
            }
            next.step_towards(&minimum.weights);
        }
        Some(next)
    }

    /// The simplex with one more vertex whose weight is lost in rounding, for the direction that is orthogonal to them all.
    /// `None` if one of the weights is negative by more than that, or the simplex would have full dimension.
    pub(crate) fn joined(&self, vertex: Vertex<N>) -> Option<Self> {
        if self.len >= N {
            return None;
        }
        let mut vertices = self.vertices;
        vertices[self.len] = vertex;
        let foot = Self::foot_on(&vertices[..=self.len])?;
        (foot.least_weight() > -SMALLEST_WEIGHT).then(|| foot.clamped())
    }

    /// Moves the weights towards the target until the first vanishes, and drops what has vanished.
    fn step_towards(&mut self, target: &[f64; MAX_SIMPLEX]) {
        let mut share = f64::INFINITY;
        let mut first_out = 0;
        for index in 0..self.len {
            let (from, to) = (self.weights[index], target[index]);
            if to <= SMALLEST_WEIGHT {
                let here = if from > to { from / (from - to) } else { 0.0 };
                if here < share {
                    share = here;
                    first_out = index;
                }
            }
        }
        let share = share.min(1.0);
        let mut kept = 0;
        for index in 0..self.len {
            let weight = self.weights[index] + share * (target[index] - self.weights[index]);
            if index != first_out && (weight > 0.0 || target[index] > SMALLEST_WEIGHT) {
                self.vertices[kept] = self.vertices[index];
                self.weights[kept] = weight;
                kept += 1;
            }
        }
        self.len = kept.max(1);
    }

    /// Least squares for the point of the affine hull nearest to the origin, by modified Gram–Schmidt with the right
    /// side carried along (Björck 1967: backward stable). Where little is left of a vector, rounding has left some of it
    /// along the directions taken away: they are taken away twice, which is enough (Kahan, in Parlett 1980). Without that
    /// the normal of a small shape that all but touches a large one would lean by the large one's rounding. `None` if the points are affinely dependent to rounding.
    fn affine_minimum(&self) -> Option<AffineMinimum<N>> {
        let base = self.vertices[0].point;
        let edges = self.len - 1;
        let mut q = [Vector::ZERO; MAX_SIMPLEX];
        let mut r = [[0.0; MAX_SIMPLEX]; MAX_SIMPLEX];
        let mut rest = base;
        let mut projection = [0.0; MAX_SIMPLEX];
        for k in 0..edges {
            let edge = self.vertices[k + 1].point - base;
            let length = edge.norm();
            let mut column = edge;
            for i in 0..k {
                r[i][k] = q[i].dot(column);
                column -= q[i] * r[i][k];
            }
            if column.norm_sq() < CANCELLED_SQ * length * length {
                for i in 0..k {
                    let left = q[i].dot(column);
                    r[i][k] += left;
                    column -= q[i] * left;
                }
            }
            r[k][k] = column.norm();
            if r[k][k] <= limits::DEPENDENT * length || r[k][k] == 0.0 {
                return None;
            }
            q[k] = column / r[k][k];
            projection[k] = -q[k].dot(rest);
            rest += q[k] * projection[k];
        }
        if rest.norm_sq() < CANCELLED_SQ * base.norm_sq() {
            for k in 0..edges {
                let left = -q[k].dot(rest);
                projection[k] += left;
                rest += q[k] * left;
            }
        }
        let mut minimum = AffineMinimum { weights: [0.0; MAX_SIMPLEX], nearest: rest };
        let mut base_weight = 1.0;
        for k in (0..edges).rev() {
            let mut value = projection[k];
            for j in k + 1..edges {
                value -= r[k][j] * minimum.weights[j + 1];
            }
            minimum.weights[k + 1] = value / r[k][k];
            base_weight -= minimum.weights[k + 1];
        }
        minimum.weights[0] = base_weight;
        minimum.nearest.is_finite().then_some(minimum)
    }
}

/// Weights up to this are zero but for rounding: the vertex is not needed.
const SMALLEST_WEIGHT: f64 = 1e-14;

/// Share of a vector's length, squared, below which what is left of it is taken to be orthogonal only after a second turn.
const CANCELLED_SQ: f64 = 1e-6;

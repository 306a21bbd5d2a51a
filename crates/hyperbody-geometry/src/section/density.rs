//! Section functions in closed form: the volume of {p in K : n·p = c} as a function of c.
//!
//! It is the density of n·p for a point p that is uniform in K, times the volume of K. For a simplex that density is the
//! B-spline whose knots are the heights of its corners (H. B. Curry, I. J. Schoenberg, 1966); for a product, whose factors
//! are independent, the convolution of those of the factors.

use hyperbody_math::{Matrix, Vector};

use crate::Polytope;
use crate::quadrature::integrate_between;
use crate::volume::{factorial, unit_ball};

/// A simplex of full dimension with its volume, m^K.
#[derive(Clone, Debug)]
pub(crate) struct Simplex<const K: usize> {
    apex: Vector<K>,
    base: [Vector<K>; K],
    volume: f64,
}

/// Simplices from lists of K + 1 corners.
pub(crate) fn simplices<const K: usize>(points: &[Vector<K>], lists: &[Vec<u32>]) -> Vec<Simplex<K>> {
    let simplex = |corners: &Vec<u32>| {
        let apex = points[corners[0] as usize];
        let base: [Vector<K>; K] = std::array::from_fn(|i| points[corners[i + 1] as usize]);
        let volume = Matrix::from_columns(base.map(|p| p - apex)).determinant().abs() / factorial(K);
        Simplex { apex, base, volume }
    };
    lists.iter().map(simplex).collect()
}

/// Simplices that fill a polytope.
pub(crate) fn filling<const K: usize>(polytope: &Polytope<K>) -> Vec<Simplex<K>> {
    let mut points = polytope.vertices().to_vec();
    points.push(polytope.vertex_mean());
    let apex = polytope.vertices().len() as u32;
    let cone = |simplex: &[u32; K]| std::iter::once(apex).chain(simplex.iter().copied()).collect::<Vec<u32>>();
    simplices(&points, &polytope.boundary_simplices().iter().map(cone).collect::<Vec<_>>())
}

/// The section function of what simplices fill, for a unit normal.
pub(crate) fn of_simplices<const K: usize>(simplices: &[Simplex<K>], normal: Vector<K>, offset: f64) -> f64 {
    let of_simplex = |simplex: &Simplex<K>| {
        let mut knots = [0.0; MAX_KNOTS];
        knots[0] = simplex.apex.dot(normal) - offset;
        for (knot, corner) in knots[1..].iter_mut().zip(&simplex.base) {
            *knot = corner.dot(normal) - offset;
        }
        simplex.volume * spline_at_zero(&mut knots[..=K])
    };
    simplices.iter().map(of_simplex).sum()
}

/// The B-spline of integral one with these knots, at a height.
pub(super) fn spline(corners: &[f64], height: f64) -> f64 {
    let mut knots = [0.0; MAX_KNOTS];
    knots.iter_mut().zip(corners).for_each(|(knot, corner)| *knot = corner - height);
    spline_at_zero(&mut knots[..corners.len()])
}

/// Corners of a simplex in six dimensions.
const MAX_KNOTS: usize = 7;

/// The B-spline of integral one with the given knots, at zero. All terms of the recurrence are positive there (C. de Boor, M. G.
/// Cox, 1972), so that nothing cancels.
fn spline_at_zero(knots: &mut [f64]) -> f64 {
    knots.sort_unstable_by(f64::total_cmp);
    let degree = knots.len() - 1;
    let mut values = [0.0; MAX_KNOTS];
    for (value, pair) in values.iter_mut().zip(knots.windows(2)) {
        if pair[0] <= 0.0 && 0.0 < pair[1] {
            *value = 1.0 / (pair[1] - pair[0]);
        }
    }
    for order in 2..=degree {
        for first in 0..=degree - order {
            let (low, high) = (knots[first], knots[first + order]);
            let sum = -low * values[first] + high * values[first + 1];
            let width = high - low;
            values[first] = if width > 0.0 { sum / width * order as f64 / (order - 1) as f64 } else { 0.0 };
        }
    }
    values[0]
}

/// Volume of the section of a ball of `dimension` dimensions at a distance from its centre.
pub(crate) fn of_ball(dimension: usize, radius: f64, distance: f64) -> f64 {
    let left = (radius - distance) * (radius + distance);
    if left > 0.0 { unit_ball(dimension - 1) * half_power(left, dimension - 1) } else { 0.0 }
}

/// x^(k/2), x ≥ 0.
fn half_power(x: f64, k: usize) -> f64 {
    let whole: f64 = (0..k / 2).map(|_| x).product();
    if k.is_multiple_of(2) { whole } else { whole * x.sqrt() }
}

/// The section function of all points at most `radius` away from the segment between ±`half`: of a cylinder, a product of the
/// segment with a ball, and of two half balls.
pub(crate) fn of_capsule<const N: usize>(
    half: Vector<N>,
    radius: f64,
    normal: Vector<N>,
    offset: f64,
    tolerance: f64,
) -> f64 {
    let half_length = half.norm();
    let cosine = half.dot(normal) / half_length;
    let sine = (normal - half * (cosine / half_length)).norm();
    let cylinder = if sine < PARALLEL {
        if offset.abs() < half_length { unit_ball(N - 1) * half_power(radius * radius, N - 1) } else { 0.0 }
    } else {
        // Along the segment, as far as the ball there reaches the hyperplane.
        let reach = radius * sine / cosine.abs().max(f64::MIN_POSITIVE);
        let middle = if cosine == 0.0 { 0.0 } else { offset / cosine };
        let (low, high) = if cosine == 0.0 {
            (-half_length, half_length)
        } else {
            ((middle - reach).max(-half_length), (middle + reach).min(half_length))
        };
        integrate_between(low, high, tolerance, |along| of_ball(N - 1, radius, (offset - along * cosine) / sine) / sine)
    };
    [1.0, -1.0].iter().fold(cylinder, |sum, sign| {
        let height = offset - sign * half.dot(normal);
        sum + half_ball_section(N, radius, height, sign * cosine, sine, tolerance)
    })
}

/// Below this sine two directions are parallel.
const PARALLEL: f64 = 1e-12;

/// Volume of {z : |z| ≤ r, n·z = height, e·z ≥ 0} where the unit vectors e and n make an angle of the given cosine and sine: a
/// ball of one dimension less beyond a hyperplane.
fn half_ball_section(dimension: usize, radius: f64, height: f64, cosine: f64, sine: f64, tolerance: f64) -> f64 {
    let left_sq = (radius - height) * (radius + height);
    if left_sq <= 0.0 {
        return 0.0;
    }
    if sine < PARALLEL {
        return if cosine * height >= 0.0 { of_ball(dimension, radius, height) } else { 0.0 };
    }
    let left = left_sq.sqrt();
    let from = (-cosine * height / sine).max(-left);
    integrate_between(from, left, tolerance, |at| of_ball(dimension - 1, left, at))
}

/// One factor of a product as its section function sees it: with the factor's part of the normal.
pub(crate) struct Term<'a> {
    /// Length of the part of the normal, > 0.
    pub(crate) weight: f64,
    /// Least and greatest of unit part·p over the factor.
    pub(crate) range: [f64; 2],
    /// The section function of the factor along the unit part of the normal: offset and tolerance.
    pub(crate) section: Box<dyn Fn(f64, f64) -> f64 + 'a>,
}

/// The density of Σ weight_i s_i at `offset`, each s_i distributed as its section function says: a convolution.
pub(crate) fn of_sum(terms: &[Term<'_>], offset: f64, tolerance: f64) -> f64 {
    let Some((last, rest)) = terms.split_last() else { return 0.0 };
    if rest.is_empty() {
        return (last.section)(offset / last.weight, tolerance * last.weight) / last.weight;
    }
    let [low, high] = [0, 1].map(|side| rest.iter().map(|term| term.weight * term.range[side]).sum::<f64>());
    let from = last.range[0].max((offset - high) / last.weight);
    let to = last.range[1].min((offset - low) / last.weight);
    if to <= from {
        return 0.0;
    }
    // Section functions are at most the volume over the width, or so; half of it comes from each.
    let inner = 1e-2 * tolerance / (to - from);
    integrate_between(from, to, tolerance, |at| {
        let own = (last.section)(at, inner);
        if own > 0.0 { own * of_sum(rest, offset - last.weight * at, inner / own) } else { 0.0 }
    })
}

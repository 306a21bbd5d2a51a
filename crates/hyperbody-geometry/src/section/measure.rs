//! How much of a body a hyperplane cuts out: volumes of sections of convex bodies, curved ones too, without a polytope in
//! between.
//!
//! Polytopes, balls, capsules and products have formulas of their own (see `density`). Everything else is known by
//! its support function and measured from there, by recursion over the dimension of the flat that cuts:
//!
//! - dimension 1: the two farthest points;
//! - dimension 2: the arc between two supports is as good as a parabola once it is short, and the parabola fills two thirds of
//!   the triangle of its chord and tangents (Archimedes, "Quadrature of the parabola"); the farthest point across the chord
//!   halves the arc. Straight edges and corners are seen as such and end the search, so that polygons are exact;
//! - dimension m: the integral of the volumes of parallel flats of dimension m − 1 along a direction.

use hyperbody_math::{Vector, scalar};

use super::SupportMap;
use super::support::farthest_at_height;
use crate::quadrature::integrate_between;

/// A convex body cut by hyperplanes with orthonormal normals, one after the other, without a change of coordinates.
struct Flat<'a, B: ?Sized, const N: usize> {
    body: &'a B,
    /// Normal, offset, and the farthest points below and above the hyperplane of what the ones before have left.
    cuts: Vec<Cut<N>>,
}

struct Cut<const N: usize> {
    normal: Vector<N>,
    offset: f64,
    ends: [Vector<N>; 2],
}

impl<B: SupportMap<N> + ?Sized, const N: usize> Flat<'_, B, N> {
    /// The farthest point along a direction that is orthogonal to the normals of the first `cuts` cuts, which alone count.
    fn farthest(&self, direction: Vector<N>, cuts: usize) -> Vector<N> {
        let Some(Cut { normal, offset, ends }) = cuts.checked_sub(1).map(|last| &self.cuts[last]) else {
            return self.body.support(direction);
        };
        let height = |point: Vector<N>| normal.dot(point) - offset;
        farthest_at_height(|along| self.farthest(along, cuts - 1), height, *normal, *ends, direction, GAP)
    }

    /// Volume of what is left, of the dimension of `basis`, which with the normals makes an orthonormal basis of space.
    fn volume(&mut self, basis: &[Vector<N>], tolerance: f64) -> f64 {
        let cuts = self.cuts.len();
        match basis {
            [] => 1.0,
            [along] => (self.farthest(*along, cuts) - self.farthest(-*along, cuts)).dot(*along),
            [first, second] => Outline { flat: self, axes: [*first, *second] }.area(tolerance),
            [rest @ .., along] => {
                let ends = [self.farthest(-*along, cuts), self.farthest(*along, cuts)];
                let [low, high] = ends.map(|end| end.dot(*along));
                if high.is_nan() || high <= low {
                    return 0.0;
                }
                // What the parts may err adds up to less than what the whole may.
                let part = INNER_SHARE * tolerance / (high - low);
                integrate_between(low, high, tolerance, |offset| {
                    self.cuts.push(Cut { normal: *along, offset, ends });
                    let left = if offset > low && offset < high { self.volume(rest, part) } else { 0.0 };
                    self.cuts.pop();
                    left
                })
            }
        }
    }
}

/// How closely points are found, in parts of the body: far below any tolerance that integrals reach in reasonable time.
const GAP: f64 = 1e-11;

/// Error of an inner integral, in parts of that of the outer one.
const INNER_SHARE: f64 = 0.1;

/// The boundary of a plane convex figure.
struct Outline<'a, 'b, B: ?Sized, const N: usize> {
    flat: &'a Flat<'b, B, N>,
    axes: [Vector<N>; 2],
}

/// A point of the boundary and the direction in which it is the farthest one.
#[derive(Clone, Copy)]
struct Support {
    point: Vector<2>,
    outward: Vector<2>,
}

/// Halvings of an arc at most: each takes its square off the height.
const MAX_HALVINGS: u32 = 24;

/// Halvings before the error of an arc is believed.
const LEAST_HALVINGS: u32 = 2;

/// What an arc may err, in parts of the whole: the errors of fifty arcs of either sign hardly ever add up to more.
const ARC_SHARE: f64 = 0.1;

/// Directions with which the outline is begun.
const FIRST_DIRECTIONS: usize = 4;

impl<B: SupportMap<N> + ?Sized, const N: usize> Outline<'_, '_, B, N> {
    fn support(&self, outward: Vector<2>) -> Support {
        let direction = self.axes[0] * outward[0] + self.axes[1] * outward[1];
        let point = self.flat.farthest(direction, self.flat.cuts.len());
        Support { point: Vector([point.dot(self.axes[0]), point.dot(self.axes[1])]), outward }
    }

    /// The area, to within about `tolerance`, m².
    fn area(&self, tolerance: f64) -> f64 {
        let supports: [Support; FIRST_DIRECTIONS] = std::array::from_fn(|k| {
            let (sin, cos) = scalar::sin_cos(std::f64::consts::TAU * k as f64 / FIRST_DIRECTIONS as f64);
            self.support(Vector([cos, sin]))
        });
        let mut sum = 0.0;
        for k in 0..FIRST_DIRECTIONS {
            let (from, to) = (supports[k], supports[(k + 1) % FIRST_DIRECTIONS]);
            let base = supports[0].point;
            sum += 0.5 * cross(from.point - base, to.point - base);
            sum += self.beyond_chord(from, to, ARC_SHARE * tolerance, 0);
        }
        sum
    }

    /// The area between the boundary from one support to the next, counter-clockwise, and the chord.
    fn beyond_chord(&self, from: Support, to: Support, tolerance: f64, halvings: u32) -> f64 {
        let triangle = tangent_triangle(from, to);
        if triangle <= 1e-3 * tolerance || halvings == MAX_HALVINGS {
            return 2.0 / 3.0 * triangle;
        }
        let chord = to.point - from.point;
        let Some(outward) = Vector([chord[1], -chord[0]]).try_normalize() else { return 0.0 };
        let middle = self.support(outward);
        let inner = 0.5 * cross(middle.point - from.point, to.point - from.point).abs();
        let coarse = 2.0 / 3.0 * triangle;
        let fine = inner + 2.0 / 3.0 * (tangent_triangle(from, middle) + tangent_triangle(middle, to));
        // The error of a smooth arc falls by sixteen with each halving.
        let gained = (fine - coarse) / 15.0;
        if halvings >= LEAST_HALVINGS && gained.abs() <= tolerance {
            return fine + gained;
        }
        inner
            + self.beyond_chord(from, middle, tolerance, halvings + 1)
            + self.beyond_chord(middle, to, tolerance, halvings + 1)
    }
}

/// The area of the triangle between a chord and the tangents at its ends: zero along an edge and at a corner.
fn tangent_triangle(from: Support, to: Support) -> f64 {
    let chord = to.point - from.point;
    let sine = cross(from.outward, to.outward);
    if sine <= 0.0 {
        return 0.0;
    }
    // How far each end of the chord is below the tangent of the other.
    let (below_from, below_to) = (-from.outward.dot(chord), to.outward.dot(chord));
    0.5 * below_from.max(0.0) * below_to.max(0.0) / sine
}

fn cross(a: Vector<2>, b: Vector<2>) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// The volume (m^N) of a convex body that is known by its support function, to within about `tolerance`, m^N.
pub(super) fn volume_by_support<B: SupportMap<N> + ?Sized, const N: usize>(body: &B, tolerance: f64) -> f64 {
    let basis: Vec<Vector<N>> = (0..N).map(Vector::unit).collect();
    Flat { body, cuts: Vec::new() }.volume(&basis, tolerance)
}

/// The same for its section by the hyperplane of all points with normal·p = offset, unit normal, m^(N−1).
pub(super) fn section_by_support<B: SupportMap<N> + ?Sized, const N: usize>(
    body: &B,
    normal: Vector<N>,
    offset: f64,
    tolerance: f64,
) -> f64 {
    let ends = [body.support(-normal), body.support(normal)];
    if !(ends[0].dot(normal) < offset && ends[1].dot(normal) > offset) {
        return 0.0;
    }
    let cut = Cut { normal, offset, ends };
    Flat { body, cuts: vec![cut] }.volume(&basis_beside(normal), tolerance)
}

/// Orthonormal directions that together with a unit vector span space.
fn basis_beside<const N: usize>(normal: Vector<N>) -> Vec<Vector<N>> {
    let left_out = normal.axis_of_max_abs();
    let mut basis: Vec<Vector<N>> = Vec::with_capacity(N);
    for axis in (0..N).filter(|&axis| axis != left_out) {
        let rest = |v: Vector<N>| basis.iter().fold(v - normal * normal.dot(v), |v, &b| v - b * b.dot(v));
        // Twice is enough (Kahan, in Parlett 1980).
        basis.push(rest(rest(Vector::unit(axis))).normalize_or_zero());
    }
    basis
}

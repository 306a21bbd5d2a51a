//! Polytopes inside of curved bodies, with a bound on what they leave out.
//!
//! The hull of points of the boundary grows outward: wherever the body reaches farther than the tolerance beyond a facet, the
//! point that does joins the hull (the sandwich method: G. Rote, "The convergence rate of the sandwich algorithm", 1992; in
//! higher dimensions G. K. Kamenev, 1992). Flat faces and sharp edges of the body come out as such, the number of facets
//! is of the order that any method needs, and as the result is a polytope its surface is closed.

use hyperbody_math::Vector;

use super::SupportMap;
use crate::error::GeometryErrorKind::BadNumber;
use crate::{GeometryError, Polytope, Result};

/// Most vertices of an approximation.
pub const MAX_APPROXIMATION_VERTICES: usize = 100_000;

/// Most rounds: each brings the error to a quarter or so.
const MAX_ROUNDS: usize = 40;

/// A polytope with its vertices on the boundary of `body` and no point of the body more than `tolerance` (in metres)
/// beyond the hyperplane of any of its facets.
///
/// # Errors
/// `BadNumber` if the tolerance is not positive, or so small that more than [`MAX_APPROXIMATION_VERTICES`] are needed;
/// `Flat` if the body has no inside.
pub fn approximate<const N: usize>(body: &dyn SupportMap<N>, tolerance: f64) -> Result<Polytope<N>> {
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(GeometryError::new(
            BadNumber,
            format!("the tolerance of a section is {tolerance}: it must be a positive number of metres"),
        ));
    }
    let mut points: Vec<Vector<N>> = Vec::new();
    for axis in 0..N {
        points.extend([body.support(Vector::unit(axis)), body.support(-Vector::unit(axis))]);
    }
    span_space(body, &mut points);
    let mut polytope = Polytope::from_points(&points)?;
    for _ in 0..MAX_ROUNDS {
        let mut beyond: Vec<Vector<N>> = Vec::new();
        for facet in polytope.facets() {
            let farthest = body.support(facet.normal);
            if facet.normal.dot(farthest) - facet.offset > tolerance {
                beyond.push(farthest);
            }
        }
        if beyond.is_empty() {
            return Ok(polytope);
        }
        points = polytope.vertices().to_vec();
        points.append(&mut beyond);
        if points.len() > MAX_APPROXIMATION_VERTICES {
            break;
        }
        polytope = Polytope::from_points(&points)?;
    }
    Err(GeometryError::new(
        BadNumber,
        format!(
            "a section of radius {} with an error of {tolerance} would have more than {MAX_APPROXIMATION_VERTICES} vertices: \
             allow a larger error",
            polytope.bounding_radius()
        ),
    ))
}

/// Adds points until they span the space, if the body does: slender bodies across the diagonal have all their extreme points
/// along the axes in one flat.
fn span_space<const N: usize>(body: &dyn SupportMap<N>, points: &mut Vec<Vector<N>>) {
    let mut basis: Vec<Vector<N>> = Vec::new();
    let reach = points.iter().map(|p| (*p - points[0]).norm()).fold(0.0, f64::max);
    let rest = |v: Vector<N>, basis: &[Vector<N>]| {
        // Twice is enough (Kahan, in Parlett 1980).
        let once = basis.iter().fold(v, |v, &b| v - b * b.dot(v));
        basis.iter().fold(once, |v, &b| v - b * b.dot(v))
    };
    for index in 1..points.len() {
        let out = rest(points[index] - points[0], &basis);
        if out.norm() > 1e-6 * reach && basis.len() < N {
            basis.push(out.normalize_or_zero());
        }
    }
    while basis.len() < N {
        let outward = (0..N)
            .map(|axis| rest(Vector::unit(axis), &basis))
            .fold(Vector::ZERO, |best: Vector<N>, v| if v.norm_sq() > best.norm_sq() { v } else { best });
        let outward = outward.normalize_or_zero();
        points.extend([body.support(outward), body.support(-outward)]);
        basis.push(outward);
    }
}

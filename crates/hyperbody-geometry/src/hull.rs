//! The convex hull of points in any number of dimensions, as a [`Polytope`] whose facets may have any number of
//! vertices.
//!
//! Quickhull (C. B. Barber, D. P. Dobkin, H. Huhdanpaa, 1996) builds a boundary of simplices; neighbours in one
//! hyperplane then become one facet, and points that are not vertices drop out. A hyperplane is thick by a tolerance
//! relative to the extent of the points: as long as the input leaves a gap between rounding errors and meant features,
//! every decision is the one that exact arithmetic would make on the ideal input, so cubes, grids and the 120-cell are
//! as safe as points in general position.
//!
//! Where there is no such gap, decisions may contradict each other. So the result is checked: every point inside every
//! facet, facets flat, each ridge shared by exactly two, all faces closing up. If a check fails, the hyperplanes get
//! thicker, and at last the points are moved to a fine grid and their hull is computed with exact integers, which always
//! succeeds but takes noise for features. (From the start it would break the facets of the 120-cell up into slivers whose
//! normals are rounding errors.)
//!
//! Crates were looked at: `chull` ends with simplices and leaves coplanar ones apart, `qhull` binds a C library, which
//! wasm and the promise of equal bits on every platform rule out; others stop at three dimensions.

mod kernel;
mod merge;
pub(crate) mod plane;
mod quickhull;
mod wide;

use hyperbody_math::Vector;

use crate::error::GeometryErrorKind::{BadCount, BadNumber, Flat, Unsupported};
use crate::order;
use crate::tolerances::{
    FLATNESS, HULL_ATTEMPTS, HULL_TOLERANCE, HULL_TOLERANCE_GROWTH, MAX_GROWN_TOLERANCE, MAX_HULL_POINTS,
    MAX_HULL_SIMPLICES,
};
use crate::{GeometryError, Polytope, Result};
use kernel::{Exact, Thick};
use quickhull::Failure;

/// The hull of `points`, with [`HULL_TOLERANCE`]; see [`Polytope::from_points`]. Returns the indices of the vertices
/// among the points as well.
///
/// # Errors
/// As [`Polytope::from_points`].
pub fn convex_hull<const N: usize>(points: &[Vector<N>]) -> Result<(Polytope<N>, Vec<u32>)> {
    convex_hull_within(points, HULL_TOLERANCE)
}

/// The hull of `points`, where points closer than `tolerance` (relative to half the extent of the point set) to a
/// hyperplane count as lying in it: about the precision of the coordinates, at most 1e-3.
///
/// # Errors
/// As [`Polytope::from_points`].
pub fn convex_hull_within<const N: usize>(points: &[Vector<N>], tolerance: f64) -> Result<(Polytope<N>, Vec<u32>)> {
    let (centre, extent) = check_points(points)?;
    if !(1e-13..=1e-3).contains(&tolerance) {
        return Err(GeometryError::new(
            BadNumber,
            format!("the tolerance of a hull is {tolerance}: it must lie between 1e-13 and 1e-3"),
        ));
    }
    let flatness = FLATNESS.max(10.0 * tolerance);
    let distinct = first_of_equals(points);
    let scaled: Vec<Vector<N>> = distinct.iter().map(|&i| (points[i as usize] - centre) / extent).collect();
    match hull_of_scaled(&scaled, tolerance, flatness) {
        Ok((polytope, used)) => {
            let used: Vec<u32> = used.iter().map(|&i| distinct[i as usize]).collect();
            Ok((polytope.placed(points, &used, centre, extent), used))
        }
        Err(failure) => Err(explain::<N>(failure, points.len(), extent, flatness)),
    }
}

/// The hull of points between −1 and 1: with thick hyperplanes, if need be thicker ones, and at last with exact ones.
fn hull_of_scaled<const N: usize>(
    points: &[Vector<N>],
    tolerance: f64,
    flatness: f64,
) -> std::result::Result<(Polytope<N>, Vec<u32>), Failure> {
    let corners = quickhull::spanning_corners(points, flatness)?;
    let sum = corners.iter().fold(Vector::ZERO, |sum, &c| sum + points[c as usize]);
    let mut thick = Thick { points, tolerance, interior: sum / corners.len() as f64 };
    for _ in 0..HULL_ATTEMPTS {
        let attempt = quickhull::simplicial_hull(&thick, points, &corners, thick.tolerance)
            .and_then(|simplices| merge::polytope_from_simplices(&thick, points, &simplices, thick.tolerance));
        match attempt {
            Err(Failure::Inconsistent(_)) => thick.tolerance *= HULL_TOLERANCE_GROWTH,
            other => return other,
        }
        if thick.tolerance > MAX_GROWN_TOLERANCE {
            break;
        }
    }
    let exact = Exact::new(points, &corners);
    let simplices = quickhull::simplicial_hull(&exact, points, &corners, tolerance)?;
    merge::polytope_from_simplices(&exact, points, &simplices, tolerance)
}

/// Ascending indices of the points without later copies of the same point.
fn first_of_equals<const N: usize>(points: &[Vector<N>]) -> Vec<u32> {
    // Adding zero makes −0 and 0 one number.
    let key = |index: u32| points[index as usize].0.map(|c| (c + 0.0).to_bits());
    let keys: Vec<u64> = points.iter().flat_map(|point| point.0.map(|c| (c + 0.0).to_bits())).collect();
    let mut order = order::of_keys(&keys, N);
    order.dedup_by_key(|index| key(*index));
    order.sort_unstable();
    order
}

/// Centre and half-width (largest over the axes) of the points' bounding box.
fn check_points<const N: usize>(points: &[Vector<N>]) -> Result<(Vector<N>, f64)> {
    if !(2..=6).contains(&N) {
        return Err(GeometryError::new(Unsupported, format!("hulls have two to six dimensions, not {N}")));
    }
    if points.len() <= N || points.len() > MAX_HULL_POINTS {
        return Err(GeometryError::new(
            BadCount,
            format!("a polytope in {N} dimensions needs {} to {MAX_HULL_POINTS} points, got {}", N + 1, points.len()),
        ));
    }
    if let Some(index) = points.iter().position(|p| !p.is_finite()) {
        let message = format!("point {index} of a polytope is {:?}: coordinates must be finite", points[index].0);
        return Err(GeometryError::new(BadNumber, message));
    }
    let (mut lower, mut upper) = (points[0], points[0]);
    for &point in points {
        (lower, upper) = (lower.min(point), upper.max(point));
    }
    let centre = lower * 0.5 + upper * 0.5;
    let extent = (upper * 0.5 - lower * 0.5).max_abs();
    if extent < f64::MIN_POSITIVE / f64::EPSILON {
        return Err(explain::<N>(Failure::Flat(0), points.len(), extent, FLATNESS));
    }
    Ok((centre, extent))
}

fn explain<const N: usize>(failure: Failure, count: usize, extent: f64, flatness: f64) -> GeometryError {
    match failure {
        Failure::Flat(dimension) => GeometryError::new(
            Flat,
            format!(
                "the {count} points of a polytope span only {dimension} of {N} dimensions (to {flatness:e} of their \
                 half-width {extent}): the body would have no volume; add points off that flat, or build it in \
                 {dimension} dimensions"
            ),
        ),
        Failure::TooManyFacets => GeometryError::new(
            BadCount,
            format!(
                "the hull of {count} points has more than {MAX_HULL_SIMPLICES} facets at some stage: use fewer points, or \
                 round the shape"
            ),
        ),
        Failure::Inconsistent(what) => GeometryError::new(
            BadNumber,
            format!(
                "the {count} points of a polytope leave no clear hull ({what}): they differ from flat facets by about as \
                 much as from each other; remove near-duplicates, or give more digits"
            ),
        ),
    }
}

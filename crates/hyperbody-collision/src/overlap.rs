//! The way out of an overlap: which normal, and how that is known to be right.
//!
//! The exact answer is the search of [`crate::epa`]. Resting contacts ask the same question every step, so three cheaper
//! things come first:
//!
//! - the facet normals of both shapes, all of them: an upper bound, and the answer that is wanted when it is nearly best;
//! - the facet of D that won in the previous step, computed anew from its vertices: one support tells whether it still
//!   is a facet;
//! - a lower bound: a point p inside both shapes, at distances r_A and r_B from their boundaries, shows that no way out
//!   is shorter than r_A + r_B, because h_A(n) − n·p ≥ r_A and h_B(−n) + n·p ≥ r_B for every unit n.

use hyperbody_geometry::Core;
use hyperbody_math::Vector;

use crate::box_sat::Feature;
use crate::difference::{Difference, inner_radius};
use crate::inner_hull::hyperplane;
use crate::limits;
use crate::manifold::Manifold;

/// A direction with the depth along it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WayOut<const N: usize> {
    /// Unit, in a's frame, from a to b.
    pub(crate) normal: Vector<N>,
    pub(crate) depth: f64,
    pub(crate) feature: Feature,
    /// Number of the facet; 0 for mixed ones.
    pub(crate) facet: u32,
}

/// Half the least thickness, or so: what small tolerances on depths are measured by. Segments and points have none and
/// don't count.
pub(crate) fn thickness<const N: usize>(difference: &Difference<'_, N>) -> f64 {
    let of = |core: &Core<N>| match core {
        Core::Point | Core::Segment { .. } => f64::INFINITY,
        Core::Box { .. } | Core::Polytope(_) => inner_radius(core, Vector::ZERO).max(0.0),
    };
    let least = of(difference.a).min(of(difference.b));
    if least.is_finite() { least } else { 0.0 }
}

/// The depth below which a mixed way out is preferred to a facet normal with the given depth.
pub(crate) fn worth_leaving_facet(depth: f64, thickness: f64, previous: Feature) -> f64 {
    let hysteresis = if previous == Feature::Mixed { limits::HYSTERESIS * thickness } else { 0.0 };
    depth * (1.0 - limits::FACET_PREFERENCE_RELATIVE) - limits::FACET_PREFERENCE_ABSOLUTE * thickness + hysteresis
}

/// The facet normal of either shape with the least depth; of nearly equal ones that of the shape that won before, then
/// a's. `None` if neither has facets. `toward_b` is a guess at the answer that saves work.
pub(crate) fn best_facet<const N: usize>(
    difference: &Difference<'_, N>,
    thickness: f64,
    previous: Feature,
    toward_b: Vector<N>,
) -> Option<WayOut<N>> {
    let [deep_a, deep_b] = difference.vertices(difference.support(toward_b).key);
    let of_a = best_facet_of(difference, difference.a, Feature::FacetOfA, deep_b);
    let a_in_b = difference.a_from_b.inverse_transform_point(deep_a);
    let of_b = best_facet_of(difference, difference.b, Feature::FacetOfB, a_in_b);
    let (Some(a), Some(b)) = (of_a, of_b) else { return of_a.or(of_b) };
    let bonus = limits::HYSTERESIS * thickness;
    let handicap = if previous == Feature::FacetOfB { -bonus } else { bonus };
    Some(if b.depth < a.depth - handicap { b } else { a })
}

/// The facet normal of one core with the least depth. A point of the other core, in the frame of this one, bounds every
/// depth from below at the price of one product: a deep one leaves few facets for which the support is asked.
fn best_facet_of<const N: usize>(
    difference: &Difference<'_, N>,
    core: &Core<N>,
    feature: Feature,
    deep: Vector<N>,
) -> Option<WayOut<N>> {
    let mut first = (f64::INFINITY, 0);
    for_each_facet(core, |facet, outward, offset| {
        let at_least = offset - outward.dot(deep);
        if at_least < first.0 {
            first = (at_least, facet);
        }
    });
    let mut best: Option<WayOut<N>> = None;
    let consider = |best: &mut Option<WayOut<N>>, facet: usize, outward: Vector<N>, offset: f64| {
        let (normal, depth) = depth_along(difference, outward, offset, feature);
        if best.is_none_or(|best| depth < best.depth) {
            *best = Some(WayOut { normal, depth, feature, facet: facet as u32 });
        }
    };
    for_each_facet(core, |facet, outward, offset| {
        if facet == first.1 {
            consider(&mut best, facet, outward, offset);
        }
    });
    for_each_facet(core, |facet, outward, offset| {
        if facet != first.1 && best.is_none_or(|best| offset - outward.dot(deep) < best.depth) {
            consider(&mut best, facet, outward, offset);
        }
    });
    best
}

/// Calls `f` with number, outward unit normal and offset of every facet.
#[inline]
fn for_each_facet<const N: usize>(core: &Core<N>, mut f: impl FnMut(usize, Vector<N>, f64)) {
    match core {
        Core::Point | Core::Segment { .. } => {}
        Core::Box { half_extents } => {
            for axis in 0..N {
                f(2 * axis, Vector::unit(axis), half_extents[axis]);
                f(2 * axis + 1, -Vector::unit(axis), half_extents[axis]);
            }
        }
        Core::Polytope(polytope) => {
            for (index, facet) in polytope.facets().iter().enumerate() {
                f(index, facet.normal, facet.offset);
            }
        }
    }
}

/// The normal from a to b that an outward facet normal of a or b stands for, and the depth along it.
fn depth_along<const N: usize>(
    difference: &Difference<'_, N>,
    outward: Vector<N>,
    offset: f64,
    feature: Feature,
) -> (Vector<N>, f64) {
    let pose = difference.a_from_b;
    if feature == Feature::FacetOfB {
        let toward_a = pose.rotation.rotate(outward);
        let reach_a = difference.a.support(-toward_a).dot(-toward_a);
        (-toward_a, reach_a + offset + toward_a.dot(pose.translation))
    } else {
        let toward_a = -pose.rotation.inverse_rotate(outward);
        let reach_b = difference.b.support(toward_a).dot(toward_a);
        (outward, offset + reach_b - outward.dot(pose.translation))
    }
}

/// The facet of D through the given vertices, if they still span one and D does not reach beyond it. `toward_b` tells
/// its sides apart.
pub(crate) fn known_facet<const N: usize>(
    difference: &Difference<'_, N>,
    keys: &[[u32; 2]],
    toward_b: Vector<N>,
) -> Option<WayOut<N>> {
    if keys.len() != N {
        return None;
    }
    let mut points = [Vector::ZERO; N];
    for (point, &key) in points.iter_mut().zip(keys) {
        *point = difference.vertex(key).point;
    }
    let unsigned = hyperplane(&points)?;
    let normal = if unsigned.dot(toward_b) < 0.0 { -unsigned } else { unsigned };
    let depth = difference.reach(normal);
    let beyond = depth - points[0].dot(normal);
    let still = beyond <= limits::EPA_GAP * difference.scale;
    still.then_some(WayOut { normal, depth, feature: Feature::Mixed, facet: 0 })
}

/// A lower bound on the depth in every direction, from points that a manifold shows to lie in both shapes. The manifold
/// is in the world, without rounding radii.
pub(crate) fn least_possible_depth<const N: usize>(
    difference: &Difference<'_, N>,
    world_from_a: &hyperbody_math::Pose<N>,
    manifold: &Manifold<N>,
) -> f64 {
    let Some(deepest) = manifold.points().iter().min_by(|p, q| p.separation.total_cmp(&q.separation)) else {
        return 0.0;
    };
    let mut middle = Vector::ZERO;
    let mut count = 0.0;
    for point in manifold.points().iter().filter(|point| point.separation <= 0.5 * deepest.separation) {
        middle += point.position;
        count += 1.0;
    }
    let half = manifold.normal * (0.5 * deepest.separation);
    let mut bound = 0.0_f64;
    for point in [middle * (1.0 / f64::max(count, 1.0)), deepest.position + half, deepest.position - half] {
        let in_a = world_from_a.inverse_transform_point(point);
        let in_b = difference.a_from_b.inverse_transform_point(in_a);
        let (radius_a, radius_b) = (inner_radius(difference.a, in_a), inner_radius(difference.b, in_b));
        // A point on a boundary may be outside by a rounding.
        let slack = -limits::ON_PLANE * difference.scale;
        if radius_a >= slack && radius_b >= slack {
            bound = bound.max(radius_a + radius_b);
        }
    }
    bound
}

//! Rays against rounded boxes and rounded polytopes.
//!
//! Along a ray the distance f(t) to the convex core is convex. Newton's method for f(t) = radius, started before the
//! surface, therefore never steps over it, and is done when the step vanishes in rounding; where f rises while the gap is
//! still open, the ray passes by. One step is the clip of the ray against a supporting hyperplane (G. van den Bergen,
//! "Ray casting against general convex objects", 2004). Grazing rays, whose root is double, gain two bits a turn.

use hyperbody_geometry::{Core, Polytope};
use hyperbody_math::{Pose, Vector};

use super::flat::{self, Stretch};
use super::{Ray, RayHit};
use crate::difference::Difference;
use crate::gjk::{self, Proximity, Seeds};
use crate::limits;

/// Distance of a point from a core and the unit vector from the core to the point; distance 0 inside.
struct Apart<const N: usize> {
    distance: f64,
    normal: Vector<N>,
    /// The facet whose interior is nearest, where that is known.
    facet: Option<u32>,
}

/// All points at most `radius` from the box |p_i| ≤ h_i.
pub(super) fn cuboid<const N: usize>(ray: &Ray<N>, half_extents: &Vector<N>, radius: f64) -> Option<RayHit<N>> {
    let stretch = flat::slabs(ray, half_extents, radius)?;
    let scale = half_extents.norm() + radius;
    newton(ray, stretch, radius, scale, |point| {
        let nearest = point.min(*half_extents).max(-*half_extents);
        let out = point - nearest;
        let distance = out.norm();
        let axis = out.axis_of_max_abs();
        let on_facet = distance > 0.0 && out[axis].abs() == distance;
        Apart {
            distance,
            normal: out.normalize_or_zero(),
            facet: on_facet.then(|| 2 * axis as u32 + u32::from(out[axis] > 0.0)),
        }
    })
}

/// All points at most `radius` from the polytope, which is given also as a core.
pub(super) fn polytope<const N: usize>(
    ray: &Ray<N>,
    core: &Core<N>,
    polytope: &Polytope<N>,
    radius: f64,
) -> Option<RayHit<N>> {
    let stretch = flat::facets(ray, polytope, radius)?;
    let scale = polytope.bounding_radius() + radius;
    let mut seeds = Seeds::default();
    let mut first = true;
    newton(ray, stretch, radius, scale, |point| {
        if first && stretch.enter >= 0.0 {
            first = false;
            if let Some(apart) = above_facet(polytope, stretch.facet, point) {
                return apart;
            }
        }
        distance_to_polytope(core, polytope, point, &mut seeds)
    })
}

/// Distance to a facet, if the foot of the perpendicular lies in it.
fn above_facet<const N: usize>(polytope: &Polytope<N>, facet: u32, point: Vector<N>) -> Option<Apart<N>> {
    let plane = &polytope.facets()[facet as usize];
    let distance = plane.normal.dot(point) - plane.offset;
    let foot = point - plane.normal * distance;
    let inside = |&other: &u32| {
        let beside = &polytope.facets()[other as usize];
        beside.normal.dot(foot) <= beside.offset
    };
    let on_it = distance >= 0.0 && plane.neighbours.iter().all(inside);
    on_it.then_some(Apart { distance, normal: plane.normal, facet: Some(facet) })
}

fn distance_to_polytope<const N: usize>(
    core: &Core<N>,
    polytope: &Polytope<N>,
    point: Vector<N>,
    seeds: &mut Seeds,
) -> Apart<N> {
    let a_from_b = Pose::from_translation(point);
    let difference = Difference::new(core, &Core::Point, &a_from_b);
    let toward = point - polytope.vertices()[0];
    match gjk::closest(&difference, seeds, toward, f64::INFINITY, &mut 0) {
        Proximity::Near(closest) => {
            *seeds = Seeds::of(closest.simplex.vertices());
            Apart { distance: closest.distance, normal: closest.normal, facet: None }
        }
        Proximity::Overlap(_) | Proximity::Apart { .. } => Apart { distance: 0.0, normal: Vector::ZERO, facet: None },
    }
}

/// The root of f(t) = radius from the start of a stretch that holds it. `scale` is the size of the solid.
fn newton<const N: usize>(
    ray: &Ray<N>,
    stretch: Stretch,
    radius: f64,
    scale: f64,
    mut distance_of: impl FnMut(Vector<N>) -> Apart<N>,
) -> Option<RayHit<N>> {
    // Measured from near the solid, so that long rays lose no digits.
    let base = stretch.enter.max(0.0);
    if base > ray.max_fraction {
        return None;
    }
    let near = Ray { origin: ray.at(base), direction: ray.direction, max_fraction: ray.max_fraction - base };
    let tolerance = limits::RAY_GAP * scale;
    let mut t = 0.0;
    for turn in 0..limits::MAX_RAY_TURNS {
        let point = near.at(t);
        let apart = distance_of(point);
        let (gap, closing) = (apart.distance - radius, -apart.normal.dot(ray.direction));
        if turn == 0 && stretch.enter < 0.0 && (gap < 0.0 || (gap == 0.0 && closing <= 0.0)) {
            return Some(RayHit::inside(ray));
        }
        let next = t + gap / closing;
        if gap <= tolerance || (closing > 0.0 && next <= t) || turn + 1 == limits::MAX_RAY_TURNS {
            let point = point - apart.normal * gap;
            return Some(RayHit { point, ..RayHit::outside(ray, base + t, apart.normal, apart.facet) });
        }
        if !(closing > 0.0 && next <= near.max_fraction) {
            return None;
        }
        t = next;
    }
    None
}

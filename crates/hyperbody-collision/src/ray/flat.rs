//! Rays against flat-faced solids: the ray is inside a face's half-space from here to there, and inside the solid
//! where it is inside all of them.

use hyperbody_geometry::Polytope;
use hyperbody_math::Vector;

use super::{Ray, RayHit};

/// All points with normal·p ≤ offset.
pub(super) fn half_space<const N: usize>(ray: &Ray<N>, normal: Vector<N>, offset: f64) -> Option<RayHit<N>> {
    let height = normal.dot(ray.origin) - offset;
    let closing = -normal.dot(ray.direction);
    if height < 0.0 || (height == 0.0 && closing <= 0.0) {
        return Some(RayHit::inside(ray));
    }
    let fraction = height / closing;
    (closing > 0.0 && fraction <= ray.max_fraction).then(|| RayHit::outside(ray, fraction, normal, None))
}

/// The stretch of a ray inside of a solid, and the face through which it goes in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// Negative if the ray starts inside, −∞ if it never was outside.
    pub(super) enter: f64,
    pub(super) facet: u32,
}

/// The box |p_i| ≤ h_i.
#[inline]
pub(super) fn cuboid<const N: usize>(ray: &Ray<N>, half_extents: &Vector<N>) -> Option<RayHit<N>> {
    let stretch = slabs(ray, half_extents, 0.0)?;
    if stretch.enter < 0.0 {
        return Some(RayHit::inside(ray));
    }
    let (axis, positive) = (stretch.facet as usize / 2, stretch.facet % 2 == 1);
    let mut hit = RayHit::outside(ray, stretch.enter, Vector::ZERO, Some(stretch.facet));
    hit.normal[axis] = if positive { 1.0 } else { -1.0 };
    // Exactly in the face, whatever the rounding of the fraction.
    hit.point[axis] = if positive { half_extents[axis] } else { -half_extents[axis] };
    Some(hit)
}

/// The stretch inside the box |p_i| ≤ h_i + margin, if some of it lies within the ray.
#[inline]
pub(super) fn slabs<const N: usize>(ray: &Ray<N>, half_extents: &Vector<N>, margin: f64) -> Option<Stretch> {
    let (mut enter, mut exit) = (f64::NEG_INFINITY, ray.max_fraction);
    let mut facet = 0;
    for axis in 0..N {
        let (origin, direction, half) = (ray.origin[axis], ray.direction[axis], half_extents[axis] + margin);
        if direction == 0.0 {
            if origin.abs() > half {
                return None;
            }
            continue;
        }
        // Seen along the direction, the ray comes from the negative side.
        let (along, speed) = if direction < 0.0 { (-origin, -direction) } else { (origin, direction) };
        let near = (-half - along) / speed;
        let far = (half - along) / speed;
        if near > enter {
            enter = near;
            facet = 2 * axis as u32 + u32::from(direction < 0.0);
        }
        if far < exit {
            exit = far;
        }
    }
    (enter <= exit && exit >= 0.0).then_some(Stretch { enter, facet })
}

/// A convex polytope.
pub(super) fn polytope<const N: usize>(ray: &Ray<N>, polytope: &Polytope<N>) -> Option<RayHit<N>> {
    let stretch = facets(ray, polytope, 0.0)?;
    if stretch.enter < 0.0 {
        return Some(RayHit::inside(ray));
    }
    let normal = polytope.facets()[stretch.facet as usize].normal;
    Some(RayHit::outside(ray, stretch.enter, normal, Some(stretch.facet)))
}

/// The stretch inside all facets moved out by `margin`, if some of it lies within the ray. One division and no
/// unforeseeable branch a facet; a ray that misses is done as soon as two facets exclude each other.
pub(super) fn facets<const N: usize>(ray: &Ray<N>, polytope: &Polytope<N>, margin: f64) -> Option<Stretch> {
    let (mut enter, mut exit) = (f64::NEG_INFINITY, ray.max_fraction);
    let mut entered = 0;
    for (index, facet) in polytope.facets().iter().enumerate() {
        let depth = facet.offset + margin - facet.normal.dot(ray.origin);
        let rising = facet.normal.dot(ray.direction);
        // Along the facet: ±∞ where that decides, NaN, which no comparison takes, for a ray in the facet itself.
        let crossing = depth / rising.abs();
        let goes_in = rising < 0.0;
        let (near, far) = (if goes_in { -crossing } else { enter }, if goes_in { exit } else { crossing });
        if near > enter {
            enter = near;
            entered = index as u32;
        }
        if far < exit {
            exit = far;
        }
        if enter > exit {
            return None;
        }
    }
    (exit >= 0.0).then_some(Stretch { enter, facet: entered })
}

//! Rays against balls and capsules.
//!
//! The quadratic is solved from the point q of the ray that is closest to the centre: the half chord is √(r² − q²) and
//! nothing large cancels, wherever the ray starts (E. Haines et al., "Precision improvements for ray/sphere
//! intersection", 2019).

use hyperbody_math::Vector;

use super::{Ray, RayHit};

/// Where a line is closest to the origin, and the fractions before and after it at which the line goes into and out of
/// the ball of the given radius.
struct Chord<const N: usize> {
    closest: Vector<N>,
    middle: f64,
    half: f64,
}

impl<const N: usize> Chord<N> {
    fn new(origin: Vector<N>, direction: Vector<N>, radius: f64) -> Option<Self> {
        let speed_sq = direction.norm_sq();
        let middle = -origin.dot(direction) / speed_sq;
        let closest = origin + direction * middle;
        let distance = closest.norm();
        let rest = (radius - distance) * (radius + distance);
        (rest >= 0.0).then(|| Self { closest, middle, half: (rest / speed_sq).sqrt() })
    }
}

/// The ball of the given radius about the origin.
#[inline]
pub(super) fn ball<const N: usize>(ray: &Ray<N>, radius: f64) -> Option<RayHit<N>> {
    let chord = Chord::new(ray.origin, ray.direction, radius)?;
    let enter = chord.middle - chord.half;
    if chord.middle + chord.half < 0.0 || enter > ray.max_fraction {
        return None;
    }
    if enter < 0.0 {
        return Some(RayHit::inside(ray));
    }
    let normal = (chord.closest - ray.direction * chord.half).normalize_or_zero();
    Some(RayHit { point: normal * radius, ..RayHit::outside(ray, enter, normal, None) })
}

/// All points at most `radius` from the segment between ±`half`.
pub(super) fn capsule<const N: usize>(ray: &Ray<N>, half: Vector<N>, radius: f64) -> Option<RayHit<N>> {
    let length = half.norm();
    let axis = half / length;
    let foot = |point: Vector<N>| axis * axis.dot(point).clamp(-length, length);
    let out = ray.origin - foot(ray.origin);
    let distance = out.norm();
    if distance < radius || (distance == radius && out.dot(ray.direction) >= 0.0) {
        return Some(RayHit::inside(ray));
    }
    // Measured from the point closest to the centre, so that long rays lose no digits.
    let middle = -ray.origin.dot(ray.direction) / ray.direction.norm_sq();
    let near = Ray { origin: ray.at(middle), ..*ray };
    let enter = enter_capsule(&near, axis, length, radius)?;
    // The origin is outside, so all of the chord lies on one side of it.
    if enter + middle < 0.0 || enter + middle > ray.max_fraction {
        return None;
    }
    let point = near.at(enter);
    let centre = foot(point);
    let normal = (point - centre).normalize_or_zero();
    Some(RayHit { point: centre + normal * radius, ..RayHit::outside(ray, enter + middle, normal, None) })
}

/// Where a line goes into the capsule along the unit vector `axis`: a cylinder and two balls. The capsule is convex and
/// lies in the infinite cylinder, so that is the first of what the three give.
fn enter_capsule<const N: usize>(line: &Ray<N>, axis: Vector<N>, length: f64, radius: f64) -> Option<f64> {
    let (along, speed_along) = (axis.dot(line.origin), axis.dot(line.direction));
    let (across, speed_across) = (line.origin - axis * along, line.direction - axis * speed_along);
    if speed_across.norm_sq() > 0.0 {
        let chord = Chord::new(across, speed_across, radius)?;
        let enter = chord.middle - chord.half;
        if (along + enter * speed_along).abs() <= length {
            return Some(enter);
        }
    } else if across.norm() > radius {
        return None;
    }
    let ends = [-length, length].map(|end| {
        let chord = Chord::new(line.origin - axis * end, line.direction, radius);
        chord.map_or(f64::INFINITY, |chord| chord.middle - chord.half)
    });
    let first = ends[0].min(ends[1]);
    first.is_finite().then_some(first)
}

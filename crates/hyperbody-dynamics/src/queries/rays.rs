//! Rays against the bodies of a world.

use hyperbody_collision::ray::{Ray, RayHit, cast_on_piece};
use hyperbody_math::Vector;

use super::{Queries, QueryFilter, QueryScratch};
use crate::BodyHandle;

/// Where a ray meets a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyHit<const N: usize> {
    /// The body.
    pub body: BodyHandle,
    /// Where and how, in the world; `part` is the part of the body's shape.
    pub hit: RayHit<N>,
}

impl<const N: usize> Queries<'_, N> {
    /// The first body that a ray meets, of those that `filter` lets through. Of several that are met at the same
    /// fraction it is the one added to the world first, as far as slots were not used again. Rays that are not
    /// [valid](Ray::is_valid) meet nothing.
    pub fn ray_cast(
        &self,
        ray: &Ray<N>,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
    ) -> Option<BodyHit<N>> {
        let (ray, scale) = ray.evened()?;
        let mut first: Option<(u32, RayHit<N>)> = None;
        self.visit_hits(&ray, scratch, filter, |slot, hit| {
            let closer = first.is_none_or(|(best_slot, best)| {
                hit.fraction < best.fraction || (hit.fraction == best.fraction && slot < best_slot)
            });
            if closer {
                first = Some((slot, *hit));
            }
            Some(hit.fraction)
        });
        first.and_then(|(slot, hit)| self.in_world(slot, &hit, scale))
    }

    /// Whether a ray meets any body that `filter` lets through; stops at the first one found.
    pub fn ray_meets_any(&self, ray: &Ray<N>, scratch: &mut QueryScratch<N>, filter: &QueryFilter<'_>) -> bool {
        let Some((ray, _)) = ray.evened() else { return false };
        let mut met = false;
        self.visit_hits(&ray, scratch, filter, |_, _| {
            met = true;
            None
        });
        met
    }

    /// Every body that a ray meets, of those that `filter` lets through, from near to far, each convex part where the ray
    /// goes into it. `out` is emptied first.
    pub fn ray_cast_all(
        &self,
        ray: &Ray<N>,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
        out: &mut Vec<BodyHit<N>>,
    ) {
        out.clear();
        let Some((ray, scale)) = ray.evened() else { return };
        self.visit_hits(&ray, scratch, filter, |slot, hit| {
            out.extend(self.in_world(slot, hit, scale));
            Some(f64::INFINITY)
        });
        out.sort_unstable_by(|a, b| {
            let by_fraction = a.hit.fraction.total_cmp(&b.hit.fraction);
            by_fraction.then(a.body.cmp(&b.body)).then(a.hit.part.cmp(&b.hit.part))
        });
    }

    /// [`Queries::ray_cast`] for many rays, on the threads of the world; the same answers for every number of threads.
    /// `out` is emptied first and then holds one answer per ray, in their order.
    pub fn ray_casts(&self, rays: &[Ray<N>], filter: &QueryFilter<'_>, out: &mut Vec<Option<BodyHit<N>>>) {
        self.batch(rays, out, |ray, scratch| self.ray_cast(ray, scratch, filter));
    }

    /// `ray` is [evened](Ray::evened). Calls `visit` with slot and hit, in the frame of the collider, of every collider that the ray meets up to what
    /// `visit` last answered, until that is `None`.
    fn visit_hits(
        &self,
        ray: &Ray<N>,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
        mut visit: impl FnMut(u32, &RayHit<N>) -> Option<f64>,
    ) {
        let inverse_speed_sq = 1.0 / ray.direction.norm_sq();
        // What costs least comes first; the filter is asked for what is hit.
        let mut look = |slot: u32, reach: f64| {
            let pose = &self.world_from_collider[slot as usize];
            if passes_ball(ray, inverse_speed_sq, pose.translation, self.reaches[slot as usize]) {
                return Some(reach);
            }
            let Some(collider) = &self.world.colliders[slot as usize] else { return Some(reach) };
            match cast_on_piece(&ray.up_to(reach).seen_from(pose), &collider.piece) {
                Some(hit) if self.candidate(slot, filter).is_some() => {
                    visit(slot, &hit).map(|next| if next < reach { next } else { reach })
                }
                _ => Some(reach),
            }
        };
        let mut reach = ray.max_fraction;
        for &slot in &self.apart {
            match look(slot, reach) {
                Some(next) => reach = next,
                None => return,
            }
        }
        let ray = ray.up_to(reach);
        let visit = |slot: u32, reach: f64| if self.is_apart[slot as usize] { Some(reach) } else { look(slot, reach) };
        if self.single {
            self.world.tree.cast_ray(&ray, &mut scratch.rays, visit);
        } else {
            self.ray_tree().cast_ray(&ray, &mut scratch.rays, visit);
        }
    }

    /// A hit in the frame of its collider as users get it; fractions of the ray cast are `scale` times those of theirs.
    fn in_world(&self, slot: u32, hit: &RayHit<N>, scale: f64) -> Option<BodyHit<N>> {
        let collider = self.world.colliders[slot as usize].as_ref()?;
        let body = self.world.bodies.handle_at(collider.body)?;
        let hit = hit.in_world(&self.world_from_collider[slot as usize]);
        Some(BodyHit { body, hit: RayHit { part: self.part(slot), fraction: hit.fraction / scale, ..hit } })
    }
}

/// Whether the line of a ray passes by a ball, beyond doubt by rounding. The ball around a turned body fills little of the
/// body's box, the less the higher the dimension, so this spares most turns of rays into the frames of bodies.
#[inline]
fn passes_ball<const N: usize>(ray: &Ray<N>, inverse_speed_sq: f64, centre: Vector<N>, radius: f64) -> bool {
    let away = centre - ray.origin;
    let closest = away - ray.direction * (away.dot(ray.direction) * inverse_speed_sq);
    // (r + e)² ≤ r²(1 + 1e-9) + e²(1 + 1e9), where e is a hundred roundings of the way to the centre.
    closest.norm_sq() > radius * radius * (1.0 + 2e-9) + 1e-18 * away.norm_sq()
}

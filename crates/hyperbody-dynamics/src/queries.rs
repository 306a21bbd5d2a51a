//! What is where in a world: rays, points and boxes against its bodies.
//!
//! The tree of the broad phase holds each body with a margin and follows it at the start of each step, so that between
//! steps a body that was struck, or moved by hand, may stand outside of its box. [`World::queries`] looks at every body
//! once and notes these few; it costs about as much as a dozen rays per hundred bodies. Make it once after a step and ask
//! it as often as needed, from as many threads as needed. Nothing of the simulation changes by being looked at.
//!
//! Everything is solid and closed; sleeping, static and quarantined bodies count like others.

use hyperbody_collision::ray::{Ray, RayHit, cast_on_piece};
use hyperbody_collision::{RayStack, point};
use hyperbody_geometry::Aabb;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Pose, Vector};
use rayon::prelude::*;

use crate::world::Collider;
use crate::{BodyHandle, World};

/// A world to be asked. It holds the world still for as long as it lives.
pub struct Queries<'w, const N: usize> {
    world: &'w World<N>,
    /// By the slot of the collider.
    world_from_collider: Vec<Pose<N>>,
    /// Colliders that the tree does not hold where they are: half-spaces, and those out of their boxes. Ascending.
    apart: Vec<u32>,
    /// The same, by slot.
    is_apart: Vec<bool>,
}

/// Where a ray meets a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyHit<const N: usize> {
    /// The body.
    pub body: BodyHandle,
    /// Where and how, in the world; `part` is the part of the body's shape.
    pub hit: RayHit<N>,
}

/// Working memory of single queries, to be kept so that nothing is allocated once it has grown. Its contents never
/// influence a result.
#[derive(Clone, Debug, Default)]
pub struct QueryScratch {
    rays: RayStack,
    nodes: Vec<u32>,
}

/// Rays that one task of [`Queries::ray_casts`] casts: enough to hide what it costs to start a task.
const RAYS_PER_TASK: usize = 256;

impl<const N: usize> World<N> {
    /// The world as it is now, to be asked for rays, points and boxes. See [`Queries`].
    #[must_use]
    pub fn queries(&self) -> Queries<'_, N> {
        let mut queries = Queries {
            world: self,
            world_from_collider: Vec::with_capacity(self.colliders.len()),
            apart: Vec::new(),
            is_apart: Vec::with_capacity(self.colliders.len()),
        };
        for (slot, collider) in self.colliders.iter().enumerate() {
            let (pose, apart) = match collider {
                Some(collider) => self.place(collider),
                None => (Pose::IDENTITY, false),
            };
            if apart {
                queries.apart.push(slot as u32);
            }
            queries.world_from_collider.push(pose);
            queries.is_apart.push(apart);
        }
        queries
    }

    /// Where a collider is, and whether the tree does not know.
    fn place(&self, collider: &Collider<N>) -> (Pose<N>, bool) {
        let Some(body) = self.bodies.at(collider.body) else { return (collider.world_from_collider, true) };
        let pose = body.world_from_body() * collider.body_from_collider;
        let known = pose == collider.world_from_collider;
        match &collider.piece {
            Piece::Convex(convex) if collider.proxy.is_some() => {
                (pose, !known && !collider.fat_aabb.contains(&convex.aabb(&pose)))
            }
            _ => (pose, true),
        }
    }

    /// The first body that a ray meets: [`Queries::ray_cast`] for a single ray.
    #[must_use]
    pub fn ray_cast(&self, ray: &Ray<N>) -> Option<BodyHit<N>> {
        self.queries().ray_cast(ray, &mut QueryScratch::default(), |_| true)
    }
}

impl<const N: usize> Queries<'_, N> {
    /// The first body that a ray meets, of those that `filter` lets through. Of several that are met at the same
    /// fraction it is the one added to the world first, as far as slots were not used again. Rays that are not
    /// [valid](Ray::is_valid) meet nothing.
    pub fn ray_cast(
        &self,
        ray: &Ray<N>,
        scratch: &mut QueryScratch,
        mut filter: impl FnMut(BodyHandle) -> bool,
    ) -> Option<BodyHit<N>> {
        let mut first: Option<(u32, RayHit<N>)> = None;
        self.visit_hits(ray, scratch, &mut filter, |slot, hit| {
            let closer = first.is_none_or(|(best_slot, best)| {
                hit.fraction < best.fraction || (hit.fraction == best.fraction && slot < best_slot)
            });
            if closer {
                first = Some((slot, *hit));
            }
            Some(hit.fraction)
        });
        first.and_then(|(slot, hit)| self.in_world(slot, &hit))
    }

    /// Whether a ray meets any body that `filter` lets through; stops at the first one found.
    pub fn ray_meets_any(
        &self,
        ray: &Ray<N>,
        scratch: &mut QueryScratch,
        mut filter: impl FnMut(BodyHandle) -> bool,
    ) -> bool {
        let mut met = false;
        self.visit_hits(ray, scratch, &mut filter, |_, _| {
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
        scratch: &mut QueryScratch,
        mut filter: impl FnMut(BodyHandle) -> bool,
        out: &mut Vec<BodyHit<N>>,
    ) {
        out.clear();
        self.visit_hits(ray, scratch, &mut filter, |slot, hit| {
            out.extend(self.in_world(slot, hit));
            Some(f64::INFINITY)
        });
        out.sort_unstable_by(|a, b| {
            let by_fraction = a.hit.fraction.total_cmp(&b.hit.fraction);
            by_fraction.then(a.body.cmp(&b.body)).then(a.hit.part.cmp(&b.hit.part))
        });
    }

    /// [`Queries::ray_cast`] for many rays, on the threads of the world; the same answers for every number of threads.
    /// `out` is emptied first and then holds one answer per ray, in their order.
    pub fn ray_casts(
        &self,
        rays: &[Ray<N>],
        filter: impl Fn(BodyHandle) -> bool + Sync,
        out: &mut Vec<Option<BodyHit<N>>>,
    ) {
        out.clear();
        out.resize(rays.len(), None);
        let cast = |(rays, answers): (&[Ray<N>], &mut [Option<BodyHit<N>>])| {
            let mut scratch = QueryScratch::default();
            for (ray, answer) in rays.iter().zip(answers) {
                *answer = self.ray_cast(ray, &mut scratch, &filter);
            }
        };
        match &self.world.pool {
            Some(pool) => pool.install(|| {
                rays.par_chunks(RAYS_PER_TASK).zip(out.par_chunks_mut(RAYS_PER_TASK)).for_each(cast);
            }),
            None => cast((rays, out)),
        }
    }

    /// The bodies in which a point lies, ascending, of those that `filter` lets through. `out` is emptied first.
    pub fn bodies_at(
        &self,
        point: impl Into<Vector<N>>,
        scratch: &mut QueryScratch,
        filter: impl FnMut(BodyHandle) -> bool,
        out: &mut Vec<BodyHandle>,
    ) {
        let point = point.into();
        let holds = |piece: &Piece<N>, pose: &Pose<N>| point::contains(piece, pose.inverse_transform_point(point));
        self.collect(&Aabb { lower: point, upper: point }, scratch, filter, holds, out);
    }

    /// The bodies that have a point in common with an axis-aligned box, ascending, of those that `filter` lets through.
    /// The bodies themselves count, not their boxes. `out` is emptied first.
    pub fn bodies_in(
        &self,
        aabb: &Aabb<N>,
        scratch: &mut QueryScratch,
        filter: impl FnMut(BodyHandle) -> bool,
        out: &mut Vec<BodyHandle>,
    ) {
        let meets = |piece: &Piece<N>, pose: &Pose<N>| point::overlaps_aabb(piece, pose, aabb);
        self.collect(aabb, scratch, filter, meets, out);
    }

    fn collect(
        &self,
        aabb: &Aabb<N>,
        scratch: &mut QueryScratch,
        mut filter: impl FnMut(BodyHandle) -> bool,
        is_in: impl Fn(&Piece<N>, &Pose<N>) -> bool,
        out: &mut Vec<BodyHandle>,
    ) {
        out.clear();
        if !(aabb.lower.is_finite() && aabb.upper.is_finite()) {
            return;
        }
        let mut look = |slot: u32| {
            let Some(collider) = &self.world.colliders[slot as usize] else { return };
            let Some(body) = self.world.bodies.handle_at(collider.body) else { return };
            if filter(body) && is_in(&collider.piece, &self.world_from_collider[slot as usize]) {
                out.push(body);
            }
        };
        self.apart.iter().copied().for_each(&mut look);
        self.world.tree.for_each_overlap(aabb, &mut scratch.nodes, |slot| {
            if !self.is_apart[slot as usize] {
                look(slot);
            }
            true
        });
        out.sort_unstable();
        out.dedup();
    }

    /// Calls `visit` with slot and hit, in the frame of the collider, of every collider that the ray meets up to what
    /// `visit` last answered, until that is `None`.
    fn visit_hits(
        &self,
        ray: &Ray<N>,
        scratch: &mut QueryScratch,
        filter: &mut impl FnMut(BodyHandle) -> bool,
        mut visit: impl FnMut(u32, &RayHit<N>) -> Option<f64>,
    ) {
        if !ray.is_valid() {
            return;
        }
        let speed_sq = ray.direction.norm_sq();
        let mut look = |slot: u32, reach: f64| {
            let Some(collider) = &self.world.colliders[slot as usize] else { return Some(reach) };
            let Some(body) = self.world.bodies.handle_at(collider.body) else { return Some(reach) };
            let pose = &self.world_from_collider[slot as usize];
            if (collider.proxy.is_some() && passes_ball(ray, speed_sq, pose.translation, collider.reach))
                || !filter(body)
            {
                return Some(reach);
            }
            let seen = ray.up_to(reach).seen_from(pose);
            match cast_on_piece(&seen, &collider.piece) {
                Some(hit) => visit(slot, &hit).map(|next| next.min(reach)),
                None => Some(reach),
            }
        };
        let mut reach = ray.max_fraction;
        for &slot in &self.apart {
            match look(slot, reach) {
                Some(next) => reach = next,
                None => return,
            }
        }
        self.world.tree.cast_ray(&ray.up_to(reach), &mut scratch.rays, |slot, reach| {
            if self.is_apart[slot as usize] { Some(reach) } else { look(slot, reach) }
        });
    }

    fn in_world(&self, slot: u32, hit: &RayHit<N>) -> Option<BodyHit<N>> {
        let collider = self.world.colliders[slot as usize].as_ref()?;
        let body = self.world.bodies.handle_at(collider.body)?;
        let siblings = &self.world.bodies.at(collider.body)?.colliders;
        let part = siblings.iter().position(|&other| other == slot)? as u32;
        Some(BodyHit { body, hit: RayHit { part, ..hit.in_world(&self.world_from_collider[slot as usize]) } })
    }
}

/// Whether the line of a ray passes by a ball, beyond doubt by rounding. The ball around a turned body fills little of the
/// body's box, the less the higher the dimension, so this spares most turns of rays into the frames of bodies.
#[inline]
fn passes_ball<const N: usize>(ray: &Ray<N>, speed_sq: f64, centre: Vector<N>, radius: f64) -> bool {
    let away = centre - ray.origin;
    let closest = away - ray.direction * (away.dot(ray.direction) / speed_sq);
    let limit = radius * (1.0 + 1e-9) + 1e-14 * away.norm();
    closest.norm_sq() > limit * limit
}

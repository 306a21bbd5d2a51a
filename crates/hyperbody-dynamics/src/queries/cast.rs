//! Moving and turning shapes against the bodies of a world, which stand still meanwhile.

use hyperbody_collision::limits::FARTHEST;
use hyperbody_collision::query::{Motion, ShapeHit, shape_cast_on_piece};
use hyperbody_collision::ray::Ray;
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Aabb, Convex, Shape};
use hyperbody_math::Vector;

use super::{Queries, QueryFilter, QueryScratch};
use crate::BodyHandle;

/// Where a moving shape meets a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyShapeHit<const N: usize> {
    /// The body.
    pub body: BodyHandle,
    /// When, where and how, in the world; `other_part` is the part of the body's shape.
    pub hit: ShapeHit<N>,
}

/// A convex part of the shape that is cast, and a ray along which its box covers all of its way.
struct Swept<const N: usize> {
    convex: Convex<N>,
    motion: Motion<N>,
    ray: Ray<N>,
    half_extents: Vector<N>,
}

impl<const N: usize> Swept<N> {
    fn new(convex: Convex<N>, motion: Motion<N>, max_time: f64, margin: f64) -> Self {
        let turns = motion.angular_velocity.norm_sq() > 0.0;
        let around = if turns {
            // Wherever it turns, it stays in the ball about its centre of turning.
            let reach = convex.bounding_radius() + motion.centre.norm();
            Aabb::from_centre(motion.start.transform_point(motion.centre), Vector::splat(reach))
        } else {
            convex.aabb(&motion.start)
        };
        let half_extents = (around.upper - around.lower) * 0.5 + Vector::splat(margin);
        let ray = Ray::new(around.centre(), motion.velocity).up_to(max_time);
        // Twice the rounding of the centre, so that what touches is not lost between boxes.
        let slack = 4.0 * f64::EPSILON * (around.centre().max_abs() + half_extents.max_abs());
        Self { convex, motion, ray, half_extents: half_extents + Vector::splat(slack) }
    }
}

impl<const N: usize> Queries<'_, N> {
    /// The first body that a shape meets in a motion, within 0 ≤ time ≤ `max_time` (s): when it comes within `margin` (m,
    /// 0 to 1e30), of the bodies that `filter` lets through; see [`hyperbody_collision::query::shape_cast`]. The bodies stand
    /// still. What overlaps at the start is met at time 0, with `inside` set. Numbers out of their ranges and half-spaces as
    /// `shape` meet nothing. Of several met at the same time it is the one added to the world first, as far as slots were not used again.
    pub fn shape_cast(
        &self,
        shape: &Shape<N>,
        motion: &Motion<N>,
        max_time: f64,
        margin: f64,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
    ) -> Option<BodyShapeHit<N>> {
        if !(motion.is_valid() && max_time >= 0.0 && (0.0..=FARTHEST).contains(&margin)) {
            return None;
        }
        let mut first: Option<(u32, BodyShapeHit<N>)> = None;
        for (part, (inner, piece)) in shape.pieces().into_iter().enumerate() {
            let Piece::Convex(convex) = piece else { return None };
            let reach = first.map_or(max_time, |(_, first)| first.hit.time);
            let swept = Swept::new(convex, motion.of_part(&inner), reach, margin);
            self.cast_part(&swept, margin, scratch, filter, |slot, body, hit| {
                let known = first.map_or((f64::INFINITY, 0), |(slot, first)| (first.hit.time, slot));
                if (hit.time, slot) < known {
                    first = Some((slot, BodyShapeHit { body, hit: ShapeHit { part: part as u32, ..hit } }));
                }
            });
        }
        let (slot, mut found) = first?;
        found.hit.other_part = self.part(slot);
        Some(found)
    }

    /// [`Queries::shape_cast`] for one shape in many motions: `out` is emptied first and then holds one answer a motion,
    /// in their order.
    pub fn shape_casts(
        &self,
        shape: &Shape<N>,
        motions: &[Motion<N>],
        max_time: f64,
        margin: f64,
        filter: &QueryFilter<'_>,
        out: &mut Vec<Option<BodyShapeHit<N>>>,
    ) {
        self.batch(motions, out, |motion, scratch| self.shape_cast(shape, motion, max_time, margin, scratch, filter));
    }

    /// Reports the hits of one part that may be the first.
    fn cast_part(
        &self,
        swept: &Swept<N>,
        margin: f64,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
        mut report: impl FnMut(u32, BodyHandle, ShapeHit<N>),
    ) {
        let QueryScratch { rays, nodes, pair } = scratch;
        let mut look = |slot: u32, reach: f64| {
            let Some((collider, pose, body)) = self.candidate(slot, filter) else { return reach };
            let hit = shape_cast_on_piece(&swept.convex, &swept.motion, &collider.piece, pose, reach, margin, pair);
            match hit {
                Some(hit) => {
                    report(slot, body, hit);
                    hit.time.min(reach)
                }
                None => reach,
            }
        };
        let mut reach = swept.ray.max_fraction;
        for &slot in &self.apart {
            reach = look(slot, reach);
        }
        if swept.ray.is_valid() {
            self.world.tree.cast_box(&swept.ray.up_to(reach), swept.half_extents, rays, |slot, reach| {
                Some(if self.is_apart[slot as usize] { reach } else { look(slot, reach) })
            });
        } else {
            // It turns on the spot, or stands.
            let around = Aabb::from_centre(swept.ray.origin, swept.half_extents);
            self.world.tree.for_each_overlap(&around, nodes, |slot| {
                if !self.is_apart[slot as usize] {
                    reach = look(slot, reach);
                }
                true
            });
        }
    }
}

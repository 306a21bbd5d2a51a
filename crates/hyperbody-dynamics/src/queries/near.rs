//! Points, boxes and shapes against the bodies of a world: what holds them, meets them, is nearest to them.

use hyperbody_collision::limits::FARTHEST;
use hyperbody_collision::point;
use hyperbody_collision::query::{
    Closest, Projection, Separation, closest_of_pieces, pieces_overlap, project_on_piece, separation_of_pieces,
};
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Aabb, Shape};
use hyperbody_math::{Pose, Vector};

use super::{Queries, QueryFilter, QueryScratch};
use crate::BodyHandle;

/// Where a point lies with regard to a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyProjection<const N: usize> {
    /// The body.
    pub body: BodyHandle,
    /// In the world; `part` is the part of the body's shape.
    pub projection: Projection<N>,
}

/// How a shape and a body lie to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodySeparation<const N: usize> {
    /// The body.
    pub body: BodyHandle,
    /// From the shape (a) to the body (b), in the world; the parts are those of compounds.
    pub separation: Separation<N>,
}

/// The convex pieces of the shape that a query is about, in the world.
pub(super) struct Probe<const N: usize> {
    pieces: Vec<(Pose<N>, Piece<N>)>,
    /// Around all pieces; `None` if one is a half-space.
    aabb: Option<Aabb<N>>,
}

impl<const N: usize> Probe<N> {
    fn new(shape: &Shape<N>, world_from_shape: &Pose<N>) -> Self {
        let pieces: Vec<_> =
            shape.pieces().into_iter().map(|(inner, piece)| (*world_from_shape * inner, piece)).collect();
        let boxes = pieces.iter().map(|(pose, piece)| match piece {
            Piece::Convex(convex) => Some(convex.aabb(pose)),
            Piece::HalfSpace { .. } => None,
        });
        let aabb = boxes.reduce(|a, b| Some(a?.union(&b?))).flatten();
        Self { pieces, aabb }
    }

    fn in_range(&self) -> bool {
        self.pieces.iter().all(|(pose, _)| pose.translation.max_abs() <= FARTHEST && pose.rotation.matrix().is_finite())
    }

    /// Distance or depth to a piece, of the part that is closest or deepest, if that is at most `up_to`.
    fn separation(
        &self,
        other: &Piece<N>,
        pose: &Pose<N>,
        up_to: f64,
        scratch: &mut QueryScratch<N>,
    ) -> Option<Separation<N>> {
        let mut best: Option<Separation<N>> = None;
        for (part, (probe_pose, piece)) in self.pieces.iter().enumerate() {
            let reach = best.map_or(up_to, |best| best.distance.max(0.0));
            let found = match closest_of_pieces(piece, probe_pose, other, pose, reach) {
                Closest::Apart => None,
                Closest::Near(found) => Some(found),
                Closest::Overlapping => separation_of_pieces(piece, probe_pose, other, pose, &mut scratch.pair),
            };
            if let Some(found) = found.filter(|found| best.is_none_or(|best| found.distance < best.distance)) {
                best = Some(Separation { part_a: part as u32, ..found });
            }
        }
        best
    }
}

impl<const N: usize> Queries<'_, N> {
    /// The bodies in which a point lies, ascending, of those that `filter` lets through. `out` is emptied first.
    pub fn bodies_at(
        &self,
        point: impl Into<Vector<N>>,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
        out: &mut Vec<BodyHandle>,
    ) {
        let point = point.into();
        let holds = |piece: &Piece<N>, pose: &Pose<N>| point::contains(piece, pose.inverse_transform_point(point));
        self.collect(&Aabb { lower: point, upper: point }, scratch, filter, holds, out);
    }

    /// [`Queries::bodies_at`] for many points: `out` is emptied first and then holds one list a point, in their order.
    pub fn bodies_at_each(&self, points: &[Vector<N>], filter: &QueryFilter<'_>, out: &mut Vec<Vec<BodyHandle>>) {
        self.batch(points, out, |point, scratch| {
            let mut bodies = Vec::new();
            self.bodies_at(*point, scratch, filter, &mut bodies);
            bodies
        });
    }

    /// The bodies that have a point in common with an axis-aligned box, ascending, of those that `filter` lets through.
    /// The bodies themselves count, not their boxes. `out` is emptied first. A box may be as large as you like, infinite
    /// included.
    pub fn bodies_in(
        &self,
        aabb: &Aabb<N>,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
        out: &mut Vec<BodyHandle>,
    ) {
        // Beyond the range of queries there is nothing, and lengths overflow.
        let limited = |corner: Vector<N>| corner.min(Vector::splat(FARTHEST)).max(Vector::splat(-FARTHEST));
        let aabb = &Aabb { lower: limited(aabb.lower), upper: limited(aabb.upper) };
        let meets = |piece: &Piece<N>, pose: &Pose<N>| point::overlaps_aabb(piece, pose, aabb);
        self.collect(aabb, scratch, filter, meets, out);
    }

    /// The bodies that have a point in common with a shape at `world_from_shape`, ascending, of those that `filter` lets
    /// through. `out` is emptied first.
    pub fn bodies_touching(
        &self,
        shape: &Shape<N>,
        world_from_shape: &Pose<N>,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
        out: &mut Vec<BodyHandle>,
    ) {
        let probe = Probe::new(shape, world_from_shape);
        let meets = |piece: &Piece<N>, pose: &Pose<N>| {
            probe.pieces.iter().any(|(probe_pose, probe)| pieces_overlap(probe, probe_pose, piece, pose))
        };
        match &probe.aabb {
            Some(aabb) => self.collect(aabb, scratch, filter, meets, out),
            None => self.collect(&everywhere(), scratch, filter, meets, out),
        }
    }

    /// [`Queries::bodies_touching`] for a shape at many poses: `out` is emptied first and then holds one list a pose, in
    /// their order.
    pub fn bodies_touching_each(
        &self,
        shape: &Shape<N>,
        poses: &[Pose<N>],
        filter: &QueryFilter<'_>,
        out: &mut Vec<Vec<BodyHandle>>,
    ) {
        self.batch(poses, out, |pose, scratch| {
            let mut bodies = Vec::new();
            self.bodies_touching(shape, pose, scratch, filter, &mut bodies);
            bodies
        });
    }

    /// The body nearest to a point, at most `up_to` (m, ≥ 0, may be infinite) away, of those that `filter` lets through: of the
    /// bodies that hold the point the one in which it lies deepest. Of several equally near it is the one added to the
    /// world first, as far as slots were not used again.
    pub fn nearest_to_point(
        &self,
        point: impl Into<Vector<N>>,
        up_to: f64,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
    ) -> Option<BodyProjection<N>> {
        let point = point.into();
        if !(0.0..=FARTHEST).contains(&point.max_abs()) {
            return None;
        }
        let mut best: Option<(u32, BodyProjection<N>)> = None;
        self.visit_near(&Aabb { lower: point, upper: point }, up_to, scratch, filter, |found, reach, scratch| {
            let (slot, piece, pose, body) = found;
            let Some(projection) = project_on_piece(point, piece, pose, &mut scratch.pair) else { return reach };
            let known = best.map_or((f64::INFINITY, 0), |(slot, best)| (best.projection.distance, slot));
            if projection.distance <= up_to && (projection.distance, slot) < known {
                best = Some((slot, BodyProjection { body, projection }));
            }
            reach.min(projection.distance.max(0.0))
        });
        let (slot, mut nearest) = best?;
        nearest.projection.part = self.part(slot);
        Some(nearest)
    }

    /// [`Queries::nearest_to_point`] for many points: `out` is emptied first and then holds one answer a point.
    pub fn nearest_to_points(
        &self,
        points: &[Vector<N>],
        up_to: f64,
        filter: &QueryFilter<'_>,
        out: &mut Vec<Option<BodyProjection<N>>>,
    ) {
        self.batch(points, out, |point, scratch| self.nearest_to_point(*point, up_to, scratch, filter));
    }

    /// The body nearest to a shape at `world_from_shape`, at most `up_to` (m, ≥ 0, may be infinite) away, with the points
    /// that are closest; of bodies that overlap the shape the deepest, and no way leads out of two half-spaces, so that their
    /// distance is −∞. Ties go to the body added first.
    pub fn nearest_to_shape(
        &self,
        shape: &Shape<N>,
        world_from_shape: &Pose<N>,
        up_to: f64,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
    ) -> Option<BodySeparation<N>> {
        let probe = Probe::new(shape, world_from_shape);
        let mut best: Option<(u32, BodySeparation<N>)> = None;
        self.visit_separations(&probe, up_to, scratch, filter, |slot, found| {
            let known = best.map_or((f64::INFINITY, 0), |(slot, best)| (best.separation.distance, slot));
            if (found.separation.distance, slot) < known {
                best = Some((slot, found));
            }
            found.separation.distance.max(0.0)
        });
        best.map(|(_, found)| found)
    }

    /// Every body at most `within` (m, ≥ 0, may be infinite) from a shape at `world_from_shape`, from deepest to farthest,
    /// each with its closest or deepest points. `out` is emptied first.
    pub fn bodies_near(
        &self,
        shape: &Shape<N>,
        world_from_shape: &Pose<N>,
        within: f64,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
        out: &mut Vec<BodySeparation<N>>,
    ) {
        out.clear();
        let probe = Probe::new(shape, world_from_shape);
        self.visit_separations(&probe, within, scratch, filter, |_, found| {
            out.push(found);
            f64::INFINITY
        });
        // Of a body's parts the nearest one stands for it.
        let order = |a: &BodySeparation<N>, b: &BodySeparation<N>| {
            a.separation.distance.total_cmp(&b.separation.distance).then(a.separation.part_b.cmp(&b.separation.part_b))
        };
        out.sort_unstable_by(|a, b| a.body.cmp(&b.body).then_with(|| order(a, b)));
        out.dedup_by_key(|found| found.body);
        out.sort_unstable_by(|a, b| order(a, b).then(a.body.cmp(&b.body)));
    }

    fn visit_separations(
        &self,
        probe: &Probe<N>,
        up_to: f64,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
        mut visit: impl FnMut(u32, BodySeparation<N>) -> f64,
    ) {
        if !probe.in_range() {
            return;
        }
        let aabb = probe.aabb.unwrap_or_else(everywhere);
        self.visit_near(&aabb, up_to, scratch, filter, |(slot, piece, pose, body), reach, scratch| {
            let Some(separation) = probe.separation(piece, pose, reach, scratch) else { return reach };
            let separation = Separation { part_b: self.part(slot), ..separation };
            reach.min(visit(slot, BodySeparation { body, separation }))
        });
    }

    /// Calls `visit` with every collider (slot, piece, pose, body) whose box is at most `up_to` away from `aabb`, roughly
    /// from near to far; it answers with how far things may be from then on.
    fn visit_near(
        &self,
        aabb: &Aabb<N>,
        up_to: f64,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
        mut visit: impl FnMut((u32, &Piece<N>, &Pose<N>, BodyHandle), f64, &mut QueryScratch<N>) -> f64,
    ) {
        if up_to.is_nan() || up_to < 0.0 {
            return;
        }
        let mut reach = up_to;
        for &slot in &self.apart {
            if let Some((collider, pose, body)) = self.candidate(slot, filter) {
                reach = visit((slot, &collider.piece, pose, body), reach, scratch).min(reach);
            }
        }
        let mut stack = std::mem::take(&mut scratch.rays);
        self.world.tree.visit_near(aabb, reach, &mut stack, |slot, reach| {
            if self.is_apart[slot as usize] {
                return Some(reach);
            }
            let Some((collider, pose, body)) = self.candidate(slot, filter) else { return Some(reach) };
            Some(visit((slot, &collider.piece, pose, body), reach, scratch))
        });
        scratch.rays = stack;
    }

    fn collect(
        &self,
        aabb: &Aabb<N>,
        scratch: &mut QueryScratch<N>,
        filter: &QueryFilter<'_>,
        is_in: impl Fn(&Piece<N>, &Pose<N>) -> bool,
        out: &mut Vec<BodyHandle>,
    ) {
        out.clear();
        if !(aabb.lower.is_finite() && aabb.upper.is_finite()) {
            return;
        }
        let mut look = |slot: u32| {
            if let Some((collider, pose, body)) = self.candidate(slot, filter)
                && is_in(&collider.piece, pose)
            {
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
}

/// A box around all that worlds hold: around a half-space there is none smaller.
fn everywhere<const N: usize>() -> Aabb<N> {
    Aabb { lower: Vector::splat(f64::MIN), upper: Vector::splat(f64::MAX) }
}

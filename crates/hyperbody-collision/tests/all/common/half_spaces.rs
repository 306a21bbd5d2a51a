//! A shape and a half-space: everything is known from the shape's vertices, exactly. What stands for a round shape touches as
//! that shape does, where queries know its facets.

use hyperbody_collision::query::{pieces_overlap, separation_of_pieces};
use hyperbody_collision::{Manifold, PairCache, Scratch, collide, limits, max_points};
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Convex, Core, Shape};
use hyperbody_math::{Pose, Vector};

use super::draw::{kind, placing, random_rotation, random_size};
use super::fuzz::{Plan, Report};
use super::oracle::{convex, outside, vertices};
use super::{Random, piece};

/// A shape over a half-space.
struct Over<'a, const N: usize> {
    name: String,
    shape: &'a Convex<N>,
    pose: Pose<N>,
    /// Outward unit normal of the half-space, in the world.
    up: Vector<N>,
    /// Of the boundary along it.
    level: f64,
    /// The shape's own size.
    size: f64,
    /// What rounding counts by: the size, and how far out the two are.
    scale: f64,
}

/// Checks a shape over the half-space of the given number.
pub fn check_drawn<const N: usize>(solid: &Piece<N>, plan: Plan, index: u64, scratch: &mut Scratch<N>) -> Report {
    let mut random = placing(plan.seed, index);
    let outward = if random.below(2) == 0 { Vector::unit(random.below(N)) } else { random.direction() };
    let far = random_size(&mut random, plan.spread);
    let offset = if random.below(2) == 0 { 0.0 } else { random.range(-far, far) };
    let half_space = piece(Shape::half_space(outward, offset).expect("a direction"));
    let placed = Pose::new(random_rotation(&mut random), random.vector(1.0));
    let up = placed.rotation.rotate(outward);
    let level = offset + up.dot(placed.translation);
    // Somewhere beside it, then up or down until the gap is as drawn.
    let mut pose = Pose::new(random_rotation(&mut random), placed.translation + random.vector(far));
    if random.below(3) == 0 {
        pose.rotation = placed.rotation;
    }
    let size = convex(solid).bounding_radius();
    let gap = match random.below(5) {
        0 => 0.0,
        1 => random.range(-1e-2, 1e-2) * size,
        2 => -random.log_range(1e-9, 1e-3) * size,
        3 => random.range(-3.0, 0.0) * size,
        _ => random.range(-0.5, 0.5) * size,
    };
    pose.translation += up * (gap - separation(convex(solid), &pose, up, level));
    let name = format!("N = {N}, seed {}, pair {index}, {} over a half-space", plan.seed, kind(solid));
    let scale = size + pose.translation.norm() + level.abs();
    let over = Over { name, shape: convex(solid), pose, up, level, size, scale };
    over.check(solid, &half_space, &placed, &mut random, scratch)
}

/// How far the shape is above the plane, by its vertices.
fn separation<const N: usize>(shape: &Convex<N>, pose: &Pose<N>, up: Vector<N>, level: f64) -> f64 {
    vertices(&shape.core, pose).iter().map(|v| v.dot(up) - level).fold(f64::INFINITY, f64::min) - shape.radius
}

impl<const N: usize> Over<'_, N> {
    fn check(
        &self,
        solid: &Piece<N>,
        half_space: &Piece<N>,
        placed: &Pose<N>,
        random: &mut Random,
        scratch: &mut Scratch<N>,
    ) -> Report {
        let mut report = Report { pairs: 1, half_spaces: 1, ..Report::default() };
        let truth = separation(self.shape, &self.pose, self.up, self.level);
        let touch = self.round_separation().unwrap_or(truth);
        let mut out = Manifold::EMPTY;
        let mut cache = PairCache::default();
        for margin in [10.0 * self.scale, 0.02 * self.size] {
            for step in 0..2 {
                collide(half_space, placed, solid, &self.pose, margin, &mut cache, scratch, &mut out);
                self.judge(&out, touch, margin, step, &mut report);
                let mut near = self.pose;
                near.translation += random.vector(1e-3 * self.size);
                collide(half_space, placed, solid, &near, margin, &mut cache, scratch, &mut out);
            }
            collide(solid, &self.pose, half_space, placed, margin, &mut PairCache::default(), scratch, &mut out);
            self.judge(&out.flipped(), touch, margin, 2, &mut report);
        }
        self.judge_query(solid, half_space, placed, truth, scratch, &mut report);
        report
    }

    /// Separation of the round shape that the core stands for, if it stands for one.
    fn round_separation(&self) -> Option<f64> {
        let Core::Polytope(polytope) = &self.shape.core else { return None };
        let seen = polytope.turned_toward(self.pose.rotation.inverse_rotate(-self.up));
        let heights = seen.vertices().map(|v| self.pose.transform_point(v).dot(self.up) - self.level);
        polytope.stands_for_round().then(|| heights.fold(f64::INFINITY, f64::min) - self.shape.radius)
    }

    /// Whether a contact with the half-space as shape a is right.
    fn judge(&self, out: &Manifold<N>, truth: f64, margin: f64, step: u32, report: &mut Report) {
        let (name, rounding) = (&self.name, 1e-12 * self.scale);
        let Some(least) = out.least_separation() else {
            assert!(truth > margin - rounding, "{name}: {truth} missed in step {step}");
            return;
        };
        assert!(truth <= margin + rounding, "{name}: {truth} reported in step {step}");
        report.touching = 1;
        report.overlapping = u64::from(truth < 0.0);
        assert!((out.normal - self.up).max_abs() < 1e-12, "{name}: normal {:?}", out.normal);
        assert!(out.points().len() <= max_points(N));
        let slack = limits::EQUAL_DEPTH * self.shape.core.bounding_radius();
        assert!(least >= truth - rounding, "{name}: {least} is deeper than {truth}");
        assert!(least <= truth + slack + rounding, "{name}: {least} shown of {truth}");
        report.separation_error = report.separation_error.max((least - truth - rounding) / (slack + rounding));
        for point in out.points() {
            // Midway between the plane and the surface of the shape.
            let on_plane = point.position - self.up * (0.5 * point.separation);
            let in_core = on_plane + self.up * (point.separation + self.shape.radius);
            let off = (on_plane.dot(self.up) - self.level).abs();
            let stands_for_round = self.round_separation().is_some();
            let outside = |point| if stands_for_round { 0.0 } else { outside(&self.shape.core, point) };
            let out_of_core = outside(self.pose.inverse_transform_point(in_core));
            assert!(off <= rounding && out_of_core <= rounding, "{name}: a point {off} off, {out_of_core} outside");
            report.outside = report.outside.max(off.max(out_of_core) / self.scale);
        }
    }

    fn judge_query(
        &self,
        solid: &Piece<N>,
        half_space: &Piece<N>,
        placed: &Pose<N>,
        truth: f64,
        scratch: &mut Scratch<N>,
        report: &mut Report,
    ) {
        let (name, rounding) = (&self.name, 1e-12 * self.scale);
        let found = separation_of_pieces(half_space, placed, solid, &self.pose, scratch)
            .unwrap_or_else(|| panic!("{name}: no separation"));
        let error = (found.distance - truth).abs();
        report.query_error = report.query_error.max(error / self.scale);
        assert!(error <= rounding, "{name}: {found:?} of {truth}");
        let off = (found.on_a.dot(self.up) - self.level).abs();
        let core_of_b = self.pose.inverse_transform_point(found.on_b + self.up * self.shape.radius);
        let out_of_core = outside(&self.shape.core, core_of_b);
        assert!(off <= rounding && out_of_core <= rounding, "{name}: {found:?} {off} off, {out_of_core} outside");
        report.query_outside = report.query_outside.max(off.max(out_of_core) / self.scale);
        if truth.abs() > rounding {
            let meet = pieces_overlap(solid, &self.pose, half_space, placed);
            assert_eq!(meet, truth < 0.0, "{name}: {found:?}");
        }
        self.check_two(half_space, placed, scratch);
    }

    /// Half-spaces overlap without bounds unless one faces away from the other exactly: then it is as far as it was put.
    fn check_two(&self, half_space: &Piece<N>, placed: &Pose<N>, scratch: &mut Scratch<N>) {
        let name = &self.name;
        let with_itself = separation_of_pieces(half_space, placed, half_space, placed, scratch).expect("they overlap");
        assert_eq!(with_itself.distance, f64::NEG_INFINITY, "{name}: {with_itself:?}");
        let Piece::HalfSpace { normal, offset } = half_space else { unreachable!("{name}: not a half-space") };
        for gap in [self.size, 0.0, -self.size] {
            let away = Piece::HalfSpace { normal: -*normal, offset: -(offset + gap) };
            let found = separation_of_pieces(half_space, placed, &away, placed, scratch).expect("they are apart");
            let error = (found.distance - gap).abs().max((found.normal - self.up).max_abs());
            assert!(error <= 1e-12 * self.scale, "{name}: {found:?} of {gap}");
        }
    }
}

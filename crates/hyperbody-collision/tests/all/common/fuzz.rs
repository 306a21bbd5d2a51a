//! What the contact of a random pair, and its distance or depth, must satisfy.

use hyperbody_collision::detect::SeparatingAxes;
use hyperbody_collision::query::{pieces_overlap, separation_of_pieces};
use hyperbody_collision::{Effort, Manifold, PairCache, Scratch, collide, limits, max_points};
use hyperbody_geometry::Core;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::Pose;
use std::cell::OnceCell;

use super::Random;
use super::draw::{Pair, Shapes, draw_of, kind};
use super::half_spaces;
use super::oracle::{Truth, convex};

/// The worst of everything that was looked at.
#[derive(Debug, Default, Clone, Copy)]
pub struct Report {
    pub pairs: u64,
    /// Those of a shape and a half-space, all of which are compared with the shape's vertices.
    pub half_spaces: u64,
    pub touching: u64,
    pub overlapping: u64,
    /// Pairs whose depth was compared with the hull of all differences.
    pub depths_compared: u64,
    /// Reported separation above that along the reported normal, measured anew from the vertices, in parts of what the
    /// tolerances allow.
    pub separation_error: f64,
    /// Distance of disjoint cores above the certificate of the normal, in parts of the smaller shape.
    pub distance_error: f64,
    /// Depth above the least possible, in parts of what the tolerances allow.
    pub depth_excess: f64,
    /// Depth below the least possible, in parts of both sizes: must be rounding.
    pub depth_shortfall: f64,
    /// How far contact points lie outside the shapes, in parts of both sizes.
    pub outside: f64,
    /// Depths compared with the separating axes of all pairs of faces.
    pub depths_by_axes: u64,
    /// Depths that a descent from random directions tried to undercut.
    pub depths_by_descent: u64,
    /// Of the query for distance and depth: distance (depth) off what its normal certifies, in parts of both sizes.
    pub query_error: f64,
    /// How far its points lie outside the shapes, in parts of both sizes.
    pub query_outside: f64,
    /// Its depth above the least possible, in parts of both sizes.
    pub query_excess: f64,
    pub effort: Effort,
}

impl Report {
    pub fn merge(&mut self, other: &Self) {
        self.pairs += other.pairs;
        self.half_spaces += other.half_spaces;
        self.touching += other.touching;
        self.overlapping += other.overlapping;
        self.depths_compared += other.depths_compared;
        self.separation_error = self.separation_error.max(other.separation_error);
        self.distance_error = self.distance_error.max(other.distance_error);
        self.depth_excess = self.depth_excess.max(other.depth_excess);
        self.depth_shortfall = self.depth_shortfall.max(other.depth_shortfall);
        self.outside = self.outside.max(other.outside);
        self.depths_by_axes += other.depths_by_axes;
        self.depths_by_descent += other.depths_by_descent;
        self.query_error = self.query_error.max(other.query_error);
        self.query_outside = self.query_outside.max(other.query_outside);
        self.query_excess = self.query_excess.max(other.query_excess);
        self.effort = self.effort.merged(&other.effort);
    }
}

/// What to draw.
#[derive(Debug, Clone, Copy)]
pub struct Plan {
    pub pairs: u64,
    pub seed: u64,
    /// Compare depths with the hull of differences up to this many points.
    pub hull_points: usize,
    /// Compare depths with separating axes up to this many pairs of faces.
    pub face_pairs: u64,
    /// Half-extents and radii are drawn from 1/spread to spread.
    pub spread: f64,
}

/// Draws pairs and checks them; the panic names the draw.
pub fn run<const N: usize>(plan: Plan) -> Report {
    let mut report = Report::default();
    let (mut shapes, mut scratch) = (None, Scratch::default());
    for index in 0..plan.pairs {
        report.merge(&check_drawn::<N>(plan, index, &mut shapes, &mut scratch));
    }
    report.effort = scratch.effort();
    report
}

/// Checks the pair of the given number. One in eight is a shape and a half-space. `shapes` are those of the pair before.
pub fn check_drawn<const N: usize>(
    plan: Plan,
    index: u64,
    shapes: &mut Option<Shapes<N>>,
    scratch: &mut Scratch<N>,
) -> Report {
    let of_this = Shapes::of(shapes.take(), plan.seed, index, plan.spread);
    let shapes = shapes.insert(of_this);
    if index % 8 == 7 {
        return half_spaces::check_drawn::<N>(&shapes.a, plan, index, scratch);
    }
    let Pair { a, b, pose_a, pose_b, name, small, mut random } = draw_of::<N>(shapes, plan.seed, index);
    Drawn { a: &a, b: &b, axes: &shapes.axes, pose_a, pose_b, name, small, plan }.check(&mut random, scratch)
}

/// Checks one pair that was not drawn, with all that is asked of drawn ones.
pub fn check_pair<const N: usize>(name: &str, a: &Piece<N>, pose_a: Pose<N>, b: &Piece<N>, pose_b: Pose<N>) -> Report {
    let small = convex(a).bounding_radius().min(convex(b).bounding_radius());
    let plan = Plan { pairs: 1, seed: 1, hull_points: 300, face_pairs: 3000, spread: 1.0 };
    let name = format!("N = {N}, {name}, {} and {}", kind(a), kind(b));
    let axes = Default::default();
    Drawn { a, b, axes: &axes, pose_a, pose_b, name, small, plan }.check(&mut Random(1), &mut Scratch::default())
}

struct Drawn<'a, const N: usize> {
    a: &'a Piece<N>,
    b: &'a Piece<N>,
    axes: &'a [OnceCell<SeparatingAxes<N>>; 2],
    pose_a: Pose<N>,
    pose_b: Pose<N>,
    name: String,
    small: f64,
    plan: Plan,
}

impl<const N: usize> Drawn<'_, N> {
    fn check(&self, random: &mut Random, scratch: &mut Scratch<N>) -> Report {
        let mut report = Report { pairs: 1, ..Report::default() };
        let truth = Truth::new(convex(self.a), &self.pose_a, convex(self.b), &self.pose_b);
        let mut out = Manifold::EMPTY;
        let mut cache = PairCache::default();
        let margin = 0.02 * self.small;
        // With an unlimited margin the answer is the distance itself.
        let whole = 10.0 * (truth.scale + self.pose_a.translation.distance(self.pose_b.translation));
        collide(self.a, &self.pose_a, self.b, &self.pose_b, whole, &mut PairCache::default(), scratch, &mut out);
        let distance = out
            .least_separation()
            .unwrap_or_else(|| panic!("{}: no answer {:?} {:?}", self.name, self.pose_a, self.pose_b));
        self.judge(&truth, &out, &mut report);
        self.judge_query(&truth, random, scratch, &mut report);
        // With a margin, from nothing and from a history.
        for step in 0..3 {
            collide(self.a, &self.pose_a, self.b, &self.pose_b, margin, &mut cache, scratch, &mut out);
            let unclear = 1e-9 * truth.scale + 1e-3 * margin;
            if out.is_empty() {
                assert!(distance > margin - unclear, "{}: {distance} missed in step {step}", self.name);
            } else {
                assert!(distance <= margin + unclear, "{}: {distance} reported in step {step}", self.name);
                self.judge(&truth, &out, &mut report);
            }
            if step == 0 {
                // A history from nearby, then back.
                let mut near = self.pose_b;
                near.translation += random.vector(1e-3 * self.small);
                collide(self.a, &self.pose_a, self.b, &near, margin, &mut cache, scratch, &mut out);
            }
        }
        collide(self.b, &self.pose_b, self.a, &self.pose_a, margin, &mut PairCache::default(), scratch, &mut out);
        if !out.is_empty() {
            self.judge(&truth, &out.flipped(), &mut report);
        }
        report
    }

    /// Whether a contact is right.
    fn judge(&self, truth: &Truth<'_, N>, out: &Manifold<N>, report: &mut Report) {
        let name = &self.name;
        let n = out.normal;
        assert!((n.norm() - 1.0).abs() < 1e-9, "{name}: normal of length {}", n.norm());
        assert!(out.points().len() <= max_points(N));
        let least = out.least_separation().expect("a contact has a point") + truth.rounding;
        let along = truth.separation(n);
        // Rounding grows with the larger shape; what a patch may leave out with the smaller.
        let rounding = 1e-9 * truth.scale;
        let slack =
            limits::FACET_PREFERENCE_RELATIVE * (-along).max(0.0) + (limits::SHOWS + limits::EQUAL_DEPTH) * self.small;
        assert!(least >= along - rounding, "{name}: {least} is deeper than possible along the normal, {along}");
        assert!(least <= along + slack + rounding, "{name}: {least} shown, {along} along the normal");
        report.touching = 1;
        report.separation_error = report.separation_error.max((least - along - rounding) / slack);
        for point in out.points() {
            let core_gap = point.separation + truth.rounding;
            let middle = point.position - n * (0.5 * (convex(self.a).radius - convex(self.b).radius));
            let (on_a, on_b) = (middle - n * (0.5 * core_gap), middle + n * (0.5 * core_gap));
            let outside =
                (truth.outside_a(on_a) + convex(self.a).radius).max(truth.outside_b(on_b) + convex(self.b).radius);
            let allowed = if point.id == WITNESS_OF_AN_OVERLAP {
                slack + 0.05 * along.abs()
            } else {
                limits::ASIDE * truth.rounding
            };
            assert!(
                outside <= rounding + allowed,
                "{name}: a contact point lies {outside} outside, gap {core_gap}, {:?} {:?} {:?}",
                self.pose_a,
                self.pose_b,
                out.normal
            );
            report.outside = report.outside.max((outside - allowed) / truth.scale);
        }
        if along > 1e-8 * truth.scale {
            // The points are in the shapes, and the normal shows that no others are closer by more than the slack.
            report.distance_error = report.distance_error.max((least - along) / self.small);
        } else {
            self.judge_depth(truth, -along, report);
        }
    }

    /// Whether the query for distance and depth is right: its normal certifies a lower bound, its points an upper one, and
    /// where the shapes overlap no other direction may be shallower, as two other algorithms see it.
    fn judge_query(&self, truth: &Truth<'_, N>, random: &mut Random, scratch: &mut Scratch<N>, report: &mut Report) {
        let name = &self.name;
        let found = separation_of_pieces(self.a, &self.pose_a, self.b, &self.pose_b, scratch)
            .unwrap_or_else(|| panic!("{name}: no separation"));
        let rounding = 1e-8 * truth.scale;
        let error = (found.distance - (truth.separation(found.normal) - truth.rounding)).abs();
        report.query_error = report.query_error.max(error / truth.scale);
        assert!(error <= rounding, "{name}: {found:?} is {error} off its normal");
        let outside = truth.outside_a(found.on_a).max(truth.outside_b(found.on_b));
        report.query_outside = report.query_outside.max(outside / truth.scale);
        assert!(outside <= 10.0 * rounding, "{name}: {found:?} has points {outside} outside");
        if found.distance.abs() > 10.0 * rounding {
            let meet = pieces_overlap(self.a, &self.pose_a, self.b, &self.pose_b);
            assert_eq!(meet, found.distance < 0.0, "{name}: {found:?}");
        }
        let depth = -found.distance - truth.rounding;
        if depth <= rounding {
            return;
        }
        let mut least = truth.least_depth_nearby(random, 4);
        report.depths_by_descent += 1;
        if let Some(by_axes) = self.depth_by_axes(truth) {
            report.depths_by_axes += 1;
            assert!(depth >= by_axes - rounding, "{name}: depth {depth}, by separating axes {by_axes}");
            least = least.min(by_axes);
        }
        report.query_excess = report.query_excess.max((depth - least) / truth.scale);
        assert!(depth <= least + rounding, "{name}: depth {depth}, but {least} is possible");
    }

    /// The least depth of the cores by the separating axes of all pairs of faces, if they are few enough.
    fn depth_by_axes(&self, truth: &Truth<'_, N>) -> Option<f64> {
        // With so many facets there are too many pairs in any case, and listing the faces takes time.
        if facet_count(&truth.a.core) * facet_count(&truth.b.core) > 1000 {
            return None;
        }
        let axes_a = self.axes[0].get_or_init(|| SeparatingAxes::of_core(truth.a));
        let axes_b = self.axes[1].get_or_init(|| SeparatingAxes::of_core(truth.b));
        if axes_a.pairs_with(axes_b) > self.plan.face_pairs {
            return None;
        }
        axes_a.separate(&self.pose_a, axes_b, &self.pose_b).map(|axis| -axis.separation)
    }

    fn judge_depth(&self, truth: &Truth<'_, N>, depth: f64, report: &mut Report) {
        report.overlapping = 1;
        let Some(least) = truth.least_depth(self.plan.hull_points) else { return };
        report.depths_compared = 1;
        let rounding = 1e-8 * truth.scale;
        let allowed = limits::FACET_PREFERENCE_RELATIVE * depth.abs()
            + 2.0 * (limits::FACET_PREFERENCE_ABSOLUTE + limits::HYSTERESIS) * truth.thickness();
        report.depth_shortfall = report.depth_shortfall.max((least - depth) / truth.scale);
        report.depth_excess = report.depth_excess.max((depth - least - rounding) / allowed);
        assert!(depth >= least - rounding, "{}: depth {depth}, least possible {least}", self.name);
        assert!(depth <= least + allowed + rounding, "{}: depth {depth}, least possible {least}", self.name);
    }
}

fn facet_count<const N: usize>(core: &Core<N>) -> usize {
    match core {
        Core::Point | Core::Segment { .. } => 2,
        Core::Box { .. } => 2 * N,
        Core::Polytope(polytope) => polytope.facets().len(),
    }
}

/// Name of the point that stands for an overlap whose patch does not show.
const WITNESS_OF_AN_OVERLAP: u32 = 0x5157_0001;

//! Random pairs of every kind and size, and what a contact of theirs must satisfy.

use hyperbody_collision::detect::SeparatingAxes;
use hyperbody_collision::query::{pieces_overlap, separation_of_pieces};
use hyperbody_collision::{Effort, Manifold, PairCache, Scratch, collide, limits, max_points};
use hyperbody_geometry::regular::{Regular, Size};
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Core, Polytope, Shape};
use hyperbody_math::{Pose, Rotation, Vector};
use std::sync::Arc;

use super::oracle::{Truth, convex};
use super::{Random, piece};

/// The worst of everything that was looked at.
#[derive(Debug, Default, Clone, Copy)]
pub struct Report {
    pub pairs: u64,
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

fn random_size(random: &mut Random, spread: f64) -> f64 {
    random.log_range(1.0 / spread, spread)
}

fn random_polytope<const N: usize>(random: &mut Random, size: f64) -> Option<Polytope<N>> {
    let kind = random.below(4);
    let mut points: Vec<Vector<N>> = Vec::new();
    match kind {
        // A regular polytope.
        3 => {
            let regular = match random.below(if N == 4 { 4 } else { 3 }) {
                0 => Regular::Simplex,
                1 => Regular::CrossPolytope,
                2 => Regular::Cube,
                _ => Regular::Cell24,
            };
            let solid = regular.polytope::<N>(Size::Circumradius(size)).ok()?;
            points.extend_from_slice(solid.vertices());
        }
        // A few points on a sphere.
        0 => points.extend((0..N + 1 + random.below(N + 4)).map(|_| random.direction::<N>() * size)),
        // A cross-polytope stretched along its axes.
        1 => {
            for axis in 0..N {
                let reach = size * random.range(0.3, 1.0);
                points.extend([Vector::unit(axis) * reach, -Vector::unit(axis) * reach]);
            }
        }
        // A grid: many points, many coplanar.
        _ => points.extend((0..3 * N).map(|_| Vector::from_fn(|_| size * (random.below(3) as f64 - 1.0)))),
    }
    if random.below(6) == 0 {
        let axis = random.below(N);
        points.iter_mut().for_each(|p| p[axis] *= 1e-2);
    }
    Polytope::from_points(&points).ok()
}

fn random_piece<const N: usize>(random: &mut Random, size: f64) -> Piece<N> {
    let cuboid = |random: &mut Random| {
        let flat = random.below(6) == 0;
        let half = Vector::from_fn(|_| size * if flat { random.log_range(1e-3, 1.0) } else { random.range(0.2, 1.0) });
        Shape::cuboid(half).expect("half-extents in range")
    };
    let polytope = |random: &mut Random| {
        // A hull can fail on a draw of coplanar points; a box never does.
        match random_polytope(random, size) {
            Some(polytope) => Shape::polytope(Arc::new(polytope)).expect("a solid polytope"),
            None => cuboid(random),
        }
    };
    let shape = match random.below(8) {
        0 => Shape::ball(size),
        1 => Shape::capsule(size * random.range(0.1, 1.0), size * random.range(0.05, 1.0), random.below(N)),
        2 => {
            let core = if random.below(2) == 0 { cuboid(random) } else { polytope(random) };
            Shape::rounded(core, size * random.range(0.01, 0.3))
        }
        3..=5 => Ok(cuboid(random)),
        _ => Ok(polytope(random)),
    };
    piece(shape.expect("lengths in range"))
}

fn random_rotation<const N: usize>(random: &mut Random) -> Rotation<N> {
    match random.below(5) {
        0 => Rotation::IDENTITY,
        1 => Rotation::in_plane(0, 1, std::f64::consts::FRAC_PI_2),
        2 => random.rotation(1e-4),
        _ => random.rotation(3.0),
    }
}

/// Places b so that the pair is anywhere between deep and apart, with a liking for the exact coincidences.
fn place<const N: usize>(random: &mut Random, a: &Piece<N>, b: &Piece<N>, small: f64) -> (Pose<N>, Pose<N>) {
    let mut pose_a = Pose::new(random_rotation(random), random.vector(1.0));
    if random.below(3) == 0 {
        pose_a = Pose::IDENTITY;
    }
    let mut pose_b = Pose::new(random_rotation(random), pose_a.translation);
    match random.below(8) {
        // Identical poses, and the same place with another rotation.
        0 => return (pose_a, pose_a),
        1 => return (pose_a, pose_b),
        _ => {}
    }
    if random.below(3) == 0 {
        pose_b.rotation = pose_a.rotation;
    }
    // Off to a side, then along a direction until the gap along it is as drawn.
    let n = if random.below(3) == 0 {
        pose_a.rotation.rotate(Vector::unit(random.below(N)))
    } else {
        random.direction::<N>()
    };
    let reach = convex(a).bounding_radius().min(convex(b).bounding_radius());
    if random.below(2) == 0 {
        pose_b.translation += random.vector(0.5 * reach);
    }
    let truth = Truth::new(convex(a), &pose_a, convex(b), &pose_b);
    let gap = match random.below(5) {
        0 => 0.0,
        1 => random.range(-1e-2, 1e-2) * small,
        2 => -random.log_range(1e-9, 1e-3) * small,
        _ => random.range(-1.0, 0.1) * small,
    };
    pose_b.translation += n * (gap - truth.separation(n) + truth.rounding);
    (pose_a, pose_b)
}

/// A drawn pair.
pub struct Pair<const N: usize> {
    pub a: Piece<N>,
    pub b: Piece<N>,
    pub pose_a: Pose<N>,
    pub pose_b: Pose<N>,
    /// Says which draw it is and what was drawn.
    pub name: String,
    /// The lesser bounding radius.
    pub small: f64,
    /// For whatever else the draw decides.
    pub random: Random,
}

/// The pair of the given number: the same for ever.
pub fn draw<const N: usize>(seed: u64, index: u64, spread: f64) -> Pair<N> {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9).wrapping_add(index));
    let size_a = random_size(&mut random, spread);
    let size_b = if random.below(2) == 0 { size_a } else { random_size(&mut random, spread) };
    let a = random_piece::<N>(&mut random, size_a);
    let b = if random.below(6) == 0 { a.clone() } else { random_piece::<N>(&mut random, size_b) };
    let small = convex(&a).bounding_radius().min(convex(&b).bounding_radius());
    let (pose_a, pose_b) = place(&mut random, &a, &b, small);
    let name = format!("N = {N}, seed {seed}, pair {index}, {} and {}", kind(&a), kind(&b));
    Pair { a, b, pose_a, pose_b, name, small, random }
}

/// Draws pairs and checks them; the panic names the draw.
pub fn run<const N: usize>(plan: Plan) -> Report {
    let mut report = Report::default();
    let mut scratch = Scratch::default();
    for index in 0..plan.pairs {
        report.merge(&check_drawn::<N>(plan, index, &mut scratch));
    }
    report.effort = scratch.effort();
    report
}

/// Checks the pair of the given number.
pub fn check_drawn<const N: usize>(plan: Plan, index: u64, scratch: &mut Scratch<N>) -> Report {
    let Pair { a, b, pose_a, pose_b, name, small, mut random } = draw::<N>(plan.seed, index, plan.spread);
    Drawn { a: &a, b: &b, pose_a, pose_b, name, small, plan }.check(&mut random, scratch)
}

/// Checks one pair that was not drawn, with all that is asked of drawn ones.
pub fn check_pair<const N: usize>(name: &str, a: &Piece<N>, pose_a: Pose<N>, b: &Piece<N>, pose_b: Pose<N>) -> Report {
    let small = convex(a).bounding_radius().min(convex(b).bounding_radius());
    let plan = Plan { pairs: 1, seed: 1, hull_points: 300, face_pairs: 3000, spread: 1.0 };
    let name = format!("N = {N}, {name}, {} and {}", kind(a), kind(b));
    Drawn { a, b, pose_a, pose_b, name, small, plan }.check(&mut Random(1), &mut Scratch::default())
}

fn kind<const N: usize>(piece: &Piece<N>) -> String {
    let core = match &convex(piece).core {
        Core::Point => "point".to_owned(),
        Core::Segment { half } => format!("segment {:?}", half.0),
        Core::Box { half_extents } => format!("box {:?}", half_extents.0),
        Core::Polytope(polytope) => {
            format!("polytope of {} vertices, {} facets", polytope.vertices().len(), polytope.facets().len())
        }
    };
    format!("{core} rounded by {}", convex(piece).radius)
}

struct Drawn<'a, const N: usize> {
    a: &'a Piece<N>,
    b: &'a Piece<N>,
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
        let (axes_a, axes_b) = (SeparatingAxes::of_core(&truth.a.clone()), SeparatingAxes::of_core(&truth.b.clone()));
        let exact = axes_a.pairs_with(&axes_b) <= self.plan.face_pairs;
        if exact && let Some(axis) = axes_a.separate(&self.pose_a, &axes_b, &self.pose_b) {
            report.depths_by_axes += 1;
            let by_axes = -axis.separation;
            assert!(depth >= by_axes - rounding, "{name}: depth {depth}, by separating axes {by_axes}");
            least = least.min(by_axes);
        }
        report.query_excess = report.query_excess.max((depth - least) / truth.scale);
        assert!(depth <= least + rounding, "{name}: depth {depth}, but {least} is possible");
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

/// Name of the point that stands for an overlap whose patch does not show.
const WITNESS_OF_AN_OVERLAP: u32 = 0x5157_0001;

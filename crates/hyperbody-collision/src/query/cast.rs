//! When moving and turning shapes first meet: conservative advancement with a bound of second order.
//!
//! At a time t let n be the unit direction between the closest points and d the distance. For a point with offset r from
//! the centre of its turning, f(τ) = n·r(t + τ) has the derivatives f′ = n·Ωr and f″ = n·Ω²r, and |f″| ≤ κ = |Ω²n|ρ, where
//! ρ is the largest |r| of the shape. So for all points of a at once
//!
//!   max f(τ) ≤ n·(c + τ v) + max over r of (n + τ Ωᵀn)·r + ½ κ τ²,
//!
//! whose middle part is one support query in a direction tilted by τ. The lower bound B(τ) on the gap along n that follows
//! (b's least minus a's greatest) is concave, as a minimum of linear functions minus squares, so it is positive up to its
//! only root, and no contact can come before that. B agrees with the true gap to first order, which makes the advance
//! converge quadratically where plain conservative advancement (Mirtich 1996; first-order bounds, kept here for long
//! ways) creeps. Without turning B is linear and a step is that of G. van den Bergen's ray cast (2004).
//!
//! Every step goes to a time up to which the shapes are proven apart. The loop ends at a gap of [`limits::CAST_GAP`] of the
//! size of the shapes, or where a bound shows that nothing is met, and at the latest after [`limits::MAX_CAST_TURNS`].

use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Convex, Shape};
use hyperbody_math::{Pose, Vector};

use super::motion::Motion;
use super::separation::{Closest, Separation, closest_of_pieces, separation_of_pieces, to_half_space};
use crate::limits;
use crate::narrow::{Scratch, plane_in_world};

/// Where a moving shape first meets another, at that time, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeHit<const N: usize> {
    /// s; the shapes are proven to be apart before it.
    pub time: f64,
    /// A point of the other shape's surface where they meet (with a margin: the one nearest to the moving shape).
    pub point: Vector<N>,
    /// Unit, out of the other shape towards the moving one.
    pub normal: Vector<N>,
    /// What is left between them, m: within rounding of the margin asked for. Negative if they overlapped at the start.
    /// More only if the bound on turns ended the search, which takes a turn by thousands of radians closely past
    /// something; the time is then a lower bound.
    pub gap: f64,
    /// Which part of the moving shape, if it is a compound; 0 for every other shape.
    pub part: u32,
    /// Which part of the other shape.
    pub other_part: u32,
    /// They were within the margin from the start: the time is 0.
    pub inside: bool,
}

/// When `shape` in `motion`, within 0 ≤ time ≤ `max_time` (s, may be infinite without turning), first comes within
/// `margin` (m, from 0 to [`limits::FARTHEST`]) of the shape `other` that stands at `world_from_other`. `None` if it does
/// not, if it only touches at the start and moves away or along without turning, if a number is out of its range or not
/// finite, or if `shape` is a half-space. Shapes that overlap at the start meet at time 0, with `inside` set.
///
/// ```
/// use hyperbody_collision::query::{Motion, shape_cast};
/// use hyperbody_geometry::Shape;
/// use hyperbody_math::{Pose, Vector};
/// let (ball, tesseract) = (Shape::<4>::ball(0.25)?, Shape::<4>::cuboid([0.5; 4])?);
/// let motion = Motion::linear(Pose::from_translation(Vector([-3.0, 0.1, 0.2, 0.3])), [2.0, 0.0, 0.0, 0.0]);
/// let hit = shape_cast(&ball, &motion, &tesseract, &Pose::IDENTITY, 5.0, 0.0).expect("it flies right at it");
/// assert!((hit.time - 1.125).abs() < 1e-9);
/// # Ok::<(), hyperbody_geometry::GeometryError>(())
/// ```
#[must_use]
pub fn shape_cast<const N: usize>(
    shape: &Shape<N>,
    motion: &Motion<N>,
    other: &Shape<N>,
    world_from_other: &Pose<N>,
    max_time: f64,
    margin: f64,
) -> Option<ShapeHit<N>> {
    let mut scratch = Scratch::default();
    let others = other.pieces();
    let mut first: Option<ShapeHit<N>> = None;
    for (part, (inner, piece)) in shape.pieces().iter().enumerate() {
        let Piece::Convex(convex) = piece else { return None };
        let motion = motion.of_part(inner);
        for (other_part, (inner, piece)) in others.iter().enumerate() {
            let pose = *world_from_other * *inner;
            let reach = first.map_or(max_time, |hit| hit.time);
            let hit = shape_cast_on_piece(convex, &motion, piece, &pose, reach, margin, &mut scratch);
            if let Some(hit) = hit.filter(|hit| first.is_none_or(|first| hit.time < first.time)) {
                first = Some(ShapeHit { part: part as u32, other_part: other_part as u32, ..hit });
            }
        }
    }
    first
}

/// [`shape_cast`] of one convex piece at another piece.
#[must_use]
pub fn shape_cast_on_piece<const N: usize>(
    convex: &Convex<N>,
    motion: &Motion<N>,
    other: &Piece<N>,
    world_from_other: &Pose<N>,
    max_time: f64,
    margin: f64,
    scratch: &mut Scratch<N>,
) -> Option<ShapeHit<N>> {
    match other {
        Piece::Convex(other) => {
            time_of_impact(convex, motion, other, &Motion::still(*world_from_other), max_time, margin, scratch)
        }
        Piece::HalfSpace { normal, offset } => {
            let plane = plane_in_world(world_from_other, *normal, *offset);
            let rest = Motion::still(*world_from_other);
            let pair = Movers { a: Mover::new(convex, motion), b: None, margin };
            if !(rest.is_valid() && plane.1.is_finite()) {
                return None;
            }
            pair.advance(max_time, scratch, |pose_a, _, _| {
                let found = to_half_space(convex, pose_a, plane);
                Some((found, found.distance <= 0.0))
            })
        }
    }
}

/// When two convex pieces, both in motion, first come within `margin` of each other; see [`shape_cast`]. The normal points
/// out of b, and `part`s are 0.
#[must_use]
pub fn time_of_impact<const N: usize>(
    a: &Convex<N>,
    motion_a: &Motion<N>,
    b: &Convex<N>,
    motion_b: &Motion<N>,
    max_time: f64,
    margin: f64,
    scratch: &mut Scratch<N>,
) -> Option<ShapeHit<N>> {
    if !motion_b.is_valid() {
        return None;
    }
    let pieces = (Piece::Convex(a.clone()), Piece::Convex(b.clone()));
    let pair = Movers { a: Mover::new(a, motion_a), b: Some(Mover::new(b, motion_b)), margin };
    pair.advance(max_time, scratch, |pose_a, pose_b, scratch| {
        match closest_of_pieces(&pieces.0, pose_a, &pieces.1, pose_b, f64::INFINITY) {
            Closest::Near(found) => Some((found, false)),
            Closest::Apart => None,
            Closest::Overlapping => {
                separation_of_pieces(&pieces.0, pose_a, &pieces.1, pose_b, scratch).map(|found| (found, true))
            }
        }
    })
}

/// One shape in motion.
struct Mover<'a, const N: usize> {
    convex: &'a Convex<N>,
    motion: &'a Motion<N>,
    /// Largest distance of a point of the core from the centre of turning.
    reach: f64,
    turns: bool,
}

impl<'a, const N: usize> Mover<'a, N> {
    fn new(convex: &'a Convex<N>, motion: &'a Motion<N>) -> Self {
        let turns = motion.angular_velocity.norm_sq() > 0.0;
        Self { convex, motion, reach: convex.core.bounding_radius() + motion.centre.norm(), turns }
    }

    /// Bound on |n·r′| over all times: the rotation turns r but keeps its length, and leaves |Ωn| alone.
    fn turning_speed(&self, n: Vector<N>) -> f64 {
        if self.turns { self.motion.angular_velocity.act_on(n).norm() * self.reach } else { 0.0 }
    }

    /// Bound on |n·r″|.
    fn curvature(&self, n: Vector<N>) -> f64 {
        let omega = &self.motion.angular_velocity;
        if self.turns { omega.act_on(omega.act_on(n)).norm() * self.reach } else { 0.0 }
    }

    /// Upper bound, up to the square term, on how far the core reaches along n at `ahead` seconds after `pose`.
    fn reach_along(&self, pose: &Pose<N>, n: Vector<N>, ahead: f64) -> f64 {
        let centre = pose.transform_point(self.motion.centre);
        let tilted = if self.turns { n - self.motion.angular_velocity.act_on(n) * ahead } else { n };
        let local = pose.rotation.inverse_rotate(tilted);
        let farthest = self.convex.core.support(local) - self.motion.centre;
        n.dot(centre) + ahead * n.dot(self.motion.velocity) + local.dot(farthest)
    }
}

/// A pair in motion; without b, against a half-space at rest, which moves along no normal.
struct Movers<'a, const N: usize> {
    a: Mover<'a, N>,
    b: Option<Mover<'a, N>>,
    margin: f64,
}

impl<const N: usize> Movers<'_, N> {
    /// Walks to the first contact. `separate` tells separation at two poses, and whether the shapes overlap.
    fn advance(
        &self,
        max_time: f64,
        scratch: &mut Scratch<N>,
        mut separate: impl FnMut(&Pose<N>, &Pose<N>, &mut Scratch<N>) -> Option<(Separation<N>, bool)>,
    ) -> Option<ShapeHit<N>> {
        if !(self.a.motion.is_valid() && max_time >= 0.0 && (0.0..=limits::FARTHEST).contains(&self.margin)) {
            return None;
        }
        let size = |mover: &Mover<'_, N>| mover.convex.bounding_radius();
        let tolerance = limits::CAST_GAP * (size(&self.a) + self.b.as_ref().map_or(0.0, size));
        let mut time = 0.0;
        for turn in 0..limits::MAX_CAST_TURNS {
            scratch.effort.cast_turns = scratch.effort.cast_turns.max(turn + 1);
            let pose_a = self.a.motion.at(time);
            let pose_b = self.b.as_ref().map_or(Pose::IDENTITY, |b| b.motion.at(time));
            let (found, overlapping) = separate(&pose_a, &pose_b, scratch)?;
            let gap = found.distance - self.margin;
            let hit = ShapeHit {
                time,
                point: found.on_b,
                normal: -found.normal,
                gap,
                part: 0,
                other_part: 0,
                inside: turn == 0 && gap < -tolerance,
            };
            let approach = self.approach(found.normal);
            if turn == 0 && !hit.inside && approach <= 0.0 {
                return None;
            }
            if overlapping || gap <= tolerance || turn + 1 == limits::MAX_CAST_TURNS {
                return Some(hit);
            }
            time += self.safe_step(&pose_a, &pose_b, found.normal, gap, approach, max_time - time)?;
        }
        None
    }

    /// Fastest that the gap along n can close, over all times.
    fn approach(&self, n: Vector<N>) -> f64 {
        let (speed_b, turning_b) =
            self.b.as_ref().map_or((0.0, 0.0), |b| (n.dot(b.motion.velocity), b.turning_speed(n)));
        n.dot(self.a.motion.velocity) - speed_b + self.a.turning_speed(n) + turning_b
    }

    /// A time for which the gap along n stays open; `None` if that is all the rest.
    fn safe_step(
        &self,
        pose_a: &Pose<N>,
        pose_b: &Pose<N>,
        n: Vector<N>,
        gap: f64,
        approach: f64,
        rest: f64,
    ) -> Option<f64> {
        let first_order = if approach > 0.0 { gap / approach } else { f64::INFINITY };
        if first_order > rest {
            return None;
        }
        let curvature = self.a.curvature(n) + self.b.as_ref().map_or(0.0, |b| b.curvature(n));
        // Nothing turns, or not along n.
        if curvature == 0.0 {
            return Some(first_order);
        }
        let reach = |ahead: f64| {
            let reach_b = self.b.as_ref().map_or(0.0, |b| b.reach_along(pose_b, -n, ahead));
            self.a.reach_along(pose_a, n, ahead) + reach_b
        };
        let now = reach(0.0);
        let bound = |ahead: f64| gap - (reach(ahead) - now) - 0.5 * curvature * ahead * ahead;
        // The square alone closes the gap after √(2·gap/κ); beyond, only a pair that flies apart keeps it open.
        let mut far = rest.min(16.0 * (first_order + (2.0 * gap / curvature).sqrt()));
        let mut closed = bound(far);
        if closed > 0.0 {
            return if far < rest { Some(far) } else { None };
        }
        // B is concave: the chord from a point where it is open meets zero before B does.
        let (mut near, mut open) = (0.0, gap);
        for _ in 0..CHORDS {
            let chord = near + (far - near) * open / (open - closed);
            let value = bound(chord);
            if value > 0.0 {
                (near, open) = (chord, value);
            }
            let middle = 0.5 * (near + far);
            let value = bound(middle);
            if value > 0.0 {
                (near, open) = (middle, value);
            } else {
                (far, closed) = (middle, value);
            }
        }
        Some(near.max(first_order))
    }
}

/// Rounds of narrowing the root of the bound; the step need not be the longest possible.
const CHORDS: u32 = 6;

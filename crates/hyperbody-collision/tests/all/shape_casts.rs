//! Shapes that move and turn, against rays on Minkowski sums, closed forms, and many poses on the way.

use crate::common::draw::{PLACEMENTS, draw};
use crate::common::oracle::vertices;
use crate::common::{Random, piece};
use hyperbody_collision::query::{
    Closest, Motion, ShapeHit, closest_of_pieces, shape_cast, shape_cast_on_piece, time_of_impact,
};
use hyperbody_collision::ray::{Ray, cast};
use hyperbody_collision::{Scratch, limits};
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Polytope, Shape};
use hyperbody_math::{Bivector, Pose, Rotation, Vector};
use std::sync::Arc;

fn turn<const N: usize>(random: &mut Random, rate: f64) -> Bivector<N> {
    Bivector::from_fn(|_, _| random.range(-rate, rate))
}

/// A ball that flies meets a shape where a ray meets the shape rounded by the ball's radius: another algorithm.
fn balls_meet_as_rays_meet_rounded_shapes<const N: usize>() {
    let mut random = Random(11 + N as u64);
    let (mut hits, mut misses) = (0, 0);
    for index in 0..300 {
        let pair = draw::<N>(41, PLACEMENTS * index, 2.0);
        let Piece::Convex(target) = &pair.a else { continue };
        let radius = random.range(0.05, 0.5);
        let ball = Shape::ball(radius).expect("a ball");
        let reach = target.bounding_radius() + radius;
        let from = pair.pose_a.translation + random.direction::<N>() * (reach * random.range(1.1, 3.0));
        let to = pair.pose_a.translation + random.direction::<N>() * (reach * random.range(0.0, 1.2));
        let ray = Ray::between(from, to).up_to(2.0);
        let mut rounded = target.clone();
        rounded.radius += radius;
        let seen = ray.seen_from(&pair.pose_a);
        let expected = hyperbody_collision::ray::cast_on_piece(&seen, &Piece::Convex(rounded));
        let motion = Motion::linear(Pose::new(random.rotation(2.0), from), to - from);
        let Piece::Convex(mover) = piece(ball) else { continue };
        let found = shape_cast_on_piece(&mover, &motion, &pair.a, &pair.pose_a, 2.0, 0.0, &mut Scratch::default());
        match (found, expected) {
            (Some(found), Some(expected)) => {
                hits += 1;
                // A grazing ray meets a rounded shape at an angle at which small errors of the gap become large in time.
                let slope = (-seen.direction.dot(expected.normal)).max(0.0) / seen.direction.norm();
                let length = 2e-8 * reach / slope.max(1e-4);
                let off = (found.time - expected.fraction).abs() * seen.direction.norm();
                assert!(off <= length, "{}: {found:?}, the ray {expected:?}", pair.name);
            }
            (None, None) => misses += 1,
            _ => {
                // Only grazing may be seen differently.
                let fraction = found.map_or_else(|| expected.map_or(0.0, |hit| hit.fraction), |hit| hit.time);
                let normal = found.map_or_else(
                    || expected.map_or(Vector::ZERO, |hit| hit.normal),
                    |hit| pair.pose_a.rotation.inverse_rotate(hit.normal),
                );
                let slope = seen.direction.dot(normal).abs() / seen.direction.norm();
                assert!(slope < 1e-3 || (fraction - 2.0).abs() < 1e-6, "{}: {found:?} {expected:?}", pair.name);
            }
        }
    }
    assert!(hits > 100 && misses > 20, "{hits} hits and {misses} misses in {N}D");
}

#[test]
fn flying_balls_are_rays_at_rounded_shapes() {
    for_every_dimension!(balls_meet_as_rays_meet_rounded_shapes);
}

/// A polytope that flies without turning meets another where a ray meets the hull of the differences of their vertices.
fn polytopes_meet_as_rays_meet_differences<const N: usize>() {
    let mut random = Random(5 + N as u64);
    let (mut hits, mut misses) = (0, 0);
    for index in 0..80 {
        let mut polytope = || {
            let size = random.log_range(0.1, 10.0);
            let points: Vec<Vector<N>> = (0..N + 2).map(|_| random.direction::<N>() * size).collect();
            Polytope::from_points(&points)
        };
        let (Ok(ours), Ok(theirs)) = (polytope(), polytope()) else { continue };
        let shape = |polytope: &Polytope<N>| piece(Shape::polytope(Arc::new(polytope.clone())).expect("a solid"));
        let (a, b) = (shape(&ours), shape(&theirs));
        let Piece::Convex(convex_a) = &a else { continue };
        let Piece::Convex(convex_b) = &b else { continue };
        let scale = ours.bounding_radius() + theirs.bounding_radius();
        let mut start = random.pose::<N>(1.0);
        let pose_b = random.pose::<N>(1.0);
        // a, moved off by s, meets b where s lies in the difference.
        let (at_a, at_b) = (vertices(&convex_a.core, &start), vertices(&convex_b.core, &pose_b));
        let points: Vec<Vector<N>> = at_b.iter().flat_map(|b| at_a.iter().map(move |a| *b - *a)).collect();
        let Ok(hull) = Polytope::from_points(&points) else { continue };
        let difference = Shape::polytope(Arc::new(hull)).expect("a solid");
        let off = random.direction::<N>() * (scale * random.range(2.0, 4.0));
        let velocity = random.vector::<N>(0.12 * scale) + (pose_b.translation - start.translation - off) * 0.5;
        start.translation += off;
        let expected = cast(&Ray::new(off, velocity).up_to(4.0), &difference, &Pose::IDENTITY);
        let motion = Motion::linear(start, velocity);
        let found = shape_cast_on_piece(convex_a, &motion, &b, &pose_b, 4.0, 0.0, &mut Scratch::default());
        // Both in motion, in another frame of reference.
        let drift = random.vector::<N>(scale);
        let (ma, mb) = (Motion::linear(start, velocity + drift), Motion::linear(pose_b, drift));
        let both = time_of_impact(convex_a, &ma, convex_b, &mb, 4.0, 0.0, &mut Scratch::default());
        match (found, expected) {
            (Some(found), Some(expected)) => {
                hits += 1;
                let slope = (-velocity.dot(expected.normal)).max(0.0) / velocity.norm();
                let away = |time: f64| (time - expected.fraction).abs() * velocity.norm();
                let allowed = 2e-8 * scale / slope.max(1e-4);
                assert!(away(found.time) <= allowed, "{N}D pair {index}: {found:?}, the ray {expected:?}");
                assert!(found.gap.abs() <= 2.0 * limits::CAST_GAP * scale, "{N}D pair {index}: {found:?}");
                let moved = both.expect("the same, seen from a moving frame").time;
                assert!(away(moved) <= allowed, "{N}D pair {index}: {moved}, the ray {expected:?}");
            }
            (None, None) => {
                misses += 1;
                assert!(both.is_none(), "{N}D pair {index}: {both:?}");
            }
            _ => {
                let normal = expected.map_or_else(|| found.map_or(Vector::ZERO, |hit| hit.normal), |hit| hit.normal);
                let slope = velocity.dot(normal).abs() / velocity.norm();
                assert!(slope < 1e-3, "{N}D pair {index}: {found:?} {expected:?}");
            }
        }
    }
    assert!(hits > 8 && misses > 5, "{hits} hits and {misses} misses in {N}D");
}

#[test]
fn flying_polytopes_are_rays_at_differences() {
    for_every_dimension!(polytopes_meet_as_rays_meet_differences);
}

/// Poses sampled on the way: none before the hit may overlap, at the hit the shapes touch, and without a hit none overlaps.
fn turning_shapes_touch_when_said<const N: usize>() {
    let mut random = Random(31 + N as u64);
    let mut scratch = Scratch::default();
    let (mut hits, mut misses) = (0, 0);
    for index in 0..250 {
        let pair = draw::<N>(47, PLACEMENTS * index, 2.0);
        let (Piece::Convex(a), Piece::Convex(b)) = (&pair.a, &pair.b) else { continue };
        let scale = a.bounding_radius() + b.bounding_radius();
        let mut start = pair.pose_a;
        start.translation += random.direction::<N>() * (scale * random.range(0.6, 2.0));
        let aim = (pair.pose_b.translation - start.translation) * random.range(0.2, 1.0);
        let velocity = aim + random.vector(0.2 * scale);
        let motion = Motion::linear(start, velocity)
            .turning(turn(&mut random, 3.0), random.vector::<N>(0.5 * a.bounding_radius()));
        let target =
            Motion::linear(pair.pose_b, random.vector::<N>(0.1 * scale)).turning(turn(&mut random, 2.0), Vector::ZERO);
        let margin = if index % 3 == 0 { 0.01 * scale } else { 0.0 };
        let found = time_of_impact(a, &motion, b, &target, 2.0, margin, &mut scratch);
        let distance =
            |time: f64| match closest_of_pieces(&pair.a, &motion.at(time), &pair.b, &target.at(time), f64::INFINITY) {
                Closest::Near(found) => found.distance,
                Closest::Overlapping => 0.0,
                Closest::Apart => f64::INFINITY,
            };
        let until = found.map_or(2.0, |hit| hit.time);
        let tolerance = 4.0 * limits::CAST_GAP * scale;
        if found.is_none_or(|hit| !hit.inside) {
            for sample in 0..100 {
                let time = until * f64::from(sample) / 100.0;
                let gap = distance(time) - margin;
                assert!(gap > -tolerance, "{}: gap {gap} at {time}, but {found:?}", pair.name);
                // Without a hit the shapes stay clear; before one, clear of more than rounding.
                assert!(gap > 0.0 || found.is_some(), "{}: gap {gap} at {time}, none found", pair.name);
            }
        }
        match found {
            Some(ShapeHit { inside: true, .. }) => {
                assert!(distance(0.0) <= margin, "{}: {found:?}", pair.name);
            }
            Some(hit) => {
                hits += 1;
                let gap = distance(hit.time) - margin;
                assert!(gap.abs() <= tolerance, "{}: gap {gap} at the hit {hit:?}", pair.name);
            }
            None => misses += 1,
        }
    }
    assert!(hits > 40 && misses > 20, "{hits} hits and {misses} misses in {N}D");
    let turns = scratch.effort().cast_turns;
    println!("{N}D: at most {turns} turns");
    assert!(turns < limits::MAX_CAST_TURNS / 2, "{turns} turns");
}

#[test]
fn turning_shapes_touch_at_the_hit_and_not_before() {
    for_every_dimension!(turning_shapes_touch_when_said);
}

/// A ball on an arm swings into a floor: the angle is known.
fn arms_swing<const N: usize>() {
    let (arm, radius, height) = (2.0, 0.25, 1.0);
    let floor = Shape::half_space(Vector::<N>::unit(1), 0.0).expect("a floor");
    let ball = Shape::ball(radius).expect("a ball");
    for last in 0..N {
        if last == 1 {
            continue;
        }
        // The arm points along `last` and turns towards −y; the ball's frame sits in the ball.
        let start = Pose::from_translation(Vector::unit(1) * height + Vector::unit(last) * arm);
        let spin = Bivector::wedge(-Vector::<N>::unit(1), Vector::unit(last));
        let down = spin.act_on(Vector::unit(last) * arm)[1];
        let spin = if down < 0.0 { spin } else { -spin };
        let motion = Motion::still(start).turning(spin, -Vector::unit(last) * arm);
        let expected = f64::asin((height - radius) / arm);
        let hit = shape_cast(&ball, &motion, &floor, &Pose::IDENTITY, 10.0, 0.0).expect("it swings into the floor");
        assert!((hit.time - expected).abs() < 1e-8, "{N}D, {hit:?}, expected {expected}");
        assert!(hit.normal.distance(Vector::unit(1)) < 1e-12 && hit.point[1].abs() < 1e-8, "{hit:?}");
        // With a margin a little sooner; too high, never.
        let soon = shape_cast(&ball, &motion, &floor, &Pose::IDENTITY, 10.0, 0.1).expect("sooner");
        assert!((soon.time - f64::asin((height - radius - 0.1) / arm)).abs() < 1e-8, "{soon:?}");
        let high = Motion { start: Pose::from_translation(start.translation + Vector::unit(1) * 1.3), ..motion };
        assert_eq!(shape_cast(&ball, &high, &floor, &Pose::IDENTITY, 10.0, 0.0), None);
    }
}

#[test]
fn a_ball_on_an_arm_meets_the_floor_at_the_known_angle() {
    for_every_dimension!(arms_swing);
}

fn edges<const N: usize>() {
    let cube = Shape::cuboid(Vector::<N>::splat(0.5)).expect("a cube");
    let x = Vector::<N>::unit(0);
    let at = |along: f64| Pose::from_translation(x * along);
    let cast = |motion: &Motion<N>, max_time: f64| shape_cast(&cube, motion, &cube, &Pose::IDENTITY, max_time, 0.0);
    // Touching and moving away, along, towards; overlapping from the start.
    assert_eq!(cast(&Motion::linear(at(1.0), x), 9.0), None);
    assert_eq!(cast(&Motion::linear(at(1.0), Vector::unit(1)), 9.0), None);
    assert_eq!(cast(&Motion::linear(at(1.0), -x), 9.0).map(|hit| (hit.time, hit.inside)), Some((0.0, false)));
    let inside = cast(&Motion::linear(at(0.75), x), 9.0).expect("they overlap");
    assert!(inside.inside && inside.time == 0.0 && (inside.gap + 0.25).abs() < 1e-9, "{inside:?}");
    // Not within the time; within it; standing still; no number.
    assert_eq!(cast(&Motion::linear(at(3.0), -x), 1.9), None);
    assert!(cast(&Motion::linear(at(3.0), -x), 2.1).is_some_and(|hit| (hit.time - 2.0).abs() < 1e-8));
    assert!(cast(&Motion::linear(at(3.0), -x), f64::INFINITY).is_some());
    assert_eq!(cast(&Motion::still(at(3.0)), f64::INFINITY), None);
    assert_eq!(cast(&Motion::linear(at(3.0), x * f64::NAN), 9.0), None);
    assert_eq!(cast(&Motion::linear(at(3.0), -x), f64::NAN), None);
    // From pose to pose: the last pose is reached.
    let to = Pose::new(Rotation::in_plane(0, N - 1, 1.0), x * 5.0 + Vector::unit(1));
    let motion = Motion::between(at(3.0), &to);
    let end = motion.at(1.0);
    assert!(end.translation.distance(to.translation) < 1e-12);
    assert!((0..N).all(|i| (end.rotation.matrix().row(i) - to.rotation.matrix().row(i)).norm() < 1e-12));
    let dense = shape_cast(&cube, &Motion::linear(at(1e6), -x), &cube, &Pose::IDENTITY, 2e6, 0.0).expect("a long way");
    assert!((dense.time - (1e6 - 1.0)).abs() < 1e-6, "{dense:?}");
}

#[test]
fn starts_ends_and_numbers_that_are_none() {
    for_every_dimension!(edges);
}

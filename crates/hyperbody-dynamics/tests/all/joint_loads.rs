//! Joints under loads that a sweep over them does not bear: long chains with heavy ends, nets, limits at the end of an arm.

use crate::common::{ball, cuboid, world};
use hyperbody_dynamics::{BodyDef, BodyHandle, Freedom, Groups, JointDef, Motor, World};
use hyperbody_math::{Pose, Vector};

/// Largest distance between two anchors.
fn gap<const N: usize>(world: &World<N>) -> f64 {
    let place = |body: Option<BodyHandle>, anchor| match body.and_then(|handle| world.body(handle)) {
        Some(body) => body.pose().transform_point(anchor),
        None => anchor,
    };
    let gaps = world.joints().map(|(_, joint)| {
        let def = joint.def();
        (place(Some(def.b), def.frame_b.translation) - place(def.a, def.frame_a.translation)).norm()
    });
    gaps.fold(0.0, f64::max)
}

fn total<const N: usize>(world: &World<N>) -> f64 {
    let energy = world.energy();
    energy.kinetic + energy.potential
}

/// Balls of 1 kg a metre apart, level, and one of 100 kg at the end; they do not collide.
fn chain<const N: usize>(links: usize) -> World<N> {
    let mut world = world(-Vector::<N>::unit(1) * 9.81);
    let along = Vector::unit(0);
    let mut last = None;
    for k in 0..=links {
        let mass = if k == links { 100.0 } else { 1.0 };
        let body = BodyDef::new(ball(0.25)).groups(Groups::NONE).mass(mass).position(along * (k as f64 + 0.5));
        let body = world.add_body(body).unwrap();
        let from = if last.is_some() { along * 0.5 } else { Vector::ZERO };
        world.add_joint(JointDef::ball(last, body, from, along * -0.5)).unwrap();
        last = Some(body);
    }
    world
}

/// The energy never grows, and no joint opens by more than a fiftieth of a link, all through the fall and the whip at its end.
fn falls<const N: usize>(links: usize) {
    let mut world = chain::<N>(links);
    let start = total(&world);
    let weight = 9.81 * (links as f64 + 100.0) * links as f64;
    for step in 0..360 {
        world.step();
        assert!(gap(&world) < 0.02, "{N}D: joints {} m apart at step {step}", gap(&world));
        let gained = total(&world) - start;
        assert!(gained < 1e-3 * weight, "{N}D: {gained} J gained at step {step}");
    }
}

#[test]
fn a_chain_with_a_hundredfold_end_swings_without_opening() {
    falls::<2>(40);
    falls::<3>(100);
    falls::<4>(40);
    falls::<6>(12);
}

/// A net of 6 × 6 balls hung by its corners with no slack, twenty times as heavy a ball in the middle of it.
#[test]
fn a_net_holds_what_lies_in_it() {
    let mut world = world(-Vector::<4>::unit(1) * 9.81);
    let side = 6;
    let mut knots = Vec::new();
    for i in 0..side {
        for j in 0..side {
            let corner = (i == 0 || i == side - 1) && (j == 0 || j == side - 1);
            let def = if corner { BodyDef::fixed(ball(0.2)) } else { BodyDef::new(ball(0.2)).mass(1.0) };
            let middle = i == side / 2 && j == side / 2;
            let def = if middle { def.mass(20.0) } else { def };
            let knot = world.add_body(def.position([i as f64, 0.0, 0.0, j as f64])).unwrap();
            let left = (i > 0).then(|| (knots[(i - 1) * side + j], 0));
            let behind = (j > 0).then(|| (knots[i * side + j - 1], 3));
            for (neighbour, axis) in left.into_iter().chain(behind) {
                let half = Vector::unit(axis) * 0.5;
                world.add_joint(JointDef::ball(neighbour, knot, half, -half)).unwrap();
            }
            knots.push(knot);
        }
    }
    for _ in 0..240 {
        world.step();
        assert!(gap(&world) < 0.02, "joints {} m apart", gap(&world));
    }
}

/// Against a motor at the end of an arm, whose moment of inertia is mostly m r², the pivot and the speed both hold: the motor gets the arm to its
/// speed within a step, if it is strong enough for that.
fn arm<const N: usize>() {
    let mut world = world(Vector::<N>::ZERO);
    let body = world.add_body(BodyDef::new(cuboid(Vector::splat(0.1))).position(Vector::unit(0) * 2.0)).unwrap();
    let at_pivot = Pose::new(hyperbody_math::Rotation::IDENTITY, -Vector::unit(0) * 2.0);
    let motor = Freedom { motor: Some(Motor { speed: 3.0, max_force: f64::INFINITY }), ..Freedom::FREE };
    let hinge = JointDef::hinge(None, body, Pose::IDENTITY, at_pivot, (0, 1)).plane(0, 1, motor);
    world.add_joint(hinge).unwrap();
    for step in 0..60 {
        world.step();
        let spin = world.body(body).unwrap().angular_velocity().get(0, 1);
        assert!((spin - 3.0).abs() < 0.01, "{N}D: {spin} rad/s after step {step}");
        assert!(gap(&world) < 1e-3);
    }
}

#[test]
fn a_motor_turns_a_long_arm() {
    arm::<2>();
    arm::<3>();
    arm::<5>();
}

/// A motor of 10 N·m on an arm of m r² = 4 kg m² speeds it up at 10/I from the first step on; no row fights another.
fn weak_arm<const N: usize>() {
    let mut world = world(Vector::<N>::ZERO);
    let body = BodyDef::new(cuboid(Vector::splat(0.1))).mass(1.0).position(Vector::unit(0) * 2.0);
    let body = world.add_body(body).unwrap();
    let at_pivot = Pose::from_translation(-Vector::unit(0) * 2.0);
    let hinge = JointDef::hinge(None, body, Pose::IDENTITY, at_pivot, (0, 1)).motor(0, 1, 3.0, 10.0);
    world.add_joint(hinge).unwrap();
    let moment = 4.0 + 0.02 / 3.0;
    for step in 1..=120 {
        world.step();
        let spin = world.body(body).unwrap().angular_velocity().get(0, 1);
        let expected = (10.0 / moment * f64::from(step) / 60.0).min(3.0);
        assert!((spin - expected).abs() < 0.01, "{N}D: {spin} rad/s after step {step}, not {expected}");
        assert!(gap(&world) < 1e-3);
    }
}

#[test]
fn a_weak_motor_turns_a_long_arm() {
    weak_arm::<2>();
    weak_arm::<3>();
    weak_arm::<4>();
    weak_arm::<6>();
}

/// An arm that lies on its limit is let go upwards when gravity turns over, as fast as it falls; and a motor stops at a limit, though it has ten times the strength that holds the arm level.
#[test]
fn limits_let_go_and_hold_against_motors() {
    let mut world = world(-Vector::<4>::unit(1) * 9.81);
    let body = BodyDef::new(cuboid(Vector::splat(0.1))).mass(1.0).position(Vector::unit(0) * 2.0);
    let body = world.add_body(body).unwrap();
    let at_pivot = Pose::from_translation(-Vector::unit(0) * 2.0);
    let hinge = JointDef::hinge(None, body, Pose::IDENTITY, at_pivot, (0, 1)).angle_limits(0, 1, 0.0, 0.5);
    let joint = world.add_joint(hinge.clone()).unwrap();
    for _ in 0..60 {
        world.step();
        assert!(gap(&world) < 1e-3 && world.body(body).unwrap().position()[1].abs() < 2e-3);
    }
    world.set_gravity(Vector::unit(1) * 9.81).unwrap();
    for step in 1..=6 {
        world.step();
        let spin = world.body(body).unwrap().angular_velocity().get(0, 1);
        let expected = 9.81 * 2.0 / (4.0 + 0.02 / 3.0) * f64::from(step) / 60.0;
        assert!((spin - expected).abs() < 0.02 * expected + 1e-3, "{spin} rad/s after step {step}, not {expected}");
        assert!(gap(&world) < 1e-3);
    }
    world.set_gravity(Vector::ZERO).unwrap();
    world.set_joint(joint, hinge.motor(0, 1, 2.0, 200.0)).unwrap();
    for _ in 0..120 {
        world.step();
    }
    let place = world.body(body).unwrap().position();
    let angle = place[1].atan2(place[0]);
    assert!((angle - 0.5).abs() < 5e-3 && gap(&world) < 1e-3, "the motor drove the arm to {angle} rad");
}

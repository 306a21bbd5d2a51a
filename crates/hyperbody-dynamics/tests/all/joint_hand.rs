//! The spring by which a hand holds a body: closed forms of the damped spring, its strength, and what it reports.

use crate::common::{ball, cuboid, down, run, world};
use hyperbody_dynamics::{BodyDef, JointDef, World, WorldDef, WorldErrorKind};
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

const OMEGA: f64 = std::f64::consts::TAU * 5.0;

/// A critically damped spring comes from rest at distance d to d(1 + ωt)exp(−ωt).
fn comes_to_the_target<const N: usize>() {
    let mut world =
        World::<N>::new(WorldDef { dt: 1.0 / 960.0, gravity: Vector::ZERO, ..WorldDef::default() }).unwrap();
    let body = world.add_body(BodyDef::new(ball(0.5)).mass(3.0)).unwrap();
    let target = Vector::<N>::from_fn(|i| 0.3 + 0.1 * i as f64);
    world.add_joint(JointDef::mouse(body, Vector::ZERO, target, f64::INFINITY)).unwrap();
    for step in 1..=480 {
        world.step();
        let t = f64::from(step) / 960.0;
        let expected = target.norm() * (1.0 + OMEGA * t) * (-OMEGA * t).exp();
        let distance = (world.body(body).unwrap().position() - target).norm();
        assert!((distance - expected).abs() < 0.01 * target.norm(), "{distance} m away after {t} s, not {expected}");
    }
}

#[test]
fn a_body_is_drawn_to_the_target_as_by_a_critically_damped_spring() {
    comes_to_the_target::<2>();
    comes_to_the_target::<3>();
    comes_to_the_target::<4>();
    comes_to_the_target::<5>();
    comes_to_the_target::<6>();
}

/// Held at the centre it sags by g/ω² and the joint reports the weight; at a corner it comes to hang below the hand.
fn holds_a_weight<const N: usize>() {
    let mut world = world(down::<N>());
    let body = world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).mass(2.0).angular_damping(2.0)).unwrap();
    let hand = world.add_joint(JointDef::mouse(body, Vector::ZERO, Vector::ZERO, 100.0)).unwrap();
    run(&mut world, 3.0);
    let sag = -world.body(body).unwrap().position()[1];
    assert!((sag - 9.81 / (OMEGA * OMEGA)).abs() < 1e-4, "sags by {sag} m");
    let force = world.joint(hand).unwrap().force();
    assert!((force - Vector::unit(1) * (2.0 * 9.81)).norm() < 1e-3, "reports {force:?}");

    let corner = Vector::splat(0.5);
    let mut def = world.joint(hand).unwrap().def().clone();
    def = def.anchors(Vector::ZERO, corner);
    world.set_joint(hand, def).unwrap();
    run(&mut world, 20.0);
    let below = -corner.norm();
    let position = world.body(body).unwrap().position();
    assert!((position[1] - below).abs() < 0.02, "hangs {} m below the hand, not {below}", position[1]);
}

#[test]
fn a_hand_holds_a_weight_and_feels_it() {
    holds_a_weight::<2>();
    holds_a_weight::<3>();
    holds_a_weight::<4>();
    holds_a_weight::<5>();
    holds_a_weight::<6>();
}

/// A hand weaker than the weight lets it fall at g − F/m, whatever the direction of the target.
fn is_no_stronger_than_it_is<const N: usize>() {
    let mut world = world(down::<N>());
    let body = world.add_body(BodyDef::new(ball(0.5)).mass(2.0)).unwrap();
    world.add_joint(JointDef::mouse(body, Vector::ZERO, Vector::unit(1) * 100.0, 12.0)).unwrap();
    run(&mut world, 1.0);
    let speed = world.body(body).unwrap().velocity()[1];
    assert!((speed + 9.81 - 6.0).abs() < 1e-4, "falls at {speed} m/s after a second");
}

#[test]
fn a_hand_has_a_strength() {
    is_no_stronger_than_it_is::<2>();
    is_no_stronger_than_it_is::<4>();
    is_no_stronger_than_it_is::<6>();
}

/// A grip turns the body to the target, however far, and a body let go flies on as it moved.
fn turns_and_throws<const N: usize>() {
    let mut world = world(Vector::<N>::ZERO);
    let body = world.add_body(BodyDef::new(cuboid(Vector::from_fn(|i| 0.2 + 0.1 * i as f64)))).unwrap();
    let turn = Bivector::from_fn(|i, j| if i == 0 { 2.0 / j as f64 } else { 0.3 });
    let target = Pose::new(Rotation::exp(&turn), Vector::splat(0.4));
    let grip = world.add_joint(JointDef::grip(body, Pose::IDENTITY, target, 1e4, 1e4)).unwrap();
    run(&mut world, 3.0);
    let pose = world.body(body).unwrap().pose();
    assert!(
        (pose.translation - target.translation).norm() < 1e-4,
        "{} m away",
        (pose.translation - target.translation).norm()
    );
    assert!(pose.rotation.angle_to(&target.rotation) < 1e-3, "{} rad off", pose.rotation.angle_to(&target.rotation));
    for step in 0..120 {
        let x = target.translation + Vector::unit(0) * (f64::from(step) / 60.0);
        world.set_joint_target(grip, x).unwrap();
        world.step();
    }
    world.remove_joint(grip).unwrap();
    run(&mut world, 1.0);
    let velocity = world.body(body).unwrap().velocity();
    // The target jumps once a step, and at the end of a step the body has all but caught up with it.
    assert!((velocity - Vector::unit(0)).norm() < 0.025, "flies at {velocity:?}");
    let error = world.set_joint_target(grip, Vector::ZERO).unwrap_err();
    assert_eq!(error.kind(), WorldErrorKind::StaleHandle);
}

#[test]
fn a_grip_turns_and_throws() {
    turns_and_throws::<2>();
    turns_and_throws::<3>();
    turns_and_throws::<4>();
    turns_and_throws::<5>();
    turns_and_throws::<6>();
}

#[test]
fn a_sleeping_body_wakes_when_it_is_taken_and_when_the_hand_moves() {
    let mut world = World::<4>::new(WorldDef::default()).unwrap();
    crate::common::add_floor(&mut world, crate::common::material(0.5, 0.0));
    let body = world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 0.5)).unwrap();
    run(&mut world, 2.0);
    assert!(world.body(body).unwrap().is_sleeping());
    let hand = world.add_joint(JointDef::mouse(body, Vector::ZERO, Vector::unit(1) * 0.5, 1e3)).unwrap();
    world.step();
    assert!(!world.body(body).unwrap().is_sleeping());
    run(&mut world, 2.0);
    assert!(world.body(body).unwrap().is_sleeping());
    world.set_joint_target(hand, Vector::unit(1) * 1.5).unwrap();
    run(&mut world, 1.0);
    assert!((world.body(body).unwrap().position()[1] - 1.5).abs() < 0.02);
}

#[test]
fn wrong_hands_are_refused() {
    let mut world = world(Vector::<4>::ZERO);
    let body = world.add_body(BodyDef::new(ball(0.5))).unwrap();
    let nan = Vector::splat(f64::NAN);
    for def in [
        JointDef::mouse(body, nan, Vector::ZERO, 1.0),
        JointDef::mouse(body, Vector::ZERO, nan, 1.0),
        JointDef::mouse(body, Vector::ZERO, Vector::unit(0) * 1e20, 1.0),
        JointDef::mouse(body, Vector::unit(0) * 1e300, Vector::ZERO, 1.0),
        JointDef::mouse(body, Vector::ZERO, Vector::ZERO, -1.0),
        JointDef::mouse(body, Vector::ZERO, Vector::ZERO, f64::NAN),
        JointDef::mouse(body, Vector::ZERO, Vector::ZERO, 1.0).softness(0.0, 1.0),
    ] {
        assert_eq!(world.add_joint(def).unwrap_err().kind(), WorldErrorKind::BadNumber);
    }
    let hand = world.add_joint(JointDef::mouse(body, Vector::ZERO, Vector::ZERO, 1.0)).unwrap();
    assert_eq!(world.set_joint_target(hand, nan).unwrap_err().kind(), WorldErrorKind::BadNumber);
    let fixed = world.add_body(BodyDef::fixed(ball(0.5))).unwrap();
    let error = world.add_joint(JointDef::mouse(fixed, Vector::ZERO, Vector::ZERO, 1.0)).unwrap_err();
    assert_eq!(error.kind(), WorldErrorKind::NotAllowed);
    world.remove_body(body).unwrap();
    assert!(world.joint(hand).is_none(), "the joint goes with its body");
}

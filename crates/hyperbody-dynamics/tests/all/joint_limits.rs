//! Limits of angles wherever they lie, planes named either way round, and elastic ropes.

use std::f64::consts::{PI, TAU};

use crate::common::{GRAVITY, assert_close, ball, cuboid, down, in_all_dimensions, run, world};
use hyperbody_dynamics::{BodyDef, BodyHandle, Freedom, JointDef, Spring, World, WorldDef, WorldErrorKind};
use hyperbody_math::{Bivector, Pose, Rotation, Vector, planes};

in_all_dimensions! {
    limits_hold_wherever_they_lie: check_limits;
    narrow_cones_keep_fast_axes: check_narrow_cones;
    a_cone_that_points_straight_back_leaves_locked_planes_alone: check_cone_behind;
    springs_and_motors_do_not_press_through_limits: check_driven_limits;
    soft_joints_with_limits_throw_nobody: check_soft_limits;
    a_cone_keeps_an_axis_and_leaves_the_turns_about_it: check_cone;
    planes_may_be_named_either_way_round: check_order;
    an_elastic_rope_is_a_spring_while_it_is_taut: check_elastic_rope;
    a_joint_between_moving_bodies_reports_the_torque_about_the_second_anchor: check_torque;
}

fn spun<const N: usize>(rate: f64, joint: impl Fn(JointDef<N>) -> JointDef<N>) -> (World<N>, BodyHandle) {
    let mut world = world(Vector::<N>::ZERO);
    let mut spin = Bivector::ZERO;
    spin.set(0, 1, rate);
    let shape = cuboid(Vector::from_fn(|i| 0.2 + 0.1 * i as f64));
    let body = world.add_body(BodyDef::new(shape).angular_velocity(spin)).unwrap();
    world.add_joint(joint(JointDef::hinge(None, body, Pose::IDENTITY, Pose::IDENTITY, (0, 1)))).unwrap();
    (world, body)
}

/// The least and the greatest angle, counted on through whole turns, that a body comes to which was set spinning.
fn reached<const N: usize>(rate: f64, joint: impl Fn(JointDef<N>) -> JointDef<N>) -> (f64, f64) {
    let (mut world, body) = spun(rate, joint);
    let (mut angle, mut least, mut greatest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for _ in 0..600 {
        world.step();
        let now = world.body(body).unwrap().rotation().log().get(0, 1);
        angle += (now - angle) - TAU * ((now - angle) / TAU).round();
        (least, greatest) = (least.min(angle), greatest.max(angle));
    }
    (least, greatest)
}

fn check_limits<const N: usize>() {
    let degrees = [(0.0, 180.0), (-180.0, 30.0), (-90.0, 180.0), (0.0, 270.0), (-300.0, 10.0), (-170.0, 170.0)];
    for (low, high) in degrees.map(|(low, high)| (f64::to_radians(low), f64::to_radians(high))) {
        let (_, greatest) = reached::<N>(2.0, |hinge| hinge.angle_limits(0, 1, low, high));
        assert!((greatest - high).abs() < 5e-3, "{greatest} at the greatest of {low}..{high} in {N}D");
        let (least, _) = reached::<N>(-2.0, |hinge| hinge.angle_limits(0, 1, low, high));
        assert!((least - low).abs() < 5e-3, "{least} at the least of {low}..{high} in {N}D");
    }
    let (_, greatest) = reached::<N>(2.0, |hinge| hinge.angle_limits(0, 1, -PI, PI));
    assert!(greatest > 3.0 * PI, "limits a whole turn apart limit nothing, but stop at {greatest} in {N}D");
    let (mut world, body) = spun::<N>(0.0, |hinge| hinge);
    let hinge = || JointDef::<N>::hinge(None, body, Pose::IDENTITY, Pose::IDENTITY, (0, 1));
    for (low, high) in [(-7.0, 0.0), (0.0, 7.0), (-4.0, 4.0), (1.0, 1.0), (f64::NAN, 1.0)] {
        let error = world.add_joint(hinge().angle_limits(0, 1, low, high)).unwrap_err();
        assert_eq!(error.kind(), WorldErrorKind::BadNumber, "{low}..{high}");
    }
}

fn check_cone<const N: usize>() {
    let largest = 0.5;
    for (i, j) in planes::all(N).filter(|&(i, j)| i == 1 || j == 1) {
        let mut world = world(Vector::<N>::ZERO);
        let mut spin = Bivector::ZERO;
        spin.set(i, j, 2.0);
        // And some turn about the axis, so that it does not go straight to the rim.
        spin.set(0, N - 1, spin.get(0, N - 1) + if N > 2 { 1.0 } else { 0.0 });
        let body = world.add_body(BodyDef::new(cuboid(Vector::splat(0.3))).angular_velocity(spin)).unwrap();
        world.add_joint(JointDef::ball(None, body, Vector::ZERO, Vector::ZERO).cone(1, largest)).unwrap();
        let (mut farthest, mut turned) = (0.0_f64, 0.0_f64);
        for _ in 0..300 {
            world.step();
            let body = world.body(body).unwrap();
            let axis = body.rotation().rotate(Vector::unit(1));
            farthest = farthest.max(axis[1].clamp(-1.0, 1.0).acos());
            turned = turned.max(1.0 - body.rotation().rotate(Vector::unit(0))[0]);
        }
        assert!((farthest - largest).abs() < 5e-3, "{farthest} rad in plane {i}{j} of {N}D");
        assert!(N == 2 || turned > 1.5, "what is about the axis is free in {N}D, but turned by {turned}");
    }
    // A bar that points sideways sinks to the rim of its cone; what holds it there is the torque of its weight.
    let mut world = world(down::<N>());
    let bar =
        world.add_body(BodyDef::new(cuboid(Vector::splat(0.1))).mass(2.0).position(Vector::unit(0) * 0.8)).unwrap();
    let def = JointDef::ball(None, bar, Vector::ZERO, Vector::unit(0) * -0.8).cone(0, largest);
    let joint = world.add_joint(def.clone()).unwrap();
    run(&mut world, 3.0);
    let place = world.body(bar).unwrap().position();
    assert_close("sinks to", (-place[1]).atan2(place[0]), largest, 2e-3);
    let torque = 2.0 * GRAVITY * 0.8 * largest.cos();
    assert_close("held by", world.joint(joint).unwrap().torque().norm(), torque, 5e-3);
    for wrong in [0.0, -1.0, PI, f64::NAN] {
        let error = world.add_joint(def.clone().cone(0, wrong)).unwrap_err();
        assert_eq!(error.kind(), WorldErrorKind::BadNumber, "{wrong}");
    }
    let weld = JointDef::weld(None, bar, Pose::IDENTITY, Pose::IDENTITY).cone(0, 1.0);
    assert_eq!(world.add_joint(weld).unwrap_err().kind(), WorldErrorKind::NotAllowed);
}

fn check_narrow_cones<const N: usize>() {
    for (largest, rate) in [(0.01, 50.0), (0.02, 20.0), (0.05, 20.0), (0.3, 100.0)] {
        let mut world = world(Vector::<N>::ZERO);
        let mut spin = Bivector::ZERO;
        spin.set(0, 1, rate);
        let body = world.add_body(BodyDef::new(cuboid(Vector::splat(0.3))).angular_velocity(spin)).unwrap();
        world.add_joint(JointDef::ball(None, body, Vector::ZERO, Vector::ZERO).cone(1, largest)).unwrap();
        let mut farthest: f64 = 0.0;
        for _ in 0..120 {
            world.step();
            let axis = world.body(body).unwrap().rotation().rotate(Vector::unit(1));
            farthest = farthest.max(axis[1].clamp(-1.0, 1.0).acos());
        }
        assert!(farthest < 1.05 * largest + 1e-3, "{farthest} rad of {largest} at {rate} rad/s in {N}D");
    }
}

/// A hinge that starts half a turn from where its cone allows comes back within its own plane.
fn check_cone_behind<const N: usize>() {
    let across = N - 1;
    let mut world = world(Vector::<N>::ZERO);
    let back = Rotation::<N>::in_plane(0, across, PI);
    let body = world.add_body(BodyDef::new(cuboid(Vector::splat(0.3))).rotation(back)).unwrap();
    let hinge = JointDef::hinge(None, body, Pose::IDENTITY, Pose::IDENTITY, (0, across));
    world.add_joint(hinge.cone(0, 0.5)).unwrap();
    run(&mut world, 5.0);
    let axis = world.body(body).unwrap().rotation().rotate(Vector::unit(0));
    assert!(axis[0].clamp(-1.0, 1.0).acos() < 0.51, "{axis:?} in {N}D");
    let within = axis[0].hypot(axis[across]);
    assert!(within > 1.0 - 1e-5, "it left its plane: {axis:?} in {N}D");
}

/// However strong they are.
fn check_driven_limits<const N: usize>() {
    for hz in [5.0, 15.0, 30.0, 60.0, 1000.0] {
        let spring = Spring { target: 1.5, hz, damping_ratio: 1.0, max_force: f64::INFINITY };
        let (_, greatest) = reached::<N>(0.0, |hinge| hinge.angle_spring(0, 1, spring).angle_limits(0, 1, -1.0, 0.5));
        assert!((greatest - 0.5).abs() < 5e-3, "{hz} Hz presses to {greatest} in {N}D");
    }
    let (_, greatest) = reached::<N>(0.0, |hinge| hinge.motor(0, 1, 5.0, 1e6).angle_limits(0, 1, -1.0, 0.5));
    assert!((greatest - 0.5).abs() < 5e-3, "a motor presses to {greatest} in {N}D");
}

fn check_soft_limits<const N: usize>() {
    for arm in [0.0, 0.5, 1.0, 2.0, 3.0] {
        for hz in [1.0, 5.0, 15.0, 30.0] {
            let mut world = world(down::<N>());
            let place = Vector::unit(0) * arm;
            let body = world.add_body(BodyDef::new(cuboid(Vector::splat(0.1))).mass(1.0).position(place)).unwrap();
            let freedom = Freedom { limits: Some((-0.3, 0.3)), ..Freedom::FREE };
            let slider = JointDef::slider(None, body, Pose::IDENTITY, Pose::from_translation(-place), 1);
            world.add_joint(slider.axis(1, freedom).softness(hz, 1.0)).unwrap();
            let start = world.energy().total();
            for step in 0..600 {
                world.step();
                // A light body at a long arm turns over within a few substeps, which gains something; it was thrown at 490 m/s.
                let (gain, fall) = (world.energy().total() - start, GRAVITY * arm);
                assert!(gain < 0.5 * fall + 1e-6, "{gain} J at step {step}, arm {arm} m, {hz} Hz in {N}D");
            }
        }
    }
}

/// What acts from the second axis to the first is what acts from the first to the second with the other sign.
fn check_order<const N: usize>() {
    let after = |joint: fn(JointDef<N>) -> JointDef<N>| {
        let (mut world, body) = spun::<N>(0.0, joint);
        run(&mut world, 1.0);
        world.body(body).unwrap().rotation().log().get(0, 1)
    };
    let one = after(|hinge| hinge.motor(0, 1, 1.0, 100.0).angle_limits(0, 1, -0.3, 0.4));
    let other = after(|hinge| hinge.motor(1, 0, -1.0, 100.0).angle_limits(1, 0, -0.4, 0.3));
    assert_eq!(one.to_bits(), other.to_bits());
    assert_close("the motor's limit", one, 0.4, 0.01);
    assert_close("the other way", after(|hinge| hinge.motor(1, 0, 0.5, 100.0)), -0.5, 0.02);
    let sprung =
        after(|hinge| hinge.angle_spring(1, 0, Spring { target: -2.0, hz: 3.0, damping_ratio: 1.0, max_force: 1e9 }));
    assert_close("the spring's target", sprung, 2.0, 0.01);
}

fn check_elastic_rope<const N: usize>() {
    let (length, hz) = (1.0, 1.0);
    let stretch = GRAVITY / (2.0 * PI * hz).powi(2);
    let hang = |damping_ratio, max_force| {
        let def = WorldDef { gravity: down::<N>(), sleeping: false, dt: 1.0 / 960.0, ..WorldDef::default() };
        let mut world = World::new(def).unwrap();
        let bob = world.add_body(BodyDef::new(ball(0.1)).mass(3.0).position(Vector::unit(1) * -0.5)).unwrap();
        let mut rope = JointDef::rope(None, bob, Vector::ZERO, Vector::ZERO, length).softness(hz, damping_ratio);
        rope.max_force = max_force;
        world.add_joint(rope).unwrap();
        (world, bob)
    };
    let (mut world, bob) = hang(0.3, f64::INFINITY);
    run(&mut world, 15.0);
    assert_close("hangs at", -world.body(bob).unwrap().position()[1], length + stretch, 1e-3);

    // Dropped from half its length: falls freely until it is taut, then swings as a spring does, and comes back to where it was.
    let (mut world, bob) = hang(0.0, f64::INFINITY);
    let speed_sq = 2.0 * GRAVITY * 0.5;
    let omega = 2.0 * PI * hz;
    let deepest = length + stretch + (stretch * stretch + speed_sq / (omega * omega)).sqrt();
    let (mut lowest, mut back) = (0.0_f64, f64::NEG_INFINITY);
    for _ in 0..1920 {
        world.step();
        let y = world.body(bob).unwrap().position()[1];
        if y < lowest {
            (lowest, back) = (y, f64::NEG_INFINITY);
        }
        back = back.max(y);
    }
    assert_close("the lowest point", -lowest, deepest, 0.002);
    assert_close("the height that it comes back to", -back, 0.5, 0.02);

    // Too weak for what hangs on it.
    let (mut world, bob) = hang(1.0, 2.0 * GRAVITY);
    run(&mut world, 4.0);
    let taut = (2.0_f64 * 0.5 / GRAVITY).sqrt();
    let (speed, left) = (GRAVITY * taut, 4.0 - taut);
    let least = length + speed * left + 0.5 * (GRAVITY / 3.0) * left * left;
    assert_close("what a weak rope lets fall", -world.body(bob).unwrap().position()[1], least, 0.01);

    let mut stiff = JointDef::rope(None, bob, Vector::ZERO, Vector::ZERO, length);
    stiff.max_force = 1.0;
    let error = world.add_joint(stiff).unwrap_err();
    assert!(error.to_string().contains("softness"), "{error}");
}

/// The change of b's angular momentum about its own centre is the arm's and what is reported beside it.
fn check_torque<const N: usize>() {
    let def = WorldDef { gravity: Vector::<N>::ZERO, dt: 1.0 / 960.0, ..WorldDef::default() };
    let mut world = World::new(def).unwrap();
    let shape = || cuboid(Vector::from_fn(|i| 0.2 + 0.1 * i as f64));
    let a = world.add_body(BodyDef::new(shape())).unwrap();
    let at = Vector::from_fn(|i| 0.5 + 0.1 * i as f64);
    let b = world.add_body(BodyDef::new(shape()).position(at).velocity(Vector::unit(0) * 3.0)).unwrap();
    let (on_a, on_b) = (Vector::unit(0) * 0.3, Vector::unit(1) * -0.4);
    let joint = world.add_joint(JointDef::ball(a, b, on_a, on_b).softness(0.5, 2.0)).unwrap();
    run(&mut world, 0.01);
    let before = world.body(b).unwrap().angular_momentum();
    world.step();
    let (body, joint) = (world.body(b).unwrap(), world.joint(joint).unwrap());
    let arm = body.rotation().rotate(on_b);
    let told = Bivector::wedge(arm, joint.impulse()) + joint.angular_impulse();
    let felt = body.angular_momentum() - before;
    let off = (told - felt).norm();
    assert!(off < 0.01 * felt.norm(), "told {told:?}, felt {felt:?} in {N}D");
    assert!(joint.angular_impulse().norm() > 0.1 * felt.norm(), "the gap counts in {N}D");
}

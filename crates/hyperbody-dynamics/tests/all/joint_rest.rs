//! What joints leave free goes on as long as something moves it, however slowly; what hangs still falls asleep.

use std::f64::consts::PI;

use crate::common::{GRAVITY, assert_close, ball, cuboid, down, in_all_dimensions, material, run};
use hyperbody_dynamics::{
    BodyDef, BodyHandle, BodyKind, Freedom, JointDef, JointHandle, Motor, Spring, World, WorldDef,
};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

in_all_dimensions! {
    small_swings_go_on: check_small_swings;
    a_slider_under_weak_gravity_falls: check_weak_slider;
    a_slow_motor_turns_on: check_slow_motor;
    a_weak_motor_sets_out: check_weak_motor;
    an_undamped_spring_swings_on: check_undamped_spring;
    a_balance_does_not_stay_tilted: check_balance;
    what_starts_far_from_its_place_arrives: check_far_starts;
    what_goes_on_slowly_goes_on: check_slow_ways;
    an_overdamped_spring_arrives: check_overdamped_spring;
    what_was_held_up_by_a_force_wakes_when_it_ends: check_cleared_force;
}

fn sleepy<const N: usize>(gravity: Vector<N>) -> World<N> {
    World::new(WorldDef { gravity, ..WorldDef::default() }).unwrap()
}

/// A ball on a ball joint, hanging at an angle from straight down.
fn pendulum<const N: usize>(length: f64, angle: f64) -> (World<N>, BodyHandle) {
    let mut world = sleepy(down());
    let at = (Vector::unit(0) * angle.sin() - Vector::unit(1) * angle.cos()) * length;
    let bob = world.add_body(BodyDef::new(ball(0.05)).position(at)).unwrap();
    world.add_joint(JointDef::ball(None, bob, Vector::ZERO, -at)).unwrap();
    (world, bob)
}

fn check_small_swings<const N: usize>() {
    for (length, degrees) in [(0.3, 1.7), (1.0, 0.6), (4.0, 0.2), (10.0, 0.25), (25.0, 0.17)] {
        let (mut world, bob) = pendulum::<N>(length, f64::to_radians(degrees));
        let start = world.body(bob).unwrap().position()[0];
        run(&mut world, 20.0);
        let period = 2.0 * PI * (length / GRAVITY).sqrt();
        let mut farthest: f64 = 0.0;
        for _ in 0..(period / world.dt()) as usize + 1 {
            world.step();
            farthest = farthest.max(world.body(bob).unwrap().position()[0].abs());
        }
        assert!(farthest > 0.8 * start, "{length} m, {degrees}°: swings {farthest} m of {start} m in {N}D");
    }
    let (mut world, bob) = pendulum::<N>(1.0, 0.0);
    run(&mut world, 2.0);
    assert!(world.body(bob).unwrap().is_sleeping(), "what hangs still is awake in {N}D");
}

fn check_weak_slider<const N: usize>() {
    let gravity = 0.02;
    let mut world = sleepy(Vector::<N>::unit(1) * -gravity);
    let body = world.add_body(BodyDef::new(cuboid(Vector::splat(0.3)))).unwrap();
    world.add_joint(JointDef::slider(None, body, Pose::IDENTITY, Pose::IDENTITY, 1)).unwrap();
    run(&mut world, 8.0);
    assert_close("fallen", -world.body(body).unwrap().position()[1], 0.5 * gravity * 64.0, 0.01);
}

/// A body on a hinge of the plane of the first two axes.
fn hinged<const N: usize>(turn: f64, freedom: Freedom) -> (World<N>, BodyHandle, JointHandle) {
    let mut world = sleepy(Vector::<N>::ZERO);
    let mut plane = Bivector::ZERO;
    plane.set(0, 1, turn);
    let shape = cuboid(Vector::from_fn(|i| if i == 0 { 0.5 } else { 0.2 }));
    let body = world.add_body(BodyDef::new(shape).rotation(Rotation::exp(&plane))).unwrap();
    let hinge = JointDef::hinge(None, body, Pose::IDENTITY, Pose::IDENTITY, (0, 1)).plane(0, 1, freedom);
    let joint = world.add_joint(hinge).unwrap();
    (world, body, joint)
}

fn angle<const N: usize>(world: &World<N>, body: BodyHandle) -> f64 {
    world.body(body).unwrap().rotation().log().get(0, 1)
}

fn check_slow_motor<const N: usize>() {
    let motor = |speed| Freedom { motor: Some(Motor { speed, max_force: 10.0 }), ..Freedom::FREE };
    let (mut world, body, joint) = hinged::<N>(0.0, motor(0.02));
    run(&mut world, 20.0);
    assert_close("turned", angle(&world, body), 0.4, 0.01);
    // Against its limit it has come to rest.
    let stalled = Freedom { limits: Some((-1.0, 0.5)), ..motor(0.02) };
    let def = world.joint(joint).unwrap().def().clone().plane(0, 1, stalled);
    world.set_joint(joint, def).unwrap();
    run(&mut world, 10.0);
    assert_close("stopped", angle(&world, body), 0.5, 0.01);
    assert!(world.body(body).unwrap().is_sleeping(), "a motor that stands still keeps its body awake in {N}D");
}

/// A flywheel that takes a minute to reach its speed.
fn check_weak_motor<const N: usize>() {
    let (mut world, body, joint) = hinged::<N>(0.0, Freedom::FREE);
    let moment = world.body(body).unwrap().mass() * (0.5 * 0.5 + 0.2 * 0.2) / 3.0;
    let weak = Freedom { motor: Some(Motor { speed: 1.0, max_force: moment / 60.0 }), ..Freedom::FREE };
    let def = world.joint(joint).unwrap().def().clone().plane(0, 1, weak);
    world.set_joint(joint, def).unwrap();
    run(&mut world, 30.0);
    assert_close("speed", world.body(body).unwrap().angular_velocity().get(0, 1), 0.5, 0.01);
}

/// Slow swings across gravity, seen at whatever moment.
fn check_undamped_spring<const N: usize>() {
    for (hz, amplitude) in [(0.1, 0.045), (0.08, 0.07), (0.05, 0.15)] {
        let mut world = sleepy(down::<N>());
        let body = world.add_body(BodyDef::new(ball(0.1)).position(Vector::unit(0) * amplitude)).unwrap();
        let spring = Spring { target: 0.0, hz, damping_ratio: 0.0, max_force: f64::INFINITY };
        let slider = JointDef::slider(None, body, Pose::IDENTITY, Pose::IDENTITY, 0);
        world.add_joint(slider.axis(0, Freedom { spring: Some(spring), ..Freedom::FREE })).unwrap();
        for _ in 0..(40.0 / world.dt()) as usize {
            world.step();
            assert!(!world.body(body).unwrap().is_sleeping(), "{hz} Hz: asleep at {} s in {N}D", world.time());
        }
    }
}

/// A beam hinged a little above its centre comes back to level, however slowly it sets out.
fn check_balance<const N: usize>() {
    for (above, degrees) in [(1e-3, 15.0), (5e-4, 30.0), (2e-3, 8.0)] {
        let mut world = sleepy(down::<N>());
        let turn = Rotation::in_plane(0, 1, f64::to_radians(degrees));
        let shape = cuboid(Vector::from_fn(|i| if i == 0 { 0.5 } else { 0.05 }));
        let hinge = Vector::unit(1) * above;
        let beam = world.add_body(BodyDef::new(shape).position(-turn.rotate(hinge)).rotation(turn)).unwrap();
        let frame = Pose::from_translation(hinge);
        world.add_joint(JointDef::hinge(None, beam, Pose::IDENTITY, frame, (0, 1))).unwrap();
        let mut least = f64::INFINITY;
        for _ in 0..(30.0 / world.dt()) as usize {
            world.step();
            least = least.min(angle(&world, beam));
        }
        assert!(least < 0.0, "{degrees}°, {above} m: comes back to {least} rad only in {N}D");
    }
}

/// What is drawn in without a velocity does not sleep before it is there.
fn check_far_starts<const N: usize>() {
    let limits = Freedom { limits: Some((-0.5, 0.5)), ..Freedom::FREE };
    for turn in [3.0, -3.1] {
        let (mut world, body, _) = hinged::<N>(turn, limits);
        run(&mut world, 4.0);
        assert!(angle(&world, body).abs() < 0.51, "{} rad from {turn} in {N}D", angle(&world, body));
    }
    let joints: [fn(BodyHandle) -> JointDef<N>; 2] = [
        |body| JointDef::ball(None, body, Vector::ZERO, Vector::ZERO),
        |body| JointDef::weld(None, body, Pose::IDENTITY, Pose::IDENTITY),
    ];
    for joint in joints {
        let mut world = sleepy(Vector::<N>::ZERO);
        let body = world.add_body(BodyDef::new(ball(0.2)).position(Vector::unit(0) * 5.0)).unwrap();
        world.add_joint(joint(body)).unwrap();
        run(&mut world, 4.0);
        let left = world.body(body).unwrap().position().norm();
        assert!(left < 0.01, "{left} m from its place in {N}D");
    }
}

/// On ice, on a slope, in space and on an axle: nothing holds it, so nothing stops it.
fn check_slow_ways<const N: usize>() {
    let mut world = sleepy(down::<N>() + Vector::unit(0) * 0.03);
    let ice = Shape::half_space(Vector::unit(1), 0.0).unwrap();
    world.add_body(BodyDef::fixed(ice.clone()).material(material(0.0, 0.0))).unwrap();
    let cube = BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 0.5).material(material(0.0, 0.0));
    let cube = world.add_body(cube).unwrap();
    run(&mut world, 5.0);
    assert_close("on ice", world.body(cube).unwrap().velocity()[0], 0.15, 0.02);

    let slope = 0.2_f64.to_radians();
    let mut world = sleepy(Vector::<N>::unit(0) * (GRAVITY * slope.sin()) - Vector::unit(1) * (GRAVITY * slope.cos()));
    world.add_body(BodyDef::fixed(ice)).unwrap();
    let wheel = world.add_body(BodyDef::new(ball(0.5)).position(Vector::unit(1) * 0.5)).unwrap();
    run(&mut world, 10.0);
    // Down by ½gt² sin α /(1 + I/(m r²)), with I/(m r²) = 2/(n + 2) of a solid ball.
    let rolled = 0.5 * GRAVITY * slope.sin() * 100.0 / (1.0 + 2.0 / (N as f64 + 2.0));
    assert_close("down the slope", world.body(wheel).unwrap().position()[0], rolled, 0.05);

    let mut world = sleepy(Vector::<N>::ZERO);
    let drifter = world.add_body(BodyDef::new(ball(0.5)).velocity(Vector::unit(0) * 0.02)).unwrap();
    run(&mut world, 5.0);
    assert_close("in space", world.body(drifter).unwrap().position()[0], 0.1, 1e-6);
}

fn check_overdamped_spring<const N: usize>() {
    let (hz, damping_ratio) = (1.0, 20.0);
    let spring = Spring { target: 0.0, hz, damping_ratio, max_force: f64::INFINITY };
    let (mut world, body, _) = hinged::<N>(0.5, Freedom { spring: Some(spring), ..Freedom::FREE });
    let slower = 2.0 * PI * hz * (damping_ratio - (damping_ratio * damping_ratio - 1.0).sqrt());
    run(&mut world, 20.0);
    assert_close("left", angle(&world, body), 0.5 * (-slower * 20.0).exp(), 0.05);
    run(&mut world, 40.0);
    assert!(
        angle(&world, body).abs() < 2e-2 && world.body(body).unwrap().is_sleeping(),
        "does not come to rest in {N}D"
    );
}

fn check_cleared_force<const N: usize>() {
    let mut world = sleepy(down::<N>());
    let body = world.add_body(BodyDef::new(ball(0.1)).mass(2.0).position(Vector::unit(1) * 5.0)).unwrap();
    let mut hover = world.body_mut(body).unwrap();
    hover.set_steady_force(Vector::unit(1) * (2.0 * GRAVITY), Bivector::ZERO).unwrap();
    run(&mut world, 2.0);
    assert!((world.body(body).unwrap().position()[1] - 5.0).abs() < 1e-3, "does not hover in {N}D");
    world.body_mut(body).unwrap().clear_forces();
    run(&mut world, 0.5);
    let fallen = 5.0 - world.body(body).unwrap().position()[1];
    assert_close("fallen", fallen, 0.5 * GRAVITY * 0.25, 0.05);
}

/// A turntable that a hand once set going hardly moves; what stands on its arm is carried along.
#[test]
fn what_a_kinematic_body_carries_by_a_joint_goes_on() {
    let mut world = sleepy(Vector::<4>::ZERO);
    let def = BodyDef::new(ball(0.2)).kind(BodyKind::Kinematic).velocity(Vector::unit(3) * 0.01);
    let base = world.add_body(def).unwrap();
    let rider = world.add_body(BodyDef::new(ball(0.2)).position(Vector::unit(0))).unwrap();
    world.add_joint(JointDef::weld(base, rider, Pose::from_translation(Vector::unit(0)), Pose::IDENTITY)).unwrap();
    run(&mut world, 20.0);
    assert_close("carried", world.body(rider).unwrap().position()[3], 0.2, 0.01);
}

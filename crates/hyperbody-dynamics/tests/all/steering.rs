//! Kinematic bodies led from pose to pose, conveyors, and forces that go on.

use super::common::{add_floor, assert_close, ball, cuboid, down, material, run, world};
use hyperbody_dynamics::{BodyDef, BodyKind, JointDef, World, WorldDef, WorldErrorKind};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

/// A plate led along a circle and turned carries a box by friction, is at each pose exactly, and rests when it is left alone.
fn led<const N: usize>() {
    let mut world = world(down::<N>());
    let half = Vector::<N>::from_fn(|i| if i == 1 { 0.1 } else { 2.0 });
    let rough = material(1.0, 0.0);
    let plate = world.add_body(BodyDef::new(cuboid(half)).kind(BodyKind::Kinematic).material(rough)).unwrap();
    let load = BodyDef::new(cuboid(Vector::splat(0.3))).position(Vector::unit(1) * 0.4).material(rough);
    let load = world.add_body(load).unwrap();
    run(&mut world, 0.5);
    for step in 1..=120 {
        let t = f64::from(step) / 120.0;
        let x = 1.0 - (std::f64::consts::PI * t).cos();
        let turn = if N > 2 { Rotation::in_plane(0, 2, 0.5 * t) } else { Rotation::IDENTITY };
        let pose = Pose::new(turn, Vector::unit(0) * x);
        world.move_kinematic(plate, pose).unwrap();
        world.step();
        let reached = world.body(plate).unwrap().pose();
        assert_eq!(reached, pose, "the plate is where it was led");
    }
    let load_x = world.body(load).unwrap().position()[0];
    assert!((load_x - 2.0).abs() < 0.02, "the load was carried to {load_x} m, not 2 m");
    world.step();
    assert_eq!(world.body(plate).unwrap().velocity(), Vector::ZERO, "it rests when it is not led on");
    assert_eq!(world.body(plate).unwrap().position(), Vector::unit(0) * 2.0);
    let far = Pose::from_translation(Vector::unit(0) * 1e4);
    assert_eq!(world.move_kinematic(plate, far).unwrap_err().kind(), WorldErrorKind::BadNumber);
    assert_eq!(world.move_kinematic(load, far).unwrap_err().kind(), WorldErrorKind::NotAllowed);
}

#[test]
fn kinematic_bodies_are_led_from_pose_to_pose() {
    led::<2>();
    led::<3>();
    led::<4>();
}

/// On a conveyor a box slides at μ g until it has the conveyor's speed; the sleeping one beside it is left alone.
fn conveyor<const N: usize>() {
    let mut world = World::<N>::new(WorldDef::default()).unwrap();
    add_floor(&mut world, material(0.25, 0.0));
    let belt = cuboid(Vector::from_fn(|i| if i == 1 { 0.5 } else { 20.0 }));
    let surface = Vector::unit(0) * 2.0 + if N > 2 { Vector::unit(2) * 1.5 } else { Vector::ZERO };
    let belt = BodyDef::fixed(belt).position(Vector::unit(1) * 0.5).material(material(0.25, 0.0));
    let belt = world.add_body(belt.surface_velocity(surface)).unwrap();
    let load = BodyDef::new(cuboid(Vector::splat(0.2))).position(Vector::unit(1) * 1.2).material(material(0.25, 0.0));
    let load = world.add_body(load).unwrap();
    run(&mut world, 0.5);
    let speed = world.body(load).unwrap().velocity().norm();
    assert_close(&format!("{N}D speed while it slips"), speed, 0.25 * 9.81 * 0.5, 0.02);
    run(&mut world, 2.0);
    let velocity = world.body(load).unwrap().velocity();
    assert!((velocity - surface).norm() < 1e-3, "{N}D: carried at {velocity:?}");
    world.body_mut(belt).unwrap().set_surface_velocity(Vector::ZERO).unwrap();
    run(&mut world, 2.0);
    assert!(world.body(load).unwrap().is_sleeping());
    world.body_mut(belt).unwrap().set_surface_velocity(surface).unwrap();
    run(&mut world, 2.0);
    assert!((world.body(load).unwrap().velocity() - surface).norm() < 1e-3, "the belt that starts wakes its load");
}

#[test]
fn conveyors_carry() {
    conveyor::<2>();
    conveyor::<3>();
    conveyor::<4>();
    conveyor::<5>();
}

/// A steady force against gravity holds a body; a steady torque speeds it up at τ/I.
fn steady<const N: usize>() {
    let mut world = world(down::<N>());
    let body = world.add_body(BodyDef::new(ball(0.5)).mass(2.0).position(Vector::unit(1))).unwrap();
    let (force, torque) = (Vector::unit(1) * (2.0 * 9.81), Bivector::plane(0, 1, 0.3));
    world.body_mut(body).unwrap().set_steady_force(force, torque).unwrap();
    run(&mut world, 2.0);
    let now = world.body(body).unwrap();
    assert!((now.position() - Vector::unit(1)).norm() < 1e-9);
    let moment = 2.0 * 2.0 * 0.25 / (N as f64 + 2.0);
    assert_close("rate after two seconds", now.angular_velocity().get(0, 1), 0.3 * 2.0 / moment, 1e-5);
    world.body_mut(body).unwrap().set_steady_force(Vector::ZERO, Bivector::ZERO).unwrap();
    run(&mut world, 1.0);
    assert_close("speed of its fall", -world.body(body).unwrap().velocity()[1], 9.81, 1e-9);
}

#[test]
fn steady_forces_go_on() {
    steady::<2>();
    steady::<3>();
    steady::<6>();
}

/// Who is led and then given a velocity, or put elsewhere, does that and no longer what it was led to.
#[test]
fn a_new_wish_ends_being_led() {
    let mut world = world(Vector::<4>::ZERO);
    let body = world.add_body(BodyDef::new(ball(0.5)).kind(BodyKind::Kinematic)).unwrap();
    world.move_kinematic(body, Pose::from_translation(Vector::unit(0) * 0.1)).unwrap();
    world.step();
    world.body_mut(body).unwrap().set_velocity(Vector::unit(1)).unwrap();
    world.step();
    let place = world.body(body).unwrap().position();
    assert!((place - Vector([0.1, world.dt(), 0.0, 0.0])).norm() < 1e-12, "it moves on at its own velocity: {place:?}");
    world.move_kinematic(body, Pose::from_translation(Vector::unit(0) * 0.2)).unwrap();
    world.body_mut(body).unwrap().set_pose(Pose::from_translation(Vector::unit(3) * 5.0)).unwrap();
    world.step();
    assert_eq!(world.body(body).unwrap().position(), Vector::unit(3) * 5.0, "it stays where it was put");
    assert_eq!(world.body(body).unwrap().velocity(), Vector::ZERO);
}

/// However slow: a thruster in empty space, a belt below the speed at which bodies fall asleep.
#[test]
fn what_is_pushed_or_carried_slowly_does_not_fall_asleep() {
    let mut space = World::<4>::new(WorldDef { gravity: Vector::ZERO, ..WorldDef::default() }).unwrap();
    let ship = space.add_body(BodyDef::new(ball(0.5)).mass(1.0)).unwrap();
    space.body_mut(ship).unwrap().set_steady_force(Vector::unit(0) * 0.01, Bivector::ZERO).unwrap();
    run(&mut space, 4.0);
    assert_close("way of the ship", space.body(ship).unwrap().position()[0], 0.5 * 0.01 * 16.0, 0.01);

    let mut world = World::<3>::new(WorldDef::default()).unwrap();
    let belt = BodyDef::fixed(cuboid(Vector([5.0, 0.5, 5.0]))).surface_velocity(Vector::unit(0) * 0.03);
    world.add_body(belt).unwrap();
    let load = world.add_body(BodyDef::new(cuboid(Vector::splat(0.2))).position(Vector::unit(1) * 0.7)).unwrap();
    run(&mut world, 4.0);
    let way = world.body(load).unwrap().position()[0];
    assert!((way - 0.12).abs() < 0.01, "the belt carried its load by {way} m");
}

/// Pressed against a wall and asleep; in the step in which something wakes it, it presses as before.
fn pressed_on<const N: usize>() {
    let mut space = World::<N>::new(WorldDef { gravity: Vector::ZERO, ..WorldDef::default() }).unwrap();
    let smooth = material(0.0, 0.0);
    let wall = BodyDef::fixed(Shape::half_space(Vector::unit(0), 0.0).unwrap()).material(smooth);
    let wall = space.add_body(wall).unwrap();
    let def = BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(0) * 0.5).mass(1.0).material(smooth);
    let body = space.add_body(def).unwrap();
    space.body_mut(body).unwrap().set_steady_force(Vector::unit(0) * -6.0, Bivector::ZERO).unwrap();
    run(&mut space, 2.0);
    assert!(space.body(body).unwrap().is_sleeping());
    let above = Vector::unit(0) * 0.5 + Vector::unit(1) * 1.5;
    let shot = BodyDef::new(ball(0.2)).position(above).velocity(Vector::unit(1) * -3.0).mass(0.1).material(smooth);
    space.add_body(shot).unwrap();
    for _ in 0..60 {
        space.step();
        if space.events().woken().contains(&body) {
            let events = space.events().contacts();
            let pressed = events.iter().find(|event| event.bodies == (wall, body)).map_or(0.0, |event| event.impulse);
            assert_close("impulse on the wall in the step of waking", pressed, 6.0 * space.dt(), 0.05);
            return;
        }
    }
    panic!("nothing woke the body");
}

#[test]
fn a_steady_force_does_not_miss_the_step_of_waking() {
    pressed_on::<2>();
    pressed_on::<4>();
}

/// In weak gravity, on a rope that is still slack: it goes on falling.
#[test]
fn a_slack_rope_is_no_support() {
    let gravity = Vector::unit(1) * -0.01;
    let mut world = World::<3>::new(WorldDef { gravity, ..WorldDef::default() }).unwrap();
    let load = world.add_body(BodyDef::new(ball(0.1)).position(Vector::unit(0) * 0.1)).unwrap();
    world.add_joint(JointDef::rope(None, load, Vector::ZERO, Vector::ZERO, 1.0)).unwrap();
    run(&mut world, 3.0);
    assert_close("way fallen", -world.body(load).unwrap().position()[1], 0.5 * 0.01 * 9.0, 0.02);
}

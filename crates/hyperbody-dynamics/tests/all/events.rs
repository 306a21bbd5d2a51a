//! Touches with their impulses, sleep, waking and breaking, against what mechanics says must have happened.

use crate::common::{add_floor, ball, cuboid, down, material, run, world};
use hyperbody_dynamics::{BodyDef, ContactPhase, JointDef, World, WorldDef};
use hyperbody_math::{Pose, Vector};

/// A ball that falls on the floor: one beginning with m(1 + e)v as its impulse, an end, and so on; at rest it stays, pressing
/// m g dt a step.
fn begins_stays_and_ends<const N: usize>() {
    let mut world = world(down::<N>());
    let floor = add_floor(&mut world, material(0.5, 0.5));
    let dropped = BodyDef::new(ball(0.5)).mass(2.0).position(Vector::unit(1) * 2.0).material(material(0.5, 0.5));
    let dropped = world.add_body(dropped).unwrap();
    let (mut begins, mut ends, mut first) = (0, 0, 0.0);
    let mut touching = false;
    for _ in 0..600 {
        world.step();
        for event in world.events().contacts() {
            assert_eq!(event.bodies, (floor, dropped));
            match event.phase {
                ContactPhase::Begin => {
                    assert!(!touching, "began twice");
                    touching = true;
                    begins += 1;
                    if begins == 1 {
                        first = event.impulse;
                        assert!((event.normal - Vector::unit(1)).norm() < 1e-9);
                        assert!((event.point - Vector::ZERO).norm() < 0.1);
                    }
                }
                ContactPhase::Stay => assert!(touching, "stayed without a beginning"),
                ContactPhase::End => {
                    assert!(touching, "ended without a beginning");
                    touching = false;
                    ends += 1;
                }
            }
        }
    }
    let fall = (2.0_f64 * 9.81 * 1.5).sqrt();
    assert!((first / (2.0 * 1.5 * fall) - 1.0).abs() < 0.05, "struck with {first} N·s");
    assert!(begins >= 3 && begins == ends + 1, "{begins} beginnings, {ends} ends");
    let last = world.events().contacts()[0];
    assert_eq!(last.phase, ContactPhase::Stay);
    assert!((last.impulse - 2.0 * 9.81 / 60.0).abs() < 1e-3, "presses with {} N·s a step", last.impulse);
    world.remove_body(floor).unwrap();
    world.step();
    assert_eq!(world.events().contacts()[0].phase, ContactPhase::End);
    world.step();
    assert!(world.events().contacts().is_empty());
}

#[test]
fn touches_begin_stay_and_end() {
    begins_stays_and_ends::<2>();
    begins_stays_and_ends::<3>();
    begins_stays_and_ends::<4>();
    begins_stays_and_ends::<6>();
}

/// Sleepers keep their touch without a word; waking is told once for each body that it reaches and for no other.
#[test]
fn sleep_and_waking_are_told_once() {
    let mut world = World::<4>::new(WorldDef::default()).unwrap();
    add_floor(&mut world, material(0.5, 0.0));
    let mut cube = |x: f64, y: f64| {
        world
            .add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::<4>::unit(0) * x + Vector::unit(1) * y))
            .unwrap()
    };
    let (below, above, apart) = (cube(0.0, 0.5), cube(0.0, 1.5), cube(5.0, 0.5));
    let (mut slept, mut woken) = (Vec::new(), Vec::new());
    for _ in 0..240 {
        world.step();
        slept.extend_from_slice(world.events().slept());
        woken.extend_from_slice(world.events().woken());
    }
    slept.sort_unstable();
    assert_eq!(slept, [below, above, apart]);
    assert!(woken.is_empty());
    assert!(world.events().contacts().is_empty(), "sleepers say nothing");
    world.body_mut(above).unwrap().apply_impulse(Vector::unit(0) * 0.1).unwrap();
    world.step();
    assert_eq!(world.events().woken(), [below, above]);
    assert!(world.body(apart).unwrap().is_sleeping());
    let phases: Vec<_> = world.events().contacts().iter().map(|event| event.phase).collect();
    assert_eq!(phases, [ContactPhase::Stay, ContactPhase::Stay], "the touches went on through the sleep");
}

/// A rope with a load of m g breaks when it is weaker than that, once, and the load falls.
fn breaks<const N: usize>() {
    for (strength, holds) in [(2.1, true), (1.9, false)] {
        let mut world = world(down::<N>());
        let load = world.add_body(BodyDef::new(ball(0.2)).mass(2.0).position(Vector::unit(1) * -1.0)).unwrap();
        let def = JointDef::distance(None, load, Vector::ZERO, Vector::ZERO, 1.0);
        let joint = world.add_joint(def.break_at(strength * 9.81, f64::INFINITY)).unwrap();
        let mut broken = 0;
        for _ in 0..60 {
            world.step();
            for event in world.events().broken_joints() {
                assert_eq!((event.joint, event.bodies), (joint, (None, load)));
                assert!((event.force - Vector::unit(1) * (2.0 * 9.81)).norm() < 0.05, "broke at {:?}", event.force);
                broken += 1;
            }
        }
        assert_eq!(broken, usize::from(!holds));
        assert_eq!(world.joint(joint).is_some(), holds);
        let fallen = -1.0 - world.body(load).unwrap().position()[1];
        assert!(if holds { fallen.abs() < 1e-3 } else { fallen > 4.0 }, "fell {fallen} m");
    }
}

#[test]
fn joints_break_when_they_are_overloaded() {
    breaks::<2>();
    breaks::<3>();
    breaks::<5>();
}

/// The order of events depends on the bodies alone: a pile tells the same with one thread and two.
#[test]
fn events_are_the_same_for_every_number_of_threads() {
    let tell = |threads| {
        let mut world = World::<3>::new(WorldDef { threads, ..WorldDef::default() }).unwrap();
        add_floor(&mut world, material(0.5, 0.2));
        let mut random = crate::common::Random(11);
        for index in 0..40 {
            let position = Vector::unit(1) * (1.0 + 0.6 * f64::from(index)) + random.vector::<3>(0.4);
            let pose = Pose::new(random.rotation(1.0), position);
            let body = BodyDef::new(cuboid(Vector::splat(0.3))).position(pose.translation).rotation(pose.rotation);
            world.add_body(body).unwrap();
        }
        let mut told = Vec::new();
        for _ in 0..240 {
            world.step();
            told.push(world.events().contacts().to_vec());
        }
        told
    };
    assert_eq!(tell(1), tell(2));
}

#[test]
fn a_joint_reports_the_weight_that_hangs_on_it() {
    let mut world = world(down::<4>());
    let beam = world
        .add_body(BodyDef::new(cuboid(Vector([1.0, 0.1, 0.1, 0.1]))).mass(3.0).position([1.0, 0.0, 0.0, 0.0]))
        .unwrap();
    let frame = Pose::from_translation(Vector([-1.0, 0.0, 0.0, 0.0]));
    let weld = world.add_joint(JointDef::weld(None, beam, Pose::IDENTITY, frame)).unwrap();
    run(&mut world, 1.0);
    let joint = world.joint(weld).unwrap();
    assert!((joint.force() - Vector::unit(1) * (3.0 * 9.81)).norm() < 1e-3, "{:?}", joint.force());
    // The weight acts a metre out: the weld turns against it, from y towards x being negative in plane xy.
    let torque = joint.torque();
    assert!((torque.get(0, 1) - 3.0 * 9.81).abs() < 1e-2, "{torque:?}");
}

/// A body in the slot of one that slept was never woken.
#[test]
fn nobody_wakes_in_the_place_of_a_removed_sleeper() {
    let mut world = World::<3>::new(WorldDef::default()).unwrap();
    add_floor(&mut world, material(0.5, 0.0));
    let sleeper = world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 0.5)).unwrap();
    run(&mut world, 2.0);
    assert!(world.body(sleeper).unwrap().is_sleeping());
    world.remove_body(sleeper).unwrap();
    let next = world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 3.0)).unwrap();
    world.step();
    assert!(!world.events().woken().contains(&next), "it never slept");
}

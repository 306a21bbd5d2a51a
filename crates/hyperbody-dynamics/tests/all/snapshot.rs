//! Snapshots: from the same state the same future, to the bit, whatever was done in between.

use crate::common::{Random, add_floor, ball, cuboid, material};
use hyperbody_dynamics::{BodyDef, JointDef, World, WorldDef};
use hyperbody_math::Vector;

/// A heap with a chain, some of it asleep.
fn busy_world<const N: usize>(threads: usize) -> World<N> {
    let mut world = World::<N>::new(WorldDef { threads, ..WorldDef::default() }).unwrap();
    add_floor(&mut world, material(0.5, 0.3));
    let mut random = Random(5);
    for index in 0..24 {
        let shape = if index % 2 == 0 { cuboid(Vector::splat(0.3)) } else { ball(0.3) };
        let position = Vector::unit(1) * (0.7 + 0.5 * f64::from(index)) + random.vector::<N>(0.5);
        world.add_body(BodyDef::new(shape).position(position).rotation(random.rotation(0.8))).unwrap();
    }
    let mut last = None;
    for link in 0..5 {
        let x = 3.0 + 0.5 * f64::from(link);
        let body = BodyDef::new(cuboid(Vector::from_fn(|i| if i == 0 { 0.25 } else { 0.1 })));
        let body = world.add_body(body.position(Vector::unit(0) * x + Vector::unit(1) * 4.0)).unwrap();
        let anchor = Vector::unit(0) * -0.25;
        let from = if last.is_some() { -anchor } else { Vector::unit(0) * 2.75 + Vector::unit(1) * 4.0 };
        world.add_joint(JointDef::ball(last, body, from, anchor)).unwrap();
        last = Some(body);
    }
    world
}

fn hashes<const N: usize>(world: &mut World<N>, steps: usize) -> Vec<u64> {
    (0..steps)
        .map(|_| {
            world.step();
            world.state_hash()
        })
        .collect()
}

/// Snapshots at the start, in the fall and at rest; the future again in the same world, after changes, and in a new one.
fn repeats<const N: usize>() {
    let mut world = busy_world::<N>(1);
    for skip in [0, 40, 200] {
        hashes(&mut world, skip);
        let snapshot = world.snapshot();
        let future = hashes(&mut world, 150);
        let events = world.events().contacts().to_vec();

        let bodies: Vec<_> = world.bodies().map(|(handle, _)| handle).collect();
        world.remove_body(bodies[3]).unwrap();
        world.add_body(BodyDef::new(ball(0.2)).position(Vector::unit(1) * 3.0)).unwrap();
        hashes(&mut world, 10);
        world.restore(&snapshot);
        assert!(world.body(bodies[3]).is_some(), "the body is back under its handle");
        assert_eq!(hashes(&mut world, 150), future, "{N}D after {skip} steps");
        assert_eq!(world.events().contacts(), events);

        let mut other = World::<N>::new(WorldDef { threads: 2, ..WorldDef::default() }).unwrap();
        other.restore(&snapshot);
        assert_eq!(hashes(&mut other, 150), future, "{N}D in another world after {skip} steps");
        world.restore(&snapshot);
    }
}

#[test]
fn the_future_repeats_from_a_snapshot() {
    repeats::<2>();
    repeats::<3>();
    repeats::<4>();
}

/// New bodies get the same handles after a restore as they did before.
#[test]
fn handles_repeat() {
    let mut world = busy_world::<3>(1);
    let victim = world.bodies().nth(7).unwrap().0;
    world.remove_body(victim).unwrap();
    let snapshot = world.snapshot();
    let first = world.add_body(BodyDef::new(ball(0.1))).unwrap();
    world.restore(&snapshot);
    assert!(world.body(first).is_none(), "what came after the snapshot is gone");
    assert_eq!(world.add_body(BodyDef::new(ball(0.1))).unwrap(), first);
    assert!(world.body(victim).is_none());
}

//! Stacks stand, piles come to rest, and nothing gains energy. Shorter than the scenes that the comparison runs; the
//! whole lengths are `hyperbody run` on the scenes of the benchmark.

use crate::common::*;
use hyperbody_dynamics::{BodyDef, World, WorldDef};
use hyperbody_geometry::Shape;
use hyperbody_math::Vector;

fn stack<const N: usize>(count: usize, seconds: f64) {
    let mut world = world(down::<N>());
    add_floor(&mut world, material(0.5, 0.0));
    for k in 0..count {
        let position = Vector::unit(1) * (0.5 + k as f64);
        world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(position)).unwrap();
    }
    run(&mut world, seconds);
    for (k, (_, body)) in world.bodies().skip(1).enumerate() {
        let mut aside = body.position();
        aside[1] = 0.0;
        assert!(aside.norm() <= 0.01, "block {k} of {count} moved sideways by {} in {N}D", aside.norm());
    }
    let penetration = world.measure_penetration();
    assert!(penetration <= 0.01, "a stack of {count} in {N}D rests {penetration} m deep");
    assert!(penetration > 0.0, "the stack touches");
}

#[test]
fn stacks_of_ten_stand() {
    stack::<2>(10, 6.0);
    stack::<3>(10, 6.0);
    stack::<4>(10, 6.0);
    stack::<5>(10, 6.0);
    stack::<6>(10, 6.0);
}

#[test]
fn a_stack_of_twenty_tesseracts_stands_for_fifteen_seconds() {
    stack::<4>(20, 15.0);
}

/// A wall is a pyramid in the xy plane, each body put a little beside its place. Where contacts are too stiff for the sweeps its rows
/// swing against each other, more and more.
fn wall<const N: usize>(rows: usize, disorder: f64, seconds: f64) {
    let mut world = World::new(WorldDef { gravity: down::<N>(), sleeping: false, ..WorldDef::default() }).unwrap();
    add_floor(&mut world, material(0.5, 0.0));
    let mut random = Random(12345);
    for row in 0..rows {
        let bodies = rows - row;
        for index in 0..bodies {
            let along = 1.05 * (index as f64 - 0.5 * (bodies - 1) as f64);
            let place = Vector::unit(0) * along + Vector::unit(1) * (0.5 + row as f64);
            let position = place + random.vector(disorder);
            world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(position)).unwrap();
        }
    }
    run(&mut world, seconds);
    let fastest = world.bodies().map(|(_, body)| body.velocity().norm()).fold(0.0, f64::max);
    assert!(fastest < 0.005, "a wall of {rows} rows in {N}D moves at {fastest} m/s after {seconds} s");
}

#[test]
fn walls_do_not_ring() {
    wall::<3>(20, 1e-3, 8.0);
    wall::<4>(20, 1e-3, 8.0);
}

/// A pit with a floor at y = 0 and walls at ±`half_width` on every other axis.
fn pit<const N: usize>(half_width: f64) -> World<N> {
    let mut world = world(down::<N>());
    add_floor(&mut world, material(0.5, 0.0));
    for axis in (0..N).filter(|&axis| axis != 1) {
        for sign in [-1.0, 1.0] {
            let wall = Shape::half_space(Vector::unit(axis) * sign, -half_width).unwrap();
            world.add_body(BodyDef::fixed(wall)).unwrap();
        }
    }
    world
}

fn pile<const N: usize>(layers: usize, across: usize, shape: impl Fn(usize) -> Shape<N>) {
    let spacing = 1.9;
    let half_width = across as f64 * spacing / 2.0 + 0.9;
    let mut world = pit::<N>(half_width);
    let mut random = Random(12345);
    for layer in 0..layers {
        let shift = if layer % 2 == 1 { spacing / 4.0 } else { -spacing / 4.0 };
        for index in 0..across.pow(N as u32 - 1) {
            let mut rest = index;
            let mut position = Vector::<N>::splat(shift) + random.vector(0.05);
            for axis in (0..N).filter(|&axis| axis != 1) {
                position[axis] += ((rest % across) as f64 - (across as f64 - 1.0) / 2.0) * spacing;
                rest /= across;
            }
            position[1] = 1.3 + layer as f64 * spacing;
            let body = BodyDef::new(shape(index)).position(position).rotation(random.rotation(0.35));
            world.add_body(body).unwrap();
        }
    }
    let start = world.energy().total();
    let mut deepest: f64 = 0.0;
    for _ in 0..480 {
        world.step();
        deepest = deepest.max(world.max_penetration());
        let energy = world.energy().total();
        assert!(energy <= start, "energy {energy} above its start {start} in {N}D");
    }
    assert!(deepest <= 0.1, "bodies overlapped by {deepest} in {N}D");
    let at_rest = world.measure_penetration();
    assert!(at_rest <= 0.02, "bodies rest {at_rest} m deep in {N}D");
    assert!(world.energy().kinetic < 0.01 * start, "the pile has not come to rest in {N}D");
    for (_, body) in world.bodies() {
        let position = body.position();
        let inside = (0..N).all(|axis| position[axis].abs() < half_width || axis == 1) && position[1] > -0.02;
        assert!(inside, "a body left the pit in {N}D: {:?}", position.0);
    }
}

#[test]
fn piles_of_boxes_come_to_rest() {
    pile::<2>(4, 6, |_| cuboid(Vector::splat(0.5)));
    pile::<3>(3, 4, |_| cuboid(Vector::splat(0.5)));
    pile::<4>(2, 3, |_| cuboid(Vector::splat(0.5)));
    pile::<5>(1, 2, |_| cuboid(Vector::splat(0.5)));
    pile::<6>(1, 2, |_| cuboid(Vector::splat(0.5)));
}

#[test]
fn piles_of_uneven_shapes_come_to_rest() {
    let shape = |index: usize| match index % 4 {
        0 => ball(0.5),
        1 => Shape::capsule(0.3, 0.4, 0).unwrap(),
        2 => cuboid(Vector::from_fn(|axis| 0.35 + 0.05 * axis as f64)),
        _ => Shape::rounded(cuboid(Vector::splat(0.35)), 0.15).unwrap(),
    };
    pile::<3>(3, 4, |index| match index % 4 {
        0 => ball(0.5),
        1 => Shape::capsule(0.3, 0.4, 0).unwrap(),
        2 => cuboid(Vector::from_fn(|axis| 0.35 + 0.05 * axis as f64)),
        _ => Shape::rounded(cuboid(Vector::splat(0.35)), 0.15).unwrap(),
    });
    pile::<4>(2, 3, shape);
}

/// A settled pile falls asleep, and touching it wakes it.
#[test]
fn a_pile_falls_asleep_and_wakes() {
    let mut world = World::<4>::new(WorldDef::default()).unwrap();
    let floor = Shape::half_space(Vector::unit(1), 0.0).unwrap();
    world.add_body(BodyDef::fixed(floor)).unwrap();
    let tesseract = || BodyDef::new(cuboid(Vector::splat(0.5)));
    let stacked: Vec<_> =
        (0..3).map(|k| world.add_body(tesseract().position(Vector::unit(1) * (0.5 + f64::from(k)))).unwrap()).collect();
    let alone = world.add_body(tesseract().position(Vector::unit(0) * 5.0 + Vector::unit(1) * 0.5)).unwrap();
    run(&mut world, 5.0);
    assert!(world.bodies().skip(1).all(|(_, body)| body.is_sleeping()), "all rest");
    let hash = world.state_hash();
    world.body_mut(stacked[2]).unwrap().apply_impulse(Vector::unit(0) * 0.5).unwrap();
    world.step();
    assert!(stacked.iter().all(|&body| !world.body(body).unwrap().is_sleeping()), "the whole stack wakes");
    assert!(world.body(alone).unwrap().is_sleeping(), "what it does not touch sleeps on");
    assert_ne!(world.state_hash(), hash);
    // What a sleeper rests on is taken away: it must not hang in the air.
    run(&mut world, 5.0);
    world.remove_body(stacked[0]).unwrap();
    run(&mut world, 1.0);
    assert!(world.body(stacked[1]).unwrap().position()[1] < 1.0, "the rest of the stack falls");
    assert!(world.remove_body(stacked[0]).is_err(), "a stale handle is refused");
}

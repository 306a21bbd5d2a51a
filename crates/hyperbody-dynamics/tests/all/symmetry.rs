//! What must not depend on the frame or the dimension: a scene of fewer dimensions placed in more moves as before, a
//! turned scene moves turned, momentum is kept, a free body tumbles by the law, and threads change nothing.

use crate::common::*;
use hyperbody_dynamics::{BodyDef, BodyHandle, BodyKind, JointDef, World, WorldDef};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Rotation, Vector};

fn embed<const D: usize, const N: usize>(v: Vector<D>) -> Vector<N> {
    Vector::from_fn(|i| if i < D { v[i] } else { 0.0 })
}

/// In space, and placed in `N` dimensions: a box that slides and pushes another, one that lands on an edge and tumbles,
/// a pendulum, and a box that flies tumbling in all planes of space.
fn scene<const N: usize>() -> (World<N>, Vec<BodyHandle>) {
    let def = WorldDef { gravity: down(), sleeping: false, dt: 1.0 / 240.0, ..WorldDef::default() };
    let mut world = World::<N>::new(def).unwrap();
    add_floor(&mut world, material(0.4, 0.0));
    // Moments of planes of space depend on the first three extents and the mass alone.
    let shape = |x: f64, y: f64, z: f64| cuboid(Vector::from_fn(|axis| [x, y, z, 0.5, 0.5, 0.5][axis]));
    let place = |x: f64, y: f64, z: f64| embed::<3, N>(Vector([x, y, z]));
    let mut add = |def: BodyDef<N>| world.add_body(def.mass(2.0).material(material(0.4, 0.0))).unwrap();
    let sliding = add(BodyDef::new(shape(0.5, 0.3, 0.4)).position(place(0.0, 0.3, 0.0)).velocity(place(4.0, 0.0, 0.0)));
    let pushed = add(BodyDef::new(shape(0.3, 0.4, 0.4)).position(place(1.2, 0.4, 0.0)));
    let landing = BodyDef::new(shape(0.5, 0.4, 0.3)).position(place(0.0, 1.2, 5.0)).velocity(place(1.0, 0.0, 0.0));
    let landing = add(landing.rotation(Rotation::in_plane(0, 1, 0.3)));
    let flying = BodyDef::new(shape(0.5, 0.4, 0.3)).position(place(0.0, 3.0, -5.0)).velocity(place(1.0, 12.0, 0.0));
    let mut spin = Bivector::plane(0, 1, 2.0);
    spin.set(1, 2, 1.0);
    let flying = add(flying.angular_velocity(spin));
    let bob = add(BodyDef::new(shape(0.2, 0.3, 0.1)).position(place(-5.0 + 0.8, 3.0, 0.0)));
    let pivot = world.add_body(BodyDef::fixed(ball(0.1)).position(place(-5.0, 3.0, 0.0))).unwrap();
    let anchor_b = place(-0.8, 0.0, 0.0);
    world.add_joint(JointDef::ball(pivot, bob, Vector::ZERO, anchor_b)).unwrap();
    (world, vec![sliding, pushed, landing, flying, bob])
}

fn embedded<const N: usize>() {
    let (mut space, in_space) = scene::<3>();
    let (mut world, in_world) = scene::<N>();
    let mut most = vec![0.0_f64; in_space.len()];
    for _ in 0..480 {
        space.step();
        world.step();
        for ((&a, &b), most) in in_space.iter().zip(&in_world).zip(&mut most) {
            let (a, b) = (space.body(a).unwrap(), world.body(b).unwrap());
            let apart = (embed::<3, N>(a.position()) - b.position()).norm();
            *most = most.max(apart);
        }
    }
    println!("{N}D departs from 3D by {most:?} m");
    // Free flight and the pendulum are the same to rounding; contacts, to that of their rows in single precision. A box that
    // slides for two seconds against a deceleration of 4 m/s² goes ½·4·2²·ε astray for each rounding ε = 1.2e-7 by which
    // friction differs all the time; twenty of them, for sums of thirty terms in another order. Edges that come down make
    // that larger: the box that is pushed is lifted by the friction of the push, hops, and lands on one.
    let allowed = [2e-5, 1e-4, 1e-4, 1e-9, 1e-9];
    let same = most.iter().zip(allowed).all(|(&apart, limit)| apart <= limit);
    assert!(same, "{N}D departs from 3D by {most:?} m within two seconds, allowed {allowed:?}");
}

#[test]
fn a_scene_of_space_moves_the_same_inside_more_dimensions() {
    embedded::<4>();
    embedded::<5>();
    embedded::<6>();
}

/// Balls and their contacts have the same points in every dimension, so the motion agrees to single precision.
fn embedded_balls<const N: usize>() {
    fn balls<const N: usize>() -> World<N> {
        let mut world = world(down::<N>());
        add_floor(&mut world, material(0.4, 0.3));
        for k in 0..4 {
            let position = embed::<3, N>(Vector([0.6 * f64::from(k), 1.0 + 0.8 * f64::from(k), 0.1 * f64::from(k)]));
            // The moments of a ball depend on n; a box of the same plane moments in every n does not roll, so the
            // balls are smooth and their spin is left out.
            let body = BodyDef::new(ball(0.5)).position(position).mass(1.0).material(material(0.0, 0.3));
            world.add_body(body.velocity(embed::<3, N>(Vector([-0.5, 0.0, 0.2])))).unwrap();
        }
        world
    }
    let (mut space, mut world) = (balls::<3>(), balls::<N>());
    for _ in 0..120 {
        space.step();
        world.step();
    }
    for ((_, a), (_, b)) in space.bodies().zip(world.bodies()) {
        let apart = (embed::<3, N>(a.position()) - b.position()).norm();
        assert!(apart < 1e-5, "{N}D departs from 3D by {apart} m");
    }
}

#[test]
fn smooth_balls_move_the_same_inside_more_dimensions() {
    embedded_balls::<4>();
    embedded_balls::<5>();
    embedded_balls::<6>();
}

/// A scene turned by any rotation moves turned.
fn turned<const N: usize>() {
    fn build<const N: usize>(turn: Rotation<N>) -> (World<N>, BodyHandle) {
        let mut world = world(turn.rotate(down::<N>()));
        let floor = Shape::half_space(turn.rotate(Vector::unit(1)), 0.0).unwrap();
        world.add_body(BodyDef::fixed(floor).material(material(0.3, 0.0))).unwrap();
        let position = Vector::unit(1) * 0.5;
        let body = BodyDef::new(ball(0.5))
            .position(turn.rotate(position))
            .velocity(turn.rotate(Vector::unit(0) * 3.0))
            .angular_velocity(turn.rotate_bivector(&Bivector::plane(0, 1, 2.0)));
        let rolling = world.add_body(body).unwrap();
        let mut random = Random(9);
        let rotation = random.rotation::<N>(0.5);
        let falling = BodyDef::new(cuboid(Vector::from_fn(|axis| 0.3 + 0.1 * axis as f64)))
            .position(turn.rotate(Vector::unit(1) * 2.0 - Vector::unit(0) * 4.0))
            .rotation(turn * rotation);
        world.add_body(falling).unwrap();
        (world, rolling)
    }
    let turn = Random(21).rotation::<N>(2.0);
    let (mut plain, _) = build::<N>(Rotation::IDENTITY);
    let (mut other, _) = build::<N>(turn);
    let mut most: f64 = 0.0;
    for step in 0..60 {
        plain.step();
        other.step();
        for ((_, a), (_, b)) in plain.bodies().zip(other.bodies()).skip(1) {
            let apart = (turn.rotate(a.position()) - b.position()).norm();
            most = most.max(apart);
            assert!(apart < 1e-4, "the turned scene departs by {apart} m at step {step} in {N}D");
        }
    }
    println!("turned, {N}D departs by {most} m");
}

#[test]
fn a_turned_scene_moves_turned() {
    turned::<2>();
    turned::<3>();
    turned::<4>();
    turned::<5>();
    turned::<6>();
}

/// Momentum is kept to rounding of the rows when only the bodies act on each other.
fn momentum_is_kept<const N: usize>() {
    let mut world = world(Vector::<N>::ZERO);
    let mut random = Random(2);
    for k in 0..12 {
        let position = random.vector::<N>(1.0) + Vector::unit(0) * (1.5 * f64::from(k % 4) - 2.0);
        let body = BodyDef::new(cuboid(Vector::splat(0.3))).position(position).velocity(random.vector::<N>(2.0));
        world.add_body(body).unwrap();
    }
    let before = world.momentum();
    let scale: f64 = world.bodies().map(|(_, body)| body.mass() * body.velocity().norm()).sum();
    run(&mut world, 2.0);
    let drift = (world.momentum() - before).norm();
    assert!(drift < 2e-6 * scale, "momentum drifted by {drift} of {scale} in {N}D");
    assert!(world.quarantined().is_empty());
}

#[test]
fn momentum_is_kept_in_collisions() {
    momentum_is_kept::<2>();
    momentum_is_kept::<3>();
    momentum_is_kept::<4>();
    momentum_is_kept::<5>();
    momentum_is_kept::<6>();
}

/// A box of half-extents 0.3 × 0.5 × 0.7 × 1.0 spins freely at 8 rad/s for a minute: momentum to 1e-10, energy to 1e-3, and
/// the spin wanders between planes.
#[test]
fn a_free_tesseractoid_tumbles_by_the_law() {
    let mut world = world(Vector::<4>::ZERO);
    // Near a plane between the stablest, so that it must tumble.
    let mut spin = Bivector::plane(0, 2, 7.9);
    spin.set(0, 1, 0.9);
    spin.set(1, 3, 0.7);
    spin.set(2, 3, 0.5);
    let spin = spin * (8.0 / spin.norm());
    let body = BodyDef::new(cuboid(Vector([0.3, 0.5, 0.7, 1.0]))).angular_velocity(spin);
    let body = world.add_body(body).unwrap();
    let energy = world.energy().kinetic;
    let momentum = world.body(body).unwrap().angular_momentum();
    let mut drift_of_energy: f64 = 0.0;
    let mut in_body_plane = Vec::new();
    for _ in 0..3600 {
        world.step();
        drift_of_energy = drift_of_energy.max((world.energy().kinetic / energy - 1.0).abs());
        let body = world.body(body).unwrap();
        in_body_plane.push(body.rotation().inverse_rotate_bivector(&body.angular_velocity()).get(0, 2));
    }
    let drift = (world.body(body).unwrap().angular_momentum() - momentum).norm() / momentum.norm();
    println!("angular momentum drift {drift:e}, energy drift {drift_of_energy:e}");
    assert!(drift <= 1e-10, "angular momentum drifted by {drift}");
    assert!(drift_of_energy <= 1e-3, "energy drifted by {drift_of_energy}");
    let (low, high) = in_body_plane.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &w| (l.min(w), h.max(w)));
    assert!(high - low > 4.0, "the spin stays in one plane of the body: {low}..{high}");
}

/// The same bits whatever the number of threads, and again when run again.
#[test]
fn threads_do_not_change_a_bit() {
    fn hash(threads: usize) -> Vec<u64> {
        let mut world = World::<4>::new(WorldDef { threads, ..WorldDef::default() }).unwrap();
        add_floor(&mut world, material(0.5, 0.2));
        let mut random = Random(77);
        for k in 0..60 {
            let position = random.vector::<4>(1.2) + Vector::unit(1) * (2.0 + 0.3 * f64::from(k));
            let shape = match k % 3 {
                0 => cuboid(Vector([0.3, 0.4, 0.3, 0.5])),
                1 => ball(0.4),
                _ => Shape::capsule(0.3, 0.3, 3).unwrap(),
            };
            world.add_body(BodyDef::new(shape).position(position).rotation(random.rotation(1.0))).unwrap();
        }
        (0..8)
            .map(|_| {
                run(&mut world, 0.5);
                world.state_hash()
            })
            .collect()
    }
    let one = hash(1);
    assert_eq!(one, hash(1), "a repeated run");
    assert_eq!(one, hash(2), "two threads");
    assert_eq!(one, hash(5), "five threads");
}

/// So many contacts that each colour of them is shared among the threads.
#[test]
fn threads_do_not_change_a_bit_of_a_large_pile() {
    fn hash<const N: usize>(threads: usize, across: u32, layers: u32) -> Vec<u64> {
        let mut world = World::<N>::new(WorldDef { threads, ..WorldDef::default() }).unwrap();
        add_floor(&mut world, material(0.5, 0.2));
        for k in 0..across.pow(N as u32 - 1) * layers {
            let mut rest = k;
            let mut position = Vector::ZERO;
            for axis in (0..N).filter(|&axis| axis != 1) {
                position[axis] = f64::from(rest % across) * 1.01 + 0.1 * f64::from(k % 3);
                rest /= across;
            }
            position[1] = 0.5 + f64::from(rest);
            let shape = if k % 2 == 0 { ball(0.5) } else { cuboid(Vector::splat(0.5)) };
            world.add_body(BodyDef::new(shape).position(position)).unwrap();
        }
        (0..4)
            .map(|_| {
                run(&mut world, 0.1);
                world.state_hash()
            })
            .collect()
    }
    let one = (hash::<2>(1, 60, 20), hash::<3>(1, 12, 8));
    for threads in [2, 3] {
        assert_eq!(one.0, hash::<2>(threads, 60, 20), "{threads} threads, 2D");
        assert_eq!(one.1, hash::<3>(threads, 12, 8), "{threads} threads, 3D");
    }
}

/// A brick wall of so many bodies that the solver divides them into four parts, of several kinds, on a belt, with joints and gaps
/// across the cuts, something that is led through it and a sensor.
fn divided_world(threads: usize) -> (World<3>, Vec<BodyHandle>) {
    let mut world = World::<3>::new(WorldDef { threads, ..WorldDef::default() }).unwrap();
    let belt = BodyDef::fixed(Shape::half_space(Vector::unit(1), 0.0).unwrap());
    world.add_body(belt.surface_velocity(Vector([0.5, 0.0, 0.2])).material(material(0.5, 0.2))).unwrap();
    let mut bodies = Vec::new();
    for k in 0..6200_u32 {
        let (layer, column) = (k / 310, k % 310);
        let position = Vector([f64::from(column) * 1.01, 0.5 + f64::from(layer), 0.3 * f64::from(k % 3)]);
        let shape = match k % 4 {
            0 => ball(0.5),
            1 => cuboid(Vector([0.5, 0.5, 0.8])),
            _ => cuboid(Vector::splat(0.5)),
        };
        let def = BodyDef::new(shape).position(position).linear_damping(f64::from(k % 5) * 0.1);
        bodies.push(world.add_body(def).unwrap());
    }
    for k in (0..6000).step_by(500) {
        let (a, b) = (bodies[k], bodies[(k * 7 + 1700) % 6200]);
        world.add_joint(JointDef::rope(a, b, Vector::ZERO, Vector::ZERO, 50.0)).unwrap();
    }
    let led = BodyDef::new(cuboid(Vector::splat(0.5))).kind(BodyKind::Kinematic).position(Vector([100.0, 8.0, -2.0]));
    world.add_body(led.velocity(Vector([0.0, 0.0, 6.0]))).unwrap();
    world.add_body(BodyDef::fixed(ball(3.0)).position(Vector([50.0, 5.0, 0.0])).sensor(true)).unwrap();
    bodies.iter().skip(5).step_by(41).for_each(|&body| world.remove_body(body).unwrap());
    (world, bodies)
}

/// Threads solve the parts of a large world at the same time, to the same bits, also where one part loses all that moves and slots are
/// given out again; and a snapshot of it goes on as it did.
#[test]
fn threads_do_not_change_a_bit_of_a_divided_world() {
    fn hashes(world: &mut World<3>, bodies: &[BodyHandle]) -> Vec<u64> {
        let mut hashes = Vec::new();
        for step in 0..6 {
            if step == 2 {
                for &body in &bodies[1540..3110] {
                    let _ = world.remove_body(body);
                }
            }
            if step == 4 {
                let drop = |k: u32| BodyDef::new(ball(0.4)).position(Vector([f64::from(k), 22.0, 0.0]));
                (0..40).for_each(|k| drop_into(world, drop(k)));
            }
            world.step();
            hashes.push(world.state_hash());
        }
        hashes
    }
    fn drop_into(world: &mut World<3>, def: BodyDef<3>) {
        world.add_body(def).unwrap();
    }
    let (mut one, bodies) = divided_world(1);
    let snapshot = one.snapshot();
    let first = hashes(&mut one, &bodies);
    for threads in [2, 5] {
        let (mut world, bodies) = divided_world(threads);
        assert_eq!(first, hashes(&mut world, &bodies), "{threads} threads");
        world.restore(&snapshot);
        assert_eq!(first, hashes(&mut world, &bodies), "{threads} threads, once more");
    }
}

/// A pile that grows across the number of bodies from which it is divided goes on without a jolt, the same for every number of threads.
#[test]
fn a_world_grows_into_parts() {
    let run = |threads: usize| {
        let mut world = World::<2>::new(WorldDef { threads, ..WorldDef::default() }).unwrap();
        add_floor(&mut world, material(0.5, 0.0));
        for k in 0..2980_u32 {
            let position = Vector([f64::from(k % 298) * 1.1, 0.5 + f64::from(k / 298)]);
            world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(position)).unwrap();
        }
        let mut hashes = Vec::new();
        for step in 0..30_u32 {
            world.add_body(BodyDef::new(ball(0.3)).position(Vector([f64::from(step) * 3.0, 20.0]))).unwrap();
            world.step();
            hashes.push(world.state_hash());
        }
        let fastest = world.bodies().take(2981).map(|(_, body)| body.velocity().norm()).fold(0.0, f64::max);
        (hashes, fastest)
    };
    let (one, two) = (run(1), run(2));
    assert_eq!(one.0, two.0);
    assert!(one.1 < 0.05, "what rests moves at {} m/s", one.1);
}

/// Contacts across cuts push both sides alike.
#[test]
fn a_divided_world_keeps_its_momentum() {
    let def = WorldDef { gravity: Vector::ZERO, threads: 2, ..WorldDef::default() };
    let mut world = World::<3>::new(def).unwrap();
    let mut random = Random(5);
    for k in 0..3200_u32 {
        let place = Vector([f64::from(k % 20), f64::from(k / 20 % 20), f64::from(k / 400)]) * 1.1;
        let velocity = random.vector::<3>(1.0) - place * 0.3;
        let shape = if k % 2 == 0 { ball(0.5) } else { cuboid(Vector([0.5, 0.4, 0.5])) };
        world.add_body(BodyDef::new(shape).mass(1.0).position(place).velocity(velocity)).unwrap();
    }
    let momenta = |world: &World<3>| {
        let (mut linear, mut angular) = (Vector::ZERO, Bivector::ZERO);
        for (_, body) in world.bodies() {
            let momentum = body.velocity() * body.mass();
            linear += momentum;
            angular += Bivector::wedge(body.centre_of_mass(), momentum) + body.angular_momentum();
        }
        (linear, angular)
    };
    let before = momenta(&world);
    let mut touches = 0;
    for _ in 0..30 {
        world.step();
        touches = touches.max(world.contacts().count());
    }
    let after = momenta(&world);
    let (linear, angular) = ((after.0 - before.0).norm(), (after.1 - before.1).norm() / before.1.norm());
    println!("{touches} contacts, momentum off by {linear:e} N·s, angular by {angular:e} of it");
    assert!(touches > 1000, "only {touches} contacts");
    assert!(linear <= 1e-3 && angular <= 1e-5, "momentum off by {linear} N·s, angular by {angular} of it");
}

/// A body whose state turns non-finite is put aside and reported; the rest goes on.
#[test]
fn a_body_gone_wrong_is_quarantined() {
    let mut world = world(down::<4>());
    add_floor(&mut world, material(0.5, 0.0));
    let good = world.add_body(BodyDef::new(ball(0.5)).position(Vector::unit(1) * 2.0)).unwrap();
    let wrong = BodyDef::new(ball(0.5)).position(Vector::unit(0) * 3.0 + Vector::unit(1) * 3.0);
    let wrong = world.add_body(wrong).unwrap();
    // More than the largest finite number in one step's force.
    for _ in 0..3 {
        let _ = world.body_mut(wrong).unwrap().apply_force(Vector::unit(0) * 1e308);
        let _ = world.body_mut(wrong).unwrap().apply_force(Vector::unit(0) * 1e308);
        world.step();
    }
    run(&mut world, 2.0);
    assert_eq!(world.quarantined(), [wrong]);
    let body = world.body(wrong).unwrap();
    assert!(body.is_quarantined() && body.position().is_finite() && body.velocity().is_finite());
    assert!((world.body(good).unwrap().position()[1] - 0.5).abs() < 0.01, "the rest goes on");
    let pose = hyperbody_math::Pose::from_translation(Vector::unit(1) * 5.0);
    world.body_mut(wrong).unwrap().set_pose(pose).unwrap();
    assert!(world.quarantined().is_empty(), "a new pose ends the quarantine");
    let saved = hyperbody_dynamics::Snapshot::<4>::from_bytes(&world.snapshot().to_bytes());
    assert!(saved.is_ok(), "at once, so that a world saved now can be read: {saved:?}");
    run(&mut world, 3.0);
    assert!(world.body(wrong).unwrap().position()[1] < 2.0, "and it falls again");
}

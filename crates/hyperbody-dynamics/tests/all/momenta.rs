//! Free of outside forces, momentum and angular momentum are kept to the rounding of the solver's single precision, through
//! collisions, friction, bounces and joints, however coarse the step.

use crate::common::{Random, add_floor, ball, cuboid, down, in_all_dimensions, material, run, world};
use hyperbody_dynamics::{BodyDef, BodyHandle, JointDef, World};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Vector, planes};

/// Of the sum of what the bodies have; f32 has 6e-8, and a step has some ten thousand impulses.
const ROUNDING: f64 = 5e-7;

/// What momenta can be compared with: sums of the sizes of the bodies' shares.
fn sizes<const N: usize>(world: &World<N>) -> (f64, f64) {
    let mut sum = (0.0, 0.0);
    for (_, body) in world.bodies() {
        let momentum = body.mass() * body.velocity().norm();
        sum.0 += momentum;
        sum.1 += momentum * body.position().norm() + body.angular_momentum().norm();
    }
    sum
}

/// Runs, and compares with the start; the bodies have to have changed what they do, or nothing is shown.
fn keeps<const N: usize>(what: &str, world: &mut World<N>, steps: usize) {
    let (momentum, spin) = (world.momentum(), world.angular_momentum());
    let (size, spin_size) = sizes(world);
    let energy = world.energy().kinetic;
    let before: Vec<_> = world.bodies().map(|(_, body)| body.velocity()).collect();
    for step in 0..steps {
        world.step();
        let off = (world.momentum() - momentum).norm() / size;
        assert!(off < ROUNDING, "{N}D, {what}: momentum off by {off:e} of {size} at step {step}");
        let off = (world.angular_momentum() - spin).norm() / spin_size;
        assert!(off < ROUNDING, "{N}D, {what}: angular momentum off by {off:e} of {spin_size} at step {step}");
        let now = world.energy().kinetic;
        assert!(now < energy * 1.001, "{N}D, {what}: energy grew from {energy} to {now} by step {step}");
    }
    let changed = world.bodies().zip(before).map(|((_, body), before)| (body.velocity() - before).norm());
    assert!(changed.fold(0.0, f64::max) > 0.3, "{N}D, {what}: nothing happened");
}

fn spin_of<const N: usize>(random: &mut Random, largest: f64) -> Bivector<N> {
    let mut spin = Bivector::ZERO;
    for (i, j) in planes::all(N) {
        spin.set(i, j, random.between(-largest, largest));
    }
    spin
}

/// Two spinning boxes of unlike sides meet off centre.
fn collisions<const N: usize>() {
    for (friction, restitution) in [(0.0, 0.0), (0.6, 0.0), (0.4, 0.8)] {
        let mut world = world::<N>(Vector::ZERO);
        let mut random = Random(3);
        for side in [-1.0, 1.0] {
            let half = Vector::from_fn(|i| 0.4 + 0.1 * i as f64);
            let body = BodyDef::new(cuboid(half)).material(material(friction, restitution));
            let position = Vector::unit(0) * side + Vector::unit(1) * (0.3 * side);
            let body = body
                .position(position)
                .velocity(Vector::unit(0) * (-3.0 * side))
                .angular_velocity(spin_of(&mut random, 2.0));
            world.add_body(body).unwrap();
        }
        keeps(&format!("collision, friction {friction}, restitution {restitution}"), &mut world, 60);
    }
}

/// A cloud of boxes falls in on itself while all of it flies along.
fn implosion<const N: usize>() {
    let mut world = world::<N>(Vector::ZERO);
    let mut random = Random(8);
    for index in 0..25 {
        let at = Vector::from_fn(|i| match i {
            0 => f64::from(index % 5) * 0.8 - 1.6,
            1 => f64::from(index / 5) * 0.8 - 1.6,
            _ => random.between(-0.1, 0.1),
        });
        let body = BodyDef::new(cuboid(Vector::splat(0.3))).material(material(0.5, 0.2));
        let velocity = at * -2.0 + Vector::unit(N - 1) * 4.0;
        world.add_body(body.position(at).velocity(velocity).angular_velocity(spin_of(&mut random, 1.0))).unwrap();
    }
    keeps("implosion", &mut world, 90);
}

/// A chain of unlike links whirls, hits itself and whips.
fn whirling_chain<const N: usize>() {
    let mut world = world::<N>(Vector::ZERO);
    let mut random = Random(21);
    let mut last = None;
    for link in 0..6 {
        let half = Vector::from_fn(|i| if i == 0 { 0.5 } else { 0.1 + 0.02 * i as f64 });
        let velocity = Vector::unit(1) * random.between(-3.0, 3.0) + Vector::unit(N - 1) * random.between(-1.0, 1.0);
        let body = BodyDef::new(cuboid(half)).position(Vector::unit(0) * f64::from(link)).velocity(velocity);
        let body = world.add_body(body.angular_velocity(spin_of(&mut random, 1.0))).unwrap();
        if let Some(last) = last {
            world.add_joint(JointDef::ball(last, body, Vector::unit(0) * 0.5, Vector::unit(0) * -0.5)).unwrap();
        }
        last = Some(body);
    }
    keeps("whirling chain", &mut world, 400);
}

/// A plank of its own weight on the ground, and what rolls on it at 2 m/s along x.
fn rolling<const N: usize>(shape: Shape<N>, radius: f64, mass: f64, plank_mass: f64) -> (World<N>, BodyHandle) {
    let mut world = world::<N>(down());
    add_floor(&mut world, material(0.8, 0.0));
    let half = Vector::from_fn(|i| [20.0, 0.2, 2.0, 2.0, 2.0, 2.0][i]);
    let plank = BodyDef::new(cuboid(half)).position(Vector::unit(1) * 0.2).mass(plank_mass);
    world.add_body(plank.material(material(0.8, 0.0))).unwrap();
    let body = BodyDef::new(shape).mass(mass).material(material(0.8, 0.0));
    let body = body.position(Vector::unit(0) * -10.0 + Vector::unit(1) * (0.4 + radius));
    let body = body.velocity(Vector::unit(0) * 2.0).angular_velocity(Bivector::plane(0, 1, -2.0 / radius));
    let body = world.add_body(body).unwrap();
    (world, body)
}

/// What rolls on something that could move rolls on, for light and heavy balls on heavy and light planks; capsules as well.
fn rolling_on<const N: usize>() {
    let mut cases = vec![
        ("a ball", ball(0.2), 0.2, 5.0, 200.0),
        ("a heavy ball", ball(0.6), 0.6, 100.0, 20.0),
        ("a small ball", ball(0.1), 0.1, 1.0, 50.0),
    ];
    if N > 2 {
        cases.push(("a capsule", Shape::capsule(0.5, 0.2, 2).unwrap(), 0.2, 5.0, 200.0));
    }
    for (what, shape, radius, mass, plank_mass) in cases {
        let (mut world, body) = rolling::<N>(shape, radius, mass, plank_mass);
        run(&mut world, 5.0);
        let speed = world.body(body).unwrap().velocity()[0];
        assert!((speed - 2.0).abs() < 0.01, "{N}D: {what} rolls at {speed} m/s after five seconds, not at 2");
    }
}

/// Balls that lie on what could move lie there.
fn lying_on<const N: usize>() {
    let (mut world, first) = rolling::<N>(ball(0.05), 0.05, 0.1, 50.0);
    let mut body = world.body_mut(first).unwrap();
    body.set_velocity(Vector::ZERO).unwrap();
    body.set_angular_velocity(Bivector::ZERO).unwrap();
    run(&mut world, 20.0);
    let speed = world.body(first).unwrap().velocity().norm();
    assert!(speed < 1e-3, "{N}D: a ball at rest moves at {speed} m/s after twenty seconds");
}

/// Forces of their own press two boxes together askew: nothing from outside, so nothing is to change.
fn pressed_together<const N: usize>() {
    let mut world = world::<N>(Vector::unit(0) * 4.0);
    for side in [-1.0, 1.0] {
        let body = BodyDef::new(cuboid(Vector::splat(0.5))).gravity_scale(-side).material(material(0.5, 0.0));
        let position = Vector::unit(0) * (0.5 * side);
        world.add_body(body.position(position).velocity(Vector::unit(1) * (0.5 * side))).unwrap();
    }
    let (spin, size) = (world.angular_momentum(), sizes(&world).1);
    world.step();
    let off = (world.angular_momentum() - spin).norm() / size;
    // Gravity acts on centres that have come out of line by half a step's way, (v·dt)·m·g·dt.
    let couple = 2.0 * 0.5 * world.dt() * 4.0 * world.dt();
    assert!(off < couple / size + ROUNDING, "{N}D: angular momentum off by {off:e} of {size}, the couple is {couple}");
}

in_all_dimensions! {
    what_rolls_on_a_free_body_rolls_on: rolling_on;
    what_lies_on_a_free_body_lies: lying_on;
    bodies_pressed_together_turn_by_the_couple_alone: pressed_together;
    collisions_keep_both_momenta: collisions;
    an_implosion_keeps_both_momenta: implosion;
    a_whirling_chain_keeps_both_momenta: whirling_chain;
}

//! A pile of 500 tesseracts: when it sleeps, what a step costs awake and asleep, and what a touch wakes. Run with `--release`.
//! Ends with status 1 if it is still awake after 20 s, if a step of sleepers takes 0.05 ms, or if a touch wakes what is out of reach of
//! what was touched.

use std::process::ExitCode;
use std::time::Instant;

use hyperbody_dynamics::{BodyDef, BodyHandle, BodyKind, ContactRef, World, WorldDef};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Rotation, Vector};

fn main() -> ExitCode {
    let mut world = World::<4>::new(WorldDef::default()).expect("in range");
    let mut seed = 12345_u64;
    let mut random = |largest: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * 2.0 * largest
    };
    for axis in 0..4 {
        for sign in if axis == 1 { vec![1.0] } else { vec![1.0, -1.0] } {
            let offset = if axis == 1 { 0.0 } else { -4.9 };
            let wall = Shape::half_space(Vector::unit(axis) * sign, offset).expect("a wall");
            world.add_body(BodyDef::fixed(wall)).expect("valid");
        }
    }
    for index in 0..500 {
        let (layer, cell) = (index / 125, index % 125);
        let at = |k: usize| ((cell / 5_usize.pow(k as u32)) % 5) as f64 * 1.6 - 3.2 + random_shift(layer);
        let place = Vector([at(0), 1.3 + 1.6 * layer as f64, at(1), at(2)]) + Vector::from_fn(|_| random(0.05));
        let turn = Rotation::exp(&Bivector::from_fn(|_, _| random(0.4)));
        let body = BodyDef::new(Shape::cuboid([0.5; 4]).expect("a box")).position(place).rotation(turn);
        world.add_body(body).expect("valid");
    }
    let mut asleep_at = None;
    let mut awake_ms = Vec::new();
    for step in 0..1800 {
        let start = Instant::now();
        world.step();
        awake_ms.push(start.elapsed().as_secs_f64() * 1e3);
        let sleepers = world.bodies().filter(|(_, body)| body.is_sleeping()).count();
        if step % 120 == 119 {
            println!("{:4.0} s: {sleepers} of 500 asleep, {:.2} ms a step", world.time(), awake_ms[awake_ms.len() - 1]);
        }
        if sleepers == 500 {
            asleep_at = Some(world.time());
            break;
        }
    }
    let Some(time) = asleep_at else {
        println!("still awake after {} s", world.time());
        return ExitCode::FAILURE;
    };
    let start = Instant::now();
    for _ in 0..1000 {
        world.step();
    }
    let asleep_ms = start.elapsed().as_secs_f64();
    println!("asleep after {time:.2} s; asleep, a step takes {asleep_ms:.4} ms");
    let reach = island_of_first(&world);
    world.body_mut(reach[0]).expect("there").apply_impulse(Vector::unit(1) * 0.5).expect("finite");
    world.step();
    let woken = world.events().woken();
    let beyond = woken.iter().filter(|body| !reach.contains(body)).count();
    println!(
        "a push wakes {} bodies, {beyond} of them out of reach; {} hang together by touch",
        woken.len(),
        reach.len()
    );
    if time < 20.0 && asleep_ms < 0.05 && beyond == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The first sleeper, and all that hang together with it by touch.
fn island_of_first(world: &World<4>) -> Vec<BodyHandle> {
    let first = world.bodies().find(|(_, body)| body.is_sleeping()).map(|(handle, _)| handle).expect("one sleeps");
    let mut reach = vec![first];
    let mut next = 0;
    while let Some(&body) = reach.get(next) {
        next += 1;
        let at = |contact: &ContactRef<'_, 4>| contact.bodies().0 == body || contact.bodies().1 == body;
        for contact in world.contacts().filter(at) {
            let (a, b) = contact.bodies();
            let other = if a == body { b } else { a };
            let moves = world.body(other).is_some_and(|other| other.kind() == BodyKind::Dynamic);
            if moves && !reach.contains(&other) {
                reach.push(other);
            }
        }
    }
    reach
}

/// Layers are moved a quarter of a spacing to either side.
fn random_shift(layer: usize) -> f64 {
    if layer.is_multiple_of(2) { -0.4 } else { 0.4 }
}

//! A pile of 500 tesseracts in a pit, and six stacks around it: when they sleep, what a step costs awake and asleep, and what a touch wakes.
//! Run with `--release`. Ends with status 1 if the pile is still awake after 20 s, if a step of sleepers takes 0.05 ms, or if a touch
//! wakes others than those that hang together with what was touched.

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
    let floor = Shape::half_space(Vector::unit(1), 0.0).expect("a floor");
    world.add_body(BodyDef::fixed(floor)).expect("valid");
    let stacks: Vec<BodyHandle> = ACROSS.into_iter().flat_map(|axis| wall_and_stacks(&mut world, axis)).collect();
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
            println!("{:4.0} s: {sleepers} asleep, {:.2} ms a step", world.time(), awake_ms[awake_ms.len() - 1]);
        }
        if sleepers == 500 + STACK * stacks.len() {
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
    let last = world.bodies().last().expect("there are bodies").0;
    let exact = [stacks[0], stacks[3], last].map(|touched| wakes_its_own(&mut world, touched));
    if time < 20.0 && asleep_ms < 0.05 && exact.iter().all(|&exact| exact) {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// Axes across the pit.
const ACROSS: [usize; 3] = [0, 2, 3];

/// Tesseracts of a stack.
const STACK: usize = 4;

/// Both walls of the pit across an axis, and a stack beyond each; returns who lies lowest.
fn wall_and_stacks(world: &mut World<4>, axis: usize) -> [BodyHandle; 2] {
    let half = Vector::from_fn(|k| if k == axis { 0.5 } else { 12.0 });
    [-1.0, 1.0].map(|side| {
        let wall = Shape::cuboid(half.0).expect("a box");
        world.add_body(BodyDef::fixed(wall).position(Vector::unit(axis) * (5.4 * side))).expect("valid");
        let stack = (0..STACK).map(|level| {
            let place = Vector::unit(axis) * (9.0 * side) + Vector::unit(1) * (0.5 + level as f64);
            world.add_body(BodyDef::new(Shape::cuboid([0.5; 4]).expect("a box")).position(place)).expect("valid")
        });
        stack.collect::<Vec<_>>()[0]
    })
}

/// Pushes a sleeper; whether that wakes all that hang together with it by touch, and nobody else.
fn wakes_its_own(world: &mut World<4>, touched: BodyHandle) -> bool {
    let mut reach = island_of(world, touched);
    world.body_mut(touched).expect("there").apply_impulse(Vector::unit(1) * 0.5).expect("finite");
    world.step();
    let mut woken = world.events().woken().to_vec();
    println!("a push wakes {} bodies; {} hang together by touch", woken.len(), reach.len());
    reach.sort_unstable();
    woken.sort_unstable();
    woken == reach
}

/// A sleeper, and all that hang together with it by touch.
fn island_of(world: &World<4>, sleeper: BodyHandle) -> Vec<BodyHandle> {
    let mut reach = vec![sleeper];
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

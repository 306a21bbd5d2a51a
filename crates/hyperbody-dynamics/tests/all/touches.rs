//! Touches as events tell them, beside what the contacts show, whatever happens between steps and whoever asks when.

use std::collections::{BTreeMap, BTreeSet};

use crate::common::{Random, add_floor, ball, cuboid, material};
use hyperbody_dynamics::{
    BodyDef, BodyHandle, BodyKind, ContactEvent, ContactPhase, JointDef, Snapshot, World, WorldDef,
};
use hyperbody_geometry::Shape;
use hyperbody_math::{Pose, Vector};

type Two = (BodyHandle, BodyHandle);

/// Who touches whom, kept step by step from contacts and bodies.
#[derive(Default)]
struct Book {
    touching: BTreeSet<Two>,
}

impl Book {
    /// What a step that did something is to tell: phases, and the impulses of what touches.
    fn turn<const N: usize>(&mut self, world: &World<N>) -> Vec<(Two, ContactPhase, f64)> {
        let moving = |body| {
            let body = world.body(body).unwrap();
            body.kind() == BodyKind::Dynamic && !body.is_sleeping() && !body.is_quarantined()
        };
        let mut found = BTreeMap::new();
        for contact in world.contacts() {
            let (a, b) = contact.bodies();
            let touches = contact.points().any(|(_, separation, impulse)| impulse > 0.0 || separation <= 0.0);
            if touches && (moving(a) || moving(b)) {
                let impulse: f64 = contact.points().map(|(_, _, impulse)| impulse).sum();
                *found.entry((a.min(b), a.max(b))).or_insert(0.0) += impulse;
            }
        }
        let rests = |&(a, b): &Two| {
            let there = world.body(a).is_some() && world.body(b).is_some();
            let dynamic = |body| world.body(body).unwrap().kind() == BodyKind::Dynamic;
            there && !moving(a) && !moving(b) && (dynamic(a) || dynamic(b))
        };
        let mut told: BTreeMap<Two, (ContactPhase, f64)> = BTreeMap::new();
        for (&pair, &impulse) in &found {
            let phase = if self.touching.contains(&pair) { ContactPhase::Stay } else { ContactPhase::Begin };
            told.insert(pair, (phase, impulse));
        }
        for pair in self.touching.iter().filter(|pair| !found.contains_key(pair) && !rests(pair)) {
            told.insert(*pair, (ContactPhase::End, 0.0));
        }
        self.touching.retain(|pair| rests(pair));
        self.touching.extend(found.keys());
        told.into_iter().map(|(pair, (phase, impulse))| (pair, phase, impulse)).collect()
    }
}

/// A heap of bodies, some of several pieces, on a floor and beside a slab that is led to and fro.
fn heap<const N: usize>() -> (World<N>, Vec<BodyHandle>) {
    let mut world = World::<N>::new(WorldDef::default()).unwrap();
    let mut bodies = vec![add_floor(&mut world, material(0.5, 0.1))];
    let mut random = Random(5);
    let slab = BodyDef::new(cuboid(Vector::splat(0.5))).kind(BodyKind::Kinematic).position(Vector::unit(0) * 2.0);
    bodies.push(world.add_body(slab).unwrap());
    for index in 0..14 {
        bodies.push(world.add_body(thing(index, &mut random)).unwrap());
    }
    (world, bodies)
}

fn thing<const N: usize>(index: usize, random: &mut Random) -> BodyDef<N> {
    let shape = match index % 3 {
        0 => ball(0.3),
        1 => cuboid(Vector::splat(0.3)),
        _ => {
            let part = |x: f64| (Pose::from_translation(Vector::unit(0) * x), cuboid(Vector::splat(0.25)));
            Shape::compound(vec![part(-0.3), part(0.3)]).unwrap()
        }
    };
    let place = random.vector::<N>(1.0) + Vector::unit(1) * (1.5 + 0.4 * index as f64);
    BodyDef::new(shape).position(place).material(material(0.5, 0.1))
}

/// Something that ends touches, begins them or leaves them, drawn by lot.
fn meddle<const N: usize>(world: &mut World<N>, bodies: &mut Vec<BodyHandle>, random: &mut Random) {
    let pick = |random: &mut Random, from: usize| bodies[from + random.bits() as usize % (bodies.len() - from)];
    let (one, other) = (pick(random, 2), pick(random, 2));
    match random.bits() % 12 {
        0 => {
            world.remove_body(one).unwrap();
            bodies.retain(|&body| body != one);
            let index = (random.bits() % 6) as usize;
            bodies.push(world.add_body(thing(index, random)).unwrap());
        }
        1 => world.body_mut(one).unwrap().set_pose(Pose::from_translation(Vector::unit(1) * 4.0)).unwrap(),
        2 if one != other => world.set_collision(one, other, random.bits() % 2 == 1).unwrap(),
        3 if one != other => {
            let joint = JointDef::rope(Some(one), other, Vector::ZERO, Vector::ZERO, 3.0);
            let stays = random.bits() % 2 == 1;
            if let Some(joint) = world.add_joint(joint).ok().filter(|_| !stays) {
                world.remove_joint(joint).unwrap();
            }
        }
        4 => {
            let sensor = !world.body(one).unwrap().is_sensor();
            world.body_mut(one).unwrap().set_sensor(sensor);
        }
        5 => {
            let now = world.body(one).unwrap();
            let kind = if now.kind() == BodyKind::Dynamic { BodyKind::Static } else { BodyKind::Dynamic };
            let _ = world.set_body(one, now.def().kind(kind));
        }
        // Beyond all numbers: it is put into quarantine.
        6 if !world.body(one).unwrap().is_quarantined() => {
            for _ in 0..2 {
                let _ = world.body_mut(one).unwrap().apply_force(Vector::unit(1) * 1.7e308);
            }
        }
        7 => {
            if let Some(&lost) = world.quarantined().first() {
                let pose = world.body(lost).unwrap().pose();
                let _ = world.body_mut(lost).unwrap().set_pose(pose);
            }
        }
        8 => world.set_gravity(Vector::unit(1) * -9.81).unwrap(),
        9 => world.body_mut(bodies[1]).unwrap().set_velocity(Vector::unit(0) * random.between(-0.4, 0.4)).unwrap(),
        10 => world.body_mut(bodies[1]).unwrap().set_velocity(Vector::ZERO).unwrap(),
        _ => {
            // Bodies that were made static feel none.
            let _ = world.body_mut(one).unwrap().apply_impulse(random.vector(0.5));
        }
    }
}

fn told<const N: usize>(world: &World<N>) -> Vec<ContactEvent<N>> {
    world.events().contacts().to_vec()
}

/// One world is asked after every step, one now and then, after more has been done to it; and one goes on from bytes.
fn check<const N: usize>(seed: u64) {
    let ((mut world, mut bodies), (mut shy, mut shy_bodies)) = (heap::<N>(), heap::<N>());
    let (mut random, mut shy_random) = (Random(seed), Random(seed));
    let mut book = Book::default();
    let mut phases = BTreeMap::new();
    for step in 0..900 {
        world.step();
        shy.step();
        let events = told(&world);
        let expected = book.turn(&world);
        let brief: Vec<_> = events.iter().map(|event| (event.bodies, event.phase)).collect();
        let expected_brief: Vec<_> = expected.iter().map(|&(bodies, phase, _)| (bodies, phase)).collect();
        assert_eq!(brief, expected_brief, "{N}D, seed {seed}, step {step}");
        for (event, (_, phase, impulse)) in events.iter().zip(&expected) {
            assert!((event.impulse - impulse).abs() <= 1e-12 * impulse, "{N}D, seed {seed}, step {step}: {event:?}");
            *phases.entry(format!("{phase:?}")).or_insert(0) += 1;
        }
        if step % 50 == 49 {
            shy.restore(&Snapshot::from_bytes(&shy.snapshot().to_bytes()).unwrap());
        }
        // Sleep comes and goes where nothing happens for a while.
        if step % 300 < 120 && step % 7 == 3 {
            meddle(&mut world, &mut bodies, &mut random);
            meddle(&mut shy, &mut shy_bodies, &mut shy_random);
        }
        assert_eq!(told(&world), events, "events stand until the next step: {N}D, seed {seed}, step {step}");
        if step % 7 == 3 || step % 50 == 49 {
            assert_eq!(told(&shy), events, "asked late: {N}D, seed {seed}, step {step}");
        }
    }
    assert_eq!(world.state_hash(), shy.state_hash());
    assert!(phases.len() == 3 && phases.values().all(|&count| count > 20), "{N}D, seed {seed}: {phases:?}");
}

#[test]
fn touches_are_told_as_contacts_show_them() {
    for seed in 0..6 {
        check::<2>(seed);
        check::<3>(seed);
    }
    check::<4>(0);
}

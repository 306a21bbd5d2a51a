//! Snapshots as bytes: what is read back goes on to the bit, the same state is the same bytes, and every broken or made-up
//! file is refused, or is a state that can be stepped.

use std::sync::Arc;

use crate::common::{Random, add_floor, ball, cuboid, in_all_dimensions, material};
use hyperbody_dynamics::snapshot::bytes::{VERSION, dimension_of};
use hyperbody_dynamics::{
    BodyDef, BodyHandle, BodyKind, Freedom, Groups, JointDef, Snapshot, SnapshotErrorKind, Spring, World, WorldDef,
};
use hyperbody_geometry::product::Factor;
use hyperbody_geometry::{Shape, regular};
use hyperbody_math::{Bivector, Pose, Vector};

fn empty<const N: usize>(threads: usize) -> World<N> {
    World::new(WorldDef { threads, ..WorldDef::default() }).unwrap()
}

/// One shape of every kind; curved products and cones need room.
fn shapes<const N: usize>() -> Vec<Shape<N>> {
    let simplex = Arc::new(regular::polytope("simplex", regular::Size::Circumradius(0.5)).unwrap());
    let polytope = Shape::polytope(simplex).unwrap();
    let mut shapes = vec![
        ball(0.3),
        cuboid(Vector::from_fn(|axis| 0.2 + 0.05 * axis as f64)),
        Shape::capsule(0.3, 0.2, N - 1).unwrap(),
        polytope.clone(),
        Shape::rounded(cuboid(Vector::splat(0.2)), 0.1).unwrap(),
        Shape::rounded(polytope.clone(), 0.05).unwrap(),
    ];
    if N > 2 {
        let disc = || Factor::new([0, 1], &Shape::<2>::ball(0.3).unwrap()).unwrap();
        let mut factors = vec![disc()];
        factors.extend((2..N).map(|axis| Factor::segment(axis, 0.25).unwrap()));
        shapes.push(Shape::product(factors).unwrap());
    }
    if N == 3 {
        let disc = Factor::new([0, 1], &Shape::<2>::ball(0.3).unwrap()).unwrap();
        shapes.push(Shape::pyramid(disc, 0.6).unwrap());
    }
    let turned = Pose::new(Random(3).rotation(1.0), Vector::unit(0) * 0.3);
    let parts = shapes.iter().take(4).map(|part| (turned, part.clone())).collect();
    shapes.push(Shape::compound(parts).unwrap());
    shapes
}

/// Bodies of every shape and kind in a heap; sensors, filters, a conveyor, a one-way floor, a led body; gaps among the slots.
fn heap<const N: usize>() -> (World<N>, Option<BodyHandle>) {
    let mut world = empty::<N>(1);
    let up = Vector::<N>::unit(1);
    let floor = add_floor(&mut world, material(0.5, 0.2));
    world.body_mut(floor).unwrap().set_surface_velocity(Vector::unit(0) * 0.2).unwrap();
    let mut random = Random(11 + N as u64);
    let mut bodies = Vec::new();
    for (index, shape) in shapes().into_iter().chain(shapes().into_iter().take(4)).enumerate() {
        let def = BodyDef::new(shape).position(random.vector::<N>(0.6) + up * (1.0 + 0.7 * index as f64));
        let mut def = def.rotation(random.rotation(2.0)).velocity(random.vector(0.5));
        def.linear_damping = 0.05;
        def.groups = Groups::new(1 << (index % 3), u32::MAX);
        bodies.push(world.add_body(def).unwrap());
    }
    world.set_collision(bodies[0], bodies[1], false).unwrap();
    world.body_mut(bodies[2]).unwrap().set_steady_force(Vector::unit(0) * 0.01, Bivector::ZERO).unwrap();
    let mut zone = BodyDef::fixed(ball(1.0)).position(up);
    zone.sensor = true;
    world.add_body(zone).unwrap();
    let mut ledge = BodyDef::fixed(cuboid(Vector::splat(0.4))).position(Vector::unit(0) * 2.0 + up * 0.5);
    ledge.one_way = Some(up);
    world.add_body(ledge).unwrap();
    let led = BodyDef::new(cuboid(Vector::splat(0.3))).kind(BodyKind::Kinematic).position(Vector::unit(0) * -2.0);
    let led = world.add_body(led).unwrap();
    for gone in [bodies[3], bodies[5]] {
        world.remove_body(gone).unwrap();
    }
    (world, Some(led))
}

/// Joints of every kind, on bodies in the air.
fn joints<const N: usize>() -> (World<N>, Option<BodyHandle>) {
    let mut world = empty::<N>(1);
    add_floor(&mut world, material(0.5, 0.0));
    let at = |x: f64, y: f64| Vector::<N>::unit(0) * x + Vector::unit(1) * y;
    let arm = Pose::from_translation(at(-0.4, 0.0));
    let other = Pose::from_translation(at(0.4, 0.0));
    let mut last = None;
    for link in 0..10 {
        let place = at(0.8 * f64::from(link), 3.0);
        let body = world.add_body(BodyDef::new(cuboid(Vector::splat(0.25))).position(place)).unwrap();
        let from = if last.is_some() { other } else { Pose::from_translation(at(-0.4, 3.0)) };
        let sliding = Freedom { limits: Some((-0.2, 0.3)), ..Freedom::FREE };
        let spring = Spring { target: 0.2, hz: 2.0, damping_ratio: 0.3, max_force: f64::INFINITY };
        let def = match link % 8 {
            0 => JointDef::ball(last, body, from.translation, arm.translation),
            1 => JointDef::hinge(last, body, from, arm, (0, 1)).angle_limits(0, 1, -0.5, 0.7),
            2 => JointDef::hinge(last, body, from, arm, (0, 1)).motor(0, 1, 3.0, 5.0),
            3 => JointDef::slider(last, body, from, arm, 0).axis(0, sliding),
            4 => JointDef::hinge(last, body, from, arm, (0, 1)).angle_spring(0, 1, spring),
            5 => JointDef::rope(last, body, from.translation, arm.translation, 0.3),
            6 => JointDef::distance(last, body, from.translation, arm.translation, 0.4).softness(4.0, 0.3),
            _ => JointDef::weld(last, body, from, arm).softness(3.0, 0.5).break_at(1e4, 1e4),
        };
        world.add_joint(def).unwrap();
        last = Some(body);
    }
    let hand = JointDef::mouse(last.unwrap(), Vector::ZERO, at(6.0, 4.0), 50.0);
    world.add_joint(hand).unwrap();
    let ends: Vec<_> = world.joints().map(|(handle, _)| handle).collect();
    world.remove_joint(ends[4]).unwrap();
    (world, None)
}

/// A stack that falls asleep, beside a ball that comes to wake it.
fn sleepers<const N: usize>() -> (World<N>, Option<BodyHandle>) {
    let mut world = empty::<N>(1);
    add_floor(&mut world, material(0.5, 0.0));
    for storey in 0..4 {
        let place = Vector::unit(1) * (0.5 + f64::from(storey));
        world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(place)).unwrap();
    }
    let place = Vector::unit(0) * 12.0 + Vector::unit(1) * 0.5;
    let rolling = BodyDef::new(ball(0.5)).position(place).velocity(Vector::unit(0) * -4.0);
    world.add_body(rolling).unwrap();
    (world, None)
}

fn steps<const N: usize>(world: &mut World<N>, led: Option<BodyHandle>, count: u32) {
    for _ in 0..count {
        if let Some(led) = led {
            let angle = 0.02 * world.step_count() as f64;
            let place = Vector::unit(0) * (-2.0 + angle.sin()) + Vector::unit(1) * 0.3;
            world.move_kinematic(led, Pose::from_translation(place)).unwrap();
        }
        world.step();
    }
}

/// 100 steps, through bytes, and 200 more in the world itself and in a new one.
fn goes_on<const N: usize>(name: &str, (mut world, led): (World<N>, Option<BodyHandle>)) {
    steps(&mut world, led, 100);
    if let Some(led) = led {
        // What was asked for and not yet done goes along.
        let ahead = Pose::from_translation(world.body(led).unwrap().position() + Vector::unit(1) * 0.01);
        world.move_kinematic(led, ahead).unwrap();
    }
    let bytes = world.snapshot().to_bytes();
    assert_eq!(dimension_of(&bytes), Ok(N));
    let snapshot = Snapshot::<N>::from_bytes(&bytes).unwrap_or_else(|error| panic!("{name} in {N}D: {error}"));
    assert!(snapshot.to_bytes() == bytes, "{name} in {N}D: other bytes after reading");
    let mut other = World::new(WorldDef { gravity: Vector::ZERO, threads: 2, ..WorldDef::default() }).unwrap();
    other.restore(&snapshot);
    assert_eq!(other.state_hash(), world.state_hash());
    for _ in 0..4 {
        for world in [&mut world, &mut other] {
            steps(world, led, 50);
        }
        assert_eq!(other.state_hash(), world.state_hash(), "{name} in {N}D after {}", world.step_count());
        assert_eq!(other.events().contacts(), world.events().contacts());
        assert_eq!(other.events().sensors(), world.events().sensors());
    }
    assert!(other.snapshot().to_bytes() == world.snapshot().to_bytes(), "{name} in {N}D: another state at the end");
    // New handles are the same ones, too.
    let new = |world: &mut World<N>| world.add_body(BodyDef::new(ball(0.1))).unwrap();
    assert_eq!(new(&mut other), new(&mut world));
}

fn every_scene_goes_on<const N: usize>() {
    goes_on::<N>("heap", heap());
    goes_on::<N>("joints", joints());
    let (mut world, _) = sleepers::<N>();
    steps(&mut world, None, 100);
    assert!(world.bodies().any(|(_, body)| body.is_sleeping()), "nothing sleeps in {N}D");
    goes_on::<N>("sleepers", sleepers());
}

/// Everything that is wrong with the frame of the bytes has its own error.
fn frame<const N: usize>() {
    let (mut world, _) = sleepers::<N>();
    steps(&mut world, None, 10);
    let good = world.snapshot().to_bytes();
    let kind = |bytes: &[u8]| Snapshot::<N>::from_bytes(bytes).unwrap_err().kind();
    let changed = |at: usize, value: u8| {
        let mut bytes = good.clone();
        bytes[at] = value;
        bytes
    };
    for length in (0..good.len()).step_by(7) {
        let expected = if length < 8 { SnapshotErrorKind::NotASnapshot } else { SnapshotErrorKind::WrongLength };
        assert_eq!(kind(&good[..length]), expected, "cut off at {length}");
    }
    assert_eq!(kind(&[&good[..], &[0]].concat()), SnapshotErrorKind::WrongLength);
    assert_eq!(kind(&changed(0, b'X')), SnapshotErrorKind::NotASnapshot);
    assert_eq!(kind(&changed(8, VERSION as u8 + 1)), SnapshotErrorKind::OtherVersion);
    assert_eq!(kind(&changed(12, N as u8 + 1)), SnapshotErrorKind::OtherDimension);
    assert_eq!(kind(&changed(16, good[16] ^ 1)), SnapshotErrorKind::WrongLength);
    for at in (24..good.len()).step_by(11) {
        assert_eq!(kind(&changed(at, good[at] ^ 0x10)), SnapshotErrorKind::WrongChecksum, "byte {at}");
    }
}

/// Bytes that were changed, with a length and a checksum that fit again.
fn mended(mut bytes: Vec<u8>) -> Vec<u8> {
    let length = (bytes.len() - 28) as u64;
    bytes[16..24].copy_from_slice(&length.to_le_bytes());
    let end = bytes.len() - 4;
    let checksum = crc32fast::hash(&bytes[..end]).to_le_bytes();
    bytes[end..].copy_from_slice(&checksum);
    bytes
}

/// What is taken has to be a state that can be stepped, asked, and stored again as the same bytes.
fn taken_is_sound<const N: usize>(bytes: &[u8], world: &mut World<N>) -> bool {
    let Ok(snapshot) = Snapshot::<N>::from_bytes(bytes) else { return false };
    assert!(snapshot.to_bytes() == bytes, "a state that was taken has other bytes");
    world.restore(&snapshot);
    for _ in 0..3 {
        world.step();
    }
    let _ = world.ray_cast(&hyperbody_collision::Ray::new(Vector::unit(1) * 9.0, -Vector::unit(1)));
    true
}

/// A few bodies with contacts, a joint, a sleeper and a sensor: small, so that many changes can be tried.
fn small<const N: usize>() -> Vec<u8> {
    let mut world = empty::<N>(1);
    add_floor(&mut world, material(0.5, 0.0));
    let simplex = Arc::new(regular::polytope("simplex", regular::Size::Circumradius(0.5)).unwrap());
    let shapes = [cuboid(Vector::splat(0.5)), Shape::polytope(simplex).unwrap(), ball(0.4)];
    let bodies = shapes.map(|shape| shape).into_iter().enumerate().map(|(index, shape)| {
        let place = Vector::unit(0) * (0.9 * index as f64) + Vector::unit(1) * 0.5;
        world.add_body(BodyDef::new(shape).position(place)).unwrap()
    });
    let bodies: Vec<_> = bodies.collect();
    world.add_joint(JointDef::rope(bodies[0], bodies[2], Vector::ZERO, Vector::ZERO, 1.9)).unwrap();
    let mut zone = BodyDef::fixed(ball(0.5));
    zone.sensor = true;
    world.add_body(zone).unwrap();
    let spare = world.add_body(BodyDef::new(ball(0.2)).position(Vector::unit(1) * 5.0)).unwrap();
    steps(&mut world, None, 20);
    world.remove_body(spare).unwrap();
    world.snapshot().to_bytes()
}

/// Every field in turn becomes what it cannot be, with a checksum that is right.
fn every_place<const N: usize>() {
    let good = small::<N>();
    let mut world = empty::<N>(1);
    assert!(taken_is_sound(&good, &mut world));
    let (mut refused, mut taken) = (0, 0);
    let words: [&[u8]; 5] = [&[0xff; 4], &[0; 4], &[0, 0, 0xf8, 0x7f], &[0xff, 0xff, 0xef, 0x7f], &[0, 0, 0, 0x80]];
    for at in (24..good.len() - 8).step_by(if N < 4 { 1 } else { 5 }) {
        for word in words {
            let mut bytes = good.clone();
            bytes[at..at + 4].copy_from_slice(word);
            if taken_is_sound(&mended(bytes), &mut world) {
                taken += 1;
            } else {
                refused += 1;
            }
        }
    }
    assert!(refused > 1000 && taken > 1000, "{refused} refused and {taken} taken in {N}D");
}

/// Random damage: bits, bytes, stretches moved, doubled and left out.
fn damage<const N: usize>(tries: usize) {
    let good = small::<N>();
    let mut world = empty::<N>(1);
    let mut random = Random(77 + N as u64);
    let mut taken = 0;
    for _ in 0..tries {
        let mut bytes = good.clone();
        for _ in 0..1 + random.bits() % 3 {
            let state = 24..bytes.len() - 4;
            let mut place = || state.start + (random.bits() as usize) % state.len();
            let (at, other) = (place(), place());
            let length = 1 + (random.bits() % 24) as usize;
            match random.bits() % 5 {
                0 => bytes[at] ^= 1 << (random.bits() % 8),
                1 => bytes[at] = random.bits() as u8,
                2 => drop(bytes.drain(at..(at + length).min(state.end))),
                3 => {
                    let stretch = bytes[at..(at + length).min(state.end)].to_vec();
                    bytes.splice(other..other, stretch);
                }
                _ => {
                    let stretch = bytes[at..(at + length).min(state.end)].to_vec();
                    let end = (other + stretch.len()).min(state.end);
                    bytes.splice(other..end, stretch);
                }
            }
            if bytes.len() < 64 {
                break;
            }
        }
        taken += usize::from(taken_is_sound(&mended(bytes), &mut world));
    }
    assert!(taken > 0 && taken < tries, "{taken} of {tries} taken in {N}D");
}

#[test]
fn random_damage_is_refused_or_harmless() {
    damage::<2>(1500);
    damage::<3>(1500);
    damage::<4>(800);
    damage::<5>(200);
    damage::<6>(200);
}

#[test]
fn what_no_field_can_be_is_refused_or_harmless() {
    every_place::<2>();
    every_place::<3>();
    every_place::<4>();
}

in_all_dimensions! {
    bytes_go_on_to_the_bit: every_scene_goes_on;
    broken_frames_have_their_own_errors: frame;
}

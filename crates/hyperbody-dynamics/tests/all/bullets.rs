//! Fast bodies of every shape stop at thin ones, whatever their direction and spin, and nothing is frozen in place.

use std::sync::Arc;

use hyperbody_dynamics::{BodyDef, BodyHandle, BodyKind, Groups, World};
use hyperbody_geometry::{Polytope, Shape, regular};
use hyperbody_math::{Bivector, Pose, Vector};

use crate::common::{GRAVITY, Random, add_floor, ball, cuboid, down, in_all_dimensions, material, run, world};

in_all_dimensions! {
    a_thousand_boxes_at_500_metres_a_second_are_stopped_by_a_centimetre: check_boxes;
    bullets_of_every_shape_are_stopped_by_every_wall: check_shapes;
    a_turning_blade_takes_along_what_it_meets: check_blade;
    two_bullets_that_meet_do_not_pass_each_other: check_head_on;
    what_slides_and_rolls_fast_is_not_held_up: check_not_frozen;
    sensors_and_open_sides_let_bullets_pass: check_let_pass;
}

const SPEED: f64 = 500.0;
const THICKNESS: f64 = 0.01;
const WIDTH: f64 = 300.0;

/// Uniform in directions at most sixty degrees off the first axis.
fn forward<const N: usize>(random: &mut Random) -> Vector<N> {
    for _ in 0..10_000 {
        let v = random.vector::<N>(1.0);
        if v.norm() <= 1.0 && v[0] > 0.5 * v.norm() {
            return v * (1.0 / v.norm());
        }
    }
    Vector::unit(0)
}

fn spin<const N: usize>(random: &mut Random, largest: f64) -> Bivector<N> {
    Bivector::from_fn(|i, j| if i < j { random.between(-largest, largest) } else { 0.0 })
}

fn thin_box<const N: usize>() -> Shape<N> {
    cuboid(Vector::from_fn(|axis| if axis == 0 { 0.5 * THICKNESS } else { WIDTH }))
}

/// Two cross-polytopes face to face.
fn thin_hull<const N: usize>() -> Shape<N> {
    let mut points = Vec::new();
    for (side, far) in [(-0.5, 4.0), (0.5, 4.4)] {
        for axis in 1..N {
            for sign in [-1.0, 1.0] {
                points.push(Vector::unit(0) * (side * THICKNESS) + Vector::unit(axis) * (sign * far * WIDTH));
            }
        }
    }
    Shape::polytope(Arc::new(Polytope::from_points(&points).unwrap())).unwrap()
}

fn bullets<const N: usize>(random: &mut Random) -> Vec<(&'static str, Shape<N>)> {
    let size = random.between(0.05, 0.3);
    let points: Vec<Vector<N>> = (0..4 * N + 4).map(|_| random.vector(size)).collect();
    let name = if N == 4 { "24-cell" } else { "cross-polytope" };
    let regular = regular::polytope(name, regular::Size::Circumradius(size)).unwrap();
    let end = |side: f64| Pose::from_translation(Vector::unit(1) * (side * 1.5 * size));
    let parts = vec![(end(1.0), ball(0.5 * size)), (end(-1.0), cuboid(Vector::splat(0.5 * size)))];
    vec![
        ("plate", cuboid(Vector::from_fn(|axis| if axis == 1 { 0.01 } else { size }))),
        ("ball", ball(size)),
        ("capsule", Shape::capsule(size, 0.3 * size, 1).unwrap()),
        ("hull", Shape::polytope(Arc::new(Polytope::from_points(&points).unwrap())).unwrap()),
        ("regular", Shape::polytope(Arc::new(regular)).unwrap()),
        ("compound", Shape::compound(parts).unwrap()),
    ]
}

/// The middles of a body's pieces as the frame of another body sees them.
fn seen<const N: usize>(world: &World<N>, body: BodyHandle, by: BodyHandle) -> Vec<Vector<N>> {
    let (body, by) = (world.body(body).unwrap(), world.body(by).unwrap());
    let pieces = body.shape().pieces();
    let place = |pose: &Pose<N>| {
        if pieces.len() == 1 { body.centre_of_mass() } else { body.pose().transform_point(pose.translation) }
    };
    pieces.iter().map(|(pose, _)| by.pose().inverse_transform_point(place(pose))).collect()
}

/// Shoots at a wall across the first axis and says whether all pieces stay before it.
fn is_stopped<const N: usize>(wall: BodyDef<N>, bullet: Shape<N>, random: &mut Random) -> bool {
    let mut world = world(Vector::ZERO);
    let wall = world.add_body(wall).unwrap();
    let direction = forward::<N>(random);
    let def = BodyDef::new(bullet).mass(1.0).position(direction * -random.between(2.0, 12.0));
    let def = def.rotation(random.rotation(3.0)).velocity(direction * SPEED).angular_velocity(spin(random, 100.0));
    let shot = world.add_body(def).unwrap();
    for _ in 0..16 {
        world.step();
    }
    seen(&world, shot, wall).iter().all(|place| place[0] < 0.0)
}

fn check_boxes<const N: usize>() {
    let mut random = Random(7 + N as u64);
    let wall = BodyDef::fixed(thin_box::<N>());
    let through = (0..1000).filter(|_| {
        let half = Vector::from_fn(|_| random.between(0.03, 0.4));
        !is_stopped(wall.clone(), cuboid(half), &mut random)
    });
    assert_eq!(through.count(), 0, "of 1,000 in {N}D");
}

fn check_shapes<const N: usize>() {
    let mut random = Random(70 + N as u64);
    let walls = [
        ("box", BodyDef::fixed(thin_box::<N>())),
        ("hull", BodyDef::fixed(thin_hull())),
        ("dynamic box", BodyDef::new(thin_box()).mass(1e6)),
    ];
    for shot in 0..12 {
        for (what, wall) in &walls {
            for (name, bullet) in bullets(&mut random) {
                assert!(
                    is_stopped(wall.clone(), bullet, &mut random),
                    "{name} through the {what} in {N}D, shot {shot}"
                );
            }
        }
    }
}

/// A blade that turns by up to a quarter of a radian a step meets bodies at rest.
fn check_blade<const N: usize>() {
    let mut random = Random(700 + N as u64);
    for _ in 0..12 {
        for (name, bullet) in bullets::<N>(&mut random) {
            let mut world = world(Vector::ZERO);
            let half = Vector::from_fn(|axis| if axis == 0 { 0.5 * THICKNESS } else { 10.0 });
            let rate = Bivector::plane(0, 1, random.between(5.0, 15.0));
            let def = BodyDef::new(cuboid(half)).kind(BodyKind::Kinematic).angular_velocity(rate);
            let blade = world.add_body(def).unwrap();
            let start = Vector::unit(1) * random.between(1.0, 6.0) - Vector::unit(0) * random.between(0.7, 2.0);
            let def = BodyDef::new(bullet).position(start).rotation(random.rotation(3.0));
            let met = world.add_body(def.angular_velocity(spin(&mut random, 30.0))).unwrap();
            for _ in 0..6 {
                world.step();
            }
            for place in seen(&world, met, blade) {
                assert!(place[0] < 0.0 || place[1] > 10.0, "the {name} is behind the blade in {N}D: {place:?}");
            }
        }
    }
}

fn check_head_on<const N: usize>() {
    let mut random = Random(7000 + N as u64);
    for _ in 0..20 {
        let mut world = world(Vector::<N>::ZERO);
        let shapes = [ball(0.05), cuboid(Vector::splat(0.05))];
        let [a, b] = [-1.0, 1.0].map(|side| {
            let shape = shapes[usize::from(random.between(0.0, 1.0) < 0.5)].clone();
            // Straight at each other and square: askew, they might glance off and go on.
            let def = BodyDef::new(shape).mass(1.0).position(Vector::unit(0) * (side * random.between(2.0, 9.0)));
            world.add_body(def.velocity(Vector::unit(0) * (side * -SPEED))).unwrap()
        });
        for _ in 0..6 {
            world.step();
            let [left, right] = [a, b].map(|body| world.body(body).unwrap().position()[0]);
            assert!(left < right, "they passed each other in {N}D: {left} and {right}");
        }
        let momentum = world.momentum();
        assert!(momentum.norm() < 0.1, "momentum is kept: {momentum:?}");
    }
}

/// Sliding on a thin floor, rolling on it, flying past it: as far as without friction, gravity and floor.
fn check_not_frozen<const N: usize>() {
    let mut world = world::<N>(down());
    let half = Vector::from_fn(|axis| if axis == 1 { 0.5 * THICKNESS } else { 50.0 });
    world.add_body(BodyDef::fixed(cuboid(half)).material(material(0.0, 0.0))).unwrap();
    let smooth = |shape: Shape<N>, height: f64| {
        let place = Vector::unit(0) * -40.0 + Vector::unit(1) * height;
        BodyDef::new(shape).position(place).material(material(0.0, 0.0)).velocity(Vector::unit(0) * 200.0)
    };
    let touching = 0.5 * THICKNESS + 0.1;
    let mut shots = vec![world.add_body(smooth(cuboid(Vector::splat(0.1)), touching)).unwrap()];
    let spinning = Bivector::plane(0, 1, -400.0);
    shots.push(world.add_body(smooth(ball(0.1), touching).angular_velocity(spinning).gravity_scale(2.0)).unwrap());
    shots.push(world.add_body(smooth(ball(0.1), touching + 0.3).gravity_scale(0.0)).unwrap());
    for (k, &shot) in shots.iter().enumerate() {
        world.body_mut(shot).unwrap().set_groups(Groups::new(1 << k, 1 << 31 | 1 << k));
    }
    let floor = world.bodies().next().unwrap().0;
    world.body_mut(floor).unwrap().set_groups(Groups::new(1 << 31, u32::MAX));
    for _ in 0..20 {
        world.step();
    }
    for shot in shots {
        let x = world.body(shot).unwrap().position()[0];
        assert!((x + 40.0 - 200.0 / 3.0).abs() < 0.05, "it came {} m in {N}D", x + 40.0);
    }
}

fn check_let_pass<const N: usize>() {
    let away = Vector::unit(0);
    let walls = [
        BodyDef::fixed(thin_box::<N>()).sensor(true),
        BodyDef::fixed(thin_box::<N>()).one_way(away),
        BodyDef::fixed(thin_box::<N>()).groups(Groups::NONE),
    ];
    for wall in walls {
        let mut world = world(Vector::ZERO);
        world.add_body(wall).unwrap();
        let def = BodyDef::new(ball(0.1)).position(away * -3.3).velocity(away * SPEED);
        let shot = world.add_body(def).unwrap();
        run(&mut world, 0.1);
        assert!((world.body(shot).unwrap().velocity() - away * SPEED).norm() < 1e-9);
    }
    // From the side that holds, it is stopped; and what lies on a floor still falls with g beside it.
    let mut world = world(down());
    add_floor(&mut world, material(0.5, 0.0));
    world.add_body(BodyDef::fixed(thin_box::<N>()).one_way(-away)).unwrap();
    let start = away * -3.3 + Vector::unit(1) * 5.0;
    let shot = world.add_body(BodyDef::new(ball(0.1)).position(start).velocity(away * SPEED)).unwrap();
    run(&mut world, 0.2);
    let body = world.body(shot).unwrap();
    assert!(body.position()[0] < 0.0 && body.velocity()[1] < -0.5 * GRAVITY * 0.2, "{:?}", body.velocity());
}

//! Bodies that become others while the world runs: their handles stay, their mass and their contacts follow, nothing is left
//! hanging in the air.

use crate::common::{Random, add_floor, ball, cuboid, in_all_dimensions, material};
use hyperbody_dynamics::{BodyDef, BodyHandle, BodyKind, JointDef, World, WorldDef, WorldErrorKind};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Pose, Vector};

in_all_dimensions! {
    a_stack_settles_anew_when_a_shape_in_it_changes: stack;
    a_body_that_was_changed_is_one_that_was_always_so: from_the_start;
    joints_hold_the_same_points_of_another_shape: joints;
    kinds_change: kinds;
}

fn falling<const N: usize>() -> World<N> {
    let mut world = World::new(WorldDef::default()).unwrap();
    add_floor(&mut world, material(0.5, 0.0));
    world
}

fn seconds<const N: usize>(world: &mut World<N>, time: f64) {
    (0..(time / world.dt()) as usize).for_each(|_| world.step());
}

/// Three cubes asleep; the middle one shrinks and then grows: the upper one follows, and all sleep again.
fn stack<const N: usize>() {
    let mut world = falling::<N>();
    let cube = |half: f64| cuboid(Vector::<N>::splat(half));
    let bodies: Vec<BodyHandle> = (0..3)
        .map(|k| world.add_body(BodyDef::new(cube(0.5)).position(Vector::unit(1) * (0.5 + f64::from(k)))).unwrap())
        .collect();
    seconds(&mut world, 3.0);
    assert!(bodies.iter().all(|&body| world.body(body).unwrap().is_sleeping()), "{N}D");
    for half in [0.4, 0.6] {
        world.set_shape(bodies[1], cube(half)).unwrap();
        let middle = world.body(bodies[1]).unwrap();
        let expected = (2.0 * half).powi(N as i32);
        assert!((middle.mass() / expected - 1.0).abs() < 1e-9, "{N}D: {} kg, not {expected}", middle.mass());
        world.step();
        assert!(bodies.iter().all(|&body| !world.body(body).unwrap().is_sleeping()), "{N}D: woken by the change");
        seconds(&mut world, 6.0);
        let heights = [0.5, 1.0 + half, 1.5 + 2.0 * half];
        for (&body, height) in bodies.iter().zip(heights) {
            let body = world.body(body).unwrap();
            assert!(body.is_sleeping(), "{N}D: awake at {:?}", body.position().0);
            let off = (body.position()[1] - height).abs();
            assert!(off < 5e-3, "{N}D: at {:?} in place of {height}, half an edge of {half}", body.position().0);
        }
    }
}

/// Changed before the first step, a world goes the same way to the bit as if the body had been added so.
fn from_the_start<const N: usize>() {
    let build = |changed: bool| {
        let mut world = falling::<N>();
        let mut random = Random(8);
        for index in 0..6 {
            let turn = random.rotation(0.5);
            let position = Vector::unit(1) * (0.6 + 0.9 * f64::from(index)) + random.vector::<N>(0.1);
            let (shape, other) = (cuboid(Vector::from_fn(|i| 0.2 + 0.05 * i as f64)), ball(0.3));
            let def = BodyDef::new(shape).position(position).rotation(turn).velocity(random.vector::<N>(0.5));
            if changed {
                let body = world.add_body(def.clone().shape(other)).unwrap();
                world.set_body(body, def).unwrap();
            } else {
                world.add_body(def).unwrap();
            }
        }
        world
    };
    let (mut changed, mut added) = (build(true), build(false));
    for step in 0..200 {
        assert_eq!(changed.state_hash(), added.state_hash(), "{N}D, step {step}");
        changed.step();
        added.step();
    }
}

/// A body hung by a corner gets a shape whose centre of mass is elsewhere: its points go on as fast as they did, and the joint
/// holds the same one.
fn joints<const N: usize>() {
    let mut world = World::<N>::new(WorldDef { sleeping: false, ..WorldDef::default() }).unwrap();
    let corner = Vector::splat(0.2);
    let spin = Bivector::plane(0, 1, 1.5);
    let body = BodyDef::new(cuboid(Vector::splat(0.2))).position(-corner).angular_velocity(spin);
    let body = world.add_body(body.velocity(spin.act_on(-corner))).unwrap();
    world.add_joint(JointDef::ball(None, body, Vector::ZERO, corner)).unwrap();
    seconds(&mut world, 0.5);
    let before = world.body(body).unwrap();
    let (pose, somewhere) = (before.pose(), Vector::unit(0) * 0.7);
    let velocity = before.velocity_at(somewhere);
    let shape = Shape::compound(vec![
        (Pose::IDENTITY, cuboid(Vector::splat(0.2))),
        (Pose::from_translation(Vector::unit(1) * -0.5), cuboid(Vector::splat(0.3))),
    ]);
    world.set_shape(body, shape.unwrap()).unwrap();
    let after = world.body(body).unwrap();
    assert!((after.pose().translation - pose.translation).norm() < 1e-12, "{N}D: the frame stays where it is");
    assert!((after.velocity_at(somewhere) - velocity).norm() < 1e-12, "{N}D: points keep their velocities");
    assert!((after.centre_of_mass() - after.position()).norm() > 0.2, "{N}D: the centre of mass is elsewhere now");
    for _ in 0..120 {
        world.step();
        let gap = world.body(body).unwrap().pose().transform_point(corner).norm();
        assert!(gap < 2e-3, "{N}D: the joint is {gap} m open");
    }
}

/// A wall becomes loose and falls; a falling one is stopped in the air; what a joint needs to move is not made to stand.
fn kinds<const N: usize>() {
    let mut world = falling::<N>();
    let wall = BodyDef::fixed(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 3.0);
    let wall = world.add_body(wall).unwrap();
    let lamp = world.add_body(BodyDef::new(ball(0.2)).position(Vector::unit(1) * 2.0)).unwrap();
    world.add_joint(JointDef::ball(wall, lamp, Vector::unit(1) * -0.5, Vector::unit(1) * 0.5)).unwrap();
    seconds(&mut world, 3.0);
    assert!(world.body(lamp).unwrap().is_sleeping(), "{N}D: the lamp hangs still");

    let refused = world.body(lamp).unwrap().def().kind(BodyKind::Static);
    assert_eq!(world.set_body(lamp, refused).unwrap_err().kind(), WorldErrorKind::NotAllowed);
    assert_eq!(world.body(lamp).unwrap().kind(), BodyKind::Dynamic, "refused, and nothing changed");

    let loose = world.body(wall).unwrap().def().kind(BodyKind::Dynamic);
    world.set_body(wall, loose).unwrap();
    seconds(&mut world, 0.3);
    let (wall_now, lamp_now) = (world.body(wall).unwrap(), world.body(lamp).unwrap());
    assert!(wall_now.velocity()[1] < -2.0 && lamp_now.velocity()[1] < -2.0, "{N}D: both fall");
    assert!(wall_now.mass() > 0.0 && wall_now.def().mass.is_some());

    let stopped = world.body(wall).unwrap().def().kind(BodyKind::Static);
    world.set_body(wall, stopped).unwrap();
    let height = world.body(wall).unwrap().position()[1];
    seconds(&mut world, 1.0);
    assert_eq!(world.body(wall).unwrap().position()[1], height, "{N}D: it stands in the air");
    assert_eq!(world.body(wall).unwrap().mass(), 0.0);
    let gap = world.body(lamp).unwrap().position()[1] - (height - 1.0);
    assert!(gap.abs() < 0.01, "{N}D: the lamp hangs from it again, {gap} m off");

    let half_space = Shape::half_space(Vector::unit(1), 0.0).unwrap();
    assert_eq!(world.set_shape(lamp, half_space).unwrap_err().kind(), WorldErrorKind::BadShape);
    world.remove_body(lamp).unwrap();
    assert_eq!(world.set_shape(lamp, ball(0.1)).unwrap_err().kind(), WorldErrorKind::StaleHandle);
    let def = BodyDef::new(ball(0.1));
    assert_eq!(world.set_body(lamp, def).unwrap_err().kind(), WorldErrorKind::StaleHandle);
}

/// A ton on a rope becomes a gram: what held the one does not throw the other.
#[test]
fn what_hung_heavily_hangs_on_when_light() {
    let mut world = World::<4>::new(WorldDef::default()).unwrap();
    let body = world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).mass(1000.0)).unwrap();
    world.add_joint(JointDef::rope(None, body, Vector::unit(1) * 2.0, Vector::ZERO, 2.0)).unwrap();
    (0..60).for_each(|_| world.step());
    let def = world.body(body).unwrap().def().mass(1e-3);
    world.set_body(body, def).unwrap();
    let mut fastest: f64 = 0.0;
    for _ in 0..60 {
        world.step();
        fastest = fastest.max(world.body(body).unwrap().velocity().norm());
    }
    assert!(fastest < 0.1, "it was thrown at {fastest} m/s");
}

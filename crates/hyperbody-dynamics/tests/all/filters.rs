//! Who meets whom: groups and masks, pairs switched off, sensors, one-way bodies, contact hooks.

use hyperbody_dynamics::{
    BodyDef, BodyHandle, BodyKind, Groups, HookedContact, SensorEvent, SensorPhase, World, WorldDef,
};
use hyperbody_geometry::Shape;
use hyperbody_math::{Pose, Rotation, Vector};

use crate::common::{GRAVITY, add_floor, assert_close, ball, cuboid, down, in_all_dimensions, material, run, world};

in_all_dimensions! {
    bodies_meet_by_groups_and_masks: check_groups;
    changed_groups_take_effect_at_once_and_wake_what_lay_there: check_changed_groups;
    a_pair_can_be_switched_off_and_on: check_switched_off;
    a_sensor_notices_and_does_not_push: check_sensor;
    a_sensor_notices_sleepers_without_waking_them: check_sensor_on_sleepers;
    a_one_way_platform_lets_up_and_holds: check_one_way;
    a_hook_changes_friction_bounce_and_speed: check_hook;
    a_hook_drops_points: check_hook_drops;
    rules_are_the_same_bits_on_two_threads_and_after_a_restore: check_bits;
}

fn height<const N: usize>(world: &World<N>, body: BodyHandle) -> f64 {
    world.body(body).unwrap().position()[1]
}

fn floor_def<const N: usize>() -> BodyDef<N> {
    BodyDef::fixed(Shape::half_space(Vector::unit(1), 0.0).unwrap())
}

/// Bodies of all pairs of memberships and masks over two groups: who falls through the floor is told by the rule.
fn check_groups<const N: usize>() {
    for floor_bits in 0..16_u32 {
        let floor = Groups::new(floor_bits & 3, floor_bits >> 2);
        let mut world = world::<N>(down());
        world.add_body(floor_def().groups(floor)).unwrap();
        let mut bodies = Vec::new();
        for bits in 0..16_u32 {
            let groups = Groups::new(bits & 3, bits >> 2);
            let place = Vector::unit(0) * f64::from(bits) + Vector::unit(1) * 0.31;
            bodies.push((groups, world.add_body(BodyDef::new(ball(0.3)).position(place).groups(groups)).unwrap()));
        }
        run(&mut world, 0.5);
        for (groups, body) in bodies {
            let meets = groups.memberships & floor.mask != 0 && floor.memberships & groups.mask != 0;
            assert_eq!(groups.meets(floor), meets);
            let expected = if meets { 0.3 } else { 0.31 - 0.5 * GRAVITY * 0.25 };
            assert!(
                (height(&world, body) - expected).abs() < 0.05,
                "{groups:?} on {floor:?}: {}",
                height(&world, body)
            );
        }
    }
}

fn check_changed_groups<const N: usize>() {
    let mut world = World::<N>::new(WorldDef::default()).unwrap();
    let floor = world.add_body(floor_def()).unwrap();
    let below = BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 0.5);
    let below = world.add_body(below).unwrap();
    let above = BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 1.5);
    let above = world.add_body(above).unwrap();
    run(&mut world, 2.0);
    assert!(world.body(below).unwrap().is_sleeping() && world.body(above).unwrap().is_sleeping());
    world.body_mut(below).unwrap().set_groups(Groups::NONE);
    run(&mut world, 0.1);
    assert!(height(&world, below) < 0.47, "it falls through the floor: {}", height(&world, below));
    assert!(height(&world, above) < 1.47, "it lost its support: {}", height(&world, above));
    run(&mut world, 2.0);
    assert!((height(&world, above) - 0.5).abs() < 0.01, "it lies on the floor: {}", height(&world, above));
    assert!(!world.may_collide(below, floor) && world.may_collide(above, floor));
}

fn check_switched_off<const N: usize>() {
    let mut world = World::<N>::new(WorldDef::default()).unwrap();
    let floor = world.add_body(floor_def()).unwrap();
    let body = world.add_body(BodyDef::new(ball(0.5)).position(Vector::unit(1) * 0.5)).unwrap();
    let beside = Vector::unit(0) * 3.0 + Vector::unit(1) * 0.5;
    let other = world.add_body(BodyDef::new(ball(0.5)).position(beside)).unwrap();
    run(&mut world, 2.0);
    assert!(world.set_collision(body, body, false).is_err());
    world.set_collision(body, floor, false).unwrap();
    assert!(!world.may_collide(body, floor) && !world.may_collide(floor, body) && world.may_collide(other, floor));
    run(&mut world, 0.2);
    assert!(height(&world, body) < 0.4 && (height(&world, other) - 0.5).abs() < 0.01);
    world.set_collision(floor, body, true).unwrap();
    run(&mut world, 2.0);
    assert!((height(&world, body) - 0.5).abs() < 0.01, "pushed out again: {}", height(&world, body));
    // A slot that is used again starts without what was said of the body before.
    world.set_collision(body, floor, false).unwrap();
    world.remove_body(body).unwrap();
    let next = world.add_body(BodyDef::new(ball(0.5)).position(Vector::unit(1) * 0.6)).unwrap();
    assert!(world.may_collide(next, floor) && !world.may_collide(body, floor));
    assert!(world.set_collision(body, floor, false).is_err());
}

/// A ball falls through a sensor exactly as it would without one, and is noticed while it overlaps it.
fn check_sensor<const N: usize>() {
    let run_with = |gate: bool| {
        let mut world = world::<N>(down());
        let sensor = gate.then(|| {
            let def = BodyDef::fixed(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * -2.0).sensor(true);
            world.add_body(def).unwrap()
        });
        let body = world.add_body(BodyDef::new(ball(0.25)).rotation(Rotation::in_plane(0, 1, 0.3))).unwrap();
        let mut events = Vec::new();
        for _ in 0..60 {
            let before = height(&world, body);
            world.step();
            for event in world.events().sensors() {
                assert_eq!((Some(event.sensor), event.other), (sensor, body));
                events.push((event.phase, before));
            }
            let overlaps = (before + 2.0).abs() <= 0.75;
            let inside: Vec<BodyHandle> = sensor.into_iter().flat_map(|sensor| world.inside(sensor)).collect();
            assert_eq!(inside, if overlaps && gate { vec![body] } else { vec![] }, "at height {before}");
            assert!(world.events().contacts().is_empty() && world.contacts().next().is_none());
        }
        (world.body(body).unwrap().position(), events)
    };
    let ((free, _), (through, events)) = (run_with(false), run_with(true));
    assert_eq!(free, through);
    let phases: Vec<SensorPhase> = events.iter().map(|event| event.0).collect();
    assert_eq!(phases, [SensorPhase::Enter, SensorPhase::Leave]);
}

fn check_sensor_on_sleepers<const N: usize>() {
    let mut world = World::<N>::new(WorldDef::default()).unwrap();
    world.add_body(floor_def()).unwrap();
    let body = world.add_body(BodyDef::new(ball(0.5)).position(Vector::unit(1) * 0.5)).unwrap();
    run(&mut world, 2.0);
    assert!(world.body(body).unwrap().is_sleeping());
    let sensor = world.add_body(BodyDef::fixed(ball(0.5)).sensor(true).position(Vector::unit(1) * 1.2)).unwrap();
    let event = |phase| SensorEvent { sensor, other: body, phase };
    world.step();
    assert_eq!(world.events().sensors(), [event(SensorPhase::Enter)]);
    run(&mut world, 0.2);
    assert_eq!(world.inside(sensor).collect::<Vec<_>>(), [body]);
    world.body_mut(sensor).unwrap().set_pose(Pose::new(Rotation::IDENTITY, Vector::unit(1) * 9.0)).unwrap();
    world.step();
    assert_eq!(world.events().sensors(), [event(SensorPhase::Leave)]);
    assert!(world.body(body).unwrap().is_sleeping(), "sensors wake nobody");
    // A kinematic sensor that comes by notices it too; two sensors notice each other.
    let start = Vector::unit(0) * -2.0 + Vector::unit(1) * 0.5;
    let def = BodyDef::new(ball(0.5)).kind(BodyKind::Kinematic).sensor(true).position(start);
    let probe = world.add_body(def.velocity(Vector::unit(0) * 4.0)).unwrap();
    let other = world.add_body(BodyDef::fixed(ball(0.5)).sensor(true).position(start + Vector::unit(0))).unwrap();
    let mut seen = Vec::new();
    for _ in 0..60 {
        world.step();
        seen.extend(world.events().sensors().iter().map(|event| (event.sensor, event.other, event.phase)));
    }
    for pair in [(probe, body), (probe, other), (other, probe)] {
        for phase in [SensorPhase::Enter, SensorPhase::Leave] {
            assert_eq!(seen.iter().filter(|event| **event == (pair.0, pair.1, phase)).count(), 1, "{seen:?}");
        }
    }
    assert!(world.body(body).unwrap().is_sleeping() && !seen.iter().any(|event| event.0 == body));
    // Nor does a sensor wake what is inside it when it becomes another one, or goes.
    let around = world.add_body(BodyDef::fixed(ball(0.5)).sensor(true).position(Vector::unit(1) * 1.2)).unwrap();
    world.step();
    world.set_shape(around, ball(0.6)).unwrap();
    world.step();
    assert_eq!(world.inside(around).collect::<Vec<_>>(), [body]);
    world.remove_body(around).unwrap();
    world.step();
    assert!(world.body(body).unwrap().is_sleeping(), "a sensor that goes wakes who was inside");
}

/// Thrown up from below it passes, comes back, and lies on top; thrown sideways it passes as well.
fn check_one_way<const N: usize>() {
    let mut world = world::<N>(down());
    let mut half = Vector::splat(3.0);
    half[1] = 0.1;
    let turned = Rotation::in_plane(0, 1, std::f64::consts::PI);
    // The body's own −y is the world's +y.
    let def = BodyDef::fixed(cuboid(half)).rotation(turned).one_way(-Vector::unit(1) * 2.0);
    let platform = world.add_body(def).unwrap();
    let shapes = [ball(0.25), cuboid(Vector::splat(0.25))];
    let mut thrown = Vec::new();
    for (shape, k) in shapes.into_iter().zip(0..) {
        let place = Vector::unit(0) * (2.0 * f64::from(k) - 1.0) - Vector::unit(1) * 1.5;
        let def = BodyDef::new(shape).position(place).velocity(Vector::unit(1) * 8.0);
        thrown.push(world.add_body(def).unwrap());
    }
    let place = Vector::unit(0) * -4.0 + Vector::unit(1) * 0.05;
    let def = BodyDef::new(ball(0.2)).position(place).velocity(Vector::unit(0) * 9.0).gravity_scale(0.0);
    let sideways = world.add_body(def).unwrap();
    run(&mut world, 1.0);
    let body = world.body(sideways).unwrap();
    assert!((body.velocity() - Vector::unit(0) * 9.0).norm() < 1e-9, "{:?}", body.velocity());
    run(&mut world, 3.0);
    for &body in &thrown {
        assert!((height(&world, body) - 0.35).abs() < 0.01, "it lies on top: {}", height(&world, body));
    }
    world.body_mut(platform).unwrap().set_one_way(None).unwrap();
    world.body_mut(thrown[0]).unwrap().set_velocity(Vector::unit(1) * -1.0).unwrap();
    run(&mut world, 1.0);
    assert!((height(&world, thrown[0]) - 0.35).abs() < 0.01);
    assert!(world.body_mut(platform).unwrap().set_one_way(Some(Vector::ZERO)).is_err());
}

/// By the hook the floor is ice for one box, a trampoline for a ball, a lift for another, a conveyor for a third.
fn check_hook<const N: usize>() {
    let mut world = world::<N>(down());
    world.add_body(floor_def().material(material(0.5, 0.0)).contact_hook(true)).unwrap();
    let place = |k: f64, height: f64| Vector::unit(0) * (3.0 * k) + Vector::unit(1) * height;
    let mut half = Vector::splat(0.4);
    half[1] = 0.2;
    let boxed = |k: f64| BodyDef::new(cuboid(half)).position(place(k, 0.2)).material(material(0.5, 0.0));
    let ice = world.add_body(boxed(0.0).velocity(Vector::unit(0) * -2.0)).unwrap();
    let rough = world.add_body(boxed(1.0).velocity(Vector::unit(0) * 0.5)).unwrap();
    let bouncing =
        world.add_body(BodyDef::new(ball(0.2)).position(place(2.0, 1.2)).material(material(0.5, 0.0))).unwrap();
    let driven = world.add_body(boxed(3.0)).unwrap();
    let carried = world.add_body(boxed(4.0)).unwrap();
    world.set_contact_hook(move |contact: &mut HookedContact<'_, N>| {
        let (handle, normal) = (contact.bodies().1, contact.normal());
        assert!(contact.body_refs().0.kind() == BodyKind::Static && !contact.points().is_empty());
        if handle == ice {
            contact.set_friction(f64::NAN);
            contact.set_friction(-1.0);
        } else if handle == bouncing {
            contact.set_restitution(7.0);
        } else if handle == driven {
            contact.set_surface_velocity(normal * -3.0);
        } else if handle == carried {
            contact.set_surface_velocity(Vector::unit(0));
        }
    });
    world.step();
    let speed = world.body(driven).unwrap().velocity()[1];
    assert_close("the driven box leaves at", speed, 3.0, 0.02);
    run(&mut world, 2.0);
    assert_close("ice keeps the speed", world.body(ice).unwrap().velocity()[0], -2.0, 1e-3);
    assert!(world.body(rough).unwrap().velocity().norm() < 1e-3);
    assert_close("the carried box goes with the floor", world.body(carried).unwrap().velocity()[0].abs(), 1.0, 1e-2);
    let energy = |world: &World<N>| {
        let body = world.body(bouncing).unwrap();
        0.5 * body.velocity()[1].powi(2) + GRAVITY * body.position()[1]
    };
    assert_close("the ball bounces on", energy(&world), GRAVITY * 1.2, 0.1);
    world.clear_contact_hook();
    run(&mut world, 2.0);
    assert!(world.body(ice).unwrap().velocity().norm() < 1e-3, "without the hook the floor is rough again");
}

fn check_hook_drops<const N: usize>() {
    let mut world = world::<N>(down());
    world.add_body(floor_def()).unwrap();
    let falls =
        world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 0.5).contact_hook(true));
    let falls = falls.unwrap();
    let beside = Vector::unit(1) * 0.5 + Vector::unit(0) * 4.0;
    let stays = world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(beside)).unwrap();
    world.set_contact_hook(|contact: &mut HookedContact<'_, N>| contact.retain_points(|_| false));
    run(&mut world, 0.5);
    assert_close("free fall", 0.5 - height(&world, falls), 0.5 * GRAVITY * 0.25, 0.05);
    assert!((height(&world, stays) - 0.5).abs() < 1e-3);
}

fn ruled_world<const N: usize>(threads: usize) -> World<N> {
    let mut world = World::<N>::new(WorldDef { threads, ..WorldDef::default() }).unwrap();
    add_floor(&mut world, material(0.5, 0.0));
    let mut half = Vector::splat(2.0);
    half[1] = 0.1;
    let platform = BodyDef::fixed(cuboid(half)).position(Vector::unit(1)).one_way(Vector::unit(1)).contact_hook(true);
    world.add_body(platform).unwrap();
    world.add_body(BodyDef::fixed(ball(1.0)).position(Vector::unit(1) * 2.0).sensor(true)).unwrap();
    for k in 0..6 {
        let place = Vector::unit(0) * (0.5 * f64::from(k) - 1.5) + Vector::unit(1) * (0.4 + 0.3 * f64::from(k % 2));
        let shape = if k % 2 == 0 { ball(0.2) } else { cuboid(Vector::splat(0.15)) };
        let def = BodyDef::new(shape).position(place).velocity(Vector::unit(1) * (4.0 + f64::from(k)));
        world.add_body(def).unwrap();
    }
    world.set_contact_hook(|contact: &mut HookedContact<'_, N>| {
        let friction = contact.friction();
        contact.set_friction(0.5 * friction);
        contact.set_restitution(0.3);
    });
    world
}

fn check_bits<const N: usize>() {
    let (mut one, mut two) = (ruled_world::<N>(1), ruled_world::<N>(2));
    run(&mut one, 0.4);
    run(&mut two, 0.4);
    assert_eq!(one.state_hash(), two.state_hash());
    let snapshot = one.snapshot();
    let mut events = Vec::new();
    for _ in 0..60 {
        one.step();
        events.extend_from_slice(one.events().sensors());
    }
    two.restore(&snapshot);
    let mut again = Vec::new();
    for _ in 0..60 {
        two.step();
        again.extend_from_slice(two.events().sensors());
    }
    assert_eq!(one.state_hash(), two.state_hash());
    assert_eq!(events, again);
}

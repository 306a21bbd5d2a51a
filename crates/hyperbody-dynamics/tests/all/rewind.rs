//! Going back by so many steps, to the bit, whatever was added, removed or tied in between; and the bounds of the past.

use crate::common::{Random, add_floor, ball, cuboid, in_all_dimensions, material};
use hyperbody_dynamics::{
    BodyDef, BodyHandle, JointDef, JointHandle, Rewind, World, WorldDef, WorldError, WorldErrorKind,
};
use hyperbody_geometry::Shape;
use hyperbody_math::{Pose, Vector};

in_all_dimensions! {
    the_same_inputs_lead_to_the_same_future: replays;
    a_push_that_came_late_acts_as_if_it_had_been_in_time: rolls_back;
}

/// A heap, and a chain that swings into it.
fn playground<const N: usize>() -> World<N> {
    let mut world = World::<N>::new(WorldDef::default()).unwrap();
    add_floor(&mut world, material(0.5, 0.2));
    let mut random = Random(3);
    for index in 0..8 {
        let shape = if index % 3 == 0 { ball(0.25) } else { cuboid(Vector::splat(0.25)) };
        let position = Vector::unit(1) * (0.3 + 0.6 * f64::from(index)) + random.vector::<N>(0.2);
        world.add_body(BodyDef::new(shape).position(position).rotation(random.rotation(0.5))).unwrap();
    }
    let mut last = None;
    for link in 0..3 {
        let at = Vector::unit(0) * (1.5 + 0.5 * f64::from(link)) + Vector::unit(1) * 3.0;
        let body = world.add_body(BodyDef::new(ball(0.2)).position(at)).unwrap();
        let (here, there) = (Vector::unit(0) * -0.25, Vector::unit(0) * 0.25);
        let from = if last.is_some() { there } else { at + here };
        world.add_joint(JointDef::ball(last, body, from, here)).unwrap();
        last = Some(body);
    }
    world
}

/// What somebody does before step `step`: the same for the same step and the same world.
fn act<const N: usize>(world: &mut World<N>, step: u64) {
    let bodies: Vec<BodyHandle> = world.bodies().map(|(handle, _)| handle).collect();
    let joints: Vec<JointHandle> = world.joints().map(|(handle, _)| handle).collect();
    let mut random = Random(step);
    match step % 11 {
        0 => {
            let at = Vector::unit(1) * 4.0 + random.vector::<N>(0.4);
            world.add_body(BodyDef::new(ball(0.2)).position(at)).unwrap();
        }
        3 => world.remove_body(bodies[1 + step as usize % (bodies.len() - 1)]).unwrap(),
        5 => {
            let (a, b) = (bodies[bodies.len() - 1], bodies[bodies.len() - 2]);
            let frames = [Vector::unit(0) * -0.4, Vector::unit(0) * 0.4].map(Pose::from_translation);
            world.add_joint(JointDef::weld(a, b, frames[0], frames[1]).softness(4.0, 0.5)).unwrap();
        }
        7 if joints.len() > 2 => world.remove_joint(joints[0]).unwrap(),
        9 => {
            let Some(&last) = bodies.last() else { return };
            world.body_mut(last).unwrap().apply_impulse(random.vector::<N>(0.05)).unwrap();
        }
        _ => {}
    }
}

/// Sixty steps with bodies and joints that come and go; then back by every distance, and the same again.
fn replays<const N: usize>() {
    let mut world = playground::<N>();
    let mut past = Rewind::new(60, usize::MAX);
    let mut hashes = Vec::new();
    for step in 0..60 {
        past.record(&world).unwrap();
        hashes.push((world.state_hash(), world.body_count(), world.joint_count()));
        act(&mut world, step);
        world.step();
    }
    assert_eq!((past.len(), past.steps()), (60, Some((0, 59))));
    for back in [1, 2, 7, 30, 60] {
        past.back(&mut world, back).unwrap();
        let step = 60 - back;
        assert_eq!(world.step_count(), step);
        assert_eq!(past.steps(), Some((0, step)), "what came later is forgotten");
        for step in step..60 {
            let now = (world.state_hash(), world.body_count(), world.joint_count());
            assert_eq!(now, hashes[step as usize], "{N}D, back by {back}, at step {step}");
            past.record(&world).unwrap();
            act(&mut world, step);
            world.step();
        }
    }
}

/// As games do: a push that arrives five steps late leads to the bit where it would have led in time, and what was made in steps
/// that never were is refused.
fn rolls_back<const N: usize>() {
    let push = |world: &mut World<N>| {
        let (handle, _) = world.bodies().nth(2).unwrap();
        world.body_mut(handle).unwrap().apply_impulse(Vector::unit(0) * 0.3).unwrap();
    };
    let (mut in_time, mut late) = (playground::<N>(), playground::<N>());
    let mut past = Rewind::new(8, usize::MAX);
    for step in 0..35 {
        if step == 30 {
            push(&mut in_time);
        }
        in_time.step();
        past.record(&late).unwrap();
        late.step();
    }
    assert_ne!(in_time.state_hash(), late.state_hash());
    let newcomer = late.add_body(BodyDef::new(ball(0.1))).unwrap();
    past.back(&mut late, 5).unwrap();
    assert!(late.body(newcomer).is_none(), "made in a future that is no longer");
    push(&mut late);
    for _ in 30..35 {
        late.step();
    }
    assert_eq!(in_time.state_hash(), late.state_hash(), "{N}D");
}

/// A memory bound: what is held stays within it and gives up the oldest; what it says of itself is what it takes.
#[test]
fn the_past_stays_within_its_memory() {
    let mut world = playground::<4>();
    let part = |at: f64| (Pose::from_translation(Vector::unit(0) * at), cuboid(Vector::splat(0.2)));
    let pair = Shape::compound(vec![part(-0.2), part(0.2)]).unwrap();
    world.add_body(BodyDef::new(pair).position(Vector::unit(1) * 6.0)).unwrap();
    // Until much touches.
    for _ in 0..120 {
        world.step();
    }
    let mut past = Rewind::new(usize::MAX, usize::MAX);
    let taken = allocation_counter::measure(|| {
        for _ in 0..20 {
            past.record(&world).unwrap();
        }
    });
    assert_eq!(past.len(), 1, "the same step is held once");
    let said = past.memory() as f64;
    let used = taken.bytes_current as f64;
    assert!((said / used - 1.0).abs() < 0.15, "{said} bytes said, {used} taken");

    let bound = 10 * past.memory();
    let mut past = Rewind::new(1000, bound);
    for step in 0..100 {
        past.record(&world).unwrap();
        assert!(past.memory() <= bound && past.len() <= step + 1);
        world.step();
    }
    let (first, last) = past.steps().unwrap();
    assert_eq!(last, 219);
    assert!((4..=16).contains(&past.len()), "{} moments in ten times the memory of the first", past.len());
    past.back(&mut world, 220 - first).unwrap();
    assert_eq!(world.step_count(), first);
}

fn kind(result: Result<(), WorldError>) -> WorldErrorKind {
    result.unwrap_err().kind()
}

/// Every way to ask for what is not there, and what the message says.
#[test]
fn what_the_past_does_not_hold_is_refused() {
    let mut world = playground::<3>();
    let mut past = Rewind::new(4, usize::MAX);
    assert!(past.is_empty() && past.steps().is_none());
    assert!(past.back(&mut world, 0).unwrap_err().to_string().contains("record every step"));
    for step in 0..10 {
        // Step 7 is left out.
        if step != 7 {
            past.record(&world).unwrap();
        }
        world.step();
    }
    assert_eq!(past.steps(), Some((5, 9)));
    let hash = world.state_hash();
    assert_eq!(kind(past.back(&mut world, 3)), WorldErrorKind::NotHeld);
    assert_eq!(kind(past.back(&mut world, 6)), WorldErrorKind::NotHeld);
    assert_eq!(kind(past.back(&mut world, 11)), WorldErrorKind::NotHeld);
    assert_eq!(kind(past.back(&mut world, u64::MAX)), WorldErrorKind::NotHeld);
    let message = past.back(&mut world, 6).unwrap_err().to_string();
    assert!(message.contains("at step 10") && message.contains("4 of the steps 5 to 9"), "{message}");
    assert_eq!((world.state_hash(), past.len()), (hash, 4), "refusals change nothing");

    assert_eq!(kind(Rewind::new(0, usize::MAX).record(&world)), WorldErrorKind::Full);
    let mut small = Rewind::new(10, 1000);
    assert_eq!(kind(small.record(&world)), WorldErrorKind::Full);
    assert!(small.is_empty() && small.memory() == 0);

    // Changes between two steps are undone by going back by none.
    past.record(&world).unwrap();
    let (victim, _) = world.bodies().nth(3).unwrap();
    world.remove_body(victim).unwrap();
    past.back(&mut world, 0).unwrap();
    assert!(world.body(victim).is_some());
    assert_eq!(world.state_hash(), hash);
}

//! Nets of ball joints, which are swept: against the same nets solved exactly, against their weight, and against what nature keeps.

use crate::common::{GRAVITY, Random, ball, down, in_all_dimensions};
use hyperbody_dynamics::{BodyDef, BodyHandle, Groups, JointDef, Tuning, World, WorldDef};
use hyperbody_math::{Bivector, Vector, planes};

in_all_dimensions! {
    a_free_net_keeps_both_momenta: check_free;
    a_net_that_falls_gains_no_energy: check_fall;
}

/// Balls of a net, a metre apart along x and the last axis.
const SIDE: usize = 10;

/// Enough for the whole net to be solved together.
const EXACT: f64 = 1e9;

fn world<const N: usize>(gravity: Vector<N>, joint_budget: f64) -> World<N> {
    let tuning = Tuning { joint_budget, ..Tuning::default() };
    World::new(WorldDef { gravity, tuning, sleeping: false, ..WorldDef::default() }).unwrap()
}

/// Adds a net of balls; `held` tells which ones are fixed, by row and column.
fn add_net<const N: usize>(
    world: &mut World<N>,
    def: impl Fn(Vector<N>) -> BodyDef<N>,
    held: impl Fn(usize, usize) -> bool,
    groups: Groups,
) -> Vec<BodyHandle> {
    let mut knots: Vec<BodyHandle> = Vec::new();
    for i in 0..SIDE {
        for j in 0..SIDE {
            let at = Vector::unit(0) * i as f64 + Vector::unit(N - 1) * j as f64;
            let knot = if held(i, j) { BodyDef::fixed(ball(0.25)).position(at) } else { def(at) };
            let knot = world.add_body(knot.groups(groups)).unwrap();
            let left = (i > 0).then(|| (knots[(i - 1) * SIDE + j], 0));
            let behind = (j > 0).then(|| (knots[i * SIDE + j - 1], N - 1));
            for (neighbour, axis) in left.into_iter().chain(behind) {
                let half = Vector::unit(axis) * 0.5;
                world.add_joint(JointDef::ball(neighbour, knot, half, -half)).ok();
            }
            knots.push(knot);
        }
    }
    knots
}

fn gap<const N: usize>(world: &World<N>) -> f64 {
    let gaps = world.joints().map(|(_, joint)| {
        let def = joint.def();
        let place = |body: BodyHandle, anchor| world.body(body).unwrap().pose().transform_point(anchor);
        (place(def.b, def.frame_b.translation) - place(def.a.unwrap(), def.frame_a.translation)).norm()
    });
    gaps.fold(0.0, f64::max)
}

fn total<const N: usize>(world: &World<N>) -> f64 {
    let energy = world.energy();
    energy.kinetic + energy.potential
}

/// Every ball flies and spins as it likes, so the first step has much to mend; all in all nothing is lost but energy.
fn check_free<const N: usize>() {
    let mut world = world::<N>(Vector::ZERO, Tuning::default().joint_budget);
    let seed = std::cell::RefCell::new(Random(5));
    let def = |at| {
        let mut random = seed.borrow_mut();
        let mut spin = Bivector::ZERO;
        for (i, j) in planes::all(N) {
            spin.set(i, j, random.between(-3.0, 3.0));
        }
        let mass = random.between(0.5, 2.0);
        BodyDef::new(ball(0.25)).mass(mass).position(at).velocity(random.vector(2.0)).angular_velocity(spin)
    };
    add_net(&mut world, def, |_, _| false, Groups::NONE);
    let (momentum, spin, energy) = (world.momentum(), world.angular_momentum(), world.energy().kinetic);
    let (mut size, mut spin_size) = (0.0, 0.0);
    for (_, body) in world.bodies() {
        let momentum = body.mass() * body.velocity().norm();
        size += momentum;
        spin_size += momentum * body.position().norm() + body.angular_momentum().norm();
    }
    for step in 0..120 {
        world.step();
        let off = (world.momentum() - momentum).norm() / size;
        assert!(off < 5e-7, "{N}D: momentum off by {off:e} of {size} at step {step}");
        let off = (world.angular_momentum() - spin).norm() / spin_size;
        assert!(off < 5e-7, "{N}D: angular momentum off by {off:e} of {spin_size} at step {step}");
        let now = world.energy().kinetic;
        assert!(now < energy * 1.001, "{N}D: energy grew from {energy} to {now} at step {step}");
    }
    assert!(gap(&world) < 0.01, "{N}D: joints {} m apart", gap(&world));
}

/// A curtain on a rod, with air that brings it to rest. (Between two corners it would be taut, and its sag the root of what it gives.)
fn check_exact<const N: usize>() {
    let hung = |joint_budget| {
        let mut world = world::<N>(down(), joint_budget);
        let def = |at| BodyDef::new(ball(0.25)).mass(1.0).position(at).linear_damping(2.0);
        let knots = add_net(&mut world, def, |i, _| i == 0, Groups::NONE);
        (0..600).for_each(|_| world.step());
        (world, knots)
    };
    let ((swept, knots), (exact, others)) = (hung(Tuning::default().joint_budget), hung(EXACT));
    let place = |world: &World<N>, knot: BodyHandle| world.body(knot).unwrap().position();
    let apart = knots.iter().zip(&others).map(|(&a, &b)| (place(&swept, a) - place(&exact, b)).norm());
    let apart = apart.fold(0.0, f64::max);
    println!("{N}D: {apart} m apart, gaps {} and {} m", gap(&swept), gap(&exact));
    assert!(apart > 0.0, "{N}D: the net was solved exactly both times");
    assert!(apart < 0.002, "{N}D: {apart} m apart");
    assert!(gap(&swept) < 0.001 && gap(&exact) < 0.001, "{N}D: joints {} and {} m apart", gap(&swept), gap(&exact));
    // The rod bears the whole net.
    let held = |knot: Option<BodyHandle>| knot.is_some_and(|knot| knots[..SIDE].contains(&knot));
    let mut force = Vector::ZERO;
    for (_, joint) in swept.joints() {
        if held(joint.def().a) {
            force += joint.force();
        }
        if held(Some(joint.def().b)) {
            force -= joint.force();
        }
    }
    let weight = GRAVITY * (SIDE * SIDE - SIDE) as f64;
    let off = (force - Vector::unit(1) * weight).norm() / weight;
    assert!(off < 0.01, "{N}D: the rod bears {force:?} N in place of {weight} N");
}

/// In the plane such a net is cheap enough to be solved exactly.
#[test]
fn a_hanging_net_is_where_an_exact_one_is() {
    check_exact::<3>();
    check_exact::<4>();
}

/// Let go flat, held by one corner, and hit: it whips, and neither opens far nor gains anything.
fn check_fall<const N: usize>() {
    let mut world = world::<N>(down(), Tuning::default().joint_budget);
    let def = |at: Vector<N>| {
        let hit = if at[0] < 3.0 { Vector::unit(1) * 5.0 } else { Vector::ZERO };
        BodyDef::new(ball(0.25)).mass(1.0).position(at).velocity(hit)
    };
    add_net(&mut world, def, |i, j| i == 0 && j == 0, Groups::NONE);
    let start = total(&world);
    let weight = GRAVITY * (SIDE * SIDE) as f64;
    for step in 0..480 {
        world.step();
        let gained = total(&world) - start;
        assert!(gained < 1e-3 * weight, "{N}D: {gained} J gained at step {step}");
        assert!(gap(&world) < 0.2, "{N}D: joints {} m apart at step {step}", gap(&world));
    }
}

/// A ball falls onto a net of balls that hangs by its four corners, and lies on it.
#[test]
fn a_net_catches_a_ball() {
    let mut world = world::<3>(down(), Tuning::default().joint_budget);
    let corner = |k| k == 0 || k == SIDE - 1;
    let knot = |at| BodyDef::new(ball(0.45)).mass(0.5).position(at);
    add_net(&mut world, knot, |i, j| corner(i) && corner(j), Groups::ALL);
    let at = Vector::from([4.5, 3.0, 4.5]);
    let caught = world.add_body(BodyDef::new(ball(1.0)).mass(20.0).position(at)).unwrap();
    for step in 0..600 {
        world.step();
        assert!(gap(&world) < 0.1, "joints {} m apart at step {step}", gap(&world));
    }
    let body = world.body(caught).unwrap();
    assert!(world.contacts().count() >= 3, "the ball touches {} knots", world.contacts().count());
    assert!(body.position()[1] > 0.0 && body.velocity().norm() < 0.5, "the ball is at {:?}", body.position());
}

/// In the middle of a fall, with impulses that are carried on.
#[test]
fn the_future_of_a_net_repeats_from_a_snapshot() {
    let mut world = world::<3>(down(), Tuning::default().joint_budget);
    let corner = |k| k == 0 || k == SIDE - 1;
    let knot = |at| BodyDef::new(ball(0.25)).position(at);
    add_net(&mut world, knot, |i, j| corner(i) && corner(j), Groups::NONE);
    (0..40).for_each(|_| world.step());
    let snapshot = world.snapshot();
    (0..60).for_each(|_| world.step());
    let hash = world.state_hash();
    world.restore(&snapshot);
    (0..60).for_each(|_| world.step());
    assert_eq!(world.state_hash(), hash);
}

/// A net is swept without taking anything from the heap.
#[test]
fn steps_of_nets_take_nothing_from_the_heap() {
    let mut world = world::<4>(down(), Tuning::default().joint_budget);
    let knot = |at| BodyDef::new(ball(0.25)).position(at).linear_damping(2.0);
    add_net(&mut world, knot, |i, _| i == 0, Groups::NONE);
    (0..600).for_each(|_| world.step());
    let taken = allocation_counter::measure(|| (0..30).for_each(|_| world.step()));
    assert_eq!(taken.count_total, 0, "{taken:?}");
}

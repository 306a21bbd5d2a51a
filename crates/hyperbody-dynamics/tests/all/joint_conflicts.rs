//! Joints that ask for the same twice, or for what cannot be: they share the load, meet half way and come to rest. Nothing
//! turns into no number, momenta are kept. Ball joints on short arms that are off by more than the body's size whip it round first:
//! of them only that is asked that every number stays one.

use crate::common::{ball, cuboid, down, in_all_dimensions, run, world};
use hyperbody_dynamics::{BodyDef, BodyHandle, Freedom, Groups, JointDef, World};
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

in_all_dimensions! {
    contradictions_with_the_world_come_to_rest: with_the_world;
    contradictions_between_free_bodies_keep_their_momenta: between_bodies;
    twice_the_same_joint_holds_as_one: twice_the_same;
    joints_far_from_their_places_draw_bodies_in: far_off;
    loops_with_more_rows_than_motions_stay_closed: closed_loop;
}

fn bar<const N: usize>() -> BodyDef<N> {
    BodyDef::new(cuboid(Vector::from_fn(|i| 0.2 + 0.05 * i as f64)))
}

fn shifted<const N: usize>(by: f64) -> Pose<N> {
    Pose::from_translation(Vector::unit(0) * by)
}

/// The fastest that anything has been over some time; all must have stayed sound.
fn fastest<const N: usize>(world: &mut World<N>, seconds: f64, what: &str) -> f64 {
    let mut fastest: f64 = 0.0;
    for step in 0..(seconds / world.dt()) as usize {
        world.step();
        for (handle, body) in world.bodies() {
            assert!(!body.is_quarantined(), "{N}D, {what}: {handle:?} is no number at step {step}");
            fastest = fastest.max(body.velocity().norm() + body.angular_velocity().norm());
        }
    }
    fastest
}

/// What contradicts what, as joints of one body with the world, and how far from its place it may come, m or rad.
fn contradictions<const N: usize>(body: BodyHandle, by: f64) -> Vec<(&'static str, Vec<JointDef<N>>)> {
    let (here, there) = (Pose::IDENTITY, shifted(by));
    let anchor = |k: usize, pose: Pose<N>| pose.transform_point(Vector::unit(k) * 0.3);
    let ball = |k: usize, pose| JointDef::ball(None, body, anchor(k, pose), Vector::unit(k) * 0.3);
    let turned = Pose::new(Rotation::in_plane(0, 1, by), Vector::ZERO);
    let all: Vec<usize> = (0..N).collect();
    let limited = Freedom { limits: Some((by, by + 0.5)), ..Freedom::FREE };
    vec![
        ("two welds", vec![JointDef::weld(None, body, here, here), JointDef::weld(None, body, there, here)]),
        (
            "two welds that are turned",
            vec![JointDef::weld(None, body, here, here), JointDef::weld(None, body, turned, here)],
        ),
        ("a lock and a ball joint", vec![JointDef::lock(body, here, &all, &[]), ball(0, there)]),
        ("ball joints beside each other", (0..N).map(|k| ball(k, if k == 0 { there } else { here })).collect()),
        (
            "rods that do not meet",
            vec![
                JointDef::distance(None, body, Vector::unit(0) * -1.0, Vector::ZERO, 1.0),
                JointDef::distance(None, body, Vector::unit(0) * (1.0 + by), Vector::ZERO, 1.0),
            ],
        ),
        (
            "rods in the shape of ropes, both too short",
            vec![
                JointDef::rope(None, body, Vector::unit(0) * -1.0, Vector::ZERO, 1.0),
                JointDef::rope(None, body, Vector::unit(0) * (1.0 + by), Vector::ZERO, 1.0),
            ],
        ),
        (
            "limits that leave no place",
            vec![
                JointDef::slider(None, body, here, here, 0)
                    .axis(0, Freedom { limits: Some((-0.5, 0.0)), ..Freedom::FREE }),
                JointDef::slider(None, body, here, here, 0).axis(0, limited),
            ],
        ),
        (
            "a weld and a limit",
            vec![
                JointDef::weld(None, body, here, here),
                JointDef::hinge(None, body, here, here, (0, 1)).plane(0, 1, limited),
            ],
        ),
        (
            "a weld and a motor",
            vec![
                JointDef::weld(None, body, here, here),
                JointDef::hinge(None, body, here, here, (0, 1)).motor(0, 1, 5.0, 20.0),
            ],
        ),
    ]
}

/// A body of half a metre that joints pull to places 1 cm, 20 cm and 2 m apart, under its weight.
fn with_the_world<const N: usize>() {
    for by in [0.01, 0.2, 2.0] {
        let cases = {
            let mut world = world::<N>(down());
            let body = world.add_body(bar()).unwrap();
            contradictions::<N>(body, by).len()
        };
        for case in 0..cases {
            let mut world = world::<N>(down());
            let body = world.add_body(bar()).unwrap();
            let (what, defs) = contradictions(body, by).swap_remove(case);
            for def in defs {
                world.add_joint(def).unwrap();
            }
            let whips = what.starts_with("ball joints") && by > 1.0;
            let what = format!("{what} by {by}");
            let speed = fastest(&mut world, 6.0, &what);
            if whips {
                continue;
            }
            assert!(speed < 30.0, "{N}D, {what}: {speed} m/s or rad/s");
            // Rods leave it free to swing about what they agree on.
            if what.starts_with("rods") {
                continue;
            }
            let now = world.body(body).unwrap();
            let left = now.velocity().norm() + now.angular_velocity().norm();
            assert!(left < 2e-3, "{N}D, {what}: {left} m/s or rad/s are left");
            let off = now.position().norm();
            assert!(off < by + 0.01, "{N}D, {what}: ends {off} m away");
        }
    }
}

/// A body 2 m from where its joint wants it, turned by up to half a turn in all planes: it comes, and is not thrown.
fn far_off<const N: usize>() {
    let within = Freedom { limits: Some((-0.2, 0.2)), ..Freedom::FREE };
    for angle in [1.0, 3.0] {
        let turn = Bivector::from_fn(|i, j| angle * (0.6 + 0.1 * i as f64 - 0.13 * j as f64));
        let frame = Pose::new(Rotation::exp(&turn), Vector::unit(0) * 2.0);
        for case in 0..5 {
            let mut world = world::<N>(Vector::ZERO);
            let body = world.add_body(bar()).unwrap();
            let post = world.add_body(BodyDef::fixed(ball(0.1)).groups(Groups::NONE)).unwrap();
            let here = Pose::IDENTITY;
            let (what, def) = match case {
                0 => ("weld", JointDef::weld(body, post, frame, here)),
                1 => ("slider within limits", JointDef::slider(body, post, frame, here, 0).axis(0, within)),
                2 => ("hinge", JointDef::hinge(body, post, frame, here, (0, 1))),
                3 => ("hinge within limits", JointDef::hinge(body, post, frame, here, (0, 1)).plane(0, 1, within)),
                _ => ("rope", JointDef::rope(body, post, frame.translation, Vector::ZERO, 0.5)),
            };
            let joint = world.add_joint(def).unwrap();
            let what = format!("{what}, off by {angle} rad");
            let speed = fastest(&mut world, 8.0, &what);
            assert!(speed < 50.0, "{N}D, {what}: {speed} m/s or rad/s");
            let def = world.joint(joint).unwrap().def();
            let anchor = world.body(body).unwrap().pose().transform_point(def.frame_a.translation);
            assert!(anchor.norm() < 0.51, "{N}D, {what}: ends {} m away", anchor.norm());
        }
    }
}

/// Two bodies in empty space, welded twice with 1 cm and 30 cm between the two places: they come to rest against each other, and
/// the pair goes on as it did.
fn between_bodies<const N: usize>() {
    for by in [0.01, 0.3] {
        let mut world = world::<N>(Vector::ZERO);
        let drift = Vector::unit(1) * 0.5;
        let a = world.add_body(bar().velocity(drift)).unwrap();
        let b = world.add_body(bar().position(Vector::unit(0) * 1.5).velocity(drift)).unwrap();
        let place = shifted(0.75);
        world.add_joint(JointDef::weld(a, b, place, shifted(-0.75))).unwrap();
        world.add_joint(JointDef::weld(a, b, place, shifted(-0.75 + by))).unwrap();
        let (momentum, spin) = (world.momentum(), world.angular_momentum());
        let speed = fastest(&mut world, 5.0, "two welds");
        assert!(speed < 10.0, "{N}D, by {by}: {speed} m/s or rad/s");
        let size = momentum.norm();
        let off = (world.momentum() - momentum).norm() / size;
        let spin_off = (world.angular_momentum() - spin).norm() / size;
        assert!(off < 1e-6 && spin_off < 1e-6, "{N}D, by {by}: momenta off by {off:e} and {spin_off:e}");
        let apart = world.body(b).unwrap().velocity() - world.body(a).unwrap().velocity();
        assert!(apart.norm() < 1e-3, "{N}D, by {by}: they move by {} m/s against each other", apart.norm());
    }
}

/// A weight at the end of an arm, on one weld and on three of the same: it hangs as low.
fn twice_the_same<const N: usize>() {
    let sag = |copies: usize| {
        let mut world = world::<N>(down());
        let body = world.add_body(bar().position(Vector::unit(0) * 1.0)).unwrap();
        for _ in 0..copies {
            world.add_joint(JointDef::weld(None, body, Pose::IDENTITY, shifted(-1.0))).unwrap();
        }
        run(&mut world, 3.0);
        let now = world.body(body).unwrap();
        assert!(now.velocity().norm() < 1e-4, "{N}D: {} m/s with {copies} welds", now.velocity().norm());
        -now.position()[1]
    };
    let (one, three) = (sag(1), sag(3));
    assert!(one < 2e-3 && three <= one + 1e-6 && three > -1e-6, "{N}D: {one} m with one weld, {three} m with three");
}

/// Four bars on hinges of one plane that close to a square: from 3D on there are more rows than motions to hold. Falling
/// from one corner it swings, stays closed and gains nothing.
fn closed_loop<const N: usize>() {
    let mut world = world::<N>(down());
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, -1.0], [0.0, -1.0]];
    let point = |k: usize| {
        let [x, y]: [f64; 2] = corners[k % 4];
        Vector::<N>::unit(0) * x + Vector::unit(1) * y
    };
    let bars: Vec<BodyHandle> = (0..4)
        .map(|k| world.add_body(BodyDef::new(ball(0.1)).position((point(k) + point(k + 1)) * 0.5)).unwrap())
        .collect();
    let ends = |k: usize, end: usize| Pose::from_translation(point(end) - (point(k) + point(k + 1)) * 0.5);
    for k in 0..4 {
        let (a, b) = (k, (k + 1) % 4);
        let def = JointDef::hinge(bars[a], bars[b], ends(a, k + 1), ends(b, k + 1), (0, 1));
        world.add_joint(def).unwrap();
    }
    world.add_joint(JointDef::hinge(None, bars[0], Pose::from_translation(point(0)), ends(0, 0), (0, 1))).unwrap();
    let start = world.energy().total();
    let fell = GRAVITY_OF_ALL * world.bodies().map(|(_, body)| body.mass()).sum::<f64>();
    for step in 0..600 {
        world.step();
        let gained = world.energy().total() - start;
        assert!(gained < 0.01 * fell, "{N}D: {gained} J gained by step {step}");
        for (_, joint) in world.joints() {
            let def = joint.def();
            let at = |body: Option<BodyHandle>, frame: &Pose<N>| match body {
                Some(body) => world.body(body).unwrap().pose().transform_point(frame.translation),
                None => frame.translation,
            };
            let gap = at(def.a, &def.frame_a).distance(at(Some(def.b), &def.frame_b));
            assert!(gap < 5e-3, "{N}D: {gap} m open at step {step}");
        }
    }
}

/// g times a metre, J/kg.
const GRAVITY_OF_ALL: f64 = 9.81;

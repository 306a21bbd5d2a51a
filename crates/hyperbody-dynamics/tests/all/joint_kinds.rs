//! Each joint against mechanics: what it keeps, what it leaves free, how its motors, limits and springs push.

use crate::common::{Random, assert_close, ball, cuboid, down, elliptic_k, run, world};
use hyperbody_dynamics::{
    BodyDef, BodyHandle, Freedom, JointDef, JointHandle, Motor, Spring, World, WorldDef, WorldErrorKind,
};
use hyperbody_math::{Bivector, Pose, Rotation, Vector, planes};

/// A box, not isotropic, at the origin of a world without gravity, jointed to a second one.
fn pair<const N: usize>(
    joint: impl Fn(BodyHandle, BodyHandle) -> JointDef<N>,
) -> (World<N>, [BodyHandle; 2], JointHandle) {
    let mut world = world(Vector::<N>::ZERO);
    let shape = || cuboid(Vector::from_fn(|i| 0.2 + 0.1 * i as f64));
    let a = world.add_body(BodyDef::new(shape())).unwrap();
    let b = world.add_body(BodyDef::new(shape()).position(Vector::unit(0) * 2.0)).unwrap();
    let joint = world.add_joint(joint(a, b)).unwrap();
    (world, [a, b], joint)
}

/// The second frame in the first.
fn relative<const N: usize>(world: &World<N>, joint: JointHandle) -> Pose<N> {
    let def = world.joint(joint).unwrap().def();
    let a = world.body(def.a.unwrap()).unwrap().pose() * def.frame_a;
    a.relative(&(world.body(def.b).unwrap().pose() * def.frame_b))
}

/// Pushed and turned at random for a few seconds, a joint keeps what it says it keeps, moves in all that it leaves free, and
/// the momentum and the angular momentum of the two stay what the pushes gave.
fn keeps_and_frees<const N: usize>(name: &str, def: impl Fn(BodyHandle, BodyHandle) -> JointDef<N>) {
    let (mut world, bodies, joint) = pair(def);
    let mut random = Random(17);
    let (mut given, mut given_spin) = (Vector::<N>::ZERO, Bivector::<N>::ZERO);
    let mut moved = [0.0_f64; N];
    let mut turned = vec![0.0_f64; planes::count(N)];
    for step in 0..240 {
        if step % 20 == 0 {
            for body in bodies {
                let impulse = random.vector::<N>(0.1) * world.body(body).unwrap().mass();
                let offset = random.vector::<N>(0.3);
                let mut body = world.body_mut(body).unwrap();
                let at = body.as_ref().position() + offset;
                body.apply_impulse_at(impulse, at).unwrap();
                given += impulse;
                given_spin += Bivector::wedge(at, impulse);
            }
        }
        world.step();
        let pose = relative(&world, joint);
        let def = world.joint(joint).unwrap().def();
        for axis in 0..N {
            let offset = pose.translation[axis].abs();
            moved[axis] = moved[axis].max(offset);
            assert!(
                !def.axes[axis].locked || offset < 2e-3,
                "{name} in {N}D: {offset} m along axis {axis} at step {step}"
            );
        }
        let twist = pose.rotation.log();
        for (k, (i, j)) in planes::all(N).enumerate() {
            turned[k] = turned[k].max(twist.get(i, j).abs());
            // What is locked lies between the groups: there the matrix itself has no entry.
            let off = pose.rotation.matrix()[i][j].abs().max(pose.rotation.matrix()[j][i].abs());
            assert!(!def.planes[k].locked || off < 4e-3, "{name} in {N}D: {off} in plane ({i}, {j}) at step {step}");
        }
    }
    let def = world.joint(joint).unwrap().def();
    for axis in (0..N).filter(|&axis| !def.axes[axis].locked) {
        assert!(moved[axis] > 0.01, "{name} in {N}D: axis {axis} is free, but moved by {} only", moved[axis]);
    }
    for (k, plane) in planes::all(N).enumerate().filter(|(k, _)| !def.planes[*k].locked) {
        assert!(turned[k] > 0.01, "{name} in {N}D: plane {plane:?} is free, but turned by {} only", turned[k]);
    }
    let error = (world.momentum() - given).norm();
    assert!(error < 1e-5, "{name} in {N}D: the joint changed the momentum by {error}");
    let error = (world.angular_momentum() - given_spin).norm();
    assert!(error < 1e-5, "{name} in {N}D: the joint changed the angular momentum by {error}");
}

fn all_kinds<const N: usize>() {
    let frame_a = Pose::from_translation(Vector::unit(0));
    let frame_b = Pose::from_translation(-Vector::unit(0));
    keeps_and_frees::<N>("ball", |a, b| JointDef::ball(a, b, Vector::unit(0), -Vector::unit(0)));
    keeps_and_frees::<N>("weld", |a, b| JointDef::weld(a, b, frame_a, frame_b));
    keeps_and_frees::<N>("hinge", |a, b| JointDef::hinge(a, b, frame_a, frame_b, (0, 1)));
    keeps_and_frees::<N>("slider", |a, b| JointDef::slider(a, b, frame_a, frame_b, 1));
    for kept in 1..N - 1 {
        keeps_and_frees::<N>(&format!("axle of {kept}"), |a, b| JointDef::axle(a, b, frame_a, frame_b, kept));
    }
    keeps_and_frees::<N>("ball on a rail", |a, b| {
        JointDef::ball(a, b, Vector::unit(0), -Vector::unit(0)).axis(0, Freedom::FREE)
    });
}

#[test]
fn joints_keep_what_they_keep_and_free_what_they_free() {
    all_kinds::<2>();
    all_kinds::<3>();
    all_kinds::<4>();
    all_kinds::<5>();
    all_kinds::<6>();
}

/// A motor of torque τ speeds a hinge up at τ/I until it has its speed, and then holds it.
fn motor<const N: usize>() {
    let mut world = world(Vector::<N>::ZERO);
    let half = Vector::<N>::from_fn(|i| 0.3 + 0.1 * i as f64);
    let wheel = world.add_body(BodyDef::new(cuboid(half)).mass(2.0)).unwrap();
    let (i, j) = (0, N - 1);
    let def = JointDef::hinge(None, wheel, Pose::IDENTITY, Pose::IDENTITY, (i, j)).motor(i, j, 4.0, 1.0);
    let hinge = world.add_joint(def).unwrap();
    run(&mut world, 0.5);
    let moments = world.body(wheel).unwrap().principal_moments();
    let mut sorted: Vec<f64> = moments.iter().collect();
    sorted.sort_by(f64::total_cmp);
    let moment = 2.0 * (half[i] * half[i] + half[j] * half[j]) / 3.0;
    let rate = |world: &World<N>| world.body(wheel).unwrap().angular_velocity().get(i, j);
    assert_close(&format!("{N}D rate after half a second"), rate(&world), 0.5 / moment, 1e-3);
    run(&mut world, 10.0);
    assert_close(&format!("{N}D final rate"), rate(&world), 4.0, 1e-4);
    // Changed while it runs, it turns the other way.
    let def = world.joint(hinge).unwrap().def().clone().motor(i, j, -1.0, 1.0);
    world.set_joint(hinge, def).unwrap();
    run(&mut world, 10.0);
    assert_close(&format!("{N}D rate after the change"), rate(&world), -1.0, 1e-4);
}

#[test]
fn a_motor_has_torque_and_speed() {
    motor::<2>();
    motor::<3>();
    motor::<4>();
    motor::<6>();
}

/// A pendulum on a hinge with limits stops at the limit and does not pass it.
fn limits<const N: usize>() {
    let mut world = world(down::<N>());
    let rod = BodyDef::new(cuboid(Vector::from_fn(|i| if i == 0 { 0.5 } else { 0.1 }))).position(Vector::unit(0) * 0.5);
    let rod = world.add_body(rod).unwrap();
    let frame_b = Pose::from_translation(Vector::unit(0) * -0.5);
    let def = JointDef::hinge(None, rod, Pose::IDENTITY, frame_b, (0, 1)).angle_limits(0, 1, -0.6, 0.2);
    world.add_joint(def).unwrap();
    let angle = |world: &World<N>| {
        let matrix = *world.body(rod).unwrap().rotation().matrix();
        matrix[1][0].atan2(matrix[0][0])
    };
    let mut least: f64 = 0.0;
    for _ in 0..300 {
        world.step();
        least = least.min(angle(&world));
    }
    assert!(least > -0.605, "fell to {least} rad, beyond the limit");
    assert!((angle(&world) + 0.6).abs() < 2e-3, "rests at {} rad", angle(&world));
    let spin = Bivector::plane(0, 1, 8.0);
    let centre = world.body(rod).unwrap().position();
    world.body_mut(rod).unwrap().set_angular_velocity(spin).unwrap();
    world.body_mut(rod).unwrap().set_velocity(spin.act_on(centre)).unwrap();
    let mut greatest: f64 = -1.0;
    for _ in 0..60 {
        world.step();
        greatest = greatest.max(angle(&world));
    }
    assert!(greatest > 0.15 && greatest < 0.205, "swung to {greatest} rad");
}

#[test]
fn limits_hold() {
    limits::<2>();
    limits::<3>();
    limits::<4>();
    limits::<6>();
}

/// A slider with a spring swings at the spring's frequency, whatever the mass, and under weight sags by g/ω².
fn spring<const N: usize>() {
    let (hz, mass) = (1.0, 7.0);
    let omega = std::f64::consts::TAU * hz;
    let mut world =
        World::<N>::new(WorldDef { gravity: down(), dt: 1.0 / 960.0, sleeping: false, ..WorldDef::default() }).unwrap();
    let sag = 9.81 / (omega * omega);
    let start = Vector::unit(1) * (0.5 - sag);
    let body = world.add_body(BodyDef::new(ball(0.2)).mass(mass).position(start)).unwrap();
    let spring = Spring { target: 0.0, hz, damping_ratio: 0.0, max_force: f64::INFINITY };
    let freedom = Freedom { spring: Some(spring), ..Freedom::FREE };
    world.add_joint(JointDef::slider(None, body, Pose::IDENTITY, Pose::IDENTITY, 1).axis(1, freedom)).unwrap();
    for step in 1..=960 {
        world.step();
        let expected = 0.5 * (omega * f64::from(step) / 960.0).cos() - sag;
        let y = world.body(body).unwrap().position()[1];
        assert!((y - expected).abs() < 0.01, "{N}D: at {y} after {step} steps, not {expected}");
    }
}

#[test]
fn a_spring_swings_at_its_frequency() {
    spring::<2>();
    spring::<3>();
    spring::<5>();
}

/// A spring that holds a hinge near half a turn swings about its target across the half turn, and not all the way round.
#[test]
fn a_spring_of_a_plane_takes_the_short_way_round() {
    let mut world = world(Vector::<4>::ZERO);
    let start = Pose::new(Rotation::in_plane(0, 3, 2.5), Vector::ZERO);
    let body = world.add_body(BodyDef::new(cuboid(Vector::splat(0.3))).rotation(start.rotation)).unwrap();
    let spring = Spring { target: 3.0, hz: 1.0, damping_ratio: 0.0, max_force: f64::INFINITY };
    let hinge = JointDef::hinge(None, body, Pose::IDENTITY, Pose::IDENTITY, (0, 3)).angle_spring(0, 3, spring);
    world.add_joint(hinge).unwrap();
    for _ in 0..120 {
        world.step();
        let matrix = world.body(body).unwrap().pose().rotation;
        let off = (matrix * Rotation::in_plane(0, 3, -3.0)).log().norm();
        assert!(off < 0.52, "{off} rad from its target");
    }
}

#[test]
fn a_rod_that_leaves_nothing_counts_nothing() {
    let mut world = world(Vector::<3>::ZERO);
    let body = world.add_body(BodyDef::new(ball(0.3))).unwrap();
    let mut def = JointDef::<3>::ball(None, body, Vector::ZERO, Vector::ZERO);
    def.distance = Some((1.0, 1.0));
    assert_eq!(def.free_motions(), (0, 3));
}

/// A rope is nothing until it is taut: then the load swings on it as a pendulum does.
fn rope<const N: usize>() {
    let mut world = World::<N>::new(WorldDef { dt: 1.0 / 240.0, sleeping: false, ..WorldDef::default() }).unwrap();
    let load = world.add_body(BodyDef::new(ball(0.1)).position(Vector::unit(0) * 0.5)).unwrap();
    world.add_joint(JointDef::rope(None, load, Vector::ZERO, Vector::ZERO, 1.0)).unwrap();
    for step in 1..=60 {
        world.step();
        let t = f64::from(step) / 240.0;
        let position = world.body(load).unwrap().position();
        assert!(
            (position[1] + 0.5 * 9.81 * t * t).abs() < 0.01 && (position[0] - 0.5).abs() < 1e-9,
            "a slack rope pulls"
        );
    }
    let mut longest: f64 = 0.0;
    for _ in 0..1200 {
        world.step();
        longest = longest.max(world.body(load).unwrap().position().norm());
    }
    assert!(longest < 1.003 && longest > 0.999, "the rope was {longest} m long");
}

#[test]
fn a_rope_pulls_only_when_taut() {
    rope::<2>();
    rope::<3>();
    rope::<4>();
    rope::<6>();
}

/// T = 4 K(sin(θ₀/2)) √(l/g) of a rod without weight and a small heavy ball that does not turn with it.
#[test]
fn a_distance_joint_is_a_pendulum_rod() {
    let mut world = World::<4>::new(WorldDef { dt: 1.0 / 240.0, sleeping: false, ..WorldDef::default() }).unwrap();
    let start = Vector([0.0, -0.8, 0.0, 0.6]);
    let bob = world.add_body(BodyDef::new(ball(0.05)).position(start)).unwrap();
    world.add_joint(JointDef::distance(None, bob, Vector::ZERO, Vector::ZERO, 1.0)).unwrap();
    let mut zeros = Vec::new();
    let mut last = start[3];
    while zeros.len() < 7 {
        world.step();
        assert!(world.step_count() < 10_000, "it does not swing");
        let now = world.body(bob).unwrap().position()[3];
        if now * last < 0.0 {
            zeros.push(world.time() - world.dt() * now / (now - last));
        }
        last = now;
    }
    let expected = 4.0 * elliptic_k((0.6_f64.asin() / 2.0).sin()) * (1.0 / 9.81_f64).sqrt();
    assert_close("period", (zeros[6] - zeros[0]) / 3.0, expected, 0.002);
}

/// A body whose axis z is locked, and the planes of z, falls and turns as in two dimensions.
#[test]
fn locked_axes_and_planes_of_a_body() {
    let mut world = world(Vector([1.0, -9.81, 3.0]));
    let pose = Pose::new(Rotation::in_plane(0, 1, 0.3), Vector([1.0, 2.0, 3.0]));
    let body = BodyDef::new(cuboid(Vector([0.2, 0.3, 0.5]))).position(pose.translation).rotation(pose.rotation);
    let body = world.add_body(body.angular_velocity(Bivector::plane(0, 1, 2.0))).unwrap();
    world.add_joint(JointDef::lock(body, pose, &[2], &[(0, 2), (1, 2)])).unwrap();
    world.body_mut(body).unwrap().apply_impulse_at([0.01, 0.0, 0.02], [1.1, 2.1, 3.3]).unwrap();
    run(&mut world, 1.0);
    let now = world.body(body).unwrap();
    assert!((now.position()[2] - 3.0).abs() < 1e-3, "z is {}", now.position()[2]);
    assert!((now.position()[1] - (2.0 - 0.5 * 9.81)).abs() < 0.05, "y is {}", now.position()[1]);
    let tilt = now.rotation().matrix()[2][2];
    assert!(tilt > 0.999_999, "z leans, its cosine is {tilt}");
    assert!(now.angular_velocity().get(0, 1).abs() > 1.0);
}

#[test]
fn joints_that_make_no_sense_are_refused_with_reasons() {
    let mut world = world(Vector::<4>::ZERO);
    let body = world.add_body(BodyDef::new(ball(0.5))).unwrap();
    let free = || JointDef::free(None, body);
    let motor = Freedom { motor: Some(Motor { speed: 1.0, max_force: 1.0 }), ..Freedom::LOCKED };
    let limited = Freedom { limits: Some((-0.5, 0.5)), ..Freedom::FREE };
    let cases = [
        (free().plane(0, 1, Freedom::LOCKED), "add up"),
        (free().plane(0, 1, limited), "angle is not defined"),
        (free().axis(2, motor), "locked"),
        (free().axis(2, Freedom { limits: Some((1.0, 1.0)), ..Freedom::FREE }), "lock what must not move"),
        (JointDef::distance(None, body, Vector::ZERO, Vector::ZERO, 0.0), "ball joint"),
        (JointDef::ball(None, body, Vector::ZERO, Vector::ZERO).break_at(-1.0, 0.0), "break_force"),
    ];
    for (def, hint) in cases {
        let error = world.add_joint(def).unwrap_err();
        assert!(error.to_string().contains(hint), "{error} does not say \"{hint}\"");
        assert!(matches!(error.kind(), WorldErrorKind::BadNumber | WorldErrorKind::NotAllowed));
    }
    assert_eq!(world.joint_count(), 0);
    let axle = JointDef::<4>::axle(None, body, Pose::IDENTITY, Pose::IDENTITY, 1);
    assert_eq!(axle.free_motions(), (0, 3), "an axle of a line in 4D turns in three planes");
}

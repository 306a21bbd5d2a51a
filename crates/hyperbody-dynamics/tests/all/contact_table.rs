//! Closed forms of contact and motion, in every dimension: rolling, sliding, sticking, impact, inclines,
//! the projectile. Every motion stays in one plane, so the forms hold for each n with the moments of its bodies.

use crate::common::*;
use hyperbody_dynamics::{BodyDef, World, WorldDef};
use hyperbody_math::{Bivector, Vector};

macro_rules! every_dimension {
    ($($name:ident),* $(,)?) => {$(
        mod $name {
            #[test] fn in_2d() { super::$name::<2>(); }
            #[test] fn in_3d() { super::$name::<3>(); }
            #[test] fn in_4d() { super::$name::<4>(); }
            #[test] fn in_5d() { super::$name::<5>(); }
            #[test] fn in_6d() { super::$name::<6>(); }
        }
    )*};
}

every_dimension!(
    ball_rolls_down_an_incline,
    ball_slips_on_a_steep_incline,
    sliding_ball_ends_rolling,
    ball_that_sticks_loses_its_share,
    frictionless_corner_impact,
    elastic_impact_of_two_bodies,
    box_rests_on_a_gentle_incline,
    box_slides_on_a_steep_incline,
    tall_box_tips,
    projectile,
);

/// a = g sinθ (n+2)/(n+4) while tanθ ≤ μ(n+4)/2.
fn ball_rolls_down_an_incline<const N: usize>() {
    let angle: f64 = 0.35;
    let n = N as f64;
    let friction = 1.1 * 2.0 * angle.tan() / (n + 4.0);
    let mut world = world(incline_gravity::<N>(angle));
    add_floor(&mut world, material(friction, 0.0));
    let rolling = BodyDef::new(ball(0.5)).position(Vector::unit(1) * 0.5).material(material(friction, 0.0));
    let rolling = world.add_body(rolling).unwrap();
    run(&mut world, 2.0);
    let acceleration = world.body(rolling).unwrap().velocity()[0] / 2.0;
    assert_close("acceleration", acceleration, GRAVITY * angle.sin() * (n + 2.0) / (n + 4.0), 0.005);
    let spin = world.body(rolling).unwrap().angular_velocity().get(0, 1);
    assert_close("spin × radius", -0.5 * spin, world.body(rolling).unwrap().velocity()[0], 0.01);
}

/// Beyond the limit it slips: a = g (sinθ − μ cosθ).
fn ball_slips_on_a_steep_incline<const N: usize>() {
    let angle: f64 = 0.8;
    let friction = 0.8 * 2.0 * angle.tan() / (N as f64 + 4.0);
    let mut world = world(incline_gravity::<N>(angle));
    add_floor(&mut world, material(friction, 0.0));
    let slipping = BodyDef::new(ball(0.5)).position(Vector::unit(1) * 0.5).material(material(friction, 0.0));
    let slipping = world.add_body(slipping).unwrap();
    run(&mut world, 2.0);
    let acceleration = world.body(slipping).unwrap().velocity()[0] / 2.0;
    assert_close("acceleration", acceleration, GRAVITY * (angle.sin() - friction * angle.cos()), 0.01);
}

/// v_end = v₀ (n+2)/(n+4) from t = 2v₀/((n+4)μg) on.
fn sliding_ball_ends_rolling<const N: usize>() {
    let (friction, v0, n) = (0.3, 4.0, N as f64);
    let mut world = world(down::<N>());
    add_floor(&mut world, material(friction, 0.0));
    let sliding = BodyDef::new(ball(0.5)).position(Vector::unit(1) * 0.5).velocity(Vector::unit(0) * v0);
    let sliding = world.add_body(sliding.material(material(friction, 0.0))).unwrap();
    let end = 2.0 * v0 / ((n + 4.0) * friction * GRAVITY);
    run(&mut world, 0.9 * end);
    let at_90 = world.body(sliding).unwrap();
    let slip = at_90.velocity()[0] + 0.5 * at_90.angular_velocity().get(0, 1);
    assert!(slip > 0.02 * v0, "still slipping before the end time, slip {slip}");
    run(&mut world, 0.2 * end + 0.1);
    let rolling = world.body(sliding).unwrap();
    assert_close("final speed", rolling.velocity()[0], v0 * (n + 2.0) / (n + 4.0), 0.005);
    let slip = rolling.velocity()[0] + 0.5 * rolling.angular_velocity().get(0, 1);
    assert!(slip.abs() < 1e-3 * v0, "rolling without slip, got {slip}");
}

/// Tangential impulse −m u_t · 2/(n+4).
fn ball_that_sticks_loses_its_share<const N: usize>() {
    let n = N as f64;
    let (u_t, u_n) = (1.5, 2.0);
    let mut world = world(Vector::<N>::ZERO);
    add_floor(&mut world, material(10.0, 0.0));
    let position = Vector::unit(1) * 0.501;
    let velocity = Vector::unit(0) * u_t - Vector::unit(1) * u_n;
    let sticking = BodyDef::new(ball(0.5)).position(position).velocity(velocity).material(material(10.0, 0.0));
    let sticking = world.add_body(sticking).unwrap();
    run(&mut world, 0.1);
    let after = world.body(sticking).unwrap();
    assert_close("change of speed", after.velocity()[0] - u_t, -u_t * 2.0 / (n + 4.0), 0.005);
    assert!(after.velocity()[1].abs() < 1e-3, "no bounce, got {}", after.velocity()[1]);
}

/// j = −(1+e) u_n / (nᵀ K n) for a box that lands on one corner.
fn frictionless_corner_impact<const N: usize>() {
    for restitution in [0.0, 0.5, 1.0] {
        let half_extents = Vector::from_fn(|i| 0.3 + 0.1 * i as f64);
        let rotation = Random(7).rotation::<N>(0.7);
        let depth = (0..N).map(|i| rotation.matrix()[1][i].abs() * half_extents[i]).sum::<f64>();
        let corner = Vector::from_fn(|i| -half_extents[i] * rotation.matrix()[1][i].signum());
        // Steps so short that no second corner, turned down by the impact, lands within the same one.
        let gravity = Vector::ZERO;
        let def = WorldDef { gravity, sleeping: false, dt: 1e-4, ..WorldDef::default() };
        let mut world = World::<N>::new(def).unwrap();
        add_floor(&mut world, material(0.0, restitution));
        let falling = BodyDef::new(cuboid(half_extents))
            .rotation(rotation)
            .position(Vector::unit(1) * (depth + 1e-6))
            .velocity(Vector::unit(1) * -3.0)
            .material(material(0.0, restitution));
        let falling = world.add_body(falling).unwrap();
        let energy_before = world.energy().total();
        world.step();
        let body = world.body(falling).unwrap();
        let moments = half_extents.scale(half_extents) * (body.mass() / 3.0);
        let k = response(body.mass(), moments, rotation, rotation.rotate(corner));
        let impulse = (1.0 + restitution) * 3.0 / k[1][1];
        assert_close("impulse", (body.velocity()[1] + 3.0) * body.mass(), impulse, 0.003);
        if restitution == 1.0 {
            assert_close("energy", world.energy().total(), energy_before, 0.003);
        }
    }
}

/// e = 1 keeps energy, momentum and angular momentum.
fn elastic_impact_of_two_bodies<const N: usize>() {
    let mut world = world(Vector::<N>::ZERO);
    let smooth = material(0.0, 1.0);
    let target =
        BodyDef::new(cuboid(Vector::splat(0.5))).material(smooth).angular_velocity(Bivector::plane(0, 1, -0.2));
    world.add_body(target).unwrap();
    let position = Vector::unit(0) * -1.2 + Vector::unit(1) * 0.2;
    let hitting = BodyDef::new(ball(0.4)).position(position).velocity(Vector::unit(0) * 4.0).material(smooth);
    let hitting = world.add_body(hitting).unwrap();
    let (energy, momentum, angular) = (world.energy().total(), world.momentum(), world.angular_momentum());
    run(&mut world, 1.0);
    assert!(world.body(hitting).unwrap().velocity()[0] < 3.0, "they met");
    assert_close("energy", world.energy().total(), energy, 0.005);
    assert!((world.momentum() - momentum).norm() <= 1e-6 * momentum.norm(), "momentum is kept");
    let drift = (world.angular_momentum() - angular).norm();
    assert!(drift <= 0.01 * angular.norm(), "angular momentum is kept, drift {drift} of {}", angular.norm());
}

fn box_on_incline<const N: usize>(angle: f64, friction: f64, half_extents: Vector<N>) -> (World<N>, Vec<f64>) {
    let mut world = world(incline_gravity::<N>(angle));
    add_floor(&mut world, material(friction, 0.0));
    let position = Vector::unit(1) * half_extents[1];
    let body = BodyDef::new(cuboid(half_extents)).position(position).material(material(friction, 0.0));
    let body = world.add_body(body).unwrap();
    let mut speeds = Vec::new();
    for _ in 0..120 {
        world.step();
        speeds.push(world.body(body).unwrap().velocity()[0]);
    }
    (world, speeds)
}

/// Rests iff tanθ ≤ μ …
fn box_rests_on_a_gentle_incline<const N: usize>() {
    let (world, _) = box_on_incline::<N>(0.3, 1.05 * 0.3_f64.tan(), Vector::splat(0.5));
    let (_, body) = world.bodies().nth(1).unwrap();
    assert!(body.position()[0].abs() < 2e-3, "slid by {}", body.position()[0]);
}

/// … else a = g (sinθ − μ cosθ).
fn box_slides_on_a_steep_incline<const N: usize>() {
    let (angle, friction) = (0.5_f64, 0.3);
    let (_, speeds) = box_on_incline::<N>(angle, friction, Vector::splat(0.5));
    let acceleration = speeds[119] / 2.0;
    assert_close("acceleration", acceleration, GRAVITY * (angle.sin() - friction * angle.cos()), 0.005);
}

/// Tips before sliding if tanθ > h_t/h_n, and stands just below.
fn tall_box_tips<const N: usize>() {
    let half_extents = Vector::from_fn(|i| if i == 1 { 1.0 } else { 0.4 });
    let limit = 0.4_f64.atan();
    for (angle, falls) in [(0.95 * limit, false), (1.05 * limit, true)] {
        let (world, _) = box_on_incline::<N>(angle, 2.0, half_extents);
        let (_, body) = world.bodies().nth(1).unwrap();
        let upright = body.rotation().matrix()[1][1];
        assert_eq!(upright < 0.95, falls, "at {angle} rad, with the limit at {limit}, uprightness is {upright}");
    }
}

/// x_k = x₀ + k h v₀ + ½ g h² k(k+1), exactly, with h the substep.
fn projectile<const N: usize>() {
    let gravity = Vector::from_fn(|i| -3.0 + i as f64);
    let mut world = world::<N>(gravity);
    let (x0, v0) = (Random(3).vector::<N>(2.0), Random(4).vector::<N>(5.0));
    let flying = world.add_body(BodyDef::new(ball(0.5)).position(x0).velocity(v0)).unwrap();
    for step in 1..=300 {
        world.step();
        let (k, h) = (4.0 * f64::from(step), world.dt() / 4.0);
        let expected = x0 + v0 * (k * h) + gravity * (0.5 * h * h * k * (k + 1.0));
        let error = (world.body(flying).unwrap().position() - expected).norm();
        assert!(error <= 1e-12 * (1.0 + expected.norm()), "off by {error} after {step} steps");
    }
}

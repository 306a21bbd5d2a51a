//! Contacts of balls have rows of their own; they do what the general rows do.

use hyperbody_dynamics::{BodyDef, BodyHandle, BodyKind, Material, World};
use hyperbody_math::{Bivector, Vector};

use crate::common::{add_floor, assert_close, ball, cuboid, down, in_all_dimensions, world};

in_all_dimensions! {
    balls_move_as_by_general_rows: check_alike;
    a_ball_on_a_half_space_is_met_as_in_general: check_on_half_space;
    a_spinning_ball_that_starts_to_roll_keeps_the_share_of_mechanics: check_start_of_rolling;
}

/// Resistance so small that it does nothing takes a contact to the general rows.
const UNFELT: f64 = 1e-13;

/// Balls that roll, spin, bounce off each other and off a kinematic and a static box.
fn build<const N: usize>(rolling_resistance: f64) -> (World<N>, Vec<BodyHandle>) {
    let mut world = world::<N>(down());
    let material = |restitution: f64| Material { restitution, rolling_resistance, ..Material::default() };
    add_floor(&mut world, material(0.0));
    let wall = BodyDef::fixed(cuboid(Vector::splat(0.5))).position(Vector::unit(0) * 3.0).material(material(0.5));
    world.add_body(wall).unwrap();
    let paddle = BodyDef::new(cuboid(Vector::from_fn(|i| if i == 1 { 0.05 } else { 2.0 })))
        .kind(BodyKind::Kinematic)
        .position(Vector::unit(0) * -4.0)
        .angular_velocity(Bivector::plane(0, 1, 0.4))
        .material(material(0.0));
    world.add_body(paddle).unwrap();
    let mut bodies = Vec::new();
    for k in 0..8_u32 {
        let place = f64::from(k);
        let radius = 0.2 + 0.03 * place;
        let last = Vector::unit(N - 1) * if N > 2 { 0.1 * place } else { 0.0 };
        let position = Vector::unit(0) * (0.55 * place - 4.3) + Vector::unit(1) * (0.35 + 0.2 * place) + last;
        let def = BodyDef::new(ball(radius))
            .position(position)
            .velocity(Vector::unit(0) * (1.0 - 0.3 * place))
            .angular_velocity(Bivector::plane(0, N - 1, 2.0 - 0.5 * place))
            .material(material(if k % 3 == 0 { 0.6 } else { 0.0 }));
        bodies.push(world.add_body(def).unwrap());
    }
    (world, bodies)
}

/// Eleven steps by both kinds of rows, impacts and all, part by roundings in single precision; later collisions make them large:
/// tenfold the one that follows in 4D.
fn check_alike<const N: usize>() {
    let (mut round, bodies) = build::<N>(0.0);
    let (mut general, _) = build::<N>(UNFELT);
    let mut touches = 0;
    for step in 0..11 {
        round.step();
        general.step();
        touches += round.contacts().count();
        for &handle in &bodies {
            let (a, b) = (round.body(handle).unwrap(), general.body(handle).unwrap());
            let (linear, angular) = (a.velocity() - b.velocity(), a.angular_velocity() - b.angular_velocity());
            assert!(linear.norm() < 2e-5, "velocities part by {} in step {step}", linear.norm());
            assert!(angular.norm() < 2e-4, "spins part by {} in step {step}", angular.norm());
            assert!(a.position().distance(b.position()) < 1e-5, "positions part in step {step}");
        }
    }
    assert!(touches > 50, "only {touches} touches");
}

/// Balls that slide and roll on a half-space, the same to the bit where a say of the contact hook, which is not set, has them
/// met the general way.
fn check_on_half_space<const N: usize>() {
    let rolling = |ruled: bool| {
        let mut world = world::<N>(down());
        add_floor(&mut world, Material::default());
        for k in 0..3_u32 {
            let (place, radius) = (f64::from(k), 0.3 + 0.07 * f64::from(k));
            let def = BodyDef::new(ball(radius))
                .position(Vector::unit(0) * (3.0 * place) + Vector::unit(1) * radius)
                .velocity(Vector::unit(0) * (1.0 - 0.7 * place))
                .angular_velocity(Bivector::plane(0, 1, place - 0.5))
                .contact_hook(ruled);
            world.add_body(def).unwrap();
        }
        world
    };
    // Normal, and place, separation and impulse of the point.
    let found = |world: &World<N>| {
        let contacts = world.contacts();
        contacts.map(|contact| (contact.normal(), contact.points().collect::<Vec<_>>())).collect::<Vec<_>>()
    };
    let (mut plain, mut general) = (rolling(false), rolling(true));
    for step in 0..60 {
        plain.step();
        general.step();
        assert_eq!(plain.contacts().count(), 3, "contacts in step {step}");
        assert_eq!(found(&plain), found(&general), "the two ways part in step {step}");
    }
}

/// A ball that is set down spinning, with the backward speed of its lowest point u = ω r, rolls at last with v = u/(1 + m r²/I),
/// whatever the friction: friction acts at the floor alone, so the angular momentum about a point of it stays.
fn check_start_of_rolling<const N: usize>() {
    let (radius, spin) = (0.5, 6.0);
    let mut world = world::<N>(down());
    add_floor(&mut world, Material { friction: 0.3, ..Material::default() });
    let def = BodyDef::new(ball(radius))
        .position(Vector::unit(1) * radius)
        .angular_velocity(Bivector::plane(0, 1, -spin))
        .material(Material { friction: 0.3, ..Material::default() });
    let body = world.add_body(def).unwrap();
    (0..300).for_each(|_| world.step());
    // In n dimensions I = 2 m r²/(n + 2).
    let share = 1.0 / (1.0 + 0.5 * (N as f64 + 2.0));
    let velocity = world.body(body).unwrap().velocity();
    assert_close("speed", velocity[0], spin * radius * share, 2e-3);
    assert!((velocity - Vector::unit(0) * velocity[0]).norm() < 1e-6, "it rolls sideways: {velocity:?}");
}

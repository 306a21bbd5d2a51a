//! Rules by which materials combine, and resistance to rolling and twisting against the closed forms of mechanics.

use hyperbody_dynamics::{BodyDef, CombineRule, Material, World};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Vector};

use crate::common::{GRAVITY, add_floor, assert_close, ball, cuboid, down, in_all_dimensions, world};

in_all_dimensions! {
    the_rule_named_later_in_the_list_wins: check_rules;
    a_rolling_ball_stops_at_the_predicted_distance: check_rolling;
    rolling_resistance_holds_a_ball_on_a_gentle_slope: check_slope;
    a_ball_spinning_on_its_spot_stops_at_the_predicted_time: check_twisting;
    a_box_twists_against_friction_and_resistance: check_box_twist;
    resistance_is_the_same_in_a_turned_scene: check_turned;
}

const RADIUS: f64 = 0.5;

fn resisting(rolling: f64, twisting: f64) -> Material {
    Material { friction: 1.0, rolling_resistance: rolling, twisting_resistance: twisting, ..Material::default() }
}

/// A box slides on a floor; how fast it loses speed tells the friction of the two.
fn check_rules<const N: usize>() {
    use CombineRule::{Average, GeometricMean, Maximum, Minimum, Multiply};
    let (a, b) = (0.4, 0.1);
    let all = [None, Some(GeometricMean), Some(Average), Some(Minimum), Some(Multiply), Some(Maximum)];
    let expected = [0.2, 0.2, 0.25, 0.1, 0.04, 0.4];
    for (i, first) in all.into_iter().enumerate() {
        for (j, second) in all.into_iter().enumerate() {
            let mut world = world::<N>(down());
            let floor = Material { friction: a, friction_rule: first, ..Material::default() };
            add_floor(&mut world, floor);
            let own = Material { friction: b, friction_rule: second, ..Material::default() };
            let half = Vector::from_fn(|axis| if axis == 1 { 0.1 } else { 0.5 });
            let place = Vector::unit(1) * (0.1 - 0.0005);
            let def = BodyDef::new(cuboid(half)).position(place).velocity(Vector::unit(0) * 5.0).material(own);
            let body = world.add_body(def).unwrap();
            (0..30).for_each(|_| world.step());
            let lost = 5.0 - world.body(body).unwrap().velocity()[0];
            assert_close(&format!("{first:?} on {second:?}"), lost, expected[i.max(j)] * GRAVITY * 0.5, 0.01);
        }
    }
    let bouncing = |e: f64, rule| Material { restitution: e, restitution_rule: rule, ..Material::default() };
    for (rule, expected) in [(None, 0.8), (Some(Average), 0.5), (Some(Minimum), 0.2), (Some(Multiply), 0.16)] {
        let mut world = world::<N>(down());
        add_floor(&mut world, bouncing(0.8, rule));
        let def = BodyDef::new(ball(0.2)).position(Vector::unit(1) * 2.2).material(bouncing(0.2, None));
        let body = world.add_body(def).unwrap();
        let (mut fastest, mut rebound) = (0.0_f64, 0.0_f64);
        for _ in 0..60 {
            world.step();
            let speed = world.body(body).unwrap().velocity()[1];
            fastest = fastest.max(-speed);
            rebound = rebound.max(speed);
        }
        assert_close(&format!("restitution by {rule:?}"), rebound / fastest, expected, 0.06);
    }
}

/// m dv/dt = −F and I/r dv/dt = F r − c m g, so a = −(c g/r)(n + 2)/(n + 4), with I = 2 m r²/(n + 2).
fn check_rolling<const N: usize>() {
    let (c, speed) = (0.02, 2.0);
    for material in [resisting(c, 0.0), resisting(c, 0.3)] {
        let mut world = world::<N>(down());
        add_floor(&mut world, resisting(0.0, 0.0));
        let spin = Bivector::plane(0, 1, -speed / RADIUS);
        let def = BodyDef::new(ball(RADIUS)).position(Vector::unit(1) * (RADIUS - 0.0005)).material(material);
        let body = world.add_body(def.velocity(Vector::unit(0) * speed).angular_velocity(spin)).unwrap();
        let n = N as f64;
        let slowing = c * GRAVITY / RADIUS * (n + 2.0) / (n + 4.0);
        (0..60).for_each(|_| world.step());
        let expected = speed - slowing;
        assert_close("speed after a second", world.body(body).unwrap().velocity()[0], expected, 0.01);
        let steps = (60.0 * speed / slowing) as usize;
        (0..steps).for_each(|_| world.step());
        let body = world.body(body).unwrap();
        assert_close("distance", body.position()[0], 0.5 * speed * speed / slowing, 0.01);
        assert!(body.velocity().norm() + body.angular_velocity().norm() < 1e-3, "it stands: {:?}", body.velocity());
    }
}

/// A ball stays on a slope up to tan θ = c/r, and rolls on a steeper one.
fn check_slope<const N: usize>() {
    for (slope, stays) in [(0.035, true), (0.045, false)] {
        let gravity = Vector::unit(0) * (GRAVITY * slope) - Vector::unit(1) * GRAVITY;
        let mut world = world::<N>(gravity);
        add_floor(&mut world, resisting(0.02, 0.0));
        let def = BodyDef::new(ball(RADIUS)).position(Vector::unit(1) * (RADIUS - 0.0005));
        let body = world.add_body(def.material(resisting(0.0, 0.0))).unwrap();
        (0..180).for_each(|_| world.step());
        let came = world.body(body).unwrap().position()[0];
        let n = N as f64;
        let rolling = 0.5 * GRAVITY * (slope - 0.04) * (n + 2.0) / (n + 4.0) * 9.0;
        if stays {
            assert!(came.abs() < 1e-3, "it stays on a slope of {slope}: {came} m");
        } else {
            assert_close("it rolls", came, rolling, 0.03);
        }
    }
}

/// I dω/dt = −c m g with I = 2 m r²/(n + 2). In the plane of two dimensions there is nothing to twist in.
fn check_twisting<const N: usize>() {
    if N < 3 {
        return;
    }
    let (c, rate) = (0.05, 6.0);
    let mut world = world::<N>(down());
    add_floor(&mut world, resisting(0.0, c));
    let def = BodyDef::new(ball(RADIUS)).position(Vector::unit(1) * (RADIUS - 0.0005)).material(resisting(0.0, 0.0));
    // In four dimensions there are three such planes, and any mixture of them is one turn more.
    let mut spin = Bivector::plane(0, 2, rate);
    if N > 3 {
        spin.set(0, 3, 0.5 * rate);
    }
    let body = world.add_body(def.angular_velocity(spin)).unwrap();
    let slowing = c * GRAVITY * (N as f64 + 2.0) / (2.0 * RADIUS * RADIUS);
    let mut stopped = 0;
    for step in 0..300 {
        world.step();
        if world.body(body).unwrap().angular_velocity().norm() > 1e-3 {
            stopped = step + 1;
        }
    }
    assert_close("time until it stands", f64::from(stopped) / 60.0, spin.norm() / slowing, 0.02);
    let place = world.body(body).unwrap().position() - Vector::unit(1) * RADIUS;
    assert!(place.norm() < 2e-3, "it stays on its spot: {place:?}");
}

/// Four or more corners at the distance ρ rub with μ m g ρ; resistance comes on top of it.
fn check_box_twist<const N: usize>() {
    if N < 3 {
        return;
    }
    let slowing_with = |c: f64| {
        let mut world = world::<N>(down());
        add_floor(&mut world, Material { friction: 0.3, ..resisting(0.0, c) });
        let half = Vector::from_fn(|axis| if axis == 1 { 0.05 } else { 0.5 });
        let def = BodyDef::new(cuboid(half)).position(Vector::unit(1) * (0.05 - 0.0005));
        let def = def.material(Material { friction: 0.3, ..Material::default() });
        let body = world.add_body(def.angular_velocity(Bivector::plane(0, 2, 10.0))).unwrap();
        (0..12).for_each(|_| world.step());
        10.0 - world.body(body).unwrap().angular_velocity().get(0, 2)
    };
    // I = m (h² + h²)/3; the torque of resistance alone is c m g.
    let expected = 0.1 * GRAVITY * 0.2 / ((0.25 + 0.25) / 3.0);
    assert_close("what resistance adds", slowing_with(0.1) - slowing_with(0.0), expected, 0.02);
}

/// Resistance knows no axes: rolling askew is rolling along an axis, seen from elsewhere.
fn check_turned<const N: usize>() {
    if N < 3 {
        return;
    }
    let roll = |direction: Vector<N>| {
        let mut world: World<N> = world(down());
        world.add_body(BodyDef::fixed(Shape::half_space(Vector::unit(1), 0.0).unwrap())).unwrap();
        let place = Vector::unit(1) * (RADIUS - 0.0005);
        let def = BodyDef::new(ball(RADIUS)).position(place).material(resisting(0.02, 0.01)).velocity(direction);
        let body = world.add_body(def).unwrap();
        (0..120).for_each(|_| world.step());
        world.body(body).unwrap().position().dot(direction)
    };
    let askew = (Vector::unit(0) * 0.6 + Vector::unit(2) * 0.8) * 1.0;
    assert_close("distance", roll(askew), roll(Vector::unit(0)), 1e-5);
}

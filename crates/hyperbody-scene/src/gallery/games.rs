//! Bowling and dominoes.

use super::stage::{floor, material, scene};
use crate::model::{Body, Scene, ShapeSpec};

pub(super) fn dominoes_3d() -> Scene {
    let mut scene =
        scene(3, "A ball topples the first of 30 dominoes, and the wave runs along half a circle to the last.");
    scene.bodies.push(floor(3));
    let (count, radius) = (30, 4.0);
    for index in 0..count {
        let turn_deg = 180.0 * f64::from(index) / f64::from(count - 1);
        let (sin, cos) = hyperbody::math::scalar::sin_cos(turn_deg.to_radians());
        let rounded = |value: f64| (value * 1e4).round() / 1e4;
        let position = [rounded(radius * sin), 0.5, rounded(radius * (1.0 - cos))];
        let domino = Body::new(ShapeSpec::cuboid([0.06, 0.5, 0.25])).named(format!("domino {index}"));
        scene.bodies.push(domino.at(position).turned("xz", rounded(turn_deg)));
    }
    let ball = Body::new(ShapeSpec::ball(0.2)).named("ball").at([-1.0, 0.8, 0.0]).weighing(0.5);
    scene.bodies.push(ball.moving([2.0, 1.5, 0.0]));
    scene
}

pub(super) fn bowling_4d() -> Scene {
    let mut scene = scene(
        4,
        "A heavy ball rolls down a four-dimensional lane into twenty pins, which stand in a tetrahedron where three \
         dimensions have a triangle.",
    );
    scene.materials.push(material("lane", 0.3, 0.0));
    scene.materials.push(material("pin", 0.5, 0.3));
    scene.bodies.push(floor(4).made_of("lane"));
    let spacing = 0.8;
    for row in 0..4 {
        for z in 0..=row {
            for w in 0..=row - z {
                let middle = f64::from(row) / 3.0;
                let position = [
                    spacing * f64::from(row),
                    0.6,
                    spacing * (f64::from(z) - middle),
                    spacing * (f64::from(w) - middle),
                ];
                let pin = ShapeSpec::cuboid([0.15, 0.6, 0.15, 0.15]);
                scene
                    .bodies
                    .push(Body::new(pin).named(format!("pin {row} {z} {w}")).at(position).made_of("pin").weighing(1.0));
            }
        }
    }
    let ball = Body::new(ShapeSpec::ball(0.5)).named("ball").at([-8.0, 0.5, 0.0, 0.0]).made_of("lane").weighing(8.0);
    // Rolling: the point on the floor stands still.
    scene.bodies.push(ball.moving([9.0, 0.0, 0.0, 0.0]).spinning("xy", -18.0));
    scene
}

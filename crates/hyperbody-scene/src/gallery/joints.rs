//! Pendulums and chains.

use super::stage::{material, scene};
use crate::model::{Body, Joint, JointKind, Scene, ShapeSpec};

pub(super) fn cradle_2d() -> Scene {
    let mut scene =
        scene(2, "Newton's cradle: one swinging ball strikes a row of four, and the far one flies off in its place.");
    scene.materials.push(material("steel", 0.0, 1.0));
    scene.sleeping = false;
    scene.dt = 1.0 / 240.0;
    let (radius, length) = (0.5, 3.0);
    let beam = ShapeSpec::cuboid([3.0, 0.1]);
    scene.bodies.push(Body::new(beam).named("beam").fixed().at([0.0, 4.5]));
    for index in 0..5 {
        // So far apart, and at steps so short, that each pair collides by itself.
        let pivot = (f64::from(index) - 2.0) * (2.0 * radius + 0.03);
        let swing_deg: f64 = if index == 0 { -50.0 } else { 0.0 };
        let (sin, cos) = hyperbody::math::scalar::sin_cos(swing_deg.to_radians());
        let position = [pivot + length * sin, 4.5 - length * cos];
        let mut ball = Body::new(ShapeSpec::ball(radius)).named(format!("ball {index}")).at(position).made_of("steel");
        if index == 0 {
            ball = ball.turned("xy", swing_deg);
        }
        scene.bodies.push(ball);
        scene.joints.push(ball_joint("beam", vec![pivot, 0.0], &format!("ball {index}"), vec![0.0, length]));
    }
    scene
}

pub(super) fn chain_3d() -> Scene {
    let mut scene = scene(3, "A chain of twelve capsules with a heavy ball at its end swings down from a fixed hook.");
    scene.sleeping = false;
    scene.bodies.push(Body::new(ShapeSpec::cube(3, 0.2)).named("hook").fixed().at([0.0, 8.0, 0.0]));
    let (half_length, half_link) = (0.2, 0.3);
    let mut previous = ("hook".to_owned(), vec![0.0; 3]);
    for index in 0..12 {
        let name = format!("link {index}");
        let position = [half_link * (2.0 * f64::from(index) + 1.0), 8.0, 0.0];
        scene.bodies.push(Body::new(ShapeSpec::capsule(half_length, 0.1, "x")).named(&name).at(position));
        scene.joints.push(ball_joint(&previous.0, previous.1, &name, vec![-half_link, 0.0, 0.0]));
        previous = (name, vec![half_link, 0.0, 0.0]);
    }
    let ball = Body::new(ShapeSpec::ball(0.4)).named("ball").at([24.0 * half_link + 0.4, 8.0, 0.0]);
    // The sideways push makes it swing in a cone instead of a plane.
    scene.bodies.push(ball.moving([0.0, 0.0, 2.0]));
    scene.joints.push(ball_joint(&previous.0, previous.1, "ball", vec![-0.4, 0.0, 0.0]));
    scene
}

pub(super) fn pendulum_4d() -> Scene {
    let mut scene = scene(
        4,
        "A double pendulum with room for three directions of swing: it starts in one plane, and a push along w makes it \
         wander through all of them, chaotically.",
    );
    scene.sleeping = false;
    scene.bodies.push(Body::new(ShapeSpec::cube(4, 0.15)).named("hook").fixed().at([0.0, 4.0, 0.0, 0.0]));
    let rod = || Body::new(ShapeSpec::cuboid([0.75, 0.1, 0.1, 0.1]));
    scene.bodies.push(rod().named("upper").at([0.75, 4.0, 0.0, 0.0]));
    scene.bodies.push(rod().named("lower").at([2.25, 4.0, 0.0, 0.0]).moving([0.0, 0.0, 0.5, 1.5]));
    let (left, right) = (vec![-0.75, 0.0, 0.0, 0.0], vec![0.75, 0.0, 0.0, 0.0]);
    scene.joints.push(ball_joint("hook", vec![0.0; 4], "upper", left.clone()));
    scene.joints.push(ball_joint("upper", right, "lower", left));
    scene
}

fn ball_joint(a: &str, anchor_a: Vec<f64>, b: &str, anchor_b: Vec<f64>) -> Joint {
    Joint::new(JointKind::Ball, a, b).anchored(anchor_a, anchor_b)
}

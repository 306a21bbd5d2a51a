//! A mixer: what gears do. A sun wheel in the middle, three planets around it on a carrier, a ring around them that stands still.

use std::f64::consts::TAU;

use hyperbody::math::scalar;

use super::stage::{pit, scene};
use crate::model::{Body, Joint, JointKind, Part, RotationSpec, Scene, ShapeSpec};

/// Teeth, and the radii (m) at which they meet: a wheel is 1/30 m for each of its teeth.
const SUN: i32 = 12;
const PLANET: i32 = 18;
const RING: i32 = SUN + 2 * PLANET;
const PER_TOOTH: f64 = 1.0 / 30.0;

/// From the middle to the axes of the planets, m.
const ORBIT: f64 = (SUN + PLANET) as f64 * PER_TOOTH;

/// Height of the wheels, m, and half of how far they go along w.
const HEIGHT: f64 = 1.75;
const HALF_W: f64 = 0.5;

pub(super) fn mixer_4d() -> Scene {
    let mut scene = scene(
        4,
        "A mixer with planetary gears: three whisks turn as they go around, held by teeth alone, and stir balls and tesseracts. \
         What lies farther along w than their blades reach stays where it is.",
    );
    scene.bodies = pit(4, 2.05);
    scene.bodies.push(Body::new(ring()).named("ring").fixed().at([0.0, HEIGHT, 0.0, 0.0]));
    scene.bodies.push(Body::new(wheel(SUN)).named("sun").at([0.0, HEIGHT, 0.0, 0.0]).weighing(2.0));
    scene.bodies.push(Body::new(carrier()).named("carrier").at([0.0, HEIGHT + 0.2, 0.0, 0.0]).weighing(2.0));
    let hinge = || JointKind::Hinge { plane: "xz".to_owned() };
    let on_axis = |y: f64| [0.0, y, 0.0, 0.0];
    scene.joints.push(Joint::with_world(hinge(), "sun").anchored(on_axis(HEIGHT), []).driven(4.0, 10.0));
    scene.joints.push(Joint::with_world(hinge(), "carrier").anchored(on_axis(HEIGHT + 0.2), []));
    for (index, [x, z]) in around(3).enumerate() {
        let name = format!("whisk {}", index + 1);
        scene.bodies.push(Body::new(whisk()).named(&name).at([ORBIT * x, HEIGHT, ORBIT * z, 0.0]).weighing(3.0));
        scene.joints.push(Joint::new(hinge(), "carrier", &name).anchored([ORBIT * x, -0.2, ORBIT * z, 0.0], []));
        let gear = |teeth| JointKind::Gear { plane: "xz".to_owned(), teeth };
        scene.joints.push(Joint::new(gear([SUN, PLANET]), "sun", &name));
        // The planets run inside the ring.
        scene.joints.push(Joint::new(gear([-RING, PLANET]), "ring", &name));
    }
    scene.bodies.extend(stirred());
    scene
}

/// Unit vectors x, z in so many directions.
fn around(count: usize) -> impl Iterator<Item = [f64; 2]> {
    (0..count).map(move |k| {
        let (sin, cos) = scalar::sin_cos(TAU * k as f64 / count as f64);
        [cos, sin]
    })
}

fn wheel(teeth: i32) -> ShapeSpec {
    let disc = ShapeSpec::regular(&format!("{{{teeth}}}"), f64::from(teeth) * PER_TOOTH);
    ShapeSpec::product([(disc, "xz"), (ShapeSpec::cuboid([0.09, HALF_W]), "yw")])
}

/// Parts set up in a circle, each turned with its place.
fn circle(count: usize, radius: f64, part: &ShapeSpec) -> ShapeSpec {
    let parts = around(count).enumerate().map(|(k, [x, z])| {
        let mut rotation = RotationSpec::default();
        rotation.push("xz", 360.0 * k as f64 / count as f64);
        Part { rotation, ..Part::new(part.clone(), [radius * x, 0.0, radius * z, 0.0]) }
    });
    ShapeSpec::Compound { parts: parts.collect() }
}

fn ring() -> ShapeSpec {
    circle(24, f64::from(RING) * PER_TOOTH + 0.12, &ShapeSpec::cuboid([0.08, 0.09, 0.25, HALF_W]))
}

fn carrier() -> ShapeSpec {
    circle(3, 0.5 * ORBIT, &ShapeSpec::cuboid([0.55, 0.05, 0.1, 0.3]))
}

/// A planet, with a shaft and a blade below.
fn whisk() -> ShapeSpec {
    let shaft = Part::new(ShapeSpec::cuboid([0.05, 0.45, 0.05, 0.3]), [0.0, -0.5, 0.0, 0.0]);
    let blade = Part::new(ShapeSpec::cuboid([0.4, 0.22, 0.05, HALF_W]), [0.0, -1.1, 0.0, 0.0]);
    ShapeSpec::Compound { parts: vec![Part::new(wheel(PLANET), []), shaft, blade] }
}

/// Two layers in the pit, without what the whisks would stand in.
fn stirred() -> Vec<Body> {
    let mut bodies = Vec::new();
    for cell in 0..96 {
        let [w, z, x, layer] = [cell % 3, cell / 3 % 4, cell / 12 % 4, cell / 48].map(f64::from);
        let (x, z) = (0.8 * x - 1.2, 0.8 * z - 1.2);
        let off = |[cos, sin]: [f64; 2]| (x - ORBIT * cos) * (x - ORBIT * cos) + (z - ORBIT * sin) * (z - ORBIT * sin);
        if around(3).any(|place| off(place) < 0.72 * 0.72) {
            continue;
        }
        let number = bodies.len() / 2 + 1;
        let body = if bodies.len().is_multiple_of(2) {
            Body::new(ShapeSpec::cube(4, 0.19)).named(format!("tesseract {number}"))
        } else {
            Body::new(ShapeSpec::ball(0.24)).named(format!("ball {number}"))
        };
        bodies.push(body.at([x, 0.25 + 0.5 * layer, z, 0.9 * (w - 1.0)]));
    }
    bodies
}

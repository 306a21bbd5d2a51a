//! Slopes: what slides and what stays.

use super::stage::{floor, material, point, scene};
use crate::model::{Angle, Body, RotationSpec, Scene, ShapeSpec, Turn};

/// Of the slope, degrees: its tangent is 0.4663.
const SLOPE_DEG: f64 = 25.0;

pub(super) fn ramp_3d() -> Scene {
    ramp(
        3,
        "Five cubes of rougher and rougher material on a slope of 25°: those whose friction with it is below tan 25° = 0.47 \
         slide down, the others stay.",
    )
}

pub(super) fn ramp_4d() -> Scene {
    ramp(
        4,
        "Five tesseracts on a slope of 25° in four dimensions: friction decides as in three, and those below 0.47 slide \
         down.",
    )
}

fn ramp(dimension: usize, description: &str) -> Scene {
    let mut scene = scene(dimension, description);
    let slope = SLOPE_DEG.to_radians();
    let (sin, cos) = hyperbody::math::scalar::sin_cos(slope);
    // It rises towards −x, from the edge at the origin where it meets the floor.
    let ramp = ShapeSpec::HalfSpace { normal: point(dimension, &[sin, cos]), offset: 0.0 };
    scene.materials.push(material("ramp", 1.0, 0.0));
    scene.bodies.push(floor(dimension).made_of("ramp"));
    scene.bodies.push(Body::new(ramp).named("ramp").fixed().made_of("ramp"));
    for (index, friction) in [0.1, 0.3, 0.45, 0.5, 0.8].into_iter().enumerate() {
        // Two surfaces combine by the geometric mean, and the ramp has friction 1.
        let name = format!("friction {friction}");
        scene.materials.push(material(&name, friction * friction, 0.0));
        let (up, height) = (6.0, 0.4);
        let mut position = point(dimension, &[-up * cos + height * sin, up * sin + height * cos]);
        position[dimension - 1] = 1.5 * (index as f64 - 2.0);
        let mut cube = Body::new(ShapeSpec::cube(dimension, 0.4)).named(&name).at(position).made_of(&name);
        cube.rotation = RotationSpec::Turns(vec![Turn { plane: "xy".to_owned(), angle: Angle::Radians(-slope) }]);
        scene.bodies.push(cube);
    }
    scene
}

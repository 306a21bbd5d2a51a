//! Bodies that bounce.

use super::random::Random;
use super::stage::{floor, material, scene};
use crate::model::{Body, Scene, ShapeSpec};

pub(super) fn restitution_2d() -> Scene {
    let mut scene = scene(
        2,
        "Six balls fall from the same height; their restitutions go from 0, which stays down, to 1, which comes back up.",
    );
    scene.sleeping = false;
    scene.bodies.push(floor(2));
    for index in 0..6 {
        let restitution = f64::from(index) / 5.0;
        let name = format!("restitution {restitution}");
        scene.materials.push(material(&name, 0.5, restitution));
        let ball = Body::new(ShapeSpec::ball(0.4)).named(&name).made_of(&name);
        scene.bodies.push(ball.at([1.2 * (f64::from(index) - 2.5), 4.0]));
    }
    scene
}

pub(super) fn clouds_5d() -> Scene {
    let mut scene = scene(
        5,
        "Two clouds of five-dimensional cubes fly into each other without gravity and scatter; their momentum stays \
         what it was.",
    );
    scene.gravity = vec![0.0; 5];
    scene.materials.push(material("default", 0.2, 0.8));
    let mut random = Random::new(55);
    for index in 0..32_u32 {
        // The corners of a cube over y, z, w and v, on two sides along x.
        let side = |bit: u32| if (index >> bit) & 1 == 0 { -1.0 } else { 1.0 };
        let mut position: Vec<f64> = (0..5).map(|bit| side(bit) * if bit == 0 { 4.0 } else { 0.7 }).collect();
        for coordinate in &mut position {
            *coordinate += random.around_zero(0.1);
        }
        let velocity = [-3.0 * side(0), random.around_zero(0.3), random.around_zero(0.3), random.around_zero(0.3), 0.0];
        let cube = Body::new(ShapeSpec::cube(5, 0.4)).at(position).moving(velocity);
        scene.bodies.push(cube.spinning("xy", random.around_zero(1.0)).spinning("zw", random.around_zero(1.0)));
    }
    scene
}

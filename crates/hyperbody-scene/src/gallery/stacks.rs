//! Boxes upon boxes: what a solver has to hold still.

use super::stage::{floor, point, scene};
use crate::model::{Body, Scene, ShapeSpec};

pub(super) fn stack_4d() -> Scene {
    stack(4, 10, "Ten tesseracts stand on each other, and go on standing.")
}

pub(super) fn stack_5d() -> Scene {
    stack(5, 6, "Six five-dimensional cubes stand on each other; every contact is a patch with sixteen corners.")
}

fn stack(dimension: usize, count: usize, description: &str) -> Scene {
    let mut scene = scene(dimension, description);
    scene.bodies.push(floor(dimension));
    for level in 0..count {
        let position = point(dimension, &[0.0, 0.5 + level as f64]);
        scene.bodies.push(Body::new(ShapeSpec::cube(dimension, 0.5)).named(format!("box {level}")).at(position));
    }
    scene
}

pub(super) fn pyramid_2d() -> Scene {
    pyramid(2, 12, "A wall of 78 squares, one fewer in every row, settles and stands.")
}

pub(super) fn pyramid_3d() -> Scene {
    pyramid(3, 5, "A square pyramid of 55 cubes stands on its base.")
}

pub(super) fn pyramid_4d() -> Scene {
    pyramid(4, 4, "A pyramid over a cube: 64, 27, 8 and 1 tesseracts, each resting on eight below it.")
}

/// Layers of base^(n−1), (base−1)^(n−1), …, 1 boxes, each over the middle of those below it.
fn pyramid(dimension: usize, base: usize, description: &str) -> Scene {
    let mut scene = scene(dimension, description);
    scene.bodies.push(floor(dimension));
    for layer in 0..base {
        let across = base - layer;
        let count = (1..dimension).fold(1, |count, _| count * across);
        for index in 0..count {
            let mut cell = index;
            let mut position = vec![0.5 + layer as f64; dimension];
            for axis in (0..dimension).filter(|&axis| axis != 1) {
                position[axis] = ((cell % across) as f64 - (across - 1) as f64 / 2.0) * 1.05;
                cell /= across;
            }
            scene.bodies.push(Body::new(ShapeSpec::cube(dimension, 0.5)).at(position));
        }
    }
    scene
}

pub(super) fn embedded_4d() -> Scene {
    let mut scene = scene(
        4,
        "A 3D scene inside 4D: a beam falls across a tower of blocks, and nothing ever leaves the space w = 0, where the \
         motion is that of three dimensions.",
    );
    scene.bodies.push(floor(4));
    for level in 0..5 {
        let block = Body::new(ShapeSpec::cuboid([0.4, 0.3, 0.4, 0.5])).named(format!("block {level}"));
        scene.bodies.push(block.at([0.0, 0.3 + 0.6 * f64::from(level), 0.0, 0.0]));
    }
    let beam = Body::new(ShapeSpec::cuboid([1.5, 0.15, 0.2, 0.5])).named("beam").at([-0.9, 5.0, 0.1, 0.0]);
    scene.bodies.push(beam.turned("xy", 20.0).turned("xz", 15.0));
    scene
}

//! Bodies that are not convex.

use super::stage::{Heap, scene};
use crate::model::{Part, Scene, ShapeSpec};

pub(super) fn ells_4d() -> Scene {
    let mut scene =
        scene(4, "24 hooks, each of three bars along three of the four axes, fall into a pit and catch in each other.");
    let heap = Heap { dimension: 4, across: 2, layers: 3, spacing: 2.1, reach: 1.05, largest_turn: 45.0, seed: 2020 };
    scene.bodies = heap.bodies(|_| hook());
    scene
}

/// A corner block with an arm along each of x, y and w.
fn hook() -> ShapeSpec {
    let mut parts = vec![Part::new(ShapeSpec::cube(4, 0.25), Vec::new())];
    for axis in [0, 1, 3] {
        let mut half_extents = [0.25; 4];
        let mut position = vec![0.0; 4];
        half_extents[axis] = 0.35;
        position[axis] = 0.6;
        parts.push(Part::new(ShapeSpec::cuboid(half_extents), position));
    }
    ShapeSpec::Compound { parts }
}

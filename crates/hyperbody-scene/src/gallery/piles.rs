//! Pits into which many bodies of one sort fall.

use super::stage::{Heap, scene};
use crate::model::{Scene, ShapeSpec};

pub(super) fn tesseracts_4d() -> Scene {
    let mut scene =
        scene(4, "Three layers of 27 tilted tesseracts fall into a pit, topple over each other and lie still.");
    scene.bodies = heap(4, 3, 3, 1.9, 1.0, 20.0).bodies(|_| ShapeSpec::cube(4, 0.5));
    scene
}

pub(super) fn dice_4d() -> Scene {
    let mut scene = scene(
        4,
        "Dice of four dimensions: 5-, 8-, 16- and 24-cells, thrown at random angles, come to rest on whole cells.",
    );
    scene.bodies = heap(4, 3, 2, 1.6, 0.7, 90.0)
        .bodies(|index| ShapeSpec::regular(["5-cell", "8-cell", "16-cell", "24-cell"][index % 4], 0.7));
    scene
}

pub(super) fn round_dice_4d() -> Scene {
    let mut scene = scene(
        4,
        "A hundred dice that are nearly balls, 120-cells and 600-cells by turns, fall into a pit with six walls and lie \
         still: each on one of its hundreds of cells.",
    );
    scene.bodies =
        heap(4, 3, 4, 1.15, 0.5, 90.0).bodies(|index| ShapeSpec::regular(["120-cell", "600-cell"][index % 2], 0.5));
    // The floor, six walls, and of the last layer as many as make a hundred.
    scene.bodies.truncate(7 + 100);
    scene
}

pub(super) fn balls_4d() -> Scene {
    balls(4, 3, 5, "135 four-dimensional balls rain into a pit with six walls and pile up.")
}

pub(super) fn balls_5d() -> Scene {
    balls(5, 2, 8, "128 five-dimensional balls rain into a pit with eight walls and pile up.")
}

pub(super) fn balls_6d() -> Scene {
    balls(6, 2, 5, "160 six-dimensional balls rain into a pit with ten walls; they roll in fifteen planes.")
}

fn balls(dimension: usize, across: usize, layers: usize, description: &str) -> Scene {
    let mut scene = scene(dimension, description);
    scene.bodies = heap(dimension, across, layers, 1.15, 0.5, 0.0).bodies(|_| ShapeSpec::ball(0.5));
    scene
}

pub(super) fn capsules_4d() -> Scene {
    let mut scene = scene(
        4,
        "54 capsules fall like logs; lying on the floor they still have three directions left in which to roll and turn, \
         and come to rest in all of them.",
    );
    let axis = |index: usize| ["x", "z", "w"][index % 3];
    scene.bodies = heap(4, 3, 2, 1.7, 0.8, 30.0).bodies(|index| ShapeSpec::capsule(0.5, 0.3, axis(index)));
    scene
}

pub(super) fn rounded_4d() -> Scene {
    let mut scene = scene(
        4,
        "Tesseracts and 16-cells with rounded edges, like worn dice, roll over their corners where sharp ones would catch.",
    );
    scene.bodies = heap(4, 3, 2, 1.7, 1.0, 60.0).bodies(|index| {
        let core = if index % 2 == 0 { ShapeSpec::cube(4, 0.35) } else { ShapeSpec::regular("16-cell", 0.7) };
        core.rounded([0.05, 0.1, 0.15][index % 3])
    });
    scene
}

fn heap(dimension: usize, across: usize, layers: usize, spacing: f64, reach: f64, largest_turn: f64) -> Heap {
    Heap { dimension, across, layers, spacing, reach, largest_turn, seed: 12345 }
}

//! Bodies that turn freely, without gravity.

use super::stage::scene;
use crate::model::{Body, Part, Scene, ShapeSpec};

pub(super) fn wing_nut_3d() -> Scene {
    let mut scene = scene(
        3,
        "A T-handle spins about its stem, the axis of the middle moment of inertia, and turns over again and again: the \
         effect that V. Dzhanibekov saw on a wing nut in orbit.",
    );
    scene.gravity = vec![0.0; 3];
    let parts = vec![
        Part::new(ShapeSpec::cuboid([0.8, 0.1, 0.1]), [0.0, 0.3, 0.0]),
        Part::new(ShapeSpec::cuboid([0.1, 0.4, 0.1]), [0.0, -0.2, 0.0]),
    ];
    let handle = Body::new(ShapeSpec::Compound { parts }).named("handle");
    scene.bodies.push(handle.spinning("xz", 6.0).spinning("xy", 0.02));
    scene
}

pub(super) fn tumble_4d() -> Scene {
    let mut scene = scene(
        4,
        "A box spins in two planes at once, yw and xz, and tumbles without end: no spin in this pair of planes is stable, \
         whatever its two rates. The box beside it spins in xy and zw, and only wobbles.",
    );
    scene.gravity = vec![0.0; 4];
    let half_extents = [0.3, 0.5, 0.7, 1.0];
    let unstable = Body::new(ShapeSpec::cuboid(half_extents)).named("tumbling").at([-2.0, 0.0, 0.0, 0.0]);
    scene.bodies.push(unstable.spinning("xz", 8.0).spinning("yw", 2.0).spinning("xy", 0.02));
    let stable = Body::new(ShapeSpec::cuboid(half_extents)).named("steady").at([2.0, 0.0, 0.0, 0.0]);
    scene.bodies.push(stable.spinning("xy", 8.0).spinning("xz", 0.02).spinning("zw", 2.0));
    scene
}

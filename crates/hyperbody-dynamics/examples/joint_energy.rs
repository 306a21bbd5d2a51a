//! How joints keep energy: relative energy drift of pendulums in 60 s, for several step lengths. Ends with status 1 if one loses or
//! gains more than a hundredth at 240 steps a second.

use std::process::ExitCode;

use hyperbody_dynamics::{BodyDef, JointDef, World, WorldDef};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Rotation, Vector};

fn pendulum<const N: usize>(steps_a_second: f64, substeps: u32, extra: f64, push: f64) -> (f64, f64) {
    let gravity = Vector::unit(1) * -9.81;
    let def = WorldDef { gravity, sleeping: false, dt: 1.0 / steps_a_second, substeps, ..WorldDef::default() };
    let mut world = World::<N>::new(def).expect("in range");
    let half = Vector::<N>::from_fn(|i| 0.1 + extra * i as f64);
    let rotation = Rotation::in_plane(1, 0, 1.2);
    let hanging = Vector::unit(1) * -0.8;
    let bob = BodyDef::new(Shape::cuboid(half).expect("a box")).rotation(rotation).position(rotation.rotate(hanging));
    let spin = Bivector::from_fn(|i, j| if i == 0 && j == 2 { push } else { 0.0 });
    let bob = bob.velocity(spin.act_on(rotation.rotate(hanging))).angular_velocity(spin);
    let bob = world.add_body(bob).expect("valid");
    world.add_joint(JointDef::ball(None, bob, Vector::ZERO, -hanging)).expect("valid");
    let before = world.energy().total();
    let lowest = -9.81 * 0.8 * world.body(bob).expect("there").mass();
    let mut gap: f64 = 0.0;
    for _ in 0..(60.0 * steps_a_second) as usize {
        world.step();
        gap = gap.max(world.body(bob).expect("there").pose().transform_point(-hanging).norm());
    }
    ((world.energy().total() - before) / (before - lowest), gap)
}

fn main() -> ExitCode {
    let mut keeps = false;
    for (rate, substeps) in [(60.0, 4), (120.0, 4), (240.0, 1), (240.0, 4), (480.0, 4)] {
        let a = pendulum::<2>(rate, substeps, 0.0, 0.0);
        let b = pendulum::<3>(rate, substeps, 0.05, 0.0);
        let c = pendulum::<3>(rate, substeps, 0.05, 2.0);
        let d = pendulum::<4>(rate, substeps, 0.05, 2.0);
        if rate == 240.0 && substeps == 4 {
            keeps = [a.0, b.0, c.0, d.0].iter().all(|drift: &f64| drift.abs() < 0.01);
        }
        println!(
            "{rate} Hz, {substeps} substeps: 2D {:.2e} (gap {:.1e}), 3D {:.2e}, 3D spherical {:.2e} (gap {:.1e}), 4D {:.2e}",
            a.0, a.1, b.0, c.0, c.1, d.0
        );
    }
    if keeps { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

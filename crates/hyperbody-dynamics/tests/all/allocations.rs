//! A settled step takes nothing from the heap.

use std::sync::Arc;

use hyperbody_dynamics::{BodyDef, JointDef};
use hyperbody_geometry::{Polytope, Shape};
use hyperbody_math::Vector;

use crate::common::{add_floor, ball, cuboid, down, in_all_dimensions, material, run, world};

in_all_dimensions! {
    settled_steps_take_nothing_from_the_heap: check;
}

/// Stacks of cubes, balls in a row, long boxes (anisotropic), simplices and a chain, all awake.
fn check<const N: usize>() {
    let mut world = world(down::<N>());
    add_floor(&mut world, material(0.5, 0.0));
    let at = |x: f64, y: f64| Vector::unit(0) * x + Vector::unit(1) * y;
    for k in 0..4_u32 {
        let step = f64::from(k);
        let long = cuboid(Vector::from_fn(|i| if i == 0 { 0.6 } else { 0.3 }));
        let corners: Vec<_> =
            (0..=N).map(|i| if i == N { Vector::splat(-0.4) } else { Vector::unit(i) * 0.8 }).collect();
        let simplex = Shape::polytope(Arc::new(Polytope::from_points(&corners).unwrap())).unwrap();
        for def in [
            BodyDef::new(cuboid(Vector::splat(0.5))).position(at(0.0, 0.5 + step)),
            BodyDef::new(ball(0.4)).position(at(2.0 + 0.8 * step, 0.4)),
            BodyDef::new(long).position(at(-4.0, 0.3 + 0.6 * step)),
            BodyDef::new(simplex).position(at(8.0 + 1.5 * step, 0.5)),
        ] {
            world.add_body(def).unwrap();
        }
    }
    let mut last = world.add_body(BodyDef::fixed(ball(0.1)).position(at(-8.0, 6.0))).unwrap();
    for k in 1..5_u32 {
        let link = BodyDef::new(ball(0.1)).position(at(-8.0, 6.0 - 0.5 * f64::from(k)));
        let link = world.add_body(link).unwrap();
        world.add_joint(JointDef::ball(last, link, at(0.0, -0.25), at(0.0, 0.25))).unwrap();
        last = link;
    }
    run(&mut world, 4.0);
    assert!(world.contacts().count() > 12, "{N}D: {} contacts", world.contacts().count());
    let taken = allocation_counter::measure(|| (0..30).for_each(|_| world.step()));
    assert_eq!(taken.count_total, 0, "{N}D: {taken:?}");
}

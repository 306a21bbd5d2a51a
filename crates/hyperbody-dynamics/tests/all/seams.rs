//! Bodies that slide over the seams of a floor keep their speed, and what stands in their way still stops them.

use std::sync::Arc;

use hyperbody_dynamics::{BodyDef, BodyHandle, World};
use hyperbody_geometry::{Polytope, Shape};
use hyperbody_math::{Pose, Rotation, Vector};

use crate::common::{ball, cuboid, down, in_all_dimensions, material, world};

in_all_dimensions! {
    slides_over_boxes_as_on_a_half_space: check_boxes;
    slides_over_cells_as_on_a_half_space: check_cells;
    slides_over_crates_that_could_move: check_crates;
    a_step_of_a_centimetre_stops: check_step;
    a_wall_stops: check_wall;
    small_bodies_on_a_floor_of_boxes_meet: check_small;
}

/// Half the size of what slides, m.
const HALF: f64 = 0.25;
const LENGTH: f64 = 10.0;

fn sliders<const N: usize>() -> Vec<(&'static str, Shape<N>, Rotation<N>)> {
    let mut all = vec![
        ("box", cuboid(Vector::splat(HALF)), Rotation::IDENTITY),
        ("ball", ball(HALF), Rotation::IDENTITY),
        ("capsule", Shape::capsule(0.3, HALF, 0).unwrap(), Rotation::IDENTITY),
        ("rounded box", Shape::rounded(cuboid(Vector::splat(0.2)), 0.05).unwrap(), Rotation::IDENTITY),
    ];
    if N > 2 {
        all.push(("turned box", cuboid(Vector::splat(HALF)), Rotation::in_plane(0, 2, 0.4)));
        all.push(("capsule across", Shape::capsule(0.3, HALF, 2).unwrap(), Rotation::IDENTITY));
    }
    all
}

/// A body that starts at rest height over the floor and slides for ten metres: its least speed, and its speed at the end.
fn slide<const N: usize>(world: &mut World<N>, shape: Shape<N>, rotation: Rotation<N>, speed: f64) -> (f64, f64) {
    let start = Vector::unit(0) * 0.6 + Vector::unit(1) * HALF;
    let def = BodyDef::new(shape).position(start).rotation(rotation).material(material(0.0, 0.0));
    let body = world.add_body(def.velocity(Vector::unit(0) * speed)).unwrap();
    let mut least = f64::INFINITY;
    for _ in 0..(LENGTH / speed * 60.0) as usize {
        world.step();
        least = least.min(world.body(body).unwrap().velocity()[0]);
    }
    let body = world.body(body).unwrap();
    assert!((body.position()[1] - HALF).abs() < 0.005, "it left the floor: {}", body.position()[1]);
    (least, body.velocity()[0])
}

fn compare<const N: usize>(what: &str, floor: impl Fn(&mut World<N>), speeds: &[f64]) {
    for (name, shape, rotation) in sliders::<N>() {
        for &speed in speeds {
            let mut smooth = world::<N>(down());
            let half_space = BodyDef::fixed(Shape::half_space(Vector::unit(1), 0.0).unwrap());
            smooth.add_body(half_space.material(material(0.0, 0.0))).unwrap();
            let (_, expected) = slide(&mut smooth, shape.clone(), rotation, speed);
            let mut seamed = world::<N>(down());
            floor(&mut seamed);
            let (least, end) = slide(&mut seamed, shape.clone(), rotation, speed);
            assert!((expected - speed).abs() < 1e-3 * speed, "the half-space slows the {name} to {expected} m/s");
            assert!(
                (end - expected).abs() < 0.01 * expected && least > 0.99 * expected,
                "{name} at {speed} m/s over {what} in {N}D: {end} m/s, at the slowest {least}; on a half-space {expected}"
            );
        }
    }
}

/// A box of the floor from x = `from` to `to`, its top at `top`.
fn slab<const N: usize>(from: f64, to: f64, top: f64) -> BodyDef<N> {
    let half = Vector::from_fn(|axis| if axis == 0 { 0.5 * (to - from) } else { 1.0 });
    let place = Vector::unit(0) * (0.5 * (from + to)) + Vector::unit(1) * (top - 1.0);
    BodyDef::fixed(cuboid(half)).position(place).material(material(0.0, 0.0))
}

fn add_slabs<const N: usize>(world: &mut World<N>, count: usize) {
    for k in 0..count {
        world.add_body(slab(0.55 * k as f64, 0.55 * (k + 1) as f64, 0.0)).unwrap();
    }
}

fn check_boxes<const N: usize>() {
    compare::<N>("boxes", |world| add_slabs(world, 22), &[0.7, 2.0, 9.0]);
}

/// Slanted cells, two beside each other, as one body: seams under the body all the way, and across it at an angle.
fn cells<const N: usize>() -> Shape<N> {
    let mut parts = Vec::new();
    for k in 0..22 {
        for side in 0..if N > 2 { 2 } else { 1 } {
            let corner = |bits: usize| {
                Vector::<N>::from_fn(|axis| {
                    let high = bits >> axis & 1 == 1;
                    match axis {
                        0 => {
                            let slant = if N > 2 && bits >> 2 & 1 == 1 { 0.3 } else { 0.0 };
                            0.6 * (k + usize::from(high)) as f64 - 0.6 + slant
                        }
                        1 => {
                            if high {
                                0.0
                            } else {
                                -0.7
                            }
                        }
                        2 => {
                            if high {
                                f64::from(side)
                            } else {
                                f64::from(side) - 1.0
                            }
                        }
                        _ => {
                            if high {
                                0.8
                            } else {
                                -0.7
                            }
                        }
                    }
                })
            };
            let points: Vec<Vector<N>> = (0..1 << N).map(corner).collect();
            let cell = Shape::polytope(Arc::new(Polytope::from_points(&points).unwrap())).unwrap();
            parts.push((Pose::IDENTITY, cell));
        }
    }
    Shape::compound(parts).unwrap()
}

fn check_cells<const N: usize>() {
    let cells = cells::<N>();
    let floor = |world: &mut World<N>| {
        world.add_body(BodyDef::fixed(cells.clone()).material(material(0.0, 0.0))).unwrap();
    };
    compare::<N>("cells", floor, &[2.0]);
}

fn check_crates<const N: usize>() {
    let floor = |world: &mut World<N>| {
        world.add_body(BodyDef::fixed(Shape::half_space(Vector::unit(1), -2.0).unwrap())).unwrap();
        for k in 0..12 {
            let def = slab::<N>(f64::from(k), f64::from(k + 1) - 1e-3, 0.0);
            world
                .add_body(BodyDef::new(def.shape).position(def.position).mass(5000.0).material(material(0.5, 0.0)))
                .unwrap();
        }
    };
    compare::<N>("crates", floor, &[2.0]);
}

/// How far the centre of a body comes that slides at an obstacle from 75 cm before x = 3 m.
fn stopped_at<const N: usize>(obstacle: BodyDef<N>, shape: &Shape<N>, speed: f64) -> f64 {
    let mut world = world::<N>(down());
    add_slabs(&mut world, 10);
    world.add_body(obstacle).unwrap();
    let start = Vector::unit(0) * 2.0 + Vector::unit(1) * HALF;
    let def = BodyDef::new(shape.clone()).position(start).velocity(Vector::unit(0) * speed);
    let body: BodyHandle = world.add_body(def.material(material(0.0, 0.0))).unwrap();
    let mut farthest = f64::NEG_INFINITY;
    for _ in 0..200 {
        world.step();
        farthest = farthest.max(world.body(body).unwrap().position()[0]);
    }
    farthest
}

fn check_step<const N: usize>() {
    // The next slabs stand a centimetre higher.
    let shape = cuboid(Vector::splat(HALF));
    let farthest = stopped_at::<N>(slab(3.0, 6.0, 0.01), &shape, 0.3);
    assert!((farthest - 2.75).abs() < 0.01, "a step of a centimetre stops a box at 2.75 m, not at {farthest}");
}

fn check_wall<const N: usize>() {
    for shape in [cuboid(Vector::splat(HALF)), ball(HALF)] {
        for (bottom, speed) in [(0.0, 1.0), (-0.5, 5.0)] {
            let half = Vector::from_fn(|axis| if axis == 0 { 0.1 } else { 1.0 });
            let place = Vector::unit(0) * 3.1 + Vector::unit(1) * (1.0 + bottom);
            let wall = BodyDef::fixed(cuboid(half)).position(place).material(material(0.0, 0.0));
            let farthest = stopped_at::<N>(wall, &shape, speed);
            assert!((farthest - 2.75).abs() < 0.02, "a wall stops it at 2.75 m, not at {farthest}, at {speed} m/s");
        }
    }
}

/// Balls of two millimetres, which stand no higher than what larger bodies slide over.
fn check_small<const N: usize>() {
    let mut world = world::<N>(down());
    add_slabs(&mut world, 3);
    let tiny = |x: f64| BodyDef::new(ball(0.001)).position(Vector::unit(0) * x + Vector::unit(1) * 0.001);
    let rest = world.add_body(tiny(0.9).material(material(0.0, 0.0)).mass(1e-3)).unwrap();
    let shot =
        world.add_body(tiny(0.8).material(material(0.0, 0.0)).mass(1e-3).velocity(Vector::unit(0) * 0.3)).unwrap();
    for _ in 0..60 {
        world.step();
    }
    let speeds = [rest, shot].map(|body| world.body(body).unwrap().velocity()[0]);
    assert!((speeds[0] - 0.15).abs() < 0.02 && (speeds[1] - 0.15).abs() < 0.02, "they share the speed: {speeds:?}");
}

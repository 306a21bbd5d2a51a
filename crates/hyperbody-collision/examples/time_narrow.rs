//! Nanoseconds per pair of the narrow phase, on one thread: `cargo run --release -p hyperbody-collision --example
//! time_narrow`.

use std::hint::black_box;
use std::time::Instant;

use hyperbody_collision::{Manifold, PairCache, Scratch, collide};
use hyperbody_geometry::Shape;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

/// Times one pair in a steady state: the second body sways by a micrometre so that no call repeats the last.
fn time<const N: usize>(name: &str, a: &Piece<N>, b: &Piece<N>, rotation: Rotation<N>, height: f64) {
    let (mut cache, mut scratch, mut out) = (PairCache::default(), Scratch::default(), Manifold::EMPTY);
    let rounds = 20_000_u32;
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        for round in 0..rounds {
            let mut centre = Vector::splat(0.17);
            centre[1] = height + 1e-6 * f64::from(round % 7);
            let pose = Pose::new(rotation, centre);
            collide(a, &Pose::IDENTITY, b, &pose, 0.02, &mut cache, &mut scratch, &mut out);
            black_box(&out);
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(rounds));
    }
    println!("{N}D  {name:<32} {best:>9.0} ns  {:>2} points", out.points().len());
}

fn tilt<const N: usize>(angle: f64) -> Rotation<N> {
    let mut planes = Bivector::ZERO;
    for i in 0..N {
        for j in i + 1..N {
            planes.set(i, j, angle * (1.0 + 0.1 * (i + 2 * j) as f64));
        }
    }
    Rotation::exp(&planes)
}

fn boxes<const N: usize>() {
    let cuboid = |half: f64| {
        let shape = Shape::<N>::cuboid(Vector::splat(half)).expect("a positive half-extent");
        shape.pieces().remove(0).1
    };
    let (large, small) = (cuboid(1.0), cuboid(0.5));
    time("box on box, aligned", &large, &small, Rotation::IDENTITY, 1.499);
    time("box on box, turned by the normal", &large, &small, tilt_around_normal(0.3), 1.499);
    time("box on box, tilted by 0.001", &large, &small, tilt(1e-3), 1.499);
    time("box in box, tilted by 0.3", &large, &small, tilt(0.3), 1.5);
    time("box over box, apart", &large, &small, tilt(0.3), 2.4);
}

/// Turns every plane without axis 1, the contact's normal.
fn tilt_around_normal<const N: usize>(angle: f64) -> Rotation<N> {
    let mut planes = Bivector::ZERO;
    for i in (0..N).filter(|&i| i != 1) {
        for j in (i + 1..N).filter(|&j| j != 1) {
            planes.set(i, j, angle * (1.0 + 0.1 * (i + 2 * j) as f64));
        }
    }
    Rotation::exp(&planes)
}

fn main() {
    boxes::<2>();
    boxes::<3>();
    boxes::<4>();
    boxes::<5>();
    boxes::<6>();
}

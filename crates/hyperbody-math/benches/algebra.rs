//! Nanoseconds of the basic operations in every dimension: `cargo bench -p hyperbody-math`.
//!
//! The best of several rounds, inputs and results hidden from the optimiser; a few nanoseconds of every figure are the
//! passing of arguments through memory that this takes.

use std::hint::black_box;
use std::time::Instant;

use hyperbody_math::{Bivector, Dim, EvenAlgebra, Rotation, Rotor, Vector, planes, symmetric_eigen};

const ROUNDS: usize = 7;
const REPEATS: u32 = 20_000;

fn time<T>(what: &str, mut operation: impl FnMut() -> T) {
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        for _ in 0..REPEATS {
            black_box(operation());
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(REPEATS));
    }
    println!("  {what:<24}{best:>10.1} ns");
}

fn measure<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let numbers: Vec<f64> = (0..planes::count(N)).map(|p| (p * 7 % 11) as f64 * 0.1 - 0.4).collect();
    let b = Bivector::<N>::from_planes(&numbers).expect("one number per plane");
    let a = Rotor::exp(&b);
    let c = Rotor::exp(&(b * 1.3)) * Rotor::in_plane(0, 1, 0.3);
    let (ra, rc) = (a.to_rotation(), c.to_rotation());
    let x = Vector::<N>::from_fn(|i| i as f64 + 0.3);
    println!("{N} dimensions");
    time("rotor · rotor", || black_box(a) * black_box(c));
    time("matrix · matrix", || black_box(ra) * black_box(rc));
    time("rotor turns vector", || black_box(a).rotate(black_box(x)));
    time("matrix turns vector", || black_box(ra).rotate(black_box(x)));
    time("rotor turns bivector", || black_box(a).rotate_bivector(black_box(&b)));
    time("matrix turns bivector", || black_box(ra).rotate_bivector(black_box(&b)));
    time("repair of a rotor", || black_box(a).repair());
    time("rotor to matrix", || black_box(a).to_rotation());
    time("matrix to rotor", || Rotor::from_rotation(black_box(&ra)));
    time("exp of a rotor", || Rotor::exp(black_box(&b)));
    time("exp of a matrix", || Rotation::exp(black_box(&b)));
    time("log of a rotor", || black_box(a).log());
    time("log of a matrix", || black_box(ra).log());
    time("eigenvectors", || symmetric_eigen(black_box(ra.matrix())));
}

fn main() {
    measure::<2>();
    measure::<3>();
    measure::<4>();
    measure::<5>();
    measure::<6>();
}

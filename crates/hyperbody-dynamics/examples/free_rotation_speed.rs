//! Nanoseconds per free-rotation step in each dimension.

use std::hint::black_box;
use std::time::Instant;

use hyperbody_dynamics::free_top::free_rotation_step;
use hyperbody_math::{Bivector, Rotation, Vector};

fn time<const N: usize>() {
    let moments = Vector::<N>::from_fn(|i| (N - i) as f64);
    let values: Vec<f64> = (0..N * (N - 1) / 2).map(|k| 0.3 + 0.1 * k as f64).collect();
    let momentum = Bivector::<N>::from_planes(&values).expect("one number per plane");
    let mut attitude = Rotation::IDENTITY;
    let steps = 1_000_000;
    let start = Instant::now();
    for _ in 0..steps {
        free_rotation_step(&mut attitude, black_box(&momentum), black_box(&moments), 1.0 / 240.0);
    }
    let nanoseconds = start.elapsed().as_secs_f64() * 1e9 / f64::from(steps);
    black_box(attitude);
    println!("{N}D: {nanoseconds:.0} ns per step");
}

fn main() {
    time::<2>();
    time::<3>();
    time::<4>();
    time::<5>();
    time::<6>();
}

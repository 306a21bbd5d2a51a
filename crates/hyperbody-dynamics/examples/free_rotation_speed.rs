//! Nanoseconds per step of the free rotation: the world's step in every dimension, the methods of the laboratory in 4D.
//! Each figure is the best of twenty batches, which other work on the machine disturbs least.

use std::hint::black_box;
use std::time::Instant;

use hyperbody_dynamics::free_top::{FreeTop, Method, TopState, free_rotation_step};
use hyperbody_math::{Bivector, Rotation, Vector, planes};

const BATCHES: usize = 20;
const STEPS: usize = 50_000;
const DT: f64 = 1.0 / 240.0;

fn moments<const N: usize>() -> Vector<N> {
    Vector::from_fn(|i| (N - i) as f64)
}

fn momentum<const N: usize>() -> Bivector<N> {
    let values: Vec<f64> = (0..planes::count(N)).map(|k| 0.3 + 0.1 * k as f64).collect();
    Bivector::from_planes(&values).expect("one number per plane")
}

fn best_nanoseconds(mut step: impl FnMut()) -> f64 {
    let batches = (0..BATCHES).map(|_| {
        let start = Instant::now();
        (0..STEPS).for_each(|_| step());
        start.elapsed().as_secs_f64() * 1e9 / STEPS as f64
    });
    batches.fold(f64::INFINITY, f64::min)
}

fn time_world_step<const N: usize>() {
    let (moments, momentum, mut attitude) = (moments::<N>(), momentum::<N>(), Rotation::IDENTITY);
    let best = best_nanoseconds(|| {
        free_rotation_step(&mut attitude, black_box(&momentum), black_box(&moments), DT);
    });
    black_box(attitude);
    println!("{:<24} {N}D {best:6.0} ns per step", "step of the world");
}

fn time_method<const N: usize>(method: Method) {
    let top = FreeTop::new(moments::<N>()).expect("positive moments");
    let mut state = TopState { world_from_body: Rotation::IDENTITY, momentum_in_body: momentum::<N>() };
    let best = best_nanoseconds(|| method.step(&top, &mut state, DT).expect("a short step"));
    black_box(state);
    println!("{:<24} {N}D {best:6.0} ns per step", method.name());
}

fn main() {
    time_world_step::<2>();
    time_world_step::<3>();
    time_world_step::<4>();
    time_world_step::<5>();
    time_world_step::<6>();
    for method in Method::ALL.into_iter().filter(|&method| method != Method::Exact) {
        time_method::<4>(method);
    }
    time_method::<6>(Method::Splitting4);
}

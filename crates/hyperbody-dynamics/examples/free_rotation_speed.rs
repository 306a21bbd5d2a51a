//! How fast the free rotation is: nanoseconds per step (the world's step in every dimension, the methods of the laboratory
//! in 4D; each the best of twenty batches, which other work on the machine disturbs least), a million steps of one 4D top
//! on one thread, and a stability map of 400 × 400 cells with measured growth on all threads.

use std::hint::black_box;
use std::time::Instant;

use hyperbody_dynamics::free_top::{FreeTop, MapRange, Method, TopState, free_rotation_step, map_spins};
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

fn time_a_million_steps() {
    let top = FreeTop::new(moments::<4>()).expect("positive moments");
    let mut state = TopState { world_from_body: Rotation::IDENTITY, momentum_in_body: momentum::<4>() };
    let start = Instant::now();
    for _ in 0..1_000_000 {
        Method::Splitting2.step(&top, &mut state, DT).expect("the splitting always succeeds");
    }
    println!("a million steps of splitting2 in 4D: {:.3} s", start.elapsed().as_secs_f64());
    black_box(state);
}

fn time_a_map() {
    let top = FreeTop::new(moments::<4>()).expect("positive moments");
    let range = MapRange::new(-1.5, 1.5, 400).expect("a range");
    let start = Instant::now();
    let map = map_spins(&top, [(0, 3), (1, 2)], range, range, &|_, _| {}).expect("a map");
    println!("a map of {} cells with measured growth: {:.2} s", map.cells.len(), start.elapsed().as_secs_f64());
}

fn main() {
    time_a_million_steps();
    time_a_map();
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

//! The long run of the narrow phase's fuzzing, with the worst cases printed: `cargo run --release -p
//! hyperbody-collision --example fuzz_narrow -- PAIRS [SEED]`.

#[path = "../tests/all/common/mod.rs"]
mod common;

use common::fuzz::{Plan, run};

fn check<const N: usize>(pairs: u64, seed: u64) {
    for spread in [1.5, 1e3] {
        let start = std::time::Instant::now();
        // Hulls of differences cost far more than what they check: a tenth of the pairs has them.
        let mut report = run::<N>(Plan { pairs: pairs / 10, seed, hull_points: 600, spread });
        let rest = run::<N>(Plan { pairs: pairs - pairs / 10, seed: seed + 1, hull_points: 0, spread });
        report.merge(&rest);
        println!("N = {N}, sizes {} to {spread}: {report:#?}", 1.0 / spread);
        println!("{:?} of the last {} pairs, {:.1} s", rest.effort, rest.pairs, start.elapsed().as_secs_f64());
    }
}

fn main() {
    let mut numbers = std::env::args().skip(1).filter_map(|text| text.parse().ok());
    let pairs = numbers.next().unwrap_or(10_000);
    let seed = numbers.next().unwrap_or(1);
    check::<2>(pairs, seed);
    check::<3>(pairs, seed);
    check::<4>(pairs, seed);
    check::<5>(pairs, seed);
    check::<6>(pairs, seed);
}

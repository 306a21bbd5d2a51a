//! The long run of the narrow phase's fuzzing, with the worst cases and the iteration maxima printed:
//! `cargo run --release -p hyperbody-collision --example fuzz_narrow -- PAIRS [SEED [DIMENSION]]`.
//!
//! Without a dimension it goes through all of them. A pair that breaks a rule ends the run with its number, which
//! reproduces it.

#[path = "../tests/all/common/mod.rs"]
mod common;

use common::fuzz::{Plan, Report, run};
use hyperbody_collision::limits;

/// Pairs between two lines on standard error.
const CHUNK: u64 = 10_000;

fn check<const N: usize>(pairs: u64, seed: u64) {
    for spread in [1.5, 1e3] {
        let start = std::time::Instant::now();
        let mut total = Report::default();
        let mut done = 0;
        while done < pairs / 2 {
            // Hulls of differences cost far more than what they check: one pair in a hundred has them.
            let chunk = CHUNK.min(pairs / 2 - done);
            let (with_hull, without) = (chunk.div_ceil(100), chunk - chunk.div_ceil(100));
            let seed = seed.wrapping_add(2 * done);
            let face_pairs = 4000;
            let mut report = run::<N>(Plan { pairs: with_hull, seed, hull_points: 200, face_pairs, spread });
            report.merge(&run::<N>(Plan { pairs: without, seed: seed + 1, hull_points: 0, face_pairs, spread }));
            total.merge(&report);
            done += chunk;
            eprintln!(
                "N = {N}, sizes {} to {spread}: {done} pairs, {:.0} s",
                1.0 / spread,
                start.elapsed().as_secs_f64()
            );
        }
        let effort = total.effort;
        println!("N = {N}, sizes {} to {spread}, {:.0} s: {total:#?}", 1.0 / spread, start.elapsed().as_secs_f64());
        println!("turns of a distance search at most {} of {}", effort.gjk_turns, limits::MAX_GJK_TURNS);
        println!(
            "vertices of a penetration search at most {} of {}",
            effort.epa_vertices,
            limits::MAX_EPA_VERTICES + N + 1
        );
        println!("facets of a penetration search at most {}, bound {}", effort.epa_facets, limits::MAX_EPA_FACETS);
        println!("turns of a descent at most {} of {}", effort.descent_turns, limits::MAX_DESCENT_TURNS);
        println!("vertices of a patch before it is reduced at most {}", effort.patch_vertices);
    }
}

fn main() {
    let mut numbers = std::env::args().skip(1).filter_map(|text| text.parse().ok());
    let pairs = numbers.next().unwrap_or(10_000);
    let seed = numbers.next().unwrap_or(1);
    let only = numbers.next();
    for n in only.map_or(2..=6, |n| n..=n) {
        match n {
            2 => check::<2>(pairs, seed),
            3 => check::<3>(pairs, seed),
            4 => check::<4>(pairs, seed),
            5 => check::<5>(pairs, seed),
            6 => check::<6>(pairs, seed),
            _ => eprintln!("{n} is not a dimension of this engine: 2 to 6 are"),
        }
    }
}

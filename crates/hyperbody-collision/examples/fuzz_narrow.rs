//! The long run of the narrow phase's fuzzing, with the worst cases and the iteration maxima printed:
//! `cargo run --release -p hyperbody-collision --example fuzz_narrow -- PAIRS [SEED [DIMENSION [FIRST]]]`.
//!
//! Without a dimension it goes through all of them. Half of the pairs are of sizes within 1.5 of each other, half of sizes
//! from 1e-3 to 1e3. FIRST is the number of the first pair, so that a long run can be made in parts, and a pair that breaks
//! a rule looked at alone. A run in which one does goes on to its end and exits with 1.

#[path = "../tests/all/common/mod.rs"]
mod common;

use common::fuzz::{Plan, Report, check_drawn};
use hyperbody_collision::{Scratch, limits};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Pairs between two lines on standard error.
const CHUNK: u64 = 10_000;

/// Hulls of all differences cost far more than what they check: one pair in so many has them.
const WITH_HULL: u64 = 100;

/// Checks a range of pairs; how many break a rule, and the worst of the others.
fn sweep<const N: usize>(pairs: u64, first: u64, seed: u64, spread: f64) -> (u64, Report) {
    let start = std::time::Instant::now();
    let (mut broken, mut total, mut shapes, mut scratch) = (0, Report::default(), None, Scratch::default());
    for index in first..first + pairs {
        let hull_points = if index.is_multiple_of(WITH_HULL) { 200 } else { 0 };
        let plan = Plan { pairs: 1, seed, hull_points, face_pairs: 4000, spread };
        match catch_unwind(AssertUnwindSafe(|| check_drawn::<N>(plan, index, &mut shapes, &mut scratch))) {
            Ok(report) => total.merge(&report),
            // The panic has named the pair.
            Err(_) => broken += 1,
        }
        let done = index + 1 - first;
        if done.is_multiple_of(CHUNK) || done == pairs {
            let seconds = start.elapsed().as_secs_f64();
            eprintln!("N = {N}, sizes {} to {spread}: {done} pairs, {broken} broken, {seconds:.0} s", 1.0 / spread);
        }
    }
    total.effort = scratch.effort();
    (broken, total)
}

fn check<const N: usize>(pairs: u64, first: u64, seed: u64) -> u64 {
    let mut all_broken = 0;
    for spread in [1.5, 1e3] {
        let start = std::time::Instant::now();
        let (broken, total) = sweep::<N>(pairs.div_ceil(2), first, seed, spread);
        all_broken += broken;
        let effort = total.effort;
        println!("N = {N}, sizes {} to {spread}, {:.0} s: {total:#?}", 1.0 / spread, start.elapsed().as_secs_f64());
        println!("pairs that break a rule: {broken}");
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
    all_broken
}

fn main() {
    let mut numbers = std::env::args().skip(1).filter_map(|text| text.parse().ok());
    let pairs = numbers.next().unwrap_or(10_000).max(1);
    let seed = numbers.next().unwrap_or(1);
    let only = numbers.next();
    let first = numbers.next().unwrap_or(0);
    let mut broken = 0;
    for n in only.map_or(2..=6, |n| n..=n) {
        broken += match n {
            2 => check::<2>(pairs, first, seed),
            3 => check::<3>(pairs, first, seed),
            4 => check::<4>(pairs, first, seed),
            5 => check::<5>(pairs, first, seed),
            6 => check::<6>(pairs, first, seed),
            _ => {
                eprintln!("{n} is not a dimension of this engine: 2 to 6 are");
                1
            }
        };
    }
    std::process::exit(i32::from(broken > 0));
}

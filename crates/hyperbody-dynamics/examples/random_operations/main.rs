//! Random operations on worlds of two to six dimensions, and what came of them:
//! `cargo run --release -p hyperbody-dynamics --example random_operations [SEEDS [OPERATIONS]]`.
//!
//! 100 seeds of 10,000 operations each if nothing is said. Ends with status 1 if a handle of what is gone was taken, a pair leaked, or
//! the world was not what it must be.

mod dice;
mod joints;
mod player;
mod tally;

use std::process::ExitCode;
use std::time::Instant;

use player::play;
use tally::{OPERATIONS, Tally};

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1).map(|argument| argument.parse::<usize>());
    let (seeds, operations) = match (arguments.next(), arguments.next()) {
        (None, _) => (100, 10_000),
        (Some(Ok(seeds)), None) => (seeds, 10_000),
        (Some(Ok(seeds)), Some(Ok(operations))) => (seeds, operations),
        _ => {
            eprintln!("random_operations takes two whole numbers: seeds, and operations for each");
            return ExitCode::from(2);
        }
    };
    let start = Instant::now();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let next = std::sync::atomic::AtomicUsize::new(0);
    let sums: Vec<Tally> = std::thread::scope(|scope| {
        let worker = || {
            let mut sum = Tally::default();
            loop {
                let seed = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                if seed >= seeds {
                    return sum;
                }
                match std::panic::catch_unwind(|| play_in_turn(seed, operations)) {
                    Ok(tally) => sum.add(&tally),
                    Err(_) => sum.panics.push(seed),
                }
            }
        };
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        workers.into_iter().map(|worker| worker.join().expect("no panic")).collect()
    });
    let mut sum = Tally::default();
    sums.iter().for_each(|part| sum.add(part));

    println!("{seeds} seeds of {operations} operations, in 2D to 6D by turns, {:.0} s", start.elapsed().as_secs_f64());
    for ((_, words, _), (done, refused)) in OPERATIONS.iter().zip(sum.done) {
        println!("{words:>26} {done:>9}   refused or nothing to do {refused:>7}");
    }
    println!("at most {} bodies, {} joints and {} pairs at once", sum.most[0], sum.most[1], sum.most[2]);
    println!("calls with stale handles: {} tried, {} refused", sum.stale_tried, sum.stale_refused);
    println!("bodies in quarantine at the end: {}", sum.quarantined);
    println!("seeds that panicked: {:?}", sum.panics);
    println!("pairs left when all bodies were removed: {}", sum.pairs_leaked);
    if sum.is_clean() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn play_in_turn(seed: usize, operations: usize) -> Tally {
    match seed % 5 {
        0 => play::<2>(seed as u64, operations),
        1 => play::<3>(seed as u64, operations),
        2 => play::<4>(seed as u64, operations),
        3 => play::<5>(seed as u64, operations),
        _ => play::<6>(seed as u64, operations),
    }
}

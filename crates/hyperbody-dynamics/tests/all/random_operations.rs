//! Whatever is done to a world in whatever random order: nothing panics, nothing leaks, every handle of what is
//! gone is refused, and snapshots and roll-backs bring back what was. The example `random_operations` plays for longer.

#[path = "../../examples/random_operations/dice.rs"]
mod dice;
#[path = "../../examples/random_operations/joints.rs"]
mod joints;
#[path = "../../examples/random_operations/player.rs"]
mod player;
#[path = "../../examples/random_operations/tally.rs"]
mod tally;

use player::play;
use tally::{OPERATIONS, Tally};

#[test]
fn random_operations() {
    let mut sum = Tally::default();
    for seed in 0..4 {
        sum.add(&play::<2>(seed, 500));
        sum.add(&play::<3>(seed, 500));
        sum.add(&play::<4>(seed, 300));
    }
    sum.add(&play::<6>(0, 150));
    assert!(sum.is_clean(), "pairs leaked, or stale handles were taken: {sum:?}");
    assert_eq!(sum.quarantined, 0, "bodies went to infinity");
    for ((_, words, _), (done, _)) in OPERATIONS.iter().zip(sum.done) {
        assert!(done > 0, "no {words}: the test no longer does what it is for");
    }
}

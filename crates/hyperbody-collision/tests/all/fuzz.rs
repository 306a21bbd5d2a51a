//! The narrow phase against what is true by vertices and facets alone, over random pairs. `HYPERBODY_FUZZ_PAIRS` sets
//! the number per dimension; the example `fuzz_narrow` runs long and prints the worst.

use crate::common::fuzz::{Plan, run};
use hyperbody_collision::limits;

fn pairs() -> u64 {
    std::env::var("HYPERBODY_FUZZ_PAIRS").ok().and_then(|text| text.parse().ok()).unwrap_or(250)
}

fn check<const N: usize>() {
    // Hulls of many points in five and six dimensions would take most of the time.
    let hull_points = if N < 5 { 300 } else { 120 };
    for spread in [1.5, 1e3] {
        let report = run::<N>(Plan { pairs: pairs(), seed: 1, hull_points, face_pairs: 2000, spread });
        println!("N = {N}: {report:#?}");
        assert!(report.overlapping * 5 > report.pairs, "the draw must make overlaps");
        assert!(report.depths_compared * 50 > report.pairs, "depths must be compared with the hull of differences");
        let effort = report.effort;
        assert!(effort.gjk_turns * 2 < limits::MAX_GJK_TURNS, "turns must stay far below their bound: {effort:?}");
        assert!(report.depths_by_axes * 20 > report.pairs, "depths must be compared with separating axes");
        assert!((effort.epa_vertices as usize) < limits::MAX_EPA_VERTICES, "vertices must stay below: {effort:?}");
    }
}

#[test]
fn contacts_are_right() {
    for_every_dimension!(check);
}

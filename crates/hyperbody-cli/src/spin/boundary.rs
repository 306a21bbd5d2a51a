//! The curve between stable and unstable in a map, from the closed form alone.
//!
//! Marching squares on the verdicts at the corners of the cells; where two neighbours differ, bisection of the closed form
//! along the edge between them finds the crossing to rounding. So the curve is exact at every edge that it crosses, and a
//! check of the measured colours that it is drawn over.

use hyperbody::dynamics::free_top::{StabilityMap, Verdict};

/// A piece of the curve within one cell: its two ends as (x, y).
pub(super) type Segment = [[f64; 2]; 2];

/// Halvings of an edge: a part in 10¹² of it.
const HALVINGS: usize = 40;

/// Step off an open point, relative to the size of the map.
const NUDGE: f64 = 1e-9;

/// The curve on which `judge` changes from unstable to anything else, in the order of the cells.
pub(super) fn boundary(map: &StabilityMap, judge: &impl Fn(f64, f64) -> Verdict) -> Vec<Segment> {
    let mut segments = Vec::new();
    let width = map.x.value(usize::MAX) - map.x.value(0);
    let unstable_at = |x: f64, y: f64| match judge(x, y) {
        // Isoclinic spins are open in the midst of unstable ones: lines without width, which are no boundary.
        Verdict::Open => judge(x + NUDGE * width, y) == Verdict::Unstable,
        verdict => verdict == Verdict::Unstable,
    };
    let unstable = |column: usize, row: usize| match map.cell(column, row).map(|cell| cell.verdict) {
        Some(Verdict::Open) | None => unstable_at(map.x.value(column), map.y.value(row)),
        Some(verdict) => verdict == Verdict::Unstable,
    };
    for row in 0..map.y.count() - 1 {
        for column in 0..map.x.count() - 1 {
            let [x1, x2] = [column, column + 1].map(|index| map.x.value(index));
            let [y1, y2] = [row, row + 1].map(|index| map.y.value(index));
            // Corners and edges in the same order, all the way round.
            let points = [[x1, y1], [x2, y1], [x2, y2], [x1, y2]];
            let corners = [
                unstable(column, row),
                unstable(column + 1, row),
                unstable(column + 1, row + 1),
                unstable(column, row + 1),
            ];
            let crossings: Vec<[f64; 2]> = (0..4)
                .filter(|&edge| corners[edge] != corners[(edge + 1) % 4])
                .map(|edge| crossing(points[edge], points[(edge + 1) % 4], corners[edge], &unstable_at))
                .collect();
            match crossings[..] {
                [a, b] => segments.push([a, b]),
                [a, b, c, d] => {
                    let centre = unstable_at(0.5 * (x1 + x2), 0.5 * (y1 + y2));
                    // A saddle: the centre belongs to the corners of its own kind.
                    let pairs = if centre == corners[0] { [[a, b], [c, d]] } else { [[d, a], [b, c]] };
                    segments.extend(pairs);
                }
                _ => {}
            }
        }
    }
    segments
}

fn crossing(from: [f64; 2], to: [f64; 2], unstable_at_from: bool, unstable: &impl Fn(f64, f64) -> bool) -> [f64; 2] {
    let (mut low, mut high) = (0.0, 1.0);
    let at = |t: f64| [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])];
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        let [x, y] = at(middle);
        if unstable(x, y) == unstable_at_from {
            low = middle;
        } else {
            high = middle;
        }
    }
    at(0.5 * (low + high))
}

//! Local descent of the depth: for differences with more facets than the penetration search may look at.
//!
//! Moved by its depth d along n, b leaves a, and the hyperplane with normal n supports D at p = d·n. If p lies in D, no
//! direction near n is shallower, and the closest points are those of a touching pair. If not, let n′ be the direction from
//! the point of D nearest to p, and e > 0 their distance: then h(n′) = n′·p − e < d, so that n′ is shallower. Each turn
//! therefore lessens the depth, which bounds the true one from above all the way.

use hyperbody_math::{Pose, Vector};

use crate::difference::Difference;
use crate::gjk::{self, Proximity, Seeds};
use crate::limits;
use crate::round::Witness;

/// The deepest points near a direction, in a's frame. `normal` is a unit vector, from a to b; `turns`
/// is raised to the number of turns taken.
pub(crate) fn descend<const N: usize>(
    difference: &Difference<'_, N>,
    mut normal: Vector<N>,
    turns: &mut u32,
) -> Witness<N> {
    let mut depth = difference.reach(normal);
    let mut points = difference.vertices(difference.support(normal).key);
    for turn in 1..=limits::MAX_DESCENT_TURNS {
        *turns = turn.max(*turns);
        let Some((touching, toward_b)) = moved_apart(difference, normal, depth) else { break };
        points = touching;
        let Some(better) = toward_b else { break };
        let shallower = difference.reach(better);
        if shallower >= depth - limits::EPA_GAP * difference.scale {
            break;
        }
        (normal, depth) = (better, shallower);
    }
    let middle = (points[0] + points[1]) * 0.5;
    let half = normal * (0.5 * depth);
    Witness { normal, on_a: middle + half, on_b: middle - half, separation: -depth }
}

/// Where A and B touch once B has moved by `depth` along the unit `normal`, which frees it: the points in a's frame before
/// that move.
pub(crate) fn touching_points<const N: usize>(
    difference: &Difference<'_, N>,
    normal: Vector<N>,
    depth: f64,
) -> [Vector<N>; 2] {
    moved_apart(difference, normal, depth)
        .map_or_else(|| difference.vertices(difference.support(normal).key), |(points, _)| points)
}

/// The closest points of A and B moved by `depth` along `normal`, before that move, and the direction between them after it
/// unless they touch.
fn moved_apart<const N: usize>(
    difference: &Difference<'_, N>,
    normal: Vector<N>,
    depth: f64,
) -> Option<([Vector<N>; 2], Option<Vector<N>>)> {
    let freed =
        Pose { translation: difference.a_from_b.translation + normal * depth, rotation: difference.a_from_b.rotation };
    let moved = Difference { a_from_b: &freed, ..*difference };
    let (simplex, toward_b) = match gjk::closest(&moved, &Seeds::default(), normal, f64::INFINITY, &mut 0) {
        Proximity::Overlap(simplex) => (simplex, None),
        Proximity::Near(near) => (near.simplex, Some(near.normal)),
        Proximity::Apart { .. } => return None,
    };
    let [on_a, on_b] = simplex.witnesses(&moved);
    Some(([on_a, on_b - normal * depth], toward_b))
}

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
        let freed = Pose {
            translation: difference.a_from_b.translation + normal * depth,
            rotation: difference.a_from_b.rotation,
        };
        let touching = Difference { a_from_b: &freed, ..*difference };
        let proximity = gjk::closest(&touching, &Seeds::default(), normal, f64::INFINITY, &mut 0);
        let (simplex, toward_b) = match proximity {
            Proximity::Overlap(simplex) => (simplex, None),
            Proximity::Near(near) => (near.simplex, Some(near.normal)),
            Proximity::Apart { .. } => break,
        };
        let [on_a, on_b] = simplex.witnesses(&touching);
        points = [on_a, on_b - normal * depth];
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

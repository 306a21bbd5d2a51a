//! What is done where the distance search and the penetration search leave the answer unsure: directions between shapes that
//! all but touch, and ways out that may not be the shortest because the search ended at its bounds.

use hyperbody_geometry::Core;
use hyperbody_math::{Pose, Vector};

use crate::box_sat::Feature;
use crate::detect::SeparatingAxes;
use crate::difference::Difference;
use crate::gjk::{self, Proximity, Seeds};
use crate::narrow::Scratch;
use crate::round::Witness;
use crate::{descent, general, limits, overlap};

/// Closest points so near to each other that the direction between them is mostly rounding: pushed into each other a
/// little, the shapes have a way out whose direction is not. The direction that separates most is taken.
pub(super) fn sharpened<const N: usize>(
    difference: &Difference<'_, N>,
    witness: Witness<N>,
    scratch: &mut Scratch<N>,
) -> Witness<N> {
    let push = witness.separation + limits::PUSH * difference.scale;
    let pushed = Pose {
        translation: difference.a_from_b.translation - witness.normal * push,
        rotation: difference.a_from_b.rotation,
    };
    let overlapping = Difference { a_from_b: &pushed, ..*difference };
    let mut best = (witness.normal, -difference.reach(witness.normal));
    let mut consider = |normal: Vector<N>| {
        let separation = -difference.reach(normal);
        if separation > best.1 {
            best = (normal, separation);
        }
    };
    if let Some(facet) = overlap::best_facet(&overlapping, 0.0, Feature::None, witness.normal) {
        consider(facet.normal);
    }
    let proximity = gjk::closest(&overlapping, &Seeds::default(), witness.normal, f64::INFINITY, &mut 0);
    if let Proximity::Overlap(simplex) = proximity {
        consider(general::penetrate(&overlapping, &simplex, f64::INFINITY, scratch).normal);
    }
    let (normal, separation) = best;
    let middle = (witness.on_a + witness.on_b) * 0.5;
    let half = normal * (0.5 * separation);
    Witness { normal, on_a: middle - half, on_b: middle + half, separation }
}

/// The witness, or what a descent from the best facet normal finds if that is shallower.
pub(super) fn shallower_by_facet<const N: usize>(
    difference: &Difference<'_, N>,
    witness: Witness<N>,
    turns: &mut u32,
) -> Witness<N> {
    let thickness = overlap::thickness(difference);
    let Some(facet) = overlap::best_facet(difference, thickness, Feature::None, witness.normal) else { return witness };
    let by_facet = descent::descend(difference, facet.normal, turns);
    if by_facet.separation > witness.separation { by_facet } else { witness }
}

/// The witness, or what the separating axes of all pairs of faces find if that is shallower: the depth itself, where the
/// search ended at its bounds and the faces are few enough.
pub(super) fn shallower_by_axes<const N: usize>(difference: &Difference<'_, N>, witness: Witness<N>) -> Witness<N> {
    let few_faces = |core: &Core<N>| match core {
        Core::Polytope(polytope) => {
            polytope.facets().len() <= limits::MAX_AXES_FACETS && polytope.vertices().len() <= limits::MAX_AXES_VERTICES
        }
        Core::Point | Core::Segment { .. } | Core::Box { .. } => true,
    };
    if !(few_faces(difference.a) && few_faces(difference.b)) {
        return witness;
    }
    let (axes_a, axes_b) = (SeparatingAxes::prepare(difference.a), SeparatingAxes::prepare(difference.b));
    if axes_a.pairs_with(&axes_b) > limits::MAX_FACE_PAIRS {
        return witness;
    }
    let best = axes_a.separate(&Pose::IDENTITY, &axes_b, difference.a_from_b);
    let Some(axis) = best.filter(|best| best.separation > witness.separation) else { return witness };
    let [on_a, on_b] = descent::touching_points(difference, axis.normal, -axis.separation);
    let middle = (on_a + on_b) * 0.5;
    let half = axis.normal * (0.5 * axis.separation);
    Witness { normal: axis.normal, on_a: middle - half, on_b: middle + half, separation: axis.separation }
}

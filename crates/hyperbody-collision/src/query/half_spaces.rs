//! Two half-spaces: unbounded both, so that only those that face away from each other exactly have a distance or a depth.

use hyperbody_math::Vector;

use super::Separation;

/// Separation of two half-spaces in the world, each an outward unit normal and an offset.
pub(super) fn half_spaces<const N: usize>(a: (Vector<N>, f64), b: (Vector<N>, f64)) -> Separation<N> {
    let ((normal, offset_a), (normal_b, offset_b)) = (a, b);
    let on_a = normal * offset_a;
    if normal == -normal_b {
        let distance = -(offset_a + offset_b);
        return Separation { distance, normal, on_a, on_b: on_a + normal * distance, part_a: 0, part_b: 0 };
    }
    // Whatever the translation, they have points in common.
    Separation { distance: f64::NEG_INFINITY, normal, on_a, on_b: normal_b * offset_b, part_a: 0, part_b: 0 }
}

//! Where a contact goes when the bodies move on: with one of them, over the other.
//!
//! The rows of a contact keep the arms of the start of the step (`solver/contacts/excess.rs`). A ball that rolls takes its contact
//! along, and the arm of what it rolls on is the one that goes stale. Between surfaces of radii R_a and R_b the contact goes at
//! (R_b v_a + R_a v_b)/(R_a + R_b), as the point does at which two balls touch (D. J. Montana, 1988, for surfaces that do not
//! turn); facets have infinite radii, sharp edges and corners none.

use hyperbody_geometry::Core;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::Vector;

use crate::world::Collider;

/// A normal this near to a facet's is the facet's: the cosine of 2.5 degrees.
const FLAT_COSINE: f64 = 0.999;

/// The part of the excess of a contact that b has to take back, 0..=1; a takes the rest. `normal` points from a to b.
pub(crate) fn share_of_b<const N: usize>(a: &Collider<N>, b: &Collider<N>, normal: Vector<N>) -> f64 {
    let (radius_a, radius_b) = (radius_of_curvature(a, normal), radius_of_curvature(b, -normal));
    match (radius_a.is_finite(), radius_b.is_finite()) {
        (true, false) => 1.0,
        (false, true) => 0.0,
        (true, true) if radius_a + radius_b > 0.0 => radius_b / (radius_a + radius_b),
        // Facet on facet: the patch is mostly the smaller one's.
        _ => {
            let (reach_a, reach_b) = (a.reach * a.reach, b.reach * b.reach);
            reach_b / (reach_a + reach_b)
        }
    }
}

/// Of a piece where its outward normal is `normal`, m: infinite on a facet.
fn radius_of_curvature<const N: usize>(collider: &Collider<N>, normal: Vector<N>) -> f64 {
    let Piece::Convex(convex) = &collider.piece else { return f64::INFINITY };
    let local = collider.world_from_collider.rotation.inverse_rotate(normal);
    let flat = match &convex.core {
        Core::Point => false,
        // In the plane alone the side of a capsule is a facet.
        Core::Segment { half } => {
            N == 2 && half.dot(local).abs() < (1.0 - FLAT_COSINE * FLAT_COSINE).sqrt() * half.norm()
        }
        Core::Box { .. } => (0..N).any(|axis| local[axis].abs() > FLAT_COSINE),
        Core::Polytope(polytope) => {
            let facets = polytope.facets_of_vertex(polytope.support_vertex(local));
            facets.iter().any(|&facet| polytope.facets()[facet as usize].normal.dot(local) > FLAT_COSINE)
        }
    };
    if flat { f64::INFINITY } else { convex.radius }
}

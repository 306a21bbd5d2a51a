//! Whether a point, or an axis-aligned box, has something in common with a piece. Pieces are closed: their surface
//! belongs to them.

use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Aabb, Convex, Core};
use hyperbody_math::{Pose, Rotation, Vector};

use crate::difference::Difference;
use crate::gjk::{self, Proximity, Seeds};
use crate::limits::FARTHEST;

/// Whether a point, in the frame of the piece, lies in it. Points that are not finite, or beyond
/// [`FARTHEST`], lie in nothing.
#[must_use]
pub fn contains<const N: usize>(piece: &Piece<N>, point: Vector<N>) -> bool {
    if !(0.0..=FARTHEST).contains(&point.max_abs()) {
        return false;
    }
    match piece {
        Piece::HalfSpace { normal, offset } => normal.dot(point) <= *offset,
        Piece::Convex(Convex { core, radius }) => match core {
            Core::Point => point.norm() <= *radius,
            Core::Segment { half } => {
                let along = (point.dot(*half) / half.norm_sq()).clamp(-1.0, 1.0);
                (point - *half * along).norm() <= *radius
            }
            Core::Box { half_extents } => (point - point.min(*half_extents).max(-*half_extents)).norm() <= *radius,
            Core::Polytope(polytope) => {
                let inside = polytope.facets().iter().all(|facet| facet.normal.dot(point) <= facet.offset);
                inside || (*radius > 0.0 && overlap(core, &Core::Point, &Pose::from_translation(point), *radius))
            }
        },
    }
}

/// Whether an axis-aligned box in the world and a piece at `world_from_piece` have a point in common. Touching within
/// the rounding of the distance search counts as common.
#[must_use]
pub fn overlaps_aabb<const N: usize>(piece: &Piece<N>, world_from_piece: &Pose<N>, aabb: &Aabb<N>) -> bool {
    let half_extents = (aabb.upper - aabb.lower) * 0.5;
    match piece {
        Piece::HalfSpace { normal, offset } => {
            let normal = world_from_piece.rotation.rotate(*normal);
            let offset = offset + normal.dot(world_from_piece.translation);
            normal.dot(aabb.centre()) - normal.abs().dot(half_extents) <= offset
        }
        Piece::Convex(Convex { core, radius }) => {
            let world_from_box = Pose::new(Rotation::IDENTITY, aabb.centre());
            overlap(core, &Core::Box { half_extents }, &world_from_piece.relative(&world_from_box), *radius)
        }
    }
}

/// Whether two cores are at most `distance` apart.
fn overlap<const N: usize>(a: &Core<N>, b: &Core<N>, a_from_b: &Pose<N>, distance: f64) -> bool {
    let difference = Difference::new(a, b, a_from_b);
    match gjk::closest(&difference, &Seeds::default(), a_from_b.translation, distance, &mut 0) {
        Proximity::Apart { .. } => false,
        Proximity::Near(closest) => closest.distance <= distance,
        Proximity::Overlap(_) => true,
    }
}

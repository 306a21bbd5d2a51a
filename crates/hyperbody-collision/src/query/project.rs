//! The point of a shape's surface nearest to a given point.

use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Convex, Core, Shape};
use hyperbody_math::{Pose, Vector};

use super::separation::separation_of_pieces;
use crate::narrow::Scratch;

/// Where a point lies with regard to a shape, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection<const N: usize> {
    /// The nearest point of the shape's surface.
    pub point: Vector<N>,
    /// Outward unit normal of the surface there: from `point` to the given point if that is outside, the opposite if it
    /// is inside.
    pub normal: Vector<N>,
    /// Distance to the surface, m; negative inside.
    pub distance: f64,
    /// Which part of a compound; 0 for every other shape.
    pub part: u32,
}

/// The nearest point of the surface of a shape at `world_from_shape`. Inside a compound it is that of the part in which
/// the point lies deepest, which may be hidden in another part. `None` for numbers that are not finite.
#[must_use]
pub fn project<const N: usize>(
    point: impl Into<Vector<N>>,
    shape: &Shape<N>,
    world_from_shape: &Pose<N>,
) -> Option<Projection<N>> {
    let point = point.into();
    let mut scratch = Scratch::default();
    let mut best: Option<Projection<N>> = None;
    for (part, (shape_from_piece, piece)) in shape.pieces().iter().enumerate() {
        let pose = *world_from_shape * *shape_from_piece;
        let Some(found) = project_on_piece(point, piece, &pose, &mut scratch) else { continue };
        if best.is_none_or(|best| found.distance < best.distance) {
            best = Some(Projection { part: part as u32, ..found });
        }
    }
    best
}

/// [`project`] on one piece.
#[must_use]
pub fn project_on_piece<const N: usize>(
    point: Vector<N>,
    piece: &Piece<N>,
    world_from_piece: &Pose<N>,
    scratch: &mut Scratch<N>,
) -> Option<Projection<N>> {
    let speck = Piece::Convex(Convex { core: Core::Point, radius: 0.0 });
    let found = separation_of_pieces(piece, world_from_piece, &speck, &Pose::from_translation(point), scratch)?;
    Some(Projection { point: found.on_a, normal: found.normal, distance: found.distance, part: 0 })
}

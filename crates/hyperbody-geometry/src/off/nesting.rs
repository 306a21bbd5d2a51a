//! Which pieces of a surface lie within others, and so bound hollows.
//!
//! A piece lies within another one if all its points do that are clearly off the other: its vertices and the middles of its
//! simplices, so that a hollow may touch the surface around it. Whether a point does is told by the winding number, for whose
//! ray boxes along it sort out all but a few simplices. Most pairs of pieces are told apart by their boxes, in one sweep.

use hyperbody_math::Vector;

use crate::decompose::{Crossing, Wall, winding_number};
use crate::error::GeometryErrorKind::{BadCount, BadMesh};
use crate::tolerances::MAX_NESTING_WORK;
use crate::{GeometryError, Result};

/// A connected piece of a surface.
#[derive(Default)]
pub(super) struct Piece<const N: usize> {
    pub(super) simplices: Vec<[u32; N]>,
    /// The number of its first facet in the file, to be named in messages; in the plane that of the polygon.
    pub(super) facet: usize,
}

struct Extent<const N: usize> {
    low: Vector<N>,
    high: Vector<N>,
}

impl<const N: usize> Extent<N> {
    fn of(points: impl Iterator<Item = Vector<N>>) -> Self {
        let none = Self { low: Vector::splat(f64::INFINITY), high: Vector::splat(f64::NEG_INFINITY) };
        points.fold(none, |box_, p| Self { low: box_.low.min(p), high: box_.high.max(p) })
    }

    fn holds(&self, inner: &Self, margin: f64) -> bool {
        (0..N).all(|axis| self.low[axis] <= inner.low[axis] + margin && inner.high[axis] <= self.high[axis] + margin)
    }
}

/// For each piece whether it lies within an odd number of the others; points closer than `margin` to a surface are on it.
///
/// # Errors
/// `BadMesh` if a piece has no point that is clearly off another one around it; `BadCount` if it would take minutes to tell.
pub(super) fn hollows<const N: usize>(pieces: &[Piece<N>], points: &[Vector<N>], margin: f64) -> Result<Vec<bool>> {
    let mut hollow = vec![false; pieces.len()];
    let mut work = 0;
    for (outer, inner) in candidates(pieces, points, margin, &mut work)? {
        let around = Around::new(&pieces[outer].simplices, points, margin);
        for piece in inner {
            let places = places(&pieces[piece].simplices, points);
            spend(&mut work, places.len() * pieces[outer].simplices.len(), pieces.len())?;
            let mut within = None;
            for side in places.into_iter().filter_map(|place| around.holds(place)) {
                within = Some(side);
                // One that is outside is enough: the surfaces cross.
                if !side {
                    break;
                }
            }
            let Some(within) = within else { return Err(doubtful(pieces[piece].facet, pieces[outer].facet)) };
            hollow[piece] ^= within;
        }
    }
    Ok(hollow)
}

/// The pieces within the box of each piece, for those where there are any.
fn candidates<const N: usize>(
    pieces: &[Piece<N>],
    points: &[Vector<N>],
    margin: f64,
    work: &mut usize,
) -> Result<Vec<(usize, Vec<usize>)>> {
    let corners = |piece: &Piece<N>| Extent::of(piece.simplices.iter().flatten().map(|&v| points[v as usize]));
    let extents: Vec<Extent<N>> = pieces.iter().map(corners).collect();
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by(|&a, &b| extents[a].low[0].total_cmp(&extents[b].low[0]));
    let mut inner: Vec<Vec<usize>> = vec![Vec::new(); pieces.len()];
    let (mut begun, mut next): (Vec<usize>, usize) = (Vec::new(), 0);
    for &piece in &order {
        let extent = &extents[piece];
        while next < order.len() && extents[order[next]].low[0] <= extent.low[0] + margin {
            begun.push(order[next]);
            next += 1;
        }
        // The others have ended before this one begins.
        begun.retain(|&other| extents[other].high[0] >= extent.low[0] - margin);
        spend(work, begun.len(), pieces.len())?;
        for &other in begun.iter().filter(|&&other| other != piece && extents[other].holds(extent, margin)) {
            inner[other].push(piece);
        }
    }
    Ok(inner.into_iter().enumerate().filter(|(_, inner)| !inner.is_empty()).collect())
}

/// The vertices of a piece, and the middles of its simplices.
fn places<const N: usize>(simplices: &[[u32; N]], points: &[Vector<N>]) -> Vec<Vector<N>> {
    let mut vertices: Vec<u32> = simplices.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let middle = |simplex: &[u32; N]| simplex.iter().fold(Vector::ZERO, |sum, &v| sum + points[v as usize]) / N as f64;
    vertices.iter().map(|&v| points[v as usize]).chain(simplices.iter().map(middle)).collect()
}

/// A piece that may lie around others.
struct Around<const N: usize> {
    simplices: Vec<[Vector<N>; N]>,
    /// Of simplices that have an area.
    walls: Vec<Wall<N>>,
    /// The direction of rays, and directions orthogonal to it and to each other.
    frame: [Vector<N>; N],
    /// Boxes of the simplices in this frame, a little larger.
    extents: Vec<Extent<N>>,
    margin: f64,
}

impl<const N: usize> Around<N> {
    fn new(simplices: &[[u32; N]], points: &[Vector<N>], margin: f64) -> Self {
        let simplices: Vec<[Vector<N>; N]> =
            simplices.iter().map(|simplex| simplex.map(|v| points[v as usize])).collect();
        // No mesh is likely to be aligned with it.
        let direction = Vector::<N>::from_fn(|axis| (axis as f64 * 0.754_877_666_246_693 + 0.618).fract() - 0.5);
        let mut frame = direction.normalize_or_zero().orthonormal_complement();
        frame[N - 1] = direction.normalize_or_zero();
        let turned = |corner: Vector<N>| Vector::from_fn(|axis| frame[axis].dot(corner));
        let extents = simplices.iter().map(|corners| {
            let tight = Extent::of(corners.iter().map(|&corner| turned(corner)));
            Extent { low: tight.low - Vector::splat(margin), high: tight.high + Vector::splat(margin) }
        });
        let extents = extents.collect();
        let walls = simplices.iter().filter_map(|corners| Wall::new(*corners)).collect();
        Self { simplices, walls, frame, extents, margin }
    }

    /// Whether the surface winds around a point; `None` if the point is on it, or nearly.
    fn holds(&self, point: Vector<N>) -> Option<bool> {
        if self.walls.iter().any(|wall| wall.is_near(point, self.margin)) {
            return None;
        }
        let place = Vector::<N>::from_fn(|axis| self.frame[axis].dot(point));
        let meets = |extent: &Extent<N>| {
            (0..N - 1).all(|axis| extent.low[axis] <= place[axis] && place[axis] <= extent.high[axis])
                && place[N - 1] <= extent.high[N - 1]
        };
        let mut winding = 0;
        for (corners, _) in self.simplices.iter().zip(&self.extents).filter(|(_, extent)| meets(extent)) {
            match Crossing::of(corners, point, self.frame[N - 1]) {
                Crossing::Away => {}
                Crossing::Through(sign) => winding += sign,
                Crossing::Edge => return winding_number(&self.simplices, point).ok().map(|winding| winding != 0),
            }
        }
        Some(winding != 0)
    }
}

fn spend(work: &mut usize, more: usize, pieces: usize) -> Result<()> {
    *work = work.saturating_add(more);
    if *work <= MAX_NESTING_WORK {
        return Ok(());
    }
    let message = format!(
        "the surface has {pieces} pieces of which too many may lie within others to tell in a few seconds which bound hollows; put \
         fewer or simpler pieces into one file, and give several files as parts of a compound"
    );
    Err(GeometryError::new(BadCount, message))
}

fn doubtful(inner: usize, outer: usize) -> GeometryError {
    let message = format!(
        "the pieces of the surface with faces {inner} and {outer} lie upon each other, so that it is not clear whether one is a hollow \
         in the other: remove one of them, or move them apart"
    );
    GeometryError::new(BadMesh, message)
}

//! Which pieces of a surface lie within others, and so bound hollows.
//!
//! A piece lies within another one if all its points do that are clearly off the other: its vertices and the middles of its
//! simplices, so that a hollow may touch the surface around it. What is off is told by the digits of the coordinates, and if nothing
//! is, by what rounding leaves of any number. Whether a point does is told by the winding number, for whose
//! ray boxes along it sort out all but a few simplices. Most pairs of pieces are told apart by their boxes, in one sweep.

use hyperbody_math::{Matrix, Vector};

use crate::decompose::{Crossing, Wall, winding_number};
use crate::error::GeometryErrorKind::{BadCount, BadMesh};
use crate::order;
use crate::tolerances::MAX_NESTING_WORK;
use crate::{GeometryError, Result};

/// Content of a piece, in parts of another one's, that is none.
const CRUMB: f64 = 1e-12;

/// What a pair of pieces costs at least, in looks at a box.
const PAIR: usize = 100;

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

/// For each piece whether it lies within an odd number of the others. Points closer than `margins[0]` to a surface are on it, or if
/// that is so of all points of a piece, those closer than the smaller `margins[1]`.
///
/// # Errors
/// `BadMesh` if a piece has no point that is clearly off another one around it; `BadCount` if it would take minutes to tell.
pub(super) fn hollows<const N: usize>(
    pieces: &[Piece<N>],
    points: &[Vector<N>],
    margins: [f64; 2],
) -> Result<Vec<bool>> {
    let mut hollow = vec![false; pieces.len()];
    let mut work = 0;
    for (outer, inner) in candidates(pieces, points, margins[0], &mut work)? {
        let around = Around::new(&pieces[outer].simplices, points, margins[0]);
        for piece in inner {
            let places = places(&pieces[piece].simplices, points);
            let mut all_within = |margin: f64| {
                let mut sides = places.iter().filter_map(|&place| around.holds(place, margin, &mut work));
                // One that is outside is enough: the surfaces cross.
                sides.next().map(|first| first && sides.all(|side| side))
            };
            let within = margins.into_iter().find_map(&mut all_within);
            spend(&mut work, 0, pieces.len())?;
            match within {
                Some(within) => hollow[piece] ^= within,
                // A crumb, as sections have, makes no difference either way.
                None if content(&pieces[piece].simplices, points)
                    <= CRUMB * content(&pieces[outer].simplices, points) => {}
                None => return Err(doubtful(pieces[piece].facet, pieces[outer].facet)),
            }
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
    let order = order::of_numbers(&extents.iter().map(|extent| extent.low[0]).collect::<Vec<f64>>());
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
            spend(work, PAIR, pieces.len())?;
        }
    }
    Ok(inner.into_iter().enumerate().filter(|(_, inner)| !inner.is_empty()).collect())
}

/// What a piece bounds, in parts that are the same for all, without its sign.
fn content<const N: usize>(simplices: &[[u32; N]], points: &[Vector<N>]) -> f64 {
    let Some(origin) = simplices.first().map(|simplex| points[simplex[0] as usize]) else { return 0.0 };
    let cone = |simplex: &[u32; N]| Matrix::from_columns(simplex.map(|v| points[v as usize] - origin)).determinant();
    simplices.iter().map(cone).sum::<f64>().abs()
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
    /// The direction of rays is the last one, and the others are orthogonal to it and to each other.
    frame: [Vector<N>; N],
    sides: Vec<Side<N>>,
    /// The largest extent of a simplex along the first axis of the frame, by which the simplices are sorted.
    widest: f64,
    corners: Vec<[Vector<N>; N]>,
}

struct Side<const N: usize> {
    /// The box of the simplex in the frame, a little larger.
    extent: Extent<N>,
    corners: [Vector<N>; N],
    /// `None` if it has no area.
    wall: Option<Wall<N>>,
}

impl<const N: usize> Around<N> {
    fn new(simplices: &[[u32; N]], points: &[Vector<N>], margin: f64) -> Self {
        // No mesh is likely to be aligned with it.
        let direction = Vector::<N>::from_fn(|axis| (axis as f64 * 0.754_877_666_246_693 + 0.618).fract() - 0.5);
        let mut frame = direction.normalize_or_zero().orthonormal_complement();
        frame[N - 1] = direction.normalize_or_zero();
        let turned = |corner: Vector<N>| Vector::from_fn(|axis| frame[axis].dot(corner));
        let side = |simplex: &[u32; N]| {
            let corners = simplex.map(|v| points[v as usize]);
            let tight = Extent::of(corners.iter().map(|&corner| turned(corner)));
            let extent = Extent { low: tight.low - Vector::splat(margin), high: tight.high + Vector::splat(margin) };
            Side { extent, corners, wall: Wall::new(corners) }
        };
        let lowest = |simplex: &[u32; N]| simplex.map(|v| frame[0].dot(points[v as usize]));
        let starts = simplices.iter().map(|simplex| lowest(simplex).into_iter().fold(f64::INFINITY, f64::min));
        let order = order::of_numbers(&starts.collect::<Vec<f64>>());
        let sides: Vec<Side<N>> = order.iter().map(|&number| side(&simplices[number])).collect();
        let widest = sides.iter().map(|side| side.extent.high[0] - side.extent.low[0]).fold(0.0, f64::max);
        let corners = sides.iter().map(|side| side.corners).collect();
        Self { frame, sides, widest, corners }
    }

    /// Whether the surface winds around a point; `None` if the point is on it, or closer than `margin`. Adds the simplices that were
    /// looked at to `work`.
    fn holds(&self, point: Vector<N>, margin: f64, work: &mut usize) -> Option<bool> {
        let place = Vector::<N>::from_fn(|axis| self.frame[axis].dot(point));
        let begin = self.sides.partition_point(|side| side.extent.low[0] < place[0] - self.widest);
        let end = self.sides.partition_point(|side| side.extent.low[0] <= place[0]);
        *work = work.saturating_add(end - begin);
        let meets = |extent: &Extent<N>| {
            (0..N - 1).all(|axis| extent.low[axis] <= place[axis] && place[axis] <= extent.high[axis])
                && place[N - 1] <= extent.high[N - 1]
        };
        let (mut winding, mut at_edge) = (0, false);
        for side in self.sides[begin..end].iter().filter(|side| meets(&side.extent)) {
            if side.wall.as_ref().is_some_and(|wall| wall.is_near(point, margin)) {
                return None;
            }
            match Crossing::of(&side.corners, point, self.frame[N - 1]) {
                Crossing::Away => {}
                Crossing::Through(sign) => winding += sign,
                Crossing::Edge => at_edge = true,
            }
        }
        if at_edge {
            *work = work.saturating_add(self.sides.len());
            winding = winding_number(&self.corners, point).ok()?;
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

fn doubtful(one: usize, other: usize) -> GeometryError {
    let (first, second) = (one.min(other), one.max(other));
    let message = format!(
        "the pieces of the surface with faces {first} and {second} lie upon each other, so that it is not clear whether one is a hollow \
         in the other: remove one of them, or move them apart"
    );
    GeometryError::new(BadMesh, message)
}

//! Convex cells of star polytopes.
//!
//! A star polytope is star-shaped: every ray from its centre leaves it once, where it meets the last facet. Its symmetry group
//! is made of reflections, and the cone between as many mirrors as there are dimensions, the chamber, holds one image of every point.
//! So the solid is known from the facets seen last within the chamber (see `envelope`): each part of one of them makes a convex
//! cell with the centre. Cells are joined where their union is convex, together with their images across the mirrors that
//! they touch, and the images under the group of what is left fill the solid. A binary space partition, as of other meshes, would
//! cut through everything with hundreds of hyperplanes.

use std::collections::BTreeMap;

use hyperbody_math::{Matrix, Vector};

use super::envelope::{Sheet, lowest};
use super::group::{Group, Known, SAME_POINT};
use super::{Fraction, distance, endless, first_vertex, mirrors, surface};
use crate::decompose::{clip, convex_cells};
use crate::error::GeometryErrorKind::{BadCount, BadMesh, Unsupported};
use crate::hull::plane::Hyperplane;
use crate::mass::MassProperties;
use crate::regular::Size;
use crate::section::SliceFrame;
use crate::{GeometryError, Polytope, Result};

/// Lengths below this are none, for a circumradius of one.
const TOLERANCE: f64 = 1e-9;

/// What volumes may differ by and still be called the same, relative.
const SAME_VOLUME: f64 = 1e-8;

/// Most parts of what is seen within the chamber.
const MAX_PARTS: usize = 1000;

const MAX_DIMENSION: usize = 6;

/// A convex cell within the chamber, and what it makes with its images.
#[derive(Clone)]
struct Cell<const N: usize> {
    own: Polytope<N>,
    volume: f64,
    /// The union of its images under some of the mirrors, which is convex.
    joined: Polytope<N>,
    /// How many images of `joined` there are.
    images: usize,
}

impl<const N: usize> Cell<N> {
    /// Joined with its images across as many mirrors as leave it convex.
    fn new(own: Polytope<N>, group: &Group<N>) -> Self {
        let volume = MassProperties::of_polytope(&own).mass;
        let on_mirror =
            |mirror: usize| own.facets().iter().any(|f| f.normal.dot(group.mirrors[mirror]) < TOLERANCE - 1.0);
        let touched: usize = (0..N).filter(|&mirror| on_mirror(mirror)).map(|mirror| 1 << mirror).sum();
        let mut cell = Self { joined: own.clone(), own, volume, images: group.order() };
        for set in (1..1 << N).filter(|set| set & !touched == 0) {
            let order = group.orders[set];
            if group.order() / order >= cell.images {
                continue;
            }
            let images: Option<Vec<_>> = cell.own.vertices().iter().map(|&v| group.orbit(v, set)).collect();
            let hull = images.and_then(|images| Polytope::from_points(&images.concat()).ok());
            if let Some(hull) = hull.filter(|hull| fills(hull, volume * order as f64)) {
                (cell.joined, cell.images) = (hull, group.order() / order);
            }
        }
        cell
    }

    /// Both as one, if that is convex.
    fn with(&self, other: &Self, group: &Group<N>) -> Option<Self> {
        let shared = |v: &&Vector<N>| other.own.vertices().iter().any(|w| w.distance(**v) < 10.0 * TOLERANCE);
        if self.own.vertices().iter().filter(shared).count() < N {
            return None;
        }
        let hull = Polytope::from_points(&[self.own.vertices(), other.own.vertices()].concat()).ok()?;
        fills(&hull, self.volume + other.volume).then(|| Self::new(hull, group))
    }
}

fn fills<const N: usize>(hull: &Polytope<N>, volume: f64) -> bool {
    MassProperties::of_polytope(hull).mass <= volume * (1.0 + SAME_VOLUME)
}

/// Convex polytopes that fill the union of all regions that the surface of a star polytope winds around, without
/// overlapping. The symbol has one entry less than there are dimensions, two to four. From three dimensions on each of them
/// has the centre as a corner: a small stellated dodecahedron is made of twelve that end in its spikes.
///
/// # Errors
/// As [`surface`]; `BadCount` if the symbol has not `N − 1` entries, or more than `most` cells are needed; the message
/// says how many. `Unsupported` above four dimensions, where no star polytope is regular.
///
/// ```
/// use hyperbody_geometry::regular::Size;
/// use hyperbody_geometry::star;
/// let cells = star::cells::<3>(&star::symbol("great dodecahedron")?, Size::Circumradius(1.0), 100)?;
/// assert_eq!(cells.len(), 30);
/// # Ok::<(), hyperbody_geometry::GeometryError>(())
/// ```
pub fn cells<const N: usize>(symbol: &[Fraction], size: Size, most: usize) -> Result<Vec<Polytope<N>>> {
    if symbol.len() + 1 != N {
        let message = format!("a symbol of {} entries: in {N} dimensions it has {}", symbol.len(), N - 1);
        return Err(GeometryError::new(BadCount, message));
    }
    let file = surface(symbol, size)?;
    let points = file.vertices::<N>().unwrap_or_default();
    let corners = match N {
        2 => {
            let cells = convex_cells(&points, &file.boundary::<N>()?)?;
            return if cells.len() > most { Err(too_many(cells.len(), most)) } else { Ok(cells) };
        }
        3 => corners::<3, 2>(symbol, most)?,
        4 => corners::<4, 3>(symbol, most)?,
        _ => {
            let message = format!("no star polytope of {N} dimensions is regular: use a polytope in place of a star");
            return Err(GeometryError::new(Unsupported, message));
        }
    };
    let radius = points.first().map_or(1.0, |vertex| vertex.norm());
    let numbers = corners.iter().map(|cell| {
        let placed = |corner: &Vec<f64>| Vector::from_fn(|i| corner[i] * radius);
        Polytope::from_points(&cell.iter().map(placed).collect::<Vec<_>>())
    });
    numbers.collect()
}

fn too_many(count: usize, most: usize) -> GeometryError {
    let message = format!(
        "the facets of this star cross each other so that it takes {count} convex cells; at most {most} are allowed"
    );
    GeometryError::new(BadCount, message)
}

/// The corners of all cells, for a circumradius of one.
fn corners<const N: usize, const M: usize>(symbol: &[Fraction], most: usize) -> Result<Vec<Vec<Vec<f64>>>> {
    let group = Group::<N>::new::<M>(symbol).ok_or_else(|| endless(symbol))?;
    let own = joined(within_chamber::<N, M>(symbol, &group)?, &group);
    let count: usize = own.iter().map(|cell| cell.images).sum();
    if count > most {
        return Err(too_many(count, most));
    }
    let numbers = |image: Vec<Vector<N>>| image.iter().map(|corner| corner.0.to_vec()).collect();
    Ok(own.iter().flat_map(|cell| images(&cell.joined, &group)).map(numbers).collect())
}

/// All images of a polytope, as their vertices.
fn images<const N: usize>(polytope: &Polytope<N>, group: &Group<N>) -> Vec<Vec<Vector<N>>> {
    let mut all = vec![(polytope.vertex_mean(), polytope.vertices().to_vec())];
    let mut known = Known::new(all[0].0);
    let mut next = 0;
    while next < all.len() {
        for mirror in 0..N {
            let middle = group.reflect(mirror, all[next].0);
            if known.is_new(middle) {
                let vertices = all[next].1.iter().map(|&v| group.reflect(mirror, v)).collect();
                all.push((middle, vertices));
            }
        }
        next += 1;
    }
    all.into_iter().map(|(_, vertices)| vertices).collect()
}

/// Cells that fill the solid within the chamber, each with the centre as a corner.
fn within_chamber<const N: usize, const M: usize>(symbol: &[Fraction], group: &Group<N>) -> Result<Vec<Cell<N>>> {
    let ahead = group.edges.iter().fold(Vector::ZERO, |sum, &edge| sum + edge).normalize_or_zero();
    let picture = SliceFrame::from_normal(ahead, 1.0)?;
    let seen_at = |point: Vector<N>| picture.to_slice::<M>(point / ahead.dot(point));
    let chamber = Polytope::from_points(&group.edges.map(seen_at))?;
    let mut sheets = Vec::new();
    let mut planes = Vec::new();
    for facet in facets::<N, M>(symbol, group)? {
        for piece in &facet.pieces {
            let Some(piece) = facet.within_chamber(piece, group) else { continue };
            let corners: Vec<Vector<M>> = piece.vertices().iter().map(|&v| seen_at(facet.place(v))).collect();
            // What is too thin to be seen is passed over.
            let Ok(region) = Polytope::from_points(&corners) else { continue };
            let normal = facet.normal();
            let constant = normal.dot(picture.to_space(Vector::<M>::ZERO));
            sheets.push(Sheet { region, gradient: picture.direction_to_slice(normal), constant });
            planes.push((normal, facet.offset()));
        }
    }
    let parts = lowest(chamber, &sheets, TOLERANCE, MAX_PARTS).ok_or_else(|| {
        GeometryError::new(
            BadMesh,
            format!("the facets of a star polytope leave more than {MAX_PARTS} parts to be seen, or a gap"),
        )
    })?;
    let cell = |(part, sheet): (Polytope<M>, usize)| {
        let (normal, offset) = planes[sheet];
        let place = |&v: &Vector<M>| {
            let point = picture.to_space(v);
            point * (offset / normal.dot(point))
        };
        let corners: Vec<Vector<N>> = part.vertices().iter().map(place).chain([Vector::ZERO]).collect();
        Ok(Cell::new(Polytope::from_points(&corners)?, group))
    };
    parts.into_iter().map(cell).collect()
}

/// Joins pairs of cells within the chamber, always those that make the fewest in all, as long as that helps.
fn joined<const N: usize>(mut cells: Vec<Cell<N>>, group: &Group<N>) -> Vec<Cell<N>> {
    let mut unions: BTreeMap<(usize, usize), Cell<N>> = BTreeMap::new();
    let mut alive: Vec<usize> = (0..cells.len()).collect();
    let mut fresh: Vec<usize> = alive.clone();
    loop {
        for &new in &fresh {
            for &other in alive.iter().filter(|&&other| other < new) {
                if let Some(union) = cells[other].with(&cells[new], group) {
                    unions.insert((other, new), union);
                }
            }
        }
        let gain = |&(a, b): &(usize, usize), union: &Cell<N>| {
            (cells[a].images + cells[b].images).saturating_sub(union.images)
        };
        let gains = unions.iter().map(|(pair, union)| (gain(pair, union), *pair));
        let Some((_, (a, b))) = gains.filter(|(gain, _)| *gain > 0).max_by_key(|(gain, _)| *gain) else { break };
        let union = unions.remove(&(a, b));
        unions.retain(|&(c, d), _| ![a, b].contains(&c) && ![a, b].contains(&d));
        alive.retain(|&k| k != a && k != b);
        fresh = vec![cells.len()];
        alive.push(cells.len());
        cells.extend(union);
    }
    alive.iter().map(|&k| cells[k].clone()).collect()
}

/// A facet with the convex pieces that fill it.
struct Placed<const N: usize, const M: usize> {
    /// Turns the first facet into this one.
    turn: Matrix<N>,
    /// Circumradius of the facet, and where its middle is along the last axis before the turn.
    radius: f64,
    height: f64,
    pieces: Vec<Polytope<M>>,
}

impl<const N: usize, const M: usize> Placed<N, M> {
    fn place(&self, own: Vector<M>) -> Vector<N> {
        self.turn * Vector::from_fn(|i| if i < M { own[i] * self.radius } else { self.height })
    }

    /// Outward.
    fn normal(&self) -> Vector<N> {
        self.turn.column(M) * self.height.signum()
    }

    fn offset(&self) -> f64 {
        self.height.abs()
    }

    /// The part of a piece that is in the chamber.
    fn within_chamber(&self, piece: &Polytope<M>, group: &Group<N>) -> Option<Polytope<M>> {
        group.mirrors.iter().try_fold(piece.clone(), |rest, &mirror| {
            let own = self.turn.transpose_mul(mirror);
            let slope = Vector::<M>::from_fn(|i| -own[i] * self.radius);
            let length = slope.norm();
            let rise = own[M] * self.height;
            if length < TOLERANCE {
                return (rise > 0.0).then_some(rest);
            }
            clip(&rest, &Hyperplane { normal: slope / length, offset: rise / length }, TOLERANCE)
        })
    }
}

/// All facets. The first lies across the last axis, and its symbol is that of the whole without the last entry.
fn facets<const N: usize, const M: usize>(symbol: &[Fraction], group: &Group<N>) -> Result<Vec<Placed<N, M>>> {
    let own = surface(&symbol[..M - 1], Size::Circumradius(1.0))?;
    let pieces = convex_cells(&own.vertices::<M>().unwrap_or_default(), &own.boundary::<M>()?)?;
    let vertex = mirrors(symbol).map(|mirrors| first_vertex(&mirrors)).ok_or_else(|| endless(symbol))?;
    let (height, radius) = (vertex[M], distance(&vertex[..M], &[0.0; MAX_DIMENSION][..M]));
    let mut facets = vec![Placed { turn: Matrix::IDENTITY, radius, height, pieces }];
    let mut next = 0;
    while next < facets.len() {
        for &mirror in &group.mirrors {
            let turn = facets[next].turn - Matrix::outer(mirror, facets[next].turn.transpose_mul(mirror)) * 2.0;
            if facets.iter().all(|known| known.turn.column(M).distance(turn.column(M)) > SAME_POINT) {
                let pieces = facets[next].pieces.clone();
                facets.push(Placed { turn, radius, height, pieces });
            }
        }
        next += 1;
    }
    Ok(facets)
}

//! The surface of a file as oriented simplices, convex or not.
//!
//! Orientation is not in a file from four dimensions up, where elements are lists without order; it follows from each part's
//! boundary being closed. So every element is a signed sum of the elements one rank below such that the boundaries of these
//! cancel, found by walking from part to neighbouring part. An element is then filled with the cones from one of its vertices
//! over its parts, as a signed sum too. Nothing of this asks for convexity: a pentagram's triangles add up to the pentagram
//! with its middle counted twice, which is the winding number there, and volumes of star polytopes come out as is usual.

use std::collections::BTreeMap;

use hyperbody_math::{Matrix, Vector};

use super::OffFile;
use super::nesting::{Piece, hollows};
use crate::error::GeometryErrorKind::{BadCount, BadMesh};
use crate::{GeometryError, Result};

/// One element: its boundary as elements one rank below with signs, and simplices that fill it.
struct Element {
    boundary: Vec<(u32, i8)>,
    /// Each `rank + 1` vertices, with a sign.
    filling: Vec<(Vec<u32>, i8)>,
}

impl OffFile {
    /// The surface that the file lists, as simplices of `N` vertices with neighbours oriented alike; each connected piece of it
    /// is turned so that its volume is positive, or negative if it lies within an odd number of others: it bounds a hollow then,
    /// which may touch the surface around it. In the plane each polygon is such a piece. Pieces that cross each other are not
    /// within each other. Its volume and moments are those of
    /// [`MassProperties::of_closed_boundary`](crate::MassProperties::of_closed_boundary), where regions around which the
    /// surface winds twice count twice.
    ///
    /// # Errors
    /// `BadCount` if the file is not of dimension `N` or lists no facets; `BadMesh` if the surface is open, more than two facets
    /// meet in a ridge, it cannot be oriented, a face is not flat ([`OffFile::check_flat`]), or pieces of it lie upon each other;
    /// `BadCount` too if there are so many pieces within the boxes of others that it would take minutes to sort them.
    pub fn boundary<const N: usize>(&self) -> Result<Vec<[u32; N]>> {
        let Some(points) = self.vertices::<N>() else {
            return Err(GeometryError::new(BadCount, format!("the file is of dimension {}, not {N}", self.dimension)));
        };
        self.check_flat::<N>()?;
        let mut edges = Edges::default();
        let mut elements: Vec<Element> = self.elements(2).iter().map(|cycle| polygon(cycle, &mut edges)).collect();
        for rank in 3..N {
            let made = self.elements(rank).iter().enumerate().map(|(index, parts)| {
                let signs = orient(parts, &elements).map_err(|what| bad(rank, index, what))?;
                let signs: Vec<(u32, i8)> =
                    parts.iter().copied().zip(signs).map(|(part, (sign, _))| (part, sign)).collect();
                Ok(Element { filling: cone(&signs, &elements), boundary: signs })
            });
            let made: Result<Vec<Element>> = made.collect();
            elements = made?;
        }
        if elements.is_empty() {
            return Err(GeometryError::new(BadCount, format!("the file lists no facets of dimension {}", N - 1)));
        }
        let pieces = if N == 2 { polygons(&elements, &edges) } else { self.connected(&elements)? };
        let origin = points.iter().fold(Vector::ZERO, |sum, &p| sum + p) / points.len().max(1) as f64;
        let pieces: Vec<Piece<N>> = pieces.into_iter().map(|piece| piece.outward(&points, origin)).collect();
        let hollow = hollows(&pieces, &points, [self.convexity_tolerance(), self.rounding()])?;
        let turned = |(piece, hollow): (Piece<N>, bool)| if hollow { piece.turned_over() } else { piece };
        Ok(pieces.into_iter().zip(hollow).flat_map(|pair| turned(pair).simplices).collect())
    }

    /// The connected pieces of the surface, each with its simplices oriented alike.
    fn connected<const N: usize>(&self, facets: &[Element]) -> Result<Vec<Piece<N>>> {
        let all: Vec<u32> = (0..facets.len() as u32).collect();
        let signs = orient(&all, facets).map_err(|what| self.bad_surface(what))?;
        let mut pieces: Vec<Piece<N>> = Vec::new();
        for (facet, (element, (sign, piece))) in facets.iter().zip(signs).enumerate() {
            // Pieces are numbered as they are met.
            if piece == pieces.len() {
                pieces.push(Piece { simplices: Vec::new(), facet });
            }
            for (corners, own) in &element.filling {
                let Ok(mut simplex) = <[u32; N]>::try_from(&corners[..]) else { continue };
                if own * sign < 0 {
                    simplex.swap(0, 1);
                }
                pieces[piece].simplices.push(simplex);
            }
        }
        Ok(pieces)
    }
}

/// In the plane the edges themselves are the surface, and each polygon is a piece: polygons that share an edge lie side by side.
fn polygons<const N: usize>(elements: &[Element], edges: &Edges) -> Vec<Piece<N>> {
    let sides = |polygon: &Element| polygon.boundary.iter().filter_map(|&(e, s)| edges.oriented(e, s)).collect();
    elements.iter().enumerate().map(|(facet, polygon)| Piece { simplices: sides(polygon), facet }).collect()
}

impl<const N: usize> Piece<N> {
    /// Turned so that its volume is not negative.
    fn outward(self, points: &[Vector<N>], origin: Vector<N>) -> Self {
        let volume =
            |simplex: &[u32; N]| Matrix::from_columns(simplex.map(|v| points[v as usize] - origin)).determinant();
        if self.simplices.iter().map(volume).sum::<f64>() < 0.0 { self.turned_over() } else { self }
    }

    fn turned_over(mut self) -> Self {
        self.simplices.iter_mut().for_each(|simplex| simplex.swap(0, 1));
        self
    }
}

impl OffFile {
    /// How many vertices stand where another one with a smaller number does. Faces meet only in vertices of the same number, so
    /// that a file with corners of its own for each face has an open surface.
    #[must_use]
    pub fn repeated_vertices(&self) -> usize {
        // Zeros of both signs are the same place.
        let mut places: Vec<Vec<u64>> =
            self.vertices.chunks(self.dimension).map(|v| v.iter().map(|c| (c + 0.0).to_bits()).collect()).collect();
        places.sort_unstable();
        places.windows(2).filter(|pair| pair[0] == pair[1]).count()
    }

    fn bad_surface(&self, what: &str) -> GeometryError {
        let repeated = self.repeated_vertices();
        let hint = if what == OPEN && repeated > 0 {
            format!(
                "; {repeated} vertices stand where another one does: faces meet only in vertices of the same number, so merge them"
            )
        } else {
            String::new()
        };
        GeometryError::new(BadMesh, format!("the surface {what}{hint}"))
    }
}

/// What is wrong if a ridge bounds one facet, or more than two.
const OPEN: &str = "is open or branches: some ridge of it (in 3D an edge) does not bound exactly two facets";

fn bad(rank: usize, index: usize, what: &str) -> GeometryError {
    GeometryError::new(BadMesh, format!("face {index} of rank {rank} {what}"))
}

/// Edges by their vertices, numbered as they are met.
#[derive(Default)]
struct Edges {
    numbers: BTreeMap<(u32, u32), u32>,
    ends: Vec<(u32, u32)>,
}

impl Edges {
    fn number(&mut self, a: u32, b: u32) -> (u32, i8) {
        let ends = (a.min(b), a.max(b));
        let next = self.ends.len() as u32;
        let number = *self.numbers.entry(ends).or_insert(next);
        if number == next {
            self.ends.push(ends);
        }
        (number, if a < b { 1 } else { -1 })
    }

    fn oriented<const N: usize>(&self, edge: u32, sign: i8) -> Option<[u32; N]> {
        let (a, b) = self.ends[edge as usize];
        let ends = if sign > 0 { [a, b] } else { [b, a] };
        <[u32; N]>::try_from(&ends[..]).ok()
    }
}

/// A cycle of vertices: its edges, and a fan of triangles.
fn polygon(cycle: &[u32], edges: &mut Edges) -> Element {
    let next = |k: usize| cycle[(k + 1) % cycle.len()];
    let boundary = (0..cycle.len()).map(|k| edges.number(cycle[k], next(k))).collect();
    let fan = (1..cycle.len().saturating_sub(1)).map(|k| (vec![cycle[0], cycle[k], cycle[k + 1]], 1)).collect();
    Element { boundary, filling: fan }
}

/// Cones from one vertex over the parts; those that hold it have no content.
fn cone(parts: &[(u32, i8)], elements: &[Element]) -> Vec<(Vec<u32>, i8)> {
    let simplices =
        || parts.iter().flat_map(|&(part, sign)| elements[part as usize].filling.iter().map(move |f| (f, sign)));
    let Some(apex) = simplices().flat_map(|((corners, _), _)| corners.iter().copied()).min() else {
        return Vec::new();
    };
    let free = simplices().filter(|((corners, _), _)| !corners.contains(&apex));
    free.map(|((corners, own), sign)| (std::iter::once(apex).chain(corners.iter().copied()).collect(), own * sign))
        .collect()
}

/// A sign for each part such that their boundaries cancel, and the number of the connected piece that it is in.
fn orient(parts: &[u32], elements: &[Element]) -> std::result::Result<Vec<(i8, usize)>, &'static str> {
    // The parts at each ridge, with the sign of the ridge in the part.
    let mut at_ridge: BTreeMap<u32, Vec<(usize, i8)>> = BTreeMap::new();
    for (position, &part) in parts.iter().enumerate() {
        for &(ridge, sign) in &elements[part as usize].boundary {
            at_ridge.entry(ridge).or_default().push((position, sign));
        }
    }
    if at_ridge.values().any(|sides| sides.len() != 2) {
        return Err(OPEN);
    }
    let mut signs: Vec<Option<(i8, usize)>> = vec![None; parts.len()];
    let mut pieces = 0;
    for start in 0..parts.len() {
        if signs[start].is_some() {
            continue;
        }
        signs[start] = Some((1, pieces));
        let mut waiting = vec![(start, 1_i8)];
        while let Some((position, sign)) = waiting.pop() {
            for (ridge, own) in &elements[parts[position] as usize].boundary {
                let sides = &at_ridge[ridge];
                let (other, other_own) = if sides[0].0 == position { sides[1] } else { sides[0] };
                let wanted = -sign * own * other_own;
                match signs[other] {
                    None => {
                        signs[other] = Some((wanted, pieces));
                        waiting.push((other, wanted));
                    }
                    Some((found, _)) if found != wanted => return Err("cannot be oriented: it has only one side"),
                    Some(_) => {}
                }
            }
        }
        pieces += 1;
    }
    signs.into_iter().map(|sign| sign.ok_or("is empty")).collect()
}

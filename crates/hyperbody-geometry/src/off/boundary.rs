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
use crate::decompose::winding_number;
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
    /// is turned so that its volume is positive, or negative if it lies within an odd number of others: it bounds a hollow then.
    /// Pieces that cross each other are not within each other. Its volume and moments are those of
    /// [`MassProperties::of_closed_boundary`](crate::MassProperties::of_closed_boundary), where regions around which the
    /// surface winds twice count twice.
    ///
    /// # Errors
    /// `BadCount` if the file is not of dimension `N` or lists no facets; `BadMesh` if the surface is open, more than two facets
    /// meet in a ridge, or it cannot be oriented.
    pub fn boundary<const N: usize>(&self) -> Result<Vec<[u32; N]>> {
        let Some(points) = self.vertices::<N>() else {
            return Err(GeometryError::new(BadCount, format!("the file is of dimension {}, not {N}", self.dimension)));
        };
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
        if N == 2 {
            // In the plane the edges themselves are the surface.
            return Ok(elements
                .iter()
                .flat_map(|face| face.boundary.iter())
                .filter_map(|&(e, s)| edges.oriented(e, s))
                .collect());
        }
        if elements.is_empty() {
            return Err(GeometryError::new(BadCount, format!("the file lists no facets of dimension {}", N - 1)));
        }
        let all: Vec<u32> = (0..elements.len() as u32).collect();
        let signs = orient(&all, &elements).map_err(|what| self.bad_surface(what))?;
        let mut pieces: Vec<(Vec<[u32; N]>, f64)> = Vec::new();
        let origin = points.iter().fold(Vector::ZERO, |sum, &p| sum + p) / points.len().max(1) as f64;
        for (element, (sign, piece)) in elements.iter().zip(signs) {
            pieces.resize_with(pieces.len().max(piece + 1), Default::default);
            for (corners, own) in &element.filling {
                let Ok(mut simplex) = <[u32; N]>::try_from(&corners[..]) else { continue };
                if own * sign < 0 {
                    simplex.swap(0, 1);
                }
                let volume = Matrix::from_columns(simplex.map(|v| points[v as usize] - origin)).determinant();
                pieces[piece].0.push(simplex);
                pieces[piece].1 += volume;
            }
        }
        let pieces: Vec<Vec<[u32; N]>> = pieces
            .into_iter()
            .map(|(simplices, volume)| if volume < 0.0 { turned_over(simplices) } else { simplices })
            .collect();
        let hollow: Vec<bool> = (0..pieces.len()).map(|piece| bounds_a_hollow(piece, &pieces, &points)).collect();
        let turned = |(simplices, hollow)| if hollow { turned_over(simplices) } else { simplices };
        Ok(pieces.into_iter().zip(hollow).flat_map(turned).collect())
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

fn turned_over<const N: usize>(mut simplices: Vec<[u32; N]>) -> Vec<[u32; N]> {
    simplices.iter_mut().for_each(|simplex| simplex.swap(0, 1));
    simplices
}

/// Whether a piece of the surface lies within an odd number of the others.
fn bounds_a_hollow<const N: usize>(piece: usize, pieces: &[Vec<[u32; N]>], points: &[Vector<N>]) -> bool {
    let mut own: Vec<u32> = pieces[piece].iter().flatten().copied().collect();
    own.sort_unstable();
    own.dedup();
    let range = |piece: &[[u32; N]]| {
        piece
            .iter()
            .flatten()
            .fold((Vector::splat(f64::INFINITY), Vector::splat(f64::NEG_INFINITY)), |(low, high), &v| {
                (low.min(points[v as usize]), high.max(points[v as usize]))
            })
    };
    let (low, high) = range(&pieces[piece]);
    let around = |other: &&Vec<[u32; N]>| {
        let (outer_low, outer_high) = range(other);
        if !(0..N).all(|axis| outer_low[axis] < low[axis] && high[axis] < outer_high[axis]) {
            return false;
        }
        let corners: Vec<[Vector<N>; N]> = other.iter().map(|simplex| simplex.map(|v| points[v as usize])).collect();
        own.iter().all(|&v| winding_number(&corners, points[v as usize]).is_ok_and(|winding| winding != 0))
    };
    pieces.iter().filter(around).count() % 2 == 1
}

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

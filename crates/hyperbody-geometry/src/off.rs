//! OFF files: vertices and faces of polytopes in two to six dimensions, as text.
//!
//! ```text
//! 4OFF                  OFF means 3OFF; "nOFF 4" is the same as 4OFF
//! 5 10 10 5             numbers of vertices, 2-faces, edges, 3-faces, … ; # begins a comment
//! 0 0 0 1               vertices
//! …
//! 3 0 1 2               2-faces: number of vertices, vertices
//! …
//! 4 0 1 4 7             3-faces: number of 2-faces, 2-faces; and so on up to the facets
//! ```

mod boundary;
mod flatness;
mod nesting;
mod precision;
mod read;

use std::fmt;

use hyperbody_math::{Matrix, Vector};

use crate::error::GeometryErrorKind::{BadCount, Flat};
use crate::tolerances::{HULL_TOLERANCE, JOINING_TOLERANCES};
use crate::{FaceLattice, GeometryError, Polytope, Result, hull};

pub use read::parse;

/// What an OFF file holds, in a dimension known only when it has been read. Shown as text, it is the file.
#[derive(Clone, Debug)]
pub struct OffFile {
    dimension: usize,
    /// Coordinates, `dimension` of them for each vertex.
    vertices: Vec<f64>,
    /// From rank 2 on: 2-faces as vertices in order around the face, then each rank as elements of the one below.
    elements: Vec<Vec<Vec<u32>>>,
    /// The line in the text that each element begins on, to be named in messages; empty if there was no text.
    lines: Vec<Vec<u32>>,
}

/// Files are equal if they hold the same, on whatever lines.
impl PartialEq for OffFile {
    fn eq(&self, other: &Self) -> bool {
        self.dimension == other.dimension && self.vertices == other.vertices && self.elements == other.elements
    }
}

impl OffFile {
    /// Number of coordinates of a vertex, 2 to 6.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.vertices.len() / self.dimension
    }

    /// The vertices, or `None` if the file is not of dimension `N`.
    #[must_use]
    pub fn vertices<const N: usize>(&self) -> Option<Vec<Vector<N>>> {
        (N == self.dimension).then(|| self.vertices.chunks(N).filter_map(Vector::from_slice).collect())
    }

    /// The elements of a rank ≥ 2 that the file lists: for rank 2 the vertices in order around each face, for higher
    /// ranks the elements of the rank below. Empty for files with vertices only.
    #[must_use]
    pub fn elements(&self, rank: usize) -> &[Vec<u32>] {
        rank.checked_sub(2).and_then(|index| self.elements.get(index)).map_or(&[], Vec::as_slice)
    }

    /// The convex hull of the vertices; of those that faces name, if the file lists faces.
    ///
    /// The facets that the file lists tell how precise its coordinates are: if the hull has more facets than the file,
    /// flat facets have been broken up by coordinates of few digits, and the hull is made with the first coarser
    /// tolerance (to 1e-4) that gives the number in the file. Where none does, as for non-convex files, the fine one
    /// counts.
    ///
    /// # Errors
    /// `BadCount` if the file is not of dimension `N`, and as [`Polytope::from_points`].
    pub fn to_polytope<const N: usize>(&self) -> Result<Polytope<N>> {
        let Some(vertices) = self.vertices::<N>() else {
            return Err(GeometryError::new(
                BadCount,
                format!(
                    "the file is of dimension {}, where {N} is wanted: take its section or another file",
                    self.dimension
                ),
            ));
        };
        let vertices = self.named_by_faces(vertices);
        let fine = Polytope::from_points(&vertices);
        let listed = self.elements(N - 1).len();
        let settled =
            fine.as_ref().map_or_else(|e| e.kind() == Flat || e.kind() == BadCount, |p| p.facets().len() == listed);
        if settled || listed == 0 {
            return fine;
        }
        for tolerance in JOINING_TOLERANCES {
            debug_assert!(tolerance > HULL_TOLERANCE);
            match hull::convex_hull_within(&vertices, tolerance) {
                Ok((coarse, _)) if coarse.facets().len() == listed => return Ok(coarse),
                _ => {}
            }
        }
        fine
    }

    /// All coordinates, vertex by vertex.
    #[must_use]
    pub fn coordinates(&self) -> &[f64] {
        &self.vertices
    }

    /// The vertices that faces name, in their order; all if there are no faces.
    fn named_by_faces<const N: usize>(&self, vertices: Vec<Vector<N>>) -> Vec<Vector<N>> {
        let mut named = vec![self.elements(2).is_empty(); vertices.len()];
        self.elements(2).iter().flatten().for_each(|&v| named[v as usize] = true);
        vertices.into_iter().zip(named).filter_map(|(vertex, named)| named.then_some(vertex)).collect()
    }

    /// A file of coordinates, `dimension` of them for each vertex, and of the elements from rank 2 on, which have to fit.
    pub(crate) const fn from_elements(dimension: usize, vertices: Vec<f64>, elements: Vec<Vec<Vec<u32>>>) -> Self {
        Self { dimension, vertices, elements, lines: Vec::new() }
    }

    /// The file of a polytope, with all its faces.
    #[must_use]
    pub fn from_polytope<const N: usize>(polytope: &Polytope<N>) -> Self {
        let lattice = polytope.face_lattice();
        let mut elements: Vec<Vec<Vec<u32>>> = Vec::new();
        let mut faces: Vec<Vec<u32>> = if N == 2 {
            let edges: Vec<u32> = (0..lattice.faces(1).len() as u32).collect();
            vec![around(&lattice, &edges)]
        } else {
            lattice.faces(2).iter().map(|face| around(&lattice, &face.boundary)).collect()
        };
        if N <= 3 {
            faces.iter_mut().for_each(|face| turn_outward(face, polytope));
        }
        elements.push(faces);
        for rank in 3..N {
            elements.push(lattice.faces(rank).iter().map(|face| face.boundary.clone()).collect());
        }
        let vertices = polytope.vertices().iter().flat_map(|v| v.0).collect();
        Self { dimension: N, vertices, elements, lines: Vec::new() }
    }

    /// Number of different edges of the 2-faces.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        let mut edges: Vec<(u32, u32)> = Vec::new();
        for face in self.elements(2) {
            for (k, &a) in face.iter().enumerate() {
                let b = face[(k + 1) % face.len()];
                edges.push((a.min(b), a.max(b)));
            }
        }
        edges.sort_unstable();
        edges.dedup();
        edges.len()
    }
}

/// Has the vertices of a face go around counterclockwise, in 3D as seen from outside: programs take that for its orientation. From
/// four dimensions on 2-faces have none.
fn turn_outward<const N: usize>(face: &mut [u32], polytope: &Polytope<N>) {
    let middle = polytope.vertex_mean();
    let corners: [Vector<N>; N] = std::array::from_fn(|k| polytope.vertices()[face[k] as usize] - middle);
    if Matrix::from_columns(corners).determinant() < 0.0 {
        face[1..].reverse();
    }
}

/// The vertices of a cycle of edges, in order, from the smallest towards the smaller of its neighbours.
fn around(lattice: &FaceLattice, edges: &[u32]) -> Vec<u32> {
    let ends: Vec<&[u32]> = edges.iter().map(|&edge| lattice.faces(1)[edge as usize].vertices.as_slice()).collect();
    let Some(&first) = ends.iter().flat_map(|pair| pair.iter()).min() else {
        return Vec::new();
    };
    let mut cycle = vec![first];
    let mut previous = u32::MAX;
    let mut current = first;
    for _ in 1..edges.len() {
        let beyond = ends.iter().filter(|pair| pair.contains(&current)).flat_map(|pair| pair.iter().copied());
        let Some(next) = beyond.filter(|&v| v != current && v != previous).min() else {
            break;
        };
        cycle.push(next);
        (previous, current) = (current, next);
    }
    cycle
}

impl fmt::Display for OffFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.dimension {
            3 => writeln!(f, "OFF")?,
            n => writeln!(f, "{n}OFF")?,
        }
        writeln!(f, "# vertices, 2-faces, edges, then the ranks from 3 on")?;
        write!(f, "{} {} {}", self.vertex_count(), self.elements(2).len(), self.edge_count())?;
        for rank in 3..self.dimension {
            write!(f, " {}", self.elements(rank).len())?;
        }
        writeln!(f)?;
        for vertex in self.vertices.chunks(self.dimension) {
            let words: Vec<String> = vertex.iter().map(ToString::to_string).collect();
            writeln!(f, "{}", words.join(" "))?;
        }
        for element in self.elements.iter().flatten() {
            write!(f, "{}", element.len())?;
            for part in element {
                write!(f, " {part}")?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}

//! All faces of a polytope, from vertices to facets, and which lies in which.
//!
//! A face is known by its vertices. Every face of rank k−1 in a face F of rank k is the intersection of F with one
//! other face of rank k beside it (the diamond property: between a face and one two ranks above it lie exactly two),
//! so the lattice follows from the facets downwards, without coordinates. Source of the idea: V. Kaibel and M. Pfetsch,
//! "Computing the face lattice of a polytope from its vertex-facet incidences" (2002); going down by neighbours
//! instead of up by closures suits facets with many vertices.

use crate::Polytope;
use crate::incidence;

/// The faces of a polytope by rank: 0 vertices, 1 edges, …, `N − 1` facets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FaceLattice {
    ranks: Vec<Vec<Face>>,
}

/// One face.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Face {
    /// Its vertices, ascending.
    pub vertices: Vec<u32>,
    /// The faces one rank lower that bound it, ascending; for an edge its two vertices, for a vertex none.
    pub boundary: Vec<u32>,
}

impl FaceLattice {
    /// The lattice of `polytope`. Vertices and facets have the same numbers as there; the faces of every other rank
    /// are in the lexicographic order of their vertex lists.
    #[must_use]
    pub fn new<const N: usize>(polytope: &Polytope<N>) -> Self {
        let facets = polytope.facets();
        let mut rank: Vec<Face> =
            facets.iter().map(|facet| Face { vertices: facet.vertices.clone(), boundary: Vec::new() }).collect();
        // Beside a facet lie its neighbours; beside a lower face, the other faces that bound one face above it.
        let mut beside: Vec<Vec<u32>> = facets.iter().map(|facet| facet.neighbours.clone()).collect();
        let mut ranks = Vec::with_capacity(N);
        for dimension in (1..N).rev() {
            let below = bound(&mut rank, &beside, dimension);
            beside = vec![Vec::new(); below.len()];
            for face in &rank {
                for &part in &face.boundary {
                    let others = &mut beside[part as usize];
                    if others.is_empty() {
                        others.extend(face.boundary.iter().filter(|&&other| other != part));
                    }
                }
            }
            ranks.push(rank);
            rank = below;
        }
        ranks.push(rank);
        ranks.reverse();
        Self { ranks }
    }

    /// Number of ranks, which is the dimension of the space.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.ranks.len()
    }

    /// The faces of a rank; none beyond the facets.
    #[must_use]
    pub fn faces(&self, rank: usize) -> &[Face] {
        self.ranks.get(rank).map_or(&[], Vec::as_slice)
    }

    /// Numbers of vertices, edges, …, facets.
    #[must_use]
    pub fn face_counts(&self) -> Vec<usize> {
        self.ranks.iter().map(Vec::len).collect()
    }

    /// Whether the faces close up as those of a polytope do: the diamond property on every rank, and Euler's relation
    /// Σ (−1)^k f_k = 1 − (−1)^N.
    pub(crate) fn is_consistent(&self) -> bool {
        let top = self.ranks.len();
        let edges = self.faces(1).iter().all(|edge| edge.boundary.len() == 2);
        let diamonds = (2..top).all(|rank| {
            self.faces(rank).iter().all(|face| {
                let sides = face.boundary.iter().map(|&side| &self.ranks[rank - 1][side as usize].boundary);
                let mut ends: Vec<u32> = sides.flatten().copied().collect();
                ends.sort_unstable();
                face.boundary.len() > rank && ends.chunk_by(|a, b| a == b).all(|same| same.len() == 2)
            })
        });
        let ridges = self.cofaces(top - 2).iter().all(|facets| facets.len() == 2);
        let euler: i64 = self.ranks.iter().rev().fold(0, |sum, faces| faces.len() as i64 - sum);
        edges && diamonds && ridges && euler == if top.is_multiple_of(2) { 0 } else { 2 }
    }

    /// For each face of `rank` the faces one rank higher that it bounds, ascending.
    #[must_use]
    pub fn cofaces(&self, rank: usize) -> Vec<Vec<u32>> {
        let above: Vec<&[u32]> = self.faces(rank + 1).iter().map(|face| face.boundary.as_slice()).collect();
        incidence::transposed(&above, self.faces(rank).len())
    }

    /// Simplices that fill the face with the given rank and number, each as `rank + 1` vertices: those of the faces
    /// that do not hold the smallest vertex, joined to it. No vertex is added, and faces that share a face fill it
    /// with the same simplices.
    #[must_use]
    pub fn triangulation(&self, rank: usize, face: usize) -> Vec<Vec<u32>> {
        let face = &self.ranks[rank][face];
        if face.vertices.len() == rank + 1 {
            return vec![face.vertices.clone()];
        }
        let apex = face.vertices[0];
        let mut simplices = Vec::new();
        for &part in &face.boundary {
            let part = part as usize;
            if self.ranks[rank - 1][part].vertices.binary_search(&apex).is_err() {
                for mut simplex in self.triangulation(rank - 1, part) {
                    simplex.insert(0, apex);
                    simplices.push(simplex);
                }
            }
        }
        simplices
    }
}

/// Fills in what bounds the faces of a rank (of the given dimension) and returns these lower faces. `beside` lists for
/// each face those that it may share a lower face with.
fn bound(rank: &mut [Face], beside: &[Vec<u32>], dimension: usize) -> Vec<Face> {
    let mut found: Vec<(Vec<u32>, u32)> = Vec::new();
    for (index, face) in rank.iter().enumerate() {
        let parts = if face.vertices.len() == dimension + 1 {
            subsets_without_one(&face.vertices)
        } else {
            let meets =
                beside[index].iter().map(|&o| incidence::intersection(&face.vertices, &rank[o as usize].vertices));
            maximal(meets.filter(|part| part.len() >= dimension).collect())
        };
        found.extend(parts.into_iter().map(|part| (part, index as u32)));
    }
    found.sort_unstable();
    let mut below: Vec<Face> = Vec::new();
    for (vertices, index) in found {
        if below.last().is_none_or(|last| last.vertices != vertices) {
            below.push(Face { vertices, boundary: Vec::new() });
        }
        rank[index as usize].boundary.push(below.len() as u32 - 1);
    }
    below
}

fn subsets_without_one(vertices: &[u32]) -> Vec<Vec<u32>> {
    (0..vertices.len()).map(|skip| [&vertices[..skip], &vertices[skip + 1..]].concat()).collect()
}

/// The sets that are in no other one, each once.
fn maximal(mut sets: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    sets.sort_unstable_by(|a, b| b.len().cmp(&a.len()).then_with(|| a.cmp(b)));
    sets.dedup();
    let mut kept: Vec<Vec<u32>> = Vec::new();
    for set in sets {
        if !kept.iter().any(|larger| set.iter().all(|v| larger.binary_search(v).is_ok())) {
            kept.push(set);
        }
    }
    kept
}

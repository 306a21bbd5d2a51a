//! Polytopes as the flat tables that sections are cut from, and that come out of a cut.
//!
//! A slice is made every frame, so nothing here is a list of lists: the faces of a rank stand one behind the other in
//! one array. The dimension stays in the type, as two numbers that the compiler checks against each other (`M + 1 == N`,
//! since stable Rust has no `N − 1`): a representation with a dimension known at run time would do the same work behind
//! bounds that cannot be checked, and everything that uses a section knows its dimension anyway.

use hyperbody_math::{Pose, Vector};

use crate::mass::MassProperties;
use crate::tolerances::SECTION_TOLERANCE;
use crate::{FaceLattice, Polytope};

/// The faces of one rank, each a list of faces one rank lower.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Faces {
    /// Where each face's list ends in `parts`.
    ends: Vec<u32>,
    parts: Vec<u32>,
}

impl Faces {
    pub(super) fn clear(&mut self) {
        self.ends.clear();
        self.parts.clear();
    }

    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    #[inline]
    pub(super) fn get(&self, face: usize) -> &[u32] {
        let start = if face == 0 { 0 } else { self.ends[face - 1] as usize };
        &self.parts[start..self.ends[face] as usize]
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.len()).map(|face| self.get(face))
    }

    /// Adds a part to the face that is being made.
    #[inline]
    pub(super) fn add(&mut self, part: u32) {
        self.parts.push(part);
    }

    /// Adds a part to the face that is being made unless it is there.
    #[inline]
    pub(super) fn add_once(&mut self, part: u32) {
        let start = self.ends.last().map_or(0, |&end| end as usize);
        if !self.parts[start..].contains(&part) {
            self.parts.push(part);
        }
    }

    /// Ends the face that is being made.
    #[inline]
    pub(super) fn finish(&mut self) {
        self.ends.push(self.parts.len() as u32);
    }
}

/// A convex polytope ready to be cut by hyperplanes, or the section that a cut has left, of dimension one to six. Each
/// facet knows a source: for a body made from a [`Polytope`] its own number, and for a section the source of the facet of
/// the body that it was cut from, through any number of cuts.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionPolytope<const N: usize> {
    pub(super) vertices: Vec<Vector<N>>,
    /// Faces of rank 1 (as pairs of vertices) to N − 1 (the facets).
    pub(super) ranks: Vec<Faces>,
    pub(super) facet_sources: Vec<u32>,
    /// A ball that holds all vertices.
    pub(super) centre: Vector<N>,
    pub(super) radius: f64,
    /// Vertices this close to a hyperplane lie in it.
    pub(super) tolerance: f64,
}

impl<const N: usize> Default for SectionPolytope<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> SectionPolytope<N> {
    /// An empty one, to be filled by cuts.
    #[must_use]
    pub fn new() -> Self {
        Self {
            vertices: Vec::new(),
            ranks: vec![Faces::default(); N.saturating_sub(1)],
            facet_sources: Vec::new(),
            centre: Vector::ZERO,
            radius: 0.0,
            tolerance: 0.0,
        }
    }

    /// The tables of a polytope.
    #[must_use]
    pub fn from_polytope(polytope: &Polytope<N>) -> Self {
        let lattice = FaceLattice::new(polytope);
        let mut tables = Self::new();
        tables.vertices.extend_from_slice(polytope.vertices());
        for (faces, rank) in tables.ranks.iter_mut().zip(1..N) {
            for face in lattice.faces(rank) {
                faces.parts.extend_from_slice(&face.boundary);
                faces.finish();
            }
        }
        tables.facet_sources.extend(0..polytope.facets().len() as u32);
        tables.measure();
        let height =
            |f: &crate::polytope::Facet<N>, v: u32| (f.normal.dot(polytope.vertices()[v as usize]) - f.offset).abs();
        let heights = polytope.facets().iter().flat_map(|f| f.vertices.iter().map(move |&v| height(f, v)));
        // Facets of files with few digits are not flat to rounding.
        let unevenness = heights.fold(0.0, f64::max);
        let rounding = SECTION_TOLERANCE * (tables.radius + tables.centre.norm());
        tables.tolerance = f64::max(4.0 * unevenness, rounding);
        tables
    }

    /// The same polytope in an outer frame.
    #[must_use]
    pub fn placed(mut self, outer_from_body: &Pose<N>) -> Self {
        for vertex in &mut self.vertices {
            *vertex = outer_from_body.transform_point(*vertex);
        }
        self.centre = outer_from_body.transform_point(self.centre);
        self.tolerance = self.tolerance.max(SECTION_TOLERANCE * (self.radius + self.centre.norm()));
        self
    }

    /// Forgets everything but the memory.
    pub(super) fn clear(&mut self) {
        self.vertices.clear();
        self.ranks.iter_mut().for_each(Faces::clear);
        self.facet_sources.clear();
    }

    /// Finds the ball around the vertices.
    pub(super) fn measure(&mut self) {
        let sum = self.vertices.iter().fold(Vector::ZERO, |sum, &v| sum + v);
        self.centre = sum / self.vertices.len().max(1) as f64;
        self.radius = self.vertices.iter().map(|v| (*v - self.centre).norm_sq()).fold(0.0, f64::max).sqrt();
    }

    /// Whether there is nothing: the hyperplane misses the body, or touches it in less than a facet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// The vertices, in the coordinates of the slice.
    #[must_use]
    pub fn vertices(&self) -> &[Vector<N>] {
        &self.vertices
    }

    /// Numbers of vertices, edges, …, facets.
    #[must_use]
    pub fn face_counts(&self) -> Vec<usize> {
        std::iter::once(self.vertices.len()).chain(self.ranks.iter().map(Faces::len)).collect()
    }

    /// The faces of a rank from 1 to `N − 1`, each as the faces one rank lower that bound it, without order; for edges the
    /// two vertices. Nothing for other ranks.
    pub fn faces(&self, rank: usize) -> impl Iterator<Item = &[u32]> {
        rank.checked_sub(1).and_then(|index| self.ranks.get(index)).into_iter().flat_map(Faces::iter)
    }

    /// For each facet (for `N` = 1: each vertex) the facet of the original body that it was cut from. A facet that lies in
    /// two facets of the body at once, because the hyperplane went along their ridge, has the smaller number.
    #[must_use]
    pub fn facet_sources(&self) -> &[u32] {
        &self.facet_sources
    }

    /// Middle of a ball that holds the polytope; inside of it.
    #[must_use]
    pub fn centre(&self) -> Vector<N> {
        self.centre
    }

    /// The same polytope with all facets those of one source, as the facets of a curved surface are.
    #[must_use]
    pub fn with_source(mut self, source: u32) -> Self {
        self.facet_sources.fill(source);
        self
    }

    /// Calls `f` with the corners of a polygon, a face of rank 2, in order around it.
    pub(crate) fn for_each_corner(&self, polygon: usize, mut f: impl FnMut(u32)) {
        let (Some(edges), Some(polygons)) = (self.ranks.first(), self.ranks.get(1)) else { return };
        let sides = polygons.get(polygon);
        let Some(&first) = sides.first() else { return };
        let (mut side, mut corner) = (first, edges.get(first as usize)[0]);
        for _ in 0..sides.len() {
            f(corner);
            let ends = edges.get(side as usize);
            corner = if ends[0] == corner { ends[1] } else { ends[0] };
            let holds = |other: u32| other != side && edges.get(other as usize).contains(&corner);
            let Some(&next) = sides.iter().find(|&&other| holds(other)) else { return };
            side = next;
        }
    }

    /// Simplices that fill the polytope, each as `N + 1` vertices: pyramids over the simplices of the facets that do not
    /// hold the first vertex, and so on downwards.
    #[must_use]
    pub fn filling(&self) -> Vec<Vec<u32>> {
        if self.is_empty() {
            return Vec::new();
        }
        let corners = self.vertices_of_faces();
        let facets: Vec<u32> = (0..self.facet_count() as u32).collect();
        let mut simplices = Vec::new();
        let mut apexes = Vec::with_capacity(N + 1);
        self.fill(N, &facets, 0, &corners, &mut apexes, &mut simplices);
        simplices
    }

    fn facet_count(&self) -> usize {
        self.ranks.last().map_or(self.vertices.len(), Faces::len)
    }

    /// Ascending vertices of the faces of ranks 0 to N − 1.
    fn vertices_of_faces(&self) -> Vec<Vec<Vec<u32>>> {
        let mut by_rank: Vec<Vec<Vec<u32>>> = vec![(0..self.vertices.len() as u32).map(|v| vec![v]).collect()];
        for faces in &self.ranks {
            let below = &by_rank[by_rank.len() - 1];
            let gathered = faces.iter().map(|parts| {
                let mut all: Vec<u32> = parts.iter().flat_map(|&part| below[part as usize].iter().copied()).collect();
                all.sort_unstable();
                all.dedup();
                all
            });
            let gathered = gathered.collect();
            by_rank.push(gathered);
        }
        by_rank
    }

    /// Fills a face of rank `rank` whose boundary is given, from its vertex `apex`.
    fn fill(
        &self,
        rank: usize,
        boundary: &[u32],
        apex: u32,
        corners: &[Vec<Vec<u32>>],
        apexes: &mut Vec<u32>,
        simplices: &mut Vec<Vec<u32>>,
    ) {
        apexes.push(apex);
        for &part in boundary {
            let part = part as usize;
            let own = &corners[rank - 1][part];
            if own.binary_search(&apex).is_ok() {
                continue;
            }
            if own.len() == rank {
                simplices.push(apexes.iter().chain(own).copied().collect());
            } else {
                self.fill(rank - 1, self.ranks[rank - 2].get(part), own[0], corners, apexes, simplices);
            }
        }
        apexes.pop();
    }

    /// Volume (in m^N; of a segment its length), centroid and second moments at unit density. All zero for nothing.
    #[must_use]
    pub fn mass_properties(&self) -> MassProperties<N> {
        MassProperties::of_filling(&self.vertices, &self.filling())
    }
}

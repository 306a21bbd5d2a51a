//! Convex polytopes: vertices, facets, and who touches whom.

use hyperbody_math::{Matrix, Vector};

use crate::error::GeometryErrorKind::BadNumber;
use crate::round_parts::{RoundPart, TurnedToward};
use crate::tolerances::{JOINING_TOLERANCES, MIN_CLIMBING_VERTICES};
use crate::{FaceLattice, GeometryError, Result, hull, incidence};

/// A convex polytope with non-empty interior. Vertices, facets and neighbours are in a fixed order that depends on the
/// input alone.
#[derive(Clone, Debug)]
pub struct Polytope<const N: usize> {
    vertices: Vec<Vector<N>>,
    facets: Vec<Facet<N>>,
    /// Facets that hold each vertex, ascending.
    vertex_facets: Vec<Vec<u32>>,
    /// Vertices joined to each vertex by an edge, ascending.
    vertex_neighbours: Vec<Vec<u32>>,
    bounding_radius: f64,
    /// A vertex farthest along −axis and along +axis, for each axis in turn: where the climb to a support begins.
    axis_supports: Vec<u32>,
    /// What is round in the shape that this polytope stands for; empty for most.
    round_parts: Vec<RoundPart>,
}

/// One facet (face of dimension `N − 1`): the polytope lies where normal·p ≤ offset.
#[derive(Clone, Debug)]
pub struct Facet<const N: usize> {
    /// Outward unit normal.
    pub normal: Vector<N>,
    /// Distance of the facet's hyperplane from the origin along the normal.
    pub offset: f64,
    /// Its vertices, ascending.
    pub vertices: Vec<u32>,
    /// The facets that share a ridge (face of dimension `N − 2`) with it, ascending.
    pub neighbours: Vec<u32>,
}

impl<const N: usize> Polytope<N> {
    /// The convex hull of points in any order; duplicates and points that are not vertices are welcome. The vertices
    /// keep the order and the exact coordinates of the points.
    ///
    /// Points closer than 1e-10 of half the extent to a facet's hyperplane lie in it; see
    /// [`convex_hull_within`](hull::convex_hull_within) for coordinates of lower precision.
    ///
    /// # Errors
    /// `BadCount` for fewer than `N + 1` points, or more than the limits in [`tolerances`](crate::tolerances); `Flat`
    /// if they do not span the space; `BadNumber` if one is not finite, or if they leave no clear hull.
    ///
    /// ```
    /// use hyperbody_geometry::Polytope;
    /// use hyperbody_math::{Matrix, Vector};
    /// let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 0.5]].map(Vector);
    /// let polytope = Polytope::from_points(&square)?;
    /// assert_eq!((polytope.vertices().len(), polytope.facets().len()), (4, 4));
    /// # Ok::<(), hyperbody_geometry::GeometryError>(())
    /// ```
    pub fn from_points(points: &[Vector<N>]) -> Result<Self> {
        hull::convex_hull(points).map(|(polytope, _)| polytope)
    }

    /// The polytope with coarser and coarser tolerance for what is one facet, to 1e-3 of its size: facets that noise in the last
    /// digits has split are joined.
    pub(crate) fn with_joined_facets(&self) -> impl Iterator<Item = Self> {
        let joined = |tolerance| hull::convex_hull_within(&self.vertices, tolerance).ok().map(|(joined, _)| joined);
        JOINING_TOLERANCES.into_iter().chain([1e-3]).filter_map(joined)
    }

    /// Takes vertices and facets that are known to fit together.
    pub(crate) fn from_parts(vertices: Vec<Vector<N>>, facets: Vec<Facet<N>>) -> Self {
        let lists: Vec<&[u32]> = facets.iter().map(|facet| facet.vertices.as_slice()).collect();
        let vertex_facets = incidence::transposed(&lists, vertices.len());
        let vertex_neighbours = incidence::vertex_neighbours(&facets, &vertex_facets);
        let mut polytope = Self {
            vertices,
            facets,
            vertex_facets,
            vertex_neighbours,
            bounding_radius: 0.0,
            axis_supports: Vec::new(),
            round_parts: Vec::new(),
        };
        polytope.update_bounds();
        polytope
    }

    /// Sets what depends on the positions of the vertices alone.
    fn update_bounds(&mut self) {
        self.bounding_radius = self.vertices.iter().map(|v| v.norm()).fold(0.0, f64::max);
        self.axis_supports =
            (0..2 * N).map(|i| self.scan(Vector::unit(i / 2) * if i % 2 == 0 { -1.0 } else { 1.0 }) as u32).collect();
    }

    /// This polytope, made from scaled points, at its true place: the vertices are the given points themselves.
    pub(crate) fn placed(mut self, points: &[Vector<N>], used: &[u32], centre: Vector<N>, extent: f64) -> Self {
        self.vertices = used.iter().map(|&index| points[index as usize]).collect();
        for facet in &mut self.facets {
            facet.offset = facet.offset * extent + facet.normal.dot(centre);
        }
        self.update_bounds();
        self
    }

    /// This polytope in place of a shape that is round in these parts.
    pub(crate) fn standing_for(mut self, round_parts: Vec<RoundPart>) -> Self {
        self.round_parts = round_parts;
        self
    }

    /// Whether the polytope stands for a shape that is round in some of its dimensions: the faceted form of a product or cone.
    #[must_use]
    pub fn stands_for_round(&self) -> bool {
        !self.round_parts.is_empty()
    }

    /// This polytope as it is met from one direction (of any length). Where it stands for a shape with round parts, these are
    /// turned so that a vertex lies exactly where the shape reaches farthest: seen from a plane across that direction it is as
    /// round as the shape, and rolls like it.
    #[must_use]
    pub fn turned_toward(&self, direction: Vector<N>) -> TurnedToward<'_, N> {
        TurnedToward::new(self, &self.round_parts, direction)
    }

    /// Mean of the vertices: a point of the interior.
    #[must_use]
    pub fn vertex_mean(&self) -> Vector<N> {
        self.vertices.iter().fold(Vector::ZERO, |sum, &v| sum + v) / self.vertices.len() as f64
    }

    /// All faces, from vertices to facets.
    #[must_use]
    pub fn face_lattice(&self) -> FaceLattice {
        FaceLattice::new(self)
    }

    /// Simplices that fill the facets, oriented outward: with o inside, det[v_1 − o, …, v_N − o] is not negative.
    #[must_use]
    pub fn boundary_simplices(&self) -> Vec<[u32; N]> {
        let mut simplices: Vec<[u32; N]> = Vec::new();
        let simplicial = self.facets.iter().all(|facet| facet.vertices.len() == N);
        if simplicial {
            simplices.extend(self.facets.iter().filter_map(|facet| <[u32; N]>::try_from(&facet.vertices[..]).ok()));
        } else {
            let lattice = self.face_lattice();
            for facet in 0..self.facets.len() {
                let filling = lattice.triangulation(N - 1, facet);
                simplices.extend(filling.iter().filter_map(|simplex| <[u32; N]>::try_from(&simplex[..]).ok()));
            }
        }
        let inside = self.vertex_mean();
        for simplex in &mut simplices {
            let corners = simplex.map(|v| self.vertices[v as usize] - inside);
            if Matrix::from_columns(corners).determinant() < 0.0 {
                simplex.swap(0, 1);
            }
        }
        simplices
    }

    /// The polytope moved by `offset`.
    #[must_use]
    pub fn translated(&self, offset: Vector<N>) -> Self {
        let mut moved = self.clone().standing_for(Vec::new());
        for vertex in &mut moved.vertices {
            *vertex += offset;
        }
        for facet in &mut moved.facets {
            facet.offset += facet.normal.dot(offset);
        }
        moved.update_bounds();
        moved
    }

    /// The polytope with every coordinate multiplied by `factor`.
    ///
    /// # Errors
    /// If the factor is not finite or not positive, or leads to a size outside 1e-150 to 1e150 m.
    pub fn scaled(&self, factor: f64) -> Result<Self> {
        if !(factor > 0.0 && factor.is_finite()) {
            return Err(GeometryError::new(
                BadNumber,
                format!("a polytope is scaled by {factor}: the factor must be positive and finite"),
            ));
        }
        let mut scaled = self.clone().standing_for(Vec::new());
        for vertex in &mut scaled.vertices {
            *vertex *= factor;
        }
        for facet in &mut scaled.facets {
            facet.offset *= factor;
        }
        scaled.update_bounds();
        // Squares of lengths have to be numbers.
        if !(1e-150..=1e150).contains(&scaled.bounding_radius) {
            return Err(GeometryError::new(
                BadNumber,
                format!(
                    "a polytope is scaled by {factor} to a size of {} m: it must lie between 1e-150 and 1e150",
                    scaled.bounding_radius
                ),
            ));
        }
        Ok(scaled)
    }

    /// The vertices.
    #[must_use]
    pub fn vertices(&self) -> &[Vector<N>] {
        &self.vertices
    }

    /// The facets.
    #[must_use]
    pub fn facets(&self) -> &[Facet<N>] {
        &self.facets
    }

    /// The facets that hold vertex `v`, ascending.
    #[must_use]
    pub fn facets_of_vertex(&self, v: usize) -> &[u32] {
        &self.vertex_facets[v]
    }

    /// The vertices joined to vertex `v` by an edge, ascending.
    #[must_use]
    pub fn neighbours_of_vertex(&self, v: usize) -> &[u32] {
        &self.vertex_neighbours[v]
    }

    /// Largest distance of a vertex from the origin.
    #[must_use]
    pub fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }

    /// Index of a vertex that lies farthest in `direction` (any length). The same direction always gives the same
    /// vertex: of equals the smallest where the polytope is small enough to look at all of them.
    #[must_use]
    pub fn support_vertex(&self, direction: Vector<N>) -> usize {
        if self.vertices.len() < MIN_CLIMBING_VERTICES {
            return self.scan(direction);
        }
        let axis = direction.axis_of_max_abs();
        let start = self.axis_supports[2 * axis + usize::from(direction[axis] > 0.0)];
        self.climb(start as usize, direction)
    }

    /// Index of a vertex that lies farthest in `direction`, searched from vertex `start`, such as the answer to a
    /// direction close to this one. Of equals it may find another one than [`Polytope::support_vertex`].
    ///
    /// # Panics
    /// If there is no vertex `start`.
    #[must_use]
    pub fn support_vertex_from(&self, start: usize, direction: Vector<N>) -> usize {
        self.climb(start, direction)
    }

    /// Goes along edges to the best neighbour for as long as that is farther. A polytope is convex: where no edge
    /// leads farther, nothing does. Each step gains, so no vertex is seen twice.
    fn climb(&self, start: usize, direction: Vector<N>) -> usize {
        let mut best = start;
        let mut farthest = self.vertices[start].dot(direction);
        for _ in 0..self.vertices.len() {
            let current = best;
            for &neighbour in &self.vertex_neighbours[current] {
                let distance = self.vertices[neighbour as usize].dot(direction);
                if distance > farthest {
                    best = neighbour as usize;
                    farthest = distance;
                }
            }
            if best == current {
                break;
            }
        }
        best
    }

    fn scan(&self, direction: Vector<N>) -> usize {
        let mut best = 0;
        let mut farthest = f64::NEG_INFINITY;
        for (index, vertex) in self.vertices.iter().enumerate() {
            let distance = vertex.dot(direction);
            if distance > farthest {
                best = index;
                farthest = distance;
            }
        }
        best
    }
}

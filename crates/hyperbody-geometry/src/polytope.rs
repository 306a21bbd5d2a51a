//! Convex polytopes: vertices, facets, and who touches whom.

use hyperbody_math::Vector;

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

    /// Index of a vertex that lies farthest in `direction`; the smallest of equals.
    #[must_use]
    pub fn support_vertex(&self, direction: Vector<N>) -> usize {
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

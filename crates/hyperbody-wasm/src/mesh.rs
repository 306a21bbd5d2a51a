//! Triangles and crisp edges in slice coordinates, in the single precision that a graphics card takes.

use hyperbody::geometry::{SectionPolytope, Surface};
use hyperbody::math::Vector;

/// The section of one body. Triangles share no corners: every corner has a position, a normal and a cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// xyz of each corner; z is 0 where two dimensions are drawn.
    pub positions: Vec<f32>,
    /// Unit normal of each corner.
    pub normals: Vec<f32>,
    /// For each corner the facet of the body that its triangle was cut from.
    pub cells: Vec<u16>,
    /// xyz of the two ends of each crisp edge.
    pub edges: Vec<f32>,
}

/// A point or direction as three floats.
pub(crate) fn single(point: Vector<3>) -> [f32; 3] {
    point.0.map(|c| c as f32)
}

pub(crate) fn cross(a: Vector<3>, b: Vector<3>) -> Vector<3> {
    Vector([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
}

impl Mesh {
    /// Forgets everything but the memory.
    pub(crate) fn clear(&mut self) {
        self.positions.clear();
        self.normals.clear();
        self.cells.clear();
        self.edges.clear();
    }

    /// Number of corners.
    #[must_use]
    pub fn corner_count(&self) -> usize {
        self.cells.len()
    }

    pub(crate) fn triangle(&mut self, corners: [Vector<3>; 3], normals: [Vector<3>; 3], cell: u16) {
        for (corner, normal) in corners.into_iter().zip(normals) {
            self.positions.extend(single(corner));
            self.normals.extend(single(normal));
            self.cells.push(cell);
        }
    }

    pub(crate) fn edge(&mut self, from: Vector<3>, to: Vector<3>) {
        self.edges.extend(single(from));
        self.edges.extend(single(to));
    }

    /// Adds the surface and the edges of a polytope.
    pub(crate) fn add_polytope(&mut self, polytope: &SectionPolytope<3>, surface: &mut Surface, first_cell: u32) {
        surface.clear();
        surface.add_polytope(polytope, first_cell);
        let vertices = surface.vertices();
        for (corners, source) in surface.polygons() {
            let Some((&first, rest)) = corners.split_first() else { continue };
            let apex = vertices[first as usize];
            let spoke = |corner: u32| vertices[corner as usize] - apex;
            let sum = rest.windows(2).fold(Vector::ZERO, |sum, pair| sum + cross(spoke(pair[0]), spoke(pair[1])));
            let Some(normal) = sum.try_normalize() else { continue };
            for pair in rest.windows(2) {
                let triangle = [apex, vertices[pair[0] as usize], vertices[pair[1] as usize]];
                self.triangle(triangle, [normal; 3], cell_number(source));
            }
        }
        for ends in polytope.faces(1) {
            if let &[from, to] = ends {
                self.edge(vertices[from as usize], vertices[to as usize]);
            }
        }
    }

    /// Adds a convex polygon in the plane z = 0 whose corners go around it, and its outline.
    pub(crate) fn add_polygon(&mut self, corners: &[Vector<2>], cell: u16) {
        let flat = |corner: Vector<2>| Vector([corner[0], corner[1], 0.0]);
        let Some((&first, rest)) = corners.split_first() else { return };
        for pair in rest.windows(2) {
            self.triangle([flat(first), flat(pair[0]), flat(pair[1])], [Vector::unit(2); 3], cell);
        }
        for (index, &corner) in corners.iter().enumerate() {
            self.edge(flat(corner), flat(corners[(index + 1) % corners.len()]));
        }
    }

    /// Adds `other` after turning its coordinates by `rows` and moving them by `offset`.
    pub(crate) fn add_placed(&mut self, other: &Self, rows: [Vector<3>; 3], offset: Vector<3>) {
        let turned = |numbers: &[f32]| {
            let v = Vector([f64::from(numbers[0]), f64::from(numbers[1]), f64::from(numbers[2])]);
            Vector([rows[0].dot(v), rows[1].dot(v), rows[2].dot(v)])
        };
        self.positions.extend(other.positions.chunks_exact(3).flat_map(|p| single(turned(p) + offset)));
        self.normals.extend(other.normals.chunks_exact(3).flat_map(|n| single(turned(n))));
        self.cells.extend_from_slice(&other.cells);
        self.edges.extend(other.edges.chunks_exact(3).flat_map(|p| single(turned(p) + offset)));
    }
}

/// Cells beyond the range of the buffer share its last number.
pub(crate) fn cell_number(source: u32) -> u16 {
    u16::try_from(source).unwrap_or(u16::MAX)
}

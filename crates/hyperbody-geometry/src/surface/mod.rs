//! Surfaces in three dimensions: what screens and printers take. A special of that dimension, and the end of every chain of
//! sections.

mod ears;
mod glb;
mod loops;
mod seams;
mod sheets;
mod text;
mod walls;

use hyperbody_math::Vector;

use crate::{Result, SectionPolytope, Solid};

/// Closed surfaces of flat polygons.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    vertices: Vec<Vector<3>>,
    /// Corners of all polygons, one polygon behind the other.
    corners: Vec<u32>,
    polygons: Vec<Polygon>,
}

/// Where a polygon's corners end, and what it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Polygon {
    end: u32,
    source: u32,
}

impl Surface {
    /// An empty one.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets everything but the memory.
    pub fn clear(&mut self) {
        self.vertices.clear();
        self.corners.clear();
        self.polygons.clear();
    }

    /// Whether there is no polygon.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.polygons.is_empty()
    }

    /// The vertices.
    #[must_use]
    pub fn vertices(&self) -> &[Vector<3>] {
        &self.vertices
    }

    /// Number of polygons.
    #[must_use]
    pub fn polygon_count(&self) -> usize {
        self.polygons.len()
    }

    /// The polygons: corners in order, counterclockwise as seen from outside, and the source of each, which for a section is
    /// the number of the facet of the body that it was cut from.
    pub fn polygons(&self) -> impl Iterator<Item = (&[u32], u32)> {
        (0..self.polygons.len()).map(|index| {
            let start = if index == 0 { 0 } else { self.polygons[index - 1].end as usize };
            let Polygon { end, source } = self.polygons[index];
            (&self.corners[start..end as usize], source)
        })
    }

    /// The polygons as triangles that fan out from their first corners, with the source of each.
    pub fn triangles(&self) -> impl Iterator<Item = ([u32; 3], u32)> {
        self.polygons().flat_map(|(corners, source)| {
            let pairs = corners.get(1..).unwrap_or_default().windows(2);
            pairs.map(move |pair| ([corners[0], pair[0], pair[1]], source))
        })
    }

    /// Adds the surface of a polytope. Sources are shifted by `first_source`.
    pub fn add_polytope(&mut self, polytope: &SectionPolytope<3>, first_source: u32) {
        let first_vertex = self.vertices.len() as u32;
        self.vertices.extend_from_slice(polytope.vertices());
        for (index, &source) in polytope.facet_sources().iter().enumerate() {
            let start = self.corners.len();
            polytope.for_each_corner(index, |corner| self.corners.push(corner));
            let loop_ = &mut self.corners[start..];
            if faces_inward(polytope, loop_) {
                loop_.reverse();
            }
            loop_.iter_mut().for_each(|corner| *corner += first_vertex);
            self.polygons.push(Polygon { end: self.corners.len() as u32, source: source + first_source });
        }
    }

    /// Adds the surface of a convex piece; curved ones within `tolerance` in metres, see [`Solid::to_polytope`].
    ///
    /// # Errors
    /// As [`Solid::to_polytope`].
    pub fn add_solid(&mut self, solid: &Solid<3>, tolerance: f64, first_source: u32) -> Result<()> {
        if let Solid::Polytope(polytope) = solid {
            self.add_polytope(polytope, first_source);
        } else if let Some(polytope) = solid.to_polytope(tolerance)? {
            self.add_polytope(&polytope.with_source(0), first_source);
        }
        Ok(())
    }
}

/// Whether the corners go clockwise as seen from outside.
fn faces_inward(polytope: &SectionPolytope<3>, corners: &[u32]) -> bool {
    let at = |corner: u32| polytope.vertices()[corner as usize];
    let Some(&first) = corners.first() else { return false };
    let base = at(first);
    let mut normal = Vector::<3>::ZERO;
    for pair in corners.windows(2) {
        let (a, b) = (at(pair[0]) - base, at(pair[1]) - base);
        normal += cross(a, b);
    }
    normal.dot(base - polytope.centre()) < 0.0
}

fn cross(a: Vector<3>, b: Vector<3>) -> Vector<3> {
    Vector([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
}

//! Projections: a body seen along an axis, as edges and faces for wireframes and as an outline for ghosts.
//!
//! Where a section shows what lies in a hyperplane, a projection shows everything at once, laid over itself. In parallel
//! projection a point p lands at its foot on the hyperplane. In perspective an eye stands at the distance d over the
//! hyperplane, on the side of its normal, and p at height h lands where the line from the eye through p meets it: at the foot
//! times d/(d − h). The hyperplane itself keeps its size, what is nearer to the eye grows. Projections of projections
//! lead on down to three or two dimensions.

use std::sync::Arc;

use hyperbody_math::Vector;

use crate::error::GeometryErrorKind::BadNumber;
use crate::section::{InShadow, SupportMap};
use crate::tolerances::MAX_LENGTH;
use crate::{GeometryError, Polytope, Result, SectionPolytope, SliceFrame, Solid};

/// A way of looking at `N` dimensions from `N − 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection<const N: usize> {
    frame: SliceFrame<N>,
    /// Distance of the eye from the hyperplane, m; infinite for parallel projection.
    eye: f64,
}

/// Share of the eye's distance that every vertex has to stay before the eye.
const NEAREST: f64 = 1e-3;

impl<const N: usize> Projection<N> {
    /// Along the normal of a hyperplane, whose coordinates the picture has.
    #[must_use]
    pub const fn parallel(frame: SliceFrame<N>) -> Self {
        Self { frame, eye: f64::INFINITY }
    }

    /// Towards an eye at `distance` (m) from the hyperplane, on the side of its normal over the origin of its coordinates.
    ///
    /// # Errors
    /// `BadNumber` if the distance is not positive, or more than [`MAX_LENGTH`].
    pub fn perspective(frame: SliceFrame<N>, distance: f64) -> Result<Self> {
        if distance > 0.0 && distance <= MAX_LENGTH {
            return Ok(Self { frame, eye: distance });
        }
        let message = format!(
            "the eye of a projection is {distance} m from its hyperplane: it has to be more than 0 and at most {MAX_LENGTH:e}"
        );
        Err(GeometryError::new(BadNumber, message))
    }

    /// Where a point lands, in the coordinates of the hyperplane, and its height over the hyperplane (m), by which pictures
    /// may fade. `M` has to be `N − 1`. `None` if the point is not clearly before the eye.
    #[must_use]
    pub fn point<const M: usize>(&self, point: Vector<N>) -> Option<(Vector<M>, f64)> {
        let height = self.frame.height(point);
        let foot = self.frame.to_slice::<M>(point);
        if self.eye.is_infinite() {
            return Some((foot, height));
        }
        let before = self.eye - height;
        (before >= NEAREST * self.eye).then(|| (foot * (self.eye / before), height))
    }

    fn behind(&self) -> GeometryError {
        GeometryError::new(
            BadNumber,
            format!("the eye, {} m from the hyperplane, is not before all of the body: move it farther away", self.eye),
        )
    }
}

/// A projected body: all its vertices, edges and 2-faces, those on the far side included.
#[derive(Clone, Debug, PartialEq)]
pub struct Wireframe<const M: usize> {
    vertices: Vec<Vector<M>>,
    heights: Vec<f64>,
    edges: Vec<[u32; 2]>,
    /// Corners in order around each polygon.
    polygons: Vec<Vec<u32>>,
}

impl<const M: usize> Wireframe<M> {
    /// Where the vertices of the body land, in its order.
    #[must_use]
    pub fn vertices(&self) -> &[Vector<M>] {
        &self.vertices
    }

    /// Height of each vertex over the hyperplane of the last projection, m.
    #[must_use]
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// The edges, as pairs of vertices.
    #[must_use]
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// The faces of two dimensions, each by its corners in order around it; straight lines stay straight, so that they are
    /// plane polygons still, some perhaps seen edge on.
    #[must_use]
    pub fn polygons(&self) -> &[Vec<u32>] {
        &self.polygons
    }

    /// Looks at the picture again, from one dimension less. `L` has to be `M − 1`.
    ///
    /// # Errors
    /// `BadNumber` if a vertex is not before the eye.
    pub fn project<const L: usize>(&self, projection: &Projection<M>) -> Result<Wireframe<L>> {
        project(&self.vertices, self.edges.clone(), self.polygons.clone(), projection)
    }

    /// The outline: the polytope that the picture covers if the body is convex.
    ///
    /// # Errors
    /// As [`Polytope::from_points`].
    pub fn outline(&self) -> Result<Polytope<M>> {
        Polytope::from_points(&self.vertices)
    }
}

fn project<const N: usize, const M: usize>(
    points: &[Vector<N>],
    edges: Vec<[u32; 2]>,
    polygons: Vec<Vec<u32>>,
    projection: &Projection<N>,
) -> Result<Wireframe<M>> {
    let landed: Option<Vec<(Vector<M>, f64)>> = points.iter().map(|&point| projection.point::<M>(point)).collect();
    let (vertices, heights) = landed.ok_or_else(|| projection.behind())?.into_iter().unzip();
    Ok(Wireframe { vertices, heights, edges, polygons })
}

impl<const N: usize> SectionPolytope<N> {
    /// The polytope as edges and faces, projected. `M` has to be `N − 1`.
    ///
    /// # Errors
    /// `BadNumber` if a vertex is not before the eye.
    ///
    /// ```
    /// use hyperbody_geometry::projection::Projection;
    /// use hyperbody_geometry::regular::{Size, polytope};
    /// use hyperbody_geometry::{SectionPolytope, SliceFrame};
    /// let tesseract = SectionPolytope::from_polytope(&polytope::<4>("tesseract", Size::Edge(1.0))?);
    /// let along_w = SliceFrame::from_normal([0.0, 0.0, 0.0, 1.0], 0.0)?;
    /// let cube_in_cube = tesseract.project::<3>(&Projection::perspective(along_w, 2.0)?)?;
    /// assert_eq!((cube_in_cube.edges().len(), cube_in_cube.polygons().len()), (32, 24));
    /// # Ok::<(), hyperbody_geometry::GeometryError>(())
    /// ```
    pub fn project<const M: usize>(&self, projection: &Projection<N>) -> Result<Wireframe<M>> {
        let edges = self.faces(1).filter_map(|ends| <[u32; 2]>::try_from(ends).ok()).collect();
        let polygon = |number: usize| {
            let mut corners = Vec::new();
            self.for_each_corner(number, |corner| corners.push(corner));
            corners
        };
        // In two dimensions the only polygon is the body itself, whose corners no rank lists.
        let count = if N > 2 { self.faces(2).count() } else { 0 };
        project(self.vertices(), edges, (0..count).map(polygon).collect(), projection)
    }
}

impl<const N: usize> Solid<N> {
    /// What the piece covers when it is seen along the normal of `frame`, in parallel projection: its shadow, from any direction
    /// of the picture as wide as the piece. `M` has to be `N − 1`. `None` for half-spaces that the normal leaves, which cover
    /// everything, and for polytopes too flat to have a hull.
    #[must_use]
    pub fn shadow<const M: usize>(&self, frame: &SliceFrame<N>) -> Option<Solid<M>> {
        match self {
            Self::Ball { centre, radius } => Some(Solid::Ball { centre: frame.to_slice(*centre), radius: *radius }),
            Self::HalfSpace { normal, offset } => {
                let within = frame.direction_to_slice::<M>(*normal);
                let along = normal.dot(frame.normal()).abs();
                (along < 1e-12).then(|| Solid::HalfSpace {
                    normal: within.normalize_or_zero(),
                    offset: offset - normal.dot(frame.space_from_slice().translation),
                })
            }
            Self::Polytope(polytope) => {
                let landed: Vec<Vector<M>> = polytope.vertices().iter().map(|&v| frame.to_slice(v)).collect();
                let outline = if M == 1 { None } else { Polytope::from_points(&landed).ok() };
                outline.map(|outline| Solid::Polytope(SectionPolytope::from_polytope(&outline)))
            }
            Self::Curved(body) => {
                let shadow: Arc<dyn SupportMap<M>> = Arc::new(InShadow::<N, M>::new(Arc::clone(body), *frame));
                Some(Solid::Curved(shadow))
            }
        }
    }
}

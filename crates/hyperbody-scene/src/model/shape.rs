//! What bodies are made of, as a file says it.

pub use hyperbody::geometry::regular::Size;

use super::RotationSpec;

/// A shape whose dimension is that of its scene. Lengths in metres.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ShapeSpec {
    /// All points at most `radius` from the origin.
    Ball {
        /// > 0.
        radius: f64,
    },
    /// A box with edges along the axes.
    Box {
        /// Half the edge lengths, > 0, one per axis.
        half_extents: Vec<f64>,
    },
    /// All points with normal·p ≤ offset; for static bodies.
    HalfSpace {
        /// Points out of the solid; any length but zero.
        normal: Vec<f64>,
        /// Distance of the boundary from the origin, in lengths of the normal.
        offset: f64,
    },
    /// All points at most `radius` from a segment about the origin.
    Capsule {
        /// Half the length of the segment, > 0.
        half_length: f64,
        /// > 0.
        radius: f64,
        /// Name of the axis along which the segment lies, such as "y".
        along: String,
    },
    /// A convex polytope.
    Polytope(PolytopeSpec),
    /// A box or polytope with edges and corners rounded: all points at most `radius` from it.
    Rounded {
        /// What is rounded.
        shape: Box<ShapeSpec>,
        /// > 0.
        radius: f64,
    },
    /// A product of shapes of lower dimension.
    Product {
        /// Two or more, whose axes are all axes of the scene once.
        factors: Vec<Factor>,
    },
    /// A pyramid over a shape of one dimension less, a cone if that is curved.
    Pyramid {
        /// The base, whose axes are all axes of the scene but that of the height. It lies at −height/2.
        base: Box<Factor>,
        /// > 0. The apex lies at height/2, over the origin of the base.
        height: f64,
    },
    /// A regular star polytope about the origin, as the union of what its surface winds around.
    Star {
        /// Its name or Schläfli symbol: "great icosahedron" or "{3,5/2}".
        name: String,
        /// How large it is.
        size: Size,
    },
    /// What the surface in an OFF file beside the scene bounds, convex or not.
    Mesh {
        /// The file.
        file: String,
    },
    /// The union of parts.
    Compound {
        /// At least one.
        parts: Vec<Part>,
    },
}

/// The three ways to give a polytope.
#[derive(Clone, Debug, PartialEq)]
pub enum PolytopeSpec {
    /// The convex hull of these points.
    Vertices(Vec<Vec<f64>>),
    /// A regular polytope about the origin.
    Regular {
        /// Its name or Schläfli symbol: "24-cell" or "{3,4,3}".
        name: String,
        /// How large it is.
        size: Size,
    },
    /// An OFF file beside the scene.
    File(String),
}

/// One factor of a product.
#[derive(Clone, Debug, PartialEq)]
pub struct Factor {
    /// What it is, in as many dimensions as it has axes.
    pub shape: ShapeSpec,
    /// Names of the axes that are its x, y, … in this order, such as "xw".
    pub axes: String,
}

/// One part of a compound.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// What it is.
    pub shape: ShapeSpec,
    /// Where its origin lies in the frame of the compound, m. Empty: at the origin.
    pub position: Vec<f64>,
    /// How it is turned in the frame of the compound.
    pub rotation: RotationSpec,
}

impl ShapeSpec {
    /// A ball.
    #[must_use]
    pub fn ball(radius: f64) -> Self {
        Self::Ball { radius }
    }

    /// A box.
    #[must_use]
    pub fn cuboid(half_extents: impl Into<Vec<f64>>) -> Self {
        Self::Box { half_extents: half_extents.into() }
    }

    /// A cube of `dimension` dimensions.
    #[must_use]
    pub fn cube(dimension: usize, half_extent: f64) -> Self {
        Self::Box { half_extents: vec![half_extent; dimension] }
    }

    /// A capsule along an axis.
    #[must_use]
    pub fn capsule(half_length: f64, radius: f64, along: &str) -> Self {
        Self::Capsule { half_length, radius, along: along.to_owned() }
    }

    /// A regular polytope by name and circumradius.
    #[must_use]
    pub fn regular(name: &str, circumradius: f64) -> Self {
        Self::Polytope(PolytopeSpec::Regular { name: name.to_owned(), size: Size::Circumradius(circumradius) })
    }

    /// The product of shapes on some of the axes each.
    #[must_use]
    pub fn product(factors: impl IntoIterator<Item = (Self, &'static str)>) -> Self {
        let factor = |(shape, axes): (Self, &str)| Factor { shape, axes: axes.to_owned() };
        Self::Product { factors: factors.into_iter().map(factor).collect() }
    }

    /// The pyramid over a shape on the given axes.
    #[must_use]
    pub fn pyramid(base: Self, axes: &str, height: f64) -> Self {
        Self::Pyramid { base: Box::new(Factor { shape: base, axes: axes.to_owned() }), height }
    }

    /// A regular star polytope by name or symbol and circumradius.
    #[must_use]
    pub fn star(name: &str, circumradius: f64) -> Self {
        Self::Star { name: name.to_owned(), size: Size::Circumradius(circumradius) }
    }

    /// This shape rounded by a radius.
    #[must_use]
    pub fn rounded(self, radius: f64) -> Self {
        Self::Rounded { shape: Box::new(self), radius }
    }

    /// What a file calls this sort of shape.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::Ball { .. } => "ball",
            Self::Box { .. } => "box",
            Self::HalfSpace { .. } => "half_space",
            Self::Capsule { .. } => "capsule",
            Self::Polytope(_) => "polytope",
            Self::Rounded { .. } => "rounded",
            Self::Product { .. } => "product",
            Self::Pyramid { .. } => "pyramid",
            Self::Star { .. } => "star",
            Self::Mesh { .. } => "mesh",
            Self::Compound { .. } => "compound",
        }
    }
}

impl Part {
    /// A part at a place, not turned.
    #[must_use]
    pub fn new(shape: ShapeSpec, position: impl Into<Vec<f64>>) -> Self {
        Self { shape, position: position.into(), rotation: RotationSpec::default() }
    }
}

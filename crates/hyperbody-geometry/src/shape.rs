//! Everything a body can be made of.

use std::sync::Arc;

use hyperbody_math::{Pose, Vector};

use crate::{Convex, GeometryError, Polytope};

/// A solid in the frame of its body. Lengths in metres. Made by the constructors, which check their arguments.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Shape<const N: usize> {
    /// All points at most `radius` from the origin.
    Ball {
        /// > 0.
        radius: f64,
    },
    /// All points with |p_i| ≤ h_i.
    Box {
        /// h_i > 0.
        half_extents: Vector<N>,
    },
    /// All points with normal·p ≤ offset. Static bodies only.
    HalfSpace {
        /// Outward unit normal.
        normal: Vector<N>,
        /// Distance of the boundary from the origin along the normal.
        offset: f64,
    },
    /// All points at most `radius` from the segment between ±`half_length` on axis `along`.
    Capsule {
        /// > 0.
        half_length: f64,
        /// > 0.
        radius: f64,
        /// < N.
        along: usize,
    },
    /// A convex polytope.
    Polytope(Arc<Polytope<N>>),
    /// All points at most `radius` from the box or polytope `core`.
    Rounded {
        /// A box or a polytope.
        core: Box<Shape<N>>,
        /// > 0.
        radius: f64,
    },
    /// The union of parts, each placed by its pose; half-spaces and compounds are not allowed as parts.
    Compound {
        /// At least one.
        parts: Vec<(Pose<N>, Shape<N>)>,
    },
}

/// What collision works on: one convex piece, or a half-space.
#[derive(Clone, Debug)]
pub enum Piece<const N: usize> {
    /// A rounded core.
    Convex(Convex<N>),
    /// All points with normal·p ≤ offset.
    HalfSpace {
        /// Outward unit normal.
        normal: Vector<N>,
        /// Distance of the boundary from the origin along the normal.
        offset: f64,
    },
}

/// The result of making a shape.
pub type Result<T> = std::result::Result<T, GeometryError>;

//! Everything a body can be made of.

use std::sync::Arc;

use hyperbody_math::{Pose, Vector};

use crate::error::GeometryErrorKind::{BadCount, BadNumber, Unsupported};
use crate::product::Product;
use crate::pyramid::Pyramid;
use crate::tolerances::{MAX_LENGTH, MAX_PARTS, MIN_LENGTH};

use crate::{Convex, Core, GeometryError, Polytope, Result};

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
    /// A product of shapes of lower dimension, of which at least one is curved: see [`Shape::product`].
    Product(Arc<Product<N>>),
    /// A pyramid over a curved base, a cone: see [`Shape::pyramid`].
    Pyramid(Arc<Pyramid<N>>),
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

impl<const N: usize> Shape<N> {
    /// A ball about the origin.
    ///
    /// # Errors
    /// If the radius is not a number of metres in [`MIN_LENGTH`]..=[`MAX_LENGTH`].
    pub fn ball(radius: f64) -> Result<Self> {
        Ok(Self::Ball { radius: check_length("the radius of a ball", radius)? })
    }

    /// A box about the origin with edges along the axes, 2h_i long.
    ///
    /// # Errors
    /// If a half-extent is not a number of metres in [`MIN_LENGTH`]..=[`MAX_LENGTH`].
    pub fn cuboid(half_extents: impl Into<Vector<N>>) -> Result<Self> {
        let half_extents = half_extents.into();
        for (axis, half_extent) in half_extents.iter().enumerate() {
            check_length(&format!("half-extent {axis} of a box"), half_extent)?;
        }
        Ok(Self::Box { half_extents })
    }

    /// All points p with normal·p ≤ offset. The normal may have any length: both sides of the inequality are divided
    /// by it.
    ///
    /// # Errors
    /// If the normal is zero or not finite, or the plane lies farther than [`MAX_LENGTH`] from the origin.
    pub fn half_space(normal: impl Into<Vector<N>>, offset: f64) -> Result<Self> {
        let normal = normal.into();
        let Some(unit) = normal.try_normalize() else {
            return Err(bad_number(format!(
                "the normal of a half-space is {:?}: it must be finite and not zero; give the direction out of the solid, \
                 such as the opposite of gravity for a floor",
                normal.0
            )));
        };
        // unit·normal is the length of the normal without the overflow of squares.
        let distance = offset / unit.dot(normal);
        if !(-MAX_LENGTH..=MAX_LENGTH).contains(&distance) {
            return Err(bad_number(format!(
                "the offset of a half-space is {offset} along the normal {:?}, which puts its boundary {distance} m from \
                 the origin: the limit is {MAX_LENGTH:e} m",
                normal.0
            )));
        }
        Ok(Self::HalfSpace { normal: unit, offset: distance })
    }

    /// All points at most `radius` from the segment between ±`half_length` on axis `along`.
    ///
    /// # Errors
    /// If a length is not a number of metres in [`MIN_LENGTH`]..=[`MAX_LENGTH`], or there is no such axis.
    pub fn capsule(half_length: f64, radius: f64, along: usize) -> Result<Self> {
        if along >= N {
            return Err(bad_number(format!(
                "a capsule lies along axis {along}: in {N} dimensions the axes are numbered 0 to {}",
                N - 1
            )));
        }
        let half_length = check_length("the half-length of a capsule", half_length)?;
        let radius = check_length("the radius of a capsule", radius)?;
        Ok(Self::Capsule { half_length, radius, along })
    }

    /// A convex polytope, at the place where its vertices put it.
    ///
    /// # Errors
    /// If it reaches farther than [`MAX_LENGTH`] from the origin, or is smaller than [`MIN_LENGTH`].
    pub fn polytope(polytope: Arc<Polytope<N>>) -> Result<Self> {
        let reach = polytope.bounding_radius();
        if !(0.0..=MAX_LENGTH).contains(&reach) {
            return Err(bad_number(format!(
                "a vertex of the polytope lies {reach} m from the origin: the limit is {MAX_LENGTH:e} m; scale it down or \
                 move it to the origin"
            )));
        }
        let (lower, upper) = polytope
            .vertices()
            .iter()
            .fold((Vector::splat(f64::INFINITY), Vector::splat(f64::NEG_INFINITY)), |(lower, upper), &v| {
                (lower.min(v), upper.max(v))
            });
        check_length("the size of a polytope", (upper - lower).max_abs())?;
        Ok(Self::Polytope(polytope))
    }

    /// All points at most `radius` from `core`: the shape grows, and its edges become round. Balls, capsules, rounded
    /// shapes and half-spaces just grow; compounds cannot be rounded, but their parts can.
    ///
    /// # Errors
    /// If the radius is not a number of metres in [`MIN_LENGTH`]..=[`MAX_LENGTH`], or the core is a compound.
    pub fn rounded(core: Self, radius: f64) -> Result<Self> {
        let radius = check_length("the radius of a rounded shape", radius)?;
        match core {
            Self::Ball { radius: inner } => Self::ball(inner + radius),
            Self::Capsule { half_length, radius: inner, along } => Self::capsule(half_length, inner + radius, along),
            Self::HalfSpace { normal, offset } => Self::half_space(normal, offset + radius),
            Self::Rounded { core, radius: inner } => Self::rounded(*core, inner + radius),
            Self::Box { .. } | Self::Polytope(_) => Ok(Self::Rounded { core: Box::new(core), radius }),
            Self::Product(_) => Err(GeometryError::new(
                Unsupported,
                "a product with curved factors cannot be rounded: round its factors instead",
            )),
            Self::Pyramid(_) => Err(GeometryError::new(
                Unsupported,
                "a cone cannot be rounded: use a pyramid over a polytope, or a rounded base",
            )),
            Self::Compound { .. } => {
                Err(GeometryError::new(Unsupported, "a compound cannot be rounded: round its parts instead"))
            }
        }
    }

    /// The union of convex parts, each placed by its pose in the frame of the compound.
    ///
    /// # Errors
    /// If there is no part, a part is a compound or a half-space, or a pose is not finite or farther out than
    /// [`MAX_LENGTH`].
    pub fn compound(parts: Vec<(Pose<N>, Self)>) -> Result<Self> {
        if parts.is_empty() || parts.len() > MAX_PARTS {
            return Err(GeometryError::new(
                BadCount,
                format!("a compound has {} parts: it needs 1 to {MAX_PARTS}", parts.len()),
            ));
        }
        for (index, (pose, shape)) in parts.iter().enumerate() {
            let distance = pose.translation.max_abs();
            if !((0.0..=MAX_LENGTH).contains(&distance) && pose.rotation.matrix().is_finite()) {
                return Err(bad_number(format!(
                    "part {index} of a compound is placed at {:?}: every coordinate must be finite and at most \
                     {MAX_LENGTH:e} m from the origin",
                    pose.translation.0
                )));
            }
            let remedy = match shape {
                Self::Compound { .. } => "another compound; put the parts of both into one list",
                Self::HalfSpace { .. } => "a half-space; make it a static body of its own",
                _ => continue,
            };
            return Err(GeometryError::new(Unsupported, format!("part {index} of a compound is {remedy}")));
        }
        Ok(Self::Compound { parts })
    }

    /// What collision works on: the convex pieces with their poses in the frame of the shape (`shape_from_piece`).
    #[must_use]
    pub fn pieces(&self) -> Vec<(Pose<N>, Piece<N>)> {
        match self {
            Self::Compound { parts } => parts
                .iter()
                .map(|(pose, shape)| (*pose, shape.pieces()))
                .flat_map(|(outer, pieces)| pieces.into_iter().map(move |(inner, piece)| (outer * inner, piece)))
                .collect(),
            Self::HalfSpace { normal, offset } => {
                vec![(Pose::IDENTITY, Piece::HalfSpace { normal: *normal, offset: *offset })]
            }
            _ => {
                let (core, radius) = self.core_and_radius();
                vec![(Pose::IDENTITY, Piece::Convex(Convex { core, radius }))]
            }
        }
    }

    /// The rounded core of a convex, bounded shape. Compounds and half-spaces, which have none, never come here; their
    /// answer is a point of radius zero.
    fn core_and_radius(&self) -> (Core<N>, f64) {
        match self {
            Self::Ball { radius } => (Core::Point, *radius),
            Self::Box { half_extents } => (Core::Box { half_extents: *half_extents }, 0.0),
            Self::Capsule { half_length, radius, along } => {
                (Core::Segment { half: Vector::unit(*along) * *half_length }, *radius)
            }
            Self::Polytope(polytope) => (Core::Polytope(Arc::clone(polytope)), 0.0),
            Self::Product(product) => (Core::Polytope(Arc::clone(product.faceted())), 0.0),
            Self::Pyramid(pyramid) => (Core::Polytope(Arc::clone(pyramid.faceted())), 0.0),
            Self::Rounded { core, radius } => {
                let (inner, inner_radius) = core.core_and_radius();
                (inner, inner_radius + radius)
            }
            Self::HalfSpace { .. } | Self::Compound { .. } => (Core::Point, 0.0),
        }
    }
}

/// `length` if it lies in the range of lengths, else an error that names it.
pub(crate) fn check_length(what: &str, length: f64) -> Result<f64> {
    if (MIN_LENGTH..=MAX_LENGTH).contains(&length) {
        return Ok(length);
    }
    Err(bad_number(format!(
        "{what} is {length}: it must be a number of metres between {MIN_LENGTH:e} and {MAX_LENGTH:e}"
    )))
}

fn bad_number(message: String) -> GeometryError {
    GeometryError::new(BadNumber, message)
}

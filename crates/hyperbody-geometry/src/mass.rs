//! Volume, centre and second moments of bodies, and the principal frame that makes inertia `N` numbers.
//!
//! Balls, boxes, capsules and rounded boxes have one closed form; polytopes and meshes are sums over simplices; rounded
//! polytopes are sums over faces and their normal cones.

mod boundary;
mod normals;
mod orthant;
mod rounded_box;
mod rounded_polytope;

pub(crate) use normals::{Normals, orthogonal_part};
pub(crate) use rounded_polytope::simplex_content;

use hyperbody_math::eigen::symmetric_eigen;
use hyperbody_math::{Matrix, Pose, Rotation, Vector};

use crate::error::GeometryErrorKind::{BadCount, BadNumber, Unsupported};
use crate::tolerances::{MAX_DENSITY, MIN_DENSITY};
use crate::{GeometryError, Polytope, Result, Shape};

/// Mass, centre of mass and second moments of a body.
///
/// With second moments P_ij = ∫ρ x_i x_j dV about the centre of mass and Ω the antisymmetric matrix of ω, the angular
/// momentum is L = PΩ + ΩP; in principal axes P = diag(J_1, …, J_N) and plane (i, j) has the moment J_i + J_j.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties<const N: usize> {
    /// In kilograms; the volume (m^N) where the density is one.
    pub mass: f64,
    /// Centre of mass in the body frame, in metres.
    pub centre: Vector<N>,
    /// ∫ρ x xᵀ dV about the centre, body axes, in kg·m².
    pub second_moments: Matrix<N>,
}

impl<const N: usize> MassProperties<N> {
    /// The properties of a polytope at unit density.
    #[must_use]
    pub fn of_polytope(polytope: &Polytope<N>) -> Self {
        boundary::of_polytope(polytope)
    }

    /// These properties with the body placed at `outer_from_body` inside an outer frame.
    #[must_use]
    pub fn transformed(&self, outer_from_body: &Pose<N>) -> Self {
        let r = outer_from_body.rotation.matrix();
        Self {
            mass: self.mass,
            centre: outer_from_body.transform_point(self.centre),
            second_moments: boundary::symmetric(&(*r * self.second_moments * r.transpose())),
        }
    }

    /// These properties with every density multiplied by `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { mass: self.mass * factor, centre: self.centre, second_moments: self.second_moments * factor }
    }

    /// The properties of several bodies in one frame as one body. Where bodies overlap, both count.
    ///
    /// # Errors
    /// `BadCount` if there is no body, `BadNumber` if the total mass is not positive and finite.
    pub fn combined(parts: &[Self]) -> Result<Self> {
        let Some(first) = parts.first() else {
            return Err(GeometryError::new(BadCount, "no bodies to combine: give at least one"));
        };
        let mass: f64 = parts.iter().map(|part| part.mass).sum();
        if !(mass > 0.0 && mass.is_finite()) {
            return Err(GeometryError::new(
                BadNumber,
                format!("the {} parts of a body have a total mass of {mass}: it must be positive", parts.len()),
            ));
        }
        // Centres relative to the first one: far from the origin nothing cancels.
        let offset = parts.iter().fold(Vector::ZERO, |sum, p| sum + (p.centre - first.centre) * (p.mass / mass));
        let centre = first.centre + offset;
        let mut second_moments = Matrix::ZERO;
        for part in parts {
            let arm = part.centre - first.centre - offset;
            second_moments += part.second_moments + Matrix::outer(arm, arm) * part.mass;
        }
        Ok(Self { mass, centre, second_moments })
    }

    /// The principal moments J_i = ∫ρ y_i² dV (kg·m², descending) and `body_from_principal`, whose columns are the
    /// principal axes: second_moments = R diag(J) Rᵀ. Plane (i, j) of the principal frame has the moment J_i + J_j.
    #[must_use]
    pub fn principal(&self) -> (Vector<N>, Rotation<N>) {
        symmetric_eigen(&self.second_moments)
    }
}

impl<const N: usize> Shape<N> {
    /// Mass, centre and second moments in the frame of the shape, at a density in kg/m^N. The parts of a compound add
    /// up; where they overlap, both count.
    ///
    /// # Errors
    /// `BadNumber` if the density is not in [`MIN_DENSITY`]..=[`MAX_DENSITY`]; `BadCount` for a rounded polytope of so
    /// many facets that its solid angles would take minutes; `Unsupported` for a half-space, which is infinite.
    pub fn mass_properties(&self, density: f64) -> Result<MassProperties<N>> {
        if !(MIN_DENSITY..=MAX_DENSITY).contains(&density) {
            let message = format!(
                "the density is {density}: it must be a number of kg/m^{N} between {MIN_DENSITY:e} and {MAX_DENSITY:e}"
            );
            return Err(GeometryError::new(BadNumber, message));
        }
        Ok(self.unit_properties()?.scaled(density))
    }

    /// The properties at unit density.
    fn unit_properties(&self) -> Result<MassProperties<N>> {
        match self {
            Self::Ball { radius } => Ok(rounded_box::properties(Vector::ZERO, *radius)),
            Self::Box { half_extents } => Ok(rounded_box::properties(*half_extents, 0.0)),
            Self::Capsule { half_length, radius, along } => {
                Ok(rounded_box::properties(Vector::unit(*along) * *half_length, *radius))
            }
            Self::Polytope(polytope) => Ok(MassProperties::of_polytope(polytope)),
            Self::Product(product) => Ok(product.unit_properties()),
            Self::Pyramid(pyramid) => Ok(pyramid.unit_properties()),
            Self::Rounded { core, radius } => match core.as_ref() {
                Self::Box { half_extents } => Ok(rounded_box::properties(*half_extents, *radius)),
                Self::Polytope(polytope) => rounded_polytope::properties(polytope, *radius),
                _ => Err(GeometryError::new(Unsupported, "only boxes and polytopes can be rounded")),
            },
            Self::Compound { parts } => {
                let mut placed = Vec::with_capacity(parts.len());
                for (pose, shape) in parts {
                    placed.push(shape.unit_properties()?.transformed(pose));
                }
                MassProperties::combined(&placed)
            }
            Self::HalfSpace { .. } => Err(GeometryError::new(
                Unsupported,
                "a half-space has no mass, because it has no end: make the body static, or use a large box",
            )),
        }
    }
}

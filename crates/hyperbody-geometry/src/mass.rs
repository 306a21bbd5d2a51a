//! Volume, centre and second moments of bodies, and the principal frame that makes inertia `N` numbers.

use hyperbody_math::{Matrix, Pose, Vector};

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
    /// These properties with the body placed at `outer_from_body` inside an outer frame.
    #[must_use]
    pub fn transformed(&self, outer_from_body: &Pose<N>) -> Self {
        let r = outer_from_body.rotation.matrix();
        Self {
            mass: self.mass,
            centre: outer_from_body.transform_point(self.centre),
            second_moments: *r * self.second_moments * r.transpose(),
        }
    }

    /// These properties with every density multiplied by `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { mass: self.mass * factor, centre: self.centre, second_moments: self.second_moments * factor }
    }
}

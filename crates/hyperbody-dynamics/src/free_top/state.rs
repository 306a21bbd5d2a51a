//! The state of a free body: attitude and angular momentum.
//!
//! Orientation of planes. In this library a positive spin in plane (i, j) turns axis i towards axis j, and with B the
//! matrix of the spin (B_ij its number for plane (i, j)) a point of the body moves with r·B, that is Bᵀr. Texts on the
//! n-dimensional top write Ṙ = RΩ, M = JΩ + ΩJ, Ṁ = [M, Ω] with Ω acting on columns. Hence **Ω = Bᵀ = −B**, and Ω and −B
//! exchange the signs of quadratic right-hand sides: Ω̇_ij = r_ij (Ω²)_ij reads dω_ij/dt = r_ij Σ_k ω_ik ω_jk here, the
//! equations that give I₁ω̇₁ = (I₂ − I₃)ω₂ω₃ in 3D.
//!
//! The momentum is kept in the body frame beside the attitude, not derived from a fixed world-frame momentum: that R M Rᵀ
//! stays put is then a property of the method that can be measured.

use hyperbody_math::{Bivector, Dim, EvenAlgebra, Rotation, Rotor};

use super::error::{FreeTopError, FreeTopErrorKind, Result, shown};
use super::top::FreeTop;

/// Attitude and momentum of a free body. Body axes are principal axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TopState<const N: usize> {
    /// The attitude.
    pub world_from_body: Rotation<N>,
    /// Angular momentum in the body frame, in kg·m²/s.
    pub momentum_in_body: Bivector<N>,
}

impl<const N: usize> TopState<N> {
    /// The state with the given attitude and spin in the body frame, in rad/s.
    ///
    /// # Errors
    /// If the spin or the momentum that belongs to it is not finite.
    pub fn from_spin(top: &FreeTop<N>, world_from_body: Rotation<N>, spin_in_body: &Bivector<N>) -> Result<Self> {
        let momentum_in_body = top.momentum_from_spin(spin_in_body);
        // The square is what every integral is made of.
        if !(spin_in_body.is_finite() && momentum_in_body.norm_sq().is_finite()) {
            return Err(FreeTopError::new(
                FreeTopErrorKind::Spin,
                format!(
                    "a spin of {} rad/s in its fastest plane has no finite angular momentum and energy with these moments; \
                     give a finite one, and a slower one",
                    shown(spin_in_body.planes().map(f64::abs).fold(0.0, f64::max))
                ),
            ));
        }
        Ok(Self { world_from_body, momentum_in_body })
    }

    /// The spin in the body frame, in rad/s.
    #[must_use]
    pub fn spin_in_body(&self, top: &FreeTop<N>) -> Bivector<N> {
        top.spin_from_momentum(&self.momentum_in_body)
    }

    /// The angular momentum in the world frame, R M Rᵀ, in kg·m²/s: constant in exact motion.
    #[must_use]
    pub fn momentum_in_world(&self) -> Bivector<N> {
        self.world_from_body.rotate_bivector(&self.momentum_in_body)
    }

    /// The attitude as a rotor; of the two the one whose scalar part is not negative.
    #[must_use]
    pub fn world_from_body_rotor(&self) -> Rotor<N>
    where
        Dim<N>: EvenAlgebra,
    {
        Rotor::from_rotation(&self.world_from_body)
    }

    /// The state with the given attitude as a rotor and momentum in the body frame, in kg·m²/s.
    #[must_use]
    pub fn from_rotor_and_momentum(world_from_body: &Rotor<N>, momentum_in_body: Bivector<N>) -> Self
    where
        Dim<N>: EvenAlgebra,
    {
        Self { world_from_body: world_from_body.to_rotation(), momentum_in_body }
    }

    /// Largest entry of the difference of two states: attitudes as matrices, momenta relative to the larger one.
    #[must_use]
    pub fn distance(&self, other: &Self) -> f64 {
        let scale = self.momentum_in_body.norm().max(other.momentum_in_body.norm());
        let momentum = (self.momentum_in_body - other.momentum_in_body).norm();
        let relative = if scale > 0.0 { momentum / scale } else { 0.0 };
        relative.max((*self.world_from_body.matrix() - *other.world_from_body.matrix()).max_abs())
    }
}

//! What makes an even multivector a rotor, and how one that is nearly so becomes one.
//!
//! R R~ is its own reverse, so it is a scalar α plus a 4-vector B.
//!
//! - Up to 5D, B² is a number β² ≥ 0, and with P± = ½(1 ± B/β), where P±² = P± and P₊P₋ = 0, R R~ = (α+β) P₊ + (α−β) P₋.
//!   So R falls into two independent parts P±R with squared lengths α ± β, and dividing each by its own length gives
//!   R' = (P₊/√(α+β) + P₋/√(α−β)) R with R' R'~ = 1 exactly. In 4D B is a multiple of e1234 and the two parts are the two
//!   quaternions of ½(1 ± e1234) R. In 2D and 3D B is zero and the formula divides by the length.
//! - In 6D B² is no number, and R R~ = 1 does not suffice: cos φ + sin φ e123456 has it and turns vectors into 5-vectors.
//!   There the vector parts of R e_k R~ give a matrix, and the rotation nearest to it the rotor.

use super::{Blades, Coefficients, Dim, EvenAlgebra, Rotor, RotorError, multiply, reverse, times_mirrored_reverse};
use crate::{Vector, polar};

/// Smallest squared length of one of the two parts, relative to the mean of both, that still counts as a direction rather
/// than as rounding.
const SMALLEST_PART: f64 = 1e-12;

impl<const N: usize> Rotor<N>
where
    Dim<N>: EvenAlgebra,
{
    /// Largest [`Rotor::defect`] that [`Rotor::from_coefficients`] accepts: numbers typed by hand with seven digits pass.
    pub const TOLERANCE: f64 = 1e-6;

    /// The rotor with the given coefficients, in the order of [`Rotor::coefficients`], cleaned of rounding.
    ///
    /// # Errors
    /// If there are not exactly 2^(N−1) of them, one is not finite, or they are not a unit versor: their
    /// [`Rotor::defect`] exceeds [`Rotor::TOLERANCE`].
    pub fn from_coefficients(coefficients: &[f64]) -> Result<Self, RotorError> {
        let candidate = Self::checked(coefficients)?;
        let defect = candidate.defect();
        if defect <= Self::TOLERANCE {
            return candidate.nearest_versor().ok_or_else(|| RotorError::no_nearest(N));
        }
        // NaN, from overflow, too.
        Err(RotorError::not_a_versor(N, candidate.norm(), defect, Self::TOLERANCE))
    }

    /// The rotor nearest to an even multivector that may be far from valid, given by its coefficients in the order of
    /// [`Rotor::coefficients`]. The length does not matter.
    ///
    /// # Errors
    /// If there are not exactly 2^(N−1) coefficients, one is not finite, or no rotor is nearest: all are zero, or, from
    /// 4D up, one of the parts that have to be normalised separately is.
    pub fn nearest(coefficients: &[f64]) -> Result<Self, RotorError> {
        let candidate = Self::checked(coefficients)?;
        let largest = coefficients.iter().fold(0.0, |largest, c| f64::max(largest, c.abs()));
        if largest == 0.0 {
            return Err(RotorError::no_nearest(N));
        }
        let mut scaled = candidate;
        for c in scaled.coefficients.as_mut() {
            *c /= largest;
        }
        scaled.nearest_versor().ok_or_else(|| RotorError::no_nearest(N))
    }

    /// This rotor with the rounding of past products removed: all its conditions hold again to rounding, not only the
    /// length.
    #[must_use]
    pub fn repair(&self) -> Self {
        self.nearest_versor().unwrap_or(*self)
    }

    /// How far this is from a unit versor: the largest coefficient of R R~ − 1, and of the parts of R e_k R~ that are not
    /// vectors. Of the order of 1e-16 for every rotor made here and growing by about as much with each product.
    #[must_use]
    pub fn defect(&self) -> f64 {
        let all = 0..Self::COUNT;
        let mut square = multiply::<N>(&self.coefficients, all.clone(), &reverse::<N>(&self.coefficients), all.clone());
        square.as_mut()[0] -= 1.0;
        let mut worst = largest_of(square.as_ref());
        for k in 0..N {
            let right = times_mirrored_reverse::<N>(&self.coefficients, Vector::unit(k));
            // R e_k R~ e_0: a vector times e_0 has slots 0..N only.
            let turned = multiply::<N>(&self.coefficients, all.clone(), &right, all.clone());
            worst = largest_of(&[worst, largest_of(&turned.as_ref()[N..])]);
        }
        worst
    }

    fn checked(coefficients: &[f64]) -> Result<Self, RotorError> {
        if coefficients.len() != Self::COUNT {
            return Err(RotorError::wrong_count(N, coefficients.len(), Self::COUNT));
        }
        if let Some(slot) = coefficients.iter().position(|c| !c.is_finite()) {
            return Err(RotorError::not_finite(slot, coefficients[slot]));
        }
        let mut own = <Dim<N> as EvenAlgebra>::ZERO;
        own.as_mut().copy_from_slice(coefficients);
        Ok(Self { coefficients: own })
    }

    fn nearest_versor(&self) -> Option<Self> {
        if N < 6 {
            // The second pass removes what cancellation in α − β leaves of a large defect.
            return self.with_unit_parts()?.with_unit_parts();
        }
        let rotation = polar::nearest_rotation(&self.vector_matrix())?;
        Some(Self::from_rotation(&rotation).aligned_with(self))
    }

    /// Up to 5D: both parts P±R divided by their lengths.
    fn with_unit_parts(&self) -> Option<Self> {
        let all = 0..Self::COUNT;
        let square = multiply::<N>(&self.coefficients, all.clone(), &reverse::<N>(&self.coefficients), all.clone());
        let alpha = square.as_ref()[0];
        let four_vector = || (0..Self::COUNT).filter(|&slot| Blades::<N>::grade(slot) == 4);
        let beta = four_vector().map(|slot| square.as_ref()[slot] * square.as_ref()[slot]).sum::<f64>().sqrt();
        let (plus, minus) = (alpha + beta, alpha - beta);
        // NaN compares false.
        if !(minus > SMALLEST_PART * alpha && plus.is_finite()) {
            return None;
        }
        let (plus, minus) = (1.0 / plus.sqrt(), 1.0 / minus.sqrt());
        let mut factor = <Dim<N> as EvenAlgebra>::ZERO;
        factor.as_mut()[0] = 0.5 * (plus + minus);
        if beta > 0.0 {
            let along = 0.5 * (plus - minus) / beta;
            for slot in four_vector() {
                factor.as_mut()[slot] = along * square.as_ref()[slot];
            }
        }
        let coefficients: Coefficients<N> = multiply::<N>(&factor, all.clone(), &self.coefficients, all);
        Some(Self { coefficients })
    }
}

/// Largest absolute value; NaN if one is.
fn largest_of(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, c| if c.is_nan() || c.abs() > largest { c.abs() } else { largest })
}

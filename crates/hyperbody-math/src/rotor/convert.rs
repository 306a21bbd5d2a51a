//! Rotors from rotation matrices and back.

use super::{Dim, EvenAlgebra, Rotor, sandwich_vector};
use crate::{Matrix, Rotation, Vector};

impl<const N: usize> Rotor<N>
where
    Dim<N>: EvenAlgebra,
{
    /// The rotor of a rotation, good to rounding for every rotation, turns by π in any number of planes included.
    ///
    /// Of the two rotors of a rotation it is the one whose scalar part is not negative. A series of rotations that passes
    /// a turn by π therefore jumps in sign there; [`Rotor::aligned_with`] the one before undoes that. At a turn by exactly
    /// π the scalar part is zero and rounding decides, the same way every time.
    ///
    /// The matrix is taken apart into turns in coordinate planes (W. Givens, 1958), whose rotors multiply. Formulas that
    /// divide by 1 + trace, known from quaternions, break down at π and have no counterpart in six dimensions.
    #[must_use]
    pub fn from_rotation(rotation: &Rotation<N>) -> Self {
        let mut m = *rotation.matrix();
        let mut rotor = Self::IDENTITY;
        for k in 0..N {
            for j in k + 1..N {
                let radius = (m[k][k] * m[k][k] + m[j][k] * m[j][k]).sqrt();
                // Nothing to turn; also both zero, where a later j brings the column's length.
                if radius == 0.0 || (m[j][k] == 0.0 && m[k][k] > 0.0) {
                    continue;
                }
                let (cos, sin) = (m[k][k] / radius, m[j][k] / radius);
                let (half_cos, half_sin) = half_angle(cos, sin);
                rotor = rotor * Self::from_plane_half_angle(k, j, half_cos, half_sin);
                let (row_k, row_j) = (m.row(k), m.row(j));
                m.0[k] = (row_k * cos + row_j * sin).0;
                m.0[j] = (row_j * cos - row_k * sin).0;
            }
        }
        if rotor.scalar_part() < 0.0 { -rotor } else { rotor }
    }

    /// The matrix of this rotation; its columns are the turned unit vectors.
    #[must_use]
    pub fn to_rotation(&self) -> Rotation<N> {
        let mut rotation = Rotation::from_matrix_unchecked(self.vector_matrix());
        rotation.reorthonormalize();
        rotation
    }

    /// The matrix with the vector parts of R e_k R~ as columns; orthogonal exactly as far as the rotor is valid.
    pub(super) fn vector_matrix(&self) -> Matrix<N> {
        Matrix::from_columns(std::array::from_fn(|k| sandwich_vector(&self.coefficients, Vector::unit(k))))
    }
}

/// Cosine and sine of half the angle in (−π, π] with the given cosine and sine, without cancellation.
fn half_angle(cos: f64, sin: f64) -> (f64, f64) {
    if cos >= 0.0 {
        let half_cos = (0.5 + 0.5 * cos).sqrt();
        (half_cos, 0.5 * sin / half_cos)
    } else {
        let half_sin = (0.5 - 0.5 * cos).sqrt();
        (0.5 * sin.abs() / half_sin, if sin < 0.0 { -half_sin } else { half_sin })
    }
}

impl<const N: usize> From<Rotation<N>> for Rotor<N>
where
    Dim<N>: EvenAlgebra,
{
    fn from(rotation: Rotation<N>) -> Self {
        Self::from_rotation(&rotation)
    }
}

impl<const N: usize> From<Rotor<N>> for Rotation<N>
where
    Dim<N>: EvenAlgebra,
{
    fn from(rotor: Rotor<N>) -> Self {
        rotor.to_rotation()
    }
}

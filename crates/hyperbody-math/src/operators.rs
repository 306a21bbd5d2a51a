//! The products of vectors, bivectors and rotations as matrices on packed planes (M. ten Bosch, 2020, §4).
//!
//! A bivector becomes a column of K = N(N−1)/2 numbers, one per plane in lexicographic order. Then
//!
//! | matrix | size | is |
//! |---|---|---|
//! | \[r\]⋆ | K×N | r ∧ a = \[r\]⋆ a and r · ω = \[r\]⋆ᵀ ω |
//! | \[R\]₂ | K×K | turns bivectors: R B R~ = \[R\]₂ B |
//! | I | K×K | inertia: L = I ω; turned with its body, I′ = \[R\]₂ I \[R\]₂ᵀ |
//!
//! These are for teaching, for checking and for tools that want a matrix. The simulation never forms them: inertia is N
//! numbers in the principal frame, and [`Bivector`] does the products in place.
//!
//! K depends on N, and stable Rust has no arrays of such a length. The entries are in a `Vec`, so that no bound enters any
//! signature and two dimensions do not carry the 15×15 numbers of six; the typed wrappers make sizes agree by construction.

use std::ops::{Add, Mul};

use crate::{Bivector, Matrix, Rotation, Vector, planes};

/// \[r\]⋆, the K×N matrix of the outer product with a fixed vector.
#[derive(Clone, Debug, PartialEq)]
pub struct WedgeOperator<const N: usize> {
    /// One row per plane.
    rows: Vec<Vector<N>>,
}

impl<const N: usize> WedgeOperator<N> {
    /// \[r\]⋆: row (i, j) has r_i in column j and −r_j in column i.
    #[must_use]
    pub fn new(r: Vector<N>) -> Self {
        let row = |(i, j)| Vector::unit(j) * r[i] - Vector::unit(i) * r[j];
        Self { rows: planes::all(N).map(row).collect() }
    }

    /// The rows in order of planes.
    #[must_use]
    pub fn rows(&self) -> &[Vector<N>] {
        &self.rows
    }

    /// \[r\]⋆ a = r ∧ a: the angular momentum of an impulse a at offset r.
    #[must_use]
    pub fn apply(&self, a: Vector<N>) -> Bivector<N> {
        let mut result = Bivector::ZERO;
        for ((i, j), row) in planes::all(N).zip(&self.rows) {
            result.set(i, j, row.dot(a));
        }
        result
    }

    /// \[r\]⋆ᵀ ω = r · ω: the velocity at offset r of a body with angular velocity ω.
    #[must_use]
    pub fn transpose_apply(&self, omega: &Bivector<N>) -> Vector<N> {
        omega.planes().zip(&self.rows).fold(Vector::ZERO, |sum, (value, row)| sum + *row * value)
    }

    /// \[r\]⋆ᵀ A \[r\]⋆. With A the inverse inertia this is the change of the velocity at offset r per impulse there, short
    /// of the part 1/m.
    #[must_use]
    pub fn sandwich(&self, a: &BivectorOperator<N>) -> Matrix<N> {
        let columns = std::array::from_fn(|k| self.transpose_apply(&a.apply(&self.apply(Vector::unit(k)))));
        Matrix::from_columns(columns)
    }
}

/// A K×K matrix that maps bivectors to bivectors, such as inertia or a rotation.
#[derive(Clone, Debug, PartialEq)]
pub struct BivectorOperator<const N: usize> {
    /// By rows; rows and columns in order of planes.
    entries: Vec<f64>,
}

impl<const N: usize> BivectorOperator<N> {
    /// Number of rows and of columns: K = N(N−1)/2.
    pub const SIZE: usize = planes::count(N);

    /// The operator with the given entry for each (row plane, column plane), both as axes (i, j), i < j.
    #[must_use]
    pub fn from_fn(mut entry: impl FnMut((usize, usize), (usize, usize)) -> f64) -> Self {
        let mut entries = Vec::with_capacity(Self::SIZE * Self::SIZE);
        for row in planes::all(N) {
            entries.extend(planes::all(N).map(|column| entry(row, column)));
        }
        Self { entries }
    }

    /// The operator that multiplies plane (i, j) by `factor(i, j)`: with J_i + J_j the inertia about principal axes, with its
    /// reciprocal the inverse inertia.
    #[must_use]
    pub fn diagonal(mut factor: impl FnMut(usize, usize) -> f64) -> Self {
        Self::from_fn(|row, column| if row == column { factor(row.0, row.1) } else { 0.0 })
    }

    /// \[R\]₂, which turns bivectors: entry (ij, kl) is the minor R_ik R_jl − R_il R_jk of the rotation matrix.
    #[must_use]
    pub fn turning(rotation: &Rotation<N>) -> Self {
        let r = rotation.matrix();
        Self::from_fn(|(i, j), (k, l)| r[i][k] * r[j][l] - r[i][l] * r[j][k])
    }

    /// The inertia L = PΩ + ΩP of a body with second moments P_ij = ∫ρ x_i x_j dV about its centre of mass, in kg·m²; P
    /// must be symmetric.
    #[must_use]
    pub fn inertia(second_moments: &Matrix<N>) -> Self {
        let p = |i: usize, j: usize| second_moments[i][j];
        let delta = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        // Ω = E_kl − E_lk.
        Self::from_fn(|(i, j), (k, l)| {
            p(i, k) * delta(l, j) - p(i, l) * delta(k, j) + delta(i, k) * p(l, j) - delta(i, l) * p(k, j)
        })
    }

    /// The entry of a row and a column, both numbers of planes below [`BivectorOperator::SIZE`].
    ///
    /// # Panics
    /// If either is not below that.
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        self.row(row)[column]
    }

    /// The rows in order of planes.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.entries.chunks_exact(Self::SIZE)
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.entries[row * Self::SIZE..(row + 1) * Self::SIZE]
    }

    /// The image of a bivector.
    #[must_use]
    pub fn apply(&self, b: &Bivector<N>) -> Bivector<N> {
        let mut result = Bivector::ZERO;
        for ((i, j), row) in planes::all(N).zip(self.rows()) {
            result.set(i, j, row.iter().zip(b.planes()).fold(0.0, |sum, (entry, value)| sum + entry * value));
        }
        result
    }

    /// The transpose.
    #[must_use]
    pub fn transpose(&self) -> Self {
        Self::from_entries(|row, column| self.entry(column, row))
    }

    /// \[R\]₂ A \[R\]₂ᵀ: the inertia I′ in the world of a body with inertia `self` in its own frame, turned by `rotation`.
    #[must_use]
    pub fn turned_by(&self, rotation: &Rotation<N>) -> Self {
        let turning = Self::turning(rotation);
        &(&turning * self) * &turning.transpose()
    }

    /// Largest absolute entry.
    #[must_use]
    pub fn max_abs(&self) -> f64 {
        self.entries.iter().fold(0.0, |largest, c| if c.is_nan() || c.abs() > largest { c.abs() } else { largest })
    }

    fn from_entries(mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        let cells = (0..Self::SIZE * Self::SIZE).map(|cell| entry(cell / Self::SIZE, cell % Self::SIZE));
        Self { entries: cells.collect() }
    }
}

impl<const N: usize> Mul for &BivectorOperator<N> {
    type Output = BivectorOperator<N>;
    /// The matrix product: `other` first, then `self`.
    fn mul(self, other: Self) -> BivectorOperator<N> {
        BivectorOperator::from_entries(|row, column| {
            (0..BivectorOperator::<N>::SIZE).fold(0.0, |sum, k| sum + self.entry(row, k) * other.entry(k, column))
        })
    }
}

impl<const N: usize> Mul<f64> for &BivectorOperator<N> {
    type Output = BivectorOperator<N>;
    fn mul(self, factor: f64) -> BivectorOperator<N> {
        BivectorOperator { entries: self.entries.iter().map(|entry| entry * factor).collect() }
    }
}

impl<const N: usize> Add for &BivectorOperator<N> {
    type Output = BivectorOperator<N>;
    fn add(self, other: Self) -> BivectorOperator<N> {
        BivectorOperator { entries: self.entries.iter().zip(&other.entries).map(|(a, b)| a + b).collect() }
    }
}

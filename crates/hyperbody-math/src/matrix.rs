//! Square `N`×`N` matrices, stored by rows.

use std::array;
use std::ops::{Add, AddAssign, Index, IndexMut, Mul, Neg, Sub};

use crate::Vector;

/// A square matrix; `m[row][column]`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Matrix<const N: usize>(pub [[f64; N]; N]);

impl<const N: usize> Matrix<N> {
    /// The zero matrix.
    pub const ZERO: Self = Self([[0.0; N]; N]);

    /// The identity.
    pub const IDENTITY: Self = {
        let mut m = [[0.0; N]; N];
        let mut i = 0;
        while i < N {
            m[i][i] = 1.0;
            i += 1;
        }
        Self(m)
    };

    /// The matrix with entry (row, column) equal to `f(row, column)`.
    #[must_use]
    pub fn from_fn(mut f: impl FnMut(usize, usize) -> f64) -> Self {
        Self(array::from_fn(|i| array::from_fn(|j| f(i, j))))
    }

    /// The diagonal matrix with the given entries.
    #[must_use]
    pub fn from_diagonal(diagonal: Vector<N>) -> Self {
        Self::from_fn(|i, j| if i == j { diagonal[i] } else { 0.0 })
    }

    /// The matrix whose columns are the given vectors.
    #[must_use]
    pub fn from_columns(columns: [Vector<N>; N]) -> Self {
        Self::from_fn(|i, j| columns[j][i])
    }

    /// The matrix a bᵀ.
    #[must_use]
    pub fn outer(a: Vector<N>, b: Vector<N>) -> Self {
        Self::from_fn(|i, j| a[i] * b[j])
    }

    /// Row `i`.
    #[inline]
    #[must_use]
    pub fn row(&self, i: usize) -> Vector<N> {
        Vector(self.0[i])
    }

    /// Column `j`.
    #[inline]
    #[must_use]
    pub fn column(&self, j: usize) -> Vector<N> {
        Vector::from_fn(|i| self.0[i][j])
    }

    /// The diagonal entries.
    #[must_use]
    pub fn diagonal(&self) -> Vector<N> {
        Vector::from_fn(|i| self.0[i][i])
    }

    /// Sum of the diagonal entries.
    #[must_use]
    pub fn trace(&self) -> f64 {
        self.diagonal().iter().sum()
    }

    /// The transpose.
    #[inline]
    #[must_use]
    pub fn transpose(&self) -> Self {
        Self::from_fn(|i, j| self.0[j][i])
    }

    /// Mᵀ v, without forming the transpose.
    #[inline]
    #[must_use]
    pub fn transpose_mul(&self, v: Vector<N>) -> Vector<N> {
        let mut result = Vector::ZERO;
        for i in 0..N {
            for j in 0..N {
                result.0[j] += self.0[i][j] * v.0[i];
            }
        }
        result
    }

    /// Largest absolute entry.
    #[must_use]
    pub fn max_abs(&self) -> f64 {
        self.0.iter().fold(0.0, |largest, row| f64::max(largest, Vector(*row).max_abs()))
    }

    /// Whether every entry is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        // All of them, at once, instead of one after the other up to the first that is not.
        self.0.as_flattened().iter().fold(true, |all, entry| all & entry.is_finite())
    }

    /// The determinant, by elimination with partial pivoting.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        let mut m = self.0;
        let mut determinant = 1.0;
        for k in 0..N {
            let pivot = pivot_row(&m, k);
            if pivot != k {
                m.swap(pivot, k);
                determinant = -determinant;
            }
            determinant *= m[k][k];
            if m[k][k] == 0.0 {
                return 0.0;
            }
            for i in k + 1..N {
                let factor = m[i][k] / m[k][k];
                for j in k + 1..N {
                    m[i][j] -= factor * m[k][j];
                }
            }
        }
        determinant
    }

    /// The solution x of M x = b by elimination with partial pivoting, or `None` if a pivot is exactly zero or the
    /// result is not finite.
    #[must_use]
    pub fn solve(&self, b: Vector<N>) -> Option<Vector<N>> {
        let mut m = self.0;
        let mut x = b.0;
        for k in 0..N {
            let pivot = pivot_row(&m, k);
            m.swap(pivot, k);
            x.swap(pivot, k);
            if m[k][k] == 0.0 {
                return None;
            }
            for i in k + 1..N {
                let factor = m[i][k] / m[k][k];
                for j in k + 1..N {
                    m[i][j] -= factor * m[k][j];
                }
                x[i] -= factor * x[k];
            }
        }
        for k in (0..N).rev() {
            for j in k + 1..N {
                x[k] -= m[k][j] * x[j];
            }
            x[k] /= m[k][k];
        }
        let x = Vector(x);
        x.is_finite().then_some(x)
    }

    /// The inverse, or `None` if the matrix is singular to working precision (see [`Matrix::solve`]).
    #[must_use]
    pub fn try_inverse(&self) -> Option<Self> {
        let mut columns = [Vector::ZERO; N];
        for (axis, column) in columns.iter_mut().enumerate() {
            *column = self.solve(Vector::unit(axis))?;
        }
        Some(Self::from_columns(columns))
    }
}

fn pivot_row<const N: usize>(m: &[[f64; N]; N], k: usize) -> usize {
    let mut best = k;
    for i in k + 1..N {
        if m[i][k].abs() > m[best][k].abs() {
            best = i;
        }
    }
    best
}

impl<const N: usize> Default for Matrix<N> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const N: usize> Index<usize> for Matrix<N> {
    type Output = [f64; N];
    #[inline]
    fn index(&self, row: usize) -> &[f64; N] {
        &self.0[row]
    }
}

impl<const N: usize> IndexMut<usize> for Matrix<N> {
    #[inline]
    fn index_mut(&mut self, row: usize) -> &mut [f64; N] {
        &mut self.0[row]
    }
}

impl<const N: usize> Mul for Matrix<N> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let mut result = Self::ZERO;
        for i in 0..N {
            for k in 0..N {
                let factor = self.0[i][k];
                for j in 0..N {
                    result.0[i][j] += factor * other.0[k][j];
                }
            }
        }
        result
    }
}

impl<const N: usize> Mul<Vector<N>> for Matrix<N> {
    type Output = Vector<N>;
    #[inline]
    fn mul(self, v: Vector<N>) -> Vector<N> {
        Vector::from_fn(|i| self.row(i).dot(v))
    }
}

impl<const N: usize> Mul<f64> for Matrix<N> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|row| row.map(|entry| entry * factor)))
    }
}

impl<const N: usize> Add for Matrix<N> {
    type Output = Self;
    #[inline]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl<const N: usize> AddAssign for Matrix<N> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        for i in 0..N {
            for j in 0..N {
                self.0[i][j] += other.0[i][j];
            }
        }
    }
}

impl<const N: usize> Sub for Matrix<N> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const N: usize> Neg for Matrix<N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(self.0.map(|row| row.map(|entry| -entry)))
    }
}

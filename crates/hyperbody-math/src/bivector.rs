//! Oriented planes: angular velocities, angular momenta, torques.
//!
//! A bivector has one number per coordinate plane. It is kept as the antisymmetric matrix B with B_ij the number of
//! plane (i, j): n² numbers instead of n(n−1)/2, but the type needs no bound in any signature and products are plain
//! matrix loops (measured equal in speed to packed forms outside the solver, which packs its own rows).
//!
//! What does not generalise from 3D: there is no axis and no cross product. A plane takes the place of the axis, the
//! wedge that of the cross product r × j, and "ω × r" becomes the plane acting on the vector.

use std::ops::{Add, AddAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::{Givens, InvariantPlanes, Matrix, Vector, planes};

/// A sum of oriented planes; component (i, j) = −component (j, i).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bivector<const N: usize> {
    /// Antisymmetric.
    m: [[f64; N]; N],
}

impl<const N: usize> Bivector<N> {
    /// The zero bivector.
    pub const ZERO: Self = Self { m: [[0.0; N]; N] };

    /// `value` times the plane from axis i to axis j, i ≠ j; (j, i) is the opposite sense.
    ///
    /// # Panics
    /// If i = j or an axis is not below `N`.
    #[must_use]
    pub fn plane(i: usize, j: usize, value: f64) -> Self {
        let mut b = Self::ZERO;
        b.set(i, j, value);
        b
    }

    /// The bivector with number `f(i, j)` in plane (i, j), asked for i < j only.
    #[inline]
    #[must_use]
    pub fn from_fn(mut f: impl FnMut(usize, usize) -> f64) -> Self {
        let mut b = Self::ZERO;
        for i in 0..N {
            for j in i + 1..N {
                b.m[i][j] = f(i, j);
                b.m[j][i] = -b.m[i][j];
            }
        }
        b
    }

    /// The bivector with the given numbers for the planes in lexicographic order, or `None` if there are not exactly
    /// `N(N−1)/2` of them.
    #[must_use]
    pub fn from_planes(values: &[f64]) -> Option<Self> {
        if values.len() != planes::count(N) {
            return None;
        }
        let mut b = Self::ZERO;
        for ((i, j), &value) in planes::all(N).zip(values) {
            b.set(i, j, value);
        }
        Some(b)
    }

    /// The antisymmetric part ½(M − Mᵀ) of a matrix as a bivector.
    #[must_use]
    pub fn from_antisymmetric_part(m: &Matrix<N>) -> Self {
        let mut b = Self::ZERO;
        for i in 0..N {
            for j in i + 1..N {
                b.m[i][j] = 0.5 * (m[i][j] - m[j][i]);
                b.m[j][i] = -b.m[i][j];
            }
        }
        b
    }

    /// The number of plane (i, j); (j, i) gives its opposite.
    #[inline]
    #[must_use]
    pub fn get(&self, i: usize, j: usize) -> f64 {
        self.m[i][j]
    }

    /// Sets the number of plane (i, j), and so that of (j, i) to its opposite.
    ///
    /// # Panics
    /// If i = j or an axis is not below `N`.
    #[inline]
    pub fn set(&mut self, i: usize, j: usize, value: f64) {
        assert!(i != j, "a plane needs two different axes, got ({i}, {j})");
        self.m[i][j] = value;
        self.m[j][i] = -value;
    }

    /// The numbers of all planes in lexicographic order.
    pub fn planes(&self) -> impl Iterator<Item = f64> + '_ {
        planes::all(N).map(|(i, j)| self.m[i][j])
    }

    /// The antisymmetric matrix B with B_ij the number of plane (i, j).
    #[inline]
    #[must_use]
    pub fn to_matrix(&self) -> Matrix<N> {
        Matrix(self.m)
    }

    /// The outer product a ∧ b: the oriented parallelogram of two vectors. Torque is r ∧ force, angular momentum is
    /// r ∧ momentum.
    #[inline]
    #[must_use]
    pub fn wedge(a: Vector<N>, b: Vector<N>) -> Self {
        let mut result = Self::ZERO;
        for i in 0..N {
            for j in 0..N {
                result.m[i][j] = a.0[i] * b.0[j] - a.0[j] * b.0[i];
            }
        }
        result
    }

    /// The contraction r · B: what the plane makes of a vector. With an angular velocity in rad/s and an offset in
    /// metres this is the velocity of the point at that offset, in m/s.
    #[inline]
    #[must_use]
    pub fn act_on(&self, r: Vector<N>) -> Vector<N> {
        let mut result = Vector::ZERO;
        for i in 0..N {
            for j in 0..N {
                result.0[j] += self.m[i][j] * r.0[i];
            }
        }
        result
    }

    /// The commutator product A × B = ½(AB − BA) of the geometric algebra, again a bivector; its matrix is AB − BA.
    ///
    /// A bivector `b` fixed to a body of angular velocity `w` changes at the rate `b.commutator(&w)`, as a fixed vector
    /// `r` moves at `w.act_on(r)`. Euler's equation in the body frame is I(ω̇) = ω × I(ω) + τ.
    #[must_use]
    pub fn commutator(&self, other: &Self) -> Self {
        let (a, b) = (self.to_matrix(), other.to_matrix());
        Self { m: (a * b - b * a).0 }
    }

    /// Inner product: the sum over planes of the products of the numbers.
    #[inline]
    #[must_use]
    pub fn dot(&self, other: &Self) -> f64 {
        let mut sum = 0.0;
        for i in 0..N {
            for j in i + 1..N {
                sum += self.m[i][j] * other.m[i][j];
            }
        }
        sum
    }

    /// Sum over planes of the squares.
    #[inline]
    #[must_use]
    pub fn norm_sq(&self) -> f64 {
        self.dot(self)
    }

    /// Root of the sum over planes of the squares.
    #[inline]
    #[must_use]
    pub fn norm(&self) -> f64 {
        self.norm_sq().sqrt()
    }

    /// Component-wise product: plane (i, j) times `factor(i, j)`, asked for i < j only.
    #[must_use]
    pub fn scale_planes(&self, mut factor: impl FnMut(usize, usize) -> f64) -> Self {
        let mut result = Self::ZERO;
        for i in 0..N {
            for j in i + 1..N {
                let value = self.m[i][j] * factor(i, j);
                result.m[i][j] = value;
                result.m[j][i] = -value;
            }
        }
        result
    }

    /// Rewrites the numbers of a bivector fixed in space for a frame that has been turned by `turn` in its plane from
    /// axis i to axis j: B ← Gᵀ B G.
    ///
    /// # Panics
    /// If an axis is not below `N`.
    #[inline]
    pub fn change_to_turned_frame(&mut self, i: usize, j: usize, turn: Givens) {
        for k in 0..N {
            if k != i && k != j {
                let (a, b) = turn.components_in_turned_axes(self.m[i][k], self.m[j][k]);
                (self.m[i][k], self.m[k][i]) = (a, -a);
                (self.m[j][k], self.m[k][j]) = (b, -b);
            }
        }
    }

    /// The orthogonal planes that this turns independently of each other, with their numbers in descending order: one
    /// for a simple bivector, two for a double rotation.
    #[must_use]
    pub fn invariant_planes(&self) -> InvariantPlanes<N> {
        InvariantPlanes::of_bivector(self)
    }

    /// Whether every number is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.to_matrix().is_finite()
    }
}

impl<const N: usize> Default for Bivector<N> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const N: usize> Add for Bivector<N> {
    type Output = Self;
    #[inline]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl<const N: usize> AddAssign for Bivector<N> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        for i in 0..N {
            for j in 0..N {
                self.m[i][j] += other.m[i][j];
            }
        }
    }
}

impl<const N: usize> Sub for Bivector<N> {
    type Output = Self;
    #[inline]
    fn sub(mut self, other: Self) -> Self {
        self -= other;
        self
    }
}

impl<const N: usize> SubAssign for Bivector<N> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        for i in 0..N {
            for j in 0..N {
                self.m[i][j] -= other.m[i][j];
            }
        }
    }
}

impl<const N: usize> Mul<f64> for Bivector<N> {
    type Output = Self;
    #[inline]
    fn mul(mut self, factor: f64) -> Self {
        self *= factor;
        self
    }
}

impl<const N: usize> MulAssign<f64> for Bivector<N> {
    #[inline]
    fn mul_assign(&mut self, factor: f64) {
        for row in &mut self.m {
            for entry in row {
                *entry *= factor;
            }
        }
    }
}

impl<const N: usize> Neg for Bivector<N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { m: self.m.map(|row| row.map(|entry| -entry)) }
    }
}

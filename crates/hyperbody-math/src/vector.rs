//! Points, directions and other N-tuples of real numbers.

use std::array;
use std::ops::{Add, AddAssign, Div, Index, IndexMut, Mul, MulAssign, Neg, Sub, SubAssign};

/// A point, direction, velocity, force or impulse in `N` dimensions.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Vector<const N: usize>(pub [f64; N]);

impl<const N: usize> Vector<N> {
    /// The zero vector.
    pub const ZERO: Self = Self([0.0; N]);

    /// The vector with every component equal to `value`.
    #[must_use]
    pub const fn splat(value: f64) -> Self {
        Self([value; N])
    }

    /// The unit vector of `axis`.
    ///
    /// # Panics
    /// If `axis >= N`.
    #[must_use]
    pub fn unit(axis: usize) -> Self {
        let mut v = Self::ZERO;
        v.0[axis] = 1.0;
        v
    }

    /// The vector with component `i` equal to `f(i)`.
    #[must_use]
    pub fn from_fn(f: impl FnMut(usize) -> f64) -> Self {
        Self(array::from_fn(f))
    }

    /// The components of `slice`, or `None` if there are not exactly `N` of them.
    #[must_use]
    pub fn from_slice(slice: &[f64]) -> Option<Self> {
        slice.try_into().ok().map(Self)
    }

    /// The components as a slice.
    #[must_use]
    pub fn as_slice(&self) -> &[f64] {
        &self.0
    }

    /// The components in order.
    pub fn iter(&self) -> impl Iterator<Item = f64> + '_ {
        self.0.iter().copied()
    }

    /// Inner product.
    #[inline]
    #[must_use]
    pub fn dot(self, other: Self) -> f64 {
        let mut sum = 0.0;
        for i in 0..N {
            sum += self.0[i] * other.0[i];
        }
        sum
    }

    /// Square of the length.
    #[inline]
    #[must_use]
    pub fn norm_sq(self) -> f64 {
        self.dot(self)
    }

    /// Length.
    #[inline]
    #[must_use]
    pub fn norm(self) -> f64 {
        self.norm_sq().sqrt()
    }

    /// Distance between two points.
    #[inline]
    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        (self - other).norm()
    }

    /// The unit vector of this direction, or `None` if the length is zero or not finite. Safe for any finite scale:
    /// the components are brought to the order of one first.
    #[must_use]
    pub fn try_normalize(self) -> Option<Self> {
        let scale = self.max_abs();
        if !(scale > 0.0 && scale.is_finite()) {
            return None;
        }
        let scaled = self / scale;
        Some(scaled / scaled.norm())
    }

    /// The unit vector of this direction, or zero if there is none.
    #[must_use]
    pub fn normalize_or_zero(self) -> Self {
        self.try_normalize().unwrap_or(Self::ZERO)
    }

    /// Largest absolute component.
    #[must_use]
    pub fn max_abs(self) -> f64 {
        self.0.iter().fold(0.0, |largest, c| if c.abs() > largest || c.is_nan() { c.abs() } else { largest })
    }

    /// Axis of the component that is largest in absolute value; the first of equals.
    #[must_use]
    pub fn axis_of_max_abs(self) -> usize {
        let mut best = 0;
        for i in 1..N {
            if self.0[i].abs() > self.0[best].abs() {
                best = i;
            }
        }
        best
    }

    /// Component-wise absolute value.
    #[inline]
    #[must_use]
    pub fn abs(self) -> Self {
        Self(self.0.map(f64::abs))
    }

    /// Component-wise minimum.
    #[inline]
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self::from_fn(|i| if other.0[i] < self.0[i] { other.0[i] } else { self.0[i] })
    }

    /// Component-wise maximum.
    #[inline]
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self::from_fn(|i| if other.0[i] > self.0[i] { other.0[i] } else { self.0[i] })
    }

    /// Component-wise product.
    #[inline]
    #[must_use]
    pub fn scale(self, factors: Self) -> Self {
        Self::from_fn(|i| self.0[i] * factors.0[i])
    }

    /// The point at parameter `t` on the line from `self` (t = 0) to `other` (t = 1).
    #[inline]
    #[must_use]
    pub fn lerp(self, other: Self, t: f64) -> Self {
        self + (other - self) * t
    }

    /// Whether every component is finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.0.iter().all(|c| c.is_finite())
    }

    /// `N − 1` unit vectors that complete the unit vector `self` to an orthonormal basis: the other columns of the
    /// Householder reflection that maps the axis of the largest component to ±`self` (A. S. Householder, 1958). The
    /// same input always gives the same basis, and nearby inputs nearby ones except where the largest component
    /// changes. Entries from `N − 1` on are zero.
    #[must_use]
    pub fn orthonormal_complement(self) -> [Self; N] {
        let k = self.axis_of_max_abs();
        let sign = if self.0[k] < 0.0 { -1.0 } else { 1.0 };
        // u = self + sign e_k is never short: |u|² = 2 + 2|self_k|. Chosen rather than indexed: numbers that are stored one by one
        // and loaded as vectors are waited for.
        let u = Self::from_fn(|i| if i == k { self.0[i] + sign } else { self.0[i] });
        let factor = 2.0 / u.norm_sq();
        let image = |axis: usize| Self::unit(axis) - u * (factor * u.0[axis]);
        let mut basis = [Self::ZERO; N];
        for slot in 0..N - 1 {
            basis[slot] = if slot < k { image(slot) } else { image(slot + 1) };
        }
        basis
    }
}

impl<const N: usize> Default for Vector<N> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const N: usize> From<[f64; N]> for Vector<N> {
    fn from(components: [f64; N]) -> Self {
        Self(components)
    }
}

impl<const N: usize> Index<usize> for Vector<N> {
    type Output = f64;
    #[inline]
    fn index(&self, axis: usize) -> &f64 {
        &self.0[axis]
    }
}

impl<const N: usize> IndexMut<usize> for Vector<N> {
    #[inline]
    fn index_mut(&mut self, axis: usize) -> &mut f64 {
        &mut self.0[axis]
    }
}

impl<const N: usize> Add for Vector<N> {
    type Output = Self;
    #[inline]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl<const N: usize> Sub for Vector<N> {
    type Output = Self;
    #[inline]
    fn sub(mut self, other: Self) -> Self {
        self -= other;
        self
    }
}

impl<const N: usize> Mul<f64> for Vector<N> {
    type Output = Self;
    #[inline]
    fn mul(mut self, factor: f64) -> Self {
        self *= factor;
        self
    }
}

impl<const N: usize> Mul<Vector<N>> for f64 {
    type Output = Vector<N>;
    #[inline]
    fn mul(self, vector: Vector<N>) -> Vector<N> {
        vector * self
    }
}

impl<const N: usize> Div<f64> for Vector<N> {
    type Output = Self;
    #[inline]
    fn div(self, divisor: f64) -> Self {
        Self(self.0.map(|c| c / divisor))
    }
}

impl<const N: usize> Neg for Vector<N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(self.0.map(|c| -c))
    }
}

impl<const N: usize> AddAssign for Vector<N> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        for i in 0..N {
            self.0[i] += other.0[i];
        }
    }
}

impl<const N: usize> SubAssign for Vector<N> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        for i in 0..N {
            self.0[i] -= other.0[i];
        }
    }
}

impl<const N: usize> MulAssign<f64> for Vector<N> {
    #[inline]
    fn mul_assign(&mut self, factor: f64) {
        for i in 0..N {
            self.0[i] *= factor;
        }
    }
}

//! Several contacts side by side: one number of each, worked on together.
//!
//! Plain arrays with plain loops: compiled for the widest vectors of the machine (see `Solver::arch`), they become
//! vector instructions, and lane by lane they are the same IEEE operations on every width, so the bits don't depend
//! on the machine. No fused multiply-add, for the same reason.

use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// The scalar of the solver's rows. Velocities enter the rows as *changes* since the start of the step and gaps as
/// distances of neighbouring surfaces: both small, so that seven digits of them are more than of the whole.
pub(crate) type Real = f32;

/// Contacts side by side: one 256-bit register of `Real`.
pub(crate) const WIDTH: usize = 8;

/// One number of each of `WIDTH` contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(crate) struct Lanes(pub(crate) [Real; WIDTH]);

impl Lanes {
    pub(crate) const ZERO: Self = Self([0.0; WIDTH]);

    #[inline(always)]
    pub(crate) const fn splat(value: Real) -> Self {
        Self([value; WIDTH])
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(Real, Real) -> Real) -> Self {
        let mut result = [0.0; WIDTH];
        for lane in 0..WIDTH {
            result[lane] = f(self.0[lane], other.0[lane]);
        }
        Self(result)
    }

    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.zip(self, |a, _| a.sqrt())
    }

    #[inline(always)]
    pub(crate) fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }

    /// Lane by lane: `positive` where `self` > 0, else `otherwise`.
    #[inline(always)]
    pub(crate) fn select_positive(self, positive: Self, otherwise: Self) -> Self {
        let mut result = [0.0; WIDTH];
        for lane in 0..WIDTH {
            result[lane] = if self.0[lane] > 0.0 { positive.0[lane] } else { otherwise.0[lane] };
        }
        Self(result)
    }
}

impl Add for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Lanes {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.zip(self, |a, _| -a)
    }
}

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Lanes {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

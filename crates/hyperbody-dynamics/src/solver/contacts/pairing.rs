//! The two bodies of each contact of a block, gathered from the solver's state into lanes, and put back.

use super::Block;
use super::layout::Layout;
use crate::solver::bodies::{MAX_PLANES, Sizes};
use crate::solver::lanes::{Lanes, Real, WIDTH};

/// Changes of velocity of both bodies of a block, one body a lane, and the header's numbers that every row needs.
pub(super) struct Pairing<const N: usize> {
    linear_a: [Lanes; N],
    linear_b: [Lanes; N],
    angular_a: [Lanes; MAX_PLANES],
    angular_b: [Lanes; MAX_PLANES],
    mass_a: Lanes,
    mass_b: Lanes,
}

impl<const N: usize> Pairing<N> {
    #[inline(always)]
    pub(super) fn gather(block: &Block, rows: &[Lanes], state: &[Real]) -> Self {
        Self::gather_at(block, rows, state, 0)
    }

    /// The displacements in place of the velocities.
    #[inline(always)]
    pub(super) fn gather_displacement(block: &Block, rows: &[Lanes], state: &[Real]) -> Self {
        Self::gather_at(block, rows, state, Sizes::<N>::VELOCITY)
    }

    #[inline(always)]
    fn gather_at(block: &Block, rows: &[Lanes], state: &[Real], part: usize) -> Self {
        let mut p = Self {
            linear_a: [Lanes::ZERO; N],
            linear_b: [Lanes::ZERO; N],
            angular_a: [Lanes::ZERO; MAX_PLANES],
            angular_b: [Lanes::ZERO; MAX_PLANES],
            mass_a: rows[Layout::<N>::INVERSE_SQRT_MASS_A],
            mass_b: rows[Layout::<N>::INVERSE_SQRT_MASS_B],
        };
        for lane in 0..WIDTH {
            let a = block.bodies_a[lane] as usize * Sizes::<N>::STATE + part;
            let b = block.bodies_b[lane] as usize * Sizes::<N>::STATE + part;
            let (a, b) = (&state[a..a + Sizes::<N>::VELOCITY], &state[b..b + Sizes::<N>::VELOCITY]);
            for i in 0..N {
                p.linear_a[i].0[lane] = a[i];
                p.linear_b[i].0[lane] = b[i];
            }
            for k in 0..Sizes::<N>::K {
                p.angular_a[k].0[lane] = a[N + k];
                p.angular_b[k].0[lane] = b[N + k];
            }
        }
        p
    }

    #[inline(always)]
    pub(super) fn scatter(&self, block: &Block, state: &mut [Real]) {
        for lane in 0..WIDTH {
            let a = block.bodies_a[lane] as usize * Sizes::<N>::STATE;
            let a = &mut state[a..a + Sizes::<N>::VELOCITY];
            for i in 0..N {
                a[i] = self.linear_a[i].0[lane];
            }
            for k in 0..Sizes::<N>::K {
                a[N + k] = self.angular_a[k].0[lane];
            }
            let b = block.bodies_b[lane] as usize * Sizes::<N>::STATE;
            let b = &mut state[b..b + Sizes::<N>::VELOCITY];
            for i in 0..N {
                b[i] = self.linear_b[i].0[lane];
            }
            for k in 0..Sizes::<N>::K {
                b[N + k] = self.angular_b[k].0[lane];
            }
        }
        // Row 0 stands for all bodies that no impulse moves; infinite impulses must not make it anything but zero.
        state[..Sizes::<N>::VELOCITY].fill(0.0);
    }

    /// Relative velocity of b against a along `direction`, linear part.
    #[inline(always)]
    pub(super) fn measure_linear(&self, direction: &[Lanes]) -> Lanes {
        let mut sum = Lanes::ZERO;
        for i in 0..N {
            sum += direction[i] * (self.linear_b[i] * self.mass_b - self.linear_a[i] * self.mass_a);
        }
        sum
    }

    /// The same, angular part, by the row's two arms.
    #[inline(always)]
    pub(super) fn measure_angular(&self, arms: &[Lanes]) -> Lanes {
        let mut sum_a = Lanes::ZERO;
        let mut sum_b = Lanes::ZERO;
        for k in 0..Sizes::<N>::K {
            sum_a += arms[k] * self.angular_a[k];
            sum_b += arms[Sizes::<N>::K + k] * self.angular_b[k];
        }
        sum_b - sum_a
    }

    /// What b's centre has been displaced by against a's.
    #[inline(always)]
    pub(super) fn between_centres(&self) -> [Lanes; N] {
        std::array::from_fn(|i| self.linear_b[i] * self.mass_b - self.linear_a[i] * self.mass_a)
    }

    #[inline(always)]
    pub(super) fn apply_linear(&mut self, direction: &[Lanes], impulse: Lanes) {
        let (a, b) = (impulse * self.mass_a, impulse * self.mass_b);
        for i in 0..N {
            self.linear_a[i] -= direction[i] * a;
            self.linear_b[i] += direction[i] * b;
        }
    }

    #[inline(always)]
    pub(super) fn apply_angular(&mut self, arms: &[Lanes], impulse: Lanes) {
        for k in 0..Sizes::<N>::K {
            self.angular_a[k] -= arms[k] * impulse;
            self.angular_b[k] += arms[Sizes::<N>::K + k] * impulse;
        }
    }
}

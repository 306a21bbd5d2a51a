//! The two bodies of each contact of a block, gathered from the solver's state into lanes, and put back.

use super::Block;
use super::layout::Layout;
use crate::solver::bodies::{MAX_STATE, Sizes};
use crate::solver::lanes::{Lanes, Real, WIDTH};
use crate::solver::machine::Machine;
use crate::solver::wide::{Wide, transpose};

/// The states of both bodies of a block's contacts, one contact a lane, and the header's numbers that every row needs.
pub(super) struct Pairing<const N: usize, M: Machine> {
    /// [`Sizes::STATE`] numbers in use.
    a: [Wide<M>; MAX_STATE],
    b: [Wide<M>; MAX_STATE],
    mass_a: Wide<M>,
    mass_b: Wide<M>,
    pub(super) machine: M,
}

/// Which part of the state is measured: where it starts.
type Part = usize;

impl<const N: usize, M: Machine> Pairing<N, M> {
    const VELOCITY: Part = 0;
    const DISPLACEMENT: Part = Sizes::<N>::VELOCITY;

    #[inline(always)]
    pub(super) fn gather(machine: M, block: &Block, rows: &[Lanes], state: &[Real]) -> Self {
        Self {
            a: Self::gather_side(machine, &block.bodies_a, state),
            b: Self::gather_side(machine, &block.bodies_b, state),
            mass_a: rows[Layout::<N>::INVERSE_SQRT_MASS_A].on(machine),
            mass_b: rows[Layout::<N>::INVERSE_SQRT_MASS_B].on(machine),
            machine,
        }
    }

    #[inline(always)]
    fn gather_side(machine: M, bodies: &[u32; WIDTH], state: &[Real]) -> [Wide<M>; MAX_STATE] {
        let mut gathered = [Wide::zero(machine); MAX_STATE];
        for at in (0..Sizes::<N>::STATE).step_by(WIDTH) {
            let mut rows = [Wide::zero(machine); WIDTH];
            for (row, body) in rows.iter_mut().zip(bodies) {
                let start = *body as usize * Sizes::<N>::STATE + at;
                *row = Lanes::of(&state[start..start + WIDTH]).on(machine);
            }
            gathered[at..at + WIDTH].copy_from_slice(&transpose(machine, &rows));
        }
        gathered
    }

    #[inline(always)]
    pub(super) fn scatter(&self, block: &Block, state: &mut [Real]) {
        Self::scatter_side(&self.a, &block.bodies_a, state);
        Self::scatter_side(&self.b, &block.bodies_b, state);
        // Row 0 stands for all bodies that no impulse moves; infinite impulses must not make it anything but zero.
        state[..Sizes::<N>::VELOCITY].fill(0.0);
    }

    /// Displacements that share a vector with velocities are put back as they were.
    #[inline(always)]
    fn scatter_side(values: &[Wide<M>; MAX_STATE], bodies: &[u32; WIDTH], state: &mut [Real]) {
        for at in (0..Sizes::<N>::VELOCITY).step_by(WIDTH) {
            let mut columns = [values[at]; WIDTH];
            columns.copy_from_slice(&values[at..at + WIDTH]);
            for (body, row) in bodies.iter().zip(transpose(columns[0].machine(), &columns)) {
                let start = *body as usize * Sizes::<N>::STATE + at;
                state[start..start + WIDTH].copy_from_slice(&row.lanes().0);
            }
        }
    }

    /// Relative velocity of b against a along `direction`, linear part.
    #[inline(always)]
    pub(super) fn measure_linear(&self, direction: &[Lanes]) -> Wide<M> {
        self.linear_of(Self::VELOCITY, direction)
    }

    /// The same, angular part, by the row's two arms.
    #[inline(always)]
    pub(super) fn measure_angular(&self, arms: &[Lanes]) -> Wide<M> {
        self.angular_of(Self::VELOCITY, arms)
    }

    /// What b has been displaced by against a along `direction`, linear part.
    #[inline(always)]
    pub(super) fn moved_linear(&self, direction: &[Lanes]) -> Wide<M> {
        self.linear_of(Self::DISPLACEMENT, direction)
    }

    /// The same, angular part, by the row's two arms.
    #[inline(always)]
    pub(super) fn moved_angular(&self, arms: &[Lanes]) -> Wide<M> {
        self.angular_of(Self::DISPLACEMENT, arms)
    }

    #[inline(always)]
    fn linear_of(&self, part: Part, direction: &[Lanes]) -> Wide<M> {
        let mut sum = Wide::zero(self.machine);
        for i in 0..N {
            sum += (self.b[part + i] * self.mass_b - self.a[part + i] * self.mass_a) * direction[i];
        }
        sum
    }

    #[inline(always)]
    fn angular_of(&self, part: Part, arms: &[Lanes]) -> Wide<M> {
        let mut sum_a = Wide::zero(self.machine);
        let mut sum_b = Wide::zero(self.machine);
        for k in 0..Sizes::<N>::K {
            sum_a += self.a[part + N + k] * arms[k];
            sum_b += self.b[part + N + k] * arms[Sizes::<N>::K + k];
        }
        sum_b - sum_a
    }

    /// What b's centre has been displaced by against a's.
    #[inline(always)]
    pub(super) fn between_centres(&self) -> [Wide<M>; N] {
        let mut between = [Wide::zero(self.machine); N];
        for (i, value) in between.iter_mut().enumerate() {
            let at = Self::DISPLACEMENT + i;
            *value = self.b[at] * self.mass_b - self.a[at] * self.mass_a;
        }
        between
    }

    #[inline(always)]
    pub(super) fn apply_linear(&mut self, direction: &[Lanes], impulse: Wide<M>) {
        let (a, b) = (impulse * self.mass_a, impulse * self.mass_b);
        for i in 0..N {
            self.a[i] -= a * direction[i];
            self.b[i] += b * direction[i];
        }
    }

    #[inline(always)]
    pub(super) fn apply_angular(&mut self, arms: &[Lanes], impulse: Wide<M>) {
        for k in 0..Sizes::<N>::K {
            self.a[N + k] -= impulse * arms[k];
            self.b[N + k] += impulse * arms[Sizes::<N>::K + k];
        }
    }
}

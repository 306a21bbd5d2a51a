//! The arms of a block's rows: for eight contacts at once, from the offset of the centre of friction and the directions of
//! normal and tangents, as each body sees them in its solver frame.

use hyperbody_math::Vector;

use super::{Block, Layout};
use crate::solver::bodies::{MAX_PLANES, Sizes, SolverBody};
use crate::solver::lanes::{Lanes, WIDTH};
use crate::solver::machine::Machine;
use crate::solver::wide::Doubles;

/// One number of each contact, in double precision.
type Eight = [f64; WIDTH];

/// What the arms of both bodies are made of.
pub(crate) struct Arms<const N: usize> {
    pub(super) a: Side<N>,
    pub(super) b: Side<N>,
}

/// What the arms of one body are made of; all zero, and so the arms, for what no impulse moves.
pub(super) struct Side<const N: usize> {
    /// From the centre of mass to the centre of friction, m.
    offset: [Eight; N],
    /// The normal, then the tangents.
    directions: [[Eight; N]; N],
    /// See [`SolverBody::inverse_sqrt_moments`].
    inverse_sqrt_moments: [Eight; MAX_PLANES],
}

impl<const N: usize> Arms<N> {
    pub(crate) const ZERO: Self = Self { a: Side::ZERO, b: Side::ZERO };

    /// Notes that a lane holds no contact.
    pub(crate) fn clear(&mut self, lane: usize) {
        self.a.clear(lane);
        self.b.clear(lane);
    }

    /// Writes the arms into the rows of a block.
    #[inline(always)]
    pub(super) fn write<M: Machine>(&self, machine: M, block: &Block, rows: &mut [Lanes]) {
        self.a.write(machine, block, rows);
        self.b.write(machine, block, &mut rows[Sizes::<N>::K..]);
    }
}

impl<const N: usize> Side<N> {
    const ZERO: Self = Self {
        offset: [[0.0; WIDTH]; N],
        directions: [[[0.0; WIDTH]; N]; N],
        inverse_sqrt_moments: [[0.0; WIDTH]; MAX_PLANES],
    };

    /// Notes how the body of one lane sees its contact.
    pub(super) fn fill(
        &mut self,
        lane: usize,
        body: &SolverBody<N>,
        offset: Vector<N>,
        normal: Vector<N>,
        tangents: &[Vector<N>; N],
    ) {
        if body.inverse_sqrt_mass == 0.0 {
            return self.clear(lane);
        }
        // The remainder spares the check of the lane.
        let lane = lane % WIDTH;
        let offset = body.in_solver_frame(offset);
        for i in 0..N {
            self.offset[i][lane] = offset[i];
        }
        for (t, direction) in self.directions.iter_mut().enumerate() {
            let seen = body.in_solver_frame(if t == 0 { normal } else { tangents[t - 1] });
            for i in 0..N {
                direction[i][lane] = seen[i];
            }
        }
        for k in 0..Sizes::<N>::K {
            self.inverse_sqrt_moments[k][lane] = body.inverse_sqrt_moments[k];
        }
    }

    fn clear(&mut self, lane: usize) {
        let moments = self.inverse_sqrt_moments[..Sizes::<N>::K].iter_mut();
        for eight in moments.chain(&mut self.offset).chain(self.directions.as_flattened_mut()) {
            eight[lane] = 0.0;
        }
    }

    /// `rows` start where the first arm of this body would stand in a row that starts the block.
    #[inline(always)]
    fn write<M: Machine>(&self, machine: M, block: &Block, rows: &mut [Lanes]) {
        let [normal, tangents @ ..] = self.directions.as_slice() else { return };
        for (t, tangent) in tangents.iter().enumerate() {
            let at = Layout::<N>::HEADER + t * Layout::<N>::SLIDE_ROW + Layout::<N>::SLIDE_ARM_A;
            self.write_arm(machine, &mut rows[at..], &self.offset, tangent);
        }
        if block.twists > 0 {
            let mut at = Layout::<N>::TWIST_ROWS;
            for s in 0..Layout::<N>::SLIDES {
                for t in s + 1..Layout::<N>::SLIDES {
                    self.write_arm(machine, &mut rows[at..], &tangents[s], &tangents[t]);
                    at += Layout::<N>::TWIST_ROW;
                }
            }
        }
        let field = Layout::<N>::field_start(block);
        self.write_arm(machine, &mut rows[field..], &self.offset, normal);
        for (t, tangent) in tangents.iter().enumerate().take(Layout::<N>::field_rows(block) - 1) {
            let at = field + (t + 1) * Layout::<N>::FIELD_ROW;
            self.write_arm(machine, &mut rows[at..], tangent, normal);
        }
    }

    /// The scaled arm of direction `d` at offset `r`: (r ∧ d)/√I.
    #[inline(always)]
    fn write_arm<M: Machine>(&self, machine: M, arm: &mut [Lanes], r: &[Eight; N], d: &[Eight; N]) {
        let arm = &mut arm[..Sizes::<N>::K];
        let mut k = 0;
        for i in 0..N {
            for j in i + 1..N {
                let wedge = Doubles::of(machine, r[i]) * Doubles::of(machine, d[j])
                    - Doubles::of(machine, r[j]) * Doubles::of(machine, d[i]);
                arm[k] = (wedge * Doubles::of(machine, self.inverse_sqrt_moments[k])).lanes();
                k += 1;
            }
        }
    }
}

//! The arms of a block's rows: from the offset of the centre of friction and the directions of normal and tangents, as each body
//! sees them in its solver frame.

use super::gather::{PlaneLanes, Side};
use super::{Block, Layout};
use crate::solver::lanes::Lanes;
use crate::solver::machine::Machine;
use crate::solver::vectors::{Bivectors, Vectors};

/// What the arms of one body are made of.
pub(super) struct Arms<'a, const N: usize, M: Machine> {
    /// From the centre of mass to the centre of friction, m.
    offset: Vectors<N, M>,
    normal: Vectors<N, M>,
    tangents: [Vectors<N, M>; N],
    /// See [`crate::solver::bodies::SolverBody::inverse_sqrt_moments`].
    inverse_sqrt_moments: &'a PlaneLanes<N>,
}

impl<'a, const N: usize, M: Machine> Arms<'a, N, M> {
    /// Of directions in the world.
    #[inline(always)]
    pub(super) fn new(
        side: &'a Side<N>,
        offset: &Vectors<N, M>,
        normal: &Vectors<N, M>,
        tangents: &[Vectors<N, M>; N],
    ) -> Self {
        let mut arms = Self {
            offset: *offset,
            normal: *normal,
            tangents: *tangents,
            inverse_sqrt_moments: &side.inverse_sqrt_moments,
        };
        if let Some(axes) = side.frame.get() {
            arms.offset = offset.in_frame(axes);
            arms.normal = normal.in_frame(axes);
            for t in 0..Layout::<N>::SLIDES {
                arms.tangents[t] = tangents[t].in_frame(axes);
            }
        }
        arms
    }

    /// `rows` start where the first arm of this body would stand in a row that starts the block.
    #[inline(always)]
    pub(super) fn write(&self, block: &Block, rows: &mut [Lanes]) {
        let tangents = &self.tangents[..Layout::<N>::SLIDES];
        for (t, tangent) in tangents.iter().enumerate() {
            let at = Layout::<N>::HEADER + t * Layout::<N>::SLIDE_ROW + Layout::<N>::SLIDE_ARM_A;
            self.write_arm(&mut rows[at..], &self.offset, tangent);
        }
        if block.twists > 0 {
            let mut at = Layout::<N>::TWIST_ROWS;
            for s in 0..Layout::<N>::SLIDES {
                for t in s + 1..Layout::<N>::SLIDES {
                    self.write_arm(&mut rows[at..], &tangents[s], &tangents[t]);
                    at += Layout::<N>::TWIST_ROW;
                }
            }
        }
        let field = Layout::<N>::field_start(block);
        self.write_arm(&mut rows[field..], &self.offset, &self.normal);
        for (t, tangent) in tangents.iter().enumerate().take(Layout::<N>::field_rows(block) - 1) {
            let at = field + (t + 1) * Layout::<N>::FIELD_ROW;
            self.write_arm(&mut rows[at..], tangent, &self.normal);
        }
    }

    /// The scaled arm of direction `d` at offset `r`: (r ∧ d)/√I.
    #[inline(always)]
    fn write_arm(&self, arm: &mut [Lanes], r: &Vectors<N, M>, d: &Vectors<N, M>) {
        Bivectors::wedge(r, d).store_scaled(self.inverse_sqrt_moments, arm);
    }
}

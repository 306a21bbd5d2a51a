//! Where each number of a block stands. All positions are constants of the dimension.

use super::Block;
use crate::solver::bodies::Sizes;

/// Positions, in lanes, inside a block: header, sliding rows, their mass matrix, twisting rows, normal rows,
/// and the response matrix of those.
pub(crate) struct Layout<const N: usize>;

impl<const N: usize> Layout<N> {
    const K: usize = Sizes::<N>::K;
    /// Sliding directions.
    pub(crate) const SLIDES: usize = N - 1;
    /// Planes of the tangent space.
    pub(crate) const TWISTS: usize = (N - 1) * (N - 2) / 2;

    // Header.
    pub(crate) const INVERSE_SQRT_MASS_A: usize = 0;
    pub(crate) const INVERSE_SQRT_MASS_B: usize = 1;
    pub(crate) const FRICTION: usize = 2;
    pub(crate) const RESTITUTION: usize = 3;
    pub(crate) const BIAS_RATE: usize = 4;
    /// γ of a soft row, and what rigid rows have in its place; 1/kg.
    pub(crate) const SOFTNESS: usize = 5;
    pub(crate) const STIFFENER: usize = 6;
    pub(crate) const TWIST_MASS: usize = 7;
    pub(crate) const NORMAL: usize = 8;
    pub(crate) const HEADER: usize = 8 + N;

    // A sliding row: direction, arms, base velocity and acceleration along it, impulse.
    pub(crate) const SLIDE_ARM_A: usize = N;
    pub(crate) const SLIDE_VELOCITY: usize = N + 2 * Self::K;
    pub(crate) const SLIDE_ACCELERATION: usize = Self::SLIDE_VELOCITY + 1;
    pub(crate) const SLIDE_IMPULSE: usize = Self::SLIDE_VELOCITY + 2;
    pub(crate) const SLIDE_ROW: usize = Self::SLIDE_VELOCITY + 3;

    /// Inverse of the effective mass matrix of sliding, upper triangle by rows.
    pub(crate) const SLIDE_MASS: usize = Self::HEADER + Self::SLIDES * Self::SLIDE_ROW;
    pub(crate) const SLIDE_MASS_LEN: usize = Self::SLIDES * (Self::SLIDES + 1) / 2;

    pub(crate) const TWIST_ROWS: usize = Self::SLIDE_MASS + Self::SLIDE_MASS_LEN;
    // A twisting row: arms, base velocity and acceleration, impulse.
    pub(crate) const TWIST_ARM_A: usize = 0;
    pub(crate) const TWIST_VELOCITY: usize = 2 * Self::K;
    pub(crate) const TWIST_ACCELERATION: usize = 2 * Self::K + 1;
    pub(crate) const TWIST_IMPULSE: usize = 2 * Self::K + 2;
    pub(crate) const TWIST_ROW: usize = 2 * Self::K + 3;

    // A normal row: arms, gap at the start of the step, base velocity and acceleration along the normal, impulse,
    // sum of the impulses of the step's substeps, what turning adds to the gap, place in the tangent space from the centre of friction.
    pub(crate) const POINT_ARM_A: usize = 0;
    pub(crate) const POINT_GAP: usize = 2 * Self::K;
    pub(crate) const POINT_VELOCITY: usize = 2 * Self::K + 1;
    pub(crate) const POINT_ACCELERATION: usize = 2 * Self::K + 2;
    pub(crate) const POINT_IMPULSE: usize = 2 * Self::K + 3;
    pub(crate) const POINT_STEP_IMPULSE: usize = 2 * Self::K + 4;
    pub(crate) const POINT_ARC: usize = 2 * Self::K + 5;
    pub(crate) const POINT_LEVER: usize = 2 * Self::K + 6;
    pub(crate) const POINT_ROW: usize = 2 * Self::K + 6 + Self::SLIDES;

    /// First normal row.
    #[inline(always)]
    pub(crate) fn points_start(block: &Block) -> usize {
        Self::TWIST_ROWS + block.twists * Self::TWIST_ROW
    }

    /// First of the response matrix of the normal rows, upper triangle by rows.
    #[inline(always)]
    pub(crate) fn response_start(block: &Block) -> usize {
        Self::points_start(block) + block.points * Self::POINT_ROW
    }

    /// Lanes of a whole block.
    #[inline(always)]
    pub(crate) fn block_len(block: &Block) -> usize {
        Self::response_start(block) + block.points * (block.points + 1) / 2
    }
}

//! Where each number of a block stands. All positions are constants of the dimension.

use super::Block;
use super::round::RoundLayout;
use crate::solver::bodies::Sizes;
use crate::solver::lanes::Lanes;

/// Positions, in lanes, inside a block: header, sliding rows, their mass matrix, twisting rows, the field of the normal
/// rows, the points, the response matrix of those, and what resists rolling and twisting.
pub(crate) struct Layout<const N: usize>;

impl<const N: usize> Layout<N> {
    const K: usize = Sizes::<N>::K;
    /// Sliding directions.
    pub(crate) const SLIDES: usize = N - 1;
    /// Planes of the tangent space.
    pub(crate) const TWISTS: usize = (N - 1) * (N - 2) / 2;

    // Header: coefficients first.
    pub(crate) const INVERSE_SQRT_MASS_A: usize = 0;
    pub(crate) const INVERSE_SQRT_MASS_B: usize = 1;
    pub(crate) const FRICTION: usize = 2;
    pub(crate) const RESTITUTION: usize = 3;
    pub(crate) const BIAS_RATE: usize = 4;
    /// γ of a soft row, and what rigid rows have in its place; 1/kg.
    pub(crate) const SOFTNESS: usize = 5;
    pub(crate) const STIFFENER: usize = 6;
    pub(crate) const COEFFICIENTS: usize = 7;
    pub(crate) const TWIST_MASS: usize = 7;
    pub(crate) const NORMAL: usize = 8;
    /// Velocity of b's centre against a's at the start of the step, and acceleration.
    pub(crate) const CENTRE_VELOCITY: usize = 8 + N;
    pub(crate) const CENTRE_ACCELERATION: usize = 8 + 2 * N;
    /// Angular momentum that the step's impulses made because the bodies moved on under them, planes of the world.
    pub(crate) const EXCESS: usize = 8 + 3 * N;
    pub(crate) const HEADER: usize = Self::EXCESS + Self::K;

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
    // A twisting row: arms, which come first, base velocity and acceleration, impulse.
    pub(crate) const TWIST_VELOCITY: usize = 2 * Self::K;
    pub(crate) const TWIST_ACCELERATION: usize = 2 * Self::K + 1;
    pub(crate) const TWIST_IMPULSE: usize = 2 * Self::K + 2;
    pub(crate) const TWIST_ROW: usize = 2 * Self::K + 3;

    // A row of the normal field: arms, base velocity and acceleration. What a normal row measures is affine in the place of
    // its point in the tangent space (what the point's height adds, (n ∧ n), is nothing), so the field's values at the
    // centre of friction and its slopes along the N − 1 tangents stand for the rows of all points.
    pub(crate) const FIELD_VELOCITY: usize = 2 * Self::K;
    pub(crate) const FIELD_ACCELERATION: usize = 2 * Self::K + 1;
    pub(crate) const FIELD_ROW: usize = 2 * Self::K + 2;

    // A point: gap at the start of the step, impulse, sum of the impulses of the step's substeps, what turning adds to the
    // gap, place in the tangent space from the centre of friction.
    pub(crate) const POINT_GAP: usize = 0;
    pub(crate) const POINT_IMPULSE: usize = 1;
    pub(crate) const POINT_STEP_IMPULSE: usize = 2;
    pub(crate) const POINT_ARC: usize = 3;
    pub(crate) const POINT_LEVER: usize = 4;
    pub(crate) const POINT_ROW: usize = 4 + Self::SLIDES;

    // Resistance: the two lengths, the mass of rolling, and the impulses of rolling along the slopes of the field.
    pub(crate) const ROLLING: usize = 0;
    pub(crate) const TWISTING: usize = 1;
    pub(crate) const ROLLING_MASS: usize = 2;
    pub(crate) const ROLLING_IMPULSES: usize = 3;
    const RESISTANCE_LEN: usize = 3 + Self::SLIDES;

    /// First row of the normal field.
    #[inline(always)]
    pub(crate) fn field_start(block: &Block) -> usize {
        Self::TWIST_ROWS + block.twists * Self::TWIST_ROW
    }

    /// Rows of the normal field: a single point stands at the centre. Its slopes are the rows of rolling, too.
    #[inline(always)]
    pub(crate) fn field_rows(block: &Block) -> usize {
        if block.points > 1 || block.resists { N } else { 1 }
    }

    /// First point.
    #[inline(always)]
    pub(crate) fn points_start(block: &Block) -> usize {
        Self::field_start(block) + Self::field_rows(block) * Self::FIELD_ROW
    }

    /// First of the response matrix of the normal rows, upper triangle by rows.
    #[inline(always)]
    pub(crate) fn response_start(block: &Block) -> usize {
        Self::points_start(block) + block.points * Self::POINT_ROW
    }

    /// First of the numbers of resistance, where there is any.
    #[inline(always)]
    pub(crate) fn resistance_start(block: &Block) -> usize {
        Self::response_start(block) + block.points * (block.points + 1) / 2
    }

    /// Sets what adds up from substep to substep to nothing.
    #[inline(always)]
    pub(crate) fn start_sums(block: &Block, rows: &mut [Lanes]) {
        rows[Self::EXCESS..Self::HEADER].fill(Lanes::ZERO);
        let points = &mut rows[Self::points_start(block)..Self::response_start(block)];
        for row in points.chunks_exact_mut(Self::POINT_ROW) {
            row[Self::POINT_STEP_IMPULSE] = Lanes::ZERO;
            row[Self::POINT_ARC] = Lanes::ZERO;
        }
    }

    /// Where what turning adds to the gap of a point stands.
    #[inline]
    pub(crate) fn arc(block: &Block, point: usize) -> usize {
        if block.round {
            return RoundLayout::<N>::ARC;
        }
        Self::points_start(block) + point * Self::POINT_ROW + Self::POINT_ARC
    }

    /// Lanes of a whole block.
    #[inline(always)]
    pub(crate) fn block_len(block: &Block) -> usize {
        if block.round {
            return RoundLayout::<N>::LEN;
        }
        Self::resistance_start(block) + if block.resists { Self::RESISTANCE_LEN } else { 0 }
    }
}

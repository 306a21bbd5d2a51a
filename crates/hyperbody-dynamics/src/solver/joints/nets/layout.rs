//! Where each number of eight joints stands. All positions are constants of the dimension.

use crate::solver::bodies::Sizes;

/// Positions, in lanes, among what every sweep reads.
pub(super) struct Swept<const N: usize>;

impl<const N: usize> Swept<N> {
    /// From the centres of mass to where the impulse acts, over √I; zero for what no impulse moves.
    pub(super) const ARM_A: usize = 0;
    pub(super) const ARM_B: usize = N;
    /// 1/√m.
    pub(super) const MASS_A: usize = 2 * N;
    pub(super) const MASS_B: usize = 2 * N + 1;
    /// The rate that is left over without the sweep's impulses, m/s: of base velocities, and what springs ask for.
    pub(super) const RATE: usize = 2 * N + 2;
    /// Inverse of K, upper triangle by rows.
    pub(super) const INVERSE: usize = 3 * N + 2;
    pub(super) const LEN: usize = Self::INVERSE + N * (N + 1) / 2;
}

/// The same among what is looked at once a substep.
pub(super) struct Ground<const N: usize>;

impl<const N: usize> Ground<N> {
    const K: usize = Sizes::<N>::K;
    /// 1/√I.
    pub(super) const LIGHTNESS_A: usize = 0;
    pub(super) const LIGHTNESS_B: usize = 1;
    /// ½ where both bodies move, so that the impulse acts midway between the anchors; else nothing.
    pub(super) const SHARE: usize = 2;
    /// Anchors from the centres of mass at the start of the step, world axes.
    pub(super) const OFFSET_A: usize = 3;
    pub(super) const OFFSET_B: usize = 3 + N;
    /// From the anchor on a to that on b at the start of the step.
    pub(super) const START: usize = 3 + 2 * N;
    /// Base velocity and acceleration of b's centre against a's.
    pub(super) const VELOCITY: usize = 3 + 3 * N;
    pub(super) const ACCELERATION: usize = 3 + 4 * N;
    /// Base angular velocities and accelerations.
    pub(super) const SPIN_A: usize = 3 + 5 * N;
    pub(super) const SPIN_B: usize = Self::SPIN_A + Self::K;
    pub(super) const SPIN_UP_A: usize = Self::SPIN_A + 2 * Self::K;
    pub(super) const SPIN_UP_B: usize = Self::SPIN_A + 3 * Self::K;
    /// All up to here is known at the start of the step.
    pub(super) const GAP: usize = Self::SPIN_A + 4 * Self::K;
    /// What base motion adds to the rate in a second.
    pub(super) const UP: usize = Self::GAP + N;
    /// Sums over the substeps: impulses on b, and their turning parts about the anchor.
    pub(super) const STEP_IMPULSE: usize = Self::UP + N;
    pub(super) const STEP_TWIST: usize = Self::STEP_IMPULSE + N;
    pub(super) const LEN: usize = Self::STEP_TWIST + Self::K;
}

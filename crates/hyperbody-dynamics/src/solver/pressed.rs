//! What all contacts of a step have done to each body so far.
//!
//! Warm starting applies every impulse once more at each substep. Arms stand still within the step, so what that does to
//! a body is the sum of all changes that contacts have made to it in the step: kept here, a warm start is one addition a
//! body instead of a pass over all rows.

use super::bodies::Sizes;
use super::lanes::Real;

/// Sums by body, and room for one pass.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pressed {
    /// [`Sizes::VELOCITY`] numbers a body.
    sum: Vec<Real>,
    before: Vec<Real>,
}

impl Pressed {
    /// Forgets the last step.
    pub(crate) fn clear<const N: usize>(&mut self, body_count: usize) {
        self.sum.clear();
        self.sum.resize(body_count * Sizes::<N>::VELOCITY, 0.0);
    }

    /// Runs a pass over contacts and adds what it changes.
    pub(crate) fn watch<const N: usize>(&mut self, state: &mut [Real], pass: impl FnOnce(&mut [Real])) {
        self.before.clear();
        for row in state.chunks_exact(Sizes::<N>::STATE) {
            self.before.extend_from_slice(&row[..Sizes::<N>::VELOCITY]);
        }
        pass(state);
        let before = self.before.chunks_exact(Sizes::<N>::VELOCITY);
        let sums = self.sum.chunks_exact_mut(Sizes::<N>::VELOCITY);
        for ((row, before), sum) in state.chunks_exact(Sizes::<N>::STATE).zip(before).zip(sums) {
            for ((total, now), then) in sum.iter_mut().zip(row).zip(before) {
                *total += *now - *then;
            }
        }
    }

    /// Does to every body once more what contacts have done to it.
    pub(crate) fn warm_start<const N: usize>(&self, state: &mut [Real]) {
        for (row, sum) in state.chunks_exact_mut(Sizes::<N>::STATE).zip(self.sum.chunks_exact(Sizes::<N>::VELOCITY)) {
            for (value, total) in row.iter_mut().zip(sum) {
                *value += *total;
            }
        }
    }
}

//! What all contacts of a step have done to each body so far.
//!
//! Warm starting applies every impulse once more at each substep. Arms stand still within the step, so what that does to
//! a body is the sum of all changes that contacts have made to it in the step: kept here, a warm start is one addition a
//! body instead of a pass over all rows.
//!
//! Velocities are kept as the whole vectors that hold them. What else is in those, displacements, contacts leave as it is.

use super::bodies::Sizes;
use super::lanes::{Lanes, Real, WIDTH};
use super::machine::{Machine, Pass, Processor};

/// Sums by body, and room for one pass: [`vectors`] of each.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pressed {
    sum: Vec<Lanes>,
    before: Vec<Lanes>,
}

/// Vectors that hold the velocity of a body.
const fn vectors<const N: usize>() -> usize {
    Sizes::<N>::VELOCITY.div_ceil(WIDTH)
}

impl Pressed {
    /// Forgets the last step.
    pub(crate) fn clear<const N: usize>(&mut self, body_count: usize) {
        self.sum.clear();
        self.sum.resize(body_count * vectors::<N>(), Lanes::ZERO);
        self.before.resize(body_count * vectors::<N>(), Lanes::ZERO);
    }

    /// Runs a pass over contacts and adds what it changes.
    pub(crate) fn watch<const N: usize>(
        &mut self,
        processor: Processor,
        state: &mut [Real],
        pass: impl FnOnce(&mut [Real]),
    ) {
        let (bodies, _) = state.as_chunks::<WIDTH>();
        let bodies = bodies.chunks_exact(Sizes::<N>::STATE / WIDTH);
        for (body, before) in bodies.zip(self.before.chunks_exact_mut(vectors::<N>())) {
            for (now, before) in body.iter().zip(before) {
                before.0 = *now;
            }
        }
        pass(state);
        processor.run(Add::<N> { state, before: &self.before, sum: &mut self.sum });
    }

    /// Does to every body once more what contacts have done to it.
    pub(crate) fn warm_start<const N: usize>(&self, processor: Processor, state: &mut [Real]) {
        processor.run(Repeat::<N> { state, sum: &self.sum });
    }
}

/// Adds what changed since `before`.
struct Add<'a, const N: usize> {
    state: &'a [Real],
    before: &'a [Lanes],
    sum: &'a mut [Lanes],
}

impl<const N: usize> Pass for Add<'_, N> {
    #[inline(always)]
    fn run<M: Machine>(self, machine: M) {
        let (bodies, _) = self.state.as_chunks::<WIDTH>();
        let bodies = bodies.chunks_exact(Sizes::<N>::STATE / WIDTH);
        let kept = self.before.chunks_exact(vectors::<N>()).zip(self.sum.chunks_exact_mut(vectors::<N>()));
        for (body, (before, sum)) in bodies.zip(kept) {
            for at in 0..vectors::<N>() {
                let change = Lanes(body[at]).on(machine) - before[at];
                sum[at] = (change + sum[at]).lanes();
            }
        }
    }
}

/// Adds sums to the state.
struct Repeat<'a, const N: usize> {
    state: &'a mut [Real],
    sum: &'a [Lanes],
}

impl<const N: usize> Pass for Repeat<'_, N> {
    #[inline(always)]
    fn run<M: Machine>(self, machine: M) {
        let (bodies, _) = self.state.as_chunks_mut::<WIDTH>();
        let bodies = bodies.chunks_exact_mut(Sizes::<N>::STATE / WIDTH);
        for (body, sum) in bodies.zip(self.sum.chunks_exact(vectors::<N>())) {
            for at in 0..vectors::<N>() {
                body[at] = (Lanes(body[at]).on(machine) + sum[at]).lanes().0;
            }
        }
    }
}

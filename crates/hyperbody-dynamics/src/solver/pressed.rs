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
use crate::threads::{MANY_BODIES, Pool, both};

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
        pool: Option<&Pool>,
        pass: impl FnOnce(&mut [Real]),
    ) {
        self.rows(state).halves::<N>(pool, &|rows| processor.run(Keep::<N>(rows)));
        pass(state);
        self.rows(state).halves::<N>(pool, &|rows| processor.run(Add::<N>(rows)));
    }

    /// Does to every body once more what contacts have done to it.
    pub(crate) fn warm_start<const N: usize>(&mut self, processor: Processor, state: &mut [Real], pool: Option<&Pool>) {
        self.rows(state).halves::<N>(pool, &|rows| processor.run(Repeat::<N>(rows)));
    }

    fn rows<'a>(&'a mut self, state: &'a mut [Real]) -> Rows<'a> {
        Rows { state, before: &mut self.before, sum: &mut self.sum }
    }
}

/// What is kept of a body: its velocity before a pass, and the sum.
type Kept<'a> = (&'a mut [Lanes], &'a mut [Lanes]);

/// Consecutive bodies.
struct Rows<'a> {
    state: &'a mut [Real],
    before: &'a mut [Lanes],
    sum: &'a mut [Lanes],
}

impl Rows<'_> {
    /// Does some work on all of them, halves at the same time where there are threads.
    fn halves<const N: usize>(self, pool: Option<&Pool>, work: &(impl Fn(Rows<'_>) + Sync)) {
        let Rows { state, before, sum } = self;
        let bodies = state.len() / Sizes::<N>::STATE;
        if pool.is_none() || bodies <= MANY_BODIES {
            return work(Rows { state, before, sum });
        }
        let middle = bodies / 2;
        let (state, other_state) = state.split_at_mut(middle * Sizes::<N>::STATE);
        let (before, other_before) = before.split_at_mut(middle * vectors::<N>());
        let (sum, other_sum) = sum.split_at_mut(middle * vectors::<N>());
        let (one, other) =
            (Rows { state, before, sum }, Rows { state: other_state, before: other_before, sum: other_sum });
        both(pool, || one.halves::<N>(pool, work), || other.halves::<N>(pool, work));
    }

    /// The vectors of each body's state, and what is kept of those that hold its velocity.
    #[inline(always)]
    fn bodies<const N: usize>(&mut self) -> impl Iterator<Item = (&mut [[Real; WIDTH]], Kept<'_>)> {
        let (bodies, _) = self.state.as_chunks_mut::<WIDTH>();
        let kept = self.before.chunks_exact_mut(vectors::<N>()).zip(self.sum.chunks_exact_mut(vectors::<N>()));
        bodies.chunks_exact_mut(Sizes::<N>::STATE / WIDTH).zip(kept)
    }
}

/// Keeps velocities as they are.
struct Keep<'a, const N: usize>(Rows<'a>);

impl<const N: usize> Pass for Keep<'_, N> {
    #[inline(always)]
    fn run<M: Machine>(mut self, _: M) {
        for (body, (before, _)) in self.0.bodies::<N>() {
            for at in 0..vectors::<N>() {
                before[at].0 = body[at];
            }
        }
    }
}

/// Adds what changed since then.
struct Add<'a, const N: usize>(Rows<'a>);

impl<const N: usize> Pass for Add<'_, N> {
    #[inline(always)]
    fn run<M: Machine>(mut self, machine: M) {
        for (body, (before, sum)) in self.0.bodies::<N>() {
            for at in 0..vectors::<N>() {
                let change = Lanes(body[at]).on(machine) - before[at];
                sum[at] = (change + sum[at]).lanes();
            }
        }
    }
}

/// Adds sums to the state.
struct Repeat<'a, const N: usize>(Rows<'a>);

impl<const N: usize> Pass for Repeat<'_, N> {
    #[inline(always)]
    fn run<M: Machine>(mut self, machine: M) {
        for (body, (_, sum)) in self.0.bodies::<N>() {
            for at in 0..vectors::<N>() {
                body[at] = (Lanes(body[at]).on(machine) + sum[at]).lanes().0;
            }
        }
    }
}

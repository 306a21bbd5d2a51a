//! Sweeps forth and back, each two of them extrapolated from what came before.
//!
//! A symmetric sweep multiplies the error by a matrix whose eigenvalues lie between 0 and 1: near 0 for what neighbours settle among
//! themselves, near 1 for what a whole net has to agree on. In place of m powers of it, Chebyshev's polynomial of degree m that is
//! least between 0 and [`SLOWEST`] (G. H. Golub and R. S. Varga, 1961): x ← ω (γ (S x − x) + x − x′) + x′, with x′ the one before x. Impulses
//! and velocities hang together linearly, so both are extrapolated alike. It is never beyond 1, whatever the net: what is slower still gets
//! better, too.

use crate::solver::lanes::{Lanes, Real};
use crate::solver::machine::Machine;
use crate::solver::wide::Wide;

/// The slowest share of an error that a sweep forth and back leaves, of those that count. Nearer to 1, so few of them would overshoot
/// by more than springs bear that are a substep late.
const SLOWEST: f64 = 0.93;

/// γ and σ of the interval from 0 to [`SLOWEST`].
const RELAXED: f64 = 2.0 / (2.0 - SLOWEST);
const SIGMA: f64 = SLOWEST / (2.0 - SLOWEST);

/// What velocities and impulses were before the present turn, and the one before.
#[derive(Clone, Debug, Default)]
pub(super) struct Chebyshev {
    last: [Vec<Lanes>; 2],
    before: [Vec<Lanes>; 2],
    omega: f64,
}

impl Chebyshev {
    /// Notes where the first turn starts from.
    #[inline]
    pub(super) fn start(&mut self, velocities: &[Lanes], impulses: &[Lanes]) {
        for ((last, before), now) in self.last.iter_mut().zip(&mut self.before).zip([velocities, impulses]) {
            last.clear();
            last.extend_from_slice(now);
            before.resize(now.len(), Lanes::ZERO);
        }
    }

    /// Goes on from what a sweep forth and back made, the `turn`th.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn extrapolate<M: Machine>(
        &mut self,
        machine: M,
        velocities: &mut [Lanes],
        impulses: &mut [Lanes],
        turn: usize,
    ) {
        self.omega = match turn {
            1 => 1.0,
            2 => 1.0 / (1.0 - 0.5 * SIGMA * SIGMA),
            _ => 1.0 / (1.0 - 0.25 * SIGMA * SIGMA * self.omega),
        };
        let (omega, relaxed) = (Wide::splat(machine, self.omega as Real), Wide::splat(machine, RELAXED as Real));
        let kept = self.last.iter().zip(&mut self.before);
        for (now, (last, before)) in [velocities, impulses].into_iter().zip(kept) {
            for ((now, last), before) in now.iter_mut().zip(last).zip(before) {
                let (swept, from) = (now.on(machine), last.on(machine));
                let onwards = relaxed * (swept - from);
                let next = if turn == 1 {
                    onwards + from
                } else {
                    let x = before.on(machine);
                    omega * (onwards + (from - x)) + x
                };
                *now = next.lanes();
                *before = *now;
            }
        }
        std::mem::swap(&mut self.last, &mut self.before);
    }
}

//! Angular momentum to rounding, though contacts stay where they were at the start of the step.
//!
//! An impulse p that acts on two bodies at one point keeps their angular momentum. Within the step the bodies move on by d_a
//! and d_b while the arms of the rows stand still, so that p adds (d_b − d_a) ∧ p. What a contact added so is summed, and taken
//! back from the spins of both bodies at the step's end. Displacements against each other, not against the world, so that a
//! uniform motion of everything changes nothing.
//!
//! Which body's arm went stale is a matter of where the contact went: with the ball that rolls on a plank, over the plank. The
//! plank has to take all of it; any part that the ball took would drive it on. `wandering` says who takes how much.

use super::pairing::Pairing;
use super::parts::Parts;
use super::round::RoundLayout;
use super::solve::{PassTimes, Passes};
use super::{Block, Layout};
use crate::solver::bodies::{MAX_PLANES, Sizes};
use crate::solver::lanes::Lanes;
use crate::solver::machine::Machine;
use crate::solver::wide::Wide;

impl<const N: usize, M: Machine> Passes<N, M> {
    /// The impulse on b of all rows of a block, world axes.
    #[inline(always)]
    pub(super) fn impulse(machine: M, rows: &Parts<'_>) -> [Wide<M>; N] {
        let load = Self::load(machine, rows.points);
        let mut sum = [load; N];
        for (sum, direction) in sum.iter_mut().zip(&rows.header[Layout::<N>::NORMAL..]) {
            *sum = load * *direction;
        }
        for row in rows.slides.chunks_exact(Layout::<N>::SLIDE_ROW) {
            let impulse = row[Layout::<N>::SLIDE_IMPULSE].on(machine);
            for (sum, direction) in sum.iter_mut().zip(row) {
                *sum += impulse * *direction;
            }
        }
        sum
    }

    /// Notes what impulses applied now, after the bodies moved, add to the angular momentum. `before` is the part of the
    /// block's impulse that was applied, and noted, earlier.
    #[inline(always)]
    pub(super) fn note_excess(rows: &mut Parts<'_>, before: &[Wide<M>; N], p: &Pairing<N, M>, times: &PassTimes) {
        let mut impulse = Self::impulse(p.machine, rows);
        for (whole, before) in impulse.iter_mut().zip(before) {
            *whole -= *before;
        }
        let (motion, excess) = rows.header.split_at_mut(Layout::<N>::EXCESS);
        let velocity = &motion[Layout::<N>::CENTRE_VELOCITY..];
        let acceleration = &motion[Layout::<N>::CENTRE_ACCELERATION..];
        p.note_excess(excess, &impulse, (velocity, acceleration), times);
    }
}

impl<const N: usize, M: Machine> Pairing<N, M> {
    /// Adds what an impulse on b adds to the angular momentum, by which the bodies have moved on. `velocity` and
    /// `acceleration` are the base motion of b's centre against a's.
    #[inline(always)]
    pub(super) fn note_excess(
        &self,
        excess: &mut [Lanes],
        impulse: &[Wide<M>; N],
        (velocity, acceleration): (&[Lanes], &[Lanes]),
        times: &PassTimes,
    ) {
        let (moved, moved_sq) = (Wide::splat(self.machine, times.moved), Wide::splat(self.machine, times.moved_sq));
        let mut between = self.between_centres();
        for i in 0..N {
            between[i] += moved * velocity[i];
            between[i] += moved_sq * acceleration[i];
        }
        let mut k = 0;
        for i in 0..N {
            for j in i + 1..N {
                excess[k] = (excess[k].on(self.machine) + (between[i] * impulse[j] - between[j] * impulse[i])).lanes();
                k += 1;
            }
        }
    }
}

/// What a contact has added to the angular momentum of its two bodies in the step, kg·m²/s, by the planes of the world. `rows` are
/// those of its block.
#[inline]
pub(crate) fn excess<const N: usize>(block: &Block, rows: &[Lanes], lane: usize) -> [f64; MAX_PLANES] {
    let start = if block.round { RoundLayout::<N>::EXCESS } else { Layout::<N>::EXCESS };
    let mut sum = [0.0; MAX_PLANES];
    for (sum, row) in sum.iter_mut().zip(&rows[start..start + Sizes::<N>::K]) {
        *sum = f64::from(row.0[lane]);
    }
    sum
}

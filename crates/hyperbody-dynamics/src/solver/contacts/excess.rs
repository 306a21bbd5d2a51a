//! Angular momentum to rounding, though contacts stay where they were at the start of the step.
//!
//! An impulse p that acts on two bodies at one point keeps their angular momentum. Within the step the bodies move on by d_a
//! and d_b while the arms of the rows stand still, so that p adds (d_b − d_a) ∧ p. What a contact added so is summed, and taken
//! back from the spins of both bodies at the step's end. Displacements against each other, not against the world, so that a
//! uniform motion of everything changes nothing.
//!
//! Which body's arm went stale is a matter of where the contact went: with the ball that rolls on a plank, over the plank. The
//! plank has to take all of it; any part that the ball took would drive it on. `wandering` says who takes how much.

use hyperbody_math::{Bivector, planes};

use super::Layout;
use super::pairing::Pairing;
use super::solve::{PassTimes, Passes};
use crate::solver::lanes::Lanes;

impl<const N: usize> Passes<N> {
    /// The impulse on b of all rows of a block, world axes.
    #[inline(always)]
    pub(super) fn impulse(head: &[Lanes], points: &[Lanes]) -> [Lanes; N] {
        let load = Self::load(points);
        let mut sum: [Lanes; N] = std::array::from_fn(|i| head[Layout::<N>::NORMAL + i] * load);
        for row in head[Layout::<N>::HEADER..Layout::<N>::SLIDE_MASS].chunks_exact(Layout::<N>::SLIDE_ROW) {
            for (sum, direction) in sum.iter_mut().zip(row) {
                *sum += *direction * row[Layout::<N>::SLIDE_IMPULSE];
            }
        }
        sum
    }

    /// Notes what impulses applied now, after the bodies moved by `displacement`, add to the angular momentum. `before` is the
    /// part of the block's impulse that was applied, and noted, earlier.
    #[inline(always)]
    pub(super) fn note_excess(
        head: &mut [Lanes],
        points: &[Lanes],
        before: &[Lanes; N],
        displacement: &Pairing<N>,
        times: &PassTimes,
    ) {
        let (moved, moved_sq) = (Lanes::splat(times.moved), Lanes::splat(times.moved_sq));
        let mut between = displacement.between_centres();
        let mut impulse = Self::impulse(head, points);
        for i in 0..N {
            between[i] += moved * head[Layout::<N>::CENTRE_VELOCITY + i];
            between[i] += moved_sq * head[Layout::<N>::CENTRE_ACCELERATION + i];
            impulse[i] -= before[i];
        }
        let mut k = Layout::<N>::EXCESS;
        for i in 0..N {
            for j in i + 1..N {
                head[k] += between[i] * impulse[j] - between[j] * impulse[i];
                k += 1;
            }
        }
    }
}

/// What a contact has added to the angular momentum of its two bodies in the step, kg·m²/s. `rows` are those of its block.
pub(crate) fn excess<const N: usize>(rows: &[Lanes], lane: usize) -> Bivector<N> {
    let mut sum = Bivector::ZERO;
    for (k, (i, j)) in planes::all(N).enumerate() {
        sum.set(i, j, f64::from(rows[Layout::<N>::EXCESS + k].0[lane]));
    }
    sum
}

//! From manifolds to rows before the substeps, and from rows to manifolds after them.

use super::bodies::{Sizes, SolverBody};
use super::colours::ActiveContact;
use super::coming::{Coming, Errand};
use super::contacts::{self, Block, Gathered, Held, Layout, Prepare, Springs};
use super::division::Stretch;
use super::lanes::{Lanes, Real};
use super::machine::Processor;
use super::softness::Softness;
use super::{Solver, contacts::ContactRows};
use crate::Tuning;
use crate::pairs::{Contact, Meeting};
use crate::threads::{Pool, both};

/// Blocks below which another thread is not worth its while.
const FEW_BLOCKS: usize = 16;

impl<const N: usize> Solver<N> {
    /// Makes the rows of all contacts. `h` is the length of a substep, s.
    pub(super) fn make_rows(&mut self, tuning: &Tuning, h: f64, pool: Option<&Pool>) {
        let springs = Springs {
            soft: Softness::new(tuning.contact_hz, tuning.contact_damping_ratio, h),
            stiff: Softness::new(2.0 * tuning.contact_hz, tuning.contact_damping_ratio, h),
        };
        let nothing = Contact::NONE;
        let ContactRows { blocks, held, rows, .. } = &mut self.contacts;
        let (bodies, active, processor) = (self.bodies.as_slice(), self.active.as_slice(), self.processor);
        let fill = Fill { active, bodies, springs, processor, nothing: &nothing };
        fill.halves(blocks, held, rows, pool);
    }

    /// Impulses to start the next step from; and from the spins what contacts added to the angular momentum.
    pub(super) fn store_impulses(&mut self, pool: Option<&Pool>) {
        let (bodies, active) = (self.bodies.as_slice(), self.active.as_slice());
        let store = |_, contacts: Stretch<'_, N>| store(bodies, active, contacts);
        self.division.each::<N>(self.contacts.whole(&mut self.state), pool, &store);
    }
}

/// What making rows reads.
#[derive(Clone, Copy)]
struct Fill<'a, const N: usize> {
    active: &'a [ActiveContact],
    bodies: &'a [SolverBody<N>],
    springs: Springs,
    processor: Processor,
    /// What an empty lane holds.
    nothing: &'a Contact<N>,
}

impl<const N: usize> Fill<'_, N> {
    /// Fills the rows of consecutive blocks, halves of them side by side.
    fn halves(&self, blocks: &[Block], held: &[Held<N>], rows: &mut [Lanes], pool: Option<&Pool>) {
        if pool.is_none() || blocks.len() <= FEW_BLOCKS {
            return self.in_turn(blocks, held, rows);
        }
        let middle = blocks.len() / 2;
        let (first, second) = blocks.split_at(middle);
        let (held_of_first, held_of_second) = held.split_at(middle);
        let (rows_of_first, rows_of_second) = rows.split_at_mut(second[0].start - first[0].start);
        both(
            pool,
            || self.halves(first, held_of_first, rows_of_first, pool),
            || self.halves(second, held_of_second, rows_of_second, pool),
        );
    }

    fn in_turn(&self, blocks: &[Block], held: &[Held<N>], rows: &mut [Lanes]) {
        let coming = Coming { blocks, active: self.active, bodies: self.bodies, errand: Errand::Fill };
        let mut gathered = Gathered::ZERO;
        let start = blocks.first().map_or(0, |block| block.start);
        for (index, (block, in_block)) in blocks.iter().zip(held).enumerate() {
            coming.fetch(index, held);
            let rows = &mut rows[block.start - start..][..Layout::<N>::block_len(block)];
            self.block(block, in_block, rows, &mut gathered);
        }
    }

    fn block(&self, block: &Block, held: &Held<N>, rows: &mut [Lanes], gathered: &mut Gathered<N>) {
        gathered.start();
        for (lane, (&index, contact)) in block.contacts.iter().zip(&held.contacts).enumerate() {
            // No index is that of an empty lane.
            let (contact, a, b) = match (self.active.get(index as usize), contact) {
                (Some(active), Some(contact)) => (&**contact, active.body_a as usize, active.body_b as usize),
                _ => (self.nothing, 0, 0),
            };
            gathered.fill(block, lane, contact, (&self.bodies[a], &self.bodies[b]));
        }
        self.processor.run(Prepare { block, rows, gathered, springs: &self.springs });
    }
}

/// See [`Solver::store_impulses`].
fn store<const N: usize>(bodies: &[SolverBody<N>], active: &[ActiveContact], contacts: Stretch<'_, N>) {
    let Stretch { blocks, held, rows, state, .. } = contacts;
    let coming = Coming { blocks, active, bodies, errand: Errand::Store };
    let start = blocks.first().map_or(0, |block| block.start);
    for (index, block) in blocks.iter().enumerate() {
        coming.fetch(index, held);
        coming.fetch_rows(index, rows);
        let rows = &rows[block.start - start..][..Layout::<N>::block_len(block)];
        let Held { contacts, meetings } = &mut held[index];
        for (lane, (contact, meeting)) in contacts.iter_mut().zip(meetings).enumerate() {
            let (Some(contact), Some(active)) = (contact, active.get(block.contacts[lane] as usize)) else { continue };
            contacts::store(block, rows, lane, contact);
            *meeting = Meeting::of(contact);
            if active.moves != [true; 2] {
                continue;
            }
            let excess = contacts::excess::<N>(block, rows, lane);
            let share = contact.share_of_b;
            let sides =
                [(active.body_a, block.bodies_a[lane], share - 1.0), (active.body_b, block.bodies_b[lane], -share)];
            for (body, row, share) in sides {
                let spin: &mut [Real] = &mut state[row as usize * Sizes::<N>::STATE + N..];
                let body = &bodies[body as usize];
                if block.round {
                    body.add_spin_of_ball(spin, &excess, share);
                } else {
                    body.add_spin(spin, &excess, share);
                }
            }
        }
    }
}

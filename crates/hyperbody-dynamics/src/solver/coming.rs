//! What the next blocks of contacts are about to ask memory for; see [`crate::ahead`].
//!
//! A contact is three steps away from its block: its pair's slot, what the pair remembers, its points. Each is asked for a block
//! sooner than the next.

use std::mem::offset_of;

use super::bodies::SolverBody;
use super::colours::ActiveContact;
use super::contacts::{Block, Layout};
use super::lanes::Lanes;
use crate::ahead::{IS_HEARD, fetch, fetch_all};
use crate::pairs::{Contact, Pairs};

/// What a pass over all blocks comes for.
#[derive(Clone, Copy)]
pub(super) enum Errand {
    /// Making rows.
    Fill,
    /// Storing impulses: of bodies, what turns them into spin.
    Store,
}

/// What passes over all blocks once a step.
#[derive(Clone, Copy)]
pub(super) struct Coming<'a, const N: usize> {
    pub(super) blocks: &'a [Block],
    pub(super) active: &'a [ActiveContact],
    pub(super) bodies: &'a [SolverBody<N>],
    pub(super) errand: Errand,
}

impl<const N: usize> Coming<'_, N> {
    /// Asks for what the blocks after the one at `index` work on.
    #[inline(always)]
    pub(super) fn fetch(&self, index: usize, pairs: &Pairs<N>) {
        if !IS_HEARD {
            return;
        }
        if let Some(block) = self.blocks.get(index + 3) {
            self.contacts(block).for_each(|active| fetch(&pairs.slots()[active.pair as usize], usize::MAX));
        }
        // How much it is stands in the calls, so that each becomes as many hints and no loop.
        if let Some(block) = self.blocks.get(index + 2) {
            if block.round {
                self.contacts(block).for_each(|active| self.fetch_of_balls(active, pairs));
            } else {
                self.contacts(block).for_each(|active| self.fetch_of_others(active, pairs));
            }
        }
        if let Some(block) = self.blocks.get(index + 1).filter(|block| !block.round) {
            for contact in self.contacts(block).filter_map(|active| contact_of(active, pairs)) {
                fetch_all(&contact.touches);
            }
        }
    }

    // Contacts and bodies keep in front what rows of balls are made of, of moments the first, and at the end what few rows are.

    #[inline(always)]
    fn fetch_of_balls(&self, active: &ActiveContact, pairs: &Pairs<N>) {
        if let Some(contact) = contact_of(active, pairs) {
            fetch(contact, offset_of!(Contact<N>, normal_in_a));
        }
        for body in self.bodies_of(active) {
            match self.errand {
                Errand::Fill => fetch(body, offset_of!(SolverBody<N>, inverse_sqrt_moments) + size_of::<f64>()),
                Errand::Store => fetch(&body.inverse_sqrt_moments[0], usize::MAX),
            }
        }
    }

    #[inline(always)]
    fn fetch_of_others(&self, active: &ActiveContact, pairs: &Pairs<N>) {
        if let Some(contact) = contact_of(active, pairs) {
            fetch(contact, offset_of!(Contact<N>, resistance));
        }
        for body in self.bodies_of(active) {
            match self.errand {
                Errand::Fill => fetch(body, offset_of!(SolverBody<N>, surface)),
                Errand::Store => {
                    fetch(&body.inverse_sqrt_moments, usize::MAX);
                    fetch(&body.frame, usize::MAX);
                }
            }
        }
    }

    /// Asks for the rows of the block after next.
    #[inline]
    pub(super) fn fetch_rows(&self, index: usize, rows: &[Lanes]) {
        let Some(block) = self.blocks.get(index + 2) else { return };
        fetch_all(&rows[block.start..block.start + Layout::<N>::block_len(block)]);
    }

    /// The contacts of a block.
    #[inline(always)]
    fn contacts<'b>(&'b self, block: &'b Block) -> impl Iterator<Item = &'b ActiveContact> {
        // No index is that of an empty lane.
        block.contacts.iter().filter_map(|&contact| self.active.get(contact as usize))
    }

    #[inline(always)]
    fn bodies_of(&self, active: &ActiveContact) -> [&SolverBody<N>; 2] {
        [active.body_a, active.body_b].map(|body| &self.bodies[body as usize])
    }
}

#[inline(always)]
fn contact_of<'a, const N: usize>(active: &ActiveContact, pairs: &'a Pairs<N>) -> Option<&'a Contact<N>> {
    pairs.get(active.pair)?.contact.as_deref()
}

//! What the next blocks of contacts are about to ask memory for; see [`crate::ahead`].
//!
//! A contact and its bodies are one step away from the block, its points two: those are asked for a block later.

use std::mem::offset_of;

use super::bodies::SolverBody;
use super::colours::ActiveContact;
use super::contacts::{Block, Held, Layout};
use super::lanes::Lanes;
use crate::ahead::{IS_HEARD, fetch, fetch_all};
use crate::pairs::Contact;

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
    pub(super) fn fetch(&self, index: usize, held: &[Held<N>]) {
        if !IS_HEARD {
            return;
        }
        // How much it is stands in the calls, so that each becomes as many hints and no loop.
        if let (Some(block), Some(held)) = (self.blocks.get(index + 2), held.get(index + 2)) {
            if block.round {
                held.contacts
                    .iter()
                    .flatten()
                    .for_each(|contact| fetch(&**contact, offset_of!(Contact<N>, normal_in_a)));
                self.contacts(block).for_each(|active| self.fetch_balls(active));
            } else {
                held.contacts
                    .iter()
                    .flatten()
                    .for_each(|contact| fetch(&**contact, offset_of!(Contact<N>, resistance)));
                self.contacts(block).for_each(|active| self.fetch_others(active));
            }
        }
        if let (Some(block), Some(held)) = (self.blocks.get(index + 1), held.get(index + 1))
            && !block.round
        {
            held.contacts.iter().flatten().for_each(|contact| fetch_all(&contact.touches));
        }
    }

    // Contacts and bodies keep in front what rows of balls are made of, of moments the first, and at the end what few rows are.

    #[inline(always)]
    fn fetch_balls(&self, active: &ActiveContact) {
        for body in self.bodies_of(active) {
            match self.errand {
                Errand::Fill => fetch(body, offset_of!(SolverBody<N>, inverse_sqrt_moments) + size_of::<f64>()),
                Errand::Store => fetch(&body.inverse_sqrt_moments[0], usize::MAX),
            }
        }
    }

    #[inline(always)]
    fn fetch_others(&self, active: &ActiveContact) {
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
        fetch_all(&rows[block.start - self.blocks[0].start..][..Layout::<N>::block_len(block)]);
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

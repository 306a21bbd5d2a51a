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
    #[inline]
    pub(super) fn fetch(&self, index: usize, pairs: &Pairs<N>) {
        if !IS_HEARD {
            return;
        }
        for (_, active) in self.contacts(index + 3) {
            fetch(&pairs.slots()[active.pair as usize], usize::MAX);
        }
        for (block, active) in self.contacts(index + 2) {
            let contact = pairs.get(active.pair).and_then(|pair| pair.contact.as_deref());
            let bodies = [active.body_a, active.body_b].map(|body| &self.bodies[body as usize]);
            // Both keep in front what rows of balls are made of, of moments the first, and at the end what few rows are. How much it
            // is stands in the calls, so that each becomes as many hints and no loop.
            if block.round {
                contact.into_iter().for_each(|contact| fetch(contact, offset_of!(Contact<N>, normal_in_a)));
            } else {
                contact.into_iter().for_each(|contact| fetch(contact, offset_of!(Contact<N>, resistance)));
            }
            let first_moment = offset_of!(SolverBody<N>, inverse_sqrt_moments) + size_of::<f64>();
            for body in bodies {
                match (self.errand, block.round) {
                    (Errand::Fill, true) => fetch(body, first_moment),
                    (Errand::Fill, false) => fetch(body, offset_of!(SolverBody<N>, surface)),
                    (Errand::Store, true) => fetch(&body.inverse_sqrt_moments[0], usize::MAX),
                    (Errand::Store, false) => {
                        fetch(&body.inverse_sqrt_moments, usize::MAX);
                        fetch(&body.frame, usize::MAX);
                    }
                }
            }
        }
        for (_, active) in self.contacts(index + 1).filter(|(block, _)| !block.round) {
            if let Some(contact) = pairs.get(active.pair).and_then(|pair| pair.contact.as_deref()) {
                fetch_all(&contact.touches);
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
    fn contacts(&self, index: usize) -> impl Iterator<Item = (&Block, &ActiveContact)> {
        let lanes =
            self.blocks.get(index).into_iter().flat_map(|block| block.contacts.iter().map(move |&lane| (block, lane)));
        // No index is that of an empty lane.
        lanes.filter_map(|(block, contact)| Some((block, self.active.get(contact as usize)?)))
    }
}

//! What the next blocks of contacts are about to ask memory for; see [`crate::ahead`].
//!
//! A contact is three steps away from its block: its pair's slot, what the pair remembers, its points. Each is asked for a block
//! sooner than the next.

use std::mem::offset_of;

use super::bodies::SolverBody;
use super::colours::{ActiveContact, Group};
use super::contacts::{Block, Layout};
use super::lanes::Lanes;
use crate::ahead::{IS_HEARD, fetch, fetch_all};
use crate::pairs::{Contact, Pairs};

/// What passes over all blocks once a step.
#[derive(Clone, Copy)]
pub(super) struct Coming<'a, const N: usize> {
    pub(super) blocks: &'a [Block],
    pub(super) active: &'a [ActiveContact],
    pub(super) bodies: &'a [SolverBody<N>],
}

impl<const N: usize> Coming<'_, N> {
    /// Asks for what the blocks after the one at `index` work on.
    #[inline]
    pub(super) fn fetch(&self, index: usize, pairs: &Pairs<N>) {
        if !IS_HEARD {
            return;
        }
        for contact in self.contacts(index + 3) {
            fetch(&pairs.slots()[contact.pair as usize], usize::MAX);
        }
        for active in self.contacts(index + 2) {
            // Both keep in front what rows of balls are made of, and at the end what few rows are.
            let (of_contact, of_body) = if active.round {
                (offset_of!(Contact<N>, normal_in_a), offset_of!(SolverBody<N>, added_moment))
            } else {
                (size_of::<Contact<N>>(), offset_of!(SolverBody<N>, angular_acceleration))
            };
            if let Some(contact) = pairs.get(active.pair).and_then(|pair| pair.contact.as_deref()) {
                fetch(contact, of_contact);
            }
            fetch(&self.bodies[active.body_a as usize], of_body);
            fetch(&self.bodies[active.body_b as usize], of_body);
        }
        for contact in self.contacts(index + 1) {
            fetch_all(pairs.get(contact.pair).map_or(&[], |pair| pair.touches()));
        }
    }

    /// Asks for the rows of the block after next.
    #[inline]
    pub(super) fn fetch_rows(&self, index: usize, rows: &[Lanes]) {
        let Some(block) = self.blocks.get(index + 2) else { return };
        fetch_all(&rows[block.start..block.start + Layout::<N>::block_len(block)]);
    }

    fn contacts(&self, index: usize) -> impl Iterator<Item = &ActiveContact> {
        let lanes = self.blocks.get(index).into_iter().flat_map(|block| block.contacts.iter());
        lanes.filter(|&&contact| contact != Group::EMPTY).map(|&contact| &self.active[contact as usize])
    }
}

//! Contacts as constraint rows.
//!
//! A manifold has one row per point along the normal, which only pushes, and at the centre of its points N − 1 rows of
//! sliding friction and (N−1)(N−2)/2 of twisting friction: sliding stays in the ball of radius μ·Σλ in the tangent space,
//! twisting within what the points give against a twist in its direction. Neither depends on the choice of axes, so that
//! a scene turned by any rotation moves turned. Resistance to rolling and twisting (`material.rs`) is a torque within a ball of
//! its own, along the slopes of the normal field and the twisting rows. With friction once a manifold, a tesseract's facet on another costs
//! 8 + 6 rows instead of 32.
//!
//! The rows of a group are lanes side by side in one flat array, in the order in which solving reads them.

mod arms;
mod excess;
mod gather;
mod layout;
mod normal;
mod pairing;
mod parts;
mod prepare;
mod response;
mod round;
mod solve;
mod sweep;

use super::colours::{ActiveContact, Colours, Group};
use super::division::{Division, Stretch};
use super::lanes::{Lanes, Real, WIDTH};
use crate::pairs::{Contact, Meeting};
pub(crate) use excess::excess;
pub(crate) use gather::Gathered;
pub(crate) use layout::Layout;
pub(crate) use normal::NormalProblem;
pub(crate) use prepare::{Prepare, Springs, store};
pub(crate) use solve::{Bounce, PassTimes, WarmStart};
pub(crate) use sweep::Sweep;

/// One group of contacts and where its rows are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// First lane in the array of rows.
    pub(crate) start: usize,
    /// Normal rows: the most points of any of its contacts.
    pub(crate) points: usize,
    /// Twisting rows: (N−1)(N−2)/2, or none where no contact has two points or resists.
    pub(crate) twists: usize,
    /// Whether any of its contacts bounces.
    pub(crate) bounces: bool,
    /// Whether any of its contacts resists rolling or twisting.
    pub(crate) resists: bool,
    /// Whether all of its contacts are those of balls, with rows of their own (`round`).
    pub(crate) round: bool,
    /// Rows of the states of its part.
    pub(crate) bodies_a: [u32; WIDTH],
    pub(crate) bodies_b: [u32; WIDTH],
    /// Active contacts, [`Group::EMPTY`] in unused lanes.
    pub(crate) contacts: [u32; WIDTH],
}

/// The contacts of a block, while they are solved, and what came of them.
#[derive(Debug)]
pub(crate) struct Held<const N: usize> {
    pub(crate) contacts: [Option<Box<Contact<N>>>; WIDTH],
    pub(crate) meetings: [Meeting; WIDTH],
}

impl<const N: usize> Default for Held<N> {
    fn default() -> Self {
        Self { contacts: [const { None }; WIDTH], meetings: [Meeting::Apart; WIDTH] }
    }
}

/// All contacts of a step.
#[derive(Debug, Default)]
pub(crate) struct ContactRows<const N: usize> {
    pub(crate) blocks: Vec<Block>,
    /// By block.
    pub(crate) held: Vec<Held<N>>,
    pub(crate) rows: Vec<Lanes>,
    /// Room for the problem of one block in each part.
    problems: Vec<NormalProblem>,
}

impl<const N: usize> ContactRows<N> {
    /// Makes room for the groups; what the rows hold is left over from the last step.
    pub(crate) fn allocate(&mut self, colours: &[Colours], contacts: &[ActiveContact], division: &mut Division) {
        self.blocks.clear();
        self.problems.resize_with(division.count(), NormalProblem::default);
        let mut start = 0;
        let mut end = 0;
        for (part, colours) in colours.iter().enumerate() {
            end += colours.groups.len();
            division.note_blocks(part, end);
        }
        for (group, first_row) in colours.iter().enumerate().flat_map(|(part, colours)| {
            let first_row = division.rows(part).start as u32;
            colours.groups.iter().map(move |group| (group, first_row))
        }) {
            let mut block = Block {
                start,
                points: 0,
                twists: 0,
                bounces: false,
                resists: false,
                round: false,
                bodies_a: [0; WIDTH],
                bodies_b: [0; WIDTH],
                contacts: group.contacts,
            };
            for (lane, &index) in group.contacts.iter().enumerate() {
                if index == Group::EMPTY {
                    continue;
                }
                let contact = &contacts[index as usize];
                block.points = block.points.max(usize::from(contact.points));
                block.bounces |= contact.surface.bounces;
                block.resists |= contact.surface.resists;
                block.round |= contact.round;
                [block.bodies_a[lane], block.bodies_b[lane]] = contact.state_rows(first_row);
            }
            if block.points > 1 || block.resists {
                block.twists = Layout::<N>::TWISTS;
            }
            start += Layout::<N>::block_len(&block);
            self.blocks.push(block);
        }
        self.rows.resize(start, Lanes::ZERO);
        self.held.resize_with(self.blocks.len(), Held::default);
    }

    /// All contacts.
    pub(crate) fn whole<'a>(&'a mut self, state: &'a mut [Real]) -> Stretch<'a, N> {
        let Self { blocks, held, rows, problems } = self;
        Stretch { blocks, held, rows, state, problems }
    }
}

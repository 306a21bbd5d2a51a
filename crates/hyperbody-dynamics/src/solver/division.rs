//! Large worlds in parts, which threads solve at the same time.
//!
//! A colour of contacts is too little work to wake another thread for, and what threads find they have to put aside until the
//! colour is done. So the bodies of a large world are halved, in the order of their slots, and halved again down to parts of
//! [`SLOTS`] or more. What moves in a contact lies in one part, or on both sides of a cut: contacts across a cut are solved first,
//! then those of both sides at the same time, each in states of its own. In most scenes who was made together is together, and
//! few contacts are across.
//!
//! The division depends on the number of slots alone, and threads only on the division: the bits are the same for any number of
//! them.
//!
//! Parts and cuts are numbered from left to right: parts are even, and the cut between two neighbouring ranges of `2ʰ` parts
//! stands between them. A *range* is what lies on both sides of a cut, or one part.

use std::ops::Range;

use super::bodies::Sizes;
use super::colours::ActiveContact;
use super::contacts::{Block, Held, NormalProblem};
use super::lanes::{Lanes, Real};
use crate::threads::{Pool, both};

/// Slots of bodies that each part has at least.
const SLOTS: usize = 1500;

/// Where a part or cut ends in the lists that are in their order.
#[derive(Clone, Copy, Debug, Default)]
struct Ends {
    contacts: usize,
    blocks: usize,
}

/// The division of one step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Division {
    /// Slots of bodies a part.
    share: usize,
    /// First rows of the parts, each of which is no body's; then the number of rows.
    first_rows: Vec<usize>,
    /// By number of the part or cut.
    ends: Vec<Ends>,
    /// By contact, while they are collected: its part or cut.
    part_of: Vec<u32>,
    /// Room for sorting.
    places: Vec<usize>,
    sorted: Vec<ActiveContact>,
}

impl Division {
    /// Divides bodies in so many slots.
    pub(crate) fn divide(&mut self, slots: usize) {
        let parts = 1 << (slots / SLOTS).max(1).ilog2();
        self.share = slots.div_ceil(parts).max(1);
        self.first_rows.clear();
        self.first_rows.push(0);
        self.ends.clear();
        self.ends.resize(2 * parts - 1, Ends::default());
        self.part_of.clear();
    }

    /// Slots a part.
    pub(crate) fn share(&self) -> usize {
        self.share
    }

    /// First row of a part, or the number of rows; no body's.
    pub(crate) fn first_row(&self, part: usize) -> usize {
        self.first_rows[part]
    }

    /// Notes where the rows of the next part end.
    pub(crate) fn note_rows(&mut self, end: usize) {
        self.first_rows.push(end);
    }

    /// Parts.
    pub(crate) fn count(&self) -> usize {
        self.ends.len().div_ceil(2)
    }

    /// Parts and cuts.
    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    /// The cut through all, or the only part.
    pub(crate) fn root(&self) -> usize {
        self.len() / 2
    }

    /// Where a contact of bodies in these slots belongs: a part, or the cut between two.
    fn of(&self, slots: [u32; 2]) -> usize {
        let [a, b] = slots.map(|slot| slot as usize / self.share);
        let (low, high) = (a.min(b), a.max(b));
        if low == high {
            return 2 * low;
        }
        let halvings = (low ^ high).ilog2();
        ((high >> halvings) << (halvings + 1)) - 1
    }

    /// Parts in the range of a part or cut.
    fn range(part: usize) -> Range<usize> {
        let beside = (1 << part.trailing_ones()) - 1;
        (part - beside) / 2..(part + beside) / 2 + 1
    }

    /// Rows of bodies in the range of a part or cut.
    pub(crate) fn rows(&self, part: usize) -> Range<usize> {
        let range = Self::range(part);
        self.first_rows[range.start]..self.first_rows[range.end]
    }

    /// Notes the slots of what moves in the next contact.
    pub(crate) fn note_contact(&mut self, slots: [u32; 2]) {
        #[expect(clippy::cast_possible_truncation, reason = "no more parts than slots")]
        self.part_of.push(self.of(slots) as u32);
    }

    /// Puts the contacts that were noted in the order of their parts and cuts, without changing it within one of them.
    pub(crate) fn sort_contacts(&mut self, contacts: &mut Vec<ActiveContact>) {
        self.places.clear();
        self.places.resize(self.len(), 0);
        for &part in &self.part_of {
            self.places[part as usize] += 1;
        }
        let mut end = 0;
        for (ends, place) in self.ends.iter_mut().zip(&mut self.places) {
            let count = std::mem::replace(place, end);
            end += count;
            ends.contacts = end;
        }
        let (Some(&any), true) = (contacts.first(), self.ends.len() > 1) else { return };
        self.sorted.clear();
        self.sorted.resize(contacts.len(), any);
        for (contact, &part) in contacts.iter().zip(&self.part_of) {
            let place = &mut self.places[part as usize];
            self.sorted[*place] = *contact;
            *place += 1;
        }
        std::mem::swap(contacts, &mut self.sorted);
    }

    /// Notes where the blocks of a part or cut end.
    pub(crate) fn note_blocks(&mut self, part: usize, end: usize) {
        self.ends[part].blocks = end;
    }

    fn between(&self, part: usize, end: impl Fn(&Ends) -> usize) -> Range<usize> {
        let start = part.checked_sub(1).map_or(0, |before| end(&self.ends[before]));
        start..end(&self.ends[part])
    }

    /// Contacts of a part, or across a cut.
    pub(crate) fn contacts(&self, part: usize) -> Range<usize> {
        self.between(part, |ends| ends.contacts)
    }

    /// Their blocks.
    pub(crate) fn blocks(&self, part: usize) -> Range<usize> {
        self.between(part, |ends| ends.blocks)
    }

    /// Does some work on all contacts: on those across a cut first, then on both sides, at the same time where there are threads.
    /// The work gets the number of the part or cut.
    pub(crate) fn each<const N: usize>(
        &self,
        all: Stretch<'_, N>,
        pool: Option<&Pool>,
        work: &(dyn Fn(usize, Stretch<'_, N>) + Sync),
    ) {
        self.each_in::<N>(0..self.len(), all, pool, work);
    }

    fn each_in<const N: usize>(
        &self,
        numbers: Range<usize>,
        all: Stretch<'_, N>,
        pool: Option<&Pool>,
        work: &(dyn Fn(usize, Stretch<'_, N>) + Sync),
    ) {
        let cut = numbers.start + numbers.len() / 2;
        if numbers.len() == 1 {
            return work(cut, all);
        }
        let Stretch { blocks, held, rows, state, problems } = all;
        let first = self.blocks(numbers.start).start;
        let (left_blocks, others) = blocks.split_at(self.blocks(cut).start - first);
        let (cut_blocks, right_blocks) = others.split_at(self.blocks(cut).len());
        let (left_held, others) = held.split_at_mut(left_blocks.len());
        let (cut_held, right_held) = others.split_at_mut(cut_blocks.len());
        let end = blocks.first().map_or(0, |block| block.start) + rows.len();
        let right_start = right_blocks.first().map_or(end, |block| block.start);
        let cut_start = cut_blocks.first().map_or(right_start, |block| block.start);
        let (others, right_rows) = rows.split_at_mut(rows.len() - (end - right_start));
        let (left_rows, cut_rows) = others.split_at_mut(others.len() - (right_start - cut_start));
        work(cut, Stretch { blocks: cut_blocks, held: cut_held, rows: cut_rows, state, problems });
        let middle = self.first_rows[cut.div_ceil(2)] - self.first_rows[numbers.start / 2];
        let (left_state, right_state) = state.split_at_mut(middle * Sizes::<N>::STATE);
        let (left_problems, right_problems) = problems.split_at_mut(problems.len() / 2);
        let left = Stretch {
            blocks: left_blocks,
            held: left_held,
            rows: left_rows,
            state: left_state,
            problems: left_problems,
        };
        let right = Stretch {
            blocks: right_blocks,
            held: right_held,
            rows: right_rows,
            state: right_state,
            problems: right_problems,
        };
        both(
            pool,
            || self.each_in::<N>(numbers.start..cut, left, pool, work),
            || self.each_in::<N>(cut + 1..numbers.end, right, pool, work),
        );
    }
}

/// Contacts and bodies of a part or cut.
pub(crate) struct Stretch<'a, const N: usize> {
    pub(crate) blocks: &'a [Block],
    pub(crate) held: &'a mut [Held<N>],
    /// Of these blocks.
    pub(crate) rows: &'a mut [Lanes],
    /// Of the bodies in its range.
    pub(crate) state: &'a mut [Real],
    /// Room for one problem a part.
    pub(crate) problems: &'a mut [NormalProblem],
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parts and cuts by what they are: the numbers of the first and the last part in their range.
    #[test]
    fn parts_and_cuts_stand_from_left_to_right() {
        let ranges: Vec<_> = (0..7).map(Division::range).collect();
        assert_eq!(ranges, [0..1, 0..2, 1..2, 0..4, 2..3, 2..4, 3..4]);
    }

    #[test]
    fn a_contact_belongs_to_the_smallest_range_that_holds_what_moves_in_it() {
        let mut division = Division::default();
        division.divide(8 * SLOTS + 17);
        assert_eq!(division.len(), 15);
        let mut state = 7_u64;
        let mut slot = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as u32 % (8 * SLOTS as u32 + 17)
        };
        for _ in 0..1000 {
            let slots = [slot(), slot()];
            let holds = |part: usize| {
                slots.iter().all(|&slot| Division::range(part).contains(&(slot as usize / division.share())))
            };
            let smallest = (0..15).filter(|&part| holds(part)).min_by_key(|&part| Division::range(part).len());
            assert_eq!(Some(division.of(slots)), smallest, "{slots:?}");
        }
    }

    /// What tests of large worlds elsewhere rely on.
    #[test]
    fn worlds_of_three_thousand_slots_are_divided() {
        for (slots, parts) in [(3000, 2), (6200, 4)] {
            let mut division = Division::default();
            division.divide(slots);
            assert_eq!((division.count(), division.len()), (parts, 2 * parts - 1));
        }
    }

    #[test]
    fn small_worlds_are_one_part() {
        for slots in [0, 1, 2 * SLOTS - 1] {
            let mut division = Division::default();
            division.divide(slots);
            assert_eq!((division.len(), division.count(), division.root()), (1, 1, 0));
        }
    }
}

//! One sweep over all contacts, by one thread or by several.
//!
//! Parts of a large world are solved in place, each by one thread (`division.rs`). The contacts that all parts wait for, those of a
//! world that is one part, and those of a part that has most of them, go colour by colour: contacts of a colour share no body that moves,
//! so their order does not matter, and halves of them are solved at the same time. Threads then read the states of bodies as they were
//! before the colour and put what they find aside; when all are done it is put in place. So the bits don't depend on the number of threads.

use std::sync::{Mutex, PoisonError};

use super::normal::NormalProblem;
use super::pairing::{States, put_in_place, put_len};
use super::solve::Solve;
use super::{Block, PassTimes};
use crate::solver::colours::Colours;
use crate::solver::division::{Division, Stretch};
use crate::solver::lanes::{Lanes, Real};
use crate::solver::machine::Processor;
use crate::threads::Pool;

/// Blocks that one thread takes at a time: two to ten microseconds a block against some ten for waking a thread.
const SHARE: usize = 24;

/// Blocks of a step from which several threads are worth their while.
const MANY: usize = 128;

/// What a sweep needs.
#[derive(Clone, Copy)]
pub(crate) struct Sweep<'a> {
    pub(crate) processor: Processor,
    pub(crate) times: &'a PassTimes,
    pub(crate) division: &'a Division,
    /// Of each part and cut.
    pub(crate) colours: &'a [Colours],
    /// Room for states that threads put aside.
    pub(crate) aside: &'a Mutex<Vec<Lanes>>,
}

impl Sweep<'_> {
    /// Solves all contacts once.
    pub(crate) fn run<const N: usize>(&self, contacts: Stretch<'_, N>, pool: Option<&Pool>) {
        let all = contacts.blocks.len();
        let pool = pool.filter(|_| all >= MANY);
        self.division.each::<N>(contacts, pool, &|part, stretch: Stretch<'_, N>| match pool {
            // What all else waits for, and what all else is done before. There is one of each, so nobody waits for room.
            Some(pool) if part == self.division.root() || 2 * stretch.blocks.len() > all => {
                pool.install(|| self.by_colours::<N>(&self.colours[part].ends, stretch));
            }
            _ => self.in_place::<N>(stretch),
        });
    }

    fn in_place<const N: usize>(&self, contacts: Stretch<'_, N>) {
        let Stretch { blocks, rows, state, problems: [problem, ..], .. } = contacts else { return };
        self.processor.run(Solve::<N> { blocks, rows, problem, states: States::InPlace(state), times: self.times });
    }

    /// One colour after the other, large ones by all threads of the pool that this runs in.
    fn by_colours<const N: usize>(&self, ends: &[usize], contacts: Stretch<'_, N>) {
        let Stretch { blocks, rows, state, problems, .. } = contacts;
        let mut put = self.aside.lock().unwrap_or_else(PoisonError::into_inner);
        let first_lane = blocks.first().map_or(0, |block| block.start);
        let mut start = 0;
        for &end in ends {
            let colour = &blocks[start..end];
            let first_of_colour = colour.first().map_or(first_lane, |block| block.start);
            let next = blocks.get(end).map_or(first_lane + rows.len(), |block| block.start);
            let rows = &mut rows[first_of_colour - first_lane..next - first_lane];
            if colour.len() > SHARE {
                put.resize(colour.len() * put_len::<N>(), Lanes::ZERO);
                self.share::<N>(colour, rows, state, &mut put);
                put_in_place::<N>(colour, &put, state);
            } else {
                self.in_place::<N>(Stretch { blocks: colour, held: &mut [], rows, state, problems });
            }
            start = end;
        }
    }

    /// Solves blocks of one colour, halves of them at the same time.
    fn share<const N: usize>(&self, blocks: &[Block], rows: &mut [Lanes], read: &[Real], put: &mut [Lanes]) {
        if blocks.len() <= SHARE {
            let mut problem = NormalProblem::default();
            let states = States::Aside { read, put: put.iter_mut() };
            self.processor.run(Solve::<N> { blocks, rows, problem: &mut problem, states, times: self.times });
            return;
        }
        let (one, other) = blocks.split_at(blocks.len() / 2);
        let (rows_of_one, rows_of_other) = rows.split_at_mut(other[0].start - one[0].start);
        let (put_of_one, put_of_other) = put.split_at_mut(one.len() * put_len::<N>());
        rayon::join(
            || self.share::<N>(one, rows_of_one, read, put_of_one),
            || self.share::<N>(other, rows_of_other, read, put_of_other),
        );
    }
}

//! Joints of a cluster that are eliminated together, as one small full matrix: a *front* (I. S. Duff and J. K. Reid, 1983).
//!
//! A front has the rows of its own joints and of those around them. What its elimination changes among the latter, its *update*, is
//! added to the next front of the tree. So all arithmetic is on full matrices, in which vectors of numbers stand side by side.
//! Neighbours in the tree that have nearly the same joints around them become one front, with some zeros in it.
//!
//! Columns of a front stand one behind the other: its own rows, then those around, with zeros up to whole vectors.

use std::ops::Range;

use super::cluster::number;
use super::elimination::Elimination;
use crate::solver::lanes::WIDTH;

/// What a front costs beside its multiplications, and what each number of its update costs to hand on, in multiplications.
const OVERHEAD: u64 = 600;
const HANDED_ON: u64 = 6;

/// Columns of an update that are computed side by side.
pub(super) const SIDE_BY_SIDE: usize = 4;

/// One front. Numbers of unknowns are those within the cluster.
#[derive(Clone, Debug)]
pub(super) struct Front {
    /// Joints that it eliminates, as nodes of the plan.
    pub(super) nodes: Range<u32>,
    /// Its first own unknown.
    pub(super) first: u32,
    pub(super) own: u32,
    /// The unknowns around, in lists of the plan: which they are, and which rows of the next front.
    pub(super) later: Range<u32>,
    /// Fronts whose updates it takes, in a list of the plan.
    pub(super) children: Range<u32>,
    /// Couplings of its own joints with others.
    pub(super) couplings: Range<u32>,
    /// Where its columns stand among all values.
    pub(super) values: u32,
    /// Where its update stands while it is needed.
    pub(super) update: u32,
}

impl Front {
    pub(super) fn own(&self) -> usize {
        self.own as usize
    }

    /// Unknowns around.
    pub(super) fn around(&self) -> usize {
        self.later.len()
    }

    /// Numbers from one column of the update to the next.
    pub(super) fn update_stride(&self) -> usize {
        self.around().next_multiple_of(WIDTH)
    }

    /// Numbers from one own column to the next.
    pub(super) fn stride(&self) -> usize {
        self.own() + self.update_stride()
    }

    pub(super) fn panel(&self) -> Range<usize> {
        let start = self.values as usize;
        start..start + self.own() * self.stride()
    }

    pub(super) fn update(&self) -> Range<usize> {
        let start = self.update as usize;
        start..start + self.around().next_multiple_of(SIDE_BY_SIDE) * self.update_stride()
    }
}

/// Fronts of a cluster before their numbers have places: places of links in the order of elimination.
pub(super) struct Draft {
    pub(super) places: Range<u32>,
    pub(super) around: Vec<u32>,
    own: u32,
    later: u32,
}

impl Draft {
    /// Twice the multiplications, about.
    fn cost(own: u32, later: u32) -> u64 {
        let around = u64::from(later.next_multiple_of(number(WIDTH)));
        let eliminated: u64 = (0..u64::from(own)).map(|left| (around + left) * (around + left)).sum();
        eliminated + HANDED_ON * around * around + OVERHEAD
    }

    /// Takes in the front before it, if that is a branch of it and saves time.
    fn merge(&mut self, before: &Self) -> bool {
        let is_branch = before.around.first().is_some_and(|parent| self.places.contains(parent));
        let apart = Self::cost(before.own, before.later) + Self::cost(self.own, self.later);
        let merged = is_branch && Self::cost(before.own + self.own, self.later) <= apart;
        if merged {
            self.places.start = before.places.start;
            self.own += before.own;
        }
        merged
    }
}

/// The fronts of an elimination. `rows` are the rows of each place.
pub(super) fn drafts(elimination: &Elimination, rows: &[u32]) -> Vec<Draft> {
    let mut drafts: Vec<Draft> = Vec::new();
    for (place, around) in elimination.around.iter().enumerate() {
        let later = around.iter().map(|&other| rows[other as usize]).sum();
        let places = number(place)..number(place + 1);
        let mut draft = Draft { places, around: around.clone(), own: rows[place], later };
        while drafts.last().is_some_and(|before| draft.merge(before)) {
            drafts.pop();
        }
        drafts.push(draft);
    }
    drafts
}

/// Room for updates, each of which is needed from its making until the next front has taken it.
#[derive(Default)]
pub(super) struct Room {
    free: Vec<Range<u32>>,
    /// Numbers in all.
    pub(super) len: u32,
}

impl Room {
    pub(super) fn take(&mut self, count: u32) -> u32 {
        if let Some(hole) = self.free.iter_mut().find(|hole| hole.end - hole.start >= count) {
            hole.start += count;
            return hole.start - count;
        }
        self.len += count;
        self.len - count
    }

    pub(super) fn give_back(&mut self, range: Range<usize>) {
        let at = self.free.partition_point(|hole| (hole.start as usize) < range.start);
        self.free.insert(at, number(range.start)..number(range.end));
        self.free.dedup_by(|next, hole| {
            let joined = hole.end == next.start;
            if joined {
                hole.end = next.end;
            }
            joined
        });
        self.free.retain(|hole| !hole.is_empty());
    }
}

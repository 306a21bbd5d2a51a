//! The order in which the unknowns of a cluster are eliminated.
//!
//! Eliminating a joint makes neighbours of all its neighbours; the next joint is always one with fewest rows around it (minimum
//! degree: W. F. Tinney and J. W. Walker, 1967), for trees from the leaves inwards. Who waits for whom is a tree; its branches
//! are put one behind the other, which costs nothing and lets neighbours in the tree be eliminated together (`fronts`).

use std::collections::BTreeSet;

use super::cluster::{Link, number};

/// Multiplications, about, that eliminate `rows` unknowns with `around` unknowns left around them.
pub(super) fn cost(rows: u32, around: u32) -> u64 {
    let all = u64::from(rows + around);
    all * all * u64::from(rows)
}

/// The order of elimination, and who is around each when its turn comes.
#[derive(Debug)]
pub(super) struct Elimination {
    /// Links, the first to be eliminated first.
    pub(super) order: Vec<u32>,
    /// By place in that order: the places of those that are around then, in order.
    pub(super) around: Vec<Vec<u32>>,
    /// Pairs of places that share a body, each once, the earlier first.
    pub(super) pairs: Vec<(u32, u32)>,
}

impl Elimination {
    /// Of a link that is solved by itself.
    pub(super) fn of_one() -> Self {
        Self { order: vec![0], around: vec![Vec::new()], pairs: Vec::new() }
    }

    /// Nothing if it would cost more than the budget.
    pub(super) fn new(links: &[Link], budget: u64) -> Option<Self> {
        if dearest_body(links) > budget {
            return None;
        }
        let pairs = pairs(links);
        let mut around: Vec<Vec<u32>> = vec![Vec::new(); links.len()];
        for &(i, j) in &pairs {
            around[i as usize].push(j);
            around[j as usize].push(i);
        }
        around.iter_mut().for_each(|others| others.sort_unstable());
        let rows_around = |others: &[u32]| others.iter().map(|&other| links[other as usize].rows).sum::<u32>();
        let mut left: BTreeSet<(u32, u32)> =
            around.iter().enumerate().map(|(index, others)| (rows_around(others), number(index))).collect();
        let mut order = Vec::with_capacity(links.len());
        let mut spent = 0;
        while let Some((rows, index)) = left.pop_first() {
            spent += cost(links[index as usize].rows, rows);
            if spent > budget {
                return None;
            }
            order.push(index);
            let others = around[index as usize].clone();
            for &other in &others {
                let mine = &mut around[other as usize];
                left.remove(&(rows_around(mine), other));
                mine.extend(&others);
                mine.sort_unstable();
                mine.dedup();
                mine.retain(|&one| one != other && one != index);
                left.insert((rows_around(mine), other));
            }
        }
        Some(Self::by_branches(&order, around, &pairs))
    }

    /// Puts the branches of the tree one behind the other. `around` and `pairs` are numbers of links.
    fn by_branches(order: &[u32], mut around: Vec<Vec<u32>>, pairs: &[(u32, u32)]) -> Self {
        let old_place = places(order);
        // The next of those around to be eliminated is the parent.
        let mut children: Vec<Vec<u32>> = vec![Vec::new(); order.len()];
        let mut waiting = Vec::new();
        for &link in order.iter().rev() {
            match around[link as usize].iter().min_by_key(|&&other| old_place[other as usize]) {
                Some(&parent) => children[parent as usize].push(link),
                None => waiting.push(link),
            }
        }
        // From the roots inwards, to be turned round.
        let mut branches = Vec::with_capacity(order.len());
        while let Some(link) = waiting.pop() {
            branches.push(link);
            waiting.extend(children[link as usize].iter().rev());
        }
        branches.reverse();
        let place = places(&branches);
        let placed = |others: Vec<u32>| {
            let mut others: Vec<u32> = others.iter().map(|&other| place[other as usize]).collect();
            others.sort_unstable();
            others
        };
        Self {
            around: branches.iter().map(|&link| placed(std::mem::take(&mut around[link as usize]))).collect(),
            pairs: pairs
                .iter()
                .map(|&(i, j)| (place[i as usize], place[j as usize]))
                .map(|(i, j)| (i.min(j), i.max(j)))
                .collect(),
            order: branches,
        }
    }
}

/// The place of each link.
fn places(order: &[u32]) -> Vec<u32> {
    let mut places = vec![0; order.len()];
    for (place, &link) in order.iter().enumerate() {
        places[link as usize] = number(place);
    }
    places
}

/// Multiplications, about, that the joints of one body cost at least: sooner or later they are all neighbours.
fn dearest_body(links: &[Link]) -> u64 {
    let mut ends: Vec<(u32, u64)> = links
        .iter()
        .flat_map(|link| link.bodies.map(|body| (body, u64::from(link.rows))))
        .filter(|&(body, _)| body != 0)
        .collect();
    ends.sort_unstable();
    let of_body = ends.chunk_by(|one, other| one.0 == other.0);
    let rows = of_body.map(|ends| ends.iter().map(|&(_, rows)| rows).sum::<u64>()).max().unwrap_or(0);
    rows.saturating_mul(rows).saturating_mul(rows) / 3
}

/// Pairs of links that share a body that moves.
fn pairs(links: &[Link]) -> Vec<(u32, u32)> {
    let mut ends: Vec<(u32, u32)> = links
        .iter()
        .enumerate()
        .flat_map(|(index, link)| link.bodies.map(|body| (body, number(index))))
        .filter(|&(body, _)| body != 0)
        .collect();
    ends.sort_unstable();
    ends.dedup();
    let mut pairs: Vec<(u32, u32)> = ends
        .chunk_by(|one, other| one.0 == other.0)
        .flat_map(|of_body| {
            of_body.iter().enumerate().flat_map(|(k, one)| of_body[..k].iter().map(move |other| (other.1, one.1)))
        })
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

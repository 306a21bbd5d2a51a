//! Which joints are solved together, and where the numbers of their linear systems stand.
//!
//! Joints that share a moving body answer to each other. A connected set of joints is one *cluster* when its linear system can be
//! factored at little cost: chains, trees, ragdolls, cars, small loops and nets. Its solution is then exact, however long the chain
//! and however unequal the masses. Nets of ball joints for which that would cost too much are swept (`nets`), and what else there is, is solved
//! joint by joint.
//!
//! The system is K x = y with a block for each pair of joints that share a body (K = J M⁻¹ Jᵀ). The plan depends on who is jointed
//! to whom alone, and is kept while that stays the same.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use super::elimination::{Elimination, cost};
use super::fronts::{Front, Room, drafts};
use super::nets::NetPlan;

/// A joint as the plan sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Link {
    /// Which of those with something to do.
    pub(super) joint: u32,
    /// Whether it is solved by itself: soft joints, which have a strength of their own.
    pub(super) apart: bool,
    /// Whether some of its rows have a range: limits, motors, springs.
    pub(super) bounded: bool,
    /// Whether nets may have it, see `nets`.
    pub(super) plain: bool,
    /// Its bodies, counted from 1; 0 for what impulses do not move. They are counted by joints, so that bodies which have none
    /// change nothing here.
    pub(super) bodies: [u32; 2],
    pub(super) rows: u32,
}

/// A joint within its cluster.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Which of those that are not swept.
    pub(super) joint: u32,
    pub(super) rows: u32,
    /// Where its unknowns stand in the vector of its cluster.
    pub(super) unknowns: u32,
}

impl Node {
    /// Its part of a vector of its cluster.
    pub(super) fn of<'a>(&self, unknowns: &'a mut [f64]) -> &'a mut [f64] {
        &mut unknowns[self.unknowns as usize..][..self.rows as usize]
    }
}

/// Two joints of a cluster that share a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coupling {
    /// Where their block stands in the front of the earlier: its first column and row.
    pub(super) column: u32,
    pub(super) row: u32,
    /// The joints, as nodes of the plan.
    pub(super) later: u32,
    pub(super) earlier: u32,
    /// Whether the shared body is the second of the later and of the earlier joint.
    pub(super) second: [bool; 2],
}

/// Joints that are solved together.
#[derive(Clone, Debug)]
pub(super) struct Cluster {
    pub(super) nodes: Range<u32>,
    pub(super) fronts: Range<u32>,
    pub(super) unknowns: u32,
    /// Whether some of its rows have a range.
    pub(super) bounded: bool,
    /// Whether it is all that its bodies are jointed by, so that its solution is the solution.
    pub(super) whole: bool,
}

/// How joints hang together, with bodies counted as they appear: all that an order of elimination follows from.
type Pattern = Vec<([u32; 2], u32, [bool; 2])>;

/// The order of everything.
#[derive(Clone, Debug, Default)]
pub(super) struct Plan {
    links: Vec<Link>,
    budget: u64,
    /// Those in use, or that the budget does not allow: when one joint is changed, the orders of the others stay good.
    eliminations: BTreeMap<Pattern, Option<Arc<Elimination>>>,
    pub(super) clusters: Vec<Cluster>,
    pub(super) nodes: Vec<Node>,
    fronts: Vec<Front>,
    couplings: Vec<Coupling>,
    /// By front: unknowns around, and their rows in the next front.
    later: Vec<u32>,
    into: Vec<u32>,
    children: Vec<u32>,
    /// What is swept.
    pub(super) nets: NetPlan,
    /// Numbers of all clusters, and of the updates that any of them needs at a time.
    pub(super) values: u32,
    pub(super) updates: u32,
}

/// How much dearer than a chain of as many joints a cluster may be in any case: trees and small loops.
const CHEAP: u64 = 16;

/// Multiplications that are always afforded: a hub with twenty spokes.
const NOTHING: u64 = 200_000;

/// How much dearer it may be at all, if the budget allows: a net of 20 × 20 is at 90. Limits and motors need new factors whenever they
/// engage, so with some of them [`CHEAP`] is the end.
const DEAR: u64 = 128;

/// The part of the budget that nets get which can be swept instead.
const SPARED: u64 = 50;

impl Plan {
    /// Makes the plan of these links, unless it is the plan already. The budget is in multiplications.
    pub(super) fn update(&mut self, links: &[Link], bodies: usize, budget: f64) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, which is as good")]
        let budget = budget as u64;
        if self.links == links && self.budget == budget {
            return;
        }
        let mut known = std::mem::take(&mut self.eliminations);
        if self.budget != budget {
            known.clear();
        }
        *self = Self { links: links.to_vec(), budget, ..Self::default() };
        let (apart, together): (Vec<Link>, Vec<Link>) = links.iter().partition(|link| link.apart);
        for link in apart {
            self.add_alone(link);
        }
        let mut swept = Vec::new();
        for component in components(&together, bodies) {
            let pattern = pattern(&component);
            let elimination = match self.eliminations.get(&pattern) {
                Some(elimination) => elimination.clone(),
                None => known.remove(&pattern).unwrap_or_else(|| eliminate(&component, budget)),
            };
            match &elimination {
                Some(elimination) => self.add(&component, elimination, true),
                None if component.iter().all(|link| link.plain) => swept.extend(component),
                None => component.iter().for_each(|link| self.add_alone(*link)),
            }
            self.eliminations.insert(pattern, elimination);
        }
        swept.sort_unstable_by_key(|link| link.joint);
        self.nets = NetPlan::new(&swept);
        for node in &mut self.nodes {
            node.joint -= self.nets.joints_before(node.joint);
        }
    }

    fn add_alone(&mut self, link: Link) {
        self.add(&[link], &Elimination::of_one(), false);
    }

    pub(super) fn nodes_of(&self, cluster: &Cluster) -> &[Node] {
        part(&self.nodes, &cluster.nodes)
    }

    pub(super) fn fronts_of(&self, cluster: &Cluster) -> &[Front] {
        part(&self.fronts, &cluster.fronts)
    }

    pub(super) fn nodes_in(&self, front: &Front) -> &[Node] {
        part(&self.nodes, &front.nodes)
    }

    pub(super) fn couplings_of(&self, front: &Front) -> &[Coupling] {
        part(&self.couplings, &front.couplings)
    }

    pub(super) fn children_of(&self, front: &Front) -> impl Iterator<Item = &Front> {
        part(&self.children, &front.children).iter().map(|&child| &self.fronts[child as usize])
    }

    /// The unknowns around a front.
    pub(super) fn around(&self, front: &Front) -> &[u32] {
        part(&self.later, &front.later)
    }

    /// The rows of the next front that they are.
    pub(super) fn rows_in_next(&self, front: &Front) -> &[u32] {
        part(&self.into, &front.later)
    }

    fn add(&mut self, links: &[Link], elimination: &Elimination, whole: bool) {
        let (first_node, first_front) = (len(&self.nodes), len(&self.fronts));
        let mut unknowns = 0;
        for &index in &elimination.order {
            let link = &links[index as usize];
            self.nodes.push(Node { joint: link.joint, rows: link.rows, unknowns });
            unknowns += link.rows;
        }
        self.add_fronts(elimination, first_node);
        self.find_couplings(links, elimination, (first_node, first_front));
        self.clusters.push(Cluster {
            nodes: first_node..len(&self.nodes),
            fronts: first_front..len(&self.fronts),
            unknowns,
            bounded: links.iter().any(|link| link.bounded),
            whole,
        });
    }

    fn add_fronts(&mut self, elimination: &Elimination, first_node: u32) {
        let nodes = &self.nodes[first_node as usize..];
        let rows: Vec<u32> = nodes.iter().map(|node| node.rows).collect();
        let mut room = Room::default();
        // Fronts that wait for the next one of the tree, which comes behind them.
        let mut waiting: Vec<u32> = Vec::new();
        for draft in drafts(elimination, &rows) {
            let own = &nodes[draft.places.start as usize..draft.places.end as usize];
            let later = len(&self.later);
            for node in draft.around.iter().map(|&place| &nodes[place as usize]) {
                self.later.extend(node.unknowns..node.unknowns + node.rows);
            }
            self.into.resize(self.later.len(), 0);
            let children = len(&self.children);
            let mut front = Front {
                nodes: first_node + draft.places.start..first_node + draft.places.end,
                first: own[0].unknowns,
                own: own.iter().map(|node| node.rows).sum(),
                later: later..len(&self.later),
                children: children..children,
                couplings: 0..0,
                values: self.values,
                update: 0,
            };
            self.values += number(front.panel().len());
            front.update = room.take(number(front.update().len()));
            while let Some(&child) = waiting.last()
                && self.is_child(&self.fronts[child as usize], &front)
            {
                waiting.pop();
                self.children.push(child);
                let child = &self.fronts[child as usize];
                room.give_back(child.update());
                for at in child.later.clone() {
                    self.into[at as usize] = self.row_of(self.later[at as usize], &front);
                }
            }
            front.children.end = len(&self.children);
            waiting.push(len(&self.fronts));
            self.fronts.push(front);
        }
        self.updates = self.updates.max(room.len);
    }

    fn is_child(&self, front: &Front, next: &Front) -> bool {
        self.around(front).first().is_some_and(|&unknown| (next.first..next.first + next.own).contains(&unknown))
    }

    /// Which row of a front an unknown is.
    fn row_of(&self, unknown: u32, front: &Front) -> u32 {
        if unknown < front.first + front.own {
            return unknown - front.first;
        }
        let at = self.around(front).binary_search(&unknown).expect("elimination made them neighbours");
        front.own + number(at)
    }

    fn find_couplings(&mut self, links: &[Link], elimination: &Elimination, (first_node, first_front): (u32, u32)) {
        let mut pairs = elimination.pairs.clone();
        pairs.sort_unstable();
        let link = |place: u32| &links[elimination.order[place as usize] as usize];
        let mut pairs = pairs.into_iter().peekable();
        for index in first_front as usize..self.fronts.len() {
            let front = self.fronts[index].clone();
            let first = len(&self.couplings);
            while let Some((early, late)) = pairs.next_if(|&(early, _)| first_node + early < front.nodes.end) {
                let (earlier, later) = (first_node + early, first_node + late);
                let column = self.nodes[earlier as usize].unknowns - front.first;
                let row = self.row_of(self.nodes[later as usize].unknowns, &front);
                for (side, &body) in link(late).bodies.iter().enumerate() {
                    for (other_side, &other) in link(early).bodies.iter().enumerate() {
                        if body == other && body != 0 {
                            let second = [side == 1, other_side == 1];
                            self.couplings.push(Coupling { column, row, later, earlier, second });
                        }
                    }
                }
            }
            self.fronts[index].couplings = first..len(&self.couplings);
        }
    }
}

/// An order for links that hang together, unless it would cost too much.
fn eliminate(component: &[Link], budget: u64) -> Option<Arc<Elimination>> {
    let in_a_chain: u64 = component.iter().map(|link| cost(link.rows, link.rows)).sum();
    let bounded = component.iter().any(|link| link.bounded);
    let plain = component.iter().all(|link| link.plain);
    let most = if bounded { 0 } else { (if plain { budget / SPARED } else { budget }).min(DEAR * in_a_chain) };
    Elimination::new(component, most.max(CHEAP * in_a_chain).max(NOTHING)).map(Arc::new)
}

fn pattern(component: &[Link]) -> Pattern {
    let mut seen = BTreeMap::from([(0, 0)]);
    let mut count = |body: u32| {
        let next = number(seen.len());
        *seen.entry(body).or_insert(next)
    };
    component.iter().map(|link| (link.bodies.map(&mut count), link.rows, [link.bounded, link.plain])).collect()
}

/// Links that hang together through moving bodies, in the order of their first links.
fn components(links: &[Link], bodies: usize) -> Vec<Vec<Link>> {
    let mut sets = Sets::new(bodies);
    for link in links {
        if link.bodies.iter().all(|&body| body != 0) {
            sets.unite(link.bodies[0], link.bodies[1]);
        }
    }
    let mut component_of = vec![u32::MAX; bodies];
    let mut components: Vec<Vec<Link>> = Vec::new();
    for link in links {
        let body = link.bodies[0].max(link.bodies[1]);
        let root = sets.root(body) as usize;
        if component_of[root] == u32::MAX || body == 0 {
            component_of[root] = len(&components);
            components.push(Vec::new());
        }
        components[component_of[root] as usize].push(*link);
    }
    components
}

/// Disjoint sets of bodies.
struct Sets(Vec<u32>);

impl Sets {
    fn new(count: usize) -> Self {
        Self((0..number(count)).collect())
    }

    fn root(&mut self, mut one: u32) -> u32 {
        while self.0[one as usize] != one {
            self.0[one as usize] = self.0[self.0[one as usize] as usize];
            one = self.0[one as usize];
        }
        one
    }

    /// Whether they were apart.
    fn unite(&mut self, one: u32, other: u32) -> bool {
        let (one, other) = (self.root(one), self.root(other));
        self.0[one.max(other) as usize] = one.min(other);
        one != other
    }
}

#[expect(clippy::cast_possible_truncation, reason = "joints and their numbers are counted in u32")]
pub(super) fn number(index: usize) -> u32 {
    index as u32
}

fn len<T>(list: &[T]) -> u32 {
    number(list.len())
}

fn part<'a, T>(list: &'a [T], range: &Range<u32>) -> &'a [T] {
    &list[range.start as usize..range.end as usize]
}

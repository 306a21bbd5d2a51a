//! Which joints are solved together, and in which order their unknowns are eliminated.
//!
//! Joints that share a moving body answer to each other. A connected set of joints is one *cluster* when its linear system can be
//! factored at little cost: chains, trees, ragdolls, cars and small loops. Its solution is then exact, however long the chain
//! and however unequal the masses. The joints of a large net are solved one by one instead.
//!
//! The system is K x = y with a block for each pair of joints that share a body (K = J M⁻¹ Jᵀ). Eliminating a joint makes neighbours of all
//! its neighbours; the next joint is always one with fewest rows around it (minimum degree: W. F. Tinney and J. W. Walker, 1967), for trees
//! from the leaves inwards. The plan depends on who is jointed to whom alone, and is kept while that stays the same.

use std::collections::BTreeSet;
use std::ops::Range;

/// A joint as the plan sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Link {
    /// Which joint.
    pub(super) joint: u32,
    /// Whether it is solved by itself: soft joints, which have a strength of their own.
    pub(super) apart: bool,
    /// Whether some of its rows have a range: limits, motors, springs.
    pub(super) bounded: bool,
    /// Places of its bodies, counted from 1; 0 for what impulses do not move. Places are counted by joints, so that bodies which have none
    /// change nothing here.
    pub(super) bodies: [u32; 2],
    pub(super) rows: u32,
}

/// An off-diagonal block: what a joint eliminated later has to do with an earlier one.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockOf {
    /// The later one, as a node of the plan.
    pub(super) node: u32,
    /// Its first column in the matrix of the earlier one.
    pub(super) column: u32,
}

/// A joint within its cluster.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) joint: u32,
    pub(super) rows: u32,
    /// Where its unknowns stand in the vector of its cluster.
    pub(super) unknowns: u32,
    /// Its diagonal block: a lower triangle by rows. Its matrix follows.
    pub(super) diagonal: u32,
    /// Columns of its matrix: rows of all joints that are eliminated later and have something to do with it then.
    pub(super) later: u32,
    pub(super) blocks: Range<u32>,
    /// Offsets that its elimination changes: for each block p and each q ≤ p of its blocks, that of the pair's block.
    targets: u32,
}

impl Node {
    /// Where its matrix stands: a row for each of its own rows, a column for each later one.
    pub(super) fn matrix(&self) -> usize {
        (self.diagonal + self.rows * (self.rows + 1) / 2) as usize
    }

    /// Its part of a vector of its cluster.
    pub(super) fn of<'a>(&self, unknowns: &'a mut [f64]) -> &'a mut [f64] {
        &mut unknowns[self.unknowns as usize..][..self.rows as usize]
    }
}

/// Two joints of a cluster that share a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coupling {
    pub(super) offset: u32,
    pub(super) later: u32,
    pub(super) earlier: u32,
    /// Place of the shared body, counted from 1.
    pub(super) body: u32,
    /// Whether the shared body is the second of the later and of the earlier joint.
    pub(super) second: [bool; 2],
}

/// Joints that are solved together.
#[derive(Clone, Debug)]
pub(super) struct Cluster {
    pub(super) nodes: Range<u32>,
    pub(super) couplings: Range<u32>,
    /// Its numbers.
    pub(super) values: Range<u32>,
    pub(super) unknowns: u32,
    /// Whether some of its rows have a range.
    pub(super) bounded: bool,
    /// Whether it is all that its bodies are jointed by, so that its solution is the solution.
    pub(super) whole: bool,
}

/// The order of everything.
#[derive(Clone, Debug, Default)]
pub(super) struct Plan {
    links: Vec<Link>,
    budget: u64,
    pub(super) clusters: Vec<Cluster>,
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<BlockOf>,
    pub(super) couplings: Vec<Coupling>,
    targets: Vec<u32>,
    /// Numbers of all clusters.
    pub(super) values: u32,
}

/// How much dearer than a chain of as many joints a cluster may be in any case: trees and small loops.
const CHEAP: u64 = 16;

/// Multiplications that are always afforded: a hub with twenty spokes.
const NOTHING: u64 = 200_000;

/// How much dearer it may be at all, if the budget allows: a net of 20 × 20 is at 90. Limits and motors need new factors whenever they
/// engage, so with some of them [`CHEAP`] is the end.
const DEAR: u64 = 128;

impl Plan {
    /// Makes the plan of these links, unless it is the plan already. The budget is in multiplications.
    pub(super) fn update(&mut self, links: &[Link], bodies: usize, budget: f64) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, which is as good")]
        let budget = budget as u64;
        if self.links == links && self.budget == budget {
            return;
        }
        *self = Self { links: links.to_vec(), budget, ..Self::default() };
        let (apart, together): (Vec<Link>, Vec<Link>) = links.iter().partition(|link| link.apart);
        for link in apart {
            self.add_alone(link);
        }
        for component in components(&together, bodies) {
            let in_a_chain: u64 = component.iter().map(|link| cost(link.rows, link.rows)).sum();
            let bounded = component.iter().any(|link| link.bounded);
            let most = if bounded { 0 } else { budget.min(DEAR * in_a_chain) };
            match Elimination::new(&component, most.max(CHEAP * in_a_chain).max(NOTHING)) {
                Some(elimination) => self.add(&component, &elimination, true),
                None => component.iter().for_each(|link| self.add_alone(*link)),
            }
        }
    }

    fn add_alone(&mut self, link: Link) {
        let alone = Elimination { order: vec![0], around: vec![Vec::new()], pairs: Vec::new() };
        self.add(&[link], &alone, false);
    }

    pub(super) fn nodes_of(&self, cluster: &Cluster) -> &[Node] {
        &self.nodes[cluster.nodes.start as usize..cluster.nodes.end as usize]
    }

    pub(super) fn blocks_of(&self, node: &Node) -> &[BlockOf] {
        &self.blocks[node.blocks.start as usize..node.blocks.end as usize]
    }

    /// The offset of the block of two of a node's neighbours, the p-th and the q-th ≤ p.
    pub(super) fn target(&self, node: &Node, p: usize, q: usize) -> usize {
        self.targets[node.targets as usize + p * (p + 1) / 2 + q] as usize
    }

    fn add(&mut self, links: &[Link], elimination: &Elimination, whole: bool) {
        let first = self.nodes.len();
        let start = self.values;
        let couplings = len(&self.couplings);
        let mut unknowns = 0;
        let mut position = vec![0; links.len()];
        for (at, &index) in elimination.order.iter().enumerate() {
            position[index as usize] = at;
        }
        for &index in &elimination.order {
            let link = &links[index as usize];
            let diagonal = self.values;
            self.values += link.rows * (link.rows + 1) / 2;
            let mut around: Vec<usize> =
                elimination.around[index as usize].iter().map(|&other| position[other as usize]).collect();
            around.sort_unstable();
            let blocks = len(&self.blocks);
            let mut later = 0;
            for other in around {
                self.blocks.push(BlockOf { node: number(first + other), column: later });
                later += links[elimination.order[other] as usize].rows;
            }
            self.values += later * link.rows;
            let blocks = blocks..len(&self.blocks);
            self.nodes.push(Node { joint: link.joint, rows: link.rows, unknowns, diagonal, later, blocks, targets: 0 });
            unknowns += link.rows;
        }
        self.find_targets(first);
        self.find_couplings(links, elimination, &position, first);
        self.clusters.push(Cluster {
            nodes: number(first)..len(&self.nodes),
            couplings: couplings..len(&self.couplings),
            values: start..self.values,
            unknowns,
            bounded: links.iter().any(|link| link.bounded),
            whole,
        });
    }

    fn find_targets(&mut self, first: usize) {
        for index in first..self.nodes.len() {
            self.nodes[index].targets = len(&self.targets);
            let blocks = self.nodes[index].blocks.clone();
            for p in blocks.clone() {
                for q in blocks.start..=p {
                    let (later, earlier) = (self.blocks[p as usize].node, self.blocks[q as usize].node);
                    let offset = self.offset(later, earlier);
                    self.targets.push(offset);
                }
            }
        }
    }

    /// The block of two nodes that are neighbours when the earlier is eliminated.
    fn offset(&self, later: u32, earlier: u32) -> u32 {
        let node = &self.nodes[earlier as usize];
        if later == earlier {
            return node.diagonal;
        }
        let blocks = self.blocks_of(node);
        let at = blocks.binary_search_by_key(&later, |block| block.node).expect("elimination made them neighbours");
        number(node.matrix()) + blocks[at].column
    }

    fn find_couplings(&mut self, links: &[Link], elimination: &Elimination, position: &[usize], first: usize) {
        for &(i, j) in &elimination.pairs {
            let (late, early) = if position[i as usize] > position[j as usize] { (i, j) } else { (j, i) };
            let (later, earlier) = (number(first + position[late as usize]), number(first + position[early as usize]));
            let offset = self.offset(later, earlier);
            for (side, &body) in links[late as usize].bodies.iter().enumerate() {
                for (other_side, &other) in links[early as usize].bodies.iter().enumerate() {
                    if body == other && body != 0 {
                        let second = [side == 1, other_side == 1];
                        self.couplings.push(Coupling { offset, later, earlier, body, second });
                    }
                }
            }
        }
    }
}

/// Multiplications, about, that eliminate `rows` unknowns with `around` unknowns left around them.
fn cost(rows: u32, around: u32) -> u64 {
    let all = u64::from(rows + around);
    all * all * u64::from(rows)
}

/// The order of elimination, and who is around each when its turn comes.
struct Elimination {
    order: Vec<u32>,
    around: Vec<Vec<u32>>,
    /// Pairs that share a body, each once, smaller number first.
    pairs: Vec<(u32, u32)>,
}

impl Elimination {
    /// Nothing if it would cost more than the budget.
    fn new(links: &[Link], budget: u64) -> Option<Self> {
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
        Some(Self { order, around, pairs })
    }
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
    rows * rows * rows / 3
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
fn number(index: usize) -> u32 {
    index as u32
}

fn len<T>(list: &[T]) -> u32 {
    number(list.len())
}

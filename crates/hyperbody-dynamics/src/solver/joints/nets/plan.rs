//! Which joints of nets are swept side by side: those that share no moving body.
//!
//! They are coloured greedily in their order, as contacts are (`colours.rs`). Within a colour the order does not matter, so the result depends
//! neither on the width of vectors nor on who is whose neighbour in them.

use crate::solver::joints::cluster::{Link, number};
use crate::solver::lanes::WIDTH;

/// Joints that are solved side by side.
#[derive(Clone, Copy, Debug)]
pub(in crate::solver::joints) struct Block {
    /// Joints of the plan; [`Block::EMPTY`] in unused lanes.
    pub(super) joints: [u32; WIDTH],
    /// Their bodies, as bodies of the plan; 0 for what impulses do not move.
    pub(super) a: [u32; WIDTH],
    pub(super) b: [u32; WIDTH],
}

impl Block {
    pub(super) const EMPTY: u32 = u32::MAX;
}

/// All nets: each is swept as if it were alone.
#[derive(Clone, Debug, Default)]
pub(in crate::solver::joints) struct NetPlan {
    /// Which joints, in ascending order.
    pub(in crate::solver::joints) joints: Vec<u32>,
    /// By body: its number in the links; the first stands for what impulses do not move.
    pub(super) bodies: Vec<u32>,
    pub(super) blocks: Vec<Block>,
    /// After how many blocks each colour ends.
    pub(super) ends: Vec<usize>,
}

const COLOURS: u32 = u64::BITS;

impl NetPlan {
    /// Of links in ascending order of their joints.
    pub(in crate::solver::joints) fn new(links: &[Link]) -> Self {
        let mut plan = Self { joints: links.iter().map(|link| link.joint).collect(), ..Self::default() };
        plan.bodies = links.iter().flat_map(|link| link.bodies).chain([0]).collect();
        plan.bodies.sort_unstable();
        plan.bodies.dedup();
        let mut colours = plan.colour(links);
        // A body with more joints than there are colours: the rest one by one.
        let crowded: Vec<Vec<u32>> = colours.pop().into_iter().flatten().map(|joint| vec![joint]).collect();
        for colour in colours.iter().chain(&crowded).filter(|colour| !colour.is_empty()) {
            for joints in colour.chunks(WIDTH) {
                let block = plan.block(links, joints);
                plan.blocks.push(block);
            }
            plan.ends.push(plan.blocks.len());
        }
        plan
    }

    /// How many of its joints stand before another.
    pub(in crate::solver::joints) fn joints_before(&self, other: u32) -> u32 {
        number(self.joints.partition_point(|&joint| joint < other))
    }

    /// Joints by colour; those that no colour has room for come last.
    fn colour(&self, links: &[Link]) -> Vec<Vec<u32>> {
        let mut used = vec![0_u64; self.bodies.len()];
        let mut colours = vec![Vec::new(); COLOURS as usize + 1];
        for (joint, link) in links.iter().enumerate() {
            let bodies = link.bodies.map(|body| self.body(body));
            let taken = bodies.iter().filter(|&&body| body != 0).fold(0, |taken, &body| taken | used[body as usize]);
            let colour = taken.trailing_ones();
            colours[colour as usize].push(number(joint));
            if colour < COLOURS {
                bodies.iter().for_each(|&body| used[body as usize] |= 1 << colour);
            }
        }
        colours
    }

    fn body(&self, in_links: u32) -> u32 {
        self.bodies.binary_search(&in_links).map_or(0, number)
    }

    fn block(&self, links: &[Link], joints: &[u32]) -> Block {
        let mut block = Block { joints: [Block::EMPTY; WIDTH], a: [0; WIDTH], b: [0; WIDTH] };
        for (lane, &joint) in joints.iter().enumerate() {
            let [a, b] = links[joint as usize].bodies.map(|body| self.body(body));
            (block.joints[lane], block.a[lane], block.b[lane]) = (joint, a, b);
        }
        block
    }
}

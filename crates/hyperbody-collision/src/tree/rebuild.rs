//! Building the tree anew, from the root down.
//!
//! Incremental insertion is greedy and decays when much has moved. The rebuild sorts the leaves into a few bins along
//! the axis of largest spread and cuts where the two halves cost least (binned surface heuristic; Wald 2007).

use hyperbody_geometry::Aabb;
use hyperbody_math::Vector;

use super::{DynamicTree, NONE, Node, State};

/// Bins per cut: finer ones gain nothing measurable.
const BINS: usize = 16;

/// Trees below this many leaves are never worth rebuilding.
const SMALLEST_REBUILT: u32 = 16;

/// A tree this much worse than right after its last rebuild is rebuilt.
const DECAY: f64 = 1.3;

/// Leaves that still have to be put below one inner node.
struct Task {
    start: usize,
    end: usize,
    parent: u32,
    slot: usize,
}

impl<const N: usize> DynamicTree<N> {
    /// Whether so much has moved that a rebuild would pay. Looks at the whole tree only once for every change of all
    /// leaves, so that asking is free on average.
    pub fn should_rebuild(&mut self) -> bool {
        if self.leaf_count < SMALLEST_REBUILT || self.changes < 2 * self.leaf_count {
            return false;
        }
        self.changes = 0;
        self.rebuilt_quality.is_infinite() || self.quality() > DECAY * self.rebuilt_quality
    }

    /// Builds the inner nodes anew. Proxies stay valid.
    pub fn rebuild(&mut self) {
        let mut leaves: Vec<u32> = Vec::with_capacity(self.len());
        for index in 0..self.nodes.len() as u32 {
            match self.nodes[index as usize].state {
                State::Leaf => leaves.push(index),
                State::Inner => self.release(index),
                State::Free => {}
            }
        }
        self.root = NONE;
        let mut inner: Vec<u32> = Vec::with_capacity(leaves.len());
        let mut tasks = Vec::new();
        if !leaves.is_empty() {
            tasks.push(Task { start: 0, end: leaves.len(), parent: NONE, slot: 0 });
        }
        // Every task makes one node of the new tree.
        while let Some(task) = tasks.pop() {
            let index = if task.end - task.start == 1 {
                leaves[task.start]
            } else {
                self.new_inner(&mut leaves, &task, &mut tasks, &mut inner)
            };
            self.nodes[index as usize].parent = task.parent;
            if task.parent == NONE {
                self.root = index;
            } else {
                self.nodes[task.parent as usize].children[task.slot] = index;
            }
        }
        // Parents were made before their children.
        for &index in inner.iter().rev() {
            self.refit(index);
        }
        self.changes = 0;
        self.rebuilt_quality = self.quality();
    }

    fn new_inner(&mut self, leaves: &mut [u32], task: &Task, tasks: &mut Vec<Task>, inner: &mut Vec<u32>) -> u32 {
        let cut = task.start + self.split(&mut leaves[task.start..task.end]);
        let nothing = Aabb { lower: Vector::ZERO, upper: Vector::ZERO };
        let node = Node { aabb: nothing, parent: NONE, children: [NONE; 2], user: 0, height: 0, state: State::Inner };
        let index = self.allocate(node);
        inner.push(index);
        tasks.push(Task { start: task.start, end: cut, parent: index, slot: 0 });
        tasks.push(Task { start: cut, end: task.end, parent: index, slot: 1 });
        index
    }

    /// Reorders at least two leaves and returns how many go to the first half; at least one goes to either.
    fn split(&self, leaves: &mut [u32]) -> usize {
        let centre = |leaf: u32| self.nodes[leaf as usize].aabb.centre();
        let mut lower = centre(leaves[0]);
        let mut upper = lower;
        for &leaf in leaves.iter() {
            lower = lower.min(centre(leaf));
            upper = upper.max(centre(leaf));
        }
        let spread = upper - lower;
        let along = spread.axis_of_max_abs();
        let halfway = leaves.len() / 2;
        // Coincident centres, or a spread that is no number: any cut will do.
        if !(spread[along] > 0.0 && spread[along].is_finite()) {
            return halfway;
        }
        let bin_of = |leaf: u32| {
            let place = (centre(leaf)[along] - lower[along]) / spread[along];
            ((place * BINS as f64) as usize).min(BINS - 1)
        };
        let Some(cut) = self.best_cut(leaves, bin_of) else { return halfway };
        // A stable partition, so that the order depends on the operations alone.
        let (before, after): (Vec<u32>, Vec<u32>) = leaves.iter().partition(|&&leaf| bin_of(leaf) < cut);
        leaves[..before.len()].copy_from_slice(&before);
        leaves[before.len()..].copy_from_slice(&after);
        before.len()
    }

    /// The bin before which to cut so that the two halves, each weighed by its leaves, are smallest.
    fn best_cut(&self, leaves: &[u32], bin_of: impl Fn(u32) -> usize) -> Option<usize> {
        let mut bins: [Option<(usize, Aabb<N>)>; BINS] = [None; BINS];
        for &leaf in leaves {
            let bin = &mut bins[bin_of(leaf)];
            *bin = merged(*bin, Some((1, self.nodes[leaf as usize].aabb)));
        }
        let mut after = [None; BINS];
        let mut gathered = None;
        for bin in (0..BINS).rev() {
            gathered = merged(gathered, bins[bin]);
            after[bin] = gathered;
        }
        let mut before = None;
        let mut best: Option<(f64, usize)> = None;
        for cut in 1..BINS {
            before = merged(before, bins[cut - 1]);
            let (Some(first), Some(second)) = (before, after[cut]) else { continue };
            let cost = first.0 as f64 * first.1.edge_sum() + second.0 as f64 * second.1.edge_sum();
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, cut));
            }
        }
        best.map(|(_, cut)| cut)
    }
}

/// Leaves counted and boxes joined.
fn merged<const N: usize>(a: Option<(usize, Aabb<N>)>, b: Option<(usize, Aabb<N>)>) -> Option<(usize, Aabb<N>)> {
    match (a, b) {
        (Some((count_a, box_a)), Some((count_b, box_b))) => Some((count_a + count_b, box_a.union(&box_b))),
        (a, None) => a,
        (None, b) => b,
    }
}

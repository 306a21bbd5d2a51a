//! The broad phase: a binary tree of axis-aligned boxes that follows moving bodies.
//!
//! Each leaf is one box given by the caller, usually fattened so that a body can move a little before its leaf has to.
//! A new leaf goes to the place that adds least to the total size of the inner boxes, found by one greedy descent, and
//! on the way back up neighbours are exchanged where that makes a box smaller (tree rotations; Kensler 2008, and the
//! form for collision trees of Catto 2019). Size is the sum of the edge lengths, see [`Aabb::edge_sum`].
//!
//! Half-spaces have no finite box: the caller keeps them apart and tests them against everything.
//!
//! The order of results depends on nothing but the sequence of operations. Queries take their stack from the caller
//! and so allocate nothing once it has grown.

mod ray;
mod rays;
mod rebuild;
mod stored;

pub use ray::RayStack;
pub use rays::RayTree;

use hyperbody_geometry::Aabb;
use hyperbody_math::Vector;

/// No node.
const NONE: u32 = u32::MAX;

#[derive(Clone, Debug)]
struct Node<const N: usize> {
    aabb: Aabb<N>,
    /// Parent of a node in use; next free node of a free one.
    parent: u32,
    /// Both [`NONE`] for a leaf.
    children: [u32; 2],
    user: u32,
    /// Largest number of steps to a leaf below.
    height: u32,
    state: State,
}

impl<const N: usize> Node<N> {
    const EMPTY: Self = Self {
        aabb: Aabb { lower: Vector::ZERO, upper: Vector::ZERO },
        parent: NONE,
        children: [NONE; 2],
        user: 0,
        height: 0,
        state: State::Free,
    };
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Free,
    Leaf,
    Inner,
}

/// Boxes that come, go and move, and the question which of them overlap.
#[derive(Clone, Debug)]
pub struct DynamicTree<const N: usize> {
    nodes: Vec<Node<N>>,
    root: u32,
    free: u32,
    leaf_count: u32,
    /// Insertions and removals since the last rebuild or check.
    changes: u32,
    /// [`DynamicTree::quality`] right after the last rebuild; infinite before the first.
    rebuilt_quality: f64,
}

impl<const N: usize> DynamicTree<N> {
    /// An empty tree.
    #[must_use]
    pub fn new() -> Self {
        Self { nodes: Vec::new(), root: NONE, free: NONE, leaf_count: 0, changes: 0, rebuilt_quality: f64::INFINITY }
    }

    /// Number of boxes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.leaf_count as usize
    }

    /// Whether there is no box.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.leaf_count == 0
    }

    /// Adds a box with a number of the caller's, which queries report. Returns the proxy that names the box until it
    /// is removed; proxies of removed boxes are used again.
    pub fn insert(&mut self, aabb: Aabb<N>, user: u32) -> u32 {
        let leaf = self.allocate(Node { aabb, parent: NONE, children: [NONE; 2], user, height: 0, state: State::Leaf });
        self.leaf_count += 1;
        self.attach(leaf);
        leaf
    }

    /// Removes a box. A proxy that names none changes nothing.
    pub fn remove(&mut self, proxy: u32) {
        if self.is_leaf(proxy) {
            self.detach(proxy);
            self.release(proxy);
            self.leaf_count -= 1;
        }
    }

    /// Moves a box to a new place in the tree. A proxy that names none changes nothing.
    pub fn update(&mut self, proxy: u32, aabb: Aabb<N>) {
        if self.is_leaf(proxy) {
            self.detach(proxy);
            self.nodes[proxy as usize].aabb = aabb;
            self.attach(proxy);
        }
    }

    /// The box of a proxy, as it was given.
    ///
    /// # Panics
    /// If the proxy was never handed out.
    #[inline]
    #[must_use]
    pub fn aabb(&self, proxy: u32) -> &Aabb<N> {
        &self.nodes[proxy as usize].aabb
    }

    /// The caller's number of a proxy.
    ///
    /// # Panics
    /// If the proxy was never handed out.
    #[inline]
    #[must_use]
    pub fn user(&self, proxy: u32) -> u32 {
        self.nodes[proxy as usize].user
    }

    /// Calls `f` with the caller's number of every box that has a point in common with `aabb`, until it returns
    /// `false`. `stack` is working memory; its contents are lost.
    #[inline]
    pub fn for_each_overlap(&self, aabb: &Aabb<N>, stack: &mut Vec<u32>, mut f: impl FnMut(u32) -> bool) {
        stack.clear();
        if self.root != NONE {
            stack.push(self.root);
        }
        // Every node is pushed at most once, by its only parent.
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if !node.aabb.overlaps(aabb) {
                continue;
            }
            if node.state == State::Leaf {
                if !f(node.user) {
                    return;
                }
            } else {
                stack.extend_from_slice(&node.children);
            }
        }
    }

    /// Memory that its nodes take, bytes.
    #[must_use]
    pub fn memory(&self) -> usize {
        size_of_val(&*self.nodes)
    }

    /// Total size of the inner boxes in parts of the root's: the expected cost of a query, up to a constant. Zero for
    /// fewer than two boxes. Costs one pass over the tree.
    #[must_use]
    pub fn quality(&self) -> f64 {
        if self.leaf_count < 2 {
            return 0.0;
        }
        let inner = self.nodes.iter().filter(|node| node.state == State::Inner);
        let total: f64 = inner.map(|node| node.aabb.edge_sum()).sum();
        total / self.nodes[self.root as usize].aabb.edge_sum().max(f64::MIN_POSITIVE)
    }

    /// Largest number of steps from the root to a box.
    #[must_use]
    pub fn height(&self) -> u32 {
        if self.root == NONE { 0 } else { self.nodes[self.root as usize].height }
    }

    fn is_leaf(&self, proxy: u32) -> bool {
        self.nodes.get(proxy as usize).is_some_and(|node| node.state == State::Leaf)
    }

    fn allocate(&mut self, node: Node<N>) -> u32 {
        if self.free == NONE {
            self.nodes.push(node);
            (self.nodes.len() - 1) as u32
        } else {
            let index = self.free;
            self.free = self.nodes[index as usize].parent;
            self.nodes[index as usize] = node;
            index
        }
    }

    fn release(&mut self, index: u32) {
        let node = &mut self.nodes[index as usize];
        node.state = State::Free;
        node.parent = self.free;
        self.free = index;
    }

    /// Puts a leaf without parent into the tree.
    fn attach(&mut self, leaf: u32) {
        self.changes = self.changes.saturating_add(1);
        if self.root == NONE {
            self.root = leaf;
            self.nodes[leaf as usize].parent = NONE;
            return;
        }
        let aabb = self.nodes[leaf as usize].aabb;
        let sibling = self.best_sibling(&aabb);
        let old_parent = self.nodes[sibling as usize].parent;
        let joined = self.nodes[sibling as usize].aabb.union(&aabb);
        let height = self.nodes[sibling as usize].height + 1;
        let inner =
            Node { aabb: joined, parent: old_parent, children: [sibling, leaf], user: 0, height, state: State::Inner };
        let new_parent = self.allocate(inner);
        self.nodes[sibling as usize].parent = new_parent;
        self.nodes[leaf as usize].parent = new_parent;
        self.replace_child(old_parent, sibling, new_parent);
        self.refit_upwards(old_parent);
    }

    /// Takes a leaf out of the tree; the leaf itself stays allocated.
    fn detach(&mut self, leaf: u32) {
        self.changes = self.changes.saturating_add(1);
        let parent = self.nodes[leaf as usize].parent;
        if parent == NONE {
            self.root = NONE;
            return;
        }
        let [first, second] = self.nodes[parent as usize].children;
        let sibling = if first == leaf { second } else { first };
        let grandparent = self.nodes[parent as usize].parent;
        self.nodes[sibling as usize].parent = grandparent;
        self.replace_child(grandparent, parent, sibling);
        self.release(parent);
        self.refit_upwards(grandparent);
    }

    /// Makes `new` the child of `parent` in place of `old`; without parent it becomes the root.
    fn replace_child(&mut self, parent: u32, old: u32, new: u32) {
        if parent == NONE {
            self.root = new;
        } else {
            let slot = usize::from(self.nodes[parent as usize].children[1] == old);
            self.nodes[parent as usize].children[slot] = new;
        }
    }

    /// The node beside which a box adds least to the total size of the inner boxes, along one greedy path from the
    /// root. The path is at most as long as the tree is high.
    fn best_sibling(&self, aabb: &Aabb<N>) -> u32 {
        let mut index = self.root;
        // What the boxes passed on the way down grow by.
        let mut inherited = 0.0;
        loop {
            let node = &self.nodes[index as usize];
            if node.state != State::Inner {
                return index;
            }
            let union = node.aabb.union(aabb).edge_sum();
            let here = inherited + union;
            inherited += union - node.aabb.edge_sum();
            let costs = node.children.map(|child| {
                let child = &self.nodes[child as usize];
                let union = child.aabb.union(aabb).edge_sum();
                // Below an inner child the new inner box will be at least as large as the new leaf.
                let growth =
                    if child.state == State::Leaf { union } else { union - child.aabb.edge_sum() + aabb.edge_sum() };
                (growth + inherited, union)
            });
            if here < costs[0].0 && here < costs[1].0 {
                return index;
            }
            index = node.children[usize::from(self.second_is_better(node.children, costs, aabb))];
        }
    }

    /// Which child to descend into: the cheaper, then the one whose box would be smaller, then the one whose centre is
    /// closer, then the lower, so that coincident boxes make no list.
    fn second_is_better(&self, children: [u32; 2], costs: [(f64, f64); 2], aabb: &Aabb<N>) -> bool {
        if costs[0].0 != costs[1].0 {
            return costs[1].0 < costs[0].0;
        }
        if costs[0].1 != costs[1].1 {
            return costs[1].1 < costs[0].1;
        }
        let [first, second] = children.map(|child| {
            let offset: Vector<N> = self.nodes[child as usize].aabb.centre() - aabb.centre();
            (offset.norm_sq(), self.nodes[child as usize].height)
        });
        if first.0 == second.0 { second.1 < first.1 } else { second.0 < first.0 }
    }

    /// Makes boxes right and better from `index` to the root.
    fn refit_upwards(&mut self, mut index: u32) {
        while index != NONE {
            self.refit(index);
            self.rotate(index);
            index = self.nodes[index as usize].parent;
        }
    }

    /// Box and height of an inner node from its children's.
    fn refit(&mut self, index: u32) {
        let [first, second] = self.nodes[index as usize].children.map(|child| &self.nodes[child as usize]);
        let (aabb, height) = (first.aabb.union(&second.aabb), first.height.max(second.height) + 1);
        let node = &mut self.nodes[index as usize];
        (node.aabb, node.height) = (aabb, height);
    }

    /// Exchanges one child of `index` with one grandchild on the other side if the box between them shrinks.
    fn rotate(&mut self, index: u32) {
        let children = self.nodes[index as usize].children;
        // (gain, side whose box shrinks, slot of the grandchild that leaves it)
        let mut best: Option<(f64, usize, usize)> = None;
        for side in 0..2 {
            let shrinking = &self.nodes[children[side] as usize];
            if shrinking.state != State::Inner {
                continue;
            }
            let size = shrinking.aabb.edge_sum();
            let uncle = &self.nodes[children[1 - side] as usize].aabb;
            for slot in 0..2 {
                let stays = &self.nodes[shrinking.children[1 - slot] as usize].aabb;
                let gain = size - stays.union(uncle).edge_sum();
                if gain > 0.0 && best.is_none_or(|(most, _, _)| gain > most) {
                    best = Some((gain, side, slot));
                }
            }
        }
        let Some((_, side, slot)) = best else { return };
        let (shrinking, uncle) = (children[side], children[1 - side]);
        let leaver = self.nodes[shrinking as usize].children[slot];
        self.nodes[shrinking as usize].children[slot] = uncle;
        self.nodes[uncle as usize].parent = shrinking;
        self.refit(shrinking);
        self.nodes[index as usize].children[1 - side] = leaver;
        self.nodes[leaver as usize].parent = index;
        self.refit(index);
    }

    /// Checks every rule that the tree keeps, for tests and debug builds.
    ///
    /// # Errors
    /// The first rule found broken.
    pub fn validate(&self) -> Result<(), String> {
        let mut seen = (0, 0);
        let mut stack = vec![];
        if self.root != NONE {
            stack.push((self.root, NONE));
        }
        while let Some((index, parent)) = stack.pop() {
            let node = &self.nodes[index as usize];
            if node.parent != parent {
                return Err(format!("node {index} names parent {} but hangs on {parent}", node.parent));
            }
            match node.state {
                State::Free => return Err(format!("node {index} is free but in the tree")),
                State::Leaf => seen.0 += 1,
                State::Inner => {
                    seen.1 += 1;
                    let [first, second] = node.children.map(|child| &self.nodes[child as usize]);
                    if node.aabb != first.aabb.union(&second.aabb) {
                        return Err(format!("the box of node {index} is not the union of its children's"));
                    }
                    if node.height != first.height.max(second.height) + 1 {
                        return Err(format!("node {index} has height {}", node.height));
                    }
                    stack.extend(node.children.map(|child| (child, index)));
                }
            }
        }
        let inner = self.nodes.iter().filter(|node| node.state == State::Inner).count();
        if seen.0 != self.leaf_count as usize || seen.1 != inner || inner != seen.0.saturating_sub(1) {
            return Err(format!("{seen:?} leaves and inner nodes reached, {} and {inner} kept", self.leaf_count));
        }
        Ok(())
    }
}

impl<const N: usize> Default for DynamicTree<N> {
    fn default() -> Self {
        Self::new()
    }
}

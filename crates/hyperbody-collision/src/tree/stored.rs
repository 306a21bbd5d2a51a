//! The tree as bytes, node by node: which nodes are free, and how the others hang together, decides what later insertions do.

use hyperbody_geometry::bytes::{BytesError, Reader, Stored, Writer};
use hyperbody_geometry::stored_choice;

use super::{DynamicTree, NONE, Node, State};

stored_choice!(State { Free = 0, Leaf = 1, Inner = 2 });

impl<const N: usize> Stored for Node<N> {
    fn write(&self, out: &mut Writer) {
        self.state.write(out);
        self.parent.write(out);
        match self.state {
            // What it held is forgotten, but for the box that takes its place anyway.
            State::Free => {}
            State::Leaf => (self.user, self.aabb).write(out),
            State::Inner => (self.children, (self.height, self.aabb)).write(out),
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let (state, parent) = Stored::read(from)?;
        let mut node = Self { parent, state, ..Self::EMPTY };
        match state {
            State::Free => {}
            State::Leaf => (node.user, node.aabb) = Stored::read(from)?,
            State::Inner => (node.children, (node.height, node.aabb)) = Stored::read(from)?,
        }
        Ok(node)
    }
}

impl<const N: usize> Stored for DynamicTree<N> {
    fn write(&self, out: &mut Writer) {
        out.length(self.nodes.len());
        self.nodes.iter().for_each(|node| node.write(out));
        ((self.root, self.free), (self.leaf_count, self.changes)).write(out);
        hyperbody_geometry::bytes::Wide(self.rebuilt_quality).write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let nodes = Stored::read(from)?;
        let ((root, free), (leaf_count, changes)) = Stored::read(from)?;
        let rebuilt_quality = hyperbody_geometry::bytes::Wide::read(from)?.0;
        let tree = Self { nodes, root, free, leaf_count, changes, rebuilt_quality };
        tree.check_links()
            .and_then(|()| tree.validate())
            .map_err(|reason| from.error(format!("the tree: {reason}")))?;
        Ok(tree)
    }
}

impl<const N: usize> DynamicTree<N> {
    /// What has to hold so that [`DynamicTree::validate`] finds its way: links lead to nodes, no node hangs on two, and the free
    /// ones form one list.
    fn check_links(&self) -> Result<(), String> {
        let is_node = |index: u32| (index as usize) < self.nodes.len();
        if self.root != NONE && !is_node(self.root) {
            return Err(format!("its root is node {}, which is not there", self.root));
        }
        let mut hangs = vec![false; self.nodes.len()];
        for node in self.nodes.iter().filter(|node| node.state == State::Inner) {
            if node.height as usize >= self.nodes.len() {
                return Err(format!("a node is {} steps high among {}", node.height, self.nodes.len()));
            }
            for child in node.children {
                if !is_node(child) || std::mem::replace(&mut hangs[child as usize], true) {
                    return Err(format!("node {child} is not there, or hangs on two others"));
                }
            }
        }
        let (mut next, mut count) = (self.free, 0);
        // Ends at the latest when every node has been counted.
        while next != NONE && count <= self.nodes.len() {
            let node = self.nodes.get(next as usize).filter(|node| node.state == State::Free);
            next = node.ok_or_else(|| format!("node {next} is listed as free"))?.parent;
            count += 1;
        }
        let free = self.nodes.iter().filter(|node| node.state == State::Free).count();
        if count != free {
            return Err(format!("{free} nodes are free, and {count} are listed"));
        }
        Ok(())
    }

    /// Proxy, number of the caller's and box of everything in the tree.
    pub fn leaves(&self) -> impl Iterator<Item = (u32, u32, &hyperbody_geometry::Aabb<N>)> {
        let numbered = self.nodes.iter().enumerate().filter(|(_, node)| node.state == State::Leaf);
        numbered.map(|(index, node)| (index as u32, node.user, &node.aabb))
    }
}

//! A picture of the tree for many rays: nothing but boxes, in the order in which rays walk.
//!
//! A node of the dynamic tree lies somewhere and holds one box; a step down reads two of them and much that only updates
//! need. Here a node holds the boxes of both children side by side, axis by axis, so that one pass over little memory
//! tests both, two lanes at a time; and children follow their parents.

use hyperbody_geometry::Aabb;
use hyperbody_math::Vector;

use super::ray::RayStack;
use super::{DynamicTree, NONE, State};
use crate::limits::RAY_BOX_SLACK;
use crate::ray::Ray;

/// Marks a child that is a leaf: the rest is the caller's number.
const LEAF: u32 = 1 << 31;

/// Two children.
#[derive(Clone, Copy, Debug)]
struct Twins<const N: usize> {
    /// Lower and upper ends by axis and child.
    lower: [[f64; 2]; N],
    upper: [[f64; 2]; N],
    children: [u32; 2],
}

/// The boxes of a [`DynamicTree`] as they were when it was made, for rays.
#[derive(Clone, Debug, Default)]
pub struct RayTree<const N: usize> {
    nodes: Vec<Twins<N>>,
    /// The only child of a tree of one.
    single: Option<(Aabb<N>, u32)>,
}

impl<const N: usize> DynamicTree<N> {
    /// A picture of the tree in which every box is what `tight` answers for the caller's number and the box that the tree
    /// holds, such as a tighter one. Numbers have to lie below 2³¹.
    #[must_use]
    pub fn for_rays(&self, mut tight: impl FnMut(u32, &Aabb<N>) -> Aabb<N>) -> RayTree<N> {
        let mut picture = RayTree { nodes: Vec::with_capacity(self.len().saturating_sub(1)), single: None };
        if self.root == NONE {
            return picture;
        }
        let root = &self.nodes[self.root as usize];
        if root.state == State::Leaf {
            picture.single = Some((tight(root.user, &root.aabb), root.user));
            return picture;
        }
        // (node, where its parent keeps it); every node is pushed once, by its only parent.
        let mut stack = vec![(self.root, None)];
        while let Some((index, place)) = stack.pop() {
            let here = picture.nodes.len();
            if let Some((parent, side)) = place {
                let parent: &mut Twins<N> = &mut picture.nodes[parent];
                parent.children[side] = here as u32;
            }
            let mut twins = Twins { lower: [[0.0; 2]; N], upper: [[0.0; 2]; N], children: [0; 2] };
            for (side, child) in self.nodes[index as usize].children.into_iter().enumerate().rev() {
                let node = &self.nodes[child as usize];
                if node.state == State::Leaf {
                    twins.children[side] = LEAF | node.user;
                    twins.set(side, &tight(node.user, &node.aabb));
                } else {
                    stack.push((child, Some((here, side))));
                }
            }
            picture.nodes.push(twins);
        }
        picture.refit();
        picture
    }
}

impl<const N: usize> Twins<N> {
    fn set(&mut self, side: usize, aabb: &Aabb<N>) {
        for i in 0..N {
            (self.lower[i][side], self.upper[i][side]) = (aabb.lower.0[i], aabb.upper.0[i]);
        }
    }

    /// The box around both.
    fn joined(&self) -> Aabb<N> {
        Aabb {
            lower: Vector::from_fn(|i| self.lower[i][0].min(self.lower[i][1])),
            upper: Vector::from_fn(|i| self.upper[i][0].max(self.upper[i][1])),
        }
    }

    /// Where a ray enters each of the two boxes: 0 from inside, ∞ if it misses it up to `reach`. Where a ray runs in a face
    /// of a box, 0·∞ is NaN, which no comparison takes: the face does not exclude it.
    #[inline]
    fn entries(&self, origin: &Vector<N>, inverse: &Vector<N>, reach: f64) -> [f64; 2] {
        let (mut enter, mut exit) = ([0.0; 2], [reach; 2]);
        for i in 0..N {
            let (from, factor) = (origin.0[i], inverse.0[i]);
            let (near, far) =
                if factor < 0.0 { (&self.upper[i], &self.lower[i]) } else { (&self.lower[i], &self.upper[i]) };
            for side in 0..2 {
                let into = (near[side] - from) * factor;
                let out = (far[side] - from) * factor;
                enter[side] = if into > enter[side] { into } else { enter[side] };
                exit[side] = if out < exit[side] { out } else { exit[side] };
            }
        }
        [0, 1].map(|side| if enter[side] <= exit[side] * (1.0 + RAY_BOX_SLACK) { enter[side] } else { f64::INFINITY })
    }
}

impl<const N: usize> RayTree<N> {
    /// Makes inner boxes fit: children come after their parents.
    fn refit(&mut self) {
        for index in (0..self.nodes.len()).rev() {
            for side in 0..2 {
                let child = self.nodes[index].children[side];
                if child & LEAF == 0 {
                    let joined = self.nodes[child as usize].joined();
                    self.nodes[index].set(side, &joined);
                }
            }
        }
    }

    /// [`DynamicTree::cast_ray`] on the picture.
    pub fn cast_ray(&self, ray: &Ray<N>, stack: &mut RayStack, mut visit: impl FnMut(u32, f64) -> Option<f64>) {
        if !ray.is_valid() {
            return;
        }
        let inverse = Vector(ray.direction.0.map(|component| 1.0 / component));
        let mut reach = ray.max_fraction;
        let entries = &mut stack.entries;
        entries.clear();
        let mut next = match &self.single {
            Some((aabb, user)) => {
                let mut twins = Twins { lower: [[0.0; 2]; N], upper: [[0.0; 2]; N], children: [LEAF | *user; 2] };
                twins.set(0, aabb);
                (twins.entries(&ray.origin, &inverse, reach)[0], LEAF | *user)
            }
            None if self.nodes.is_empty() => return,
            None => (0.0, 0),
        };
        // Every node is looked at once, from its only parent.
        loop {
            let (begins, index) = next;
            if begins <= reach * (1.0 + RAY_BOX_SLACK) && begins < f64::INFINITY {
                if index & LEAF == 0 {
                    let twins = &self.nodes[index as usize];
                    let [first, second] = twins.entries(&ray.origin, &inverse, reach);
                    let [child_first, child_second] = twins.children;
                    let far = if second < first {
                        next = (second, child_second);
                        (first, child_first)
                    } else {
                        next = (first, child_first);
                        (second, child_second)
                    };
                    if far.0 < f64::INFINITY {
                        entries.push(far);
                    }
                    continue;
                }
                match visit(index & !LEAF, reach) {
                    Some(closer) => reach = if closer < reach { closer } else { reach },
                    None => return,
                }
            }
            let Some(popped) = entries.pop() else { return };
            next = popped;
        }
    }
}

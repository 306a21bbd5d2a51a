//! What is near the pieces of a body.
//!
//! The pieces of one body are neighbours of each other for ever, and those of a star polytope all meet in its centre: asked one
//! by one, thousands of them find each other millions of times, only for all of that to be dropped. So the surroundings of a body
//! of many pieces are looked up once, and its pieces compared with what is of other bodies there. In free fall that is nothing.

use hyperbody_geometry::Aabb;

use crate::World;

/// Pieces up to which they are looked up one by one: looking at the surroundings first saves nothing.
const FEW_PIECES: usize = 8;

/// Buffers, kept from step to step.
#[derive(Debug)]
pub(crate) struct Near<const N: usize> {
    /// Of walks through the tree.
    pub(crate) stack: Vec<u32>,
    /// Bodies to be looked at.
    pub(crate) bodies: Vec<u32>,
    /// Pieces of one of them with boxes to be searched.
    pub(crate) boxes: Vec<(u32, Aabb<N>)>,
    /// Pieces of others around them, with their fattened boxes.
    others: Vec<(u32, Aabb<N>)>,
}

impl<const N: usize> Default for Near<N> {
    fn default() -> Self {
        Self { stack: Vec::new(), bodies: Vec::new(), boxes: Vec::new(), others: Vec::new() }
    }
}

impl<const N: usize> World<N> {
    pub(crate) fn has_many_pieces(&self, body: u32) -> bool {
        self.bodies.at(body).is_some_and(|body| body.colliders.len() > FEW_PIECES)
    }

    /// Calls `found` with each piece in `near.boxes`, which are of `body`, and each convex collider of another body whose fattened
    /// box overlaps its box, in no particular order. With few pieces those of the same body come too.
    pub(crate) fn for_each_near(&self, body: u32, near: &mut Near<N>, mut found: impl FnMut(u32, u32)) {
        let Near { stack, boxes, others, .. } = near;
        if boxes.len() <= FEW_PIECES {
            for &(slot, aabb) in &*boxes {
                self.tree.for_each_overlap(&aabb, stack, |other| {
                    found(slot, other);
                    true
                });
            }
            return;
        }
        let is_other = |slot: u32| self.colliders[slot as usize].as_ref().filter(|other| other.body != body);
        others.clear();
        let Some(whole) = union(boxes) else { return };
        self.tree.for_each_overlap(&whole, stack, |slot| {
            others.extend(is_other(slot).map(|other| (slot, other.fat_aabb)));
            others.len() <= boxes.len()
        });
        let Some(surroundings) = union(others) else { return };
        if others.len() > boxes.len() {
            // Among so many the tree finds those of each piece sooner.
            for &(slot, aabb) in &*boxes {
                self.tree.for_each_overlap(&aabb, stack, |other| {
                    if is_other(other).is_some() {
                        found(slot, other);
                    }
                    true
                });
            }
            return;
        }
        for &(slot, aabb) in boxes.iter().filter(|(_, aabb)| aabb.overlaps(&surroundings)) {
            others.iter().filter(|(_, other)| aabb.overlaps(other)).for_each(|&(other, _)| found(slot, other));
        }
    }
}

fn union<const N: usize>(boxes: &[(u32, Aabb<N>)]) -> Option<Aabb<N>> {
    boxes.iter().map(|&(_, aabb)| aabb).reduce(|all, aabb| all.union(&aabb))
}

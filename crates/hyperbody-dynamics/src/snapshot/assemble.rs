//! What follows from the stored state, made anew: colliders from shapes, lists of joints from joints. And the checks that go
//! with it, so that every index a step follows leads somewhere.

use hyperbody_geometry::Aabb;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::Vector;

use super::Snapshot;
use super::bytes::{Placed, SnapshotError};
use crate::BodyKind;
use crate::balls::is_ball;
use crate::continuous::PieceCore;
use crate::joint::WORLD;
use crate::world::{Collider, reach};

impl<const N: usize> Snapshot<N> {
    /// Makes what was not stored. `placed` is by the slot of the collider.
    pub(super) fn assemble(&mut self, mut placed: Vec<Option<Placed<N>>>) -> Result<(), SnapshotError> {
        if self.motions.len() != placed.len() {
            return Err(SnapshotError::bad_state(format!(
                "it has {} colliders and {} motions",
                placed.len(),
                self.motions.len()
            )));
        }
        self.colliders = placed.iter().map(|_| None).collect();
        let boxes = self.boxes(placed.len())?;
        for slot in 0..self.bodies.slot_count() as u32 {
            self.make_colliders(slot, &mut placed, &boxes)?;
        }
        if let Some(slot) = placed.iter().position(Option::is_some) {
            return Err(SnapshotError::bad_state(format!("collider {slot} belongs to no body")));
        }
        let in_tree = self.colliders.iter().flatten().filter(|collider| collider.proxy.is_some()).count();
        if in_tree != self.tree.len() {
            return Err(SnapshotError::bad_state(format!(
                "the tree holds {} boxes, of {in_tree} colliders",
                self.tree.len()
            )));
        }
        let mut free: Vec<bool> = self.colliders.iter().map(Option::is_none).collect();
        for &slot in &self.free_colliders {
            if !free.get_mut(slot as usize).is_some_and(std::mem::take) {
                return Err(SnapshotError::bad_state(format!("collider {slot} is listed as free, but is not")));
            }
        }
        if free.contains(&true) {
            return Err(SnapshotError::bad_state("a collider without body is not listed as free"));
        }
        self.tie_joints()
    }

    /// The box of each collider with the proxy that names it, as the tree holds them.
    fn boxes(&self, colliders: usize) -> Result<Vec<Option<(u32, Aabb<N>)>>, SnapshotError> {
        let mut boxes = vec![None; colliders];
        for (proxy, slot, aabb) in self.tree.leaves() {
            let place = boxes.get_mut(slot as usize).filter(|place| place.is_none());
            let place = place.ok_or_else(|| {
                SnapshotError::bad_state(format!("the tree holds collider {slot}, which is not there or in it twice"))
            })?;
            *place = Some((proxy, *aabb));
        }
        Ok(boxes)
    }

    fn make_colliders(
        &mut self,
        body_slot: u32,
        placed: &mut [Option<Placed<N>>],
        boxes: &[Option<(u32, Aabb<N>)>],
    ) -> Result<(), SnapshotError> {
        let Some(body) = self.bodies.at_mut(body_slot) else { return Ok(()) };
        let pieces = body.shape.pieces();
        if pieces.len() != body.colliders.len() {
            return Err(SnapshotError::bad_state(format!(
                "body {body_slot} has {} pieces and {} colliders",
                pieces.len(),
                body.colliders.len()
            )));
        }
        body.radius = reach(&pieces, body.centre_in_body);
        body.core_radius = f64::INFINITY;
        body.is_ball = is_ball(&pieces, body.centre_in_body);
        for ((body_from_collider, piece), &slot) in pieces.into_iter().zip(&body.colliders) {
            let wrong = |what: &str| SnapshotError::bad_state(format!("collider {slot} of body {body_slot} {what}"));
            let place = placed.get_mut(slot as usize).and_then(Option::take);
            let Placed { world_from_collider, proxy } =
                place.ok_or_else(|| wrong("is not there, or another body's"))?;
            let core = PieceCore::of(&piece);
            body.core_radius = body.core_radius.min(core.radius);
            let (radius, fat_aabb) = match &piece {
                Piece::Convex(convex) => {
                    let known = boxes[slot as usize].filter(|(known, _)| Some(*known) == proxy);
                    let (_, aabb) = known.ok_or_else(|| wrong("is not in the tree where it says"))?;
                    (convex.bounding_radius(), aabb)
                }
                Piece::HalfSpace { .. } => {
                    if body.kind != BodyKind::Static || proxy.is_some() {
                        return Err(wrong("is a half-space, but in the tree or not static"));
                    }
                    self.half_spaces.push(slot);
                    (0.0, Aabb { lower: Vector::ZERO, upper: Vector::ZERO })
                }
            };
            self.colliders[slot as usize] = Some(Collider {
                body: body_slot,
                piece,
                body_from_collider,
                world_from_collider,
                reach: radius,
                core,
                proxy,
                fat_aabb,
            });
        }
        self.half_spaces.sort_unstable();
        Ok(())
    }

    /// Gives bodies the list of their joints, in the order of their slots.
    fn tie_joints(&mut self) -> Result<(), SnapshotError> {
        for (handle, joint) in self.joints.iter() {
            let wrong = |what: &str| SnapshotError::bad_state(format!("joint {} {what}", handle.index));
            let mut moves = false;
            for end in [joint.def.a, Some(joint.def.b)].into_iter().flatten() {
                let body = self.bodies.get_mut(end).ok_or_else(|| wrong("ties a body that is not there"))?;
                moves |= body.kind == BodyKind::Dynamic;
                body.joints.push(handle.index);
            }
            if joint.body_a == joint.body_b || joint.body_b == WORLD || !moves {
                return Err(wrong("needs two different bodies, of which one is dynamic"));
            }
        }
        Ok(())
    }
}

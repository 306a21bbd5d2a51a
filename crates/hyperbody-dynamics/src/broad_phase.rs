//! Who may touch whom: colliders whose fattened boxes overlap.
//!
//! A collider's box in the tree stands off by a margin, so that a slow body stays in it for many steps; only colliders
//! that left their box are put back and asked for new neighbours.

use hyperbody_geometry::Aabb;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::Vector;
use rayon::prelude::*;

use crate::balls::Plain;
use crate::body::Body;
use crate::handle::Arena;
use crate::narrow_phase::moved;
use crate::near::Near;
use crate::pairs::{NONE, Pair, PairRole, Surface, in_order};
use crate::threads::MANY_BODIES;
use crate::world::{Collider, Motion};
use crate::{BodyHandle, Tuning, World};

impl<const N: usize> World<N> {
    /// Brings boxes, tree and pairs up to date with the bodies' poses.
    pub(crate) fn update_broad_phase(&mut self) {
        self.restart_ways();
        self.refit_boxes();
        if self.motions.iter().any(|motion| motion.moved) {
            self.put_back_into_tree();
            self.drop_ended_pairs();
            self.find_new_pairs();
            self.motions.iter_mut().for_each(|motion| motion.moved = false);
        }
        if self.tree.should_rebuild() {
            self.tree.rebuild();
        }
    }

    /// Moves colliders along with their bodies, stretches of them side by side.
    fn refit_boxes(&mut self) {
        self.plain.resize(self.colliders.len(), Plain::Other);
        let refit = Refit { bodies: &self.bodies, tuning: &self.tuning, dt: self.dt };
        let (colliders, motions) = (self.colliders.as_mut_slice(), self.motions.as_mut_slice());
        let plain = self.plain.as_mut_slice();
        let chunk = colliders.len().div_ceil(self.scratch.len()).max(1);
        match self.pool.as_ref().filter(|_| colliders.len() >= MANY_BODIES) {
            None => refit.colliders(colliders, motions, plain),
            Some(pool) => pool.install(|| {
                let parts = colliders.par_chunks_mut(chunk).zip(motions.par_chunks_mut(chunk));
                parts.zip(plain.par_chunks_mut(chunk)).for_each(|((colliders, motions), plain)| {
                    refit.colliders(colliders, motions, plain);
                });
            }),
        }
    }

    /// Boxes that colliders have left are replaced in the tree.
    fn put_back_into_tree(&mut self) {
        for (collider, _) in self.colliders.iter().zip(&self.motions).filter(|(_, motion)| motion.moved) {
            if let Some(collider) = collider
                && let Some(proxy) = collider.proxy
                && self.tree.aabb(proxy) != &collider.fat_aabb
            {
                self.tree.update(proxy, collider.fat_aabb);
            }
        }
    }

    /// Counts all ways from zero again when one has become so long that small steps would be lost on it.
    fn restart_ways(&mut self) {
        if self.motions.iter().all(|motion| motion.way <= LONGEST_WAY) {
            return;
        }
        self.motions.iter_mut().for_each(|motion| motion.way = 0.0);
        self.pairs.slots_mut().iter_mut().flatten().for_each(|pair| pair.holds_until = f64::NEG_INFINITY);
    }

    fn drop_ended_pairs(&mut self) {
        for slot in 0..self.pairs.keys.len() {
            let key = self.pairs.keys[slot];
            let moved = |collider: u32| self.motions[collider as usize].moved;
            if key == NONE || !(moved(key.0) || moved(key.1)) {
                continue;
            }
            let colliders = (&self.colliders[key.0 as usize], &self.colliders[key.1 as usize]);
            if !matches!(colliders, (Some(a), Some(b)) if boxes_meet(a, b)) {
                #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
                self.drop_pair(slot as u32);
            }
        }
    }

    fn find_new_pairs(&mut self) {
        let (mut found, mut near) = (std::mem::take(&mut self.new_pairs), std::mem::take(&mut self.near));
        found.clear();
        near.bodies.clear();
        #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
        for slot in (0..self.motions.len()).filter(|&slot| self.motions[slot].moved).map(|slot| slot as u32) {
            let Some(collider) = &self.colliders[slot as usize] else { continue };
            if collider.proxy.is_none() {
                self.find_beside_half_space(slot, collider, &mut found);
                continue;
            }
            if self.has_many_pieces(collider.body) {
                near.bodies.push(collider.body);
            } else {
                self.tree.for_each_overlap(&collider.fat_aabb, &mut near.stack, |other| {
                    found.push((slot.min(other), slot.max(other)));
                    true
                });
            }
            for &plane in &self.half_spaces {
                if self.colliders[plane as usize].as_ref().is_some_and(|plane| boxes_meet(plane, collider)) {
                    found.push((slot.min(plane), slot.max(plane)));
                }
            }
        }
        near.bodies.sort_unstable();
        near.bodies.dedup();
        for index in 0..near.bodies.len() {
            self.find_beside_pieces(near.bodies[index], &mut near, &mut found);
        }
        found.sort_unstable_by_key(in_order);
        found.dedup();
        for &(a, b) in &found {
            if !self.pairs.contains(a, b)
                && let Some(pair) = self.new_pair(a, b)
            {
                self.wake_beside_newcomer(&pair);
                self.pairs.insert(pair);
            }
        }
        (self.new_pairs, self.near) = (found, near);
    }

    fn find_beside_half_space(&self, slot: u32, plane: &Collider<N>, found: &mut Vec<(u32, u32)>) {
        #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
        for (other_slot, other) in self.colliders.iter().enumerate().map(|(s, c)| (s as u32, c)) {
            if other.as_ref().is_some_and(|other| other.proxy.is_some() && boxes_meet(plane, other)) {
                found.push((slot.min(other_slot), slot.max(other_slot)));
            }
        }
    }

    /// Neighbours of the pieces of a body that left their boxes.
    fn find_beside_pieces(&self, body: u32, near: &mut Near<N>, found: &mut Vec<(u32, u32)>) {
        near.boxes.clear();
        for &slot in self.bodies.at(body).map_or(&[][..], |body| &body.colliders) {
            let collider = self.colliders[slot as usize].as_ref();
            let moved = self.motions[slot as usize].moved;
            let moved = collider.filter(|collider| moved && collider.proxy.is_some());
            near.boxes.extend(moved.map(|collider| (slot, collider.fat_aabb)));
        }
        self.for_each_near(body, near, |slot, other| found.push((slot.min(other), slot.max(other))));
    }

    /// A pair of two colliders that may touch, or `None` if they never do: of one body, or of two that leave each other alone.
    fn new_pair(&self, collider_a: u32, collider_b: u32) -> Option<Pair<N>> {
        let a = self.colliders[collider_a as usize].as_ref()?;
        let b = self.colliders[collider_b as usize].as_ref()?;
        let (body_a, body_b) = (self.bodies.at(a.body)?, self.bodies.at(b.body)?);
        if a.body == b.body || !self.may_pair(a.body, b.body) {
            return None;
        }
        let surface = Surface::of(&body_a.material, &body_b.material);
        let role = PairRole::of(body_a, body_b);
        Some(Pair::new((collider_a, a.body), (collider_b, b.body), role, surface))
    }
}

/// What moving colliders along reads.
#[derive(Clone, Copy)]
struct Refit<'a, const N: usize> {
    bodies: &'a Arena<Body<N>, BodyHandle>,
    tuning: &'a Tuning,
    /// s.
    dt: f64,
}

impl<const N: usize> Refit<'_, N> {
    fn colliders(&self, colliders: &mut [Option<Collider<N>>], motions: &mut [Motion<N>], plain: &mut [Plain<N>]) {
        for ((collider, motion), plain) in colliders.iter_mut().zip(motions).zip(plain) {
            let Some(collider) = collider else { continue };
            let Some(body) = self.bodies.at(collider.body) else { continue };
            motion.awake = body.is_awake();
            motion.speed = if body.quarantined { f64::INFINITY } else { 0.0 };
            motion.velocity = body.velocity;
            if motion.awake || motion.moved {
                self.collider(collider, motion, body);
            }
            motion.plain = plain.take(collider, body);
        }
    }

    fn collider(&self, collider: &mut Collider<N>, motion: &mut Motion<N>, body: &Body<N>) {
        let spin = body.surface_speed_by_spin();
        if motion.awake {
            motion.speed = body.velocity.norm() + spin;
        }
        let pose = body.world_from_body() * collider.body_from_collider;
        motion.way += match &collider.piece {
            Piece::Convex(_) => moved(&collider.world_from_collider, &pose, collider.reach),
            // Unbounded: wherever it turns, something is swept.
            Piece::HalfSpace { .. } if pose != collider.world_from_collider => {
                2.0 * self.tuning.recycle_distance + self.tuning.speculative_distance
            }
            Piece::HalfSpace { .. } => 0.0,
        };
        collider.world_from_collider = pose;
        let Piece::Convex(convex) = &collider.piece else { return };
        let tight = convex.aabb(&pose);
        // All that the body can reach within the step; twice as far when the box is made anew.
        let way = body.velocity * self.dt;
        let reach = self.tuning.speculative_distance + spin * self.dt;
        if !collider.fat_aabb.contains(&ahead(&tight, way).grown(reach)) {
            collider.fat_aabb = ahead(&tight, way * 2.0).grown(self.tuning.tree_margin + reach);
            motion.moved = true;
        }
    }
}

/// Longest way that is counted, m: beyond, a nanometre is lost in each step.
const LONGEST_WAY: f64 = 1e6;

/// The box and where it will be a step later.
fn ahead<const N: usize>(tight: &Aabb<N>, motion: Vector<N>) -> Aabb<N> {
    tight.union(&Aabb { lower: tight.lower + motion, upper: tight.upper + motion })
}

/// Whether fattened boxes, or a half-space and a fattened box, have a point in common.
fn boxes_meet<const N: usize>(a: &Collider<N>, b: &Collider<N>) -> bool {
    match (&a.piece, &b.piece) {
        (Piece::HalfSpace { normal, offset }, Piece::Convex(_)) => half_space_meets(a, *normal, *offset, &b.fat_aabb),
        (Piece::Convex(_), Piece::HalfSpace { normal, offset }) => half_space_meets(b, *normal, *offset, &a.fat_aabb),
        (Piece::Convex(_), Piece::Convex(_)) => a.fat_aabb.overlaps(&b.fat_aabb),
        (Piece::HalfSpace { .. }, Piece::HalfSpace { .. }) => false,
    }
}

fn half_space_meets<const N: usize>(plane: &Collider<N>, normal: Vector<N>, offset: f64, aabb: &Aabb<N>) -> bool {
    let normal = plane.world_from_collider.rotation.rotate(normal);
    let offset = offset + normal.dot(plane.world_from_collider.translation);
    let half = (aabb.upper - aabb.lower) * 0.5;
    normal.dot(aabb.centre()) - normal.abs().dot(half) <= offset
}

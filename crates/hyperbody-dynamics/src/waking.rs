//! Who wakes, and why: what users touched, what lost or got a neighbour at rest, and what something awake will press on.
//!
//! Sleepers wake by whole islands (`islands`), so no body is left hanging on a sleeping neighbour that has gone.

use crate::body::Body;
use crate::narrow_phase::velocity_near;
use crate::pairs::{Pair, PairRole, Touch};
use crate::{BodyKind, World};

impl<const N: usize> World<N> {
    /// Wakes the islands of the bodies that the user touched since the last step.
    pub(crate) fn serve_wake_requests(&mut self) {
        let mut requests = std::mem::take(&mut self.wake_requests);
        requests.sort_unstable();
        requests.dedup();
        for &slot in &requests {
            self.islands.wake_body(slot, &mut self.bodies);
            let Some(body) = self.bodies.at_mut(slot) else { continue };
            body.slow_time = 0.0;
            let refilter = std::mem::take(&mut body.refilter);
            if body.kind != BodyKind::Dynamic || body.quarantined || refilter {
                self.wake_neighbours(slot);
            }
            if refilter {
                self.drop_forbidden_pairs(slot);
            }
            let Some(body) = self.bodies.at(slot) else { continue };
            for &collider in &body.colliders {
                // A teleported body must be looked at, static ones too.
                self.motions[collider as usize].moved = true;
            }
        }
        requests.clear();
        self.wake_requests = requests;
    }

    /// Drops the pairs of a body that are no longer allowed or have become of another kind; the broad phase finds anew what
    /// is to stay.
    fn drop_forbidden_pairs(&mut self, slot: u32) {
        self.drop_pairs(|world, pair| {
            let bodies = (world.bodies.at(pair.body_a), world.bodies.at(pair.body_b));
            let (Some(a), Some(b)) = bodies else { return false };
            let asked = pair.body_a == slot || pair.body_b == slot;
            !asked || (world.may_pair(pair.body_a, pair.body_b) && pair.role == PairRole::of(a, b))
        });
    }

    /// Wakes what lies beside a body that was moved by hand: it may have been its support.
    fn wake_neighbours(&mut self, slot: u32) {
        let own = |pair: &&Pair<N>| pair.role != PairRole::Sensor && (pair.body_a == slot || pair.body_b == slot);
        for pair in self.pairs.iter().filter(own) {
            let other = if pair.body_a == slot { pair.body_b } else { pair.body_a };
            self.islands.wake_body(other, &mut self.bodies);
        }
        let Some(body) = self.bodies.at(slot) else { return };
        let ties = body.joints.iter().filter_map(|&joint| self.joints.at(joint));
        let ends: Vec<u32> = ties.flat_map(|joint| [joint.body_a, joint.body_b]).collect();
        for end in ends {
            self.islands.wake_body(end, &mut self.bodies);
        }
    }

    /// A sleeper that finds something at rest beside it, put there since it fell asleep, wakes to feel it.
    pub(crate) fn wake_beside_newcomer(&mut self, pair: &Pair<N>) {
        if pair.role == PairRole::Sensor {
            return;
        }
        for (slot, other) in [(pair.body_a, pair.body_b), (pair.body_b, pair.body_a)] {
            if self.bodies.at(other).is_some_and(|body| body.kind != BodyKind::Dynamic && !body.drifts()) {
                self.islands.wake_body(slot, &mut self.bodies);
            }
        }
    }

    /// Wakes sleepers that something awake touches or is jointed to, until none is left.
    pub(crate) fn wake_touched(&mut self) {
        if !self.islands.anyone_sleeps() {
            return;
        }
        // Each round wakes at least one island or is the last.
        for _ in 0..=self.islands.count() {
            let mut woken = false;
            for slot in 0..self.pairs.slots().len() {
                #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
                let Some(pair) = self.pairs.get(slot as u32) else { continue };
                let (a, b) = (pair.body_a, pair.body_b);
                if pair.points > 0 && self.touches_within_step(pair) {
                    woken |= self.wake_across(a, b);
                }
            }
            for slot in 0..self.joints.slot_count() {
                #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
                let Some(joint) = self.joints.at(slot as u32) else { continue };
                let (a, b) = (joint.body_a, joint.body_b);
                woken |= self.wake_across(a, b);
            }
            if !woken {
                return;
            }
        }
    }

    /// Whether some point of a pair touches, or will before the step ends: the solver would press there.
    fn touches_within_step(&self, pair: &Pair<N>) -> bool {
        let (Some(a), Some(b)) = (self.bodies.at(pair.body_a), self.bodies.at(pair.body_b)) else { return false };
        let normal = pair.normal();
        pair.touches().iter().any(|Touch { point, .. }| {
            let approach = velocity_near(a, point.position) - velocity_near(b, point.position);
            let closing = approach.dot(normal);
            point.separation <= self.tuning.slop + closing.max(0.0) * self.dt
        })
    }

    /// Wakes the one of two bodies that sleeps if the other one is up and about.
    fn wake_across(&mut self, a: u32, b: u32) -> bool {
        let (Some(body_a), Some(body_b)) = (self.bodies.at(a), self.bodies.at(b)) else { return false };
        let disturbs = |body: &Body<N>| {
            body.is_awake() && (body.is_moving() || body.velocity.norm_sq() + body.angular_velocity.norm_sq() > 0.0)
        };
        if body_a.asleep_in.is_some() && disturbs(body_b) {
            return self.islands.wake_body(a, &mut self.bodies);
        }
        if body_b.asleep_in.is_some() && disturbs(body_a) {
            return self.islands.wake_body(b, &mut self.bodies);
        }
        false
    }
}

//! Who rests together falls asleep together, and wakes together.
//!
//! Awake dynamic bodies that touch or are jointed form an island (found anew at each step by union–find, in the order of
//! pairs and joints). When every body of an island has been slow for long enough, the island sleeps as one; when
//! anything awake touches one of it, or the user does, all of it wakes. So no body is left hanging on a sleeping
//! neighbour that has gone.

use hyperbody_math::{Bivector, Vector};

use crate::body::Body;
use crate::handle::Arena;
use crate::joint::{Joint, WORLD};
use crate::pairs::Contact;
use crate::{BodyHandle, World};

/// Sleeping islands, and the buffers of union–find.
#[derive(Clone, Debug)]
pub(crate) struct Islands {
    /// Bodies of each sleeping island; empty ones are free.
    pub(crate) sleeping: Vec<Vec<u32>>,
    pub(crate) free: Vec<u32>,
    pub(crate) parent: Vec<u32>,
    /// By root: shortest time that a body of the island has been slow.
    pub(crate) least_slow_time: Vec<f64>,
    /// By root: the sleeping island that it became in this step.
    pub(crate) became: Vec<u32>,
    /// By root: whether something immovable holds a body of the island.
    pub(crate) held: Vec<bool>,
    /// Bodies that fell asleep (true) or woke since the list was last taken.
    pub(crate) changes: Vec<(BodyHandle, bool)>,
}

const NONE: u32 = u32::MAX;

impl Islands {
    pub(crate) const fn new() -> Self {
        Self {
            sleeping: Vec::new(),
            free: Vec::new(),
            parent: Vec::new(),
            least_slow_time: Vec::new(),
            became: Vec::new(),
            held: Vec::new(),
            changes: Vec::new(),
        }
    }

    /// Wakes the island of a body; true if it slept.
    pub(crate) fn wake_body<const N: usize>(&mut self, slot: u32, bodies: &mut Arena<Body<N>, BodyHandle>) -> bool {
        let Some(island) = bodies.at(slot).and_then(|body| body.asleep_in) else { return false };
        let mut members = std::mem::take(&mut self.sleeping[island as usize]);
        for &member in &members {
            if let Some(body) = bodies.at_mut(member) {
                body.asleep_in = None;
                body.slow_time = 0.0;
            }
            self.changes.extend(bodies.handle_at(member).map(|handle| (handle, false)));
        }
        members.clear();
        self.sleeping[island as usize] = members;
        self.free.push(island);
        true
    }

    pub(crate) fn anyone_sleeps(&self) -> bool {
        self.free.len() < self.sleeping.len()
    }

    /// Sleeping islands, free ones included.
    pub(crate) fn count(&self) -> usize {
        self.sleeping.len()
    }

    /// Wakes everything.
    pub(crate) fn wake_all<const N: usize>(&mut self, bodies: &mut Arena<Body<N>, BodyHandle>) {
        for slot in 0..bodies.slot_count() {
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            self.wake_body(slot as u32, bodies);
        }
    }

    /// Whether nobody woke since the last step.
    pub(crate) fn nothing_changed(&self) -> bool {
        self.changes.is_empty()
    }

    /// Who fell asleep (true) or woke since the last call, in order.
    pub(crate) fn take_changes(&mut self) -> impl Iterator<Item = (BodyHandle, bool)> {
        self.changes.drain(..)
    }

    fn find(&mut self, mut x: u32) -> u32 {
        while self.parent[x as usize] != x {
            let grandparent = self.parent[self.parent[x as usize] as usize];
            self.parent[x as usize] = grandparent;
            x = grandparent;
        }
        x
    }

    /// Joins two islands; the smaller root wins, so that the result does not depend on the order.
    fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    fn new_sleeping_island(&mut self) -> u32 {
        self.free.pop().unwrap_or_else(|| {
            self.sleeping.push(Vec::new());
            #[expect(clippy::cast_possible_truncation, reason = "no more islands than bodies")]
            let last = (self.sleeping.len() - 1) as u32;
            last
        })
    }
}

impl<const N: usize> World<N> {
    /// Puts islands to sleep whose bodies have all been slow for long enough.
    pub(crate) fn fall_asleep(&mut self) {
        if !self.sleeping {
            return;
        }
        let limit = self.tuning.sleep_time;
        if !self.bodies.values().any(|body| body.is_moving() && body.slow_time >= limit) {
            return;
        }
        self.find_islands();
        let slot_count = self.bodies.slot_count();
        self.islands.became.clear();
        self.islands.became.resize(slot_count, NONE);
        for slot in 0..slot_count {
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            let slot = slot as u32;
            if !self.bodies.at(slot).is_some_and(Body::is_moving) {
                continue;
            }
            let root = self.islands.find(slot) as usize;
            if self.islands.least_slow_time[root] < limit {
                continue;
            }
            if self.islands.became[root] == NONE {
                self.islands.became[root] = self.islands.new_sleeping_island();
            }
            let island = self.islands.became[root];
            self.islands.sleeping[island as usize].push(slot);
            if let Some(body) = self.bodies.at_mut(slot) {
                body.fall_asleep_in(island);
                self.islands.changes.extend(self.bodies.handle_at(slot).map(|handle| (handle, true)));
            }
        }
    }

    fn find_islands(&mut self) {
        let slot_count = self.bodies.slot_count();
        self.islands.parent.clear();
        #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
        self.islands.parent.extend(0..slot_count as u32);
        for pair in self.pairs.iter().filter(|pair| pair.points > 0) {
            unite_moving(&mut self.islands, &self.bodies, pair.body_a, pair.body_b);
        }
        for joint in self.joints.values() {
            unite_moving(&mut self.islands, &self.bodies, joint.body_a, joint.body_b);
        }
        self.islands.least_slow_time.clear();
        self.islands.least_slow_time.resize(slot_count, f64::INFINITY);
        for slot in 0..slot_count {
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            let slot = slot as u32;
            let Some(body) = self.bodies.at(slot).filter(|body| body.is_moving()) else { continue };
            let slow_time = if body.can_sleep { body.slow_time } else { 0.0 };
            let root = self.islands.find(slot) as usize;
            self.islands.least_slow_time[root] = self.islands.least_slow_time[root].min(slow_time);
        }
        self.keep_moved_awake();
    }
}

impl<const N: usize> World<N> {
    /// What touches a kinematic body in motion, or is tied to it, is carried along, however slowly, and may not fall asleep;
    /// nor may what gravity or a steady force pulls and nothing immovable holds, however slowly it still moves.
    fn keep_moved_awake(&mut self) {
        let mut held = std::mem::take(&mut self.islands.held);
        held.clear();
        held.resize(self.bodies.slot_count(), false);
        let presses = |contact: &Contact<N>| contact.touches.iter().any(|touch| touch.step_impulse > 0.0);
        let pressed = self.pairs.iter().filter(|pair| pair.contact.as_deref().is_some_and(presses));
        let contacts = pressed.map(|pair| (pair.body_a, pair.body_b, true, true));
        // A slack rope holds nothing.
        let bears = |joint: &Joint<N>| joint.step_impulse != Vector::ZERO || joint.step_twist != Bivector::ZERO;
        let joints = self.joints.values().map(|joint| (joint.body_a, joint.body_b, false, bears(joint)));
        for (a, b, touch, bears) in contacts.chain(joints) {
            for (body, other) in [(a, b), (b, a)] {
                let other = self.bodies.at(other);
                if body == WORLD || other.is_some_and(Body::is_moving) {
                    continue;
                }
                let root = self.islands.find(body) as usize;
                held[root] |= bears;
                if other.is_some_and(|other| other.drifts() || (touch && other.runs())) {
                    self.islands.least_slow_time[root] = 0.0;
                }
            }
        }
        for slot in 0..self.bodies.slot_count() {
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            let Some(body) = self.bodies.at(slot as u32).filter(|body| body.is_moving()) else { continue };
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            let root = self.islands.find(slot as u32) as usize;
            let pull = self.gravity * body.gravity_scale + body.steady_force * body.inverse_mass;
            if !held[root] && (pull != Vector::ZERO || body.steady_torque != Bivector::ZERO) {
                self.islands.least_slow_time[root] = 0.0;
            }
        }
        self.islands.held = held;
    }
}

fn unite_moving<const N: usize>(islands: &mut Islands, bodies: &Arena<Body<N>, BodyHandle>, a: u32, b: u32) {
    if bodies.at(a).is_some_and(Body::is_moving) && bodies.at(b).is_some_and(Body::is_moving) {
        islands.unite(a, b);
    }
}

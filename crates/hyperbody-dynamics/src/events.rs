//! What happened in the last step: touches, what sensors noticed, sleep, broken joints.
//!
//! Lists are of the last step and stand until the next one; their order depends on bodies and joints alone: contacts by their
//! two bodies' slots, the rest by when it happened. Bodies of several pieces touch once, however many of their pieces do. Pairs of
//! which both bodies sleep or cannot move keep their touch without a word. The list of contacts is made when it is asked for
//! (`meetings`).

use std::sync::OnceLock;

use hyperbody_math::{Bivector, Vector};

use crate::meetings::Meetings;
use crate::{BodyHandle, JointHandle, World};

/// What a touch did in the last step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactPhase {
    /// The two had not touched in the step before.
    Begin,
    /// They had, and still do.
    Stay,
    /// They no longer do, or one of them is gone: its handle may be stale.
    End,
}

/// Two bodies that touch, or have ceased to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactEvent<const N: usize> {
    /// The two bodies; the one of the lower slot first.
    pub bodies: (BodyHandle, BodyHandle),
    /// What the touch did.
    pub phase: ContactPhase,
    /// Sum of the normal impulses of all points over the step, N·s: how hard it struck, or presses. Zero at the end.
    pub impulse: f64,
    /// Mean of the points, weighted by their impulses, in the world, m. Zero at the end.
    pub point: Vector<N>,
    /// Unit normal in the world, from the first body to the second, of the pieces that press most. Zero at the end.
    pub normal: Vector<N>,
}

/// What a sensor noticed in the last step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SensorPhase {
    /// The other body came to overlap it.
    Enter,
    /// It no longer does, or one of the two is gone: its handle may be stale.
    Leave,
}

/// A body that came into a sensor or left it. Of two sensors, each notices the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SensorEvent {
    /// The sensor.
    pub sensor: BodyHandle,
    /// What it noticed.
    pub other: BodyHandle,
    /// Which way.
    pub phase: SensorPhase,
}

/// A joint that was loaded beyond its strength. It is gone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrokenJoint<const N: usize> {
    /// What was its handle.
    pub joint: JointHandle,
    /// Its bodies; `None` is the world.
    pub bodies: (Option<BodyHandle>, BodyHandle),
    /// The force in its last step, on the second body, N.
    pub force: Vector<N>,
    /// The torque in its last step, N·m.
    pub torque: Bivector<N>,
}

/// What happened in the last step.
#[derive(Clone, Debug)]
pub struct Events<const N: usize> {
    /// Made when somebody asks.
    pub(crate) contacts: OnceLock<Vec<ContactEvent<N>>>,
    /// Whether somebody asked since the last step: then the next one makes the list itself.
    pub(crate) asked: OnceLock<()>,
    /// Whether there was nothing to do in the last step, or one is under way: no touch is told.
    pub(crate) quiet: bool,
    pub(crate) meetings: Meetings<N>,
    pub(crate) sensors: Vec<SensorEvent>,
    pub(crate) woken: Vec<BodyHandle>,
    pub(crate) slept: Vec<BodyHandle>,
    pub(crate) broken: Vec<BrokenJoint<N>>,
    /// What is in which sensor, by sensor and body ascending.
    pub(crate) inside: Vec<(BodyHandle, BodyHandle)>,
    /// The next `inside`: buffer.
    pub(crate) noticed: Vec<(BodyHandle, BodyHandle)>,
}

impl<const N: usize> Events<N> {
    pub(crate) const fn new() -> Self {
        Self {
            contacts: OnceLock::new(),
            asked: OnceLock::new(),
            quiet: true,
            meetings: Meetings::new(),
            sensors: Vec::new(),
            woken: Vec::new(),
            slept: Vec::new(),
            broken: Vec::new(),
            inside: Vec::new(),
            noticed: Vec::new(),
        }
    }

    /// Forgets the last step. If nothing happens now, touches go on in silence.
    pub(crate) fn forget_step(&mut self) {
        self.quiet = true;
        if let Some(contacts) = self.contacts.get_mut() {
            contacts.clear();
        }
        self.sensors.clear();
        self.woken.clear();
        self.slept.clear();
        self.broken.clear();
    }

    /// Touches that began, stayed or ended.
    #[must_use]
    pub fn contacts(&self) -> &[ContactEvent<N>] {
        self.contacts.get().map_or(&[], Vec::as_slice)
    }

    /// What came into sensors and what left them, by sensor and body in the order of their slots. It is noticed at the start
    /// of a step, where bodies are then: what passes through a sensor within one step is not.
    #[must_use]
    pub fn sensors(&self) -> &[SensorEvent] {
        &self.sensors
    }

    /// Bodies that woke, in the step or by a call before it.
    #[must_use]
    pub fn woken(&self) -> &[BodyHandle] {
        &self.woken
    }

    /// Bodies that fell asleep.
    #[must_use]
    pub fn slept(&self) -> &[BodyHandle] {
        &self.slept
    }

    /// Joints that broke.
    #[must_use]
    pub fn broken_joints(&self) -> &[BrokenJoint<N>] {
        &self.broken
    }
}

impl<const N: usize> World<N> {
    /// What happened in the last step. The lists stand until the next one. That of contacts, the longest, is made when this is
    /// called for the first time after a step; steps of worlds in which nobody asks do without.
    #[must_use]
    pub fn events(&self) -> &Events<N> {
        self.events.asked.get_or_init(|| ());
        self.list_contacts();
        &self.events
    }

    /// The bodies that a sensor noticed in the last step, in the order of their slots.
    pub fn inside(&self, sensor: BodyHandle) -> impl Iterator<Item = BodyHandle> + '_ {
        let list = &self.events.inside;
        let start = list.partition_point(|&(other, _)| other < sensor);
        list[start..].iter().take_while(move |(other, _)| *other == sensor).map(|&(_, body)| body)
    }

    /// Makes the lists of the step that just ended.
    pub(crate) fn collect_events(&mut self) {
        self.break_joints();
        self.settle_meetings();
        self.tell_meetings();
        self.notice_overlaps();
        self.compare_overlaps();
        let (bodies, events) = (&self.bodies, &mut self.events);
        events.woken.clear();
        events.slept.clear();
        for (handle, asleep) in self.islands.take_changes().filter(|(handle, _)| bodies.get(*handle).is_some()) {
            let list = if asleep { &mut events.slept } else { &mut events.woken };
            list.push(handle);
        }
    }

    fn break_joints(&mut self) {
        self.events.broken.clear();
        for slot in 0..self.joints.slot_count() {
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            let slot = slot as u32;
            let Some(joint) = self.joints.at(slot) else { continue };
            let (force, torque) = (joint.step_impulse * (1.0 / self.dt), joint.step_twist * (1.0 / self.dt));
            // A load that is no number breaks nothing: its body is put into quarantine.
            if !(force.norm() > joint.def.break_force || torque.norm() > joint.def.break_torque) {
                continue;
            }
            let bodies = (joint.def.a, joint.def.b);
            let Some(handle) = self.joints.handle_at(slot) else { continue };
            if self.remove_joint(handle).is_ok() {
                self.events.broken.push(BrokenJoint { joint: handle, bodies, force, torque });
            }
        }
    }

    fn notice_overlaps(&mut self) {
        let mut noticed = std::mem::take(&mut self.events.noticed);
        noticed.clear();
        for pair in self.pairs.overlaps() {
            noticed.extend(self.noticed_by(pair.body_a, pair.body_b));
            noticed.extend(self.noticed_by(pair.body_b, pair.body_a));
        }
        self.events.noticed = noticed;
    }

    /// Sensor and body, if the first of two that overlap is a sensor.
    fn noticed_by(&self, sensor: u32, other: u32) -> Option<(BodyHandle, BodyHandle)> {
        self.bodies.at(sensor).filter(|body| body.sensor)?;
        Some((self.bodies.handle_at(sensor)?, self.bodies.handle_at(other)?))
    }

    /// What sensors notice beside what they noticed in the last step.
    fn compare_overlaps(&mut self) {
        let Events { sensors, inside, noticed, .. } = &mut self.events;
        sensors.clear();
        noticed.sort_unstable();
        noticed.dedup();
        let mut before = inside.iter().copied().peekable();
        let event = |(sensor, other), phase| SensorEvent { sensor, other, phase };
        for &now in &*noticed {
            while let Some(left) = before.next_if(|&other| other < now) {
                sensors.push(event(left, SensorPhase::Leave));
            }
            if before.next_if_eq(&now).is_none() {
                sensors.push(event(now, SensorPhase::Enter));
            }
        }
        sensors.extend(before.map(|left| event(left, SensorPhase::Leave)));
        std::mem::swap(inside, noticed);
    }
}

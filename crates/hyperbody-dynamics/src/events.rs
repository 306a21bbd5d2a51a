//! What happened in the last step: touches, what sensors noticed, sleep, broken joints.
//!
//! Lists are made at the end of each step and stand until the next one; their order depends on bodies and joints alone:
//! contacts by their two bodies' slots, the rest by when it happened. Bodies of several pieces touch once, however many of
//! their pieces do. Pairs of which both bodies sleep or cannot move keep their touch without a word, and cost nothing
//! but a look.

use hyperbody_math::{Bivector, Vector};

use crate::body::Body;
use crate::counting::Counting;
use crate::pairs::Touch;
use crate::{BodyHandle, BodyKind, JointHandle, World};

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
    pub(crate) contacts: Vec<ContactEvent<N>>,
    pub(crate) sensors: Vec<SensorEvent>,
    pub(crate) woken: Vec<BodyHandle>,
    pub(crate) slept: Vec<BodyHandle>,
    pub(crate) broken: Vec<BrokenJoint<N>>,
    /// Who touches whom, ascending.
    pub(crate) touching: Vec<(BodyHandle, BodyHandle)>,
    /// Touches of the step, one for each pair of pieces: buffer.
    pub(crate) found: Vec<ContactEvent<N>>,
    /// The touches found, by their bodies.
    pub(crate) order: Vec<u32>,
    pub(crate) counting: Counting,
    /// The next `touching`: buffer.
    pub(crate) next: Vec<(BodyHandle, BodyHandle)>,
    /// What is in which sensor, by sensor and body ascending.
    pub(crate) inside: Vec<(BodyHandle, BodyHandle)>,
    /// The next `inside`: buffer.
    pub(crate) noticed: Vec<(BodyHandle, BodyHandle)>,
}

impl<const N: usize> Events<N> {
    pub(crate) const fn new() -> Self {
        Self {
            contacts: Vec::new(),
            sensors: Vec::new(),
            woken: Vec::new(),
            slept: Vec::new(),
            broken: Vec::new(),
            touching: Vec::new(),
            found: Vec::new(),
            order: Vec::new(),
            counting: Counting::new(),
            next: Vec::new(),
            inside: Vec::new(),
            noticed: Vec::new(),
        }
    }

    /// Nothing happened; touches go on in silence.
    pub(crate) fn forget_step(&mut self) {
        self.contacts.clear();
        self.sensors.clear();
        self.woken.clear();
        self.slept.clear();
        self.broken.clear();
    }

    /// Touches that began, stayed or ended.
    #[must_use]
    pub fn contacts(&self) -> &[ContactEvent<N>] {
        &self.contacts
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
    /// What happened in the last step. The lists stand until the next one.
    #[must_use]
    pub fn events(&self) -> &Events<N> {
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
        self.find_touches();
        self.compare_touches();
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

    /// Pairs of pieces that touch and of which one may move.
    fn find_touches(&mut self) {
        let mut found = std::mem::take(&mut self.events.found);
        found.clear();
        self.events.noticed.clear();
        for pair in self.pairs.overlaps() {
            self.events.noticed.extend(self.noticed_by(pair.body_a, pair.body_b));
            self.events.noticed.extend(self.noticed_by(pair.body_b, pair.body_a));
        }
        for (_, pair) in self.pairs.contacts() {
            let Some(contact) = pair.contact.as_deref() else { continue };
            let touches = |touch: &Touch<N>| touch.step_impulse > 0.0 || touch.point.separation <= 0.0;
            let touching = contact.touches.iter().any(touches);
            let (Some(a), Some(b)) = (self.bodies.at(pair.body_a), self.bodies.at(pair.body_b)) else { continue };
            if !touching || !(a.is_moving() || b.is_moving()) {
                continue;
            }
            let handles = (self.bodies.handle_at(pair.body_a), self.bodies.handle_at(pair.body_b));
            let (Some(handle_a), Some(handle_b)) = handles else { continue };
            let (mut impulse, mut point) = (0.0, Vector::ZERO);
            for touch in contact.touches.iter() {
                let part = f64::from(touch.step_impulse);
                impulse += part;
                point += touch.point.position * part;
            }
            let pressed = impulse > 0.0;
            let first = contact.touches.first().map_or(Vector::ZERO, |touch| touch.point.position);
            let swap = handle_b.index < handle_a.index;
            found.push(ContactEvent {
                bodies: if swap { (handle_b, handle_a) } else { (handle_a, handle_b) },
                phase: ContactPhase::Begin,
                impulse,
                point: if pressed { point * (1.0 / impulse) } else { first },
                normal: if swap { -contact.normal } else { contact.normal },
            });
        }
        // Pieces of the same two bodies keep the order of their pairs. What is sorted is small beside the events.
        let Events { order, counting, .. } = &mut self.events;
        order.clear();
        #[expect(clippy::cast_possible_truncation, reason = "fewer pairs than fit into memory")]
        order.extend(0..found.len() as u32);
        let slots = self.bodies.slot_count();
        counting.sort(order, slots, |touch| found[touch as usize].bodies.1.index as usize);
        counting.sort(order, slots, |touch| found[touch as usize].bodies.0.index as usize);
        self.events.found = found;
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

    /// Touches of this step beside those of the last one.
    fn compare_touches(&mut self) {
        let Events { contacts, touching, found, order, next, .. } = &mut self.events;
        let bodies = &self.bodies;
        contacts.clear();
        next.clear();
        let mut before = touching.iter().copied().peekable();
        let end = |pair: (BodyHandle, BodyHandle), next: &mut Vec<_>, contacts: &mut Vec<_>| {
            let asleep = |handle| {
                bodies.get(handle).is_some_and(|body: &Body<N>| body.kind == BodyKind::Dynamic && !body.is_moving())
            };
            let still = |handle| bodies.get(handle).is_some_and(|body: &Body<N>| !body.is_moving());
            // Two bodies that nothing moves, since one was made static, touch no more.
            if still(pair.0) && still(pair.1) && (asleep(pair.0) || asleep(pair.1)) {
                next.push(pair);
            } else {
                let (point, normal) = (Vector::ZERO, Vector::ZERO);
                contacts.push(ContactEvent { bodies: pair, phase: ContactPhase::End, impulse: 0.0, point, normal });
            }
        };
        for touches in order.chunk_by(|&a, &b| found[a as usize].bodies == found[b as usize].bodies) {
            let mut touches = touches.iter().map(|&touch| &found[touch as usize]);
            let Some(first) = touches.next() else { continue };
            let pair = first.bodies;
            while let Some(ended) = before.next_if(|&other| other < pair) {
                end(ended, next, contacts);
            }
            let stays = before.next_if_eq(&pair).is_some();
            let mut event = merged(first, touches);
            if stays {
                event.phase = ContactPhase::Stay;
            }
            contacts.push(event);
            next.push(pair);
        }
        for ended in before {
            end(ended, next, contacts);
        }
        std::mem::swap(touching, next);
    }
}

/// The touches of the pieces of two bodies as one.
fn merged<'a, const N: usize>(
    first: &ContactEvent<N>,
    others: impl Iterator<Item = &'a ContactEvent<N>>,
) -> ContactEvent<N> {
    let mut event = *first;
    let mut most = event.impulse;
    let mut weighted = event.point * event.impulse;
    let mut alone = true;
    for touch in others {
        alone = false;
        event.impulse += touch.impulse;
        weighted += touch.point * touch.impulse;
        if touch.impulse > most {
            most = touch.impulse;
            event.normal = touch.normal;
        }
    }
    if !alone && event.impulse > 0.0 {
        event.point = weighted * (1.0 / event.impulse);
    }
    event
}

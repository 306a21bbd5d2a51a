//! Touches that begin, stay and end: what [`Events::contacts`](crate::Events::contacts) tells.
//!
//! Most programs ask for a few of these events or for none, and a pile has ten thousand. So a step only notes in each pair how
//! its bodies meet, at places where it has the pair at hand: the narrow phase what was, the solver what is. The list is made of
//! that when somebody asks, or by the step itself if somebody asked after the last one, in buffers that are kept.
//!
//! What was known of pairs that are dropped while their bodies touch stands in a list until the end of the step.

use hyperbody_math::Vector;

use crate::body::Body;
use crate::counting::Counting;
use crate::handle::Arena;
use crate::pairs::{Contact, Meeting, Pair, Pairs};
use crate::{BodyHandle, BodyKind, ContactEvent, ContactPhase, World};

/// Two bodies, the one of the lower slot first.
type Two = (BodyHandle, BodyHandle);

/// How the bodies of dropped pairs met, and the buffers of the list.
#[derive(Clone, Debug)]
pub(crate) struct Meetings<const N: usize> {
    /// Bodies of pairs that were dropped while they touched: since the last step, or before if they rest since.
    pub(crate) dropped: Vec<Two>,
    /// Those of them of which the last step has something to tell, ascending.
    pub(crate) gone: Vec<Two>,
    /// One for each pair of pieces: buffer.
    pub(crate) found: Vec<ContactEvent<N>>,
    /// Those found, by their bodies: buffer.
    pub(crate) order: Vec<u32>,
    pub(crate) counting: Counting,
}

impl<const N: usize> Meetings<N> {
    pub(crate) const fn new() -> Self {
        Self { dropped: Vec::new(), gone: Vec::new(), found: Vec::new(), order: Vec::new(), counting: Counting::new() }
    }
}

impl Meeting {
    /// Of two pieces with this contact, of which one may move.
    pub(crate) fn of<const N: usize>(contact: &Contact<N>) -> Self {
        let touching = contact.touches.iter().any(|touch| touch.step_impulse > 0.0 || touch.point.separation <= 0.0);
        if touching { Self::Touching } else { Self::Apart }
    }
}

impl<const N: usize> World<N> {
    /// Drops the pairs for which `keep` is false. Their touches are not forgotten: the next step ends them.
    pub(crate) fn drop_pairs(&mut self, keep: impl Fn(&Self, &Pair<N>) -> bool) {
        for slot in 0..self.pairs.slots().len() {
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            let slot = slot as u32;
            if self.pairs.get(slot).is_some_and(|pair| !keep(self, pair)) {
                self.drop_pair(slot);
            }
        }
    }

    pub(crate) fn drop_pair(&mut self, slot: u32) {
        // Between steps, what the last one did is told of the pairs as it left them.
        self.list_contacts();
        if let Some(pair) = self.pairs.remove(slot).filter(|pair| pair.meeting != Meeting::Apart) {
            let bodies = in_order_of_slots(&pair, &self.bodies).map(|(bodies, _)| bodies);
            self.events.meetings.dropped.extend(bodies);
        }
    }

    /// How bodies meet at the end of a step where the solver could not know: some fell asleep, woke, or are in quarantine.
    pub(crate) fn settle_meetings(&mut self) {
        let (bodies, Meetings { dropped, gone, .. }) = (&self.bodies, &mut self.events.meetings);
        if !(self.islands.nothing_changed() && self.quarantined.is_empty()) {
            for pair in self.pairs.iter_mut() {
                let (Some(a), Some(b)) = (bodies.at(pair.body_a), bodies.at(pair.body_b)) else { continue };
                pair.meeting = if a.is_moving() || b.is_moving() {
                    pair.contact.as_deref().map_or(Meeting::Apart, Meeting::of)
                } else if pair.met && rest_together(a, b) {
                    Meeting::Asleep
                } else {
                    Meeting::Apart
                };
                if pair.meeting == Meeting::Asleep && pair.points == 0 {
                    // Forgotten in quarantine.
                    dropped.extend(in_order_of_slots(pair, bodies).map(|(bodies, _)| bodies));
                    (pair.met, pair.meeting) = (false, Meeting::Apart);
                }
            }
        }
        gone.clear();
        dropped.retain(|&(a, b)| {
            let rest = matches!((bodies.get(a), bodies.get(b)), (Some(a), Some(b)) if rest_together(a, b));
            if !rest {
                gone.push((a, b));
            }
            rest
        });
        gone.sort_unstable();
    }

    /// Makes the list of touches of the step that just ended, if it is to be made at once.
    pub(crate) fn tell_meetings(&mut self) {
        self.events.quiet = false;
        let mut list = self.events.contacts.take().unwrap_or_default();
        if self.events.asked.take().is_some() {
            self.events.meetings.tell(&self.pairs, &self.bodies, &mut list);
            self.events.contacts = list.into();
        }
    }

    /// The list of touches, made now if nobody asked before.
    pub(crate) fn list_contacts(&self) -> &[ContactEvent<N>] {
        self.events.contacts.get_or_init(|| {
            let mut list = Vec::new();
            if !self.events.quiet {
                let mut meetings = Meetings { gone: self.events.meetings.gone.clone(), ..Meetings::new() };
                meetings.tell(&self.pairs, &self.bodies, &mut list);
            }
            list
        })
    }
}

/// Whether two bodies keep their touch in silence: neither moves, and one sleeps. Two that nothing moves, since one was made static,
/// touch no more.
fn rest_together<const N: usize>(a: &Body<N>, b: &Body<N>) -> bool {
    !(a.is_moving() || b.is_moving()) && (a.kind == BodyKind::Dynamic || b.kind == BodyKind::Dynamic)
}

/// The bodies of a pair, and whether the second of the pair comes first.
fn in_order_of_slots<const N: usize>(pair: &Pair<N>, bodies: &Arena<Body<N>, BodyHandle>) -> Option<(Two, bool)> {
    let (a, b) = (bodies.handle_at(pair.body_a)?, bodies.handle_at(pair.body_b)?);
    let swap = b.index < a.index;
    Some((if swap { (b, a) } else { (a, b) }, swap))
}

impl<const N: usize> Meetings<N> {
    /// Lists what the touches of the last step did, by the slots of their bodies. Bodies of several pieces touch once.
    fn tell(&mut self, pairs: &Pairs<N>, bodies: &Arena<Body<N>, BodyHandle>, list: &mut Vec<ContactEvent<N>>) {
        let Self { gone, found, order, counting, .. } = self;
        found.clear();
        found.extend(gone.iter().map(|&bodies| end(bodies)));
        for pair in pairs.iter().filter(|pair| pair.met || pair.meeting == Meeting::Touching) {
            let Some((bodies, swap)) = in_order_of_slots(pair, bodies) else { continue };
            match (pair.meeting, pair.contact.as_deref()) {
                (Meeting::Touching, Some(contact)) => {
                    let phase = if pair.met { ContactPhase::Stay } else { ContactPhase::Begin };
                    found.push(touch(contact, bodies, swap, phase));
                }
                (Meeting::Apart, _) => found.push(end(bodies)),
                _ => {}
            }
        }
        // Pieces of the same two bodies keep the order of their pairs. What is sorted is small beside the events.
        order.clear();
        #[expect(clippy::cast_possible_truncation, reason = "fewer pairs than fit into memory")]
        order.extend(0..found.len() as u32);
        let mut sort_by = |keys: usize, key: fn(&ContactEvent<N>) -> u32| {
            counting.sort(order, keys, |touch| key(&found[touch as usize]) as usize);
        };
        // Of two handles with one slot the older one comes first: where all are good, slots are enough.
        let (slots, generations) = (bodies.slot_count(), u32::MAX as usize);
        if !gone.is_empty() {
            sort_by(generations, |touch| touch.bodies.1.generation);
        }
        sort_by(slots, |touch| touch.bodies.1.index);
        if !gone.is_empty() {
            sort_by(generations, |touch| touch.bodies.0.generation);
        }
        sort_by(slots, |touch| touch.bodies.0.index);
        list.clear();
        for touches in order.chunk_by(|&a, &b| found[a as usize].bodies == found[b as usize].bodies) {
            list.extend(merged(touches.iter().map(|&touch| &found[touch as usize])));
        }
    }
}

fn end<const N: usize>(bodies: Two) -> ContactEvent<N> {
    ContactEvent { bodies, phase: ContactPhase::End, impulse: 0.0, point: Vector::ZERO, normal: Vector::ZERO }
}

/// The touch of two pieces. `swap` tells that the contact takes the bodies the other way round.
fn touch<const N: usize>(contact: &Contact<N>, bodies: Two, swap: bool, phase: ContactPhase) -> ContactEvent<N> {
    let (mut impulse, mut point) = (0.0, Vector::ZERO);
    for touch in contact.touches.iter() {
        let part = f64::from(touch.step_impulse);
        impulse += part;
        point += touch.point.position * part;
    }
    let first = contact.touches.first().map_or(Vector::ZERO, |touch| touch.point.position);
    ContactEvent {
        bodies,
        phase,
        impulse,
        point: if impulse > 0.0 { point * (1.0 / impulse) } else { first },
        normal: if swap { -contact.normal } else { contact.normal },
    }
}

/// What the pieces of two bodies do, as one.
fn merged<'a, const N: usize>(pieces: impl Iterator<Item = &'a ContactEvent<N>> + Clone) -> Option<ContactEvent<N>> {
    let first = *pieces.clone().next()?;
    let mut touching = pieces.clone().filter(|piece| piece.phase != ContactPhase::End);
    let Some(mut event) = touching.next().copied() else { return Some(first) };
    let mut most = event.impulse;
    let mut weighted = event.point * event.impulse;
    let mut alone = true;
    for touch in touching {
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
    let mut phases = pieces.map(|piece| piece.phase);
    event.phase =
        if phases.all(|phase| phase == ContactPhase::Begin) { ContactPhase::Begin } else { ContactPhase::Stay };
    Some(event)
}

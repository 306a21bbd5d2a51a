//! Pairs of colliders whose boxes overlap, with what each remembers from step to step.
//!
//! Pairs live in slots; a slot is found from its two colliders through a map, which is only looked up and
//! never walked, and the step walks slots in order. So the order of contacts depends on the calls alone.

use std::collections::HashMap;
use std::hash::BuildHasherDefault;

use hyperbody_collision::PairCache;
use hyperbody_math::{Bivector, Pose, Vector};

use crate::Material;
use crate::ahead::{IS_HEARD, fetch, fetch_all};
use crate::body::Body;
use crate::hash::KeyHasher;
pub(crate) use crate::touches::{Anchors, Touch, Touches};

/// What pairs of numbers are sorted and found by: the first, then the second. One function for worlds of all dimensions, so that sorting
/// by it is compiled once.
pub(crate) fn in_order(&(a, b): &(u32, u32)) -> u64 {
    u64::from(a) << 32 | u64::from(b)
}

/// What comes of a pair that meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PairRole {
    /// The two push each other.
    Solid,
    /// So they do, but one-way bodies or the contact hook have a say in it at every step.
    Ruled,
    /// One is a sensor: overlap is noted, and that is all.
    Sensor,
}

impl PairRole {
    pub(crate) fn of<const N: usize>(a: &Body<N>, b: &Body<N>) -> Self {
        let ruled = |body: &Body<N>| body.one_way.is_some() || body.contact_hook;
        if a.sensor || b.sensor {
            Self::Sensor
        } else if ruled(a) || ruled(b) {
            Self::Ruled
        } else {
            Self::Solid
        }
    }
}

/// What of two surfaces in contact the solver has to know beforehand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
    pub(crate) bounces: bool,
    pub(crate) resists: bool,
}

impl Surface {
    pub(crate) fn of(a: &Material, b: &Material) -> Self {
        let (rolling, twisting) = a.combined_resistance(b);
        Self { bounces: a.combined_restitution(b) > 0.0, resists: rolling > 0.0 || twisting > 0.0 }
    }
}

/// How a pair with a one-way body stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Passage {
    /// The two are apart.
    Apart,
    /// Met on the side that holds.
    Held,
    /// Met on another side: no contact until they have come apart.
    Passing,
}

/// How the bodies of a pair met in the last step, as events tell it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meeting {
    /// They did not touch, or nothing can move them.
    Apart,
    /// They touched, and one of them may move.
    Touching,
    /// They touched when they fell asleep, and have not moved since.
    Asleep,
}

/// Two colliders that may touch: what every step looks at. Of the many pairs that are near each other few touch, and of
/// those that touch few have moved; what the others need stands apart, so that passing by costs one line of cache.
#[derive(Clone, Debug)]
pub(crate) struct Pair<const N: usize> {
    /// Slots of the colliders, a < b.
    pub(crate) collider_a: u32,
    pub(crate) collider_b: u32,
    /// Slots of their bodies.
    pub(crate) body_a: u32,
    pub(crate) body_b: u32,
    /// What was found of the two holds while the sum of their ways is at most this (see `Motion::way`), m.
    pub(crate) holds_until: f64,
    /// Deepest overlap of its points, m; zero where none overlaps.
    pub(crate) deepest: f64,
    /// Points of its manifold, and how many of them overlap.
    pub(crate) points: u8,
    pub(crate) touching: u8,
    /// Whether the surfaces bounce.
    pub(crate) bounces: bool,
    /// Whether rolling or twisting is resisted.
    pub(crate) resists: bool,
    pub(crate) role: PairRole,
    /// Of sensors: whether the two overlap.
    pub(crate) overlaps: bool,
    /// Whether both are balls, which know no seams.
    pub(crate) round: bool,
    /// Whether its contact approaches, as ghosts at seams do.
    pub(crate) suspect: bool,
    pub(crate) meeting: Meeting,
    /// Whether they met in the step before.
    pub(crate) met: bool,
    /// Of one-way bodies.
    pub(crate) passage: Passage,
    pub(crate) search: Box<Search<N>>,
    /// Made when the two touch for the first time.
    pub(crate) contact: Option<Box<Contact<N>>>,
}

impl<const N: usize> Pair<N> {
    /// What a copy of it takes beside itself, bytes.
    pub(crate) fn memory(&self) -> usize {
        let search = size_of::<Search<N>>();
        let lists = |contact: &Contact<N>| contact.touches.memory() + size_of_val(contact.anchors.as_slice());
        search + self.contact.as_deref().map_or(0, |contact| size_of_val(contact) + lists(contact))
    }
}

/// What searching for contact anew starts from.
#[derive(Clone, Debug)]
pub(crate) struct Search<const N: usize> {
    /// The relative pose of the last search, if its outcome may be kept while the two hardly move.
    pub(crate) a_from_b: Option<Pose<N>>,
    /// What the narrow phase wants to keep.
    pub(crate) cache: PairCache<N>,
}

/// What two colliders that touch remember: the manifold of the last narrow phase, and how it is carried on. First what every
/// step asks for.
#[derive(Clone, Debug)]
#[repr(C)]
pub(crate) struct Contact<const N: usize> {
    /// Where they touch.
    pub(crate) touches: Touches<N>,
    /// Unit vector from a to b in the world; zero while there are no points.
    pub(crate) normal: Vector<N>,
    /// Of both surfaces, by their rules.
    pub(crate) friction: f64,
    pub(crate) restitution: f64,
    /// Which part of what moving on adds to the angular momentum b takes back; see `wandering`.
    pub(crate) share_of_b: f64,
    /// Warm start: friction impulse on b over one substep, world frame, N·s.
    pub(crate) friction_impulse: Vector<N>,
    /// How b's surface runs against a's, beside what the bodies say, world axes, m/s: asked for by the contact hook.
    pub(crate) surface: Vector<N>,
    /// The normal in the frame of a, which carries it along.
    pub(crate) normal_in_a: Vector<N>,
    /// One a touch but for those of balls: from them the points are made anew while the two hardly move.
    pub(crate) anchors: Vec<Anchors<N>>,
    /// Warm start: twisting friction impulse on b over one substep, and that of resistance to rolling, world frame, N·m·s.
    pub(crate) twist_impulse: Bivector<N>,
    /// Resistance to rolling and to twisting, m.
    pub(crate) resistance: (f64, f64),
    /// Radii by which the colliders' cores are rounded, m.
    pub(crate) radii: (f64, f64),
}

impl<const N: usize> Contact<N> {
    /// Nothing touches anything.
    pub(crate) const NONE: Self = Self {
        touches: Touches::List(Vec::new()),
        normal: Vector::ZERO,
        friction: 0.0,
        restitution: 0.0,
        share_of_b: 0.5,
        friction_impulse: Vector::ZERO,
        surface: Vector::ZERO,
        normal_in_a: Vector::ZERO,
        anchors: Vec::new(),
        twist_impulse: Bivector::ZERO,
        resistance: (0.0, 0.0),
        radii: (0.0, 0.0),
    };

    /// Forgets points, normal and the impulses of friction.
    pub(crate) fn clear(&mut self) {
        self.touches.clear();
        self.anchors.clear();
        self.normal = Vector::ZERO;
        self.friction_impulse = Vector::ZERO;
        self.twist_impulse = Bivector::ZERO;
    }
}

impl<const N: usize> Pair<N> {
    /// A pair of which nothing is known yet.
    pub(crate) fn new(
        (collider_a, body_a): (u32, u32),
        (collider_b, body_b): (u32, u32),
        role: PairRole,
        surface: Surface,
    ) -> Self {
        Self {
            collider_a,
            collider_b,
            body_a,
            body_b,
            holds_until: f64::NEG_INFINITY,
            deepest: 0.0,
            points: 0,
            touching: 0,
            bounces: surface.bounces,
            resists: surface.resists,
            role,
            overlaps: false,
            round: false,
            suspect: false,
            meeting: Meeting::Apart,
            met: false,
            passage: Passage::Apart,
            search: Box::new(Search { a_from_b: None, cache: PairCache::default() }),
            contact: None,
        }
    }

    pub(crate) fn surface(&self) -> Surface {
        Surface { bounces: self.bounces, resists: self.resists }
    }

    /// Forgets contact and impulses, as if the two had never met; events still have to tell what came of their touch.
    pub(crate) fn forget(&mut self) {
        let surface = self.surface();
        let new = Self::new((self.collider_a, self.body_a), (self.collider_b, self.body_b), self.role, surface);
        *self = Self { meeting: self.meeting, met: self.met, ..new };
    }

    /// The touching points; none where the two have not met.
    pub(crate) fn touches(&self) -> &[Touch<N>] {
        self.contact.as_ref().map_or(&[], |contact| &contact.touches)
    }

    /// Unit vector from a to b in the world; zero while there are no points.
    pub(crate) fn normal(&self) -> Vector<N> {
        self.contact.as_ref().map_or(Vector::ZERO, |contact| contact.normal)
    }

    /// Notes what the manifold holds.
    pub(crate) fn summarize(&mut self) {
        let mut summary = Summary::default();
        self.touches().iter().for_each(|touch| summary.count(touch.point.separation));
        self.note(&summary);
    }

    /// Notes what is known of the points of the manifold.
    #[inline]
    pub(crate) fn note(&mut self, summary: &Summary) {
        (self.deepest, self.touching, self.points) = (summary.deepest, summary.touching, summary.points);
        if summary.points == 0 && self.meeting == Meeting::Touching {
            self.meeting = Meeting::Apart;
        }
    }
}

/// What a pair has at hand of the points of its manifold; see there.
#[derive(Default)]
pub(crate) struct Summary {
    deepest: f64,
    points: u8,
    touching: u8,
}

impl Summary {
    /// One more point, at a separation in m.
    #[inline]
    pub(crate) fn count(&mut self, separation: f64) {
        self.points += 1;
        if separation <= 0.0 {
            self.touching += 1;
            if -separation > self.deepest {
                self.deepest = -separation;
            }
        }
    }
}

/// Asks for what the pairs after `slot` remember, where slots are walked in order; see [`crate::ahead`].
#[inline]
pub(crate) fn fetch_contacts<const N: usize>(slots: &[Option<Pair<N>>], slot: usize) {
    if !IS_HEARD {
        return;
    }
    let touching = |slot: usize| slots.get(slot)?.as_ref().filter(|pair| pair.points > 0);
    if let Some(pair) = touching(slot + 16)
        && let Some(contact) = pair.contact.as_deref()
    {
        if pair.round {
            fetch(contact, std::mem::offset_of!(Contact<N>, friction));
        } else {
            fetch(contact, std::mem::offset_of!(Contact<N>, twist_impulse));
        }
    }
    if let Some(pair) = touching(slot + 8).filter(|pair| !pair.round)
        && let Some(contact) = pair.contact.as_deref()
        && let Touches::List(touches) = &contact.touches
    {
        fetch_all(touches);
        fetch_all(&contact.anchors);
    }
}

/// All pairs of a world.
#[derive(Clone, Debug)]
pub(crate) struct Pairs<const N: usize> {
    pub(crate) slots: Vec<Option<Pair<N>>>,
    /// By slot: its colliders once more, side by side, for walks that ask for nothing else; [`NONE`] where there is no pair.
    pub(crate) keys: Vec<(u32, u32)>,
    pub(crate) free: Vec<u32>,
    pub(crate) slot_of: HashMap<u64, u32, BuildHasherDefault<KeyHasher>>,
    /// Slots of the pairs with points, and of those of sensors that overlap, ascending: found by the narrow phase, for the stages
    /// after it.
    pub(crate) contacts: Vec<u32>,
    pub(crate) overlaps: Vec<u32>,
}

/// The key of an empty slot.
pub(crate) const NONE: (u32, u32) = (u32::MAX, u32::MAX);

impl<const N: usize> Pairs<N> {
    pub(crate) fn new() -> Self {
        Self {
            slots: Vec::new(),
            keys: Vec::new(),
            free: Vec::new(),
            slot_of: HashMap::default(),
            contacts: Vec::new(),
            overlaps: Vec::new(),
        }
    }

    pub(crate) fn contains(&self, collider_a: u32, collider_b: u32) -> bool {
        self.slot_of.contains_key(&in_order(&(collider_a, collider_b)))
    }

    pub(crate) fn insert(&mut self, pair: Pair<N>) {
        let key = (pair.collider_a, pair.collider_b);
        let slot = self.free.pop().unwrap_or_else(|| {
            self.slots.push(None);
            self.keys.push(NONE);
            #[expect(clippy::cast_possible_truncation, reason = "fewer pairs than fit into memory")]
            let last = (self.slots.len() - 1) as u32;
            last
        });
        self.slots[slot as usize] = Some(pair);
        self.keys[slot as usize] = key;
        self.slot_of.insert(in_order(&key), slot);
    }

    pub(crate) fn remove(&mut self, slot: u32) -> Option<Pair<N>> {
        let pair = self.slots[slot as usize].take()?;
        self.keys[slot as usize] = NONE;
        self.slot_of.remove(&in_order(&(pair.collider_a, pair.collider_b)));
        self.free.push(slot);
        Some(pair)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Pair<N>> {
        self.slots.iter().flatten()
    }

    /// Those with points, with their slots, since the narrow phase of this step.
    pub(crate) fn contacts(&self) -> impl Iterator<Item = (u32, &Pair<N>)> {
        let taken = self.contacts.iter().filter_map(|&slot| Some((slot, self.get(slot)?)));
        taken.filter(|(_, pair)| pair.points > 0)
    }

    /// Those of sensors that overlap.
    pub(crate) fn overlaps(&self) -> impl Iterator<Item = &Pair<N>> {
        self.overlaps.iter().filter_map(|&slot| self.get(slot)).filter(|pair| pair.overlaps)
    }

    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut Pair<N>> {
        self.slots.iter_mut().flatten()
    }

    /// The pair of two colliders, a < b.
    pub(crate) fn of(&self, collider_a: u32, collider_b: u32) -> Option<&Pair<N>> {
        self.get(*self.slot_of.get(&in_order(&(collider_a, collider_b)))?)
    }

    pub(crate) fn get(&self, slot: u32) -> Option<&Pair<N>> {
        self.slots[slot as usize].as_ref()
    }

    pub(crate) fn get_mut(&mut self, slot: u32) -> Option<&mut Pair<N>> {
        self.slots[slot as usize].as_mut()
    }

    pub(crate) fn slots(&self) -> &[Option<Pair<N>>] {
        &self.slots
    }

    pub(crate) fn slots_mut(&mut self) -> &mut [Option<Pair<N>>] {
        &mut self.slots
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::bodies::Sizes;
    use crate::world::Collider;

    fn sizes<const N: usize>() -> [usize; 8] {
        let solver = size_of::<crate::solver::bodies::SolverBody<N>>() + Sizes::<N>::STATE * size_of::<f32>();
        [
            size_of::<Body<N>>(),
            size_of::<Collider<N>>(),
            solver,
            size_of::<Option<Pair<N>>>(),
            size_of::<Search<N>>(),
            size_of::<Contact<N>>(),
            size_of::<Touch<N>>(),
            size_of::<Anchors<N>>(),
        ]
    }

    /// What docs/performance.md states, in bytes: body, collider, body in the solver, pair, search, contact, a point of it and
    /// its anchors.
    #[test]
    #[cfg(target_pointer_width = "64")]
    fn bodies_and_contacts_take_the_stated_memory() {
        let stated = [
            [672, 208, 272, 64, 224, 224, 40, 32],
            [1080, 336, 480, 64, 280, 304, 48, 48],
            [1616, 496, 736, 64, 352, 400, 56, 64],
            [2280, 688, 1040, 64, 440, 512, 64, 80],
            [3072, 912, 1424, 64, 544, 640, 72, 96],
        ];
        assert_eq!([sizes::<2>(), sizes::<3>(), sizes::<4>(), sizes::<5>(), sizes::<6>()], stated);
    }
}

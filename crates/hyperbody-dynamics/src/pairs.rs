//! Pairs of colliders whose boxes overlap, with what each remembers from step to step.
//!
//! Pairs live in slots; a slot is found from its two colliders through an ordered map, which is only looked up and
//! never walked, and the step walks slots in order. So the order of contacts depends on the calls alone.

use std::collections::BTreeMap;

use hyperbody_collision::{MAX_POINTS, Manifold, PairCache};
use hyperbody_math::{Bivector, Pose, Vector};

use crate::Material;
use crate::body::Body;

/// What pairs of numbers are sorted by: the first, then the second. One function for worlds of all dimensions, so that sorting
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
    pub(crate) const NONE: Self = Self { bounces: false, resists: false };

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
    /// Of one-way bodies.
    pub(crate) passage: Passage,
    pub(crate) search: Box<Search<N>>,
    /// Made when the two touch for the first time.
    pub(crate) contact: Option<Box<Contact<N>>>,
}

impl<const N: usize> Pair<N> {
    /// What it takes beside itself, bytes.
    pub(crate) fn memory(&self) -> usize {
        let search = size_of::<Search<N>>();
        search + self.contact.as_ref().map_or(0, |_| size_of::<Contact<N>>())
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

/// What two colliders that touch remember.
#[derive(Clone, Debug)]
pub(crate) struct Contact<const N: usize> {
    /// Radii by which the colliders' cores are rounded, m.
    pub(crate) radii: (f64, f64),
    /// Of both surfaces, by their rules.
    pub(crate) friction: f64,
    pub(crate) restitution: f64,
    /// Resistance to rolling and to twisting, m.
    pub(crate) resistance: (f64, f64),
    /// How b's surface runs against a's, beside what the bodies say, world axes, m/s: asked for by the contact hook.
    pub(crate) surface: Vector<N>,
    /// Which part of what moving on adds to the angular momentum b takes back; see `wandering`.
    pub(crate) share_of_b: f64,
    /// The touching points of the last narrow phase.
    pub(crate) manifold: Manifold<N>,
    /// Warm start: normal impulse of each point over one substep, N·s.
    pub(crate) normal_impulses: [f32; MAX_POINTS],
    /// Normal impulse of each point over the last step, N·s.
    pub(crate) step_impulses: [f32; MAX_POINTS],
    /// Warm start: friction impulse on b over one substep, world frame, N·s.
    pub(crate) friction_impulse: Vector<N>,
    /// Warm start: twisting friction impulse on b over one substep, and that of resistance to rolling, world frame, N·m·s.
    pub(crate) twist_impulse: Bivector<N>,
    /// The manifold as the bodies carry it along.
    pub(crate) carried: Carried<N>,
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
            passage: Passage::Apart,
            search: Box::new(Search { a_from_b: None, cache: PairCache::default() }),
            contact: None,
        }
    }

    pub(crate) fn surface(&self) -> Surface {
        Surface { bounces: self.bounces, resists: self.resists }
    }

    /// Forgets contact and impulses, as if the two had never met.
    pub(crate) fn forget(&mut self) {
        let surface = self.surface();
        *self = Self::new((self.collider_a, self.body_a), (self.collider_b, self.body_b), self.role, surface);
    }

    /// The touching points, with their normal; empty where the two have not met.
    pub(crate) fn manifold(&self) -> &Manifold<N> {
        self.contact.as_ref().map_or(const { &Manifold::EMPTY }, |contact| &contact.manifold)
    }

    /// Notes what the manifold holds.
    pub(crate) fn summarize(&mut self) {
        let (mut deepest, mut touching) = (0.0_f64, 0);
        for point in self.manifold().points() {
            if point.separation <= 0.0 {
                deepest = deepest.max(-point.separation);
                touching += 1;
            }
        }
        #[expect(clippy::cast_possible_truncation, reason = "at most MAX_POINTS")]
        let points = self.manifold().points().len() as u8;
        (self.deepest, self.touching, self.points) = (deepest, touching, points);
    }
}

/// A manifold in the frames of its two colliders, from which it can be made anew while they hardly move.
#[derive(Clone, Debug)]
pub(crate) struct Carried<const N: usize> {
    pub(crate) normal_in_a: Vector<N>,
    /// The two surfaces' points of each contact point.
    pub(crate) anchors: [(Vector<N>, Vector<N>); MAX_POINTS],
}

/// All pairs of a world.
#[derive(Clone, Debug)]
pub(crate) struct Pairs<const N: usize> {
    pub(crate) slots: Vec<Option<Pair<N>>>,
    pub(crate) free: Vec<u32>,
    pub(crate) slot_of: BTreeMap<(u32, u32), u32>,
}

impl<const N: usize> Pairs<N> {
    pub(crate) const fn new() -> Self {
        Self { slots: Vec::new(), free: Vec::new(), slot_of: BTreeMap::new() }
    }

    pub(crate) fn contains(&self, collider_a: u32, collider_b: u32) -> bool {
        self.slot_of.contains_key(&(collider_a, collider_b))
    }

    pub(crate) fn insert(&mut self, pair: Pair<N>) {
        let key = (pair.collider_a, pair.collider_b);
        let slot = self.free.pop().unwrap_or_else(|| {
            self.slots.push(None);
            #[expect(clippy::cast_possible_truncation, reason = "fewer pairs than fit into memory")]
            let last = (self.slots.len() - 1) as u32;
            last
        });
        self.slots[slot as usize] = Some(pair);
        self.slot_of.insert(key, slot);
    }

    /// Removes the pairs for which `keep` is false.
    pub(crate) fn retain(&mut self, mut keep: impl FnMut(&Pair<N>) -> bool) {
        for (index, slot) in self.slots.iter_mut().enumerate() {
            if let Some(pair) = slot
                && !keep(pair)
            {
                self.slot_of.remove(&(pair.collider_a, pair.collider_b));
                *slot = None;
                #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
                self.free.push(index as u32);
            }
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Pair<N>> {
        self.slots.iter().flatten()
    }

    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut Pair<N>> {
        self.slots.iter_mut().flatten()
    }

    /// The pair of two colliders, a < b.
    pub(crate) fn of(&self, collider_a: u32, collider_b: u32) -> Option<&Pair<N>> {
        self.get(*self.slot_of.get(&(collider_a, collider_b))?)
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

    fn sizes<const N: usize>() -> [usize; 6] {
        let solver = size_of::<crate::solver::bodies::SolverBody<N>>() + Sizes::<N>::STATE * size_of::<f32>();
        [
            size_of::<Body<N>>(),
            size_of::<Collider<N>>(),
            solver,
            size_of::<Option<Pair<N>>>(),
            size_of::<Search<N>>(),
            size_of::<Contact<N>>(),
        ]
    }

    /// What docs/performance.md states, in bytes: body, collider, body in the solver, pair, search, contact.
    #[test]
    #[cfg(target_pointer_width = "64")]
    fn bodies_and_contacts_take_the_stated_memory() {
        let stated = [
            [672, 208, 344, 64, 224, 1312],
            [1080, 336, 528, 64, 280, 1768],
            [1616, 496, 760, 64, 352, 2240],
            [2280, 688, 1040, 64, 440, 2728],
            [3072, 912, 1400, 64, 544, 3232],
        ];
        assert_eq!([sizes::<2>(), sizes::<3>(), sizes::<4>(), sizes::<5>(), sizes::<6>()], stated);
    }
}

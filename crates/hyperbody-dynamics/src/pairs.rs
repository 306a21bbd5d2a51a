//! Pairs of colliders whose boxes overlap, with what each remembers from step to step.
//!
//! Pairs live in slots; a slot is found from its two colliders through an ordered map, which is only looked up and
//! never walked, and the step walks slots in order. So the order of contacts depends on the calls alone.

use std::collections::BTreeMap;

use hyperbody_collision::{MAX_POINTS, Manifold, PairCache};
use hyperbody_math::{Bivector, Pose, Vector};

/// Two colliders that may touch.
#[derive(Clone, Debug)]
pub(crate) struct Pair<const N: usize> {
    /// Slots of the colliders, a < b.
    pub(crate) collider_a: u32,
    pub(crate) collider_b: u32,
    /// Slots of their bodies.
    pub(crate) body_a: u32,
    pub(crate) body_b: u32,
    /// Radii by which the colliders' cores are rounded, m.
    pub(crate) radii: (f64, f64),
    /// √(μ_a μ_b).
    pub(crate) friction: f64,
    /// max(e_a, e_b).
    pub(crate) restitution: f64,
    /// The touching points of the last narrow phase.
    pub(crate) manifold: Manifold<N>,
    /// Warm start: normal impulse of each point over one substep, N·s.
    pub(crate) normal_impulses: [f32; MAX_POINTS],
    /// Normal impulse of each point over the last step, N·s.
    pub(crate) step_impulses: [f32; MAX_POINTS],
    /// Warm start: friction impulse on b over one substep, world frame, N·s.
    pub(crate) friction_impulse: Vector<N>,
    /// Warm start: twisting friction impulse on b over one substep, world frame, N·m·s.
    pub(crate) twist_impulse: Bivector<N>,
    /// The contact as the bodies carry it along, if it may be kept.
    pub(crate) recycled: Option<Recycled<N>>,
    /// What the narrow phase wants to keep.
    pub(crate) cache: PairCache<N>,
}

impl<const N: usize> Pair<N> {
    /// Forgets contact and impulses, as if the two had never met.
    pub(crate) fn forget(&mut self) {
        self.manifold.clear();
        self.normal_impulses = [0.0; MAX_POINTS];
        self.step_impulses = [0.0; MAX_POINTS];
        self.friction_impulse = Vector::ZERO;
        self.twist_impulse = Bivector::ZERO;
        self.recycled = None;
        self.cache = PairCache::default();
    }
}

/// A manifold in the frames of its two colliders, from which it can be made anew while they hardly move.
#[derive(Clone, Debug)]
pub(crate) struct Recycled<const N: usize> {
    /// When the manifold was computed.
    pub(crate) a_from_b: Pose<N>,
    pub(crate) normal_in_a: Vector<N>,
    /// The two surfaces' points of each contact point.
    pub(crate) anchors: [(Vector<N>, Vector<N>); MAX_POINTS],
}

/// All pairs of a world.
#[derive(Clone, Debug)]
pub(crate) struct Pairs<const N: usize> {
    slots: Vec<Option<Box<Pair<N>>>>,
    free: Vec<u32>,
    slot_of: BTreeMap<(u32, u32), u32>,
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
        self.slots[slot as usize] = Some(Box::new(pair));
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
        self.slots.iter().flatten().map(AsRef::as_ref)
    }

    pub(crate) fn get(&self, slot: u32) -> Option<&Pair<N>> {
        self.slots[slot as usize].as_deref()
    }

    pub(crate) fn get_mut(&mut self, slot: u32) -> Option<&mut Pair<N>> {
        self.slots[slot as usize].as_deref_mut()
    }

    pub(crate) fn slots(&self) -> &[Option<Box<Pair<N>>>] {
        &self.slots
    }

    pub(crate) fn slots_mut(&mut self) -> &mut [Option<Box<Pair<N>>>] {
        &mut self.slots
    }
}

//! Contacts that stopped something: what hands feel and ears hear.
//!
//! A body at rest is carried by impulses too, the same at every step. An impact is a pair whose impulse rises well above what it
//! had in the step before, by enough to change the speed of the lighter body noticeably.

use hyperbody::math::Vector;
use hyperbody::prelude::{BodyHandle, World};

/// Least change of speed of the lighter body, m/s.
const LEAST_SPEED: f64 = 0.15;

/// Most impacts that a frame reports: the strongest, and beside them those of what is held.
const MOST: usize = 32;

/// Impacts that wait for a frame to report them.
const MOST_WAITING: usize = 4096;

/// One impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Impact<const N: usize> {
    pub(crate) bodies: (BodyHandle, BodyHandle),
    /// N·s.
    pub(crate) impulse: f64,
    pub(crate) point: Vector<N>,
}

/// Watches the contacts of a world from step to step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Impacts<const N: usize> {
    /// Impulse of each pair in the last step, sorted by pair.
    before: Vec<((BodyHandle, BodyHandle), f64)>,
    now: Vec<((BodyHandle, BodyHandle), f64, Vector<N>)>,
    /// Since the last [`Impacts::take`].
    found: Vec<Impact<N>>,
}

impl<const N: usize> Impacts<N> {
    /// Looks at the contacts of the step that the world has just made.
    pub(crate) fn look(&mut self, world: &World<N>) {
        self.now.clear();
        if self.found.len() > MOST_WAITING {
            self.found.clear();
        }
        for contact in world.contacts() {
            let (mut total, mut point) = (0.0, Vector::ZERO);
            for (position, _, impulse) in contact.points() {
                total += impulse;
                point += position * impulse;
            }
            if total > 0.0 {
                self.now.push((contact.bodies(), total, point));
            }
        }
        // Pieces of one pair of bodies count together.
        self.now.sort_unstable_by_key(|(bodies, ..)| *bodies);
        self.now.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1 += next.1;
                kept.2 += next.2;
            }
            same
        });
        for &(bodies, impulse, weighted) in &self.now {
            let last = self.before.binary_search_by_key(&bodies, |(pair, _)| *pair);
            let last = last.map_or(0.0, |index| self.before[index].1);
            let rise = impulse - last;
            let mass = |handle| world.body(handle).map_or(0.0, |body| body.mass());
            let (a, b) = (mass(bodies.0), mass(bodies.1));
            let lighter = if a == 0.0 || (b > 0.0 && b < a) { b } else { a };
            // What one step of gravity needs is not an impact.
            let carried = lighter * world.gravity().norm() * world.dt();
            if rise > LEAST_SPEED * lighter + carried && rise > last {
                self.found.push(Impact { bodies, impulse: rise, point: weighted / impulse });
            }
        }
        self.before.clear();
        self.before.extend(self.now.iter().map(|(bodies, impulse, _)| (*bodies, *impulse)));
    }

    /// What has happened since the last call, strongest first; none of what is held is left out.
    pub(crate) fn take(&mut self, is_held: impl Fn(BodyHandle) -> bool) -> Vec<Impact<N>> {
        let mut found = std::mem::take(&mut self.found);
        found.sort_by(|a, b| b.impulse.total_cmp(&a.impulse).then(a.bodies.cmp(&b.bodies)));
        let mut kept = 0;
        found.retain(|impact| {
            kept += 1;
            kept <= MOST || is_held(impact.bodies.0) || is_held(impact.bodies.1)
        });
        found
    }
}

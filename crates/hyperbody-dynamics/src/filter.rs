//! Who may touch whom, geometry aside: groups and masks, and pairs of bodies that are switched off.
//!
//! A pair that is not allowed is never made: it costs nothing after the broad phase has looked at it once. Bodies tied by a
//! joint leave each other alone too, unless the joint says otherwise ([`JointDef::collide`](crate::JointDef::collide)).

use std::collections::BTreeSet;

use crate::body::Body;
use crate::world::stale;
use crate::{BodyHandle, BodyKind, World, WorldError, WorldErrorKind};

/// Which of 32 groups a body is in, and which it meets, one bit a group. Two bodies meet if each is in a group that the
/// other one meets. The default is in all groups and meets all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Groups {
    /// The groups that the body is in.
    pub memberships: u32,
    /// The groups that it meets.
    pub mask: u32,
}

impl Groups {
    /// In all groups, meeting all.
    pub const ALL: Self = Self { memberships: u32::MAX, mask: u32::MAX };

    /// In no group, meeting none: passes through everything.
    pub const NONE: Self = Self { memberships: 0, mask: 0 };

    /// In the groups of the bits of `memberships`, meeting those of `mask`.
    #[must_use]
    pub const fn new(memberships: u32, mask: u32) -> Self {
        Self { memberships, mask }
    }

    /// Whether each of the two is in a group that the other one meets.
    ///
    /// ```
    /// use hyperbody_dynamics::Groups;
    ///
    /// const WALLS: u32 = 1 << 0;
    /// const GHOSTS: u32 = 1 << 1;
    /// const FLOORS: u32 = 1 << 2;
    /// let ghost = Groups::new(GHOSTS, FLOORS);
    /// assert!(ghost.meets(Groups::new(FLOORS, u32::MAX)));
    /// assert!(!ghost.meets(Groups::new(WALLS, u32::MAX)));
    /// ```
    #[must_use]
    pub const fn meets(self, other: Self) -> bool {
        self.memberships & other.mask != 0 && other.memberships & self.mask != 0
    }
}

impl Default for Groups {
    fn default() -> Self {
        Self::ALL
    }
}

/// Pairs of bodies that do not meet, by slot, the lower one first. Looked up, never walked in the step.
#[derive(Clone, Debug, Default)]
pub(crate) struct IgnoredPairs(pub(crate) BTreeSet<(u32, u32)>);

impl IgnoredPairs {
    pub(crate) const fn new() -> Self {
        Self(BTreeSet::new())
    }

    fn key(a: u32, b: u32) -> (u32, u32) {
        (a.min(b), a.max(b))
    }

    pub(crate) fn holds(&self, a: u32, b: u32) -> bool {
        !self.0.is_empty() && self.0.contains(&Self::key(a, b))
    }

    /// Forgets a body that is gone: its slot may be used again.
    pub(crate) fn forget_body(&mut self, slot: u32) {
        self.0.retain(|&(a, b)| a != slot && b != slot);
    }
}

impl<const N: usize> World<N> {
    /// Switches collision between two bodies off or on again, whatever their groups say. Both wake. Forgotten when one of
    /// them is removed.
    ///
    /// # Errors
    /// If a handle is stale, or both are the same body.
    pub fn set_collision(&mut self, a: BodyHandle, b: BodyHandle, enabled: bool) -> Result<(), WorldError> {
        if self.bodies.get(a).is_none() || self.bodies.get(b).is_none() {
            return Err(stale("body"));
        }
        if a == b {
            let message = "a body never collides with itself; name two bodies";
            return Err(WorldError::new(WorldErrorKind::NotAllowed, message));
        }
        let key = IgnoredPairs::key(a.index, b.index);
        if enabled {
            self.ignored.0.remove(&key)
        } else {
            self.ignored.0.insert(key)
        };
        for handle in [a, b] {
            if let Some(body) = self.bodies.get_mut(handle) {
                body.refilter = true;
                self.wake_requests.push(handle.index);
            }
        }
        Ok(())
    }

    /// Whether two bodies collide where they meet: false for those that are switched off, whose groups do not meet, that
    /// are tied by a joint that keeps them apart, of which none moves, or of which one is gone.
    #[must_use]
    pub fn may_collide(&self, a: BodyHandle, b: BodyHandle) -> bool {
        self.bodies.get(a).is_some() && self.bodies.get(b).is_some() && a != b && self.may_pair(a.index, b.index)
    }

    /// Whether the bodies of two slots, different ones, may touch or be noticed.
    pub(crate) fn may_pair(&self, a: u32, b: u32) -> bool {
        let (Some(body_a), Some(body_b)) = (self.bodies.at(a), self.bodies.at(b)) else { return false };
        let kinds = if body_a.sensor || body_b.sensor {
            body_a.kind != BodyKind::Static || body_b.kind != BodyKind::Static
        } else {
            body_a.kind == BodyKind::Dynamic || body_b.kind == BodyKind::Dynamic
        };
        kinds && body_a.groups.meets(body_b.groups) && !self.ignored.holds(a, b) && !self.are_joined(body_a, b)
    }

    fn are_joined(&self, body: &Body<N>, other: u32) -> bool {
        body.joints
            .iter()
            .filter_map(|&slot| self.joints.at(slot))
            .any(|joint| (joint.body_a == other || joint.body_b == other) && !joint.def.collide)
    }
}

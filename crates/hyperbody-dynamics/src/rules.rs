//! Pairs that do more than push: sensors, one-way bodies, and contacts on which the user has a say.
//!
//! They are looked at apart from all others, afresh whenever something moved, so that ordinary pairs pay nothing for them.

use std::fmt;
use std::sync::Arc;

use hyperbody_collision::{ContactPoint, Manifold, Scratch, collide};
use hyperbody_math::Vector;

use crate::body::Body;
use crate::narrow_phase::Update;
use crate::pairs::{Pair, Passage};
use crate::world::Collider;
use crate::{BodyHandle, BodyRef, World};

/// A say in contacts, asked at every step for every pair of convex pieces that touch or are about to, of which one body has
/// [`BodyDef::contact_hook`](crate::BodyDef::contact_hook) set.
///
/// It is called from the threads of the world, in no order. For results that are the same bits for every number of threads it
/// has to answer by the pair alone: by what it is given, and by data of its own that no call changes. Closures will do:
///
/// ```
/// use hyperbody_dynamics::{BodyDef, HookedContact, World, WorldDef};
/// use hyperbody_geometry::Shape;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut world = World::<3>::new(WorldDef::default())?;
/// let ice = world.add_body(BodyDef::fixed(Shape::half_space([0.0, 1.0, 0.0], 0.0)?).contact_hook(true))?;
/// world.add_body(BodyDef::new(Shape::cuboid([0.5; 3])?).position([0.0, 0.5, 0.0]).velocity([2.0, 0.0, 0.0]))?;
/// world.set_contact_hook(move |contact: &mut HookedContact<'_, 3>| {
///     if contact.bodies().0 == ice {
///         contact.set_friction(0.0);
///     }
/// });
/// world.step();
/// # Ok(())
/// # }
/// ```
pub trait ContactHook<const N: usize>: Send + Sync {
    /// Looks at a contact and changes what it wants.
    fn modify(&self, contact: &mut HookedContact<'_, N>);
}

impl<const N: usize, F: Fn(&mut HookedContact<'_, N>) + Send + Sync> ContactHook<N> for F {
    fn modify(&self, contact: &mut HookedContact<'_, N>) {
        self(contact);
    }
}

/// The hook of a world, shared by its threads.
#[derive(Clone)]
pub(crate) struct Hook<const N: usize>(Arc<dyn ContactHook<N>>);

impl<const N: usize> fmt::Debug for Hook<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Hook")
    }
}

/// A contact of this step before it is solved, as a [`ContactHook`] may change it.
#[derive(Debug)]
pub struct HookedContact<'a, const N: usize> {
    handles: (BodyHandle, BodyHandle),
    bodies: (&'a Body<N>, &'a Body<N>),
    manifold: &'a mut Manifold<N>,
    friction: f64,
    restitution: f64,
    surface: Vector<N>,
}

impl<const N: usize> HookedContact<'_, N> {
    /// The two bodies, a and b; which is which stays the same while they live.
    #[must_use]
    pub fn bodies(&self) -> (BodyHandle, BodyHandle) {
        self.handles
    }

    /// The two bodies to read, as they are at the start of the step.
    #[must_use]
    pub fn body_refs(&self) -> (BodyRef<'_, N>, BodyRef<'_, N>) {
        (BodyRef { body: self.bodies.0 }, BodyRef { body: self.bodies.1 })
    }

    /// Unit normal in the world, from a to b.
    #[must_use]
    pub fn normal(&self) -> Vector<N> {
        self.manifold.normal
    }

    /// The points, each with its place in the world (m) and its separation (m, negative is overlap).
    #[must_use]
    pub fn points(&self) -> &[ContactPoint<N>] {
        self.manifold.points()
    }

    /// Keeps the points for which `keep` is true. Without points the two pass through each other in this step.
    pub fn retain_points(&mut self, mut keep: impl FnMut(&ContactPoint<N>) -> bool) {
        let mut kept = Manifold::EMPTY;
        kept.normal = self.manifold.normal;
        for point in self.manifold.points().iter().filter(|point| keep(point)) {
            kept.push(*point);
        }
        *self.manifold = kept;
    }

    /// Coulomb coefficient of the contact.
    #[must_use]
    pub fn friction(&self) -> f64 {
        self.friction
    }

    /// Sets it. What is not finite is left out; below zero counts as zero.
    pub fn set_friction(&mut self, friction: f64) {
        if friction.is_finite() {
            self.friction = friction.max(0.0);
        }
    }

    /// Share of the approach speed that a bounce gives back.
    #[must_use]
    pub fn restitution(&self) -> f64 {
        self.restitution
    }

    /// Sets it, brought to 0..=1. What is no number is left out.
    pub fn set_restitution(&mut self, restitution: f64) {
        if !restitution.is_nan() {
            self.restitution = restitution.clamp(0.0, 1.0);
        }
    }

    /// How the surface of b runs against that of a, beside the surface velocities of the bodies, world axes, m/s. Zero unless
    /// set in this call.
    #[must_use]
    pub fn surface_velocity(&self) -> Vector<N> {
        self.surface
    }

    /// Sets it. Along the surface it carries, as a conveyor does; against the normal it drives the two apart: with −3 times
    /// the normal, b leaves at 3 m/s. What is not finite is left out.
    pub fn set_surface_velocity(&mut self, surface: impl Into<Vector<N>>) {
        let surface = surface.into();
        if surface.is_finite() {
            self.surface = surface;
        }
    }
}

impl<const N: usize> World<N> {
    /// Sets what has a say in the contacts of bodies with [`BodyDef::contact_hook`](crate::BodyDef::contact_hook). It stays
    /// with the world: snapshots do not hold it.
    pub fn set_contact_hook(&mut self, hook: impl ContactHook<N> + 'static) {
        self.hook = Some(Hook(Arc::new(hook)));
    }

    /// Takes the hook away.
    pub fn clear_contact_hook(&mut self) {
        self.hook = None;
    }
}

impl<const N: usize> Update<'_, N> {
    /// Whether a sensor and what it met overlap, looked at anew only where they may have come together or apart.
    pub(crate) fn sense(&self, pair: &mut Pair<N>, way: f64, scratch: &mut Scratch<N>) {
        if way <= pair.holds_until {
            return;
        }
        let Some([(a, _), (b, _)]) = self.sides(pair) else { return };
        let mut manifold = Manifold::EMPTY;
        let (pose_a, pose_b) = (&a.world_from_collider, &b.world_from_collider);
        let cache = &mut pair.search.cache;
        collide(&a.piece, pose_a, &b.piece, pose_b, self.margin, cache, scratch, &mut manifold);
        let least = manifold.least_separation();
        pair.overlaps = least.is_some_and(|least| least <= 0.0);
        // Neither begins nor ends before the two have moved as far as they are apart, or deep.
        pair.holds_until = way + least.map_or(self.margin, |least| CERTAIN * least.abs());
    }

    /// Lets one-way bodies and the hook have their say on a contact that was just found.
    pub(crate) fn judge(
        &self,
        pair: &mut Pair<N>,
        manifold: &mut Manifold<N>,
        (a, body_a): (&Collider<N>, &Body<N>),
        (b, body_b): (&Collider<N>, &Body<N>),
    ) {
        pair.passage = self.passage(pair.passage, manifold, body_a, body_b);
        if pair.passage == Passage::Passing {
            manifold.clear();
        }
        let Some(contact) = &mut pair.contact else { return };
        contact.surface = Vector::ZERO;
        contact.friction = body_a.material.combined_friction(&body_b.material);
        contact.restitution = body_a.material.combined_restitution(&body_b.material);
        let handles = (self.bodies.handle_at(a.body), self.bodies.handle_at(b.body));
        if let (Some(hook), (Some(handle_a), Some(handle_b))) = (&self.hook, handles)
            && (body_a.contact_hook || body_b.contact_hook)
            && !manifold.is_empty()
        {
            let mut hooked = HookedContact {
                handles: (handle_a, handle_b),
                bodies: (body_a, body_b),
                manifold,
                friction: contact.friction,
                restitution: contact.restitution,
                surface: Vector::ZERO,
            };
            hook.0.modify(&mut hooked);
            (contact.friction, contact.restitution) = (hooked.friction, hooked.restitution);
            contact.surface = hooked.surface;
        }
        pair.bounces = contact.restitution > 0.0;
    }

    /// How a pair stands towards its one-way bodies: what is met on a side that holds is held; what is met elsewhere, or
    /// found deep inside, passes until the two have come apart.
    fn passage(&self, before: Passage, manifold: &Manifold<N>, a: &Body<N>, b: &Body<N>) -> Passage {
        let Some(least) = manifold.least_separation() else { return Passage::Apart };
        let holds = |body: &Body<N>, outward: Vector<N>| {
            body.one_way.is_none_or(|side| outward.dot(body.rotation.rotate(side)) > HOLDING_COSINE)
        };
        let held = holds(a, manifold.normal) && holds(b, -manifold.normal);
        match before {
            Passage::Held if held => Passage::Held,
            Passage::Apart if held && least >= -self.margin => Passage::Held,
            Passage::Passing if held && least > 0.0 => Passage::Held,
            Passage::Apart | Passage::Held | Passage::Passing => Passage::Passing,
        }
    }
}

/// Cosine of the largest angle between the side of a one-way body and a normal on which it holds: sixty degrees.
const HOLDING_COSINE: f64 = 0.5;

/// Share of a distance or depth that two have to move at least to undo it. The depth along the normal that is reported may
/// be a twentieth above the least one.
const CERTAIN: f64 = 0.9;

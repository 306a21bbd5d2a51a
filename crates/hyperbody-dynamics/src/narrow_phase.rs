//! Where pairs touch: manifolds, and the impulses that carry over to them.

use hyperbody_collision::{MAX_POINTS, Manifold, PairCache, Scratch, collide, max_points};
use hyperbody_geometry::Core;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Bivector, Pose, Rotation, Vector};
use rayon::prelude::*;

use crate::ahead::{IS_HEARD, fetch};
use crate::balls::Plain;
use crate::body::Body;
use crate::handle::Arena;
use crate::pairs::{Contact, Meeting, Pair, PairRole, Summary, Touch, Touches, fetch_contacts};
use crate::rules::Hook;
use crate::seams::{SLIDES, is_suspect};
use crate::wandering::share_of_b;
use crate::world::{Collider, Motion};
use crate::{BodyHandle, BodyKind, World};

/// A pair of bodies that touch, or are about to.
#[derive(Clone, Copy, Debug)]
pub struct ContactRef<'a, const N: usize> {
    pub(crate) pair: &'a Pair<N>,
    pub(crate) bodies: (BodyHandle, BodyHandle),
}

impl<const N: usize> ContactRef<'_, N> {
    /// The two bodies, a and b.
    #[must_use]
    pub fn bodies(&self) -> (BodyHandle, BodyHandle) {
        self.bodies
    }

    /// Unit normal in the world, from a to b.
    #[must_use]
    pub fn normal(&self) -> Vector<N> {
        self.pair.normal()
    }

    /// Points of contact: position in the world (m), separation along the normal (m, negative is overlap), and normal
    /// impulse over the last step (N·s).
    pub fn points(&self) -> impl Iterator<Item = (Vector<N>, f64, f64)> + '_ {
        let touches = self.pair.touches().iter();
        touches.map(|touch| (touch.point.position, touch.point.separation, f64::from(touch.step_impulse)))
    }
}

impl<const N: usize> World<N> {
    /// Finds the manifold of every pair that may have changed, in parallel; each pair depends on its own past alone.
    pub(crate) fn update_manifolds(&mut self) {
        let update = Update {
            colliders: &self.colliders,
            bodies: &self.bodies,
            motions: &self.motions,
            plain: &self.plain,
            margin: self.tuning.speculative_distance,
            recycle_distance: self.tuning.recycle_distance,
            dt: self.dt,
            hook: self.hook.as_ref(),
        };
        let slots = self.pairs.slots.as_mut_slice();
        match &self.pool {
            None => {
                if let ([scratch, ..], [found, ..]) = (self.scratch.as_mut_slice(), self.found.as_mut_slice()) {
                    update.pairs(slots, 0, scratch, found);
                }
            }
            Some(pool) => {
                // One stretch of slots and one scratch a piece of work.
                let chunk = slots.len().div_ceil(self.scratch.len()).max(1);
                pool.install(|| {
                    let memory = self.scratch.par_iter_mut().zip(&mut self.found);
                    slots.par_chunks_mut(chunk).zip(memory).enumerate().for_each(
                        |(index, (slots, (scratch, found)))| {
                            update.pairs(slots, index * chunk, scratch, found);
                        },
                    );
                });
            }
        }
        self.gather_found();
        if self.drop_ghosts() {
            self.measure_contacts();
        }
    }

    /// Puts what the threads found together, lists in the order of slots.
    fn gather_found(&mut self) {
        let (pairs, suspects) = (&mut self.pairs, &mut self.seams.suspects);
        pairs.contacts.clear();
        pairs.overlaps.clear();
        suspects.clear();
        (self.max_penetration, self.contact_count) = (0.0, 0);
        for found in &mut self.found {
            self.max_penetration = self.max_penetration.max(std::mem::take(&mut found.deepest));
            self.contact_count += std::mem::take(&mut found.touching);
            pairs.contacts.append(&mut found.contacts);
            pairs.overlaps.append(&mut found.overlaps);
            suspects.append(&mut found.suspects);
        }
    }

    /// Measures what is left of the contacts.
    fn measure_contacts(&mut self) {
        let (mut deepest, mut count) = (0.0, 0);
        for (_, pair) in self.pairs.contacts() {
            count += usize::from(pair.touching);
            if pair.deepest > deepest {
                deepest = pair.deepest;
            }
        }
        (self.max_penetration, self.contact_count) = (deepest, count);
    }

    /// Deepest overlap of two bodies as they stand now, m. Looks at every pair afresh and changes nothing.
    #[must_use]
    pub fn measure_penetration(&self) -> f64 {
        let mut deepest: f64 = 0.0;
        let mut scratch = Scratch::default();
        for pair in self.pairs.iter() {
            let (Some(a), Some(b)) =
                (&self.colliders[pair.collider_a as usize], &self.colliders[pair.collider_b as usize])
            else {
                continue;
            };
            let (Some(body_a), Some(body_b)) = (self.bodies.at(a.body), self.bodies.at(b.body)) else { continue };
            let mut manifold = Manifold::default();
            let world_from_a = body_a.world_from_body() * a.body_from_collider;
            let world_from_b = body_b.world_from_body() * b.body_from_collider;
            let mut cache = pair.search.cache.clone();
            let pieces: (&Piece<N>, &Piece<N>) = (&a.piece, &b.piece);
            collide(pieces.0, &world_from_a, pieces.1, &world_from_b, 0.0, &mut cache, &mut scratch, &mut manifold);
            for point in manifold.points() {
                deepest = deepest.max(-point.separation);
            }
        }
        deepest
    }

    /// Pairs of bodies that touch or are about to, as the last step found them, in the order of its work.
    pub fn contacts(&self) -> impl Iterator<Item = ContactRef<'_, N>> {
        self.pairs.iter().filter(|pair| pair.points > 0).filter_map(|pair| {
            let bodies = (self.bodies.handle_at(pair.body_a)?, self.bodies.handle_at(pair.body_b)?);
            Some(ContactRef { pair, bodies })
        })
    }
}

/// What updating pairs finds, as slots of pairs, ascending.
#[derive(Debug, Default)]
pub(crate) struct Found {
    /// Pairs with points.
    contacts: Vec<u32>,
    /// Those of them that may hold ghosts.
    suspects: Vec<u32>,
    /// Pairs of sensors with what they notice.
    overlaps: Vec<u32>,
    /// Deepest overlap, m.
    deepest: f64,
    /// Points that overlap.
    touching: usize,
}

impl Found {
    fn clear(&mut self) {
        let Self { contacts, suspects, overlaps, deepest, touching } = self;
        contacts.clear();
        suspects.clear();
        overlaps.clear();
        (*deepest, *touching) = (0.0, 0);
    }

    fn note<const N: usize>(&mut self, slot: usize, pair: &Pair<N>) {
        #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
        let slot = slot as u32;
        if pair.points > 0 {
            self.contacts.push(slot);
            self.deepest = self.deepest.max(pair.deepest);
            self.touching += usize::from(pair.touching);
        }
        if pair.suspect {
            self.suspects.push(slot);
        }
        if pair.overlaps {
            self.overlaps.push(slot);
        }
    }
}

/// What updating a pair reads.
#[derive(Clone, Copy)]
pub(crate) struct Update<'a, const N: usize> {
    pub(crate) colliders: &'a [Option<Collider<N>>],
    pub(crate) bodies: &'a Arena<Body<N>, BodyHandle>,
    /// By slot of the collider.
    motions: &'a [Motion<N>],
    /// By slot of the collider.
    pub(crate) plain: &'a [Plain<N>],
    /// m.
    pub(crate) margin: f64,
    /// m.
    recycle_distance: f64,
    /// s.
    pub(crate) dt: f64,
    pub(crate) hook: Option<&'a Hook<N>>,
}

impl<const N: usize> Update<'_, N> {
    /// Brings the pairs of some slots up to date, the first of which is `first`.
    fn pairs(&self, slots: &mut [Option<Pair<N>>], first: usize, scratch: &mut Scratch<N>, found: &mut Found) {
        // Something may be left of a step in which a contact hook panicked.
        found.clear();
        for slot in 0..slots.len() {
            fetch_contacts(slots, slot);
            self.fetch_search(slots, slot + 8);
            if let Some(pair) = &mut slots[slot] {
                self.pair(pair, scratch);
                found.note(first + slot, pair);
            }
        }
    }

    /// Asks for what searching a pair starts from, if it has to be searched.
    #[inline]
    fn fetch_search(&self, slots: &[Option<Pair<N>>], slot: usize) {
        let Some(pair) = slots.get(slot).and_then(Option::as_ref).filter(|pair| IS_HEARD && !pair.round) else {
            return;
        };
        let way = |collider: u32| self.motions[collider as usize].way;
        if way(pair.collider_a) + way(pair.collider_b) > pair.holds_until {
            fetch(&pair.search.a_from_b, usize::MAX);
        }
    }

    /// Brings a pair up to date, by the cheapest of three ways that does: carrying along what was found before.
    fn pair(&self, pair: &mut Pair<N>, scratch: &mut Scratch<N>) {
        let (a, b) = (&self.motions[pair.collider_a as usize], &self.motions[pair.collider_b as usize]);
        // Between sleepers and the immovable nothing changed; what is in quarantine is to be forgotten.
        let idle = !(a.awake || b.awake || a.speed.is_infinite() || b.speed.is_infinite());
        if pair.role == PairRole::Sensor {
            // Sensors notice sleepers too, and wake nobody.
            return self.sense(pair, a.way + b.way, scratch);
        }
        // Written where it changes: of most pairs a step only reads.
        if pair.met != (pair.meeting != Meeting::Apart) {
            pair.met = !pair.met;
        }
        if pair.suspect {
            pair.suspect = false;
        }
        if idle {
            return;
        }
        // What was left out of the kept manifold was farther apart than the margin, and stays out of reach.
        let calm = self.dt * (a.speed + b.speed) + self.recycle_distance <= self.margin;
        let (plain, way) = (a.plain && b.plain, a.way + b.way);
        if calm && (way <= pair.holds_until || !plain && self.still_holds(pair, way)) {
            if pair.points > 0 {
                self.carry_along(pair);
            }
        } else if !(plain && self.plain(pair, way)) {
            self.look_closer(pair, way, scratch);
        }
        // What hardly moves comes to no seam, and neither does what moves together.
        if pair.points > 0
            && !pair.round
            && a.speed + b.speed > SLIDES
            && (a.velocity - b.velocity).norm_sq() > SLIDES * SLIDES
            && let (Some(body_a), Some(body_b)) = (self.bodies.at(pair.body_a), self.bodies.at(pair.body_b))
            && is_suspect(pair, body_a, body_b)
        {
            pair.suspect = true;
        }
    }

    /// The colliders and bodies of a pair; of bodies in quarantine none, and what was known of the pair is forgotten.
    pub(crate) fn sides(&self, pair: &mut Pair<N>) -> Option<[(&Collider<N>, &Body<N>); 2]> {
        let a = self.colliders[pair.collider_a as usize].as_ref()?;
        let b = self.colliders[pair.collider_b as usize].as_ref()?;
        let (body_a, body_b) = (self.bodies.at(pair.body_a)?, self.bodies.at(pair.body_b)?);
        if body_a.quarantined || body_b.quarantined {
            pair.forget();
            return None;
        }
        Some([(a, body_a), (b, body_b)])
    }

    /// Searches anew. Apart from the other ways: it needs all registers, which they would miss.
    #[inline(never)]
    fn look_closer(&self, pair: &mut Pair<N>, way: f64, scratch: &mut Scratch<N>) {
        let Some([(a, body_a), (b, body_b)]) = self.sides(pair) else { return };
        let closing = self.closing_distance(body_a, body_b);
        if closing + self.recycle_distance <= self.margin && self.still_holds(pair, way) {
            if pair.points > 0 {
                self.carry_along(pair);
            }
            return;
        }
        let a_from_b = a.world_from_collider.relative(&b.world_from_collider);
        let mut manifold = Manifold::default();
        collide(
            &a.piece,
            &a.world_from_collider,
            &b.piece,
            &b.world_from_collider,
            self.margin + AFTER_IMPACT * closing,
            &mut pair.search.cache,
            scratch,
            &mut manifold,
        );
        self.drop_unreached(&mut manifold, (a, body_a), (b, body_b), scratch);
        if pair.role == PairRole::Ruled {
            if !manifold.is_empty() {
                pair.contact.get_or_insert_with(|| Box::new(meet_first((a, body_a), (b, body_b), max_points(N))));
            }
            self.judge(pair, &mut manifold, (a, body_a), (b, body_b));
        }
        let empty = manifold.points().is_empty();
        if !(empty && pair.contact.is_none()) {
            let contact =
                pair.contact.get_or_insert_with(|| Box::new(meet_first((a, body_a), (b, body_b), max_points(N))));
            carry_over(contact, &manifold, self.margin);
            if !empty && body_a.kind == BodyKind::Dynamic && body_b.kind == BodyKind::Dynamic {
                contact.share_of_b = share_of_b(a, b, manifold.normal);
            }
            record(contact, &a.world_from_collider, &b.world_from_collider);
        }
        pair.summarize();
        let keep = pair.role == PairRole::Solid && (empty || (flat_faced(&a.piece) && flat_faced(&b.piece)));
        pair.search.a_from_b = keep.then_some(a_from_b);
        pair.holds_until = if keep { way + self.recycle_distance } else { f64::NEG_INFINITY };
    }

    /// Whether what was found of two colliders holds though they went far: along the way they may have come back, or gone
    /// together. Then until when.
    fn still_holds(&self, pair: &mut Pair<N>, way: f64) -> bool {
        let (Some(a), Some(b), Some(kept)) = (
            &self.colliders[pair.collider_a as usize],
            &self.colliders[pair.collider_b as usize],
            &pair.search.a_from_b,
        ) else {
            return false;
        };
        let a_from_b = a.world_from_collider.relative(&b.world_from_collider);
        let left = self.recycle_distance - moved(kept, &a_from_b, a.reach.max(b.reach));
        if left >= 0.0 {
            pair.holds_until = way + left;
        }
        left >= 0.0
    }

    /// Makes the manifold of a pair anew from its carried form at the colliders' present poses.
    fn carry_along(&self, pair: &mut Pair<N>) {
        let (Some(a), Some(b), Some(contact)) =
            (&self.colliders[pair.collider_a as usize], &self.colliders[pair.collider_b as usize], &mut pair.contact)
        else {
            return;
        };
        // Copied: for all that the compiler knows, writing points might change them.
        let (world_from_a, world_from_b) = (a.world_from_collider, b.world_from_collider);
        let normal = world_from_a.rotation.rotate(contact.normal_in_a);
        contact.normal = normal;
        let mut summary = Summary::default();
        for (Touch { point, .. }, anchors) in contact.touches.iter_mut().zip(&contact.anchors) {
            let on_a = world_from_a.transform_point(anchors.0);
            let on_b = world_from_b.transform_point(anchors.1);
            point.position = (on_a + on_b) * 0.5;
            point.separation = (on_b - on_a).dot(normal);
            summary.count(point.separation);
        }
        pair.note(&summary);
    }
}

impl<const N: usize> Update<'_, N> {
    /// How far any two points of the bodies can come closer within the step, m; at most.
    fn closing_distance(&self, a: &Body<N>, b: &Body<N>) -> f64 {
        self.dt * ((b.velocity - a.velocity).norm() + a.surface_speed_by_spin() + b.surface_speed_by_spin())
    }

    /// Clears a manifold of which no point is near now or reached within the step at the present velocities: a fast body is
    /// met in time, and one that flies past is not. Where one point is reached, the others stay, for the impact changes
    /// the course of the body.
    fn drop_unreached(
        &self,
        manifold: &mut Manifold<N>,
        a: (&Collider<N>, &Body<N>),
        b: (&Collider<N>, &Body<N>),
        scratch: &mut Scratch<N>,
    ) {
        let normal = manifold.normal;
        let least = manifold.points().iter().map(|point| point.separation).fold(f64::INFINITY, f64::min);
        if least <= self.margin {
            return;
        }
        let reached = manifold.points().iter().any(|point| {
            let half_gap = normal * (0.5 * point.separation);
            let on_a = velocity_near(a.1, point.position - half_gap);
            let on_b = velocity_near(b.1, point.position + half_gap);
            point.separation <= (on_a - on_b).dot(normal) * self.dt
        });
        if !(reached && self.meet(least, a, b, scratch)) {
            manifold.clear();
        }
    }

    /// Whether two colliders that are `distance` apart, moving on as they do, come within the margin of each other before
    /// the step ends: by conservative advancement (B. Mirtich, 1996). True where that takes too many turns to tell.
    fn meet(
        &self,
        mut distance: f64,
        (a, body_a): (&Collider<N>, &Body<N>),
        (b, body_b): (&Collider<N>, &Body<N>),
        scratch: &mut Scratch<N>,
    ) -> bool {
        let closing = self.closing_distance(body_a, body_b);
        let mut manifold = Manifold::default();
        let mut share = 0.0;
        for _ in 0..ADVANCES {
            share += (distance - 0.5 * self.margin) / closing;
            if share >= 1.0 {
                return false;
            }
            let (world_from_a, world_from_b) =
                (pose_after(a, body_a, share * self.dt), pose_after(b, body_b, share * self.dt));
            let reach = self.margin + (1.0 - share) * closing;
            manifold.clear();
            let mut cache = PairCache::default();
            collide(&a.piece, &world_from_a, &b.piece, &world_from_b, reach, &mut cache, scratch, &mut manifold);
            distance = manifold.points().iter().map(|point| point.separation).fold(f64::INFINITY, f64::min);
            if distance <= self.margin {
                return true;
            }
            if manifold.points().is_empty() {
                return false;
            }
        }
        true
    }
}

/// How far ahead of fast bodies contacts are made, in parts of what they close in the step: a body that lands on one corner
/// throws the others down faster than it came.
pub(crate) const AFTER_IMPACT: f64 = 2.0;

/// Turns of the advancement of fast bodies. Each covers at least half of the distance that is left at the fastest approach.
const ADVANCES: u32 = 12;

/// Velocity of the body's point nearest to a place: its own there, if the place lies within its reach.
pub(crate) fn velocity_near<const N: usize>(body: &Body<N>, place: Vector<N>) -> Vector<N> {
    let offset = place - body.centre;
    let distance = offset.norm();
    let bounded = body.radius > 0.0 && distance > body.radius;
    let arm = if bounded { offset * (body.radius / distance) } else { offset };
    body.velocity + body.angular_velocity.act_on(arm)
}

/// Where a collider will be if its body moves on freely for a time, s.
fn pose_after<const N: usize>(collider: &Collider<N>, body: &Body<N>, time: f64) -> Pose<N> {
    let turn = Rotation::exp(&(body.angular_velocity * time));
    let now = &collider.world_from_collider;
    let centre = body.centre + body.velocity * time;
    Pose::new(turn * now.rotation, centre + turn.rotate(now.translation - body.centre))
}

/// Round shapes roll out from under their contact points, and theirs are cheap to find anew.
fn flat_faced<const N: usize>(piece: &Piece<N>) -> bool {
    match piece {
        Piece::HalfSpace { .. } => true,
        Piece::Convex(convex) => matches!(convex.core, Core::Box { .. } | Core::Polytope(_)),
    }
}

/// How far any point of either, within `reach` of its frame's origin, moved against the other, m; at most.
pub(crate) fn moved<const N: usize>(then: &Pose<N>, now: &Pose<N>, reach: f64) -> f64 {
    let mut turned_sq = 0.0;
    for i in 0..N {
        turned_sq += (now.rotation.matrix().row(i) - then.rotation.matrix().row(i)).norm_sq();
    }
    now.translation.distance(then.translation) + turned_sq.sqrt() * reach
}

/// What two colliders remember that touch for the first time, in at most so many points.
pub(crate) fn meet_first<const N: usize>(
    (a, body_a): (&Collider<N>, &Body<N>),
    (b, body_b): (&Collider<N>, &Body<N>),
    most_points: usize,
) -> Contact<N> {
    Contact {
        touches: Touches::with_room(most_points),
        friction: body_a.material.combined_friction(&body_b.material),
        restitution: body_a.material.combined_restitution(&body_b.material),
        resistance: body_a.material.combined_resistance(&body_b.material),
        anchors: Vec::with_capacity(most_points),
        radii: (a.rounding(), b.rounding()),
        ..Contact::NONE
    }
}

/// Notes the manifold in the frames of its colliders.
fn record<const N: usize>(contact: &mut Contact<N>, world_from_a: &Pose<N>, world_from_b: &Pose<N>) {
    let normal = contact.normal;
    contact.anchors.clear();
    contact.anchors.extend(contact.touches.iter().map(|Touch { point, .. }| {
        let half_gap = normal * (0.5 * point.separation);
        let on_a = world_from_a.inverse_transform_point(point.position - half_gap);
        (on_a, world_from_b.inverse_transform_point(point.position + half_gap))
    }));
    contact.normal_in_a = world_from_a.rotation.inverse_rotate(normal);
}

/// Makes a new manifold that of a contact. Its points get the impulses of the old points that they continue: those of the same id, else the
/// nearest one that is left within `reach`. Impulses of points that ended are dropped.
fn carry_over<const N: usize>(contact: &mut Contact<N>, new: &Manifold<N>, reach: f64) {
    let old = contact.touches.as_slice();
    let mut impulses = [0.0; MAX_POINTS];
    let mut taken = [false; MAX_POINTS];
    let mut matched = [false; MAX_POINTS];
    for (k, point) in new.points().iter().enumerate() {
        let same = old.iter().enumerate().position(|(o, other)| other.point.id == point.id && !taken[o]);
        if let Some(o) = same {
            impulses[k] = old[o].normal_impulse;
            taken[o] = true;
            matched[k] = true;
        }
    }
    for (k, point) in new.points().iter().enumerate().filter(|(k, _)| !matched[*k]) {
        let mut nearest = None;
        let mut least = reach * reach;
        for (o, other) in old.iter().enumerate().filter(|(o, _)| !taken[*o]) {
            let distance_sq = (other.point.position - point.position).norm_sq();
            if distance_sq < least {
                least = distance_sq;
                nearest = Some(o);
            }
        }
        if let Some(o) = nearest {
            impulses[k] = old[o].normal_impulse;
            taken[o] = true;
        }
    }
    if new.points().is_empty() {
        contact.friction_impulse = Vector::ZERO;
        contact.twist_impulse = Bivector::ZERO;
    }
    contact.normal = new.normal;
    let touches = new.points().iter().zip(impulses);
    contact.touches.replace(touches.map(|(point, normal_impulse)| Touch { normal_impulse, ..Touch::new(*point) }));
}

//! Where pairs touch: manifolds, and the impulses that carry over to them.

use hyperbody_collision::{MAX_POINTS, Manifold, Scratch, collide};
use hyperbody_geometry::shape::Piece;
use hyperbody_math::Vector;
use rayon::prelude::*;

use crate::body::Body;
use crate::handle::Arena;
use crate::pairs::Pair;
use crate::world::Collider;
use crate::{BodyHandle, World};

/// A pair of bodies that touch, or are about to.
#[derive(Clone, Copy, Debug)]
pub struct ContactRef<'a, const N: usize> {
    pub(crate) pair: &'a Pair<N>,
    pub(crate) bodies: (BodyHandle, BodyHandle),
    pub(crate) substeps: f64,
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
        self.pair.manifold.normal
    }

    /// Points of contact: position in the world (m), separation along the normal (m, negative is overlap), and normal
    /// impulse over the last step (N·s, about; the last substep's times their number).
    pub fn points(&self) -> impl Iterator<Item = (Vector<N>, f64, f64)> + '_ {
        let points = self.pair.manifold.points().iter().zip(&self.pair.normal_impulses);
        points.map(|(point, impulse)| (point.position, point.separation, f64::from(*impulse) * self.substeps))
    }
}

impl<const N: usize> World<N> {
    /// Finds the manifold of every pair that may have changed, in parallel; each pair depends on its own past alone.
    pub(crate) fn update_manifolds(&mut self) {
        let update =
            Update { colliders: &self.colliders, bodies: &self.bodies, margin: self.tuning.speculative_distance };
        let slots = self.pairs.slots_mut();
        match &self.pool {
            None => {
                if let Some(scratch) = self.scratch.first_mut() {
                    slots.iter_mut().flatten().for_each(|pair| update.pair(pair, scratch));
                }
            }
            Some(pool) => {
                // A few chunks a thread even out dense and empty stretches of slots.
                let chunk = slots.len().div_ceil(self.scratch.len()).max(1);
                pool.install(|| {
                    slots.par_chunks_mut(chunk).zip(self.scratch.par_iter_mut()).for_each(|(chunk, scratch)| {
                        chunk.iter_mut().flatten().for_each(|pair| update.pair(pair, scratch));
                    });
                });
            }
        }
        self.measure_contacts();
    }

    fn measure_contacts(&mut self) {
        self.max_penetration = 0.0;
        self.contact_count = 0;
        for point in self.pairs.iter().flat_map(|pair| pair.manifold.points()) {
            if point.separation <= 0.0 {
                self.contact_count += 1;
                self.max_penetration = self.max_penetration.max(-point.separation);
            }
        }
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
            let mut cache = pair.cache.clone();
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
        self.pairs.iter().filter(|pair| !pair.manifold.points().is_empty()).filter_map(|pair| {
            let bodies = (self.bodies.handle_at(pair.body_a)?, self.bodies.handle_at(pair.body_b)?);
            Some(ContactRef { pair, bodies, substeps: f64::from(self.substeps) })
        })
    }
}

/// What updating a pair reads.
#[derive(Clone, Copy)]
struct Update<'a, const N: usize> {
    colliders: &'a [Option<Collider<N>>],
    bodies: &'a Arena<Body<N>, BodyHandle>,
    /// m.
    margin: f64,
}

impl<const N: usize> Update<'_, N> {
    fn pair(&self, pair: &mut Pair<N>, scratch: &mut Scratch<N>) {
        let (Some(a), Some(b)) = (&self.colliders[pair.collider_a as usize], &self.colliders[pair.collider_b as usize])
        else {
            return;
        };
        let (Some(body_a), Some(body_b)) = (self.bodies.at(pair.body_a), self.bodies.at(pair.body_b)) else { return };
        if body_a.quarantined || body_b.quarantined {
            pair.manifold.clear();
            return;
        }
        // Between sleepers and the immovable nothing changed.
        if !(body_a.is_awake() || body_b.is_awake()) {
            return;
        }
        let mut manifold = Manifold::default();
        collide(
            &a.piece,
            &a.world_from_collider,
            &b.piece,
            &b.world_from_collider,
            self.margin,
            &mut pair.cache,
            scratch,
            &mut manifold,
        );
        carry_over(pair, &manifold, self.margin);
        pair.manifold = manifold;
    }
}

/// Gives the points of a new manifold the impulses of the old points that they continue: those of the same id, else the
/// nearest one that is left within `reach`. Impulses of points that ended are dropped.
fn carry_over<const N: usize>(pair: &mut Pair<N>, new: &Manifold<N>, reach: f64) {
    let old = pair.manifold.points();
    let mut impulses = [0.0; MAX_POINTS];
    let mut taken = [false; MAX_POINTS];
    let mut matched = [false; MAX_POINTS];
    for (k, point) in new.points().iter().enumerate() {
        let same = old.iter().enumerate().position(|(o, other)| other.id == point.id && !taken[o]);
        if let Some(o) = same {
            impulses[k] = pair.normal_impulses[o];
            taken[o] = true;
            matched[k] = true;
        }
    }
    for (k, point) in new.points().iter().enumerate().filter(|(k, _)| !matched[*k]) {
        let mut nearest = None;
        let mut least = reach * reach;
        for (o, other) in old.iter().enumerate().filter(|(o, _)| !taken[*o]) {
            let distance_sq = (other.position - point.position).norm_sq();
            if distance_sq < least {
                least = distance_sq;
                nearest = Some(o);
            }
        }
        if let Some(o) = nearest {
            impulses[k] = pair.normal_impulses[o];
            taken[o] = true;
        }
    }
    if new.points().is_empty() {
        pair.friction_impulse = Vector::ZERO;
        pair.twist_impulse = hyperbody_math::Bivector::ZERO;
    }
    pair.normal_impulses = impulses;
}

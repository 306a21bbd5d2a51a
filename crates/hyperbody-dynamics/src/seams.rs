//! Ghost contacts: bodies that slide over the seam between two others must not catch on it.
//!
//! A body that lies on a floor of boxes has sunk into it by a hair. Where its front comes to the next box, the least way out
//! of that one is back, not up, and a contact made ahead of it stops it dead. But no push back is needed: a plane that holds
//! the body already keeps it clear of the next box too.
//!
//! So of the contacts of one body, with normals n_i and planes above which they hold it, contact j needs no push of its own if
//! for some other i
//!
//! - all that j's partner has lies below the plane of i, or above it by no more than [`FLUSH`], and
//! - the normals differ, and
//! - i does not approach along its normal, as ghosts do, or nothing is said against i itself in this way.
//!
//! Then n_i separates the body from the partner of j. If n_j leans but a little, as where a ball nears an edge or a box has
//! pitched by a hair, it is set upright, to n_i; else j goes without a push in this step. A step or a wall stands above the plane,
//! and keeps its contact. Nothing of this knows of edges, neighbours or the dimension, so it holds for boxes side by side, cells
//! of a mesh, and floors of anything else; what it does not see are seams where the next face rises.
//!
//! Others go by adjacency: internal edges are found when a mesh is built (P. Terdiman, 2012), or contacts are sorted by depth and
//! features used up (Jolt). Both are for triangles of one mesh; here the floor may be made of bodies, too.

use hyperbody_geometry::Core;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::Vector;

use crate::body::Body;
use crate::narrow_phase::velocity_near;
use crate::pairs::{Pair, in_order};
use crate::world::Collider;
use crate::{BodyKind, World};

/// How far something may stand above a plane that holds a body and still be flush with it, m: what is lower than this in
/// the way of a body is slid over. Above the overlap that resting contacts keep, by which dynamic bodies side by side may
/// differ in height.
const FLUSH: f64 = 0.002;

/// The same in parts of the height, along the plane's normal, of the lower one of the two: small bodies on a floor do meet.
const FLUSH_SHARE: f64 = 0.05;

/// Speed of two bodies against each other from which their contact may be a ghost, m/s: what hardly moves comes to no seam.
pub(crate) const SLIDES: f64 = 0.02;

/// The sine of a lean from which it matters: over a second, gravity makes a hundredth of a millimetre a second of it.
const LEAN: f64 = 1e-6;

/// Approach along the normal below which a contact holds, m/s, whatever else is said of it.
const HOLDS: f64 = 0.01;

/// Cosine of the largest lean that is set upright: eighteen degrees.
const UPRIGHT: f64 = 0.95;

/// Buffers, kept from step to step.
#[derive(Debug, Default)]
pub(crate) struct Seams<const N: usize> {
    /// Slots of pairs that may hold ghosts.
    pub(crate) suspects: Vec<u32>,
    /// By slot of the body: where its contacts begin in `holds`; [`NONE`] for all but the dynamic bodies of suspects.
    places: Vec<u32>,
    /// Body and pair of all contacts of those bodies, ascending.
    contacts: Vec<(u32, u32)>,
    /// The same contacts as their bodies see them.
    holds: Vec<Hold<N>>,
    /// Pair, and the normal that it gets, from a to b; none for those that are dropped.
    ghosts: Vec<(u32, Option<Vector<N>>)>,
}

const NONE: u32 = u32::MAX;

impl<const N: usize> Seams<N> {
    /// The contacts of a body, if it is one of those that are looked at.
    fn contacts_of(&self, body: u32) -> &[Hold<N>] {
        let place = self.places[body as usize];
        let from_there = if place == NONE { &[] } else { &self.holds[place as usize..] };
        let count = from_there.iter().take_while(|hold| hold.body == body).count();
        &from_there[..count]
    }
}

/// A contact as one of its bodies sees it.
#[derive(Clone, Copy, Debug)]
struct Hold<const N: usize> {
    body: u32,
    /// Slots of the pair and of the colliders of the body and of its partner.
    pair: u32,
    own: u32,
    partner: u32,
    /// Unit, world axes, towards the body.
    normal: Vector<N>,
    /// The deepest point, and its separation, m.
    point: Vector<N>,
    separation: f64,
}

/// Whether a contact that was just found approaches along its normal, as ghosts do, or parts, as behind an edge, however
/// little.
pub(crate) fn is_suspect<const N: usize>(pair: &Pair<N>, a: &Body<N>, b: &Body<N>) -> bool {
    approach(pair, a, b).abs() > LEAN * (a.velocity - b.velocity).norm()
}

/// Speed at which the two come together at the first point of their contact, m/s.
fn approach<const N: usize>(pair: &Pair<N>, a: &Body<N>, b: &Body<N>) -> f64 {
    let speed_at = |place| (velocity_near(a, place) - velocity_near(b, place)).dot(pair.normal());
    pair.touches().first().map_or(0.0, |touch| speed_at(touch.point.position))
}

impl<const N: usize> World<N> {
    /// Drops contacts that another contact of the same body makes needless; whether there were any.
    pub(crate) fn drop_ghosts(&mut self) -> bool {
        if self.seams.suspects.is_empty() {
            return false;
        }
        let mut seams = std::mem::take(&mut self.seams);
        self.collect_contacts_of_suspects(&mut seams);
        self.find_ghosts(&mut seams);
        for &(slot, normal) in &seams.ghosts {
            self.correct(slot, normal);
        }
        self.seams = seams;
        !self.seams.ghosts.is_empty()
    }

    fn collect_contacts_of_suspects(&self, seams: &mut Seams<N>) {
        let Seams { suspects, places, contacts, holds, .. } = seams;
        places.clear();
        places.resize(self.bodies.slot_count(), NONE);
        for pair in suspects.iter().filter_map(|&slot| self.pairs.get(slot)) {
            for body in [pair.body_a, pair.body_b] {
                if self.bodies.at(body).is_some_and(|body| body.kind == BodyKind::Dynamic) {
                    places[body as usize] = 0;
                }
            }
        }
        contacts.clear();
        for (slot, pair) in self.pairs.contacts() {
            for body in [pair.body_a, pair.body_b] {
                if places[body as usize] != NONE {
                    contacts.push((body, slot));
                }
            }
        }
        contacts.sort_unstable_by_key(in_order);
        holds.clear();
        holds.extend(contacts.iter().filter_map(|&(body, slot)| self.hold(body, slot)));
        for (place, hold) in holds.iter().enumerate().rev() {
            places[hold.body as usize] = place as u32;
        }
    }

    fn find_ghosts(&self, seams: &mut Seams<N>) {
        let mut ghosts = std::mem::take(&mut seams.ghosts);
        ghosts.clear();
        for &suspect in &seams.suspects {
            let Some(pair) = self.pairs.get(suspect) else { continue };
            let mut best: Option<(f64, Vector<N>)> = None;
            let mut below = None;
            for (body, sign) in [(pair.body_a, -1.0), (pair.body_b, 1.0)] {
                let others = seams.contacts_of(body);
                let Some(of) = others.iter().find(|hold| hold.pair == suspect) else { continue };
                for by in others {
                    let Some(cosine) = self.explains(by, of) else { continue };
                    let holds = self.hardly_approaches(by.pair)
                        || !others.iter().any(|third| self.explains(third, by).is_some());
                    // One that makes it needless counts for more than any that would set it upright.
                    if holds && best.is_none_or(|(most, _)| most > UPRIGHT && (cosine <= UPRIGHT || cosine > most)) {
                        best = Some((cosine, by.normal * sign));
                    }
                }
                below = below.or_else(|| Some(self.facet_below(of)? * sign));
            }
            let normal = match (best, below) {
                (Some((cosine, _)), _) if cosine <= UPRIGHT => None,
                (_, Some(facet)) => Some(facet),
                (Some((_, normal)), None) => Some(normal),
                (None, None) => continue,
            };
            ghosts.push((suspect, normal));
        }
        seams.ghosts = ghosts;
    }

    fn collider(&self, slot: u32) -> Option<&Collider<N>> {
        self.colliders[slot as usize].as_ref()
    }

    /// Normal of a facet on which a contact of a body nearly stands, on a partner that impulses do not move: what leans there
    /// follows the pitch of the body, or an edge within a floor. Towards the body.
    fn facet_below(&self, hold: &Hold<N>) -> Option<Vector<N>> {
        let (own, partner) = (self.collider(hold.own)?, self.collider(hold.partner)?);
        self.bodies.at(partner.body).filter(|partner| partner.kind != BodyKind::Dynamic)?;
        let facet = nearest_facet(partner, hold.normal)?;
        if facet.dot(hold.normal) <= UPRIGHT {
            return None;
        }
        let (own, partner) = (span(own, facet)?, span(partner, facet)?);
        let flush = FLUSH.min(FLUSH_SHARE * (own.1 - own.0).min(partner.1 - partner.0));
        (own.0 - partner.1 >= hold.separation.min(0.0) - flush).then_some(facet)
    }

    fn hardly_approaches(&self, slot: u32) -> bool {
        let Some(pair) = self.pairs.get(slot) else { return false };
        match (self.bodies.at(pair.body_a), self.bodies.at(pair.body_b)) {
            (Some(a), Some(b)) => approach(pair, a, b) <= HOLDS,
            _ => false,
        }
    }

    /// If the plane on which contact `by` holds a body keeps it clear of its partner in contact `of` of the same body: how near
    /// the normals are to each other, as a cosine.
    fn explains(&self, by: &Hold<N>, of: &Hold<N>) -> Option<f64> {
        if by.pair == of.pair {
            return None;
        }
        let cosine = by.normal.dot(of.normal);
        // What the contact points show of the two is enough to rule most out.
        let seen = (by.point - of.point).dot(by.normal) + 0.5 * (by.separation + cosine * of.separation);
        let sunk = by.separation.min(0.0);
        if seen < sunk - FLUSH || (by.normal - of.normal).norm_sq() < LEAN * LEAN {
            return None;
        }
        let (own, partner) = (span(self.collider(of.own)?, by.normal)?, span(self.collider(of.partner)?, by.normal)?);
        let flush = FLUSH.min(FLUSH_SHARE * (own.1 - own.0).min(partner.1 - partner.0));
        // The lowest of the body stands above the highest of the partner, but for what has sunk in and what is flush.
        (own.0 - partner.1 >= sunk - flush).then_some(cosine)
    }

    /// A contact as its body sees it.
    fn hold(&self, body: u32, slot: u32) -> Option<Hold<N>> {
        let pair = self.pairs.get(slot)?;
        let (own, partner, normal) = if pair.body_a == body {
            (pair.collider_a, pair.collider_b, -pair.normal())
        } else {
            (pair.collider_b, pair.collider_a, pair.normal())
        };
        let points = pair.touches().iter().map(|touch| &touch.point);
        let deepest = points.min_by(|a, b| a.separation.total_cmp(&b.separation))?;
        let (point, separation) = (deepest.position, deepest.separation);
        Some(Hold { body, pair: slot, own, partner, normal, point, separation })
    }

    /// Gives a contact another normal, or drops it.
    fn correct(&mut self, slot: u32, normal: Option<Vector<N>>) {
        let Some(pair) = self.pairs.get_mut(slot) else { return };
        // It has to be looked for anew in the next step, wherever the two are then.
        pair.search.a_from_b = None;
        pair.holds_until = f64::NEG_INFINITY;
        let Some(contact) = &mut pair.contact else { return };
        match normal {
            Some(normal) => contact.normal = normal,
            None => {
                contact.clear();
                pair.summarize();
            }
        }
    }
}

/// Least and greatest coordinate along a unit direction of the world, m; `None` for half-spaces.
fn span<const N: usize>(collider: &Collider<N>, direction: Vector<N>) -> Option<(f64, f64)> {
    let Piece::Convex(convex) = &collider.piece else { return None };
    let pose = &collider.world_from_collider;
    let local = pose.rotation.inverse_rotate(direction);
    let middle = pose.translation.dot(direction);
    let least = convex.core.support(-local).dot(local) - convex.radius;
    let greatest = convex.core.support(local).dot(local) + convex.radius;
    Some((middle + least, middle + greatest))
}

/// The outward normal of the facet that looks most in a direction, world axes; `None` for round cores.
fn nearest_facet<const N: usize>(collider: &Collider<N>, direction: Vector<N>) -> Option<Vector<N>> {
    let Piece::Convex(convex) = &collider.piece else { return None };
    let rotation = &collider.world_from_collider.rotation;
    let local = rotation.inverse_rotate(direction);
    let normal = match &convex.core {
        Core::Box { .. } => {
            let axis = local.axis_of_max_abs();
            Vector::unit(axis) * local[axis].signum()
        }
        Core::Polytope(polytope) => {
            let facets = polytope.facets_of_vertex(polytope.support_vertex(local)).iter();
            let normals = facets.map(|&facet| polytope.facets()[facet as usize].normal);
            normals.max_by(|a, b| a.dot(local).total_cmp(&b.dot(local)))?
        }
        Core::Point | Core::Segment { .. } => return None,
    };
    Some(rotation.rotate(normal))
}

//! Fast bodies that contacts did not stop in time: swept after the step, and put back to where they went through something.
//!
//! Contacts are made ahead of fast bodies (`narrow_phase`), and stop most of them. What they miss is what turns far within the
//! step, or is thrown by an impact into something that was not in its way. So each convex piece has a core: the ball about its
//! middle of half its inner radius. A piece may overlap others by a little, and contacts will push it out; but where its core
//! would have come through another piece within the step, the body is put back to where the two first touched (or, if they
//! touched all along, to where the core arrived), and keeps its velocity for the contact of the next step. A body that lies
//! or slides on another one never comes near it with its core, so nothing is frozen in place, and only bodies that went
//! farther than half their core's size are looked at.
//!
//! Of a pair the one that is fast is put back, both if both are; what a kinematic body sweeps up is carried along on it.
//! Cores and times of impact are those of Box2D in spirit (E. Catto, "Continuous collision", 2013); sweeping the
//! core alone, against the whole of the other piece, is what makes it a search for one point in every dimension.

mod sweep;

use hyperbody_collision::Scratch;
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Convex, Core};
use hyperbody_math::Vector;

use crate::pairs::PairRole;
use crate::{BodyKind, World};
use sweep::{Sweep, Swept};

/// The ball inside a convex piece that must not pass through others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PieceCore<const N: usize> {
    /// In the frame of the collider.
    pub(crate) centre: Vector<N>,
    /// m; zero for half-spaces, which have none.
    pub(crate) radius: f64,
}

/// Radius of a core, in parts of the radius of the largest ball about the middle of the piece: what rests on something, and
/// is pressed into it, must not be held for what goes through it.
const CORE_SHARE: f64 = 0.5;

impl<const N: usize> PieceCore<N> {
    pub(crate) fn of(piece: &Piece<N>) -> Self {
        let Piece::Convex(convex) = piece else { return Self { centre: Vector::ZERO, radius: 0.0 } };
        let Convex { core, radius } = convex;
        let (centre, inner) = match core {
            Core::Point | Core::Segment { .. } => (Vector::ZERO, 0.0),
            Core::Box { half_extents } => (Vector::ZERO, half_extents.iter().fold(f64::INFINITY, f64::min)),
            Core::Polytope(polytope) => {
                let middle = polytope.vertex_mean();
                let depths = polytope.facets().iter().map(|facet| facet.offset - facet.normal.dot(middle));
                (middle, depths.fold(f64::INFINITY, f64::min).max(0.0))
            }
        };
        Self { centre, radius: CORE_SHARE * (inner + radius) }
    }
}

/// A core that came through a piece.
#[derive(Clone, Copy, Debug)]
struct Impact {
    /// Part of the step after which the two touched.
    time: f64,
    /// Sweeps of the body of the core and of the other one; [`NONE`] for a body that stands.
    body: u32,
    other: u32,
}

const NONE: u32 = u32::MAX;

/// How often impacts are sought anew among bodies that were put back.
const ROUNDS: usize = 4;

/// Buffers, kept from step to step.
#[derive(Debug, Default)]
pub(crate) struct Continuous<const N: usize> {
    /// Slots of bodies that went far in this step.
    pub(crate) fast: Vec<u32>,
    sweeps: Vec<Sweep<N>>,
    /// Colliders that may have met: of the core, and the other.
    pairs: Vec<(u32, u32)>,
    impacts: Vec<Impact>,
}

impl<const N: usize> World<N> {
    /// Puts bodies back that went through something.
    pub(crate) fn stop_at_impacts(&mut self) {
        let mut work = std::mem::take(&mut self.continuous);
        self.find_sweeps(&mut work);
        if !work.sweeps.is_empty() {
            self.find_met(&mut work);
            for _ in 0..ROUNDS {
                if work.pairs.is_empty() || !self.apply_impacts(&mut work) {
                    break;
                }
            }
            self.write_back(&work);
        }
        work.fast.clear();
        self.continuous = work;
    }

    /// The ways of bodies that went far.
    fn find_sweeps(&self, work: &mut Continuous<N>) {
        work.sweeps.clear();
        for &slot in &work.fast {
            work.sweeps.extend(self.sweep_of(slot));
        }
    }

    /// The way of a body in this step: its colliders still stand where it began.
    fn sweep_of(&self, slot: u32) -> Option<Sweep<N>> {
        let body = self.bodies.at(slot).filter(|body| !body.quarantined)?;
        let collider = self.colliders[*body.colliders.first()? as usize].as_ref()?;
        let world_from_body = collider.world_from_collider * collider.body_from_collider.inverse();
        let start = world_from_body.transform_point(body.centre_in_body);
        Some(Sweep::new(slot, (start, world_from_body.rotation), (body.centre, body.rotation), body))
    }

    /// Pairs of a core and another piece that may have come together, by the boxes of their ways.
    fn find_met(&mut self, work: &mut Continuous<N>) {
        work.pairs.clear();
        let mut near = std::mem::take(&mut self.near);
        for sweep in &work.sweeps {
            let Some(body) = self.bodies.at(sweep.slot) else { continue };
            near.boxes.clear();
            for &slot in &body.colliders {
                let Some(collider) = &self.colliders[slot as usize] else { continue };
                let Piece::Convex(convex) = &collider.piece else { continue };
                let (start, end) = (sweep.pose_of(collider, 0.0), sweep.pose_of(collider, 1.0));
                let way = convex.aabb(&start).union(&convex.aabb(&end)).grown(sweep.bulge(collider));
                near.boxes.push((slot, way));
            }
            self.for_each_near(sweep.slot, &mut near, |slot, other| {
                work.pairs.extend([(slot, other), (other, slot)]);
            });
        }
        self.near = near;
        work.pairs.sort_unstable();
        work.pairs.dedup();
        let mut pairs = std::mem::take(&mut work.pairs);
        pairs.retain(|&(core, other)| self.must_not_pass(core, other));
        work.pairs = pairs;
        self.add_swept_up(work);
    }

    /// Slow bodies may be carried along by kinematic ones: they get ways too.
    fn add_swept_up(&self, work: &mut Continuous<N>) {
        let known = work.sweeps.len();
        for &(core, other) in &work.pairs {
            let (Some(a), Some(b)) = (&self.colliders[core as usize], &self.colliders[other as usize]) else {
                continue;
            };
            let by_kinematic = self.bodies.at(b.body).is_some_and(|body| body.kind == BodyKind::Kinematic);
            let is_new = |sweep: &Sweep<N>| sweep.slot != a.body;
            if by_kinematic
                && work.sweeps[..known].binary_search_by_key(&a.body, |sweep| sweep.slot).is_err()
                && work.sweeps[known..].iter().all(is_new)
            {
                work.sweeps.extend(self.sweep_of(a.body));
            }
        }
        work.sweeps.sort_unstable_by_key(|sweep| sweep.slot);
    }

    /// Whether the core of a collider must not pass through another one.
    fn must_not_pass(&self, core: u32, other: u32) -> bool {
        let (Some(a), Some(b)) = (&self.colliders[core as usize], &self.colliders[other as usize]) else {
            return false;
        };
        let (Some(body_a), Some(body_b)) = (self.bodies.at(a.body), self.bodies.at(b.body)) else { return false };
        if a.body == b.body || body_a.kind != BodyKind::Dynamic || a.core.radius <= 0.0 || body_b.quarantined {
            return false;
        }
        match PairRole::of(body_a, body_b) {
            PairRole::Sensor => false,
            PairRole::Solid => self.may_pair(a.body, b.body),
            // One-way bodies and hooks have said whether the two may pass.
            PairRole::Ruled => self.pairs.of(core.min(other), core.max(other)).is_some_and(|pair| pair.points > 0),
        }
    }

    /// Finds impacts, and ends the ways of bodies there, the earliest first; whether any way has become shorter.
    fn apply_impacts(&mut self, work: &mut Continuous<N>) -> bool {
        work.impacts.clear();
        let mut scratch = self.scratch.first_mut().map(std::mem::take).unwrap_or_default();
        for &(core, other) in &work.pairs {
            work.impacts.extend(self.impact(core, other, &work.sweeps, &mut scratch));
        }
        if let Some(first) = self.scratch.first_mut() {
            *first = scratch;
        }
        // Stable: those of one time keep the order of their colliders.
        work.impacts.sort_by(|a, b| a.time.total_cmp(&b.time));
        let mut shorter = false;
        for impact in &work.impacts {
            let end_of = |sweep: u32| work.sweeps.get(sweep as usize).map_or(1.0, |sweep| sweep.end);
            // Who was put back before never came here.
            if end_of(impact.body) < impact.time || end_of(impact.other) < impact.time {
                continue;
            }
            shorter |= self.end_ways(impact, &mut work.sweeps);
        }
        shorter
    }

    /// Ends the ways of the two of an impact, or has the one carried by the other.
    fn end_ways(&self, impact: &Impact, sweeps: &mut [Sweep<N>]) -> bool {
        let kinematic = |sweep: u32| {
            let slot = sweeps.get(sweep as usize).map(|sweep| sweep.slot);
            slot.and_then(|slot| self.bodies.at(slot)).is_some_and(|body| body.kind == BodyKind::Kinematic)
        };
        if kinematic(impact.other) {
            let carrier = sweeps[impact.other as usize].clone();
            return sweeps.get_mut(impact.body as usize).is_some_and(|sweep| sweep.carry(impact.time, &carrier));
        }
        let mut shorter = false;
        for sweep in [impact.body, impact.other] {
            if let Some(sweep) = sweeps.get_mut(sweep as usize)
                && impact.time < sweep.end
            {
                sweep.end = impact.time;
                shorter = true;
            }
        }
        shorter
    }

    fn impact(&self, core: u32, other: u32, sweeps: &[Sweep<N>], scratch: &mut Scratch<N>) -> Option<Impact> {
        let (a, b) = (self.colliders[core as usize].as_ref()?, self.colliders[other as usize].as_ref()?);
        let find = |slot: u32| sweeps.binary_search_by_key(&slot, |sweep| sweep.slot).ok();
        let (body, other) = (find(a.body), find(b.body));
        let sweep_of = |index: Option<usize>| index.map(|index| &sweeps[index]);
        if sweep_of(body).is_some_and(Sweep::is_carried) {
            return None;
        }
        let swept = (Swept::new(a, sweep_of(body)), Swept::new(b, sweep_of(other)));
        let time = sweep::time_of_impact(&swept.0, &swept.1, self.tuning.speculative_distance, scratch)?;
        let number = |index: Option<usize>| index.map_or(NONE, |index| index as u32);
        let impact = Impact { time, body: number(body), other: number(other) };
        // Between one that stands and a kinematic body, or two that stand, nobody can be put back.
        (impact.body != NONE || impact.other != NONE).then_some(impact)
    }

    /// Bodies end where their ways do.
    fn write_back(&mut self, work: &Continuous<N>) {
        for sweep in work.sweeps.iter().filter(|sweep| sweep.end < 1.0 || sweep.is_carried()) {
            let Some(body) = self.bodies.at_mut(sweep.slot).filter(|body| body.kind == BodyKind::Dynamic) else {
                continue;
            };
            (body.centre, body.rotation) = sweep.place();
            body.refresh_angular_velocity();
            body.vetted = false;
        }
    }
}

//! What the rows of a block are made of, from contacts and bodies all over memory: each number of eight contacts side by side, so
//! that everything else is done for all of them at once.

use hyperbody_collision::MAX_POINTS;
use hyperbody_math::{Bivector, Vector};

use super::Block;
use crate::pairs::{Contact, Touch};
use crate::solver::bodies::{PlaneNumbers, SolverBody};
use crate::solver::lanes::{DoubleLanes, WIDTH};

/// A bivector of each contact.
pub(super) type PlaneLanes<const N: usize> = PlaneNumbers<N, DoubleLanes>;

/// The contacts of a block.
pub(crate) struct Gathered<const N: usize> {
    pub(super) a: Side<N>,
    pub(super) b: Side<N>,
    pub(super) normal: [DoubleLanes; N],
    pub(super) friction: DoubleLanes,
    pub(super) restitution: DoubleLanes,
    pub(super) friction_impulse: [DoubleLanes; N],
    /// How b's surface runs against a's.
    pub(super) surfaces: Rare<Surfaces<N>>,
    /// Of blocks that twist or resist.
    pub(super) twist_impulse: PlaneLanes<N>,
    /// Of blocks that resist: against rolling, against twisting.
    pub(super) resistance: [DoubleLanes; 2],
    /// Points of each contact.
    pub(super) counts: DoubleLanes,
    /// As many as the block has; zero where a contact has fewer.
    pub(super) points: [Point<N>; MAX_POINTS],
}

/// One of the bodies of each contact.
pub(super) struct Side<const N: usize> {
    pub(super) inverse_sqrt_mass: DoubleLanes,
    pub(super) inverse_sqrt_moments: PlaneLanes<N>,
    pub(super) centre: [DoubleLanes; N],
    pub(super) velocity: [DoubleLanes; N],
    pub(super) acceleration: [DoubleLanes; N],
    pub(super) angular_velocity: PlaneLanes<N>,
    pub(super) angular_acceleration: Rare<PlaneLanes<N>>,
    /// World from solver frame.
    pub(super) frame: Rare<[[DoubleLanes; N]; N]>,
}

/// How surfaces run, all of it and what contacts have of it beside their bodies.
#[derive(Clone, Copy)]
pub(super) struct Surfaces<const N: usize> {
    pub(super) whole: [DoubleLanes; N],
    pub(super) of_contact: [DoubleLanes; N],
}

/// A point of each contact.
#[derive(Clone, Copy)]
pub(super) struct Point<const N: usize> {
    pub(super) position: [DoubleLanes; N],
    pub(super) gap: DoubleLanes,
    pub(super) impulse: DoubleLanes,
}

/// What few contacts have.
pub(super) struct Rare<T> {
    any: bool,
    value: T,
}

impl<T> Rare<T> {
    /// What there is, if any contact of the block has it.
    #[inline(always)]
    pub(super) fn get(&self) -> Option<&T> {
        self.any.then_some(&self.value)
    }

    /// To be written; holds what `others` have.
    #[inline]
    fn or(&mut self, others: T) -> &mut T {
        if !self.any {
            *self = Self { any: true, value: others };
        }
        &mut self.value
    }
}

impl<const N: usize> Gathered<N> {
    pub(crate) const ZERO: Self = Self {
        a: Side::ZERO,
        b: Side::ZERO,
        normal: [DoubleLanes::ZERO; N],
        friction: DoubleLanes::ZERO,
        restitution: DoubleLanes::ZERO,
        friction_impulse: [DoubleLanes::ZERO; N],
        surfaces: Rare { any: false, value: Surfaces::ZERO },
        twist_impulse: PlaneNumbers::splat(DoubleLanes::ZERO),
        resistance: [DoubleLanes::ZERO; 2],
        counts: DoubleLanes::ZERO,
        points: [Point::ZERO; MAX_POINTS],
    };

    /// Before the first lane of a block.
    pub(crate) fn start(&mut self) {
        self.surfaces.any = false;
        for side in [&mut self.a, &mut self.b] {
            side.angular_acceleration.any = false;
            side.frame.any = false;
        }
    }

    /// Notes the contact of one lane; [`Contact::NONE`] of [`SolverBody::RESTING`] where there is none.
    pub(crate) fn fill(
        &mut self,
        block: &Block,
        lane: usize,
        contact: &Contact<N>,
        (a, b): (&SolverBody<N>, &SolverBody<N>),
    ) {
        // The remainder spares the check of the lane.
        let lane = lane % WIDTH;
        self.a.fill(block, lane, a);
        self.b.fill(block, lane, b);
        set_vector(&mut self.normal, lane, contact.normal);
        self.friction.0[lane] = contact.friction;
        self.restitution.0[lane] = contact.restitution;
        set_vector(&mut self.friction_impulse, lane, contact.friction_impulse);
        if a.runs || b.runs || contact.surface != Vector::ZERO {
            let surfaces = self.surfaces.or(Surfaces::ZERO);
            set_vector(&mut surfaces.whole, lane, contact.surface + b.surface - a.surface);
            set_vector(&mut surfaces.of_contact, lane, contact.surface);
        }
        if block.twists > 0 || block.resists {
            set_planes(&mut self.twist_impulse, lane, &contact.twist_impulse);
        }
        if block.resists {
            self.resistance[0].0[lane] = contact.resistance.0;
            self.resistance[1].0[lane] = contact.resistance.1;
        }
        self.counts.0[lane] = contact.touches.len() as f64;
        let mut touches = contact.touches.iter();
        for point in &mut self.points[..block.points] {
            match touches.next() {
                Some(touch) => point.fill(lane, touch),
                None => point.clear(lane),
            }
        }
    }
}

impl<const N: usize> Side<N> {
    const ZERO: Self = Self {
        inverse_sqrt_mass: DoubleLanes::ZERO,
        inverse_sqrt_moments: PlaneNumbers::splat(DoubleLanes::ZERO),
        centre: [DoubleLanes::ZERO; N],
        velocity: [DoubleLanes::ZERO; N],
        acceleration: [DoubleLanes::ZERO; N],
        angular_velocity: PlaneNumbers::splat(DoubleLanes::ZERO),
        angular_acceleration: Rare { any: false, value: PlaneNumbers::splat(DoubleLanes::ZERO) },
        frame: Rare { any: false, value: [[DoubleLanes::ZERO; N]; N] },
    };

    #[inline(always)]
    fn fill(&mut self, block: &Block, lane: usize, body: &SolverBody<N>) {
        self.inverse_sqrt_mass.0[lane] = body.inverse_sqrt_mass;
        set_vector(&mut self.centre, lane, body.centre);
        set_vector(&mut self.velocity, lane, body.velocity);
        set_vector(&mut self.acceleration, lane, body.acceleration);
        set_planes(&mut self.angular_velocity, lane, &body.angular_velocity);
        if body.spins_up {
            let rest = PlaneNumbers::splat(DoubleLanes::ZERO);
            set_planes(self.angular_acceleration.or(rest), lane, &body.angular_acceleration);
        }
        // Balls have one moment, which is all that is asked for, and no frame.
        let moments = if block.round { 1 } else { body.inverse_sqrt_moments.len() };
        for (lanes, moment) in self.inverse_sqrt_moments.iter_mut().zip(&body.inverse_sqrt_moments[..moments]) {
            lanes.0[lane] = *moment;
        }
        if !block.round
            && let Some(frame) = &body.frame
        {
            let rows = self.frame.or(identity());
            for (i, row) in rows.iter_mut().enumerate() {
                set_vector(row, lane, frame.matrix().row(i));
            }
        }
    }
}

impl<const N: usize> Surfaces<N> {
    const ZERO: Self = Self { whole: [DoubleLanes::ZERO; N], of_contact: [DoubleLanes::ZERO; N] };
}

impl<const N: usize> Point<N> {
    const ZERO: Self = Self { position: [DoubleLanes::ZERO; N], gap: DoubleLanes::ZERO, impulse: DoubleLanes::ZERO };

    #[inline(always)]
    fn fill(&mut self, lane: usize, touch: &Touch<N>) {
        set_vector(&mut self.position, lane, touch.point.position);
        self.gap.0[lane] = touch.point.separation;
        self.impulse.0[lane] = f64::from(touch.normal_impulse);
    }

    fn clear(&mut self, lane: usize) {
        set_vector(&mut self.position, lane, Vector::ZERO);
        self.gap.0[lane] = 0.0;
        self.impulse.0[lane] = 0.0;
    }
}

#[inline(always)]
fn set_vector<const N: usize>(lanes: &mut [DoubleLanes; N], lane: usize, value: Vector<N>) {
    for i in 0..N {
        lanes[i].0[lane] = value[i];
    }
}

#[inline(always)]
fn set_planes<const N: usize>(lanes: &mut PlaneLanes<N>, lane: usize, value: &Bivector<N>) {
    for (lanes, value) in lanes.iter_mut().zip(value.planes()) {
        lanes.0[lane] = value;
    }
}

/// The frames of bodies that have none.
fn identity<const N: usize>() -> [[DoubleLanes; N]; N] {
    let mut rows = [[DoubleLanes::ZERO; N]; N];
    for i in 0..N {
        rows[i][i] = DoubleLanes::splat(1.0);
    }
    rows
}

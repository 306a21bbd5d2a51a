//! Gaps of contacts whose bodies turn far within one step.
//!
//! Rows follow their points along straight lines, with the arms of the start of the step. A die that lands on a corner at
//! ten metres a second turns by a third of a radian before the step ends, and the corner that slams down next is then
//! centimetres off its line. So after each substep the gaps of bodies that have turned by more than [`FAR`] get what the
//! exact rotation adds to the straight line: n·(R r − r − θ·r), with R = exp θ.

use hyperbody_math::{Bivector, Rotation, Vector};

use super::bodies::{Sizes, SolverBody};
use super::colours::{ActiveContact, Group};
use super::contacts::{ContactRows, Layout, PassTimes};
use super::lanes::Real;
use crate::pairs::Touch;

/// Turn from which the arc is told from its tangent, rad: a millimetre and a quarter at an arm of a metre.
const FAR: f64 = 0.05;

/// A body that has turned far in this step.
#[derive(Clone, Copy, Debug)]
struct Turn<const N: usize> {
    angle: Bivector<N>,
    rotation: Rotation<N>,
}

/// The bodies that have turned far in this step; buffers kept from step to step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Turning<const N: usize> {
    turns: Vec<Turn<N>>,
    /// By row of the solver's bodies: place in `turns`, or [`NONE`].
    place: Vec<u32>,
    /// By row: up to which [`bound`] it is seen not to have turned far without looking closer.
    bounds: Vec<Real>,
}

const NONE: u32 = u32::MAX;

/// The square of a scaled displacement up to which a body has turned by no more than [`FAR`], half by its base motion in `dt`
/// seconds and half by impulses; below zero where that cannot be told.
fn bound<const N: usize>(body: &SolverBody<N>, dt: f64) -> Real {
    const HALF: f64 = 0.49 * FAR;
    if body.is_ball {
        return Real::INFINITY;
    }
    let spin_up = if body.spins_up { body.angular_acceleration.norm() } else { 0.0 };
    if (body.angular_velocity.norm() + dt * spin_up) * dt <= HALF {
        let largest_scale = body.inverse_sqrt_moments.iter().copied().fold(0.0, f64::max);
        let most = HALF / largest_scale;
        (most * most) as Real
    } else {
        LOOKED_AT
    }
}

/// The scaled angular displacement of a body, of its state.
fn scaled_turn<const N: usize>(state: &[Real]) -> &[Real] {
    &state[Sizes::<N>::VELOCITY + N..2 * Sizes::<N>::VELOCITY]
}

/// Whether a body has not turned far for sure, by its state and its [`bound`].
fn is_near<const N: usize>(state: &[Real], bound: Real) -> bool {
    let displaced_sq: Real = scaled_turn::<N>(state).iter().map(|value| value * value).sum();
    displaced_sq <= bound
}

/// The bound of a body of which nothing is known, or that has turned far.
const LOOKED_AT: Real = -1.0;

impl<const N: usize> Turning<N> {
    /// Forgets the last step, and looks who may turn far in the next one of `dt` seconds.
    pub(crate) fn clear(&mut self, bodies: &[SolverBody<N>], dt: f64) {
        self.turns.clear();
        self.place.clear();
        self.place.resize(bodies.len(), NONE);
        self.bounds.clear();
        self.bounds.extend(bodies.iter().map(|body| bound(body, dt)));
    }

    /// Looks who has turned far by now, and mends the gaps of their contacts.
    pub(crate) fn refresh(
        &mut self,
        bodies: &[SolverBody<N>],
        state: &[Real],
        times: &PassTimes,
        (contacts, active): (&mut ContactRows<N>, &[ActiveContact]),
    ) {
        self.find(bodies, state, times);
        if self.turns.is_empty() {
            return;
        }
        for (block, held) in contacts.blocks.iter().zip(&contacts.held) {
            for (lane, &index) in block.contacts.iter().enumerate().filter(|(_, index)| **index != Group::EMPTY) {
                let contact = &active[index as usize];
                let (a, b) = (contact.body_a as usize, contact.body_b as usize);
                if self.place[a] == NONE && self.place[b] == NONE {
                    continue;
                }
                let Some(held) = &held.contacts[lane] else { continue };
                let normal = held.normal;
                for (Touch { point, .. }, k) in held.touches.iter().zip(0..) {
                    // Round surfaces roll over their contact; what turns with the body is the core below.
                    let below = normal * (0.5 * point.separation + held.radii.0);
                    let above = normal * (0.5 * point.separation + held.radii.1);
                    let arc_a = self.arc(a, point.position - below - bodies[a].centre);
                    let arc_b = self.arc(b, point.position + above - bodies[b].centre);
                    let at = block.start + Layout::<N>::arc(block, k);
                    contacts.rows[at].0[lane] = (arc_b - arc_a).dot(normal) as Real;
                }
            }
        }
    }

    fn find(&mut self, bodies: &[SolverBody<N>], state: &[Real], times: &PassTimes) {
        let (moved, moved_sq) = (f64::from(times.moved), f64::from(times.moved_sq));
        let mut rows = state.chunks_exact(Sizes::<N>::STATE).zip(&self.bounds);
        // Mostly nobody has turned far, and this alone is a short loop.
        let Some(first) = rows.position(|(state, bound)| !is_near::<N>(state, *bound)) else { return };
        let rows = state.chunks_exact(Sizes::<N>::STATE).zip(&mut self.bounds).enumerate();
        for (row, (state, bound)) in rows.skip(first.max(1)) {
            let body = &bodies[row];
            if is_near::<N>(state, *bound) || body.is_ball {
                continue;
            }
            let scaled = scaled_turn::<N>(state);
            let known = self.place[row];
            let mut by_impulses: f64 = 0.0;
            for (k, &value) in scaled.iter().enumerate() {
                let turn = f64::from(value) * body.inverse_sqrt_moments[k];
                by_impulses += turn * turn;
            }
            let mut base = body.angular_velocity * moved;
            if body.spins_up {
                base += body.angular_acceleration * moved_sq;
            }
            if known == NONE && by_impulses.sqrt() + base.norm() <= FAR {
                continue;
            }
            let angle = base + body.unscaled_velocity(scaled);
            let turn = Turn { angle, rotation: Rotation::exp(&angle) };
            if let Some(slot) = self.turns.get_mut(known as usize) {
                *slot = turn;
            } else {
                #[expect(clippy::cast_possible_truncation, reason = "no more turns than bodies")]
                let place = self.turns.len() as u32;
                self.place[row] = place;
                *bound = LOOKED_AT;
                self.turns.push(turn);
            }
        }
    }

    /// What the rotation adds to the straight displacement of the point at `offset` from the centre.
    fn arc(&self, row: usize, offset: Vector<N>) -> Vector<N> {
        let Some(turn) = self.turns.get(self.place[row] as usize) else { return Vector::ZERO };
        turn.rotation.rotate(offset) - offset - turn.angle.act_on(offset)
    }
}

//! The first stage of a step: what users set since the last one is brought within the limits that the other stages rely
//! on, so that a wild number harms no one but its own body.
//!
//! After this stage every awake body has finite state, is no faster than [`Tuning::max_speed`] and
//! [`Tuning::max_spin`], and lies within [`POSITION_LIMIT`] of the origin; what cannot be mended is quarantined.

use hyperbody_math::{Bivector, Vector};

use crate::body::Body;
use crate::{BodyKind, Tuning, World};

/// Largest coordinate of a body, m. Beyond, a double no longer tells decimetres apart.
pub const POSITION_LIMIT: f64 = 1e15;

impl<const N: usize> World<N> {
    /// Brings speeds and pushes within the limits, and quarantines bodies that are out of bounds. Sleepers have been
    /// vetted before they fell asleep, and wake when they are pushed.
    pub(crate) fn vet_bodies(&mut self) {
        for slot in 0..self.bodies.slot_count() {
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            let slot = slot as u32;
            let Some(body) = self.bodies.at_mut(slot).filter(|body| body.is_awake() && !body.vetted) else { continue };
            if limit(body, &self.tuning, self.dt) && body.state_is_sound() {
                continue;
            }
            let last = (if in_bounds(body.centre) { body.centre } else { Vector::ZERO }, body.rotation);
            body.quarantine(last);
            self.wake_requests.push(slot);
            self.let_go_of_joints(slot);
            if let Some(handle) = self.bodies.handle_at(slot) {
                self.quarantined.push(handle);
            }
        }
    }
}

impl<const N: usize> World<N> {
    /// Pushes those on that woke since the bodies were vetted: what goes on does so from the step in which they wake.
    pub(crate) fn push_woken(&mut self) {
        if self.islands.nothing_changed() {
            return;
        }
        for body in self.bodies.values_mut().filter(|body| body.is_moving() && !body.pushed) {
            limit(body, &self.tuning, self.dt);
        }
    }
}

/// Whether vetting would change nothing of a sound body whose pushes have been spent, as long as nobody touches it.
pub(crate) fn is_within_limits<const N: usize>(body: &Body<N>, tuning: &Tuning) -> bool {
    is_slow(body, tuning) && body.steady_force == Vector::ZERO && body.steady_torque == Bivector::ZERO
}

pub(crate) fn in_bounds<const N: usize>(position: Vector<N>) -> bool {
    position.iter().fold(true, |all, c| all & (c.abs() <= POSITION_LIMIT))
}

/// Whether speed and spin are below the limits.
#[inline]
fn is_slow<const N: usize>(body: &Body<N>, tuning: &Tuning) -> bool {
    body.velocity.norm_sq() < tuning.max_speed * tuning.max_speed
        && body.angular_velocity.norm_sq() < tuning.max_spin * tuning.max_spin
}

/// Slows a body down to the limits.
#[inline]
pub(crate) fn limit_speed<const N: usize>(body: &mut Body<N>, tuning: &Tuning) {
    if !is_slow(body, tuning) {
        slow_down(body, tuning);
    }
}

#[cold]
fn slow_down<const N: usize>(body: &mut Body<N>, tuning: &Tuning) {
    body.velocity = shortened(body.velocity, tuning.max_speed);
    let spin = shortened_bivector(&body.angular_velocity, tuning.max_spin);
    if spin != body.angular_velocity {
        body.angular_velocity = spin;
        if body.kind == BodyKind::Dynamic {
            body.angular_momentum = body.inertia.momentum(&body.rotation, &spin);
        }
    }
}

/// Slows a body down to the limits, and its pushes to what reaches the largest speed within the step; `false` if a push
/// is beyond all numbers.
fn limit<const N: usize>(body: &mut Body<N>, tuning: &Tuning, dt: f64) -> bool {
    limit_speed(body, tuning);
    if body.kind != BodyKind::Dynamic {
        return true;
    }
    if !body.pushed {
        body.pushed = true;
        body.force += body.steady_force;
        body.torque += body.steady_torque;
    }
    let acceleration = body.force * body.inverse_mass;
    let shorter = shortened(acceleration, tuning.max_speed / dt);
    if shorter != acceleration {
        body.force = shorter * body.mass;
    }
    if body.torque == Bivector::ZERO {
        return acceleration.is_finite();
    }
    let twist = body.inertia.velocity(&body.rotation, &body.torque);
    let shorter = shortened_bivector(&twist, tuning.max_spin / dt);
    if shorter != twist && twist.is_finite() {
        body.torque = body.inertia.momentum(&body.rotation, &shorter);
    }
    acceleration.is_finite() && twist.is_finite()
}

/// A vector of at most the given length in the same direction. Does not overflow on the way.
pub(crate) fn shortened<const N: usize>(v: Vector<N>, longest: f64) -> Vector<N> {
    if v.norm_sq() < longest * longest {
        return v;
    }
    let largest = v.max_abs();
    if !(largest > 0.0 && largest.is_finite()) {
        return v;
    }
    let direction = v * (1.0 / largest);
    let length = direction.norm();
    if length * largest > longest { direction * (longest / length) } else { v }
}

fn shortened_bivector<const N: usize>(b: &Bivector<N>, longest: f64) -> Bivector<N> {
    if b.norm_sq() < longest * longest {
        return *b;
    }
    let largest = b.planes().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return *b;
    }
    let direction = *b * (1.0 / largest);
    let length = direction.norm();
    if length * largest > longest { direction * (longest / length) } else { *b }
}

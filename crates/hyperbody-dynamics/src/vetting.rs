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
    /// Brings speeds and pushes within the limits, and quarantines bodies that are out of bounds.
    pub(crate) fn vet_bodies(&mut self) {
        for slot in 0..self.bodies.slot_count() {
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            let slot = slot as u32;
            let Some(body) = self.bodies.at_mut(slot) else { continue };
            // Pushes on a sleeper wait for the next stage, which wakes it.
            if body.kind == BodyKind::Static || body.quarantined {
                continue;
            }
            limit(body, &self.tuning, self.dt);
            if body.state_is_sound() {
                continue;
            }
            let last = (if in_bounds(body.centre) { body.centre } else { Vector::ZERO }, body.rotation);
            body.quarantine(last);
            self.wake_requests.push(slot);
            if let Some(handle) = self.bodies.handle_at(slot) {
                self.quarantined.push(handle);
            }
        }
    }
}

pub(crate) fn in_bounds<const N: usize>(position: Vector<N>) -> bool {
    position.max_abs() <= POSITION_LIMIT
}

/// Slows a body down to the limits. Finite accelerations are limited to what reaches the largest speed within the step.
fn limit<const N: usize>(body: &mut Body<N>, tuning: &Tuning, dt: f64) {
    let speed = length(body.velocity);
    if speed > tuning.max_speed {
        body.velocity *= tuning.max_speed / speed;
    }
    let spin = bivector_length(&body.angular_velocity);
    if spin > tuning.max_spin {
        let factor = tuning.max_spin / spin;
        body.angular_velocity *= factor;
        body.angular_momentum *= factor;
    }
    if body.kind != BodyKind::Dynamic {
        return;
    }
    let push = length(body.force) * body.inverse_mass * dt;
    if push > tuning.max_speed && push.is_finite() {
        body.force *= tuning.max_speed / push;
    }
    let twist = bivector_length(&body.inertia.velocity(&body.rotation, &body.torque)) * dt;
    if twist > tuning.max_spin && twist.is_finite() {
        body.torque *= tuning.max_spin / twist;
    }
}

/// Euclidean length that does not overflow on the way.
fn length<const N: usize>(v: Vector<N>) -> f64 {
    let largest = v.max_abs();
    if largest > 0.0 && largest.is_finite() { (v * (1.0 / largest)).norm() * largest } else { largest }
}

fn bivector_length<const N: usize>(b: &Bivector<N>) -> f64 {
    let largest = b.planes().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    if largest > 0.0 && largest.is_finite() { (*b * (1.0 / largest)).norm() * largest } else { largest }
}

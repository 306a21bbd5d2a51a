//! Hands: what is held goes to where a mouse, a finger or a controller is, and turns as it turns.
//!
//! Before each step the velocity of the body is set towards the place that the hand wants, by no more than a hand can change
//! it: what it meets on the way stops it, and let go it keeps the velocity that it has. The velocity is that of the held
//! point, so that a body that is turned turns about where it is held.

use hyperbody::math::{Bivector, Rotation, Vector};
use hyperbody::prelude::{BodyHandle, World};

/// Part of the way to the hand that a body goes in a step: it arrives within a few steps, without overshoot.
const APPROACH: f64 = 0.25;

/// Most that a hand changes the speed of what it holds, m/s²: fifteen times gravity lifts what lies on top and is still held
/// up by walls.
const PULL: f64 = 150.0;

/// The same for turning, rad/s².
const TWIST: f64 = 600.0;

/// Part of its spin that a held body keeps from step to step while the hand does not turn.
const STEADINESS: f64 = 0.9;

/// A hand that holds something.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hand<const N: usize> {
    pub(crate) hand: u32,
    /// Number of the body.
    pub(crate) body: u32,
    pub(crate) handle: BodyHandle,
    /// Step of the scene at which it took hold.
    pub(crate) since: u64,
    /// Where it holds the body, in the body's frame, m.
    anchor: Vector<N>,
    /// Where it draws that point to, in the world, m.
    pub(crate) target: Vector<N>,
    grip: Option<Grip<N>>,
}

/// What a hand that turns remembers.
#[derive(Clone, Copy, Debug)]
struct Grip<const N: usize> {
    /// The hand's attitude when it began to turn, if it has one.
    hand_at_start: Option<Rotation<N>>,
    /// The body's attitude then.
    body_at_start: Rotation<N>,
    /// Where it is drawn to.
    target: Rotation<N>,
}

impl<const N: usize> Hand<N> {
    /// Takes hold of a body at a point of the world, at a step of the scene.
    pub(crate) fn grab(
        world: &World<N>,
        hand: u32,
        (body, handle): (u32, BodyHandle),
        point: Vector<N>,
        since: u64,
    ) -> Self {
        let anchor = world.body(handle).map_or(Vector::ZERO, |body| body.pose().inverse_transform_point(point));
        Self { hand, body, handle, since, anchor, target: point, grip: None }
    }

    /// Says where the hand is now, and how it turns: by the change of its attitude, or by a further turn of the world.
    pub(crate) fn go(
        &mut self,
        world: &World<N>,
        point: Vector<N>,
        attitude: Option<Rotation<N>>,
        turn: Option<Rotation<N>>,
    ) {
        self.target = point;
        if attitude.is_none() && turn.is_none() {
            return;
        }
        let Some(body) = world.body(self.handle) else { return };
        let rotation = body.rotation();
        let grip = self.grip.get_or_insert(Grip { hand_at_start: None, body_at_start: rotation, target: rotation });
        if let Some(attitude) = attitude {
            if let Some(start) = grip.hand_at_start {
                grip.target = attitude * start.inverse() * grip.body_at_start;
            } else {
                grip.hand_at_start = Some(attitude);
                grip.body_at_start = grip.target;
            }
        }
        if let Some(turn) = turn {
            grip.target = turn * grip.target;
            grip.body_at_start = turn * grip.body_at_start;
        }
    }

    /// Sets the body moving; to be called before each step.
    pub(crate) fn pull(&self, world: &mut World<N>) {
        let dt = world.dt();
        let gravity = world.gravity();
        let Some(mut body) = world.body_mut(self.handle) else { return };
        let now = body.as_ref();
        let (pose, velocity, spin) = (now.pose(), now.velocity(), now.angular_velocity());
        let wanted_spin = match &self.grip {
            Some(grip) => (grip.target * pose.rotation.inverse()).log() * (APPROACH / dt),
            None => spin * STEADINESS,
        };
        let spin = spin + limited_turn(wanted_spin - spin, TWIST * dt);
        let held = pose.transform_point(self.anchor);
        let arm = held - now.centre_of_mass();
        // Gravity will add its own in the step.
        let wanted = (self.target - held) * (APPROACH / dt) - spin.act_on(arm) - gravity * dt;
        let change = wanted - velocity;
        let most = PULL * dt;
        let length = change.norm();
        let change = if length > most { change * (most / length) } else { change };
        // Refusals are of numbers that are not finite, which the solver's own vetting reports.
        let _ = body.set_angular_velocity(spin);
        let _ = body.set_velocity(velocity + change);
    }

    /// Where the held point of the body is, in the world.
    pub(crate) fn point(&self, world: &World<N>) -> Vector<N> {
        world.body(self.handle).map_or(self.target, |body| body.pose().transform_point(self.anchor))
    }
}

fn limited_turn<const N: usize>(change: Bivector<N>, most: f64) -> Bivector<N> {
    let size = change.norm();
    if size > most { change * (most / size) } else { change }
}

//! Joints as constraint rows.
//!
//! A ball joint keeps N rows, one an axis, solved together through their N×N response matrix. Unlike contacts, joints
//! follow the turning of their bodies within the step: anchors are turned along at every substep, because a pendulum's
//! arm is long and its error would be seen.

use hyperbody_math::{Bivector, Rotation, Vector};

use super::bodies::{MAX_PLANES, Sizes, SolverBody};
use super::contacts::PassTimes;
use super::lanes::Real;
use super::softness::Softness;
use crate::joint::Joint;

/// One end of a joint.
#[derive(Clone, Copy, Debug)]
struct End<const N: usize> {
    /// Row of the solver's bodies.
    body: usize,
    /// Anchor from the centre of mass at the start of the step, world axes.
    start_offset: Vector<N>,
    /// Scaled arms of the axes at the anchor, now.
    arms: [[f64; MAX_PLANES]; N],
}

/// A joint of one step.
#[derive(Clone, Debug)]
pub(crate) struct JointRows<const N: usize> {
    pub(crate) slot: u32,
    a: End<N>,
    b: End<N>,
    /// Inverse of the response matrix of the anchor.
    mass: [[f64; N]; N],
    /// Anchor of b minus anchor of a, now, m.
    gap: Vector<N>,
    /// Base part of the anchors' relative velocity, now, m/s.
    base_velocity: Vector<N>,
    /// Accumulated impulse on b, N·s.
    pub(crate) impulse: Vector<N>,
}

impl<const N: usize> JointRows<N> {
    /// The rows of a joint between two solver bodies, each given by its row and the anchor's offset in world axes.
    pub(crate) fn new(
        slot: u32,
        joint: &Joint<N>,
        (a, offset_a): (usize, Vector<N>),
        (b, offset_b): (usize, Vector<N>),
    ) -> Self {
        let end = |body, start_offset| End { body, start_offset, arms: [[0.0; MAX_PLANES]; N] };
        Self {
            slot,
            a: end(a, offset_a),
            b: end(b, offset_b),
            mass: [[0.0; N]; N],
            gap: Vector::ZERO,
            base_velocity: Vector::ZERO,
            impulse: joint.impulse,
        }
    }

    /// Turns the anchors along and renews what depends on them.
    pub(crate) fn refresh(&mut self, bodies: &[SolverBody<N>], state: &[Real], times: &PassTimes) {
        let (anchor_a, velocity_a) = self.a.refresh(bodies, state, times);
        let (anchor_b, velocity_b) = self.b.refresh(bodies, state, times);
        self.gap = anchor_b - anchor_a;
        self.base_velocity = velocity_b - velocity_a;
        let (mass_a, mass_b) = (bodies[self.a.body].inverse_sqrt_mass, bodies[self.b.body].inverse_sqrt_mass);
        let mut response = [[0.0; N]; N];
        for i in 0..N {
            for j in 0..N {
                let mut sum = if i == j { mass_a * mass_a + mass_b * mass_b } else { 0.0 };
                for k in 0..Sizes::<N>::K {
                    sum += self.a.arms[i][k] * self.a.arms[j][k] + self.b.arms[i][k] * self.b.arms[j][k];
                }
                response[i][j] = sum;
            }
        }
        self.mass = super::contacts::invert_positive_definite(response, N);
    }

    /// Applies the impulse held from the last substep.
    pub(crate) fn warm_start(&self, bodies: &[SolverBody<N>], state: &mut [Real]) {
        self.apply(bodies, state, self.impulse);
    }

    /// One sweep over the joint's rows, soft while `softness` is given, rigid otherwise.
    pub(crate) fn solve(&mut self, bodies: &[SolverBody<N>], state: &mut [Real], softness: Option<&Softness>) {
        let velocity = self.base_velocity + self.b.measure(bodies, state) - self.a.measure(bodies, state);
        let (bias, mass_scale, impulse_scale) = match softness {
            Some(soft) => (self.gap * soft.bias_rate, soft.mass_scale, soft.impulse_scale),
            None => (Vector::ZERO, 1.0, 0.0),
        };
        let error = velocity + bias;
        let change =
            Vector::from_fn(|i| -mass_scale * Vector(self.mass[i]).dot(error) - impulse_scale * self.impulse[i]);
        self.impulse += change;
        self.apply(bodies, state, change);
    }

    fn apply(&self, bodies: &[SolverBody<N>], state: &mut [Real], impulse: Vector<N>) {
        self.a.apply(bodies, state, -impulse);
        self.b.apply(bodies, state, impulse);
    }
}

impl<const N: usize> End<N> {
    /// Renews the arms; returns the anchor's position and base velocity in the world.
    fn refresh(&mut self, bodies: &[SolverBody<N>], state: &[Real], times: &PassTimes) -> (Vector<N>, Vector<N>) {
        let body = &bodies[self.body];
        let (moved, moved_sq) = (f64::from(times.moved), f64::from(times.moved_sq));
        let mut turned = body.angular_velocity * moved + body.angular_acceleration * moved_sq;
        let mut centre = body.centre + body.velocity * moved + body.acceleration * moved_sq;
        if body.inverse_sqrt_mass > 0.0 {
            let row = self.body * Sizes::<N>::STATE + Sizes::<N>::VELOCITY;
            let displacement = &state[row..row + Sizes::<N>::VELOCITY];
            centre += Vector::from_fn(|i| f64::from(displacement[i]) * body.inverse_sqrt_mass);
            turned += body.unscaled_velocity(&displacement[N..]);
        }
        let offset = turn_along(&turned, self.start_offset);
        for axis in 0..N {
            self.arms[axis] = body.arm(offset, Vector::unit(axis));
        }
        let elapsed = f64::from(times.elapsed);
        let velocity = body.base_velocity_at(offset) + body.base_acceleration_at(offset) * elapsed;
        (centre + offset, velocity)
    }

    /// Change of the anchor's velocity since the start of the step.
    fn measure(&self, bodies: &[SolverBody<N>], state: &[Real]) -> Vector<N> {
        let inverse_sqrt_mass = bodies[self.body].inverse_sqrt_mass;
        if inverse_sqrt_mass == 0.0 {
            return Vector::ZERO;
        }
        let row = self.body * Sizes::<N>::STATE;
        let change = &state[row..row + Sizes::<N>::VELOCITY];
        Vector::from_fn(|i| {
            let mut sum = f64::from(change[i]) * inverse_sqrt_mass;
            for k in 0..Sizes::<N>::K {
                sum += self.arms[i][k] * f64::from(change[N + k]);
            }
            sum
        })
    }

    fn apply(&self, bodies: &[SolverBody<N>], state: &mut [Real], impulse: Vector<N>) {
        let inverse_sqrt_mass = bodies[self.body].inverse_sqrt_mass;
        if inverse_sqrt_mass == 0.0 {
            return;
        }
        let row = self.body * Sizes::<N>::STATE;
        let change = &mut state[row..row + Sizes::<N>::VELOCITY];
        for i in 0..N {
            change[i] += (impulse[i] * inverse_sqrt_mass) as Real;
        }
        for k in 0..Sizes::<N>::K {
            let mut sum = 0.0;
            for i in 0..N {
                sum += self.arms[i][k] * impulse[i];
            }
            change[N + k] += sum as Real;
        }
    }
}

/// A vector turned by the rotation vector `turned`. Up to a tenth of a radian by the exponential series to third order:
/// the remainder is θ⁴/24, 4e-6, and does not add up, since every step starts from the exact attitude.
fn turn_along<const N: usize>(turned: &Bivector<N>, r: Vector<N>) -> Vector<N> {
    if turned.norm_sq() > 0.01 {
        return Rotation::exp(turned).rotate(r);
    }
    let first = turned.act_on(r);
    let second = turned.act_on(first);
    let third = turned.act_on(second);
    r + first + second * 0.5 + third * (1.0 / 6.0)
}

//! Impulses and forces become motion: the end of the step.
//!
//! With substep h, velocity v₀ and acceleration a at the start, and Σ the solver's displacement: x ← x + n·h·v₀ +
//! ½n(n+1)·h²·a + Σ, which is what n substeps of the semi-implicit Euler rule give, exactly.

use hyperbody_math::{Bivector, Rotation, Vector};

use crate::body::Body;
use crate::pairs::Pair;
use crate::solver::bodies::{Sizes, SolverBody};
use crate::vetting::limit_speed;
use crate::{BodyKind, Tuning, World};

impl<const N: usize> World<N> {
    /// Writes the solver's results into the bodies.
    pub(crate) fn integrate(&mut self) {
        let n = f64::from(self.substeps);
        let h = self.dt / n;
        let span = Span { dt: self.dt, dt_sq: h * h * n * (n + 1.0) * 0.5 };
        let mut gyros = self.solver.gyros.iter().peekable();
        let sound = self.quarantined.len();
        for (row, solved) in self.solver.bodies.iter().enumerate() {
            let Some(body) = self.bodies.at_mut(solved.slot) else { continue };
            let before = (body.centre, body.rotation);
            let at = row * Sizes::<N>::STATE;
            let (change, displacement) = self.solver.state[at..at + Sizes::<N>::STATE].split_at(Sizes::<N>::VELOCITY);
            span.translate(body, solved, &change[..N], &displacement[..N]);
            match gyros.next_if(|gyro| gyro.body == row) {
                Some(gyro) => {
                    body.angular_momentum = gyro.own_momentum(solved, &self.solver.state, span.dt);
                    let principal = gyro.at_end(solved, &displacement[N..], span.dt);
                    let mut rotation = principal * body.inertia.body_from_principal.inverse();
                    rotation.reorthonormalize();
                    body.rotation = rotation;
                }
                None => span.turn(body, solved, &change[N..], &displacement[N..]),
            }
            let spin = body.angular_velocity.norm();
            finish(body, &self.tuning);
            rest(body, before, self.gravity, &self.tuning, self.dt);
            let turned = spin.max(body.angular_velocity.norm()) * body.radius * self.dt;
            let went = body.centre.distance(before.0) + turned;
            if went > self.tuning.speculative_distance.max(body.core_radius) {
                self.continuous.fast.push(solved.slot);
            }
            if !body.state_is_sound() {
                body.quarantine(before);
                self.wake_requests.push(solved.slot);
                if let Some(handle) = self.bodies.handle_at(solved.slot) {
                    self.quarantined.push(handle);
                }
            }
        }
        for &slot in self.solver.creeping() {
            self.bodies.at_mut(slot).into_iter().for_each(|body| body.slow_time = 0.0);
        }
        // Their impulses are no numbers either.
        for body in sound..self.quarantined.len() {
            let slot = self.quarantined[body].index;
            let own = |pair: &&mut Pair<N>| pair.body_a == slot || pair.body_b == slot;
            self.pairs.iter_mut().filter(own).for_each(Pair::forget);
            self.let_go_of_joints(slot);
        }
        for body in self.bodies.values_mut().filter(|body| body.kind == BodyKind::Kinematic && !body.quarantined) {
            if let Some((centre, rotation)) = body.led_to.take() {
                (body.centre, body.rotation, body.arrived) = (centre, rotation, true);
                continue;
            }
            body.centre += body.velocity * self.dt;
            if body.angular_velocity != Bivector::ZERO {
                body.rotation = Rotation::exp(&(body.angular_velocity * self.dt)) * body.rotation;
                body.rotation.reorthonormalize();
            }
        }
    }
}

/// Lengths of the step as base motion enters: n·h and ½n(n+1)·h².
#[derive(Clone, Copy)]
struct Span {
    dt: f64,
    dt_sq: f64,
}

impl Span {
    fn translate<const N: usize>(
        &self,
        body: &mut Body<N>,
        solved: &SolverBody<N>,
        change: &[crate::solver::Real],
        displacement: &[crate::solver::Real],
    ) {
        let scale = solved.inverse_sqrt_mass;
        let by_impulses = Vector::from_fn(|i| f64::from(displacement[i]) * scale);
        body.centre += solved.velocity * self.dt + solved.acceleration * self.dt_sq + by_impulses;
        body.velocity += solved.acceleration * self.dt + Vector::from_fn(|i| f64::from(change[i]) * scale);
    }

    /// Isotropic bodies: momentum and velocity are parallel, so the turn is one exponential.
    fn turn<const N: usize>(
        &self,
        body: &mut Body<N>,
        solved: &SolverBody<N>,
        change: &[crate::solver::Real],
        displacement: &[crate::solver::Real],
    ) {
        body.angular_momentum += body.torque * self.dt + solved.own_momentum_of(change);
        let turned = solved.angular_velocity * self.dt
            + solved.angular_acceleration * self.dt_sq
            + solved.unscaled_velocity(displacement);
        if turned != Bivector::ZERO {
            body.rotation = Rotation::exp(&turned) * body.rotation;
            body.rotation.reorthonormalize();
        }
    }
}

/// Derived quantities and limits.
fn finish<const N: usize>(body: &mut Body<N>, tuning: &Tuning) {
    body.force = Vector::ZERO;
    body.torque = Bivector::ZERO;
    body.pushed = false;
    body.refresh_angular_velocity();
    limit_speed(body, tuning);
}

/// How far a body may get while it counts as resting, in parts of the way of [`Tuning::sleep_speed`] in [`Tuning::sleep_time`]: what trembles in its
/// place rests, what goes on does not, however slowly. What joints leave a way to go is at rest less often than it is slow: a
/// pendulum where it turns back, a balance that sets out.
const LOOSE: f64 = 0.08;
const JOINTED: f64 = 0.02;

/// The same in parts of the way that what pulls it would take it in that time.
const OF_PULL: f64 = 0.25;

/// Counts how long a body has been slow and in one place; `before` is where it was before this step.
fn rest<const N: usize>(
    body: &mut Body<N>,
    (centre, rotation): (Vector<N>, Rotation<N>),
    gravity: Vector<N>,
    tuning: &Tuning,
    dt: f64,
) {
    if body.slow_time == 0.0 {
        body.strayed = (Vector::ZERO, Bivector::ZERO);
    }
    let fastest = body.velocity.norm() + body.angular_velocity.norm() * body.radius;
    if fastest >= tuning.sleep_speed {
        body.slow_time = 0.0;
        return;
    }
    let turn = *body.rotation.matrix() * rotation.matrix().transpose();
    body.strayed.0 += body.centre - centre;
    body.strayed.1 += Bivector::from_antisymmetric_part(&turn.transpose());
    let way = tuning.sleep_speed * tuning.sleep_time * if body.joints.is_empty() { LOOSE } else { JOINTED };
    let pull = (gravity * body.gravity_scale + body.steady_force * body.inverse_mass).norm();
    let by_pull = 0.5 * pull * tuning.sleep_time * tuning.sleep_time;
    let allowed = if pull > 0.0 { way.min(OF_PULL * by_pull) } else { way };
    let strayed = body.strayed.0.norm() + body.strayed.1.norm() * body.radius;
    body.slow_time = if strayed < allowed { body.slow_time + dt } else { 0.0 };
}

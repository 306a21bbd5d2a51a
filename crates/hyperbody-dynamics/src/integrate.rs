//! Impulses and forces become motion: the end of the step.
//!
//! With substep h, velocity v₀ and acceleration a at the start, and Σ the solver's displacement: x ← x + n·h·v₀ +
//! ½n(n+1)·h²·a + Σ, which is what n substeps of the semi-implicit Euler rule give, exactly.

use hyperbody_math::{Bivector, Rotation, Vector};
use rayon::prelude::*;

use crate::body::Body;
use crate::handle::Slot;
use crate::pairs::Pair;
use crate::solver::Solver;
use crate::solver::bodies::{Sizes, SolverBody};
use crate::solver::gyro::Gyro;
use crate::threads::MANY_BODIES;
use crate::vetting::{is_within_limits, limit_speed};
use crate::{BodyKind, Tuning, World};

impl<const N: usize> World<N> {
    /// Writes the solver's results into the bodies, stretches of them side by side.
    pub(crate) fn integrate(&mut self) {
        let n = f64::from(self.substeps);
        let h = self.dt / n;
        let integration = Integration {
            span: Span { dt: self.dt, dt_sq: h * h * n * (n + 1.0) * 0.5 },
            solver: &self.solver,
            gravity: self.gravity,
            tuning: &self.tuning,
            sleeping: self.sleeping,
        };
        let slots = self.bodies.slots.as_mut_slice();
        let chunk = slots.len().div_ceil(self.integrated.len()).max(1);
        match self.pool.as_ref().filter(|_| slots.len() >= MANY_BODIES) {
            None => integration.bodies(0, slots, &mut self.integrated[0]),
            Some(pool) => pool.install(|| {
                let parts = slots.par_chunks_mut(chunk).zip(&mut self.integrated).enumerate();
                parts.for_each(|(part, (slots, integrated))| integration.bodies(part * chunk, slots, integrated));
            }),
        }
        for &slot in self.solver.creeping() {
            self.bodies.at_mut(slot).into_iter().for_each(|body| body.slow_time = 0.0);
        }
        self.note_integrated();
    }

    /// Takes over what integrating found, in the order of the bodies.
    fn note_integrated(&mut self) {
        let mut integrated = std::mem::take(&mut self.integrated);
        for Integrated { fast, unsound } in &mut integrated {
            self.continuous.fast.append(fast);
            for slot in unsound.drain(..) {
                self.wake_requests.push(slot);
                self.quarantined.extend(self.bodies.handle_at(slot));
                // Their impulses are no numbers either.
                let own = |pair: &&mut Pair<N>| pair.body_a == slot || pair.body_b == slot;
                self.pairs.iter_mut().filter(own).for_each(Pair::forget);
                self.let_go_of_joints(slot);
            }
        }
        self.integrated = integrated;
    }
}

/// How far a body may get while it counts as resting, in parts of the way of [`Tuning::sleep_speed`] in [`Tuning::sleep_time`]: what trembles in its
/// place rests, what goes on does not, however slowly. What joints leave a way to go is at rest less often than it is slow: a
/// pendulum where it turns back, a balance that sets out.
const LOOSE: f64 = 0.08;
const JOINTED: f64 = 0.02;

/// The same in parts of the way that what pulls it would take it in that time.
const OF_PULL: f64 = 0.25;

/// What integrating a stretch of bodies found: slots, ascending.
#[derive(Debug, Default)]
pub(crate) struct Integrated {
    /// Bodies that went so far that they may have passed through something.
    fast: Vec<u32>,
    /// Bodies gone non-finite.
    unsound: Vec<u32>,
}

/// What integrating bodies reads.
#[derive(Clone, Copy)]
struct Integration<'a, const N: usize> {
    span: Span,
    solver: &'a Solver<N>,
    gravity: Vector<N>,
    tuning: &'a Tuning,
    /// Whether bodies may fall asleep: only then somebody asks how long they have been resting.
    sleeping: bool,
}

impl<const N: usize> Integration<'_, N> {
    /// Moves the bodies in consecutive slots on, the first of which is `start`.
    fn bodies(&self, start: usize, slots: &mut [Slot<Body<N>>], integrated: &mut Integrated) {
        let row = |body: &Body<N>| body.is_moving().then_some(body.solver_index as usize);
        let first = slots.iter().find_map(|slot| row(slot.value.as_ref()?)).unwrap_or(0);
        let gyros = &self.solver.gyros;
        let mut gyros = &gyros[gyros.partition_point(|gyro| gyro.body < first)..];
        for (index, body) in slots.iter_mut().enumerate() {
            let Some(body) = &mut body.value else { continue };
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            let slot = (start + index) as u32;
            if let Some(row) = row(body) {
                let gyro = gyros.first().filter(|gyro| gyro.body == row);
                gyros = &gyros[usize::from(gyro.is_some())..];
                self.dynamic(body, slot, row, gyro, integrated);
            } else if body.kind == BodyKind::Kinematic && !body.quarantined {
                self.kinematic(body, slot, integrated);
            }
        }
    }

    fn dynamic(&self, body: &mut Body<N>, slot: u32, row: usize, gyro: Option<&Gyro<N>>, integrated: &mut Integrated) {
        let before = (body.centre, body.rotation);
        let solved = &self.solver.bodies[row];
        let state = &self.solver.state[row * Sizes::<N>::STATE..][..Sizes::<N>::STATE];
        let (change, displacement) = state.split_at(Sizes::<N>::VELOCITY);
        self.span.translate(body, solved, &change[..N], &displacement[..N]);
        match gyro {
            Some(gyro) => {
                body.angular_momentum = gyro.own_momentum(solved, &self.solver.state, self.span.dt);
                let principal = gyro.at_end(solved, &displacement[N..], self.span.dt);
                let mut rotation = principal * body.inertia.body_from_principal.inverse();
                rotation.reorthonormalize();
                body.rotation = rotation;
            }
            None => self.span.turn(body, solved, &change[N..], &displacement[N..]),
        }
        let spin_before = body.angular_velocity.norm();
        finish(body, self.tuning);
        let spin = body.angular_velocity.norm();
        if self.sleeping {
            self.rest(body, before, body.velocity.norm() + spin * body.radius);
        }
        let turned = spin_before.max(spin) * body.radius * self.span.dt;
        let went = body.centre.distance(before.0) + turned;
        if went > self.tuning.speculative_distance.max(body.core_radius) {
            integrated.fast.push(slot);
        }
        if !body.motion_is_sound() {
            body.quarantine(before);
            integrated.unsound.push(slot);
        }
        body.vetted = is_within_limits(body, self.tuning);
    }

    fn kinematic(&self, body: &mut Body<N>, slot: u32, integrated: &mut Integrated) {
        if let Some((centre, rotation)) = body.led_to.take() {
            (body.centre, body.rotation, body.arrived) = (centre, rotation, true);
        } else {
            body.centre += body.velocity * self.span.dt;
            if body.angular_velocity != Bivector::ZERO {
                body.rotation = Rotation::exp(&(body.angular_velocity * self.span.dt)) * body.rotation;
                body.rotation.reorthonormalize();
            }
        }
        // What lies in its way may be carried along or passed through.
        let speed = body.velocity.norm() + body.angular_velocity.norm() * body.radius;
        if speed * self.span.dt > self.tuning.speculative_distance {
            integrated.fast.push(slot);
        }
    }

    /// Counts how long a body has been slow and in one place; `before` is where it was before this step, and `fastest` the speed of
    /// its fastest point.
    fn rest(&self, body: &mut Body<N>, (centre, rotation): (Vector<N>, Rotation<N>), fastest: f64) {
        if body.slow_time == 0.0 {
            body.strayed = (Vector::ZERO, Bivector::ZERO);
        }
        let tuning = self.tuning;
        if fastest >= tuning.sleep_speed {
            body.slow_time = 0.0;
            return;
        }
        body.strayed.0 += body.centre - centre;
        body.strayed.1 += turn_between(&rotation, &body.rotation);
        let way = tuning.sleep_speed * tuning.sleep_time * if body.joints.is_empty() { LOOSE } else { JOINTED };
        let pull = (self.gravity * body.gravity_scale + body.steady_force * body.inverse_mass).norm();
        let by_pull = 0.5 * pull * tuning.sleep_time * tuning.sleep_time;
        let allowed = if pull > 0.0 { way.min(OF_PULL * by_pull) } else { way };
        let strayed = body.strayed.0.norm() + body.strayed.1.norm() * body.radius;
        body.slow_time = if strayed < allowed { body.slow_time + self.span.dt } else { 0.0 };
    }
}

/// The small turn from one attitude to another: the antisymmetric part of the way there.
fn turn_between<const N: usize>(from: &Rotation<N>, to: &Rotation<N>) -> Bivector<N> {
    let (from, to) = (from.matrix(), to.matrix());
    Bivector::from_fn(|i, j| 0.5 * (to.row(j).dot(from.row(i)) - to.row(i).dot(from.row(j))))
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

//! Where jointed bodies are within the step, in double precision.
//!
//! Contacts make do with the attitude of the start of the step; joints follow the turning, because the arm of a
//! pendulum is long and its error would be seen.

use hyperbody_math::{Bivector, Matrix, Rotation, Vector};

use crate::solver::bodies::{Sizes, SolverBody};
use crate::solver::gyro::Gyro;
use crate::solver::joints::Moving;

/// A moment of the step, as base motion enters: with k of n substeps done, lengths of h.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    /// Substep, s.
    pub(crate) h: f64,
    /// k·h and ½k(k+1)·h²: what has been moved by base velocity and acceleration.
    pub(crate) moved: f64,
    pub(crate) moved_sq: f64,
    /// Time by which base accelerations have acted on velocities, s.
    pub(crate) elapsed: f64,
}

impl Moment {
    /// After `done` moves and `kicks` ≥ `done` additions of acceleration.
    pub(crate) fn new(done: u32, kicks: u32, h: f64) -> Self {
        let k = f64::from(done);
        Self { h, moved: h * k, moved_sq: h * h * k * (k + 1.0) * 0.5, elapsed: h * f64::from(kicks) }
    }
}

/// Centre of mass in the world, and the turn since the start of the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot<const N: usize> {
    pub(crate) centre: Vector<N>,
    pub(crate) turn: Matrix<N>,
}

/// A jointed body within the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<const N: usize> {
    /// Row of the solver's bodies; 0 for what does not move.
    pub(crate) row: usize,
    pub(crate) gyro: Option<usize>,
    pub(crate) now: Spot<N>,
    /// Where it would be after this substep at its present velocity.
    pub(crate) next: Spot<N>,
    /// Of isotropic and kinematic bodies: logarithm of the turn.
    turned: Bivector<N>,
    /// Velocities without impulses, now.
    pub(crate) velocity: Vector<N>,
    pub(crate) spin: Bivector<N>,
    /// What forces add to them in a second.
    pub(crate) acceleration: Vector<N>,
    pub(crate) spin_up: Bivector<N>,
}

impl<const N: usize> Place<N> {
    pub(crate) fn new(row: usize, gyro: Option<usize>, centre: Vector<N>) -> Self {
        let spot = Spot { centre, turn: Matrix::IDENTITY };
        Self {
            row,
            gyro,
            now: spot,
            next: spot,
            turned: Bivector::ZERO,
            velocity: Vector::ZERO,
            spin: Bivector::ZERO,
            acceleration: Vector::ZERO,
            spin_up: Bivector::ZERO,
        }
    }

    /// Looks where the body is now.
    pub(crate) fn refresh(&mut self, moving: &Moving<'_, N>, moment: &Moment) {
        if self.row == 0 {
            return;
        }
        let body = &moving.bodies[self.row];
        (self.acceleration, self.spin_up) = (body.acceleration, body.angular_acceleration);
        self.velocity = body.velocity + body.acceleration * moment.elapsed;
        self.spin = body.angular_velocity + body.angular_acceleration * moment.elapsed;
        self.now.centre = body.centre + body.velocity * moment.moved + body.acceleration * moment.moved_sq;
        let mut turned = body.angular_velocity * moment.moved + body.angular_acceleration * moment.moved_sq;
        if body.inverse_sqrt_mass > 0.0 {
            let (linear, angular) = self.part(moving, Sizes::<N>::VELOCITY);
            self.now.centre += linear;
            turned += angular;
        }
        self.turned = turned;
        self.now.turn = match (self.gyro, &body.frame) {
            (Some(gyro), Some(frame)) => *moving.gyros[gyro].world_from_principal.matrix() * frame.matrix().transpose(),
            _ => turn(&turned),
        };
    }

    /// Looks where the body will be after this substep if nothing changes its velocity.
    pub(crate) fn look_ahead(&mut self, moving: &Moving<'_, N>, moment: &Moment) {
        if self.row == 0 {
            return;
        }
        let body = &moving.bodies[self.row];
        let (mut velocity, mut spin) = (self.velocity, self.spin);
        if body.inverse_sqrt_mass > 0.0 {
            let (linear, angular) = self.part(moving, 0);
            velocity += linear;
            spin += angular;
        }
        self.next.centre = self.now.centre + velocity * moment.h;
        self.next.turn = match self.gyro {
            Some(gyro) => {
                let bend = moving.gyros[gyro].precession_of(&spin);
                turn(&(spin * moment.h + bend * (0.5 * moment.h * moment.h))) * self.now.turn
            }
            None => turn(&(self.turned + spin * moment.h)),
        };
    }

    /// Angular velocity, impulses included, rad/s.
    pub(crate) fn spin_now(&self, moving: &Moving<'_, N>) -> Bivector<N> {
        let still = self.row == 0 || moving.bodies[self.row].inverse_sqrt_mass == 0.0;
        if still { self.spin } else { self.spin + self.part(moving, 0).1 }
    }

    /// What impulses changed, in the world: velocities at `part` 0, displacements at [`Sizes::VELOCITY`].
    fn part(&self, moving: &Moving<'_, N>, part: usize) -> (Vector<N>, Bivector<N>) {
        let body: &SolverBody<N> = &moving.bodies[self.row];
        let at = self.row * Sizes::<N>::STATE + part;
        let state = &moving.state[at..at + Sizes::<N>::VELOCITY];
        let linear = Vector::from_fn(|i| f64::from(state[i]) * body.inverse_sqrt_mass);
        (linear, body.unscaled_velocity(&state[N..]))
    }
}

/// The rotation by a rotation vector: up to a quarter of a radian by the series to sixth order, whose remainder is θ⁷/5040,
/// 1e-8, and does not add up, since every step starts from the exact attitude.
fn turn<const N: usize>(turned: &Bivector<N>) -> Matrix<N> {
    let size_sq = turned.norm_sq();
    if size_sq > 0.0625 {
        return *Rotation::exp(turned).matrix();
    }
    let velocity = turned.to_matrix().transpose();
    let terms = if size_sq > 1e-4 { 6 } else { 4 };
    let mut sum = Matrix::IDENTITY;
    for term in (1..=terms).rev() {
        sum = Matrix::IDENTITY + (velocity * sum) * (1.0 / f64::from(term));
    }
    sum
}

/// The rate at which free rotation changes an angular velocity, asked of gyros.
impl<const N: usize> Gyro<N> {
    /// d/dt of the angular velocity `spin` at constant angular momentum, world frame, rad/s².
    pub(crate) fn precession_of(&self, spin: &Bivector<N>) -> Bivector<N> {
        let moments = self.moments();
        let local = self.world_from_principal.inverse_rotate_bivector(spin);
        let momentum = local.scale_planes(|i, j| moments[i] + moments[j]);
        let rate = local.commutator(&momentum).scale_planes(|i, j| 1.0 / (moments[i] + moments[j]));
        self.world_from_principal.rotate_bivector(&rate)
    }
}

//! Free rotation of anisotropic bodies within the step.
//!
//! Their angular velocity changes without any torque. At each substep the world-frame momentum, which the rows know
//! through impulses, turns the attitude by the momentum-keeping splitting of `free_top`, and the change of angular
//! velocity that comes of it is put into the solver's state beside the impulses.
//!
//! A body that turns by less than [`SLOW`] in the step, like all that rests, does so once, at the end: what its angular
//! velocity would have changed by within the step is less than that share of it. Joints ask for attitudes within the step, so
//! jointed bodies always go by substeps.

use hyperbody_math::{Bivector, Rotation, Vector, planes};

use super::bodies::{MAX_PLANES, Sizes, SolverBody};
use super::lanes::Real;
use crate::body::Body;
use crate::free_top::free_rotation_step;

/// Turn within a step, at the speed it starts with, up to which a body is turned once, rad.
const SLOW: f64 = 0.01;

/// An anisotropic body during one step.
#[derive(Clone, Debug)]
pub(crate) struct Gyro<const N: usize> {
    /// Row of the solver's bodies.
    pub(crate) body: usize,
    /// World from principal frame, now.
    pub(crate) world_from_principal: Rotation<N>,
    /// J_i, kg·m².
    moments: Vector<N>,
    /// At the start of the step, world frame.
    momentum_at_start: Bivector<N>,
    torque: Bivector<N>,
    /// The part of the scaled change of angular velocity that no impulse made.
    precession: [Real; MAX_PLANES],
    /// Whether it turns once, at the end of the step.
    once: bool,
}

impl<const N: usize> Gyro<N> {
    pub(crate) fn new(
        row: usize,
        world_from_principal: Rotation<N>,
        mut moments: Vector<N>,
        body: &Body<N>,
        added_moment: f64,
        dt: f64,
    ) -> Self {
        let mut momentum_at_start = body.angular_momentum;
        if added_moment > 0.0 {
            // A plane's moment is the sum of its axes'.
            moments = Vector::from_fn(|i| moments[i] + 0.5 * added_moment);
            momentum_at_start += body.angular_velocity * added_moment;
        }
        Self {
            body: row,
            world_from_principal,
            moments,
            momentum_at_start,
            torque: body.torque,
            precession: [0.0; MAX_PLANES],
            once: body.angular_velocity.norm() * dt <= SLOW,
        }
    }

    /// Turns with every substep, however slowly.
    pub(crate) fn keep_up(&mut self) {
        self.once = false;
    }

    /// World from principal frame at the end of a step of `dt` seconds. `displacement` is what impulses have turned the body
    /// by, scaled as in the solver's state.
    pub(crate) fn at_end(&self, body: &SolverBody<N>, displacement: &[Real], dt: f64) -> Rotation<N> {
        if !self.once {
            return self.world_from_principal;
        }
        let mut free = self.world_from_principal;
        free_rotation_step(&mut free, &(self.momentum_at_start + self.torque * (0.5 * dt)), &self.moments, dt);
        Rotation::exp(&body.unscaled_velocity(displacement)) * free
    }

    /// Angular momentum of the body with its own inertia, world frame, at the end of the step.
    pub(crate) fn own_momentum(&self, body: &SolverBody<N>, state: &[Real], elapsed: f64) -> Bivector<N> {
        let momentum = self.momentum(body, state, elapsed);
        if body.added_moment == 0.0 {
            return momentum;
        }
        let local = self.world_from_principal.inverse_rotate_bivector(&momentum);
        let own = local.scale_planes(|i, j| {
            let whole = self.moments[i] + self.moments[j];
            (whole - body.added_moment) / whole
        });
        self.world_from_principal.rotate_bivector(&own)
    }

    /// J_i, kg·m².
    pub(crate) fn moments(&self) -> &Vector<N> {
        &self.moments
    }

    /// Angular momentum now with all inertia, world frame: that at the start, the torque's share, and the impulses'.
    pub(crate) fn momentum(&self, body: &SolverBody<N>, state: &[Real], elapsed: f64) -> Bivector<N> {
        let row = self.body * Sizes::<N>::STATE + N;
        let mut impulses = [0.0; MAX_PLANES];
        for k in 0..Sizes::<N>::K {
            impulses[k] = state[row + k] - self.precession[k];
        }
        self.momentum_at_start + self.torque * elapsed + body.momentum_of(&impulses[..Sizes::<N>::K])
    }

    /// Turns the attitude through one substep of length `h`; `elapsed` is the time of the step at its end.
    pub(crate) fn turn(&mut self, body: &SolverBody<N>, state: &mut [Real], h: f64, elapsed: f64) {
        if self.once {
            return;
        }
        let momentum = self.momentum(body, state, elapsed);
        free_rotation_step(&mut self.world_from_principal, &momentum, &self.moments, h);
        let local = self.world_from_principal.inverse_rotate_bivector(&momentum);
        let local_velocity = local.scale_planes(|i, j| 1.0 / (self.moments[i] + self.moments[j]));
        let velocity = self.world_from_principal.rotate_bivector(&local_velocity);
        let wanted = body.scaled_velocity(&(velocity - body.angular_velocity - body.angular_acceleration * elapsed));
        let row = self.body * Sizes::<N>::STATE + N;
        for k in 0..planes::count(N) {
            // Impulses are what is not precession: exactly zero as long as nothing touches the body.
            let impulse = state[row + k] - self.precession[k];
            self.precession[k] = wanted[k] - impulse;
            state[row + k] = self.precession[k] + impulse;
        }
    }
}

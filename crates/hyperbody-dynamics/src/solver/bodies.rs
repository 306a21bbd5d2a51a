//! The bodies of one step as the solver sees them.
//!
//! Each body's velocity is split: a base part in double precision, which is known in advance (the velocity at the start
//! of the step, growing by constant accelerations), and the change that impulses make, in the solver's precision. Rows
//! carry the base part as two numbers each, and work on the change alone.
//!
//! The change is kept scaled by the square root of the mass, linear part in world axes, angular part in the body's
//! solver frame: the principal frame at the start of the step (the world's axes for isotropic bodies). There, the
//! inverse mass matrix is the identity: one vector a row serves both to measure a velocity and to apply an impulse,
//! and bodies that no impulse moves are rows of zeros.

use std::ops::{Deref, DerefMut};

use hyperbody_math::{Bivector, Rotation, Vector, planes};

use super::lanes::{Real, WIDTH};
use crate::body::Body;

/// Most planes of any dimension: 15 in 6D.
pub(crate) const MAX_PLANES: usize = planes::count(6);

/// [`Sizes::STATE`] of 6D.
pub(crate) const MAX_STATE: usize = Sizes::<6>::STATE;

/// Sizes that follow from the dimension.
pub(crate) struct Sizes<const N: usize>;

impl<const N: usize> Sizes<N> {
    /// Planes.
    pub(crate) const K: usize = planes::count(N);
    /// Numbers of a velocity: linear, then angular.
    pub(crate) const VELOCITY: usize = N + Self::K;
    /// Numbers of a body: change of velocity, then displacement by it, then nothing up to a whole vector.
    pub(crate) const STATE: usize = (2 * Self::VELOCITY).next_multiple_of(WIDTH);
}

/// A number a plane, in lexicographic order. A length of N(N−1)/2 can't be said in the type; 3N is enough up to 7D.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaneNumbers<const N: usize, T = f64>([[T; N]; 3]);

impl<const N: usize, T: Copy> PlaneNumbers<N, T> {
    #[inline(always)]
    pub(crate) const fn splat(value: T) -> Self {
        Self([[value; N]; 3])
    }
}

impl<const N: usize, T> Deref for PlaneNumbers<N, T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        &self.0.as_flattened()[..Sizes::<N>::K]
    }
}

impl<const N: usize, T> DerefMut for PlaneNumbers<N, T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.0.as_flattened_mut()[..Sizes::<N>::K]
    }
}

/// Mass, frame and base motion of a body during one step: first what contacts of balls ask for, then what others do, then what
/// few bodies have.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct SolverBody<const N: usize> {
    /// 1/√m; zero for bodies that no impulse moves.
    pub(crate) inverse_sqrt_mass: f64,
    /// Slot in the world.
    pub(crate) slot: u32,
    /// See [`Body::is_ball`].
    pub(crate) is_ball: bool,
    /// Whether there is an angular acceleration.
    pub(crate) spins_up: bool,
    /// Whether its surface runs.
    pub(crate) runs: bool,
    pub(crate) centre: Vector<N>,
    /// Base motion: velocity at time t of the step = velocity + t · acceleration.
    pub(crate) velocity: Vector<N>,
    pub(crate) acceleration: Vector<N>,
    pub(crate) angular_velocity: Bivector<N>,
    /// 1/√I of the planes of the solver frame; zero for bodies that no impulse moves.
    pub(crate) inverse_sqrt_moments: PlaneNumbers<N>,
    /// World from solver frame; `None` where that is the identity.
    pub(crate) frame: Option<Rotation<N>>,

    /// How the surface runs along the body, world axes, m/s: friction is against it.
    pub(crate) surface: Vector<N>,
    /// What the moments have beside those of the body, kg·m²; see `joints/tension.rs`.
    pub(crate) added_moment: f64,
    pub(crate) angular_acceleration: Bivector<N>,
}

impl<const N: usize> SolverBody<N> {
    /// Whatever rests and is not moved by impulses; where it is does not matter.
    pub(crate) const RESTING: Self = Self {
        inverse_sqrt_mass: 0.0,
        slot: u32::MAX,
        is_ball: false,
        spins_up: false,
        runs: false,
        centre: Vector::ZERO,
        velocity: Vector::ZERO,
        acceleration: Vector::ZERO,
        angular_velocity: Bivector::ZERO,
        inverse_sqrt_moments: PlaneNumbers::splat(0.0),
        frame: None,
        surface: Vector::ZERO,
        added_moment: 0.0,
        angular_acceleration: Bivector::ZERO,
    };

    /// A body at rest at the origin with moments of 1 kg·m², for tests.
    #[cfg(test)]
    pub(crate) fn with_unit_moments(inverse_sqrt_mass: f64) -> Self {
        Self { slot: 0, inverse_sqrt_mass, inverse_sqrt_moments: PlaneNumbers::splat(1.0), ..Self::RESTING }
    }

    /// A body that no impulse moves.
    pub(crate) fn immovable(body: &Body<N>) -> Self {
        let surface = body.surface_in_world();
        Self {
            runs: surface != Vector::ZERO,
            centre: body.centre,
            velocity: body.velocity,
            angular_velocity: body.angular_velocity,
            surface,
            ..Self::RESTING
        }
    }

    /// A dynamic body under gravity and its own forces.
    pub(crate) fn dynamic(slot: u32, body: &Body<N>, gravity: Vector<N>, added_moment: f64) -> Self {
        let inverse_sqrt = |moment: f64| 1.0 / (moment + added_moment).sqrt();
        let mut inverse_sqrt_moments = PlaneNumbers::splat(0.0);
        match body.inertia.isotropic {
            Some(moment) => inverse_sqrt_moments.fill(inverse_sqrt(moment)),
            None => {
                for (k, (i, j)) in planes::all(N).enumerate() {
                    inverse_sqrt_moments[k] = inverse_sqrt(body.inertia.plane_moment(i, j));
                }
            }
        }
        let frame = body.inertia.isotropic.is_none().then(|| body.rotation * body.inertia.body_from_principal);
        let spins_up = body.torque != Bivector::ZERO;
        let angular_acceleration =
            if spins_up { body.inertia.velocity(&body.rotation, &body.torque) } else { Bivector::ZERO };
        let surface = body.surface_in_world();
        Self {
            slot,
            inverse_sqrt_mass: body.inverse_mass.sqrt(),
            frame,
            inverse_sqrt_moments,
            added_moment,
            is_ball: body.is_ball,
            spins_up,
            runs: surface != Vector::ZERO,
            centre: body.centre,
            velocity: body.velocity,
            angular_velocity: body.angular_velocity,
            acceleration: gravity * body.gravity_scale + body.force * body.inverse_mass,
            angular_acceleration,
            surface,
        }
    }

    /// A vector of the world in the solver frame.
    #[inline]
    pub(crate) fn in_solver_frame(&self, v: Vector<N>) -> Vector<N> {
        match &self.frame {
            Some(frame) => frame.inverse_rotate(v),
            None => v,
        }
    }

    /// The scaled arm of direction `d` at offset `r`, both in the world: (r ∧ d) in the solver frame over √I.
    #[inline]
    pub(crate) fn arm(&self, r: Vector<N>, d: Vector<N>) -> [f64; MAX_PLANES] {
        let (r, d) = (self.in_solver_frame(r), self.in_solver_frame(d));
        let mut arm = [0.0; MAX_PLANES];
        let mut k = 0;
        for i in 0..N {
            for j in i + 1..N {
                arm[k] = (r.0[i] * d.0[j] - r.0[j] * d.0[i]) * self.inverse_sqrt_moments[k];
                k += 1;
            }
        }
        arm
    }

    /// The scaled arm of a turn in the plane `b`, of the world: b in the solver frame over √I.
    #[inline]
    pub(crate) fn lever(&self, b: &Bivector<N>) -> [f64; MAX_PLANES] {
        let local = match &self.frame {
            Some(frame) => frame.inverse_rotate_bivector(b),
            None => *b,
        };
        let mut arm = [0.0; MAX_PLANES];
        for (k, value) in local.planes().enumerate() {
            arm[k] = value * self.inverse_sqrt_moments[k];
        }
        arm
    }

    /// Adds `share` times an angular impulse, by the planes of the world, to the scaled angular velocity `spin`.
    pub(crate) fn add_spin(&self, spin: &mut [Real], impulse: &[f64; MAX_PLANES], share: f64) {
        let turned = self.frame.is_some().then(|| {
            let mut planes = impulse.iter();
            self.lever(&Bivector::from_fn(|_, _| planes.next().copied().unwrap_or(0.0)))
        });
        for (k, (value, scale)) in spin.iter_mut().zip(&*self.inverse_sqrt_moments).enumerate() {
            let change = turned.map_or_else(|| impulse[k] * scale, |turned| turned[k]);
            *value += (change * share) as Real;
        }
    }

    /// [`SolverBody::add_spin`] for a ball, whose moments are all the same: asks for the first of them and for nothing else.
    pub(crate) fn add_spin_of_ball(&self, spin: &mut [Real], impulse: &[f64; MAX_PLANES], share: f64) {
        let scale = self.inverse_sqrt_moments[0];
        for (value, impulse) in spin.iter_mut().zip(&impulse[..Sizes::<N>::K]) {
            *value += (impulse * scale * share) as Real;
        }
    }

    /// A bivector of the solver frame, scaled by 1/√I (velocities, displacements), in the world.
    #[inline(always)]
    pub(crate) fn unscaled_velocity(&self, scaled: &[Real]) -> Bivector<N> {
        self.in_world(scaled, |scale| scale)
    }

    /// The angular momentum of a scaled angular velocity, in the world: √I times it.
    pub(crate) fn momentum_of(&self, scaled: &[Real]) -> Bivector<N> {
        self.in_world(scaled, |scale| 1.0 / scale)
    }

    /// The share of [`SolverBody::momentum_of`] that the body's own inertia has.
    #[inline(always)]
    pub(crate) fn own_momentum_of(&self, scaled: &[Real]) -> Bivector<N> {
        self.in_world(scaled, |scale| 1.0 / scale - self.added_moment * scale)
    }

    /// Numbers of planes of the solver frame, times what `factor` makes of 1/√I, in the world.
    #[inline(always)]
    fn in_world(&self, scaled: &[Real], factor: impl Fn(f64) -> f64) -> Bivector<N> {
        let in_frame = || {
            let mut planes = scaled.iter().zip(&*self.inverse_sqrt_moments);
            Bivector::from_fn(|_, _| planes.next().map_or(0.0, |(&number, &scale)| f64::from(number) * factor(scale)))
        };
        match &self.frame {
            Some(frame) => frame.rotate_bivector(&in_frame()),
            None => in_frame(),
        }
    }

    /// The inverse of [`SolverBody::unscaled_velocity`].
    pub(crate) fn scaled_velocity(&self, in_world: &Bivector<N>) -> [Real; MAX_PLANES] {
        let local = match &self.frame {
            Some(frame) => frame.inverse_rotate_bivector(in_world),
            None => *in_world,
        };
        let mut scaled = [0.0; MAX_PLANES];
        for (k, value) in local.planes().enumerate() {
            scaled[k] = (value / self.inverse_sqrt_moments[k]) as Real;
        }
        scaled
    }
}

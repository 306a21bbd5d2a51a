//! Closed forms of the free rotation, where they exist: steady spins, block-symmetric bodies, spins within three axes.
//!
//! Block-symmetric bodies have J = (A, …, A, B, …, B) up to the order of the axes: symmetric tops in 3D, and in 4D the
//! duocylinder and the capped ball alike. With r = (A − B)/(A + B), the spin at the start Ω₀ = [[S, X], [−Xᵀ, T]] and
//! D = diag(S, −T), the spin precesses as Ω(t) = e^{rtD} Ω₀ e^{−rtD} and the attitude is
//! **R(t) = R(0) e^{t(Ω₀ + rD)} e^{−rtD}**: in every dimension two turns at constant rate, one inside the other.
//!
//! Three axes are solved by Jacobi's functions, see [`three_axes`](super::three_axes). A general body in 4D needs
//! functions of two variables and is not here.

use hyperbody_math::{Bivector, Rotation};

use super::error::{FreeTopError, FreeTopErrorKind, Result, rounded};
use super::state::TopState;
use super::three_axes::ThreeAxesMotion;
use super::top::FreeTop;

/// Relative difference up to which two moments count as equal.
const EQUAL_MOMENTS: f64 = 1e-13;

/// Relative size of dM/dt that rounding explains.
const STEADY: f64 = 8.0 * f64::EPSILON;

/// The closed form of a motion.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum ExactMotion<const N: usize> {
    /// The spin is constant in the body and in the world: R(t) = R(0) e^{tΩ}.
    Steady(SteadyMotion<N>),
    /// The body has at most two different moments.
    Blocks(BlockMotion<N>),
    /// The spin lies in the planes of three axes.
    ThreeAxes(ThreeAxesMotion<N>),
}

impl<const N: usize> ExactMotion<N> {
    /// The closed form of the motion that starts at `start`.
    ///
    /// # Errors
    /// If there is none: the body has three or more different moments and the spin reaches beyond the planes of three
    /// axes.
    pub fn new(top: &FreeTop<N>, start: &TopState<N>) -> Result<Self> {
        if let Some(steady) = SteadyMotion::new(top, start) {
            return Ok(Self::Steady(steady));
        }
        if let Some(blocks) = BlockMotion::new(top, start) {
            return Ok(Self::Blocks(blocks));
        }
        if let Some(three_axes) = ThreeAxesMotion::new(top, start) {
            return Ok(Self::ThreeAxes(three_axes));
        }
        Err(FreeTopError::new(
            FreeTopErrorKind::NoClosedForm,
            format!(
                "no closed form is known here for the moments {} with this spin: it takes at most two different \
                 moments, a spin within three axes, or a steady spin; use splitting6",
                top.principal_moments().iter().map(rounded).collect::<Vec<_>>().join(", ")
            ),
        ))
    }

    /// The state `t` seconds after the start, or before it for negative `t`.
    #[must_use]
    pub fn state_at(&self, t: f64) -> TopState<N> {
        match self {
            Self::Steady(motion) => motion.state_at(t),
            Self::Blocks(motion) => motion.state_at(t),
            Self::ThreeAxes(motion) => motion.state_at(t),
        }
    }

    /// Period of the momentum in the body frame in seconds, where it has one that is known: from Jacobi's functions.
    /// Infinite on the separatrix.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        match self {
            Self::ThreeAxes(motion) => Some(motion.period()),
            Self::Steady(_) | Self::Blocks(_) => None,
        }
    }
}

/// A spin that Euler's equation leaves constant.
#[derive(Clone, Copy, Debug)]
pub struct SteadyMotion<const N: usize> {
    start: TopState<N>,
    spin: Bivector<N>,
}

impl<const N: usize> SteadyMotion<N> {
    /// The steady motion from `start`, or `None` if the spin changes.
    #[must_use]
    pub fn new(top: &FreeTop<N>, start: &TopState<N>) -> Option<Self> {
        let spin = start.spin_in_body(top);
        let scale = start.momentum_in_body.norm() * spin.norm();
        (top.momentum_rate(&start.momentum_in_body).norm() <= STEADY * scale).then_some(Self { start: *start, spin })
    }

    /// The state after `t` seconds.
    #[must_use]
    pub fn state_at(&self, t: f64) -> TopState<N> {
        TopState { world_from_body: self.start.world_from_body * Rotation::exp(&(self.spin * t)), ..self.start }
    }
}

/// The motion of a body with at most two different moments.
#[derive(Clone, Copy, Debug)]
pub struct BlockMotion<const N: usize> {
    start: TopState<N>,
    /// Ω₀ + rD as a bivector.
    outer_spin: Bivector<N>,
    /// rD as a bivector.
    inner_spin: Bivector<N>,
}

impl<const N: usize> BlockMotion<N> {
    /// The motion from `start`, or `None` if the body has more than two different moments (to 13 digits).
    #[must_use]
    pub fn new(top: &FreeTop<N>, start: &TopState<N>) -> Option<Self> {
        let moments = top.principal_moments();
        let largest = moments.max_abs();
        let equal = |a: f64, b: f64| (a - b).abs() <= EQUAL_MOMENTS * largest;
        let first = moments[0];
        let second = moments.iter().find(|&m| !equal(m, first)).unwrap_or(first);
        if !moments.iter().all(|m| equal(m, first) || equal(m, second)) {
            return None;
        }
        let spin = start.spin_in_body(top);
        let asymmetry = (first - second) / (first + second);
        let inner_spin = spin.scale_planes(|i, j| match (equal(moments[i], first), equal(moments[j], first)) {
            (true, true) => asymmetry,
            (false, false) => -asymmetry,
            _ => 0.0,
        });
        Some(Self { start: *start, outer_spin: spin + inner_spin, inner_spin })
    }

    /// The state after `t` seconds.
    #[must_use]
    pub fn state_at(&self, t: f64) -> TopState<N> {
        let inner = Rotation::exp(&(self.inner_spin * t));
        TopState {
            world_from_body: self.start.world_from_body * Rotation::exp(&(self.outer_spin * t)) * inner.inverse(),
            momentum_in_body: inner.rotate_bivector(&self.start.momentum_in_body),
        }
    }
}

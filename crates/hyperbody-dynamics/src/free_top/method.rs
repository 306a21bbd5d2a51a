//! The ways to follow a free body, by name.

use super::engine_steps::{explicit_step, gyroscopic_step};
use super::error::{FreeTopError, FreeTopErrorKind, Result};
use super::midpoint::midpoint_step;
use super::splitting::{ORDER_2, ORDER_4, ORDER_6, splitting_step};
use super::state::TopState;
use super::top::FreeTop;

/// A way to follow a free body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Method {
    /// Plane splitting of second order: what the world uses.
    Splitting2,
    /// Plane splitting of fourth order, five stages.
    Splitting4,
    /// Plane splitting of sixth order, thirteen stages.
    Splitting6,
    /// Implicit midpoint rule on rotations: second order, keeps every integral, of any degree.
    Midpoint,
    /// The implicit gyroscopic step of engines, one Newton iteration; first order, for comparison.
    Gyroscopic,
    /// Explicit Euler; first order, for comparison.
    Explicit,
    /// The closed form, where there is one.
    Exact,
}

impl Method {
    /// All methods, best known first.
    pub const ALL: [Self; 7] = [
        Self::Splitting2,
        Self::Splitting4,
        Self::Splitting6,
        Self::Midpoint,
        Self::Gyroscopic,
        Self::Explicit,
        Self::Exact,
    ];

    /// The name that [`Method::from_name`] knows.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Splitting2 => "splitting2",
            Self::Splitting4 => "splitting4",
            Self::Splitting6 => "splitting6",
            Self::Midpoint => "midpoint",
            Self::Gyroscopic => "gyroscopic",
            Self::Explicit => "explicit",
            Self::Exact => "exact",
        }
    }

    /// The method of that name.
    ///
    /// # Errors
    /// If there is none; the message lists the names.
    pub fn from_name(name: &str) -> Result<Self> {
        Self::ALL.into_iter().find(|method| method.name() == name).ok_or_else(|| {
            FreeTopError::new(
                FreeTopErrorKind::Method,
                format!("there is no method \"{name}\"; the methods are {}", Self::ALL.map(Self::name).join(", ")),
            )
        })
    }

    /// Order of convergence; `None` for the closed form, which has no step.
    #[must_use]
    pub const fn order(self) -> Option<u32> {
        match self {
            Self::Splitting2 | Self::Midpoint => Some(2),
            Self::Splitting4 => Some(4),
            Self::Splitting6 => Some(6),
            Self::Gyroscopic | Self::Explicit => Some(1),
            Self::Exact => None,
        }
    }

    /// One step of `dt` seconds; [`Method::Exact`] solves anew from `state`.
    ///
    /// # Errors
    /// If the midpoint equation has no solution within reach, or if there is no closed form.
    pub fn step<const N: usize>(self, top: &FreeTop<N>, state: &mut TopState<N>, dt: f64) -> Result<()> {
        match self {
            Self::Splitting2 => splitting_step(top, state, &ORDER_2, dt),
            Self::Splitting4 => splitting_step(top, state, &ORDER_4, dt),
            Self::Splitting6 => splitting_step(top, state, &ORDER_6, dt),
            Self::Midpoint => midpoint_step(top, state, dt)?,
            Self::Gyroscopic => gyroscopic_step(top, state, dt),
            Self::Explicit => explicit_step(top, state, dt),
            Self::Exact => *state = super::exact::ExactMotion::new(top, state)?.state_at(dt),
        }
        Ok(())
    }
}

//! A run of a free body, recorded: spins, conserved quantities, drift, flips.

use hyperbody_math::Bivector;

use super::error::{FreeTopError, FreeTopErrorKind, Result, shown};
use super::exact::ExactMotion;
use super::flips::{FlipDetector, Flips};
use super::invariants::{Drift, DriftMeter, Invariants};
use super::method::Method;
use super::state::TopState;
use super::top::FreeTop;

/// Most steps and most recorded samples of one run: an hour of computing, and a gigabyte.
pub const MAX_STEPS: u64 = 10_000_000_000;
/// See [`MAX_STEPS`].
pub const MAX_SAMPLES: u64 = 2_000_000;

/// Halvings of a step that error control may ask for: a step a million times shorter.
const MAX_HALVINGS: u32 = 20;

/// What to compute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunPlan {
    /// The method.
    pub method: Method,
    /// Duration in seconds, > 0.
    pub seconds: f64,
    /// Step in seconds, > 0; shortened so that a whole number of steps fills the duration.
    pub dt: f64,
    /// Steps from one recorded sample to the next, ≥ 1. Drift and flips take every step into account.
    pub record_every: u64,
    /// Error control on request: each step of `dt` is halved until halving once more changes attitude and (relative)
    /// momentum by no more than this.
    pub tolerance: Option<f64>,
}

impl RunPlan {
    /// The plan with the given method, duration and step in seconds, at most a thousand samples or so, and no error
    /// control.
    ///
    /// # Errors
    /// If duration or step is not finite and positive, or the steps are too many.
    pub fn new(method: Method, seconds: f64, dt: f64) -> Result<Self> {
        let mut plan = Self { method, seconds, dt, record_every: 1, tolerance: None };
        plan.record_every = (plan.steps()? / 1000).max(1);
        Ok(plan)
    }

    /// Number of steps.
    ///
    /// # Errors
    /// As [`RunPlan::new`].
    pub fn steps(&self) -> Result<u64> {
        for (what, value) in [("duration", self.seconds), ("step", self.dt)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(bad_span(format!("the {what} is {} s; it must be finite and positive", shown(value))));
            }
        }
        // A duration that is a whole number of steps up to rounding takes that number.
        let steps = (self.seconds / self.dt * (1.0 - 1e-12)).ceil().max(1.0);
        if steps > MAX_STEPS as f64 {
            return Err(bad_span(format!(
                "{} s in steps of {} s are {steps:.1e} steps; at most {MAX_STEPS} are followed",
                shown(self.seconds),
                shown(self.dt)
            )));
        }
        Ok(steps as u64)
    }

    fn check(&self) -> Result<u64> {
        let steps = self.steps()?;
        if self.record_every == 0 || steps / self.record_every > MAX_SAMPLES {
            return Err(bad_span(format!(
                "recording every {} of {steps} steps; give a number from 1 on that leaves at most {MAX_SAMPLES} samples",
                self.record_every
            )));
        }
        match self.tolerance {
            Some(tolerance) if !(tolerance > 0.0 && tolerance.is_finite()) => {
                Err(bad_span(format!("the tolerance is {}; it must be finite and positive", shown(tolerance))))
            }
            _ => Ok(steps),
        }
    }
}

/// A recorded run. All series have one entry for each time.
#[derive(Clone, Debug)]
pub struct TopRun<const N: usize> {
    /// In seconds, from zero.
    pub times: Vec<f64>,
    /// Attitude and momentum.
    pub states: Vec<TopState<N>>,
    /// Spin in the body frame, in rad/s.
    pub spins: Vec<Bivector<N>>,
    /// Conserved quantities.
    pub invariants: Vec<Invariants<N>>,
    /// Largest deviations from the start over all steps.
    pub drift: Drift,
    /// Sign changes of the plane that holds most of the momentum at the start.
    pub flips: Flips,
    /// The step in seconds that filled the duration.
    pub dt: f64,
    /// Steps of `dt` taken.
    pub steps: u64,
    /// Most parts that error control divided a step into; one without.
    pub most_parts: u64,
}

impl<const N: usize> TopRun<N> {
    /// The last state.
    #[must_use]
    pub fn final_state(&self) -> &TopState<N> {
        // The start is always recorded.
        &self.states[self.states.len() - 1]
    }
}

/// Follows the body from `start`. `progress(done, steps)` is called now and then.
///
/// # Errors
/// If the plan is empty or too long, the midpoint equation cannot be solved, the method has no closed form, or error
/// control does not reach its tolerance.
pub fn run<const N: usize>(
    top: &FreeTop<N>,
    start: &TopState<N>,
    plan: &RunPlan,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<TopRun<N>> {
    let steps = plan.check()?;
    let dt = plan.seconds / steps as f64;
    let exact = if plan.method == Method::Exact { Some(ExactMotion::new(top, start)?) } else { None };
    let mut control = ErrorControl { halvings: 0, most_halvings: 0 };
    let mut state = *start;
    let mut meter = DriftMeter::new(top, start);
    let mut detector = FlipDetector::for_main_plane(&start.momentum_in_body);
    detector.observe(top, 0.0, &start.momentum_in_body);
    let mut record = Record::default();
    record.push(top, 0.0, start, Invariants::of(top, start));
    for step in 1..=steps {
        // The time is a product, not a sum: it does not drift.
        let time = step as f64 * dt;
        match (&exact, plan.tolerance) {
            (Some(exact), _) => state = exact.state_at(time),
            (None, Some(tolerance)) => control.advance(top, &mut state, plan.method, dt, tolerance)?,
            (None, None) => plan.method.step(top, &mut state, dt)?,
        }
        let invariants = Invariants::of(top, &state);
        meter.observe(&invariants);
        detector.observe(top, time, &state.momentum_in_body);
        if step % plan.record_every == 0 || step == steps {
            record.push(top, time, &state, invariants);
        }
        // Under error control a single step may take a second.
        if plan.tolerance.is_some() || step % 4096 == 0 || step == steps {
            progress(step, steps);
        }
    }
    Ok(TopRun {
        times: record.times,
        states: record.states,
        spins: record.spins,
        invariants: record.invariants,
        drift: meter.drift(),
        flips: detector.flips(),
        dt,
        steps,
        most_parts: 1 << control.most_halvings,
    })
}

#[derive(Default)]
struct Record<const N: usize> {
    times: Vec<f64>,
    states: Vec<TopState<N>>,
    spins: Vec<Bivector<N>>,
    invariants: Vec<Invariants<N>>,
}

impl<const N: usize> Record<N> {
    fn push(&mut self, top: &FreeTop<N>, time: f64, state: &TopState<N>, invariants: Invariants<N>) {
        self.times.push(time);
        self.states.push(*state);
        self.spins.push(state.spin_in_body(top));
        self.invariants.push(invariants);
    }
}

/// Halves steps until one more halving changes nothing that counts.
struct ErrorControl {
    halvings: u32,
    most_halvings: u32,
}

impl ErrorControl {
    fn advance<const N: usize>(
        &mut self,
        top: &FreeTop<N>,
        state: &mut TopState<N>,
        method: Method,
        dt: f64,
        tolerance: f64,
    ) -> Result<()> {
        // One halving less than last time is tried first, so that the parts grow again where the motion is easy.
        let first = self.halvings.saturating_sub(1);
        let mut coarse = divided_step(top, state, method, dt, first);
        let mut error = f64::INFINITY;
        for halvings in first + 1..=MAX_HALVINGS {
            let fine = divided_step(top, state, method, dt, halvings);
            // A step that is too long for the midpoint equation counts as inaccurate; in the end it is an error.
            if let (Ok(coarse), Ok(fine)) = (&coarse, &fine) {
                error = coarse.distance(fine);
                if error <= tolerance {
                    *state = *fine;
                    self.halvings = halvings - 1;
                    self.most_halvings = self.most_halvings.max(halvings);
                    return Ok(());
                }
            }
            coarse = fine;
        }
        coarse?;
        Err(FreeTopError::new(
            FreeTopErrorKind::Tolerance,
            format!(
                "after {MAX_HALVINGS} halvings a step of {dt:.3e} s still changes by {error:.1e}, more than the tolerance \
                 {tolerance:.1e}: rounding does not allow less; raise the tolerance or take a method of higher order"
            ),
        ))
    }
}

fn divided_step<const N: usize>(
    top: &FreeTop<N>,
    state: &TopState<N>,
    method: Method,
    dt: f64,
    halvings: u32,
) -> Result<TopState<N>> {
    let parts = 1_u64 << halvings;
    let mut state = *state;
    for _ in 0..parts {
        method.step(top, &mut state, dt / parts as f64)?;
    }
    Ok(state)
}

pub(crate) fn bad_span(message: String) -> FreeTopError {
    FreeTopError::new(FreeTopErrorKind::Span, message)
}

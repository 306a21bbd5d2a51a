//! Growth rates of disturbances, measured: what the verdicts of [`stability`](mod@super::stability) are checked against.
//!
//! Two ways that share nothing with the eigenvalue formulas. *Linearised*: the derivative of one step of the fourth-order
//! splitting at the steady rotation, flow by flow, is a matrix A; squaring it twenty times over follows a disturbance
//! through a million steps, and log‖A^(2^m)‖ grows at the measured rate. *Perturbed*: two bodies, one disturbed by a part
//! in 10¹⁰, followed until they differ by a part in 10⁴; `growth_fit` says what is read off.

use hyperbody_math::{Bivector, Givens, Rotation, planes, scalar};

use super::error::Result;
use super::growth_fit::Track;
use super::method::Method;
use super::plane_splitting::for_each_flow;
use super::principal_rotation::PrincipalRotation;
use super::splitting::ORDER_4;
use super::state::TopState;
use super::top::FreeTop;

/// Largest number of planes, at N = 6.
const MAX_PLANES: usize = planes::count(6);

/// Step of the linearised run, as an angle by which the largest momentum would turn the plane of least inertia. Over
/// 20,000 random double rotations in 4D, of up to 2 rad/s, the rate is then off by 1e-7/s in the median and by 6e-5/s at
/// worst, next to thresholds.
const STEP_RAD: f64 = 0.1;

/// Least duration of the linearised run as an angle of the fastest turn: through it a disturbance that grows by 1e-3 of
/// the spin's rate grows by e¹⁰⁰ while bounded ones only wander.
const DURATION_RAD: f64 = 1e5;

/// Most squarings, which bounds the loop for bodies with moments of the most different sizes.
const MAX_SQUARINGS: u32 = 60;

type Square = [[f64; MAX_PLANES]; MAX_PLANES];

/// The growth rate of disturbances of a steady rotation in 1/s, from its linearised run; where nothing grows not exactly
/// zero, but below 1e-4 of the rate of the fastest turn.
#[must_use]
pub fn linearised_growth_rate<const N: usize>(top: &FreeTop<N>, rotation: &PrincipalRotation<N>) -> f64 {
    let fastest = rotation.turns().iter().map(|turn| turn.rate.abs()).fold(0.0, f64::max);
    if fastest == 0.0 {
        return 0.0;
    }
    let spin = rotation.spin();
    let count = planes::count(N);
    let largest_momentum = top.momentum_from_spin(&spin).planes().fold(0.0, |largest: f64, m| largest.max(m.abs()));
    let largest_inverse = top.inverse_inertia().iter().flatten().fold(0.0, |largest: f64, &i| largest.max(i));
    let dt = STEP_RAD / (largest_momentum * largest_inverse);
    let mut power = step_derivative(top, &spin, dt);
    // log of the factor taken out so far, and of the norm before the last squaring, which covered `half_time`.
    let (mut log_factor, mut log_before, mut half_time) = (0.0, 0.0, 0.5 * dt);
    for _ in 0..MAX_SQUARINGS {
        let norm = frobenius(&power, count);
        if norm == 0.0 || !norm.is_finite() {
            return 0.0;
        }
        log_before = log_factor + scalar::ln(norm);
        half_time *= 2.0;
        scale(&mut power, 1.0 / norm, count);
        power = square(&power, count);
        log_factor = 2.0 * log_before;
        if 2.0 * half_time * fastest >= DURATION_RAD {
            break;
        }
    }
    let log_after = log_factor + scalar::ln(frobenius(&power, count));
    (log_after - log_before) / half_time
}

/// Derivative of one step at `spin`: how the momentum components after the step depend on those before.
fn step_derivative<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>, dt: f64) -> Square {
    let mut momentum = top.momentum_from_spin(spin);
    let mut columns: Vec<Bivector<N>> = planes::all(N).map(|(i, j)| Bivector::plane(i, j, 1.0)).collect();
    let inverse_inertia = top.inverse_inertia();
    for_each_flow::<N>(&ORDER_4, dt, &mut |i, j, time| {
        let angle_per_momentum = time * inverse_inertia[i][j];
        let turn = Givens::from_angle(angle_per_momentum * momentum.get(i, j));
        momentum.change_to_turned_frame(i, j, turn);
        for column in &mut columns {
            // A change of M_ij changes the angle, too, and with it everything that the frame turns.
            let extra_angle = angle_per_momentum * column.get(i, j);
            column.change_to_turned_frame(i, j, turn);
            for k in (0..N).filter(|&k| k != i && k != j) {
                column.set(i, k, column.get(i, k) + extra_angle * momentum.get(j, k));
                column.set(j, k, column.get(j, k) - extra_angle * momentum.get(i, k));
            }
        }
    });
    let mut matrix = [[0.0; MAX_PLANES]; MAX_PLANES];
    for (index, column) in columns.iter().enumerate() {
        for (row, value) in column.planes().enumerate() {
            matrix[row][index] = value;
        }
    }
    matrix
}

fn frobenius(matrix: &Square, count: usize) -> f64 {
    let mut sum = 0.0;
    for row in &matrix[..count] {
        for entry in &row[..count] {
            sum += entry * entry;
        }
    }
    sum.sqrt()
}

fn scale(matrix: &mut Square, factor: f64, count: usize) {
    for row in &mut matrix[..count] {
        for entry in &mut row[..count] {
            *entry *= factor;
        }
    }
}

fn square(matrix: &Square, count: usize) -> Square {
    let mut product = [[0.0; MAX_PLANES]; MAX_PLANES];
    for i in 0..count {
        for k in 0..count {
            let factor = matrix[i][k];
            for j in 0..count {
                product[i][j] += factor * matrix[k][j];
            }
        }
    }
    product
}

/// How a disturbed body runs away from an undisturbed one.
#[derive(Clone, Debug, PartialEq)]
pub struct PerturbedRun {
    /// Measured growth rate in 1/s. Where the disturbance did not run away it is what beats and rounding leave, of either
    /// sign, and [`PerturbedRun::growth_bound`] says more.
    pub growth_rate: f64,
    /// Growth in 1/s that the run rules out if the disturbance did not run away: a tenth of it growing faster would have
    /// passed the largest deviation seen. `None` if it ran away or nothing turned.
    pub growth_bound: Option<f64>,
    /// Whether the disturbance grew to 1e-4 of the momentum.
    pub ran_away: bool,
    /// Times in seconds.
    pub times: Vec<f64>,
    /// |M' − M|/|M| at those times.
    pub deviations: Vec<f64>,
}

/// Size of the disturbance of a [`perturbed_run`] at the start, relative to the momentum.
pub const DISTURBANCE: f64 = 1e-10;

/// Sizes between which growth is measured, relative to the momentum: late enough that the fastest mode has outgrown the
/// bounded ones, early enough that the motion is still linear.
const MEASURE_FROM: f64 = 1e-7;
const MEASURE_TO: f64 = 1e-4;

/// Share of the disturbance that a growing mode is taken to have at least, where none was seen.
const GROWING_SHARE: f64 = 0.1;

/// Most points that a [`PerturbedRun`] keeps.
const MAX_POINTS: u64 = 2000;

/// Follows a steady rotation disturbed in every plane by [`DISTURBANCE`] for up to `seconds`, with the sixth-order splitting
/// in steps of a twentieth of a radian.
///
/// # Errors
/// Never in practice: the splitting always succeeds.
pub fn perturbed_run<const N: usize>(
    top: &FreeTop<N>,
    rotation: &PrincipalRotation<N>,
    seconds: f64,
) -> Result<PerturbedRun> {
    let spin = rotation.spin();
    let steady = TopState::from_spin(top, Rotation::IDENTITY, &spin)?;
    let momentum = steady.momentum_in_body;
    let size = momentum.norm();
    let fastest = rotation.turns().iter().map(|turn| turn.rate.abs()).fold(0.0, f64::max);
    let mut run = PerturbedRun {
        growth_rate: 0.0,
        growth_bound: None,
        ran_away: false,
        times: vec![0.0],
        deviations: vec![DISTURBANCE],
    };
    if fastest == 0.0 || seconds.is_nan() || seconds <= 0.0 {
        return Ok(run);
    }
    let steps = ((seconds * fastest / 0.05).ceil().min(1e8)) as u64;
    let dt = seconds / steps as f64;
    let every = steps.div_ceil(MAX_POINTS);
    let mut state = steady;
    state.momentum_in_body += disturbance_direction::<N>() * (DISTURBANCE * size);
    let mut track = Track::default();
    let (mut early, mut late) = (DISTURBANCE, DISTURBANCE);
    for step in 1..=steps {
        Method::Splitting6.step(top, &mut state, dt)?;
        let change = (state.momentum_in_body - momentum) * (1.0 / size);
        let deviation = change.norm();
        if step % every == 0 {
            run.times.push(step as f64 * dt);
            run.deviations.push(deviation);
        }
        if deviation >= MEASURE_FROM || !track.is_empty() {
            track.push(change);
        }
        if deviation >= MEASURE_TO {
            run.growth_rate = track.growth_per_step() / dt;
            run.ran_away = true;
            return Ok(run);
        }
        if 2 * step <= steps {
            early = early.max(deviation);
        } else {
            late = late.max(deviation);
        }
    }
    run.growth_rate = scalar::ln(late / early) / (0.5 * seconds);
    run.growth_bound = Some(scalar::ln(early.max(late) / (GROWING_SHARE * DISTURBANCE)) / seconds);
    Ok(run)
}

/// A fixed direction with about the same weight in every plane and no symmetry, of length one.
fn disturbance_direction<const N: usize>() -> Bivector<N> {
    let mut index = 0.0;
    let direction = Bivector::from_fn(|_, _| {
        index += 1.0;
        1.0 + 0.5 * scalar::sin(index)
    });
    direction * (1.0 / direction.norm())
}

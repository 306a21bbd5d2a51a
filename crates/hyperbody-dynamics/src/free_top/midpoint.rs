//! The implicit midpoint rule on the momentum, with a Cayley turn for the attitude.
//!
//! M' = M + h f(½(M + M')), f(M) Euler's equation. The rule keeps every quadratic integral of f whatever the step: the
//! energy, |M|², the Pfaffian and Manakov's integrals (it is the one-stage Gauss method; G. Cooper, 1987). The attitude
//! follows with the Cayley transform of the midpoint spin, R' = R (1 − ½hA)⁻¹(1 + ½hA), A = Bᵀ: orthogonal, of second
//! order. World-frame momentum is cubic in the state and drifts with h²; the splittings keep it.

use hyperbody_math::{Bivector, Matrix, Rotation, planes};

use super::error::{FreeTopError, FreeTopErrorKind, Result};
use super::state::TopState;
use super::top::FreeTop;

/// Iterations that a step may take. The fixed-point iteration gains a factor of about h|ω|/2 each: sixteen digits in 50
/// iterations up to h|ω| ≈ 1. Newton's method takes over where it stalls, and doubles the digits.
const MAX_FIXED_POINT: usize = 60;
const MAX_NEWTON: usize = 30;

/// Relative size of an update that rounding explains.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Largest number of planes, at N = 6.
const MAX_PLANES: usize = planes::count(6);

/// One step of `dt` seconds.
///
/// # Errors
/// If the implicit equation is not solved in a bounded number of iterations, which takes a step of more than a radian or
/// so: then the state is left as it was.
pub fn midpoint_step<const N: usize>(top: &FreeTop<N>, state: &mut TopState<N>, dt: f64) -> Result<()> {
    let start = state.momentum_in_body;
    let Some(increment) = fixed_point(top, &start, dt).or_else(|| newton(top, &start, dt)) else {
        return Err(FreeTopError::new(
            FreeTopErrorKind::NoConvergence,
            format!(
                "the midpoint equation has no solution within reach: a step of {dt} s at {} rad/s is too long; \
                 keep the product below one",
                state.spin_in_body(top).norm()
            ),
        ));
    };
    let middle = start + increment * 0.5;
    state.momentum_in_body = start + increment;
    state.world_from_body = state.world_from_body * cayley(&(top.spin_from_momentum(&middle) * dt));
    state.world_from_body.reorthonormalize();
    Ok(())
}

/// Iterates the increment M' − M until it no longer changes by more than rounding; `None` if it does not settle.
fn fixed_point<const N: usize>(top: &FreeTop<N>, start: &Bivector<N>, dt: f64) -> Option<Bivector<N>> {
    let tolerance = ROUNDING * start.norm();
    let mut increment = top.momentum_rate(start) * dt;
    let mut last_change = f64::INFINITY;
    for _ in 0..MAX_FIXED_POINT {
        let next = top.momentum_rate(&(*start + increment * 0.5)) * dt;
        let change = (next - increment).norm();
        increment = next;
        // One more pass after the tolerance is met puts the error below rounding.
        if last_change <= tolerance {
            return Some(increment);
        }
        if change.is_nan() || (change > tolerance && change > 0.9 * last_change) {
            return None;
        }
        last_change = change;
    }
    None
}

/// Newton's method on F(X) = X − h f(M + ½X), whose derivative is exact because f is quadratic.
fn newton<const N: usize>(top: &FreeTop<N>, start: &Bivector<N>, dt: f64) -> Option<Bivector<N>> {
    let tolerance = ROUNDING * start.norm();
    let mut increment = Bivector::ZERO;
    let mut last_change = f64::INFINITY;
    for _ in 0..MAX_NEWTON {
        let middle = *start + increment * 0.5;
        let residual = top.momentum_rate(&middle) * dt - increment;
        let correction = solve_newton_system(top, &middle, &residual, 0.5 * dt)?;
        increment += correction;
        let change = correction.norm();
        // Rounding in a long step can keep the last digits moving: stop where they no longer improve.
        if change <= tolerance || (change <= 1e3 * tolerance && change >= last_change) {
            return Some(increment);
        }
        last_change = change;
    }
    None
}

/// Solves (1 − h Df(M)) X = `residual` by elimination with partial pivoting.
pub(crate) fn solve_newton_system<const N: usize>(
    top: &FreeTop<N>,
    momentum: &Bivector<N>,
    residual: &Bivector<N>,
    h: f64,
) -> Option<Bivector<N>> {
    let count = planes::count(N);
    let mut matrix = [[0.0; MAX_PLANES + 1]; MAX_PLANES];
    for (column, (i, j)) in planes::all(N).enumerate() {
        let rate = momentum_rate_derivative(top, momentum, &Bivector::plane(i, j, 1.0));
        for (row, value) in rate.planes().enumerate() {
            matrix[row][column] = f64::from(u8::from(row == column)) - h * value;
        }
    }
    for (row, value) in residual.planes().enumerate() {
        matrix[row][count] = value;
    }
    let solution = eliminate(&mut matrix, count)?;
    Bivector::from_planes(&solution[..count])
}

/// Derivative of Euler's right-hand side at `momentum` in a direction.
pub(crate) fn momentum_rate_derivative<const N: usize>(
    top: &FreeTop<N>,
    momentum: &Bivector<N>,
    direction: &Bivector<N>,
) -> Bivector<N> {
    let spin = top.spin_from_momentum(momentum).to_matrix();
    let change = top.spin_from_momentum(direction).to_matrix();
    let moments = top.principal_moments();
    Bivector::from_fn(|i, j| {
        (moments[i] - moments[j]) * (spin.row(i).dot(change.row(j)) + change.row(i).dot(spin.row(j)))
    })
}

fn eliminate(matrix: &mut [[f64; MAX_PLANES + 1]; MAX_PLANES], count: usize) -> Option<[f64; MAX_PLANES]> {
    for k in 0..count {
        let pivot = (k..count).fold(k, |best, i| if matrix[i][k].abs() > matrix[best][k].abs() { i } else { best });
        matrix.swap(k, pivot);
        for i in k + 1..count {
            let factor = matrix[i][k] / matrix[k][k];
            for j in k..=count {
                matrix[i][j] -= factor * matrix[k][j];
            }
        }
    }
    let mut solution = [0.0; MAX_PLANES];
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count).map(|j| matrix[k][j] * solution[j]).sum();
        solution[k] = (matrix[k][count] - known) / matrix[k][k];
    }
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}

/// (1 − ½A)⁻¹(1 + ½A) with A the matrix that maps r to r·b: a rotation that agrees with exp(b) to second order.
fn cayley<const N: usize>(b: &Bivector<N>) -> Rotation<N> {
    let half = b.to_matrix().transpose() * 0.5;
    // 1 − ½A of an antisymmetric A has singular values of at least one.
    let inverse = (Matrix::IDENTITY - half).try_inverse();
    inverse.and_then(|inverse| Rotation::from_matrix(inverse * (Matrix::IDENTITY + half))).unwrap_or(Rotation::IDENTITY)
}

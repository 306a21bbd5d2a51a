//! The implicit midpoint rule on rotations, in the form that conserves everything.
//!
//! The Lagrangian ½ tr(Ṙ P Ṙᵀ), P = diag(J), at the mean velocity (R' − R)/h of a step, and R' kept a rotation: the
//! midpoint rule for a body (J. Moser and A. Veselov, 1991). With R' = R C, C = (1 − A)⁻¹(1 + A) a Cayley turn and Ω, M as
//! in texts (see [`state`](super::state)), one step solves
//!
//! X = (1 − A) M (1 + A), A = ½hΩ(X), that is PA + AP = ½h X,
//!
//! for the momentum X in the middle, and M' = Cᵀ M C. So R M Rᵀ holds by construction, and with it |M|², the Pfaffian and
//! the traces of all powers of M. Energy and Manakov's integrals of every degree hold too: the step is integrable, with
//! the integrals of the motion itself. It is symplectic, time-reversible and of second order (R. McLachlan and A. Zanna,
//! 2005, who also show that it is RATTLE).
//!
//! Tried first: M' = M + h f(½(M + M')), the midpoint rule on Euler's equation alone, with the Cayley turn of that midpoint
//! as attitude. It keeps every quadratic integral, but from 5D on there are others, and its R M Rᵀ drifts with h².

use hyperbody_math::{Bivector, Matrix, Rotation, planes};

use super::error::{FreeTopError, FreeTopErrorKind, Result};
use super::state::TopState;
use super::top::FreeTop;

/// Iterations that a step may take. The fixed-point iteration gains a factor of about h|ω| each: sixteen digits in 50
/// iterations up to h|ω| ≈ ½. Newton's method takes over where it stalls, and doubles the digits.
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
    let middle = fixed_point(top, &start, dt).or_else(|| newton(top, &start, dt));
    let end = middle.and_then(|middle| turned(state, &(top.spin_from_momentum(&middle) * dt)));
    *state = end.ok_or_else(|| {
        FreeTopError::new(
            FreeTopErrorKind::NoConvergence,
            format!(
                "the midpoint equation has no solution within reach: a step of {dt} s at {} rad/s is too long; \
                 keep the product below one",
                state.spin_in_body(top).norm()
            ),
        )
    })?;
    Ok(())
}

/// What the equation makes of a guess at the momentum in the middle: (1 − A) M (1 + A), A from the guess. In the matrices
/// of this library, a = −A and m = −M, that is m + am − ma − ama, and ma is the transpose of am.
fn middle_momentum<const N: usize>(top: &FreeTop<N>, start: &Bivector<N>, guess: &Bivector<N>, dt: f64) -> Bivector<N> {
    let half_turn = (top.spin_from_momentum(guess) * (0.5 * dt)).to_matrix();
    let once = half_turn * start.to_matrix();
    let twice = once * half_turn;
    *start + Bivector::from_fn(|i, j| once[i][j] - once[j][i] - twice[i][j])
}

/// The derivative of [`middle_momentum`] by its guess, in a direction.
fn middle_momentum_derivative<const N: usize>(
    top: &FreeTop<N>,
    start: &Bivector<N>,
    guess: &Bivector<N>,
    direction: &Bivector<N>,
    dt: f64,
) -> Bivector<N> {
    let half_turn = (top.spin_from_momentum(guess) * (0.5 * dt)).to_matrix();
    let change = (top.spin_from_momentum(direction) * (0.5 * dt)).to_matrix();
    let once = change * start.to_matrix();
    // The derivative of ama is δa m a and the negative of its transpose.
    let twice = once * half_turn;
    Bivector::from_fn(|i, j| once[i][j] - once[j][i] - (twice[i][j] - twice[j][i]))
}

/// Iterates the momentum in the middle until it no longer changes by more than rounding; `None` if it does not settle.
fn fixed_point<const N: usize>(top: &FreeTop<N>, start: &Bivector<N>, dt: f64) -> Option<Bivector<N>> {
    let tolerance = ROUNDING * start.norm();
    let mut middle = *start;
    let mut last_change = f64::INFINITY;
    for _ in 0..MAX_FIXED_POINT {
        let next = middle_momentum(top, start, &middle, dt);
        let change = (next - middle).norm();
        middle = next;
        // One more pass after the tolerance is met puts the error below rounding.
        if last_change <= tolerance {
            return Some(middle);
        }
        if change.is_nan() || (change > tolerance && change > 0.9 * last_change) {
            return None;
        }
        last_change = change;
    }
    None
}

/// Newton's method, from the start of the step.
fn newton<const N: usize>(top: &FreeTop<N>, start: &Bivector<N>, dt: f64) -> Option<Bivector<N>> {
    let tolerance = ROUNDING * start.norm();
    let mut middle = *start;
    let mut last_change = f64::INFINITY;
    for _ in 0..MAX_NEWTON {
        let residual = middle_momentum(top, start, &middle, dt) - middle;
        let derivative = |direction: &Bivector<N>| middle_momentum_derivative(top, start, &middle, direction, dt);
        let correction = solve_newton_system(derivative, &residual)?;
        middle += correction;
        let change = correction.norm();
        // Rounding in a long step can keep the last digits moving: stop where they no longer improve.
        if change <= tolerance || (change <= 1e3 * tolerance && change >= last_change) {
            return Some(middle);
        }
        last_change = change;
    }
    None
}

/// Solves (1 − D) X = `residual` with a linear map D of bivectors, by elimination with partial pivoting.
pub(crate) fn solve_newton_system<const N: usize>(
    derivative: impl Fn(&Bivector<N>) -> Bivector<N>,
    residual: &Bivector<N>,
) -> Option<Bivector<N>> {
    let count = planes::count(N);
    let mut matrix = [[0.0; MAX_PLANES + 1]; MAX_PLANES];
    for (column, (i, j)) in planes::all(N).enumerate() {
        let image = derivative(&Bivector::plane(i, j, 1.0));
        for (row, value) in image.planes().enumerate() {
            matrix[row][column] = f64::from(u8::from(row == column)) - value;
        }
    }
    for (row, value) in residual.planes().enumerate() {
        matrix[row][count] = value;
    }
    let solution = eliminate(&mut matrix, count)?;
    Bivector::from_planes(&solution[..count])
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

/// The state after the Cayley turn C = (1 − A)⁻¹(1 + A), A the matrix that maps r to r·½b, which agrees with exp(b) to second
/// order: R C and Cᵀ M C.
///
/// Both are computed as changes, by C − 1 = 2(1 − A)⁻¹A: the rounding of C itself would be a part in 10¹⁶ in every step,
/// always of the same sign, and a thousand times that of its change.
fn turned<const N: usize>(state: &TopState<N>, b: &Bivector<N>) -> Option<TopState<N>> {
    let half = b.to_matrix().transpose() * 0.5;
    // 1 − A of an antisymmetric A has singular values of at least one.
    let change = (Matrix::IDENTITY - half).try_inverse()? * half * 2.0;
    let attitude = *state.world_from_body.matrix();
    let world_from_body = Rotation::from_matrix(attitude + attitude * change)?;
    let momentum = state.momentum_in_body.to_matrix();
    let once = momentum * change;
    let twice = change.transpose() * once;
    // CᵀMC − M = ME + EᵀM + EᵀME, where EᵀM is the negative transpose of ME.
    let momentum_change = Bivector::from_fn(|i, j| once[i][j] - once[j][i] + twice[i][j]);
    Some(TopState { world_from_body, momentum_in_body: state.momentum_in_body + momentum_change })
}

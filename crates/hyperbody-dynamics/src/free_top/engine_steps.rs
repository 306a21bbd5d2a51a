//! What engines usually do with a spinning body, for comparison: none of it conserves the momentum.
//!
//! The implicit gyroscopic step solves I(ω' − ω) + h ω' × Iω' = 0 by one step of Newton's method from ω (E. Catto, 2015,
//! in 3D; M. ten Bosch, 2020, in n dimensions), the explicit step takes ω' = ω + h dω/dt. Both then turn the body by the
//! new spin, R' = R exp(h ω'). Stable at any step, the implicit one loses energy and momentum in proportion to the step.

use hyperbody_math::{Bivector, Rotation};

use super::midpoint::solve_newton_system;
use super::state::TopState;
use super::top::FreeTop;

/// One implicit gyroscopic step of `dt` seconds.
pub fn gyroscopic_step<const N: usize>(top: &FreeTop<N>, state: &mut TopState<N>, dt: f64) {
    let momentum = state.momentum_in_body;
    let residual = top.momentum_rate(&momentum) * dt;
    // The system is singular for no step in practice; if it is, the spin stays.
    let derivative = |direction: &Bivector<N>| momentum_rate_derivative(top, &momentum, direction) * dt;
    let change = solve_newton_system(derivative, &residual).unwrap_or(Bivector::ZERO);
    advance(top, state, momentum + change, dt);
}

/// One explicit Euler step of `dt` seconds.
pub fn explicit_step<const N: usize>(top: &FreeTop<N>, state: &mut TopState<N>, dt: f64) {
    let momentum = state.momentum_in_body + top.momentum_rate(&state.momentum_in_body) * dt;
    advance(top, state, momentum, dt);
}

/// Derivative of Euler's right-hand side at `momentum` in a direction.
fn momentum_rate_derivative<const N: usize>(
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

fn advance<const N: usize>(top: &FreeTop<N>, state: &mut TopState<N>, momentum: Bivector<N>, dt: f64) {
    // Explicit steps blow up in the end; the last finite state is kept instead of spreading NaN.
    if momentum.norm_sq().is_finite() {
        state.momentum_in_body = momentum;
    }
    let turn = top.spin_from_momentum(&state.momentum_in_body) * dt;
    if turn.is_finite() {
        state.world_from_body = state.world_from_body * Rotation::exp(&turn);
        state.world_from_body.reorthonormalize();
    }
}

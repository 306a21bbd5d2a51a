//! The free rotation as a product of exact turns in coordinate planes.
//!
//! H = ½ Σ M_ij²/(J_i + J_j) is a sum over planes, and the flow of one term alone is known: it turns the body by
//! θ = h M_ij/(J_i + J_j) in its own plane (i, j), R ← R G(θ) and M ← Gᵀ M G, while M_ij stands still. Composed there and
//! back, the turns of all planes give a step that is explicit, time-reversible and of second order. Every factor is
//! orthogonal, so R M Rᵀ and the Casimirs of M hold to rounding whatever the step, and the energy error does not grow
//! (R. McLachlan, 1993; J. Touma and J. Wisdom, 1994; S. Reich, 1994, in three dimensions).
//!
//! Disjoint planes commute: the N(N−1)/2 planes fall into rounds of disjoint ones, like the games of a tournament in
//! which everybody meets everybody (N − 1 rounds for even N, N for odd). A round needs no order inside, the innermost
//! round of a step is done once over the whole step, and the turns of one round do not wait for each other's sines. In
//! 4D these are the three pairs {12, 34}, {13, 24}, {14, 23}.

use hyperbody_math::{Bivector, Givens, Rotation, Vector};

/// Number of rounds of disjoint planes.
const fn round_count(n: usize) -> usize {
    n - 1 + n % 2
}

/// The planes of one round, each given to `flow` with the time for which it turns.
///
/// Circle method: with m the round count, axes i and j < m meet in round (i + j) mod m; for even N the last axis meets
/// the one that would meet itself.
#[inline]
fn round<const N: usize>(round: usize, time: f64, flow: &mut impl FnMut(usize, usize, f64)) {
    let m = round_count(N);
    for first in 0..m {
        let second = (round + m - first) % m;
        let (i, j) = if first == second && N.is_multiple_of(2) { (first, N - 1) } else { (first, second) };
        if i < j {
            flow(i, j, time);
        }
    }
}

/// The single-plane flows of a step of `dt` seconds in their order: `flow(i, j, time)`. One symmetric stage of second
/// order for each weight, where the outermost rounds of neighbouring stages, which turn the same planes, are merged.
#[inline]
pub(crate) fn for_each_flow<const N: usize>(weights: &[f64], dt: f64, flow: &mut impl FnMut(usize, usize, f64)) {
    let innermost = round_count(N) - 1;
    if innermost == 0 {
        // One plane: its flow is exact whatever the weights.
        flow(0, 1, dt);
        return;
    }
    let mut pending = 0.0;
    for &weight in weights {
        let half = 0.5 * weight * dt;
        round::<N>(0, pending + half, flow);
        for index in 1..innermost {
            round::<N>(index, half, flow);
        }
        round::<N>(innermost, 2.0 * half, flow);
        for index in (1..innermost).rev() {
            round::<N>(index, half, flow);
        }
        pending = half;
    }
    round::<N>(0, pending, flow);
}

/// The exact flow of one plane: turns attitude and momentum by `angle_per_momentum` times the momentum of the plane.
#[inline]
pub(crate) fn turn_plane<const N: usize>(
    (i, j): (usize, usize),
    angle_per_momentum: f64,
    momentum: &mut Bivector<N>,
    world_from_body: &mut Rotation<N>,
) {
    let turn = Givens::from_angle(angle_per_momentum * momentum.get(i, j));
    momentum.change_to_turned_frame(i, j, turn);
    world_from_body.turn_in_body_plane(i, j, turn);
}

/// One free-rotation step of second order for a body that carries its angular momentum in the world frame.
///
/// `world_from_principal` is the attitude of the principal frame; it advances by `dt` seconds (negative: back in time)
/// and is left orthogonal to rounding. `momentum_in_world` in kg·m²/s does not change: no torque acts.
/// `principal_moments` are the second moments J_i in kg·m² (plane (i, j) has the moment of inertia J_i + J_j).
///
/// Never panics and never makes a NaN from finite input: a plane without inertia does not turn, and a momentum too large
/// to be written in the body frame leaves the attitude as it is. A step with −dt undoes a step with dt up to rounding.
#[inline]
pub fn free_rotation_step<const N: usize>(
    world_from_principal: &mut Rotation<N>,
    momentum_in_world: &Bivector<N>,
    principal_moments: &Vector<N>,
    dt: f64,
) {
    let mut momentum = world_from_principal.inverse_rotate_bivector(momentum_in_world);
    if !momentum.is_finite() {
        return;
    }
    let mut inverse_inertia = [[0.0; N]; N];
    for i in 0..N {
        for j in i + 1..N {
            inverse_inertia[i][j] = 1.0 / (principal_moments[i] + principal_moments[j]);
        }
    }
    for_each_flow::<N>(&[1.0], dt, &mut |i, j, time| {
        turn_plane((i, j), time * inverse_inertia[i][j], &mut momentum, world_from_principal);
    });
    world_from_principal.reorthonormalize();
}

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
pub(crate) const fn round_count(n: usize) -> usize {
    n - 1 + n % 2
}

/// h/(J_i + J_j): what turns the momentum of a plane into the angle of its turn.
#[inline]
fn angle_per_momentum<const N: usize>(principal_moments: &Vector<N>, h: f64) -> [[f64; N]; N] {
    let mut rate = [[0.0; N]; N];
    for i in 0..N {
        for j in i + 1..N {
            rate[i][j] = h / (principal_moments[i] + principal_moments[j]);
        }
    }
    rate
}

/// One round of exact flows over `fraction` of the time that `angle_per_momentum` stands for.
///
/// Circle method: with m the round count, axes i and j < m meet in round (i + j) mod m; for even N the last axis meets
/// the one that would meet itself.
#[inline]
fn turn_round<const N: usize>(
    round: usize,
    fraction: f64,
    angle_per_momentum: &[[f64; N]; N],
    momentum: &mut Bivector<N>,
    world_from_body: &mut Rotation<N>,
) {
    let m = round_count(N);
    for first in 0..m {
        let second = (round + m - first) % m;
        let (i, j) = if first == second && N.is_multiple_of(2) { (first, N - 1) } else { (first, second) };
        if i < j {
            let turn = Givens::from_angle(fraction * angle_per_momentum[i][j] * momentum.get(i, j));
            momentum.change_to_turned_frame(i, j, turn);
            world_from_body.turn_in_body_plane(i, j, turn);
        }
    }
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
    let rate = angle_per_momentum(principal_moments, dt);
    let innermost = round_count(N) - 1;
    for round in 0..innermost {
        turn_round(round, 0.5, &rate, &mut momentum, world_from_principal);
    }
    turn_round(innermost, 1.0, &rate, &mut momentum, world_from_principal);
    for round in (0..innermost).rev() {
        turn_round(round, 0.5, &rate, &mut momentum, world_from_principal);
    }
    world_from_principal.reorthonormalize();
}

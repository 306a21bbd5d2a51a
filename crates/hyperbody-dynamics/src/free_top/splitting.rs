//! Plane splitting of orders 2, 4 and 6: the step of [`plane_splitting`](super::plane_splitting) composed with itself.
//!
//! A symmetric step S(h) of second order gives higher orders as S(γ₁h) S(γ₂h) … S(γₛh) with symmetric weights γ that add
//! up to one and cancel the error terms of third (and fifth) order; some weights are negative. The product remains
//! explicit, time-reversible and orthogonal, so it keeps what the plain step keeps.
//!
//! Order 4: five stages, 1/(4 − ∛4) twice on either side (M. Suzuki, 1990). Order 6: thirteen stages (M. Sofroniou and
//! G. Spaletta, 2005). On a tumbling 4D body these are 2.6 times as accurate at equal cost as the nine stages of W. Kahan
//! and R.-C. Li (1997), which were tried first.

use super::plane_splitting::{for_each_flow, turn_plane};
use super::state::TopState;
use super::top::FreeTop;

/// Second order: the plain step.
pub const ORDER_2: [f64; 1] = [1.0];

/// Fourth order: 1/(4 − ∛4) = 0.4144907717943757… and 1 minus four times that (M. Suzuki, 1990).
pub const ORDER_4: [f64; 5] = [
    0.414_490_771_794_375_7,
    0.414_490_771_794_375_7,
    -0.657_963_087_177_502_9,
    0.414_490_771_794_375_7,
    0.414_490_771_794_375_7,
];

/// Sixth order (M. Sofroniou and G. Spaletta, 2005).
pub const ORDER_6: [f64; 13] = [
    0.138_619_308_540_516_95,
    0.133_465_628_510_747_6,
    0.130_705_310_114_492_25,
    0.129_618_937_569_070_35,
    -0.350_003_248_939_209,
    0.118_055_306_530_023_87,
    0.399_077_515_348_715_9,
    0.118_055_306_530_023_87,
    -0.350_003_248_939_209,
    0.129_618_937_569_070_35,
    0.130_705_310_114_492_25,
    0.133_465_628_510_747_6,
    0.138_619_308_540_516_95,
];

/// One step of `dt` seconds (negative: back in time) with the weights of a symmetric composition.
pub fn splitting_step<const N: usize>(top: &FreeTop<N>, state: &mut TopState<N>, weights: &[f64], dt: f64) {
    let inverse_inertia = top.inverse_inertia();
    let TopState { world_from_body, momentum_in_body } = state;
    for_each_flow::<N>(weights, dt, &mut |i, j, time| {
        turn_plane((i, j), time * inverse_inertia[i][j], momentum_in_body, world_from_body);
    });
    world_from_body.reorthonormalize();
}

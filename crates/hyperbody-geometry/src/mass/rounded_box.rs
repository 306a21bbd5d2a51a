//! Boxes rounded by a radius, where any half-extent may be zero: balls, capsules and boxes are among them.
//!
//! Steiner's decomposition: the shape is the union, over all sets S of axes, of pieces where exactly the axes of S have
//! left the core. With m = |S| the 2^m pieces of S together are a box with edges 2h_i (i ∉ S) times a ball of dimension
//! m and radius r, pulled apart by h_i along the axes of S. Its volume is Π_{i∉S} 2h_i · V_m r^m, and the mean of x_i² is
//! h_i²/3 for i ∉ S and (h_i + |y_i|)² over the ball for i ∈ S. Every term is positive: nothing cancels.

use hyperbody_math::{Matrix, Vector};

use super::MassProperties;
use crate::volume::unit_ball;

/// The properties at unit density of all points at most `radius` from the box of these half-extents (each ≥ 0).
pub(super) fn properties<const N: usize>(half_extents: Vector<N>, radius: f64) -> MassProperties<N> {
    let mut volume = 0.0;
    let mut moments = Vector::<N>::ZERO;
    for set in 0_usize..1 << N {
        let rounded = |axis: usize| set >> axis & 1 == 1;
        let m = set.count_ones() as usize;
        let mut piece = unit_ball(m);
        for axis in 0..N {
            piece *= if rounded(axis) { radius } else { 2.0 * half_extents[axis] };
        }
        volume += piece;
        let mean_sq = radius * radius / (m + 2) as f64;
        for axis in 0..N {
            let h = half_extents[axis];
            let square = if rounded(axis) { h * h + 2.0 * h * mean_reach(m) * radius + mean_sq } else { h * h / 3.0 };
            moments[axis] += piece * square;
        }
    }
    MassProperties { mass: volume, centre: Vector::ZERO, second_moments: Matrix::from_diagonal(moments) }
}

/// Mean of |y_1| over the unit ball of dimension m ≥ 1: 2 V_{m−1} / ((m+1) V_m), from slices orthogonal to y_1.
fn mean_reach(m: usize) -> f64 {
    2.0 * unit_ball(m - 1) / ((m + 1) as f64 * unit_ball(m))
}

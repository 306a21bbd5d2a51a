//! How the rows of a block respond to impulses: all contacts of a block at once.
//!
//! In double precision, rounded at the end: in single precision the sums would differ by some roundings from what the rows do
//! when they are applied, and a scene that is turned, or placed in more dimensions, would depart ten times as fast.

use super::normal::upper;
use super::{Block, Layout};
use crate::solver::bodies::Sizes;
use crate::solver::lanes::{DoubleLanes, Lanes, Real};
use crate::solver::machine::Machine;
use crate::solver::wide::{Doubles, Wide};

/// Effective masses of friction, and the responses of a block's points to each other.
pub(super) struct Response<const N: usize>;

impl<const N: usize> Response<N> {
    /// Completes a block whose arms and levers are there.
    #[inline(always)]
    pub(super) fn write<M: Machine>(machine: M, block: &Block, rows: &mut [Lanes], counts: &DoubleLanes) {
        let a = rows[Layout::<N>::INVERSE_SQRT_MASS_A].on(machine).doubles();
        let b = rows[Layout::<N>::INVERSE_SQRT_MASS_B].on(machine).doubles();
        let inverse_mass = a * a + b * b;
        Self::sliding(rows, inverse_mass);
        rows[Layout::<N>::TWIST_MASS] = if block.twists > 0 {
            Self::mass_of_turning(machine, rows, Layout::<N>::TWIST_ROWS, Layout::<N>::TWIST_ROW, block.twists).lanes()
        } else {
            Lanes::ZERO
        };
        if block.resists {
            let slopes = Layout::<N>::field_start(block) + Layout::<N>::FIELD_ROW;
            let mass = Self::mass_of_turning(machine, rows, slopes, Layout::<N>::FIELD_ROW, Layout::<N>::SLIDES);
            rows[Layout::<N>::resistance_start(block) + Layout::<N>::ROLLING_MASS] = mass.lanes();
        }
        let counts = Doubles::of(machine, counts.0).lanes();
        Self::points(block, rows, inverse_mass, counts.on(machine));
    }

    /// Response of one row to another through the rotation of both bodies; their arms stand at the given positions.
    #[inline(always)]
    fn of_arms<M: Machine>(machine: M, rows: &[Lanes], row: usize, other: usize) -> Doubles<M> {
        let (row, other) = (&rows[row..row + 2 * Sizes::<N>::K], &rows[other..other + 2 * Sizes::<N>::K]);
        let mut response = Doubles::zero(machine);
        for (arm, other) in row.iter().zip(other) {
            response += arm.on(machine).doubles() * other.on(machine).doubles();
        }
        response
    }

    /// Inverse of T K Tᵀ with K the paper's response matrix summed over both bodies. Symmetric and positive definite,
    /// because (m_a + m_b)⁻¹ stands on its diagonal.
    #[inline(always)]
    fn sliding<M: Machine>(rows: &mut [Lanes], inverse_mass: Doubles<M>) {
        let machine = inverse_mass.machine();
        let slides = Layout::<N>::SLIDES;
        let mut k = [[Doubles::zero(machine); N]; N];
        for s in 0..slides {
            for t in s..slides {
                let arms = Layout::<N>::HEADER + Layout::<N>::SLIDE_ARM_A;
                let (row, other) = (arms + s * Layout::<N>::SLIDE_ROW, arms + t * Layout::<N>::SLIDE_ROW);
                let response = Self::of_arms(machine, rows, row, other);
                k[s][t] = if s == t { response + inverse_mass } else { response };
                k[t][s] = k[s][t];
            }
        }
        let inverse = invert_positive_definite(machine, k, slides);
        let mut at = Layout::<N>::SLIDE_MASS;
        for s in 0..slides {
            for t in s..slides {
                rows[at] = inverse[s][t].lanes();
                at += 1;
            }
        }
    }

    /// One mass for several rows that turn: the inverse of a bound on the largest eigenvalue of their response matrix, mean +
    /// deviation·√(k−1) (H. Wolkowicz and G. P. H. Styan, 1980), exact for isotropic bodies, safe for others, and the same
    /// for every choice of tangents.
    #[inline(always)]
    fn mass_of_turning<M: Machine>(
        machine: M,
        rows: &[Lanes],
        start: usize,
        stride: usize,
        count: usize,
    ) -> Doubles<M> {
        let zero = Doubles::zero(machine);
        let mut trace = zero;
        for s in 0..count {
            trace += Self::of_arms(machine, rows, start + s * stride, start + s * stride);
        }
        // In parts of the trace, whose square might overflow.
        let inverse_trace = trace.inverse_or_zero();
        let mut squares = zero;
        for s in 0..count {
            for t in s..count {
                let part = Self::of_arms(machine, rows, start + s * stride, start + t * stride) * inverse_trace;
                let square = part * part;
                squares += if s == t { square } else { square + square };
            }
        }
        let share = 1.0 / count.max(1) as Real;
        let mean = Doubles::splat(machine, share);
        let variance = (squares * mean - mean * mean).max(zero);
        let largest = mean + (variance * Doubles::splat(machine, count.saturating_sub(1) as Real)).sqrt();
        inverse_trace * largest.inverse_or_zero()
    }

    /// One in the lanes that have a point of this number, else zero.
    #[inline(always)]
    fn there<M: Machine>(counts: Wide<M>, point: usize) -> Doubles<M> {
        let machine = counts.machine();
        let beyond = counts - Wide::splat(machine, point as Real + 0.5);
        beyond.select_positive(Wide::splat(machine, 1.0), Wide::zero(machine)).doubles()
    }

    /// Responses of the points to each other, L G Lᵀ with L the places of the points and G the responses of the field.
    #[inline(always)]
    fn points<M: Machine>(block: &Block, rows: &mut [Lanes], inverse_mass: Doubles<M>, counts: Wide<M>) {
        let machine = inverse_mass.machine();
        let zero = Doubles::zero(machine);
        let used = Layout::<N>::field_rows(block);
        let field = Layout::<N>::field_start(block);
        let mut g = [[zero; N]; N];
        for s in 0..used {
            for t in s..used {
                let (row, other) = (field + s * Layout::<N>::FIELD_ROW, field + t * Layout::<N>::FIELD_ROW);
                g[s][t] = Self::of_arms(machine, rows, row, other);
                g[t][s] = g[s][t];
            }
        }
        g[0][0] += inverse_mass;
        let (head, response) = rows.split_at_mut(Layout::<N>::response_start(block));
        let levers = &head[Layout::<N>::points_start(block)..];
        for i in 0..block.points {
            let place = &levers[i * Layout::<N>::POINT_ROW + Layout::<N>::POINT_LEVER..][..Layout::<N>::SLIDES];
            // Lanes with fewer points have no response there.
            let there = Self::there(counts, i);
            let mut to_place = [zero; N];
            for t in 0..used {
                to_place[t] = g[0][t];
                for s in 1..used {
                    to_place[t] += g[s][t] * place[s - 1].on(machine).doubles();
                }
                to_place[t] = to_place[t] * there;
            }
            for j in i..block.points {
                let other = &levers[j * Layout::<N>::POINT_ROW + Layout::<N>::POINT_LEVER..][..Layout::<N>::SLIDES];
                let there = Self::there(counts, j);
                let mut sum = to_place[0];
                for t in 1..used {
                    sum += to_place[t] * other[t - 1].on(machine).doubles();
                }
                response[upper(block.points, i, j)] = (sum * there).lanes();
            }
        }
    }
}

/// Inverse of the leading `size`×`size` block of symmetric positive definite matrices, by Gauss–Jordan elimination, which
/// needs no pivoting there; zero in lanes that hold no matrix.
#[inline(always)]
fn invert_positive_definite<const N: usize, M: Machine>(
    machine: M,
    mut m: [[Doubles<M>; N]; N],
    size: usize,
) -> [[Doubles<M>; N]; N] {
    let mut inverse = [[Doubles::zero(machine); N]; N];
    for i in 0..size {
        inverse[i][i] = Doubles::splat(machine, 1.0);
    }
    for k in 0..size {
        let scale = m[k][k].inverse_or_zero();
        for j in 0..size {
            m[k][j] = m[k][j] * scale;
            inverse[k][j] = inverse[k][j] * scale;
        }
        for i in 0..size {
            if i == k {
                continue;
            }
            let factor = m[i][k];
            for j in 0..size {
                m[i][j] -= factor * m[k][j];
                inverse[i][j] -= factor * inverse[k][j];
            }
        }
    }
    inverse
}

//! A spin within three axes, by Jacobi's elliptic functions: the classical top, in a space of any dimension.
//!
//! A spin in the planes of three principal axes stays there, and the other axes stand still. With the three momenta
//! l₁ = M_bc, l₂ = M_ca, l₃ = M_ab, moments I₁, I₂, I₃ of those planes and the axes ordered by moment so that l₃ keeps its sign,
//!
//! l₁ = I₁A₁ cn τ, l₂ = ±I₂A₂ sn τ, l₃ = ±I₃A₃ dn τ, τ = τ₀ + pt, p² = (I₃ − I₂)(L² − 2E I₁)/(I₁ I₂ I₃),
//! k² = (I₂ − I₁)(2E I₃ − L²)/((I₃ − I₂)(L² − 2E I₁)), period 4K(k)/p
//!
//! with p < 0 where that order has descending moments (L. Landau and E. Lifshitz, Mechanics, §37). The attitude follows from the fixed direction of L and from the angle φ by
//! which axis 1 has precessed about it, dφ/dt = L/I₁ + L (2E − L²/I₁)/(L² − l₁²), an integral of the third kind. Axis 1
//! never points along L, so φ is smooth up to the separatrix.

use hyperbody_math::{Bivector, Matrix, Rotation, Vector, planes, scalar};

use super::elliptic::{complete_first, incomplete_first, jacobi, third_within_quarter};
use super::state::TopState;
use super::top::FreeTop;

/// A triple of numbers, one for each of the three axes.
type Triple = [f64; 3];

/// The motion of a spin within three axes.
#[derive(Clone, Copy, Debug)]
pub struct ThreeAxesMotion<const N: usize> {
    start: TopState<N>,
    /// The three axes in the order of the formulas.
    axes: [usize; 3],
    /// Largest |l₁|, |l₂|, |l₃|.
    amplitudes: Triple,
    /// Sign of l₃.
    sign: f64,
    /// dτ/dt (negative where axis 1 is the one of the largest moment) and τ at the start.
    pace: f64,
    phase: f64,
    /// 1 − k².
    m1: f64,
    /// dφ/dt = steady + varying/(1 + ν sn² τ).
    precession_steady: f64,
    precession_varying: f64,
    nu: f64,
    /// Body axes of the frame (axis 1 across L, its normal, L), by columns, at the start.
    frame: [Triple; 3],
}

impl<const N: usize> ThreeAxesMotion<N> {
    /// The motion from `start`, or `None` if the spin reaches beyond the planes of three axes, or is so close to steady
    /// that the formulas lose their meaning.
    #[must_use]
    pub fn new(top: &FreeTop<N>, start: &TopState<N>) -> Option<Self> {
        let mut axes = axes_of(&start.momentum_in_body)?;
        // J descending makes I ascending.
        let moments = top.principal_moments();
        axes.sort_by(|&a, &b| moments[b].total_cmp(&moments[a]));
        if excess_over_separatrix(top, &start.momentum_in_body, axes) < 0.0 {
            axes.reverse();
        }
        Self::in_order(top, start, axes)
    }

    fn in_order(top: &FreeTop<N>, start: &TopState<N>, axes: [usize; 3]) -> Option<Self> {
        let inertia = inertia_of(top, axes);
        let [i1, i2, i3] = inertia;
        let l = components(&start.momentum_in_body, axes);
        let sq = l.map(|c| c * c);
        // Each difference as a sum of terms of one sign, free of cancellation: 2E I₃ − L², L² − 2E I₁, L² − 2E I₂.
        let below_third = sq[0] * (i3 - i1) / i1 + sq[1] * (i3 - i2) / i2;
        let above_first = sq[1] * (i2 - i1) / i2 + sq[2] * (i3 - i1) / i3;
        let above_second = sq[2] * (i3 - i2) / i3 - sq[0] * (i2 - i1) / i1;
        let denominator = (i3 - i2) * above_first;
        if denominator == 0.0 {
            return None;
        }
        // Descending I runs through the functions backwards.
        let pace = (denominator / (i1 * i2 * i3)).sqrt().copysign(i3 - i1);
        let m1 = ((i3 - i1) * above_second / denominator).clamp(0.0, 1.0);
        let amplitudes = [
            (i1 * below_third / (i3 - i1)).sqrt(),
            (i2 * below_third / (i3 - i2)).sqrt(),
            (i3 * above_first / (i3 - i1)).sqrt(),
        ];
        if !(amplitudes[0] > 0.0 && amplitudes[1] > 0.0 && pace.is_finite()) {
            return None;
        }
        let sign = 1.0_f64.copysign(l[2]);
        let phase = incomplete_first(scalar::atan2(sign * l[1] / amplitudes[1], l[0] / amplitudes[0]), m1);
        let norm_sq = sq[0] + sq[1] + sq[2];
        let (norm, across_sq) = (norm_sq.sqrt(), amplitudes[2] * amplitudes[2]);
        // 2E − L²/I₁ ≤ 0 and L² − l₁² at sn = 0, which is l₃².
        let deficit = sq[1] * (1.0 / i2 - 1.0 / i1) + sq[2] * (1.0 / i3 - 1.0 / i1);
        Some(Self {
            start: *start,
            axes,
            amplitudes,
            sign,
            pace,
            phase,
            m1,
            precession_steady: norm / i1,
            precession_varying: norm * deficit / across_sq,
            nu: amplitudes[0] * amplitudes[0] / across_sq,
            frame: frame_about(l),
        })
        .filter(|motion| motion.phase.is_finite())
    }

    /// Period of the momentum in the body frame, 4K/p, in seconds; infinite on the separatrix. The body flips twice in it.
    #[must_use]
    pub fn period(&self) -> f64 {
        4.0 * complete_first(self.m1) / self.pace.abs()
    }

    /// The modulus k² of the motion: one on the separatrix.
    #[must_use]
    pub fn modulus_sq(&self) -> f64 {
        1.0 - self.m1
    }

    /// The state after `t` seconds.
    #[must_use]
    pub fn state_at(&self, t: f64) -> TopState<N> {
        let (l, angle) = (self.momentum_at(t), self.precession_at(t));
        let (sin, cos) = scalar::sin_cos(angle);
        let now = frame_about(l);
        // Columns of R(0)ᵀR(t) within the three axes: frame at the start · turn about L by the angle · present frameᵀ.
        let first = combine(self.frame[0], cos, self.frame[1], sin);
        let second = combine(self.frame[1], cos, self.frame[0], -sin);
        let mut turn = Matrix::<N>::IDENTITY;
        for (row, &axis) in self.axes.iter().enumerate() {
            for (column, &other) in self.axes.iter().enumerate() {
                turn[axis][other] =
                    first[row] * now[0][column] + second[row] * now[1][column] + self.frame[2][row] * now[2][column];
            }
        }
        let turn = Rotation::from_matrix(turn).unwrap_or(Rotation::IDENTITY);
        TopState { world_from_body: self.start.world_from_body * turn, momentum_in_body: self.bivector(l) }
    }

    /// l₁, l₂, l₃ after `t` seconds.
    fn momentum_at(&self, t: f64) -> Triple {
        let (sn, cn, dn) = jacobi(self.within_period(t).1, self.m1);
        let flip = if self.within_period(t).0 % 2.0 == 0.0 { 1.0 } else { -1.0 };
        [
            flip * self.amplitudes[0] * cn,
            flip * self.sign * self.amplitudes[1] * sn,
            self.sign * self.amplitudes[2] * dn,
        ]
    }

    /// τ as a whole number of half periods 2K and a rest within ±K.
    fn within_period(&self, t: f64) -> (f64, f64) {
        let tau = self.phase + self.pace * t;
        let half_period = 2.0 * complete_first(self.m1);
        if half_period.is_infinite() {
            return (0.0, tau);
        }
        let half_periods = (tau / half_period).round();
        (half_periods, tau - half_periods * half_period)
    }

    /// The angle by which axis 1 has precessed about L in `t` seconds.
    fn precession_at(&self, t: f64) -> f64 {
        let varying = self.third_kind_at(t) - self.third_kind_at(0.0);
        self.precession_steady * t + self.precession_varying / self.pace * varying
    }

    /// ∫ dτ/(1 + ν sn² τ) from 0 to τ(t).
    fn third_kind_at(&self, t: f64) -> f64 {
        let (half_periods, rest) = self.within_period(t);
        let (sn, cn, _) = jacobi(rest, self.m1);
        let within = third_within_quarter(sn, cn, self.nu, self.m1);
        if half_periods == 0.0 {
            return within;
        }
        within + 2.0 * half_periods * third_within_quarter(1.0, 0.0, self.nu, self.m1)
    }

    fn bivector(&self, l: Triple) -> Bivector<N> {
        let [a, b, c] = self.axes;
        let mut momentum = Bivector::ZERO;
        momentum.set(b, c, l[0]);
        momentum.set(c, a, l[1]);
        momentum.set(a, b, l[2]);
        momentum
    }
}

/// The three axes whose planes hold the whole bivector (the first ones if fewer would do); `None` if there are more or
/// the space has none.
fn axes_of<const N: usize>(momentum: &Bivector<N>) -> Option<[usize; 3]> {
    let used = |axis: usize| planes::all(N).any(|(i, j)| (i == axis || j == axis) && momentum.get(i, j) != 0.0);
    let mut axes: Vec<usize> = (0..N).filter(|&axis| used(axis)).collect();
    for axis in 0..N {
        if axes.len() < 3 && !axes.contains(&axis) {
            axes.push(axis);
        }
    }
    axes.try_into().ok()
}

/// l₁ = M_bc, l₂ = M_ca, l₃ = M_ab.
fn components<const N: usize>(momentum: &Bivector<N>, [a, b, c]: [usize; 3]) -> Triple {
    [momentum.get(b, c), momentum.get(c, a), momentum.get(a, b)]
}

fn inertia_of<const N: usize>(top: &FreeTop<N>, [a, b, c]: [usize; 3]) -> Triple {
    [top.plane_moment(b, c), top.plane_moment(c, a), top.plane_moment(a, b)]
}

/// L² − 2E I₂ for axes with ascending I: positive where the motion circles axis 3, negative where it circles axis 1.
fn excess_over_separatrix<const N: usize>(top: &FreeTop<N>, momentum: &Bivector<N>, axes: [usize; 3]) -> f64 {
    let ([i1, i2, i3], l) = (inertia_of(top, axes), components(momentum, axes));
    l[2] * l[2] * (i3 - i2) / i3 - l[0] * l[0] * (i2 - i1) / i1
}

/// Orthonormal columns: axis 1 without its part along `l`, then `l` × that, then the direction of `l`.
fn frame_about(l: Triple) -> [Triple; 3] {
    let direction = Vector::<3>(l).normalize_or_zero();
    let across = (Vector::<3>::unit(0) - direction * direction[0]).normalize_or_zero();
    let (u, v) = (direction.0, across.0);
    let third = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    [v, third, u]
}

fn combine(a: Triple, x: f64, b: Triple, y: f64) -> Triple {
    [a[0] * x + b[0] * y, a[1] * x + b[1] * y, a[2] * x + b[2] * y]
}

//! Where the anchors of a net are within the step, and how its joints answer there.
//!
//! Bodies are where straight lines and turns by the exponential lead from the start of the step, in single precision: all that is
//! reckoned in it is what a step changes, and distances of anchors.

use hyperbody_math::{Bivector, Rotation, Vector};

use super::layout::{Ground, Swept};
use super::pairing::{Side, act, dot, load, put};
use super::plan::Block;
use crate::solver::bodies::{MAX_PLANES, Sizes};
use crate::solver::joints::place::Moment;
use crate::solver::lanes::{Lanes, Real, WIDTH};
use crate::solver::machine::{Machine, Pass};
use crate::solver::wide::Wide;

/// Squares of turns, rad², up to which so many terms of the series are as good as all: the next is 3e-9 and 5e-9 of the arm.
const SMALL: (Real, usize) = (0.05 * 0.05, 4);
const LARGE: (Real, usize) = (0.5 * 0.5, 8);

/// Looks where all anchors are now.
pub(super) struct Refresh<'a, const N: usize> {
    pub(super) blocks: &'a [Block],
    pub(super) swept: &'a mut [Lanes],
    pub(super) ground: &'a mut [Lanes],
    /// By body: what impulses have displaced it by.
    pub(super) displacements: &'a [Lanes],
    pub(super) moment: &'a Moment,
}

impl<const N: usize> Pass for Refresh<'_, N> {
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<M: Machine>(self, machine: M) {
        let Self { blocks, swept, ground, displacements, moment } = self;
        let swept = swept.chunks_exact_mut(Swept::<N>::LEN);
        let ground = ground.chunks_exact_mut(Ground::<N>::LEN);
        for ((block, swept), ground) in blocks.iter().zip(swept).zip(ground) {
            let a = Side::gather::<N>(machine, displacements, &block.a);
            let b = Side::gather::<N>(machine, displacements, &block.b);
            let (reach_a, reach_b) = locate::<N, M>((&a, &b), swept, ground, moment);
            base_rate(swept, ground, &reach_a, &reach_b, moment);
            invert::<N, M>(machine, swept);
        }
    }
}

/// Finds gap and arms; the arms are returned in metres.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn locate<const N: usize, M: Machine>(
    (a, b): (&Side<M>, &Side<M>),
    swept: &mut [Lanes],
    ground: &mut [Lanes],
    moment: &Moment,
) -> ([Wide<M>; N], [Wide<M>; N]) {
    let machine = a.linear(0).machine();
    let (mass_a, mass_b) = (swept[Swept::<N>::MASS_A], swept[Swept::<N>::MASS_B]);
    let (light_a, light_b) = (ground[Ground::<N>::LIGHTNESS_A], ground[Ground::<N>::LIGHTNESS_B]);
    let offset_a: [Wide<M>; N] = load(machine, ground, Ground::<N>::OFFSET_A);
    let offset_b: [Wide<M>; N] = load(machine, ground, Ground::<N>::OFFSET_B);
    let of_a = (Ground::<N>::SPIN_A, Ground::<N>::SPIN_UP_A, light_a);
    let of_b = (Ground::<N>::SPIN_B, Ground::<N>::SPIN_UP_B, light_b);
    let mut reach_a = turned(&turn::<N, M>(a, ground, of_a, moment), &offset_a);
    let mut reach_b = turned(&turn::<N, M>(b, ground, of_b, moment), &offset_b);
    let (moved, moved_sq) = (Wide::splat(machine, moment.moved as Real), Wide::splat(machine, moment.moved_sq as Real));
    let share = ground[Ground::<N>::SHARE];
    let mut gap = offset_a;
    for i in 0..N {
        let base = moved * ground[Ground::<N>::VELOCITY + i] + moved_sq * ground[Ground::<N>::ACCELERATION + i];
        let centres = base + (b.linear(i) * mass_b - a.linear(i) * mass_a);
        let turning = (reach_b[i] - offset_b[i]) - (reach_a[i] - offset_a[i]);
        gap[i] = centres + ground[Ground::<N>::START + i] + turning;
        reach_a[i] += gap[i] * share;
        reach_b[i] -= gap[i] * share;
        swept[Swept::<N>::ARM_A + i] = (reach_a[i] * light_a).lanes();
        swept[Swept::<N>::ARM_B + i] = (reach_b[i] * light_b).lanes();
    }
    put(ground, Ground::<N>::GAP, &gap);
    (reach_a, reach_b)
}

/// The turn of a body since the start of the step, as a bivector.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn turn<const N: usize, M: Machine>(
    side: &Side<M>,
    ground: &[Lanes],
    (spin, spin_up, lightness): (usize, usize, Lanes),
    moment: &Moment,
) -> [Wide<M>; MAX_PLANES] {
    let machine = side.linear(0).machine();
    let (moved, moved_sq) = (Wide::splat(machine, moment.moved as Real), Wide::splat(machine, moment.moved_sq as Real));
    let mut turn = [Wide::zero(machine); MAX_PLANES];
    for k in 0..Sizes::<N>::K {
        let base = moved * ground[spin + k] + moved_sq * ground[spin_up + k];
        turn[k] = side.angular::<N>(k) * lightness + base;
    }
    turn
}

/// exp θ · r.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn turned<const N: usize, M: Machine>(turn: &[Wide<M>; MAX_PLANES], r: &[Wide<M>; N]) -> [Wide<M>; N] {
    let machine = r[0].machine();
    let mut size_sq = Wide::zero(machine);
    for plane in &turn[..Sizes::<N>::K] {
        size_sq += *plane * *plane;
    }
    let terms = if (Wide::splat(machine, SMALL.0) - size_sq).all_positive() {
        SMALL.1
    } else if (Wide::splat(machine, LARGE.0) - size_sq).all_positive() {
        LARGE.1
    } else {
        return turned_far(turn, r);
    };
    let (mut sum, mut term) = (*r, *r);
    for power in 1..=terms {
        let scale = Wide::splat(machine, 1.0 / power as Real);
        term = act(turn, &term);
        for i in 0..N {
            term[i] = term[i] * scale;
            sum[i] += term[i];
        }
    }
    sum
}

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn turned_far<const N: usize, M: Machine>(turn: &[Wide<M>; MAX_PLANES], r: &[Wide<M>; N]) -> [Wide<M>; N] {
    let mut result = *r;
    let mut lanes = [Lanes::ZERO; N];
    let mut planes = [Lanes::ZERO; MAX_PLANES];
    for (lanes, value) in lanes.iter_mut().zip(r) {
        *lanes = value.lanes();
    }
    for (lanes, value) in planes.iter_mut().zip(turn) {
        *lanes = value.lanes();
    }
    turn_one_by_one(&planes, &mut lanes);
    for (value, lanes) in result.iter_mut().zip(lanes) {
        *value = lanes.on(r[0].machine());
    }
    result
}

/// Far turns, up to some rounds a step, are rare.
#[cold]
fn turn_one_by_one<const N: usize>(planes: &[Lanes; MAX_PLANES], r: &mut [Lanes; N]) {
    for lane in 0..WIDTH {
        let mut angle = planes.iter().map(|plane| f64::from(plane.0[lane]));
        let mut turn = Bivector::<N>::ZERO;
        for (i, j) in hyperbody_math::planes::all(N) {
            turn.set(i, j, angle.next().unwrap_or(0.0));
        }
        let turned = Rotation::exp(&turn).rotate(Vector::from_fn(|i| f64::from(r[i].0[lane])));
        for i in 0..N {
            r[i].0[lane] = turned[i] as Real;
        }
    }
}

/// The rate of base velocities, and what base accelerations add to it.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn base_rate<const N: usize, M: Machine>(
    swept: &mut [Lanes],
    ground: &mut [Lanes],
    reach_a: &[Wide<M>; N],
    reach_b: &[Wide<M>; N],
    moment: &Moment,
) {
    let machine = reach_a[0].machine();
    let elapsed = Wide::splat(machine, moment.elapsed as Real);
    let spin_a = act(&planes::<N, M>(machine, ground, Ground::<N>::SPIN_A), reach_a);
    let spin_b = act(&planes::<N, M>(machine, ground, Ground::<N>::SPIN_B), reach_b);
    let up_a = act(&planes::<N, M>(machine, ground, Ground::<N>::SPIN_UP_A), reach_a);
    let up_b = act(&planes::<N, M>(machine, ground, Ground::<N>::SPIN_UP_B), reach_b);
    for i in 0..N {
        let up = (up_b[i] - up_a[i]) + ground[Ground::<N>::ACCELERATION + i];
        let rate = (spin_b[i] - spin_a[i]) + ground[Ground::<N>::VELOCITY + i] + elapsed * up;
        ground[Ground::<N>::UP + i] = up.lanes();
        swept[Swept::<N>::RATE + i] = rate.lanes();
    }
}

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn planes<const N: usize, M: Machine>(machine: M, ground: &[Lanes], at: usize) -> [Wide<M>; MAX_PLANES] {
    let mut planes = [Wide::zero(machine); MAX_PLANES];
    for (plane, lanes) in planes.iter_mut().zip(&ground[at..at + Sizes::<N>::K]) {
        *plane = lanes.on(machine);
    }
    planes
}

/// K = s − a aᵀ − b bᵀ with the scaled arms a, b and s = m + |a|² + |b|², m = 1/m_a + 1/m_b. With p = m + |b|², q = m + |a|², c = a·b its inverse
/// is (1 + (a (q a + c b)ᵀ + b (c a + p b)ᵀ)/d)/s, where d = p q − c² = m s + |a ∧ b|² (M. A. Woodbury, 1950).
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn invert<const N: usize, M: Machine>(machine: M, swept: &mut [Lanes]) {
    let a: [Wide<M>; N] = load(machine, swept, Swept::<N>::ARM_A);
    let b: [Wide<M>; N] = load(machine, swept, Swept::<N>::ARM_B);
    let (one, zero) = (Wide::splat(machine, 1.0), Wide::zero(machine));
    let (mass_a, mass_b) = (swept[Swept::<N>::MASS_A].on(machine), swept[Swept::<N>::MASS_B].on(machine));
    let mass = mass_a * mass_a + mass_b * mass_b;
    let (q, p, c) = (mass + dot(&a, &a), mass + dot(&b, &b), dot(&a, &b));
    let s = p + dot(&a, &a);
    let mut d = mass * s;
    for i in 0..N {
        for j in i + 1..N {
            let wedge = a[i] * b[j] - a[j] * b[i];
            d += wedge * wedge;
        }
    }
    // Lanes in which there is no joint.
    let (inverse_s, inverse_d) = (s.select_positive(one.div(s), zero), d.select_positive(one.div(d), zero));
    let (mut of_a, mut of_b) = (a, b);
    for i in 0..N {
        of_a[i] = (q * a[i] + c * b[i]) * inverse_d;
        of_b[i] = (c * a[i] + p * b[i]) * inverse_d;
    }
    let mut at = Swept::<N>::INVERSE;
    for i in 0..N {
        for j in i..N {
            let diagonal = if i == j { one } else { zero };
            swept[at] = ((a[i] * of_a[j] + b[i] * of_b[j] + diagonal) * inverse_s).lanes();
            at += 1;
        }
    }
}

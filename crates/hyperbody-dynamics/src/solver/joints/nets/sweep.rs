//! Sweeps over the joints of nets.

use super::chebyshev::Chebyshev;
use super::layout::{Ground, Swept};
use super::pairing::{Side, dot, load, put};
use super::plan::NetPlan;
use super::{Block, FORTH_AND_BACK};
use crate::solver::joints::aim::PUSH_BACK;
use crate::solver::lanes::{Lanes, Real};
use crate::solver::machine::{Machine, Pass};
use crate::solver::softness::Softness;
use crate::solver::wide::Wide;

/// The numbers that sweeps work on.
pub(super) struct Numbers<'a> {
    pub(super) plan: &'a NetPlan,
    pub(super) swept: &'a mut [Lanes],
    pub(super) ground: &'a mut [Lanes],
    /// By block: impulses on b.
    pub(super) impulses: &'a mut Vec<Lanes>,
    /// By body: scaled velocities.
    pub(super) velocities: &'a mut Vec<Lanes>,
    pub(super) chebyshev: &'a mut Chebyshev,
}

/// Before the move: springs, and impulses of the last substep to start from.
pub(super) struct Move<'a, const N: usize> {
    pub(super) numbers: Numbers<'a>,
    pub(super) soft: Softness,
    /// Length of a substep, s.
    pub(super) h: f64,
}

/// After it: what is left of rates.
pub(super) struct Settle<'a, const N: usize> {
    pub(super) numbers: Numbers<'a>,
}

impl<const N: usize> Pass for Move<'_, N> {
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<M: Machine>(self, machine: M) {
        let Self { mut numbers, soft, h } = self;
        start::<N, M>(machine, &mut numbers, soft, h);
        numbers.chebyshev.start(numbers.velocities, numbers.impulses);
        for turn in 1..=FORTH_AND_BACK {
            let Numbers { plan, swept, impulses, velocities, .. } = &mut numbers;
            let mut sweep = Sweep { swept, impulses, velocities, soft };
            // The last colour has just had its turn, and would change nothing on the way back.
            let last = plan.ends.len().checked_sub(2).map_or(0, |colour| plan.ends[colour]);
            sweep.run::<N, M>(machine, plan, (0..plan.blocks.len()).chain((0..last).rev()));
            numbers.chebyshev.extrapolate(machine, numbers.velocities, numbers.impulses, turn);
        }
    }
}

impl<const N: usize> Pass for Settle<'_, N> {
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<M: Machine>(self, machine: M) {
        let Numbers { plan, swept, ground, impulses, velocities, .. } = self.numbers;
        let mut sweep = Sweep { swept, impulses, velocities, soft: Softness::RIGID };
        sweep.run::<N, M>(machine, plan, (0..plan.blocks.len()).rev());
        let ground = ground.chunks_exact_mut(Ground::<N>::LEN);
        for (ground, impulses) in ground.zip(impulses.chunks_exact(N)) {
            add_up::<N, M>(machine, ground, impulses);
        }
    }
}

/// Applies the impulses of the last substep at the present place, and finds what springs ask for.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn start<const N: usize, M: Machine>(machine: M, numbers: &mut Numbers<'_>, soft: Softness, h: f64) {
    let Numbers { plan, swept, ground, impulses, velocities, .. } = numbers;
    let blocks = plan.blocks.iter().zip(swept.chunks_exact_mut(Swept::<N>::LEN));
    let others = ground.chunks_exact(Ground::<N>::LEN).zip(impulses.chunks_exact(N));
    let (compliance, bias_rate) =
        (Wide::splat(machine, soft.compliance() as Real), Wide::splat(machine, soft.bias_rate as Real));
    let (h, one) = (Wide::splat(machine, h as Real), Wide::splat(machine, 1.0));
    let (push_back, least) = (Wide::splat(machine, PUSH_BACK as Real), Wide::splat(machine, Real::MIN_POSITIVE));
    for ((block, swept), (ground, impulses)) in blocks.zip(others) {
        let mut pair = Pair::<N, M>::gather(machine, block, swept, velocities);
        let impulse = load(machine, impulses, 0);
        let before = pair.rate();
        pair.push(&impulse);
        pair.scatter(block, velocities);
        // What the impulse changes the rate by is K λ.
        let after = pair.rate();
        let mut given = impulse;
        let mut back = impulse;
        for i in 0..N {
            given[i] = (after[i] - before[i]) * compliance;
            back[i] = bias_rate * ground[Ground::<N>::GAP + i];
        }
        // What it gives way comes on top, or a great load would open the joint without end.
        let fastest = dot(&given, &given).sqrt() + push_back;
        let wanted = dot(&back, &back).sqrt().max(least);
        let share = fastest.div(wanted).min(one);
        for i in 0..N {
            let rate = h * ground[Ground::<N>::UP + i] + swept[Swept::<N>::RATE + i];
            swept[Swept::<N>::RATE + i] = (rate + share * back[i]).lanes();
        }
    }
}

/// Adds the impulses of a substep to those of the step.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn add_up<const N: usize, M: Machine>(machine: M, ground: &mut [Lanes], impulses: &[Lanes]) {
    let impulse: [Wide<M>; N] = load(machine, impulses, 0);
    let mut gap: [Wide<M>; N] = load(machine, ground, Ground::<N>::GAP);
    let share = ground[Ground::<N>::SHARE];
    let mut k = Ground::<N>::STEP_TWIST;
    for i in 0..N {
        ground[Ground::<N>::STEP_IMPULSE + i] = (impulse[i] + ground[Ground::<N>::STEP_IMPULSE + i]).lanes();
        gap[i] = gap[i] * share;
    }
    for i in 0..N {
        for j in i + 1..N {
            let twist = gap[j] * impulse[i] - gap[i] * impulse[j];
            ground[k] = (twist + ground[k]).lanes();
            k += 1;
        }
    }
}

/// One sweep's numbers.
struct Sweep<'a> {
    swept: &'a [Lanes],
    impulses: &'a mut [Lanes],
    velocities: &'a mut [Lanes],
    soft: Softness,
}

impl Sweep<'_> {
    /// Solves blocks one after the other: λ ← λ − σ K⁻¹ r − τ λ, of a spring as soft in every direction as K.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<const N: usize, M: Machine>(&mut self, machine: M, plan: &NetPlan, blocks: impl Iterator<Item = usize>) {
        let mass_scale = Wide::splat(machine, self.soft.mass_scale as Real);
        let impulse_scale = Wide::splat(machine, self.soft.impulse_scale as Real);
        for index in blocks {
            let block = &plan.blocks[index];
            let swept = &self.swept[index * Swept::<N>::LEN..(index + 1) * Swept::<N>::LEN];
            let impulses = &mut self.impulses[index * N..(index + 1) * N];
            let mut pair = Pair::<N, M>::gather(machine, block, swept, self.velocities);
            let mut rate = pair.rate();
            for i in 0..N {
                rate[i] += swept[Swept::<N>::RATE + i];
            }
            let answer = answer(swept, &rate);
            let mut impulse: [Wide<M>; N] = load(machine, impulses, 0);
            let mut change = impulse;
            for i in 0..N {
                change[i] = -(mass_scale * answer[i] + impulse_scale * impulse[i]);
                impulse[i] += change[i];
            }
            put(impulses, 0, &impulse);
            pair.push(&change);
            pair.scatter(block, self.velocities);
        }
    }
}

/// K⁻¹ times a rate.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn answer<const N: usize, M: Machine>(swept: &[Lanes], rate: &[Wide<M>; N]) -> [Wide<M>; N] {
    let mut answer = *rate;
    let mut inverse = swept[Swept::<N>::INVERSE..Swept::<N>::LEN].iter();
    for (i, lanes) in inverse.by_ref().take(N).enumerate() {
        answer[i] = rate[0] * *lanes;
        if i > 0 {
            answer[0] += rate[i] * *lanes;
        }
    }
    for i in 1..N {
        for (j, lanes) in (i..N).zip(inverse.by_ref()) {
            answer[i] += rate[j] * *lanes;
            if j != i {
                answer[j] += rate[i] * *lanes;
            }
        }
    }
    answer
}

/// Both bodies of eight joints.
struct Pair<const N: usize, M: Machine> {
    a: Side<M>,
    b: Side<M>,
    arm_a: [Wide<M>; N],
    arm_b: [Wide<M>; N],
    mass_a: Wide<M>,
    mass_b: Wide<M>,
}

impl<const N: usize, M: Machine> Pair<N, M> {
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn gather(machine: M, block: &Block, swept: &[Lanes], velocities: &[Lanes]) -> Self {
        Self {
            a: Side::gather::<N>(machine, velocities, &block.a),
            b: Side::gather::<N>(machine, velocities, &block.b),
            arm_a: load(machine, swept, Swept::<N>::ARM_A),
            arm_b: load(machine, swept, Swept::<N>::ARM_B),
            mass_a: swept[Swept::<N>::MASS_A].on(machine),
            mass_b: swept[Swept::<N>::MASS_B].on(machine),
        }
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn scatter(&self, block: &Block, velocities: &mut [Lanes]) {
        self.a.scatter::<N>(velocities, &block.a);
        self.b.scatter::<N>(velocities, &block.b);
    }

    /// Velocity of the anchor on b against that on a, as far as impulses made it.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn rate(&self) -> [Wide<M>; N] {
        let on_a = self.a.velocity(&self.arm_a, self.mass_a);
        let mut rate = self.b.velocity(&self.arm_b, self.mass_b);
        for i in 0..N {
            rate[i] -= on_a[i];
        }
        rate
    }

    /// Applies an impulse on b, and its opposite on a.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn push(&mut self, impulse: &[Wide<M>; N]) {
        let mut opposite = *impulse;
        for i in 0..N {
            opposite[i] = -impulse[i];
        }
        self.a.push(&opposite, &self.arm_a, self.mass_a);
        self.b.push(impulse, &self.arm_b, self.mass_b);
    }
}

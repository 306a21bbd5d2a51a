//! The passes over contact rows: warm start, solve, bounce. This is where the time of a step goes.

use std::marker::PhantomData;

use super::normal::{NormalProblem, upper};
use super::pairing::{Pairing, States};
use super::parts::Parts;
use super::round::RoundPasses;
use super::{Block, Layout};
use crate::solver::bodies::Sizes;
use crate::solver::division::Stretch;
use crate::solver::lanes::{Lanes, Real};
use crate::solver::machine::{Machine, Pass};
use crate::solver::wide::Wide;

/// Where a pass stands in the step: factors on the base part of rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PassTimes {
    /// Base velocity now = velocity + `elapsed` · acceleration.
    pub(crate) elapsed: Real,
    /// Base displacement so far = `moved` · velocity + `moved_sq` · acceleration.
    pub(crate) moved: Real,
    pub(crate) moved_sq: Real,
    /// 1/h.
    pub(crate) inverse_h: Real,
    /// Whether overlap is pushed apart; otherwise the rows only stop approach.
    pub(crate) push: bool,
    /// m.
    pub(crate) slop: Real,
    /// m/s.
    pub(crate) push_out_speed: Real,
    /// m/s; of the bounce.
    pub(crate) restitution_threshold: Real,
}

const MAX: usize = crate::solver::bodies::MAX_PLANES;

/// Applies the impulses that the rows hold.
pub(crate) struct WarmStart<'a, const N: usize> {
    pub(crate) contacts: Stretch<'a, N>,
}

/// One Gauss–Seidel sweep over the manifolds of some blocks.
pub(crate) struct Solve<'a, const N: usize> {
    pub(super) blocks: &'a [Block],
    /// Of these blocks.
    pub(super) rows: &'a mut [Lanes],
    pub(super) problem: &'a mut NormalProblem,
    pub(super) states: States<'a>,
    pub(crate) times: &'a PassTimes,
}

/// Gives back the share e of the approach speed at points that were pressed in this step.
pub(crate) struct Bounce<'a, const N: usize> {
    pub(crate) contacts: Stretch<'a, N>,
    pub(crate) times: &'a PassTimes,
}

impl<const N: usize> Pass for WarmStart<'_, N> {
    #[inline(always)]
    fn run<M: Machine>(self, machine: M) {
        Passes::<N, M>::warm_start(machine, self.contacts);
    }
}

impl<const N: usize> Pass for Solve<'_, N> {
    #[inline(always)]
    fn run<M: Machine>(self, machine: M) {
        Passes::<N, M>::solve(machine, self);
    }
}

impl<const N: usize> Pass for Bounce<'_, N> {
    #[inline(always)]
    fn run<M: Machine>(self, machine: M) {
        Passes::<N, M>::bounce(machine, self.contacts, self.times);
    }
}

/// The passes for one dimension and one machine.
pub(crate) struct Passes<const N: usize, M: Machine>(PhantomData<M>);

impl<const N: usize, M: Machine> Passes<N, M> {
    const K: usize = Sizes::<N>::K;

    #[inline(always)]
    fn warm_start(machine: M, contacts: Stretch<'_, N>) {
        let Stretch { blocks, rows, state, .. } = contacts;
        let mut states = States::InPlace(state);
        let first = blocks.first().map_or(0, |block| block.start);
        for block in blocks {
            let rows = &mut rows[block.start - first..];
            if block.round {
                RoundPasses::<N, M>::warm_start(machine, block, rows, &mut states);
                continue;
            }
            let mut p = Pairing::<N, M>::gather(machine, block, rows, states.read());
            let rows = Parts::cut::<N>(block, block.points, rows);
            for row in rows.slides.chunks_exact(Layout::<N>::SLIDE_ROW) {
                let impulse = row[Layout::<N>::SLIDE_IMPULSE].on(machine);
                p.apply_linear(&row[..N], impulse);
                p.apply_angular(&row[N..N + 2 * Self::K], impulse);
            }
            for row in rows.twists.chunks_exact(Layout::<N>::TWIST_ROW) {
                p.apply_angular(&row[..2 * Self::K], row[Layout::<N>::TWIST_IMPULSE].on(machine));
            }
            let mut sum = [Wide::zero(machine); N];
            for row in rows.points.chunks_exact(Layout::<N>::POINT_ROW) {
                add_at(&mut sum, row[Layout::<N>::POINT_IMPULSE].on(machine), &row[Layout::<N>::POINT_LEVER..]);
            }
            Self::apply_to_field(&rows, &sum, &mut p);
            if block.resists {
                let impulses = &rows.resistance[Layout::<N>::ROLLING_IMPULSES..];
                for (row, impulse) in Self::field(rows.field).skip(1).zip(impulses) {
                    p.apply_angular(row, impulse.on(machine));
                }
            }
            p.scatter(block, &mut states);
        }
    }

    #[inline(always)]
    fn solve(machine: M, pass: Solve<'_, N>) {
        let Solve { blocks, rows, problem, mut states, times } = pass;
        let first = blocks.first().map_or(0, |block| block.start);
        for block in blocks {
            let rows = &mut rows[block.start - first..];
            if block.round {
                RoundPasses::<N, M>::solve(machine, block, rows, &mut states, times);
                continue;
            }
            let mut p = Pairing::<N, M>::gather(machine, block, rows, states.read());
            // Loops of a length that the compiler knows take half the time; of eight points it is as much either way.
            match block.points {
                1 if M::UNROLLS => Self::solve_block(block, rows, 1, &mut p, times, &mut NormalProblem::<1>::default()),
                2 if M::UNROLLS => Self::solve_block(block, rows, 2, &mut p, times, &mut NormalProblem::<2>::default()),
                4 if M::UNROLLS && N > 2 => {
                    Self::solve_block(block, rows, 4, &mut p, times, &mut NormalProblem::<4>::default());
                }
                count => Self::solve_block(block, rows, count, &mut p, times, problem),
            }
            p.scatter(block, &mut states);
        }
    }

    #[inline(always)]
    fn solve_block<const P: usize>(
        block: &Block,
        rows: &mut [Lanes],
        count: usize,
        p: &mut Pairing<N, M>,
        times: &PassTimes,
        problem: &mut NormalProblem<P>,
    ) {
        let machine = p.machine;
        let mut rows = Parts::cut::<N>(block, count, rows);
        // Before the move warm starting has just applied all of it.
        let before = if times.push { [Wide::zero(machine); N] } else { Self::impulse(machine, &rows) };
        // While positions are at stake the normal rows have the last word; afterwards friction has it, with the full
        // load, so that a sliding body loses exactly μ times its weight.
        if times.push {
            Self::rub(block, &mut rows, p, times);
        }
        Self::pose(&rows, p, times, problem);
        Self::press(&mut rows, count, p, problem);
        if !times.push {
            for row in rows.points.chunks_exact_mut(Layout::<N>::POINT_ROW) {
                let sum = row[Layout::<N>::POINT_STEP_IMPULSE].on(machine) + row[Layout::<N>::POINT_IMPULSE];
                row[Layout::<N>::POINT_STEP_IMPULSE] = sum.lanes();
            }
            Self::rub(block, &mut rows, p, times);
        }
        Self::note_excess(&mut rows, &before, p, times);
    }

    #[inline(always)]
    fn rub(block: &Block, rows: &mut Parts<'_>, p: &mut Pairing<N, M>, times: &PassTimes) {
        Self::slide(rows, p, times);
        if !rows.twists.is_empty() {
            let load = Self::load(p.machine, rows.points);
            let resisted = if block.resists { Some(load * rows.resistance[Layout::<N>::TWISTING]) } else { None };
            Self::twist(rows, resisted, p, times);
        }
        if block.resists {
            Self::roll(rows, p, times);
        }
    }

    /// Sum of the impulses of the points.
    #[inline(always)]
    pub(super) fn load(machine: M, points: &[Lanes]) -> Wide<M> {
        let mut load = Wide::zero(machine);
        for row in points.chunks_exact(Layout::<N>::POINT_ROW) {
            load += row[Layout::<N>::POINT_IMPULSE];
        }
        load
    }

    /// What a row measures without the bodies' changes: base velocity by now.
    #[inline(always)]
    pub(super) fn base(velocity: Lanes, acceleration: Lanes, elapsed: Wide<M>) -> Wide<M> {
        elapsed * acceleration + velocity
    }

    /// The share of a wish that stays within a ball of radius `limit`. In parts of the limit, whose square might vanish in
    /// single precision.
    #[inline(always)]
    pub(super) fn share_within(limit: Wide<M>, wanted: &[Wide<M>]) -> Wide<M> {
        let one = Wide::splat(limit.machine(), 1.0);
        let inverse_limit = one.div(limit.max(Wide::splat(limit.machine(), Real::MIN_POSITIVE)));
        let mut ratio_sq = Wide::zero(limit.machine());
        for value in wanted {
            let ratio = *value * inverse_limit;
            ratio_sq += ratio * ratio;
        }
        one.div(ratio_sq.sqrt().max(one))
    }

    /// Resistance to rolling: within the ball of radius c·Σλ in the planes of the normal and the tangents, against the turn.
    #[inline(always)]
    fn roll(rows: &mut Parts<'_>, p: &mut Pairing<N, M>, times: &PassTimes) {
        let machine = p.machine;
        let limit = Self::load(machine, rows.points) * rows.resistance[Layout::<N>::ROLLING];
        let mass = rows.resistance[Layout::<N>::ROLLING_MASS].on(machine);
        let impulses = &mut rows.resistance[Layout::<N>::ROLLING_IMPULSES..];
        let elapsed = Wide::splat(machine, times.elapsed);
        let mut wanted = [Wide::zero(machine); N];
        for ((wanted, row), held) in wanted.iter_mut().zip(Self::field(rows.field).skip(1)).zip(&*impulses) {
            let rate = Self::base(row[Layout::<N>::FIELD_VELOCITY], row[Layout::<N>::FIELD_ACCELERATION], elapsed)
                + p.measure_angular(row);
            *wanted = held.on(machine) - mass * rate;
        }
        let factor = Self::share_within(limit, &wanted[..Layout::<N>::SLIDES]);
        for ((wanted, row), held) in wanted.iter().zip(Self::field(rows.field).skip(1)).zip(impulses) {
            let impulse = *wanted * factor;
            p.apply_angular(row, impulse - *held);
            *held = impulse.lanes();
        }
    }

    #[inline(always)]
    fn slide(rows: &mut Parts<'_>, p: &mut Pairing<N, M>, times: &PassTimes) {
        let machine = p.machine;
        let limit = Self::load(machine, rows.points) * rows.header[Layout::<N>::FRICTION];
        let elapsed = Wide::splat(machine, times.elapsed);
        let slides = Layout::<N>::SLIDES;
        let (rows, masses) = (&mut *rows.slides, &*rows.slide_mass);
        let mut velocity = [Wide::zero(machine); N];
        for (t, row) in rows.chunks_exact(Layout::<N>::SLIDE_ROW).enumerate() {
            velocity[t] = Self::base(row[Layout::<N>::SLIDE_VELOCITY], row[Layout::<N>::SLIDE_ACCELERATION], elapsed)
                + p.measure_linear(&row[..N])
                + p.measure_angular(&row[N..N + 2 * Self::K]);
        }
        // wanted = held − K⁻¹ u, then back into the ball of radius μΣλ.
        let mut wanted = [Wide::zero(machine); N];
        let mut at = 0;
        for s in 0..slides {
            for t in s..slides {
                let mass = masses[at].on(machine);
                at += 1;
                wanted[s] -= mass * velocity[t];
                if t != s {
                    wanted[t] -= mass * velocity[s];
                }
            }
        }
        for (wanted, row) in wanted.iter_mut().zip(rows.chunks_exact(Layout::<N>::SLIDE_ROW)) {
            *wanted += row[Layout::<N>::SLIDE_IMPULSE];
        }
        let factor = Self::share_within(limit, &wanted[..slides]);
        for (wanted, row) in wanted.iter().zip(rows.chunks_exact_mut(Layout::<N>::SLIDE_ROW)) {
            let impulse = *wanted * factor;
            let change = impulse - row[Layout::<N>::SLIDE_IMPULSE];
            row[Layout::<N>::SLIDE_IMPULSE] = impulse.lanes();
            p.apply_linear(&row[..N], change);
            p.apply_angular(&row[N..N + 2 * Self::K], change);
        }
    }

    #[inline(always)]
    fn twist(rows: &mut Parts<'_>, resisted: Option<Wide<M>>, p: &mut Pairing<N, M>, times: &PassTimes) {
        let machine = p.machine;
        let mass = rows.header[Layout::<N>::TWIST_MASS].on(machine);
        let friction = rows.header[Layout::<N>::FRICTION];
        let elapsed = Wide::splat(machine, times.elapsed);
        let (rows, points) = (&mut rows.twists[..Layout::<N>::TWISTS * Layout::<N>::TWIST_ROW], &*rows.points);
        let mut wanted = [Wide::zero(machine); MAX];
        let mut largest = Wide::splat(machine, Real::MIN_POSITIVE);
        for (t, row) in rows.chunks_exact(Layout::<N>::TWIST_ROW).enumerate() {
            let velocity = Self::base(row[Layout::<N>::TWIST_VELOCITY], row[Layout::<N>::TWIST_ACCELERATION], elapsed)
                + p.measure_angular(&row[..2 * Self::K]);
            wanted[t] = row[Layout::<N>::TWIST_IMPULSE].on(machine) - mass * velocity;
            largest = largest.max(wanted[t]).max(-wanted[t]);
        }
        let mut limit = Self::twisting_load(points, &wanted, largest) * friction;
        if let Some(resisted) = resisted {
            limit += resisted * Self::share_of_largest(&wanted, largest);
        }
        let factor = limit.div(largest).min(Wide::splat(machine, 1.0));
        for (t, row) in rows.chunks_exact_mut(Layout::<N>::TWIST_ROW).enumerate() {
            let impulse = wanted[t] * factor;
            let change = impulse - row[Layout::<N>::TWIST_IMPULSE];
            row[Layout::<N>::TWIST_IMPULSE] = impulse.lanes();
            p.apply_angular(&row[..2 * Self::K], change);
        }
    }

    /// The largest part of a twist over its length.
    #[inline(always)]
    fn share_of_largest(twist: &[Wide<M>; MAX], largest: Wide<M>) -> Wide<M> {
        let one = Wide::splat(largest.machine(), 1.0);
        let scale = one.div(largest);
        let mut length_sq = Wide::zero(largest.machine());
        for part in &twist[..Layout::<N>::TWISTS] {
            let part = *part * scale;
            length_sq += part * part;
        }
        one.div(length_sq.max(one).sqrt())
    }

    /// What a unit of friction coefficient can hold against the twist B, in parts of B over `largest`: the points at ρ
    /// rub against their motion B·ρ, which gives the torque Σλ|B·ρ|/|B| in the direction of B. So extent across the
    /// planes of the twist does not count.
    #[inline(always)]
    fn twisting_load(points: &[Lanes], twist: &[Wide<M>; MAX], largest: Wide<M>) -> Wide<M> {
        let machine = largest.machine();
        let (zero, one) = (Wide::zero(machine), Wide::splat(machine, 1.0));
        let slides = Layout::<N>::SLIDES;
        let scale = one.div(largest);
        let mut length_sq = zero;
        let mut unit = [zero; MAX];
        for t in 0..Layout::<N>::TWISTS {
            unit[t] = twist[t] * scale;
            length_sq += unit[t] * unit[t];
        }
        let mut load = zero;
        for row in points.chunks_exact(Layout::<N>::POINT_ROW) {
            let lever = &row[Layout::<N>::POINT_LEVER..];
            let mut motion = [zero; N];
            let mut plane = 0;
            for s in 0..slides {
                for t in s + 1..slides {
                    motion[s] += unit[plane] * lever[t];
                    motion[t] -= unit[plane] * lever[s];
                    plane += 1;
                }
            }
            let mut motion_sq = zero;
            for value in &motion[..slides] {
                motion_sq += *value * *value;
            }
            load += motion_sq.sqrt() * row[Layout::<N>::POINT_IMPULSE];
        }
        load.div(length_sq.max(one))
    }

    /// Poses the problem of a block's normal rows.
    #[inline(always)]
    fn pose<const P: usize>(rows: &Parts<'_>, p: &Pairing<N, M>, times: &PassTimes, problem: &mut NormalProblem<P>) {
        let machine = p.machine;
        let normal = Self::normal(rows);
        let zero = Wide::zero(machine);
        let elapsed = Wide::splat(machine, times.elapsed);
        let (moved, moved_sq) = (Wide::splat(machine, times.moved), Wide::splat(machine, times.moved_sq));
        let (bias_rate, softness) = if times.push {
            (rows.header[Layout::<N>::BIAS_RATE].on(machine), rows.header[Layout::<N>::SOFTNESS].on(machine))
        } else {
            (zero, zero)
        };
        let (mut closed, mut velocities) = ([zero; N], [zero; N]);
        for (t, row) in Self::field(rows.field).enumerate() {
            let (velocity, acceleration) = (row[Layout::<N>::FIELD_VELOCITY], row[Layout::<N>::FIELD_ACCELERATION]);
            closed[t] = moved * velocity + moved_sq * acceleration + p.moved_angular(row);
            velocities[t] = Self::base(velocity, acceleration, elapsed) + p.measure_angular(row);
        }
        closed[0] += p.moved_linear(normal);
        velocities[0] += p.measure_linear(normal);
        for (index, row) in rows.points.chunks_exact(Layout::<N>::POINT_ROW).enumerate() {
            let lever = &row[Layout::<N>::POINT_LEVER..];
            let gap = row[Layout::<N>::POINT_GAP].on(machine) + row[Layout::<N>::POINT_ARC] + value_at(&closed, lever);
            let velocity = value_at(&velocities, lever);
            problem.excess[index] = (velocity + Self::bias(gap, bias_rate, times)).lanes();
            problem.softness[index] = gap.select_positive(zero, softness).lanes();
        }
    }

    /// What a row of the given gap may approach by beside its velocity. Ahead of touching: approach may close the gap within
    /// the substep. Overlapping: pushed apart softly.
    #[inline(always)]
    pub(super) fn bias(gap: Wide<M>, bias_rate: Wide<M>, times: &PassTimes) -> Wide<M> {
        let machine = gap.machine();
        let overlap = (gap + Wide::splat(machine, times.slop)).min(Wide::zero(machine));
        let push_limit = Wide::splat(machine, -times.push_out_speed);
        gap.select_positive(gap * Wide::splat(machine, times.inverse_h), (bias_rate * overlap).max(push_limit))
    }

    /// The rows of the normal field.
    #[inline(always)]
    fn field(rows: &[Lanes]) -> std::slice::ChunksExact<'_, Lanes> {
        rows.chunks_exact(Layout::<N>::FIELD_ROW)
    }

    #[inline(always)]
    fn normal<'a>(rows: &'a Parts<'_>) -> &'a [Lanes] {
        &rows.header[Layout::<N>::NORMAL..Layout::<N>::NORMAL + N]
    }

    /// Applies impulses along the normal: their sum, and their moments along the tangents.
    #[inline(always)]
    fn apply_to_field(rows: &Parts<'_>, sum: &[Wide<M>; N], p: &mut Pairing<N, M>) {
        for (row, impulse) in Self::field(rows.field).zip(sum) {
            p.apply_angular(row, *impulse);
        }
        p.apply_linear(Self::normal(rows), sum[0]);
    }

    /// Solves it and applies the change of impulses.
    #[inline(always)]
    fn press<const P: usize>(
        rows: &mut Parts<'_>,
        count: usize,
        p: &mut Pairing<N, M>,
        problem: &mut NormalProblem<P>,
    ) {
        let machine = p.machine;
        let (zero, one) = (Wide::zero(machine), Wide::splat(machine, 1.0));
        for (index, row) in rows.points.chunks_exact(Layout::<N>::POINT_ROW).enumerate() {
            problem.held[index] = row[Layout::<N>::POINT_IMPULSE];
            // Lanes with fewer points have no response there.
            let response = rows.response[upper(count, index, index)].on(machine);
            problem.allowed[index] = response.select_positive(one, zero).lanes();
        }
        problem.solve(machine, rows.response, count, rows.header[Layout::<N>::STIFFENER]);
        Self::apply_solution(rows, p, problem);
    }

    #[inline(always)]
    fn apply_solution<const P: usize>(rows: &mut Parts<'_>, p: &mut Pairing<N, M>, problem: &NormalProblem<P>) {
        let mut sum = [Wide::zero(p.machine); N];
        for (index, row) in rows.points.chunks_exact_mut(Layout::<N>::POINT_ROW).enumerate() {
            let impulse = problem.impulse[index];
            row[Layout::<N>::POINT_IMPULSE] = impulse;
            add_at(&mut sum, impulse.on(p.machine) - problem.held[index], &row[Layout::<N>::POINT_LEVER..]);
        }
        Self::apply_to_field(rows, &sum, p);
    }

    #[inline(always)]
    fn bounce(machine: M, contacts: Stretch<'_, N>, times: &PassTimes) {
        let Stretch { blocks, rows, state, problems, .. } = contacts;
        let [problem, ..] = problems else { return };
        let mut states = States::InPlace(state);
        let first = blocks.first().map_or(0, |block| block.start);
        for block in blocks.iter().filter(|block| block.bounces) {
            let rows = &mut rows[block.start - first..];
            if block.round {
                RoundPasses::<N, M>::bounce(machine, block, rows, &mut states, times);
                continue;
            }
            let mut p = Pairing::<N, M>::gather(machine, block, rows, states.read());
            let mut rows = Parts::cut::<N>(block, block.points, rows);
            let before = Self::impulse(machine, &rows);
            Self::pose_bounce(&rows, &p, times, problem);
            problem.solve(machine, rows.response, block.points, rows.header[Layout::<N>::STIFFENER]);
            // Lanes that don't bounce keep what they have.
            let restitution = rows.header[Layout::<N>::RESTITUTION].on(machine);
            for (index, row) in rows.points.chunks_exact_mut(Layout::<N>::POINT_ROW).enumerate() {
                let (solved, held) = (problem.impulse[index].on(machine), problem.held[index].on(machine));
                let impulse = restitution.select_positive(solved, held);
                problem.impulse[index] = impulse.lanes();
                let sum = row[Layout::<N>::POINT_STEP_IMPULSE].on(machine) + (impulse - held);
                row[Layout::<N>::POINT_STEP_IMPULSE] = sum.lanes();
            }
            Self::apply_solution(&mut rows, &mut p, problem);
            Self::note_excess(&mut rows, &before, &p, times);
            p.scatter(block, &mut states);
        }
    }

    /// Poses the problem of a block's bounces.
    #[inline(always)]
    fn pose_bounce(rows: &Parts<'_>, p: &Pairing<N, M>, times: &PassTimes, problem: &mut NormalProblem) {
        let zero = Wide::zero(p.machine);
        let restitution = rows.header[Layout::<N>::RESTITUTION].on(p.machine);
        let (mut starts, mut accelerations, mut changes) = ([zero; N], [zero; N], [zero; N]);
        for (t, row) in Self::field(rows.field).enumerate() {
            starts[t] = row[Layout::<N>::FIELD_VELOCITY].on(p.machine);
            accelerations[t] = row[Layout::<N>::FIELD_ACCELERATION].on(p.machine);
            changes[t] = p.measure_angular(row);
        }
        changes[0] += p.measure_linear(Self::normal(rows));
        for (index, row) in rows.points.chunks_exact(Layout::<N>::POINT_ROW).enumerate() {
            let lever = &row[Layout::<N>::POINT_LEVER..];
            let gap = row[Layout::<N>::POINT_GAP].on(p.machine);
            let of_row = (value_at(&starts, lever), value_at(&accelerations, lever), gap);
            let (excess, fast) = Self::bounce_of(of_row, restitution, value_at(&changes, lever), times);
            problem.excess[index] = excess.lanes();
            problem.softness[index] = Lanes::ZERO;
            let held = row[Layout::<N>::POINT_IMPULSE];
            problem.held[index] = held;
            let step_impulse = row[Layout::<N>::POINT_STEP_IMPULSE].on(p.machine);
            problem.allowed[index] = Self::may_press(fast, step_impulse, held.on(p.machine)).lanes();
        }
    }

    /// What a row should lose for the bounce, and the share of its approach that it gives back: zero where it is slow. Of
    /// the row: base velocity at the start of the step, acceleration, gap; `change` is what impulses have made of it.
    #[inline(always)]
    pub(super) fn bounce_of(
        (at_start, acceleration, gap): (Wide<M>, Wide<M>, Wide<M>),
        restitution: Wide<M>,
        change: Wide<M>,
        times: &PassTimes,
    ) -> (Wide<M>, Wide<M>) {
        let machine = gap.machine();
        let zero = Wide::zero(machine);
        // Between the start of the step and the touch the body falls on; without this, a ball that gives back all
        // of its speed would lose what it gained over that gap at every bounce.
        let gained = Wide::splat(machine, -2.0) * acceleration * gap.max(zero);
        let approach = -(at_start * at_start + gained).max(zero).sqrt();
        let velocity = at_start + Wide::splat(machine, times.elapsed) * acceleration + change;
        let threshold = Wide::splat(machine, -times.restitution_threshold);
        let fast = (threshold - at_start).select_positive(restitution, zero);
        (velocity + fast * approach, fast)
    }

    /// One where a point may press at the bounce: what was met in this step bounces; what presses and is slow must go on
    /// pressing.
    #[inline(always)]
    pub(super) fn may_press(fast: Wide<M>, step_impulse: Wide<M>, held: Wide<M>) -> Wide<M> {
        let (zero, one) = (Wide::zero(fast.machine()), Wide::splat(fast.machine(), 1.0));
        fast.select_positive(step_impulse, held).select_positive(one, zero)
    }
}

/// Value of an affine field at a place along the tangents: its value at the centre, and its slopes.
#[inline(always)]
fn value_at<const N: usize, M: Machine>(field: &[Wide<M>; N], place: &[Lanes]) -> Wide<M> {
    let mut value = field[0];
    for (slope, along) in field[1..].iter().zip(place) {
        value += *slope * *along;
    }
    value
}

/// Adds an impulse at a place to a sum of impulses and their moments along the tangents.
#[inline(always)]
fn add_at<const N: usize, M: Machine>(sum: &mut [Wide<M>; N], impulse: Wide<M>, place: &[Lanes]) {
    sum[0] += impulse;
    for (moment, along) in sum[1..].iter_mut().zip(place) {
        *moment += impulse * *along;
    }
}

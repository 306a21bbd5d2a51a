//! The passes over contact rows: warm start, solve, bounce. This is where the time of a step goes.

use super::normal::{NormalProblem, upper};
use super::pairing::Pairing;
use super::{Block, ContactRows, Layout};
use crate::solver::bodies::Sizes;
use crate::solver::lanes::{Lanes, Real};
use crate::solver::width::WidePass;

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
    pub(crate) contacts: &'a mut ContactRows,
    pub(crate) state: &'a mut [Real],
}

/// One Gauss–Seidel sweep over all manifolds.
pub(crate) struct Solve<'a, const N: usize> {
    pub(crate) contacts: &'a mut ContactRows,
    pub(crate) state: &'a mut [Real],
    pub(crate) times: &'a PassTimes,
}

/// Gives back the share e of the approach speed at points that were pressed in this step.
pub(crate) struct Bounce<'a, const N: usize> {
    pub(crate) contacts: &'a mut ContactRows,
    pub(crate) state: &'a mut [Real],
    pub(crate) times: &'a PassTimes,
}

impl<const N: usize> WidePass for WarmStart<'_, N> {
    #[inline(always)]
    fn run(self) {
        Passes::<N>::warm_start(self.contacts, self.state);
    }
}

impl<const N: usize> WidePass for Solve<'_, N> {
    #[inline(always)]
    fn run(self) {
        Passes::<N>::solve(self.contacts, self.state, self.times);
    }
}

impl<const N: usize> WidePass for Bounce<'_, N> {
    #[inline(always)]
    fn run(self) {
        Passes::<N>::bounce(self.contacts, self.state, self.times);
    }
}

/// The passes for one dimension.
pub(crate) struct Passes<const N: usize>;

impl<const N: usize> Passes<N> {
    const K: usize = Sizes::<N>::K;

    #[inline(always)]
    fn warm_start(contacts: &mut ContactRows, state: &mut [Real]) {
        for block in &contacts.blocks {
            let rows = &contacts.rows[block.start..block.start + Layout::<N>::block_len(block)];
            let mut p = Pairing::<N>::gather(block, rows, state);
            for row in rows[Layout::<N>::HEADER..Layout::<N>::SLIDE_MASS].chunks_exact(Layout::<N>::SLIDE_ROW) {
                let impulse = row[Layout::<N>::SLIDE_IMPULSE];
                p.apply_linear(&row[..N], impulse);
                p.apply_angular(&row[N..N + 2 * Self::K], impulse);
            }
            let (field_start, points_start) = (Layout::<N>::field_start(block), Layout::<N>::points_start(block));
            for row in rows[Layout::<N>::TWIST_ROWS..field_start].chunks_exact(Layout::<N>::TWIST_ROW) {
                p.apply_angular(&row[..2 * Self::K], row[Layout::<N>::TWIST_IMPULSE]);
            }
            let (head, points) = rows.split_at(points_start);
            let mut sum = [Lanes::ZERO; N];
            let end = block.points * Layout::<N>::POINT_ROW;
            for row in points[..end].chunks_exact(Layout::<N>::POINT_ROW) {
                add_at(&mut sum, row[Layout::<N>::POINT_IMPULSE], &row[Layout::<N>::POINT_LEVER..]);
            }
            Self::apply_to_field(block, head, &sum, &mut p);
            if block.resists {
                let resistance = &rows[Layout::<N>::resistance_start(block)..];
                let impulses = &resistance[Layout::<N>::ROLLING_IMPULSES..];
                for (row, impulse) in Self::field(block, head).skip(1).zip(impulses) {
                    p.apply_angular(row, *impulse);
                }
            }
            p.scatter(block, state);
        }
    }

    #[inline(always)]
    fn solve(contacts: &mut ContactRows, state: &mut [Real], times: &PassTimes) {
        let ContactRows { blocks, rows, problem } = contacts;
        for block in blocks.iter() {
            let rows = &mut rows[block.start..block.start + Layout::<N>::block_len(block)];
            let mut p = Pairing::<N>::gather(block, rows, state);
            let (head, rest) = rows.split_at_mut(Layout::<N>::points_start(block));
            let (points, rest) = rest.split_at_mut(block.points * Layout::<N>::POINT_ROW);
            let (response, resistance) = rest.split_at_mut(block.points * (block.points + 1) / 2);
            let displacement = Pairing::<N>::gather_displacement(block, head, state);
            // Before the move warm starting has just applied all of it.
            let before = if times.push { [Lanes::ZERO; N] } else { Self::impulse(head, points) };
            // While positions are at stake the normal rows have the last word; afterwards friction has it, with the full
            // load, so that a sliding body loses exactly μ times its weight.
            if times.push {
                Self::rub(block, head, points, resistance, &mut p, times);
            }
            Self::pose(block, head, points, &p, times, &displacement, problem);
            Self::press(block, head, points, response, &mut p, problem);
            if !times.push {
                for row in points.chunks_exact_mut(Layout::<N>::POINT_ROW) {
                    let impulse = row[Layout::<N>::POINT_IMPULSE];
                    row[Layout::<N>::POINT_STEP_IMPULSE] += impulse;
                }
                Self::rub(block, head, points, resistance, &mut p, times);
            }
            Self::note_excess(head, points, &before, &displacement, times);
            p.scatter(block, state);
        }
    }

    #[inline(always)]
    fn rub(
        block: &Block,
        head: &mut [Lanes],
        points: &[Lanes],
        resistance: &mut [Lanes],
        p: &mut Pairing<N>,
        times: &PassTimes,
    ) {
        Self::slide(head, points, p, times);
        if block.twists > 0 {
            let resisted = block.resists.then(|| resistance[Layout::<N>::TWISTING] * Self::load(points));
            Self::twist(head, points, resisted, p, times);
        }
        if block.resists {
            Self::roll(block, head, points, resistance, p, times);
        }
    }

    /// Sum of the impulses of the points.
    #[inline(always)]
    pub(super) fn load(points: &[Lanes]) -> Lanes {
        let mut load = Lanes::ZERO;
        for row in points.chunks_exact(Layout::<N>::POINT_ROW) {
            load += row[Layout::<N>::POINT_IMPULSE];
        }
        load
    }

    /// Resistance to rolling: within the ball of radius c·Σλ in the planes of the normal and the tangents, against the turn.
    #[inline(always)]
    fn roll(
        block: &Block,
        head: &[Lanes],
        points: &[Lanes],
        resistance: &mut [Lanes],
        p: &mut Pairing<N>,
        times: &PassTimes,
    ) {
        let limit = resistance[Layout::<N>::ROLLING] * Self::load(points);
        let mass = resistance[Layout::<N>::ROLLING_MASS];
        let impulses = &mut resistance[Layout::<N>::ROLLING_IMPULSES..];
        let elapsed = Lanes::splat(times.elapsed);
        let inverse_limit = Lanes::splat(1.0).div(limit.max(Lanes::splat(Real::MIN_POSITIVE)));
        let mut wanted = [Lanes::ZERO; N];
        let mut ratio_sq = Lanes::ZERO;
        for ((wanted, row), held) in wanted.iter_mut().zip(Self::field(block, head).skip(1)).zip(&*impulses) {
            let rate = row[Layout::<N>::FIELD_VELOCITY]
                + elapsed * row[Layout::<N>::FIELD_ACCELERATION]
                + p.measure_angular(row);
            *wanted = *held - mass * rate;
            let ratio = *wanted * inverse_limit;
            ratio_sq += ratio * ratio;
        }
        let factor = Lanes::splat(1.0).div(ratio_sq.sqrt().max(Lanes::splat(1.0)));
        for ((wanted, row), held) in wanted.iter().zip(Self::field(block, head).skip(1)).zip(impulses) {
            let impulse = *wanted * factor;
            p.apply_angular(row, impulse - *held);
            *held = impulse;
        }
    }

    #[inline(always)]
    fn slide(head: &mut [Lanes], points: &[Lanes], p: &mut Pairing<N>, times: &PassTimes) {
        let limit = head[Layout::<N>::FRICTION] * Self::load(points);
        let elapsed = Lanes::splat(times.elapsed);
        let slides = Layout::<N>::SLIDES;
        let (rows, masses) = head[Layout::<N>::HEADER..].split_at_mut(slides * Layout::<N>::SLIDE_ROW);
        let mut velocity = [Lanes::ZERO; N];
        for (t, row) in rows.chunks_exact(Layout::<N>::SLIDE_ROW).enumerate() {
            velocity[t] = row[Layout::<N>::SLIDE_VELOCITY]
                + elapsed * row[Layout::<N>::SLIDE_ACCELERATION]
                + p.measure_linear(&row[..N])
                + p.measure_angular(&row[N..N + 2 * Self::K]);
        }
        // wanted = held − K⁻¹ u, then back into the ball of radius μΣλ.
        let mut wanted = [Lanes::ZERO; N];
        let mut at = 0;
        for s in 0..slides {
            for t in s..slides {
                let mass = masses[at];
                at += 1;
                wanted[s] -= mass * velocity[t];
                if t != s {
                    wanted[t] -= mass * velocity[s];
                }
            }
        }
        // In parts of the limit, whose square might vanish in single precision.
        let inverse_limit = Lanes::splat(1.0).div(limit.max(Lanes::splat(Real::MIN_POSITIVE)));
        let mut ratio_sq = Lanes::ZERO;
        for (t, row) in rows.chunks_exact(Layout::<N>::SLIDE_ROW).enumerate() {
            wanted[t] += row[Layout::<N>::SLIDE_IMPULSE];
            let ratio = wanted[t] * inverse_limit;
            ratio_sq += ratio * ratio;
        }
        let factor = Lanes::splat(1.0).div(ratio_sq.sqrt().max(Lanes::splat(1.0)));
        for (t, row) in rows.chunks_exact_mut(Layout::<N>::SLIDE_ROW).enumerate() {
            let impulse = wanted[t] * factor;
            let change = impulse - row[Layout::<N>::SLIDE_IMPULSE];
            row[Layout::<N>::SLIDE_IMPULSE] = impulse;
            p.apply_linear(&row[..N], change);
            p.apply_angular(&row[N..N + 2 * Self::K], change);
        }
    }

    #[inline(always)]
    fn twist(head: &mut [Lanes], points: &[Lanes], resisted: Option<Lanes>, p: &mut Pairing<N>, times: &PassTimes) {
        let (friction, mass) = (head[Layout::<N>::FRICTION], head[Layout::<N>::TWIST_MASS]);
        let elapsed = Lanes::splat(times.elapsed);
        let rows =
            &mut head[Layout::<N>::TWIST_ROWS..Layout::<N>::TWIST_ROWS + Layout::<N>::TWISTS * Layout::<N>::TWIST_ROW];
        let mut wanted = [Lanes::ZERO; MAX];
        let mut largest = Lanes::splat(Real::MIN_POSITIVE);
        for (t, row) in rows.chunks_exact(Layout::<N>::TWIST_ROW).enumerate() {
            let velocity = row[Layout::<N>::TWIST_VELOCITY]
                + elapsed * row[Layout::<N>::TWIST_ACCELERATION]
                + p.measure_angular(&row[..2 * Self::K]);
            wanted[t] = row[Layout::<N>::TWIST_IMPULSE] - mass * velocity;
            largest = largest.max(wanted[t]).max(-wanted[t]);
        }
        let mut limit = friction * Self::twisting_load(points, &wanted, largest);
        if let Some(resisted) = resisted {
            limit += resisted * Self::share_of_largest(&wanted, largest);
        }
        let factor = limit.div(largest).min(Lanes::splat(1.0));
        for (t, row) in rows.chunks_exact_mut(Layout::<N>::TWIST_ROW).enumerate() {
            let impulse = wanted[t] * factor;
            let change = impulse - row[Layout::<N>::TWIST_IMPULSE];
            row[Layout::<N>::TWIST_IMPULSE] = impulse;
            p.apply_angular(&row[..2 * Self::K], change);
        }
    }

    /// The largest part of a twist over its length.
    #[inline(always)]
    fn share_of_largest(twist: &[Lanes; MAX], largest: Lanes) -> Lanes {
        let scale = Lanes::splat(1.0).div(largest);
        let mut length_sq = Lanes::ZERO;
        for part in &twist[..Layout::<N>::TWISTS] {
            let part = *part * scale;
            length_sq += part * part;
        }
        Lanes::splat(1.0).div(length_sq.max(Lanes::splat(1.0)).sqrt())
    }

    /// What a unit of friction coefficient can hold against the twist B, in parts of B over `largest`: the points at ρ
    /// rub against their motion B·ρ, which gives the torque Σλ|B·ρ|/|B| in the direction of B. So extent across the
    /// planes of the twist does not count.
    #[inline(always)]
    fn twisting_load(points: &[Lanes], twist: &[Lanes; MAX], largest: Lanes) -> Lanes {
        let slides = Layout::<N>::SLIDES;
        let scale = Lanes::splat(1.0).div(largest);
        let mut length_sq = Lanes::ZERO;
        let mut unit = [Lanes::ZERO; MAX];
        for t in 0..Layout::<N>::TWISTS {
            unit[t] = twist[t] * scale;
            length_sq += unit[t] * unit[t];
        }
        let mut load = Lanes::ZERO;
        for row in points.chunks_exact(Layout::<N>::POINT_ROW) {
            let lever = &row[Layout::<N>::POINT_LEVER..];
            let mut motion = [Lanes::ZERO; N];
            let mut plane = 0;
            for s in 0..slides {
                for t in s + 1..slides {
                    motion[s] += unit[plane] * lever[t];
                    motion[t] -= unit[plane] * lever[s];
                    plane += 1;
                }
            }
            let mut motion_sq = Lanes::ZERO;
            for value in &motion[..slides] {
                motion_sq += *value * *value;
            }
            load += row[Layout::<N>::POINT_IMPULSE] * motion_sq.sqrt();
        }
        load.div(length_sq.max(Lanes::splat(1.0)))
    }

    /// Poses the problem of a block's normal rows.
    #[inline(always)]
    fn pose(
        block: &Block,
        head: &[Lanes],
        points: &[Lanes],
        p: &Pairing<N>,
        times: &PassTimes,
        displacement: &Pairing<N>,
        problem: &mut NormalProblem,
    ) {
        let normal = &head[Layout::<N>::NORMAL..Layout::<N>::NORMAL + N];
        let zero = Lanes::ZERO;
        let elapsed = Lanes::splat(times.elapsed);
        let (moved, moved_sq) = (Lanes::splat(times.moved), Lanes::splat(times.moved_sq));
        let inverse_h = Lanes::splat(times.inverse_h);
        let (bias_rate, softness) =
            if times.push { (head[Layout::<N>::BIAS_RATE], head[Layout::<N>::SOFTNESS]) } else { (zero, zero) };
        let slop = Lanes::splat(times.slop);
        let push_limit = Lanes::splat(-times.push_out_speed);
        let (mut closed, mut velocities) = ([zero; N], [zero; N]);
        for (t, row) in Self::field(block, head).enumerate() {
            let (velocity, acceleration) = (row[Layout::<N>::FIELD_VELOCITY], row[Layout::<N>::FIELD_ACCELERATION]);
            closed[t] = moved * velocity + moved_sq * acceleration + displacement.measure_angular(row);
            velocities[t] = velocity + elapsed * acceleration + p.measure_angular(row);
        }
        closed[0] += displacement.measure_linear(normal);
        velocities[0] += p.measure_linear(normal);
        for (index, row) in points.chunks_exact(Layout::<N>::POINT_ROW).enumerate() {
            let lever = &row[Layout::<N>::POINT_LEVER..];
            let gap = row[Layout::<N>::POINT_GAP] + row[Layout::<N>::POINT_ARC] + value_at(&closed, lever);
            let velocity = value_at(&velocities, lever);
            // Ahead of touching: approach may close the gap within the substep. Overlapping: pushed apart softly.
            let overlap = (gap + slop).min(zero);
            let bias = gap.select_positive(gap * inverse_h, (bias_rate * overlap).max(push_limit));
            problem.excess[index] = velocity + bias;
            problem.softness[index] = gap.select_positive(zero, softness);
        }
    }

    /// The rows of the normal field.
    #[inline(always)]
    fn field<'a>(block: &Block, head: &'a [Lanes]) -> std::slice::ChunksExact<'a, Lanes> {
        head[Layout::<N>::field_start(block)..].chunks_exact(Layout::<N>::FIELD_ROW)
    }

    /// Applies impulses along the normal: their sum, and their moments along the tangents.
    #[inline(always)]
    fn apply_to_field(block: &Block, head: &[Lanes], sum: &[Lanes; N], p: &mut Pairing<N>) {
        for (row, impulse) in Self::field(block, head).zip(sum) {
            p.apply_angular(row, *impulse);
        }
        p.apply_linear(&head[Layout::<N>::NORMAL..Layout::<N>::NORMAL + N], sum[0]);
    }

    /// Solves it and applies the change of impulses.
    #[inline(always)]
    fn press(
        block: &Block,
        head: &[Lanes],
        points: &mut [Lanes],
        response: &[Lanes],
        p: &mut Pairing<N>,
        problem: &mut NormalProblem,
    ) {
        let (zero, one) = (Lanes::ZERO, Lanes::splat(1.0));
        for (index, row) in points.chunks_exact(Layout::<N>::POINT_ROW).enumerate() {
            problem.held[index] = row[Layout::<N>::POINT_IMPULSE];
            // Lanes with fewer points have no response there.
            problem.allowed[index] = response[upper(block.points, index, index)].select_positive(one, zero);
        }
        problem.solve(response, block.points, head[Layout::<N>::STIFFENER]);
        Self::apply_solution(block, head, points, p, problem);
    }

    #[inline(always)]
    fn apply_solution(
        block: &Block,
        head: &[Lanes],
        points: &mut [Lanes],
        p: &mut Pairing<N>,
        problem: &NormalProblem,
    ) {
        let mut sum = [Lanes::ZERO; N];
        for (index, row) in points.chunks_exact_mut(Layout::<N>::POINT_ROW).enumerate() {
            let impulse = problem.impulse[index];
            row[Layout::<N>::POINT_IMPULSE] = impulse;
            add_at(&mut sum, impulse - problem.held[index], &row[Layout::<N>::POINT_LEVER..]);
        }
        Self::apply_to_field(block, head, &sum, p);
    }

    #[inline(always)]
    fn bounce(contacts: &mut ContactRows, state: &mut [Real], times: &PassTimes) {
        let ContactRows { blocks, rows, problem } = contacts;
        let (zero, one) = (Lanes::ZERO, Lanes::splat(1.0));
        let elapsed = Lanes::splat(times.elapsed);
        let threshold = Lanes::splat(-times.restitution_threshold);
        for block in blocks.iter().filter(|block| block.bounces) {
            let rows = &mut rows[block.start..block.start + Layout::<N>::block_len(block)];
            let mut p = Pairing::<N>::gather(block, rows, state);
            let (head, rest) = rows.split_at_mut(Layout::<N>::points_start(block));
            let (points, rest) = rest.split_at_mut(block.points * Layout::<N>::POINT_ROW);
            let response = &rest[..block.points * (block.points + 1) / 2];
            let displacement = Pairing::<N>::gather_displacement(block, head, state);
            let before = Self::impulse(head, points);
            let restitution = head[Layout::<N>::RESTITUTION];
            let (mut starts, mut accelerations, mut changes) = ([zero; N], [zero; N], [zero; N]);
            for (t, row) in Self::field(block, head).enumerate() {
                starts[t] = row[Layout::<N>::FIELD_VELOCITY];
                accelerations[t] = row[Layout::<N>::FIELD_ACCELERATION];
                changes[t] = p.measure_angular(row);
            }
            changes[0] += p.measure_linear(&head[Layout::<N>::NORMAL..Layout::<N>::NORMAL + N]);
            for (index, row) in points.chunks_exact(Layout::<N>::POINT_ROW).enumerate() {
                let lever = &row[Layout::<N>::POINT_LEVER..];
                let (at_start, acceleration) = (value_at(&starts, lever), value_at(&accelerations, lever));
                // Between the start of the step and the touch the body falls on; without this, a ball that gives back all
                // of its speed would lose what it gained over that gap at every bounce.
                let gap = row[Layout::<N>::POINT_GAP].max(zero);
                let gained = Lanes::splat(-2.0) * acceleration * gap;
                let approach = -(at_start * at_start + gained).max(zero).sqrt();
                let velocity = at_start + elapsed * acceleration + value_at(&changes, lever);
                let fast = (threshold - at_start).select_positive(restitution, zero);
                problem.excess[index] = velocity + fast * approach;
                problem.softness[index] = zero;
                problem.held[index] = row[Layout::<N>::POINT_IMPULSE];
                // What was met in this step bounces; what presses and is slow must go on pressing.
                let met = row[Layout::<N>::POINT_STEP_IMPULSE].select_positive(one, zero);
                let presses = row[Layout::<N>::POINT_IMPULSE].select_positive(one, zero);
                problem.allowed[index] = fast.select_positive(met, presses);
            }
            problem.solve(response, block.points, head[Layout::<N>::STIFFENER]);
            // Lanes that don't bounce keep what they have.
            for index in 0..block.points {
                problem.impulse[index] = restitution.select_positive(problem.impulse[index], problem.held[index]);
            }
            for (index, row) in points.chunks_exact_mut(Layout::<N>::POINT_ROW).enumerate() {
                row[Layout::<N>::POINT_STEP_IMPULSE] += problem.impulse[index] - problem.held[index];
            }
            Self::apply_solution(block, head, points, &mut p, problem);
            Self::note_excess(head, points, &before, &displacement, times);
            p.scatter(block, state);
        }
    }
}

/// Value of an affine field at a place along the tangents: its value at the centre, and its slopes.
#[inline(always)]
fn value_at<const N: usize>(field: &[Lanes; N], place: &[Lanes]) -> Lanes {
    let mut value = field[0];
    for (slope, along) in field[1..].iter().zip(place) {
        value += *slope * *along;
    }
    value
}

/// Adds an impulse at a place to a sum of impulses and their moments along the tangents.
#[inline(always)]
fn add_at<const N: usize>(sum: &mut [Lanes; N], impulse: Lanes, place: &[Lanes]) {
    sum[0] += impulse;
    for (moment, along) in sum[1..].iter_mut().zip(place) {
        *moment += impulse * *along;
    }
}

//! Contacts of balls: of a ball with a ball, or with what no impulse moves.
//!
//! Their arms lie along the normal n: r_a = ρ_a n and r_b = ρ_b n. So a push along n turns neither body, the mass against
//! sliding is the same in all directions, 1/m_a + 1/m_b + ρ_a²/I_a + ρ_b²/I_b, and the normal and friction don't see each
//! other. No tangents are chosen, no rows of arms stored: both spins act on n as one bivector W = ρ_b ω_b − ρ_a ω_a. A block
//! takes a third of the memory of the general rows, and a pass a fifth of their arithmetic.

use std::marker::PhantomData;

use hyperbody_math::{Bivector, Vector};

use super::gather::Gathered;
use super::pairing::{Pairing, States};
use super::prepare::{BaseMotion, inverse_sqrt_masses};
use super::solve::{PassTimes, Passes};
use super::{Block, Layout};
use crate::pairs::Contact;
use crate::solver::bodies::Sizes;
use crate::solver::lanes::Lanes;
use crate::solver::machine::Machine;
use crate::solver::part::Place;
use crate::solver::vectors::Vectors;
use crate::solver::wide::Wide;

/// Where each number of such a block stands.
pub(crate) struct RoundLayout<const N: usize>;

impl<const N: usize> RoundLayout<N> {
    /// The coefficients stand where the general rows have them, see [`Layout`].
    const FIRST: usize = Layout::<N>::COEFFICIENTS;
    /// ρ/√I of both bodies, along the normal.
    const ARM_A: usize = Self::FIRST;
    const ARM_B: usize = Self::FIRST + 1;
    /// 1/m_a + 1/m_b; zero in lanes that hold no contact.
    const INVERSE_MASS: usize = Self::FIRST + 2;
    const SLIDE_MASS: usize = Self::FIRST + 3;
    const GAP: usize = Self::FIRST + 4;
    const IMPULSE: usize = Self::FIRST + 5;
    const STEP_IMPULSE: usize = Self::FIRST + 6;
    pub(crate) const ARC: usize = Self::FIRST + 7;
    /// Base velocity of b against a along the normal, and acceleration.
    const NORMAL_VELOCITY: usize = Self::FIRST + 8;
    const NORMAL_ACCELERATION: usize = Self::FIRST + 9;
    const NORMAL: usize = Self::FIRST + 10;
    /// The same across the normal.
    const VELOCITY: usize = Self::NORMAL + N;
    const ACCELERATION: usize = Self::VELOCITY + N;
    /// Of b's centre against a's.
    const CENTRE_VELOCITY: usize = Self::ACCELERATION + N;
    const CENTRE_ACCELERATION: usize = Self::CENTRE_VELOCITY + N;
    const FRICTION_IMPULSE: usize = Self::CENTRE_ACCELERATION + N;
    pub(crate) const EXCESS: usize = Self::FRICTION_IMPULSE + N;
    pub(crate) const LEN: usize = Self::EXCESS + Sizes::<N>::K;

    /// Sets what adds up from substep to substep to nothing.
    #[inline(always)]
    pub(super) fn start_sums(rows: &mut [Lanes]) {
        rows[Self::STEP_IMPULSE] = Lanes::ZERO;
        rows[Self::ARC] = Lanes::ZERO;
        rows[Self::EXCESS..Self::LEN].fill(Lanes::ZERO);
    }
}

/// The passes over blocks of balls, for one dimension and one machine.
pub(super) struct RoundPasses<const N: usize, M: Machine>(PhantomData<M>);

/// What a pass has found out about a block.
struct Solved<const N: usize, M: Machine> {
    /// The whole impulse on b, and what of it is new.
    impulse: [Wide<M>; N],
    change: [Wide<M>; N],
    /// The part of the change that turns the bodies: along the tangents.
    sliding: [Wide<M>; N],
}

impl<const N: usize, M: Machine> RoundPasses<N, M> {
    /// Makes the rows of a block, all but the coefficients.
    #[inline(always)]
    pub(super) fn prepare(place: Place<M>, rows: &mut [Lanes], gathered: &Gathered<N>) {
        let rows = &mut rows[..RoundLayout::<N>::LEN];
        let point = &gathered.points[0];
        let normal = Vectors::load(place, &gathered.normal);
        let position = Vectors::load(place, &point.position);
        let offset_a = position - Vectors::load(place, &gathered.a.centre);
        let offset_b = position - Vectors::load(place, &gathered.b.centre);
        // All moments of a ball are the same.
        let arm_a = offset_a.dot(&normal) * gathered.a.inverse_sqrt_moments[0].at(place);
        let arm_b = offset_b.dot(&normal) * gathered.b.inverse_sqrt_moments[0].at(place);
        let (a, b) = inverse_sqrt_masses(place, gathered);
        let inverse_mass = a * a + b * b;
        arm_a.store(&mut rows[RoundLayout::<N>::ARM_A]);
        arm_b.store(&mut rows[RoundLayout::<N>::ARM_B]);
        inverse_mass.store(&mut rows[RoundLayout::<N>::INVERSE_MASS]);
        let response = inverse_mass + arm_a * arm_a + arm_b * arm_b;
        response.inverse_or_zero().store(&mut rows[RoundLayout::<N>::SLIDE_MASS]);
        point.gap.at(place).store(&mut rows[RoundLayout::<N>::GAP]);
        point.impulse.at(place).store(&mut rows[RoundLayout::<N>::IMPULSE]);
        let motion = BaseMotion::at(place, gathered, (&offset_a, &offset_b));
        let (mut meeting, mut sliding) = (motion.velocity, motion.velocity);
        if let Some(surfaces) = gathered.surfaces.get() {
            meeting = meeting + Vectors::load(place, &surfaces.of_contact);
            sliding = sliding + Vectors::load(place, &surfaces.whole);
        }
        meeting.dot(&normal).store(&mut rows[RoundLayout::<N>::NORMAL_VELOCITY]);
        motion.acceleration.dot(&normal).store(&mut rows[RoundLayout::<N>::NORMAL_ACCELERATION]);
        normal.store(&mut rows[RoundLayout::<N>::NORMAL..]);
        Self::across(&normal, sliding).store(&mut rows[RoundLayout::<N>::VELOCITY..]);
        Self::across(&normal, motion.acceleration).store(&mut rows[RoundLayout::<N>::ACCELERATION..]);
        let motion = BaseMotion::of_centres(place, gathered);
        motion.velocity.store(&mut rows[RoundLayout::<N>::CENTRE_VELOCITY..]);
        motion.acceleration.store(&mut rows[RoundLayout::<N>::CENTRE_ACCELERATION..]);
        let held = Vectors::load(place, &gathered.friction_impulse);
        Self::across(&normal, held).store(&mut rows[RoundLayout::<N>::FRICTION_IMPULSE..]);
    }

    /// The part of a vector across the normal.
    #[inline(always)]
    fn across(normal: &Vectors<N, M>, vector: Vectors<N, M>) -> Vectors<N, M> {
        vector - *normal * normal.dot(&vector)
    }

    #[inline(always)]
    fn gather(machine: M, block: &Block, rows: &[Lanes], states: &States<'_>) -> Pairing<N, M> {
        Pairing::gather_part(machine, block, rows, states.read(), Sizes::<N>::VELOCITY + N)
    }

    #[inline(always)]
    fn vector(machine: M, rows: &[Lanes], start: usize) -> [Wide<M>; N] {
        let mut vector = [Wide::zero(machine); N];
        for (value, lanes) in vector.iter_mut().zip(&rows[start..start + N]) {
            *value = lanes.on(machine);
        }
        vector
    }

    #[inline(always)]
    fn dot(a: &[Wide<M>; N], b: &[Wide<M>; N]) -> Wide<M> {
        let mut sum = a[0] * b[0];
        for i in 1..N {
            sum += a[i] * b[i];
        }
        sum
    }

    #[inline(always)]
    pub(super) fn warm_start(machine: M, block: &Block, rows: &[Lanes], states: &mut States<'_>) {
        let rows = &rows[..RoundLayout::<N>::LEN];
        let mut p = Self::gather(machine, block, rows, states);
        let normal = Self::vector(machine, rows, RoundLayout::<N>::NORMAL);
        let sliding = Self::vector(machine, rows, RoundLayout::<N>::FRICTION_IMPULSE);
        let pressing = rows[RoundLayout::<N>::IMPULSE].on(machine);
        let mut impulse = sliding;
        for i in 0..N {
            impulse[i] += pressing * normal[i];
        }
        Self::apply(rows, &normal, &impulse, &sliding, &mut p);
        p.scatter(block, states);
    }

    /// Applies an impulse on b, of which the part `sliding` lies across the normal.
    #[inline(always)]
    fn apply(
        rows: &[Lanes],
        normal: &[Wide<M>; N],
        impulse: &[Wide<M>; N],
        sliding: &[Wide<M>; N],
        p: &mut Pairing<N, M>,
    ) {
        p.push(impulse);
        p.spin(normal, sliding, rows[RoundLayout::<N>::ARM_A], rows[RoundLayout::<N>::ARM_B]);
    }

    #[inline(always)]
    pub(super) fn solve(machine: M, block: &Block, rows: &mut [Lanes], states: &mut States<'_>, times: &PassTimes) {
        let rows = &mut rows[..RoundLayout::<N>::LEN];
        let mut p = Self::gather(machine, block, rows, states);
        let normal = Self::vector(machine, rows, RoundLayout::<N>::NORMAL);
        let velocity = p.velocity_between_centres();
        let along = Self::dot(&velocity, &normal);
        let held = rows[RoundLayout::<N>::IMPULSE].on(machine);
        let pressing = Self::press(rows, &normal, along, &p, times);
        // While positions are at stake friction goes by the load so far, afterwards by the full one, as in general rows.
        let load = if times.push { held } else { pressing };
        let before = Self::vector(machine, rows, RoundLayout::<N>::FRICTION_IMPULSE);
        let rubbing = Self::rub(rows, &normal, (&velocity, along), load, &p, times);
        let (mut sliding, mut change, mut impulse) = (rubbing, rubbing, rubbing);
        for i in 0..N {
            sliding[i] = rubbing[i] - before[i];
            change[i] = sliding[i] + (pressing - held) * normal[i];
            impulse[i] = rubbing[i] + pressing * normal[i];
            rows[RoundLayout::<N>::FRICTION_IMPULSE + i] = rubbing[i].lanes();
        }
        rows[RoundLayout::<N>::IMPULSE] = pressing.lanes();
        if !times.push {
            let sum = pressing + rows[RoundLayout::<N>::STEP_IMPULSE];
            rows[RoundLayout::<N>::STEP_IMPULSE] = sum.lanes();
        }
        // Before the move warm starting has just applied all of it.
        let applied = if times.push { impulse } else { change };
        Self::finish(rows, &normal, &Solved { impulse: applied, change, sliding }, &mut p, times);
        p.scatter(block, states);
    }

    /// Applies what was solved, and notes what it adds to the angular momentum because the bodies have moved on.
    #[inline(always)]
    fn finish(
        rows: &mut [Lanes],
        normal: &[Wide<M>; N],
        solved: &Solved<N, M>,
        p: &mut Pairing<N, M>,
        times: &PassTimes,
    ) {
        Self::apply(rows, normal, &solved.change, &solved.sliding, p);
        let (head, excess) = rows.split_at_mut(RoundLayout::<N>::EXCESS);
        let velocity = &head[RoundLayout::<N>::CENTRE_VELOCITY..];
        let acceleration = &head[RoundLayout::<N>::CENTRE_ACCELERATION..];
        p.note_excess(excess, &solved.impulse, (velocity, acceleration), times);
    }

    /// The impulse along the normal: the one row's problem, solved. `along` is what impulses have changed of the velocity
    /// along the normal.
    #[inline(always)]
    fn press(rows: &[Lanes], normal: &[Wide<M>; N], along: Wide<M>, p: &Pairing<N, M>, times: &PassTimes) -> Wide<M> {
        let machine = p.machine;
        let zero = Wide::zero(machine);
        let (velocity, acceleration) =
            (rows[RoundLayout::<N>::NORMAL_VELOCITY], rows[RoundLayout::<N>::NORMAL_ACCELERATION]);
        let closed = Wide::splat(machine, times.moved) * velocity
            + Wide::splat(machine, times.moved_sq) * acceleration
            + Self::dot(&p.between_centres(), normal);
        let gap = rows[RoundLayout::<N>::GAP].on(machine) + rows[RoundLayout::<N>::ARC] + closed;
        let (bias_rate, softness) = if times.push {
            (rows[Layout::<N>::BIAS_RATE].on(machine), rows[Layout::<N>::SOFTNESS].on(machine))
        } else {
            (zero, zero)
        };
        let bias = Passes::<N, M>::bias(gap, bias_rate, times);
        let base = Passes::<N, M>::base(velocity, acceleration, Wide::splat(machine, times.elapsed));
        Self::pressing(rows, base + along + bias, gap.select_positive(zero, softness))
    }

    /// The impulse that leaves no approach, if the row now approaches by `excess`: a linear complementarity problem of one
    /// row, of the same terms as those of many (`normal.rs`).
    #[inline(always)]
    fn pressing(rows: &[Lanes], excess: Wide<M>, softness: Wide<M>) -> Wide<M> {
        let machine = excess.machine();
        let zero = Wide::zero(machine);
        let response = rows[RoundLayout::<N>::INVERSE_MASS].on(machine);
        let held = rows[RoundLayout::<N>::IMPULSE].on(machine);
        let stiffener = rows[Layout::<N>::STIFFENER].on(machine);
        let free = excess - response * held;
        let diagonal = softness.select_positive(softness, stiffener) + response;
        let proximal = softness.select_positive(zero, stiffener * held);
        let impulse = (proximal - free).div(diagonal).max(zero);
        response.select_positive(impulse, zero)
    }

    /// The friction impulse on b, within what `load` allows.
    #[inline(always)]
    fn rub(
        rows: &[Lanes],
        normal: &[Wide<M>; N],
        (velocity, along): (&[Wide<M>; N], Wide<M>),
        load: Wide<M>,
        p: &Pairing<N, M>,
        times: &PassTimes,
    ) -> [Wide<M>; N] {
        let machine = p.machine;
        let elapsed = Wide::splat(machine, times.elapsed);
        let mass = rows[RoundLayout::<N>::SLIDE_MASS].on(machine);
        let turning = p.turning(normal, rows[RoundLayout::<N>::ARM_A], rows[RoundLayout::<N>::ARM_B]);
        let mut wanted = [Wide::zero(machine); N];
        for i in 0..N {
            let base = Passes::<N, M>::base(
                rows[RoundLayout::<N>::VELOCITY + i],
                rows[RoundLayout::<N>::ACCELERATION + i],
                elapsed,
            );
            let slip = base + (velocity[i] - along * normal[i]) + turning[i];
            wanted[i] = rows[RoundLayout::<N>::FRICTION_IMPULSE + i].on(machine) - mass * slip;
        }
        let factor = Passes::<N, M>::share_within(load * rows[Layout::<N>::FRICTION], &wanted);
        for value in &mut wanted {
            *value = *value * factor;
        }
        wanted
    }

    /// See [`super::Bounce`].
    #[inline(always)]
    pub(super) fn bounce(machine: M, block: &Block, rows: &mut [Lanes], states: &mut States<'_>, times: &PassTimes) {
        let rows = &mut rows[..RoundLayout::<N>::LEN];
        let zero = Wide::zero(machine);
        let mut p = Self::gather(machine, block, rows, states);
        let normal = Self::vector(machine, rows, RoundLayout::<N>::NORMAL);
        let along = Self::dot(&p.velocity_between_centres(), &normal);
        let held = rows[RoundLayout::<N>::IMPULSE].on(machine);
        let step_impulse = rows[RoundLayout::<N>::STEP_IMPULSE].on(machine);
        let restitution = rows[Layout::<N>::RESTITUTION].on(machine);
        let at_start = rows[RoundLayout::<N>::NORMAL_VELOCITY].on(machine);
        let acceleration = rows[RoundLayout::<N>::NORMAL_ACCELERATION].on(machine);
        let row = (at_start, acceleration, rows[RoundLayout::<N>::GAP].on(machine));
        let (excess, fast) = Passes::<N, M>::bounce_of(row, restitution, along, times);
        let solved = Self::pressing(rows, excess, zero);
        let solved = Passes::<N, M>::may_press(fast, step_impulse, held).select_positive(solved, zero);
        // Lanes that don't bounce keep what they have.
        let pressing = restitution.select_positive(solved, held);
        rows[RoundLayout::<N>::IMPULSE] = pressing.lanes();
        rows[RoundLayout::<N>::STEP_IMPULSE] = (step_impulse + (pressing - held)).lanes();
        let mut change = normal;
        for value in &mut change {
            *value = *value * (pressing - held);
        }
        let solved = Solved { impulse: change, change, sliding: [zero; N] };
        Self::finish(rows, &normal, &solved, &mut p, times);
        p.scatter(block, states);
    }
}

/// [`super::store`] for a block of balls.
pub(super) fn store<const N: usize>(rows: &[Lanes], lane: usize, contact: &mut Contact<N>) {
    let value = |position: usize| rows[position].0[lane];
    contact.friction_impulse = Vector::from_fn(|i| f64::from(value(RoundLayout::<N>::FRICTION_IMPULSE + i)));
    contact.twist_impulse = Bivector::ZERO;
    for touch in contact.touches.iter_mut() {
        touch.normal_impulse = value(RoundLayout::<N>::IMPULSE);
        touch.step_impulse = value(RoundLayout::<N>::STEP_IMPULSE);
    }
}

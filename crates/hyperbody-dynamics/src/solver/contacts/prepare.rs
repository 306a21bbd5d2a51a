//! From gathered contacts to rows, for as many contacts at once as a register holds; and from solved rows back to the pair's warm start.

use hyperbody_math::{Bivector, Vector};

use super::arms::Arms;
use super::gather::{Gathered, Side};
use super::response::Response;
use super::round::{RoundLayout, RoundPasses};
use super::{Block, Layout, round};
use crate::pairs::Contact;
use crate::solver::bodies::Sizes;
use crate::solver::lanes::Lanes;
use crate::solver::machine::{Machine, Pass};
use crate::solver::part::{Part, Place};
use crate::solver::softness::Softness;
use crate::solver::vectors::{Bivectors, Vectors};

/// How contacts give way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Springs {
    /// Between two moving bodies.
    pub(crate) soft: Softness,
    /// Against the immovable: stiffer, because there the other side won't give; twice the frequency where the substep
    /// allows it, at 60 Hz and four substeps 60 in place of 45 Hz.
    pub(crate) stiff: Softness,
}

/// What rigid rows have in place of softness, in parts of the inverse mass that a point carries: large against rounding in
/// single precision, small against the response.
const RIGID_SHARE: f64 = 1e-4;

/// Makes the rows of a block.
pub(crate) struct Prepare<'a, const N: usize> {
    pub(crate) block: &'a Block,
    pub(crate) rows: &'a mut [Lanes],
    pub(crate) gathered: &'a Gathered<N>,
    pub(crate) springs: &'a Springs,
}

impl<const N: usize> Pass for Prepare<'_, N> {
    #[inline(always)]
    fn run<M: Machine>(self, machine: M) {
        let Self { block, rows, gathered, springs } = self;
        for place in Place::all(machine) {
            coefficients(place, rows, gathered, springs);
            if block.round {
                RoundPasses::<N, M>::prepare(place, rows, gathered);
            } else {
                Manifolds::<N, M>::new(place, block, gathered).write(rows);
            }
        }
        if block.round {
            RoundLayout::<N>::start_sums(rows);
        } else {
            Layout::<N>::start_sums(block, rows);
            Response::<N>::write(machine, block, rows, &gathered.counts);
        }
    }
}

/// What all blocks start with.
#[inline(always)]
fn coefficients<const N: usize, M: Machine>(
    place: Place<M>,
    rows: &mut [Lanes],
    gathered: &Gathered<N>,
    springs: &Springs,
) {
    let rows = &mut rows[..Layout::<N>::COEFFICIENTS];
    let Springs { soft, stiff } = springs;
    let masses @ (a, b) = inverse_sqrt_masses(place, gathered);
    a.store(&mut rows[Layout::<N>::INVERSE_SQRT_MASS_A]);
    b.store(&mut rows[Layout::<N>::INVERSE_SQRT_MASS_B]);
    gathered.friction.at(place).store(&mut rows[Layout::<N>::FRICTION]);
    gathered.restitution.at(place).store(&mut rows[Layout::<N>::RESTITUTION]);
    by_spring(masses, soft.bias_rate, stiff.bias_rate).store(&mut rows[Layout::<N>::BIAS_RATE]);
    // The spring is the manifold's, shared evenly by its points: a patch is as stiff with sixteen corners as with one.
    let share = (a * a + b * b) * gathered.counts.at(place);
    let softness_share = by_spring(masses, soft.compliance().max(RIGID_SHARE), stiff.compliance().max(RIGID_SHARE));
    (share * softness_share).store(&mut rows[Layout::<N>::SOFTNESS]);
    (share * place.splat(RIGID_SHARE)).store(&mut rows[Layout::<N>::STIFFENER]);
}

#[inline(always)]
pub(super) fn inverse_sqrt_masses<const N: usize, M: Machine>(
    place: Place<M>,
    gathered: &Gathered<N>,
) -> (Part<M>, Part<M>) {
    (gathered.a.inverse_sqrt_mass.at(place), gathered.b.inverse_sqrt_mass.at(place))
}

/// `soft` where both bodies move, else `stiff`.
#[inline(always)]
fn by_spring<M: Machine>((a, b): (Part<M>, Part<M>), soft: f64, stiff: f64) -> Part<M> {
    let (soft, stiff) = (a.place().splat(soft), a.place().splat(stiff));
    a.select_positive(b.select_positive(soft, stiff), stiff)
}

/// How bodies b move against bodies a at a point of each contact, of themselves.
pub(super) struct BaseMotion<const N: usize, M: Machine> {
    pub(super) velocity: Vectors<N, M>,
    pub(super) acceleration: Vectors<N, M>,
}

impl<const N: usize, M: Machine> BaseMotion<N, M> {
    /// At the given offsets from both centres.
    #[inline(always)]
    pub(super) fn at(place: Place<M>, gathered: &Gathered<N>, (a, b): (&Vectors<N, M>, &Vectors<N, M>)) -> Self {
        let (velocity_a, acceleration_a) = base_motion_of(place, &gathered.a, a);
        let (velocity_b, acceleration_b) = base_motion_of(place, &gathered.b, b);
        Self { velocity: velocity_b - velocity_a, acceleration: acceleration_b - acceleration_a }
    }

    /// Of the centres.
    #[inline(always)]
    pub(super) fn of_centres(place: Place<M>, Gathered { a, b, .. }: &Gathered<N>) -> Self {
        Self {
            velocity: Vectors::load(place, &b.velocity) - Vectors::load(place, &a.velocity),
            acceleration: Vectors::load(place, &b.acceleration) - Vectors::load(place, &a.acceleration),
        }
    }
}

/// Velocity and acceleration of the point at offset `r`.
#[inline(always)]
fn base_motion_of<const N: usize, M: Machine>(
    place: Place<M>,
    side: &Side<N>,
    r: &Vectors<N, M>,
) -> (Vectors<N, M>, Vectors<N, M>) {
    let spin = Bivectors::load(place, &side.angular_velocity);
    let velocity = Vectors::load(place, &side.velocity) + spin.act_on(r);
    let mut acceleration = Vectors::load(place, &side.acceleration);
    if let Some(spin_up) = side.angular_acceleration.get() {
        acceleration = acceleration + Bivectors::load(place, spin_up).act_on(r);
    }
    (velocity, acceleration)
}

/// The contacts of a block that are not those of balls, while its rows are made.
struct Manifolds<'a, const N: usize, M: Machine> {
    place: Place<M>,
    block: &'a Block,
    gathered: &'a Gathered<N>,
    normal: Vectors<N, M>,
    tangents: [Vectors<N, M>; N],
    /// The mean of the points.
    centre: Vectors<N, M>,
}

impl<'a, const N: usize, M: Machine> Manifolds<'a, N, M> {
    #[inline(always)]
    fn new(place: Place<M>, block: &'a Block, gathered: &'a Gathered<N>) -> Self {
        let share = gathered.counts.at(place).inverse_or_zero();
        let mut centre = Vectors::zero(place);
        for point in &gathered.points[..block.points] {
            centre = centre + Vectors::load(place, &point.position) * share;
        }
        let normal = Vectors::load(place, &gathered.normal);
        Self { place, block, gathered, normal, tangents: normal.orthonormal_complement(), centre }
    }

    /// All but what [`Response`] adds.
    #[inline(always)]
    fn write(&self, rows: &mut [Lanes]) {
        let Self { place, gathered: Gathered { a, b, .. }, .. } = *self;
        let offset_a = self.centre - Vectors::load(place, &a.centre);
        let offset_b = self.centre - Vectors::load(place, &b.centre);
        Arms::new(a, &offset_a, &self.normal, &self.tangents).write(self.block, rows);
        Arms::new(b, &offset_b, &self.normal, &self.tangents).write(self.block, &mut rows[Sizes::<N>::K..]);
        let motion = BaseMotion::at(place, self.gathered, (&offset_a, &offset_b));
        self.centres(rows);
        self.sliding(&motion, rows);
        self.turning(rows);
        self.field(&motion, rows);
        self.points(rows);
        if self.block.resists {
            self.resistance(rows);
        }
    }

    /// The normal, and how the centres move against each other.
    #[inline(always)]
    fn centres(&self, rows: &mut [Lanes]) {
        let rows = &mut rows[..Layout::<N>::HEADER];
        let motion = BaseMotion::of_centres(self.place, self.gathered);
        self.normal.store(&mut rows[Layout::<N>::NORMAL..]);
        motion.velocity.store(&mut rows[Layout::<N>::CENTRE_VELOCITY..]);
        motion.acceleration.store(&mut rows[Layout::<N>::CENTRE_ACCELERATION..]);
    }

    #[inline(always)]
    fn sliding(&self, motion: &BaseMotion<N, M>, rows: &mut [Lanes]) {
        let mut velocity = motion.velocity;
        if let Some(surfaces) = self.gathered.surfaces.get() {
            velocity = velocity + Vectors::load(self.place, &surfaces.whole);
        }
        let held = Vectors::load(self.place, &self.gathered.friction_impulse);
        let rows = rows[Layout::<N>::HEADER..Layout::<N>::SLIDE_MASS].chunks_exact_mut(Layout::<N>::SLIDE_ROW);
        for (row, tangent) in rows.zip(&self.tangents) {
            tangent.store(row);
            velocity.dot(tangent).store(&mut row[Layout::<N>::SLIDE_VELOCITY]);
            motion.acceleration.dot(tangent).store(&mut row[Layout::<N>::SLIDE_ACCELERATION]);
            held.dot(tangent).store(&mut row[Layout::<N>::SLIDE_IMPULSE]);
        }
    }

    /// Twisting rows, which are the planes of the tangent space, their bivectors orthonormal; and the slopes of the normal field.
    #[inline(always)]
    fn turning(&self, rows: &mut [Lanes]) {
        let Self { place, block, gathered: Gathered { a, b, .. }, ref normal, ref tangents, .. } = *self;
        let spin = Bivectors::load(place, &b.angular_velocity) - Bivectors::load(place, &a.angular_velocity);
        let spin_up = match (a.angular_acceleration.get(), b.angular_acceleration.get()) {
            (None, None) => None,
            (a, b) => Some(Bivectors::load_or_zero(place, b) - Bivectors::load_or_zero(place, a)),
        };
        let (field, points) = (Layout::<N>::field_start(block), Layout::<N>::points_start(block));
        if block.twists > 0 {
            let held = Bivectors::load(place, &self.gathered.twist_impulse);
            let mut rows = rows[Layout::<N>::TWIST_ROWS..field].chunks_exact_mut(Layout::<N>::TWIST_ROW);
            for s in 0..Layout::<N>::SLIDES {
                for (t, row) in (s + 1..Layout::<N>::SLIDES).zip(&mut rows) {
                    let plane = Bivectors::wedge(&tangents[s], &tangents[t]);
                    spin.dot(&plane).store(&mut row[Layout::<N>::TWIST_VELOCITY]);
                    match &spin_up {
                        Some(spin_up) => spin_up.dot(&plane),
                        None => place.zero(),
                    }
                    .store(&mut row[Layout::<N>::TWIST_ACCELERATION]);
                    held.dot(&plane).store(&mut row[Layout::<N>::TWIST_IMPULSE]);
                }
            }
        }
        for (row, tangent) in rows[field..points].chunks_exact_mut(Layout::<N>::FIELD_ROW).skip(1).zip(tangents) {
            spin.act_on(tangent).dot(normal).store(&mut row[Layout::<N>::FIELD_VELOCITY]);
            match &spin_up {
                Some(spin_up) => spin_up.act_on(tangent).dot(normal),
                None => place.zero(),
            }
            .store(&mut row[Layout::<N>::FIELD_ACCELERATION]);
        }
    }

    /// The normal field at the centre of friction.
    #[inline(always)]
    fn field(&self, motion: &BaseMotion<N, M>, rows: &mut [Lanes]) {
        let mut velocity = motion.velocity;
        if let Some(surfaces) = self.gathered.surfaces.get() {
            velocity = velocity + Vectors::load(self.place, &surfaces.of_contact);
        }
        let row = &mut rows[Layout::<N>::field_start(self.block)..][..Layout::<N>::FIELD_ROW];
        velocity.dot(&self.normal).store(&mut row[Layout::<N>::FIELD_VELOCITY]);
        motion.acceleration.dot(&self.normal).store(&mut row[Layout::<N>::FIELD_ACCELERATION]);
    }

    #[inline(always)]
    fn points(&self, rows: &mut [Lanes]) {
        let Self { place, block, gathered, .. } = *self;
        let counts = gathered.counts.at(place);
        let rows = rows[Layout::<N>::points_start(block)..Layout::<N>::response_start(block)]
            .chunks_exact_mut(Layout::<N>::POINT_ROW);
        for ((index, row), point) in rows.enumerate().zip(&gathered.points) {
            point.gap.at(place).store(&mut row[Layout::<N>::POINT_GAP]);
            point.impulse.at(place).store(&mut row[Layout::<N>::POINT_IMPULSE]);
            // Lanes with fewer points have none there.
            let is_there = counts - place.splat(index as f64 + 0.5);
            let offset = Vectors::load(place, &point.position) - self.centre;
            let levers = &mut row[Layout::<N>::POINT_LEVER..Layout::<N>::POINT_ROW];
            for t in 0..Layout::<N>::SLIDES {
                is_there.select_positive(offset.dot(&self.tangents[t]), place.zero()).store(&mut levers[t]);
            }
        }
    }

    /// Rolling rows are the slopes of the normal field: the planes of the normal and each tangent.
    #[inline(always)]
    fn resistance(&self, rows: &mut [Lanes]) {
        let Self { place, gathered, .. } = *self;
        let [rolling, twisting] = &gathered.resistance;
        let held = Bivectors::load(place, &gathered.twist_impulse);
        let rows = &mut rows[Layout::<N>::resistance_start(self.block)..];
        rolling.at(place).store(&mut rows[Layout::<N>::ROLLING]);
        twisting.at(place).store(&mut rows[Layout::<N>::TWISTING]);
        for (row, tangent) in rows[Layout::<N>::ROLLING_IMPULSES..].iter_mut().zip(&self.tangents) {
            held.dot(&Bivectors::wedge(tangent, &self.normal)).store(row);
        }
    }
}

/// Stores the impulses of one lane in its contact, to warm-start the next step.
pub(crate) fn store<const N: usize>(block: &Block, rows: &[Lanes], lane: usize, contact: &mut Contact<N>) {
    if block.round {
        return round::store(rows, lane, contact);
    }
    let value = |position: usize| f64::from(rows[position].0[lane]);
    let mut tangents = [Vector::ZERO; N];
    contact.friction_impulse = Vector::ZERO;
    for (t, tangent) in tangents.iter_mut().enumerate().take(Layout::<N>::SLIDES) {
        let at = Layout::<N>::HEADER + t * Layout::<N>::SLIDE_ROW;
        *tangent = Vector::from_fn(|i| value(at + i));
        contact.friction_impulse += *tangent * value(at + Layout::<N>::SLIDE_IMPULSE);
    }
    contact.twist_impulse = Bivector::ZERO;
    if block.twists > 0 {
        let mut row = 0;
        for s in 0..Layout::<N>::SLIDES {
            for t in s + 1..Layout::<N>::SLIDES {
                let at = Layout::<N>::TWIST_ROWS + row * Layout::<N>::TWIST_ROW + Layout::<N>::TWIST_IMPULSE;
                contact.twist_impulse += Bivector::wedge(tangents[s], tangents[t]) * value(at);
                row += 1;
            }
        }
    }
    if block.resists {
        let start = Layout::<N>::resistance_start(block) + Layout::<N>::ROLLING_IMPULSES;
        for t in 0..Layout::<N>::SLIDES {
            contact.twist_impulse += Bivector::wedge(tangents[t], contact.normal) * value(start + t);
        }
    }
    let start = Layout::<N>::points_start(block);
    for (index, touch) in contact.touches.iter_mut().enumerate() {
        let at = start + index * Layout::<N>::POINT_ROW + Layout::<N>::POINT_IMPULSE;
        touch.normal_impulse = rows[at].0[lane];
        let total = start + index * Layout::<N>::POINT_ROW + Layout::<N>::POINT_STEP_IMPULSE;
        touch.step_impulse = rows[total].0[lane];
    }
}

#[cfg(test)]
mod tests {
    use hyperbody_collision::{ContactPoint, MAX_POINTS};

    use super::*;
    use crate::pairs::{Touch, Touches};
    use crate::solver::bodies::SolverBody;
    use crate::solver::lanes::{Real, WIDTH};
    use crate::solver::machine::Processor;

    /// What is left over in the rows from the step before does not stay in any of them.
    fn check_that_all_is_written<const N: usize>(points: usize, resists: bool, round: bool) {
        let twists = if points > 1 || resists { Layout::<N>::TWISTS } else { 0 };
        let (bodies, contacts) = ([0; WIDTH], [0; WIDTH]);
        let block = Block {
            start: 0,
            points,
            twists,
            bounces: false,
            resists,
            round,
            bodies_a: bodies,
            bodies_b: bodies,
            contacts,
        };
        let position = |k: usize| Vector::from_fn(|i| if i > 0 && k >> (i - 1) & 1 == 1 { 0.5 } else { -0.5 });
        let touch = |k| Touch::new(ContactPoint { position: position(k), separation: -0.01, id: 0 });
        let touches = |count: usize| Touches::List((0..count).map(touch).collect());
        let contact = |count| Contact { touches: touches(count), normal: Vector::unit(0), ..Contact::NONE };
        let (body, resting) = (SolverBody::<N>::with_unit_moments(1.0), SolverBody::<N>::RESTING);
        let mut gathered = Gathered::ZERO;
        gathered.start();
        gathered.fill(&block, 0, &contact(points), (&resting, &body));
        gathered.fill(&block, 1, &contact(1), (&body, &body));
        for lane in 2..WIDTH {
            gathered.fill(&block, lane, &Contact::NONE, (&resting, &resting));
        }
        let mut rows = vec![Lanes::splat(Real::NAN); Layout::<N>::block_len(&block)];
        let spring = Softness::new(30.0, 10.0, 1.0 / 240.0);
        let springs = Springs { soft: spring, stiff: spring };
        let pass = Prepare { block: &block, rows: &mut rows, gathered: &gathered, springs: &springs };
        Processor::of_this_machine().run(pass);
        for (at, row) in rows.iter().enumerate() {
            assert!(row.0.iter().all(|value| value.is_finite()), "{at} of {} in {N}D: {row:?}", rows.len());
        }
    }

    fn check<const N: usize>() {
        check_that_all_is_written::<N>(1, false, true);
        for points in [1, N, MAX_POINTS] {
            check_that_all_is_written::<N>(points, false, false);
            check_that_all_is_written::<N>(points, true, false);
        }
    }

    #[test]
    fn all_rows_are_written() {
        check::<2>();
        check::<3>();
        check::<4>();
        check::<5>();
        check::<6>();
    }
}

//! From a manifold to rows, and from solved rows back to the pair's warm start.

use hyperbody_math::{Bivector, Vector};

use super::arms::Arms;
use super::{Block, Layout, round};
use crate::pairs::{Contact, Touch};
use crate::solver::bodies::SolverBody;
use crate::solver::lanes::{Lanes, Real, WIDTH};
use crate::solver::softness::Softness;

/// What preparing needs of the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prepare {
    /// Between two moving bodies.
    pub(crate) soft: Softness,
    /// Against the immovable: stiffer, because there the other side won't give; twice the frequency where the substep
    /// allows it, at 60 Hz and four substeps 60 in place of 45 Hz.
    pub(crate) stiff: Softness,
}

/// What rigid rows have in place of softness, in parts of the inverse mass that a point carries: large against rounding in
/// single precision, small against the response.
const RIGID_SHARE: f64 = 1e-4;

/// One contact while its lane is filled.
pub(super) struct Lane<'a, const N: usize> {
    pub(super) rows: &'a mut [Lanes],
    pub(super) lane: usize,
    pub(super) a: &'a SolverBody<N>,
    pub(super) b: &'a SolverBody<N>,
}

/// Offsets of a point from both centres of mass, world axes.
#[derive(Clone, Copy)]
pub(super) struct Offsets<const N: usize> {
    pub(super) a: Vector<N>,
    pub(super) b: Vector<N>,
}

impl Prepare {
    pub(super) fn softness<const N: usize>(&self, a: &SolverBody<N>, b: &SolverBody<N>) -> &Softness {
        let both_move = a.inverse_sqrt_mass > 0.0 && b.inverse_sqrt_mass > 0.0;
        if both_move { &self.soft } else { &self.stiff }
    }

    /// Fills one lane of a block from a contact's manifold and warm start, all but its arms, which [`super::Respond`] makes of
    /// what is noted in `arms`.
    pub(crate) fn fill<const N: usize>(
        &self,
        block: &Block,
        rows: &mut [Lanes],
        lane: usize,
        contact: &Contact<N>,
        (a, b): (&SolverBody<N>, &SolverBody<N>),
        arms: &mut Arms<N>,
    ) {
        let mut lane = Lane { rows, lane, a, b };
        lane.coefficients(contact, self.softness(a, b));
        lane.centres(contact);
        let touches = contact.touches.as_slice();
        let mut centre = Vector::ZERO;
        for touch in touches {
            centre += touch.point.position * (1.0 / touches.len() as f64);
        }
        let tangents = contact.normal.orthonormal_complement();
        let r = lane.offsets(centre);
        let motion = lane.base_motion(r);
        arms.a.fill(lane.lane, a, r.a, contact.normal, &tangents);
        arms.b.fill(lane.lane, b, r.b, contact.normal, &tangents);
        lane.sliding(contact, &tangents, motion);
        if block.twists > 0 {
            lane.twisting(contact, &tangents);
        }
        lane.field(contact, &tangents, motion, block);
        lane.points(contact, centre, &tangents, block);
        if block.resists {
            lane.resistance(contact, &tangents, block);
        }
    }
}

impl<const N: usize> Lane<'_, N> {
    pub(super) fn set(&mut self, position: usize, value: f64) {
        // The remainder spares the check of the lane.
        self.rows[position].0[self.lane % WIDTH] = value as Real;
    }

    pub(super) fn set_vector(&mut self, position: usize, value: Vector<N>) {
        for i in 0..N {
            self.set(position + i, value[i]);
        }
    }

    pub(super) fn offsets(&self, point: Vector<N>) -> Offsets<N> {
        Offsets { a: point - self.a.centre, b: point - self.b.centre }
    }

    /// Relative base velocity and acceleration of b against a at a point.
    pub(super) fn base_motion(&self, r: Offsets<N>) -> (Vector<N>, Vector<N>) {
        (
            self.b.base_velocity_at(r.b) - self.a.base_velocity_at(r.a),
            self.b.base_acceleration_at(r.b) - self.a.base_acceleration_at(r.a),
        )
    }

    /// How b's surface runs against a's.
    pub(super) fn surfaces(&self, contact: &Contact<N>) -> Vector<N> {
        if self.a.runs || self.b.runs {
            return contact.surface + self.b.surface - self.a.surface;
        }
        contact.surface
    }

    pub(super) fn inverse_mass_sum(&self) -> f64 {
        self.a.inverse_sqrt_mass * self.a.inverse_sqrt_mass + self.b.inverse_sqrt_mass * self.b.inverse_sqrt_mass
    }

    pub(super) fn coefficients(&mut self, contact: &Contact<N>, softness: &Softness) {
        self.set(Layout::<N>::INVERSE_SQRT_MASS_A, self.a.inverse_sqrt_mass);
        self.set(Layout::<N>::INVERSE_SQRT_MASS_B, self.b.inverse_sqrt_mass);
        self.set(Layout::<N>::FRICTION, contact.friction);
        self.set(Layout::<N>::RESTITUTION, contact.restitution);
        self.set(Layout::<N>::BIAS_RATE, softness.bias_rate);
        // The spring is the manifold's, shared evenly by its points: a patch is as stiff with sixteen corners as with one.
        let share = self.inverse_mass_sum() * contact.touches.len() as f64;
        let softness_share = (softness.impulse_scale / softness.mass_scale).max(RIGID_SHARE);
        self.set(Layout::<N>::SOFTNESS, share * softness_share);
        self.set(Layout::<N>::STIFFENER, share * RIGID_SHARE);
    }

    /// The normal, and how the centres move against each other.
    fn centres(&mut self, contact: &Contact<N>) {
        self.set_vector(Layout::<N>::NORMAL, contact.normal);
        self.set_vector(Layout::<N>::CENTRE_VELOCITY, self.b.velocity - self.a.velocity);
        self.set_vector(Layout::<N>::CENTRE_ACCELERATION, self.b.acceleration - self.a.acceleration);
    }

    fn sliding(
        &mut self,
        contact: &Contact<N>,
        tangents: &[Vector<N>; N],
        (velocity, acceleration): (Vector<N>, Vector<N>),
    ) {
        let velocity = velocity + self.surfaces(contact);
        for t in 0..Layout::<N>::SLIDES {
            let at = Layout::<N>::HEADER + t * Layout::<N>::SLIDE_ROW;
            let tangent = tangents[t];
            self.set_vector(at, tangent);
            self.set(at + Layout::<N>::SLIDE_VELOCITY, velocity.dot(tangent));
            self.set(at + Layout::<N>::SLIDE_ACCELERATION, acceleration.dot(tangent));
            self.set(at + Layout::<N>::SLIDE_IMPULSE, contact.friction_impulse.dot(tangent));
        }
    }

    /// Twisting rows are the planes of the tangent space; their bivectors are orthonormal.
    fn twisting(&mut self, contact: &Contact<N>, tangents: &[Vector<N>; N]) {
        let spin = self.b.angular_velocity - self.a.angular_velocity;
        let spin_up = self.b.spin_up_against(self.a);
        let mut row = 0;
        for s in 0..Layout::<N>::SLIDES {
            for t in s + 1..Layout::<N>::SLIDES {
                let at = Layout::<N>::TWIST_ROWS + row * Layout::<N>::TWIST_ROW;
                let plane = Bivector::wedge(tangents[s], tangents[t]);
                self.set(at + Layout::<N>::TWIST_VELOCITY, spin.dot(&plane));
                self.set(at + Layout::<N>::TWIST_ACCELERATION, spin_up.dot(&plane));
                self.set(at + Layout::<N>::TWIST_IMPULSE, contact.twist_impulse.dot(&plane));
                row += 1;
            }
        }
    }

    /// Rolling rows are the slopes of the normal field: the planes of the normal and each tangent.
    fn resistance(&mut self, contact: &Contact<N>, tangents: &[Vector<N>; N], block: &Block) {
        let start = Layout::<N>::resistance_start(block);
        self.set(start + Layout::<N>::ROLLING, contact.resistance.0);
        self.set(start + Layout::<N>::TWISTING, contact.resistance.1);
        for t in 0..Layout::<N>::SLIDES {
            let plane = Bivector::wedge(tangents[t], contact.normal);
            self.set(start + Layout::<N>::ROLLING_IMPULSES + t, contact.twist_impulse.dot(&plane));
        }
    }

    /// The field of the normal rows: at the centre, and along the tangents.
    fn field(
        &mut self,
        contact: &Contact<N>,
        tangents: &[Vector<N>; N],
        (mut velocity, acceleration): (Vector<N>, Vector<N>),
        block: &Block,
    ) {
        let normal = contact.normal;
        if contact.surface != Vector::ZERO {
            velocity += contact.surface;
        }
        let start = Layout::<N>::field_start(block);
        self.set(start + Layout::<N>::FIELD_VELOCITY, velocity.dot(normal));
        self.set(start + Layout::<N>::FIELD_ACCELERATION, acceleration.dot(normal));
        let spin = self.b.angular_velocity - self.a.angular_velocity;
        let spin_up = self.b.spin_up_against(self.a);
        for t in 1..Layout::<N>::field_rows(block) {
            let at = start + t * Layout::<N>::FIELD_ROW;
            let tangent = tangents[t - 1];
            self.set(at + Layout::<N>::FIELD_VELOCITY, spin.act_on(tangent).dot(normal));
            self.set(at + Layout::<N>::FIELD_ACCELERATION, spin_up.act_on(tangent).dot(normal));
        }
    }

    fn points(&mut self, contact: &Contact<N>, centre: Vector<N>, tangents: &[Vector<N>; N], block: &Block) {
        for (index, Touch { point, normal_impulse, .. }) in contact.touches.iter().enumerate() {
            let at = Layout::<N>::points_start(block) + index * Layout::<N>::POINT_ROW;
            self.set(at + Layout::<N>::POINT_GAP, point.separation);
            self.set(at + Layout::<N>::POINT_IMPULSE, f64::from(*normal_impulse));
            for t in 0..Layout::<N>::SLIDES {
                self.set(at + Layout::<N>::POINT_LEVER + t, (point.position - centre).dot(tangents[t]));
            }
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

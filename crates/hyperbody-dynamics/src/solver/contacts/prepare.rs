//! From a manifold to rows, and from solved rows back to the pair's warm start.

use hyperbody_math::{Bivector, Vector};

use super::{Block, Layout};
use crate::pairs::Contact;
use crate::solver::bodies::{MAX_PLANES, Sizes, SolverBody};
use crate::solver::lanes::{Lanes, Real};
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
struct Lane<'a, const N: usize> {
    rows: &'a mut [Lanes],
    lane: usize,
    a: &'a SolverBody<N>,
    b: &'a SolverBody<N>,
}

/// Offsets of a point from both centres of mass, world axes.
#[derive(Clone, Copy)]
struct Offsets<const N: usize> {
    a: Vector<N>,
    b: Vector<N>,
}

impl Prepare {
    /// Fills one lane of a block from a contact's manifold and warm start.
    pub(crate) fn fill<const N: usize>(
        &self,
        block: &Block,
        rows: &mut [Lanes],
        lane: usize,
        contact: &Contact<N>,
        a: &SolverBody<N>,
        b: &SolverBody<N>,
    ) {
        let mut lane = Lane { rows, lane, a, b };
        let both_move = a.inverse_sqrt_mass > 0.0 && b.inverse_sqrt_mass > 0.0;
        lane.header(contact, if both_move { &self.soft } else { &self.stiff });
        let points = contact.manifold.points();
        let mut centre = Vector::ZERO;
        for point in points {
            centre += point.position * (1.0 / points.len() as f64);
        }
        let tangents = contact.manifold.normal.orthonormal_complement();
        let motion = lane.base_motion(lane.offsets(centre));
        lane.sliding(contact, centre, &tangents, motion);
        if block.twists > 0 {
            lane.twisting(contact, &tangents);
        }
        lane.field(contact, centre, &tangents, motion, block);
        lane.points(contact, centre, &tangents, block);
        if block.resists {
            lane.resistance(contact, &tangents, block);
        }
    }
}

impl<const N: usize> Lane<'_, N> {
    fn set(&mut self, position: usize, value: f64) {
        self.rows[position].0[self.lane] = value as Real;
    }

    fn set_arms(&mut self, position: usize, a: &[f64; MAX_PLANES], b: &[f64; MAX_PLANES]) {
        for k in 0..Sizes::<N>::K {
            self.set(position + k, a[k]);
            self.set(position + Sizes::<N>::K + k, b[k]);
        }
    }

    fn offsets(&self, point: Vector<N>) -> Offsets<N> {
        Offsets { a: point - self.a.centre, b: point - self.b.centre }
    }

    /// Relative base velocity and acceleration of b against a at a point.
    fn base_motion(&self, r: Offsets<N>) -> (Vector<N>, Vector<N>) {
        (
            self.b.base_velocity_at(r.b) - self.a.base_velocity_at(r.a),
            self.b.base_acceleration_at(r.b) - self.a.base_acceleration_at(r.a),
        )
    }

    fn inverse_mass_sum(&self) -> f64 {
        self.a.inverse_sqrt_mass * self.a.inverse_sqrt_mass + self.b.inverse_sqrt_mass * self.b.inverse_sqrt_mass
    }

    fn header(&mut self, contact: &Contact<N>, softness: &Softness) {
        self.set(Layout::<N>::INVERSE_SQRT_MASS_A, self.a.inverse_sqrt_mass);
        self.set(Layout::<N>::INVERSE_SQRT_MASS_B, self.b.inverse_sqrt_mass);
        self.set(Layout::<N>::FRICTION, contact.friction);
        self.set(Layout::<N>::RESTITUTION, contact.restitution);
        self.set(Layout::<N>::BIAS_RATE, softness.bias_rate);
        // The spring is the manifold's, shared evenly by its points: a patch is as stiff with sixteen corners as with one.
        let share = self.inverse_mass_sum() * contact.manifold.points().len() as f64;
        let softness_share = (softness.impulse_scale / softness.mass_scale).max(RIGID_SHARE);
        self.set(Layout::<N>::SOFTNESS, share * softness_share);
        self.set(Layout::<N>::STIFFENER, share * RIGID_SHARE);
        for i in 0..N {
            self.set(Layout::<N>::NORMAL + i, contact.manifold.normal[i]);
            self.set(Layout::<N>::CENTRE_VELOCITY + i, self.b.velocity[i] - self.a.velocity[i]);
            self.set(Layout::<N>::CENTRE_ACCELERATION + i, self.b.acceleration[i] - self.a.acceleration[i]);
        }
    }

    fn sliding(
        &mut self,
        contact: &Contact<N>,
        centre: Vector<N>,
        tangents: &[Vector<N>; N],
        (velocity, acceleration): (Vector<N>, Vector<N>),
    ) {
        let r = self.offsets(centre);
        let velocity = velocity + self.b.surface - self.a.surface + contact.surface;
        for t in 0..Layout::<N>::SLIDES {
            let at = Layout::<N>::HEADER + t * Layout::<N>::SLIDE_ROW;
            let tangent = tangents[t];
            for i in 0..N {
                self.set(at + i, tangent[i]);
            }
            self.set_arms(at + Layout::<N>::SLIDE_ARM_A, &self.a.arm(r.a, tangent), &self.b.arm(r.b, tangent));
            self.set(at + Layout::<N>::SLIDE_VELOCITY, velocity.dot(tangent));
            self.set(at + Layout::<N>::SLIDE_ACCELERATION, acceleration.dot(tangent));
            self.set(at + Layout::<N>::SLIDE_IMPULSE, contact.friction_impulse.dot(tangent));
        }
    }

    /// Twisting rows are the planes of the tangent space; their bivectors are orthonormal.
    fn twisting(&mut self, contact: &Contact<N>, tangents: &[Vector<N>; N]) {
        let spin = self.b.angular_velocity - self.a.angular_velocity;
        let spin_up = self.b.angular_acceleration - self.a.angular_acceleration;
        let mut row = 0;
        for s in 0..Layout::<N>::SLIDES {
            for t in s + 1..Layout::<N>::SLIDES {
                let at = Layout::<N>::TWIST_ROWS + row * Layout::<N>::TWIST_ROW;
                let plane = Bivector::wedge(tangents[s], tangents[t]);
                let arms = (self.a.arm(tangents[s], tangents[t]), self.b.arm(tangents[s], tangents[t]));
                self.set_arms(at + Layout::<N>::TWIST_ARM_A, &arms.0, &arms.1);
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
            let plane = Bivector::wedge(tangents[t], contact.manifold.normal);
            self.set(start + Layout::<N>::ROLLING_IMPULSES + t, contact.twist_impulse.dot(&plane));
        }
    }

    /// The field of the normal rows: at the centre, and along the tangents.
    fn field(
        &mut self,
        contact: &Contact<N>,
        centre: Vector<N>,
        tangents: &[Vector<N>; N],
        (mut velocity, acceleration): (Vector<N>, Vector<N>),
        block: &Block,
    ) {
        let normal = contact.manifold.normal;
        let r = self.offsets(centre);
        if contact.surface != Vector::ZERO {
            velocity += contact.surface;
        }
        let start = Layout::<N>::field_start(block);
        self.set_arms(start, &self.a.arm(r.a, normal), &self.b.arm(r.b, normal));
        self.set(start + Layout::<N>::FIELD_VELOCITY, velocity.dot(normal));
        self.set(start + Layout::<N>::FIELD_ACCELERATION, acceleration.dot(normal));
        let spin = self.b.angular_velocity - self.a.angular_velocity;
        let spin_up = self.b.angular_acceleration - self.a.angular_acceleration;
        for t in 1..Layout::<N>::field_rows(block) {
            let at = start + t * Layout::<N>::FIELD_ROW;
            let tangent = tangents[t - 1];
            self.set_arms(at, &self.a.arm(tangent, normal), &self.b.arm(tangent, normal));
            self.set(at + Layout::<N>::FIELD_VELOCITY, spin.act_on(tangent).dot(normal));
            self.set(at + Layout::<N>::FIELD_ACCELERATION, spin_up.act_on(tangent).dot(normal));
        }
    }

    fn points(&mut self, contact: &Contact<N>, centre: Vector<N>, tangents: &[Vector<N>; N], block: &Block) {
        let points = contact.manifold.points();
        for (index, point) in points.iter().enumerate() {
            let at = Layout::<N>::points_start(block) + index * Layout::<N>::POINT_ROW;
            self.set(at + Layout::<N>::POINT_GAP, point.separation);
            self.set(at + Layout::<N>::POINT_IMPULSE, f64::from(contact.normal_impulses[index]));
            for t in 0..Layout::<N>::SLIDES {
                self.set(at + Layout::<N>::POINT_LEVER + t, (point.position - centre).dot(tangents[t]));
            }
        }
    }
}

/// Stores the impulses of one lane in its contact, to warm-start the next step.
pub(crate) fn store<const N: usize>(block: &Block, rows: &[Lanes], lane: usize, contact: &mut Contact<N>) {
    let tangents = contact.manifold.normal.orthonormal_complement();
    let value = |position: usize| f64::from(rows[position].0[lane]);
    contact.friction_impulse = Vector::ZERO;
    for (t, &tangent) in tangents.iter().enumerate().take(Layout::<N>::SLIDES) {
        let at = Layout::<N>::HEADER + t * Layout::<N>::SLIDE_ROW + Layout::<N>::SLIDE_IMPULSE;
        contact.friction_impulse += tangent * value(at);
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
            contact.twist_impulse += Bivector::wedge(tangents[t], contact.manifold.normal) * value(start + t);
        }
    }
    let start = Layout::<N>::points_start(block);
    for index in 0..contact.manifold.points().len() {
        let at = start + index * Layout::<N>::POINT_ROW + Layout::<N>::POINT_IMPULSE;
        contact.normal_impulses[index] = rows[at].0[lane];
        let total = start + index * Layout::<N>::POINT_ROW + Layout::<N>::POINT_STEP_IMPULSE;
        contact.step_impulses[index] = rows[total].0[lane];
    }
}

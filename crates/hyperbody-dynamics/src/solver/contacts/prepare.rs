//! From a manifold to rows, and from solved rows back to the pair's warm start.

use hyperbody_math::{Bivector, Vector};

use super::normal::upper;
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
        lane.sliding(contact, centre, &tangents);
        if block.twists > 0 {
            lane.twisting(contact, &tangents);
        }
        lane.field(contact, centre, &tangents, block);
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

    /// Response of one row to another through the rotation of both bodies; their arms stand at the given positions.
    fn response_of_arms(&self, row: usize, other: usize) -> f64 {
        let mut response = 0.0;
        for k in 0..2 * Sizes::<N>::K {
            response += f64::from(self.rows[row + k].0[self.lane]) * f64::from(self.rows[other + k].0[self.lane]);
        }
        response
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

    fn sliding(&mut self, contact: &Contact<N>, centre: Vector<N>, tangents: &[Vector<N>; N]) {
        let r = self.offsets(centre);
        let (velocity, acceleration) = self.base_motion(r);
        let velocity = velocity + self.b.surface - self.a.surface + contact.surface;
        let mut arms = [([0.0; MAX_PLANES], [0.0; MAX_PLANES]); N];
        for t in 0..Layout::<N>::SLIDES {
            let at = Layout::<N>::HEADER + t * Layout::<N>::SLIDE_ROW;
            let tangent = tangents[t];
            for i in 0..N {
                self.set(at + i, tangent[i]);
            }
            arms[t] = (self.a.arm(r.a, tangent), self.b.arm(r.b, tangent));
            self.set_arms(at + Layout::<N>::SLIDE_ARM_A, &arms[t].0, &arms[t].1);
            self.set(at + Layout::<N>::SLIDE_VELOCITY, velocity.dot(tangent));
            self.set(at + Layout::<N>::SLIDE_ACCELERATION, acceleration.dot(tangent));
            self.set(at + Layout::<N>::SLIDE_IMPULSE, contact.friction_impulse.dot(tangent));
        }
        self.sliding_mass(&arms);
    }

    /// Inverse of T K Tᵀ with K the paper's response matrix summed over both bodies. Symmetric and positive definite,
    /// because (m_a + m_b)⁻¹ stands on its diagonal.
    fn sliding_mass(&mut self, arms: &[([f64; MAX_PLANES], [f64; MAX_PLANES]); N]) {
        let slides = Layout::<N>::SLIDES;
        let mut k = [[0.0; N]; N];
        for s in 0..slides {
            for t in 0..slides {
                let mut sum = if s == t { self.inverse_mass_sum() } else { 0.0 };
                for plane in 0..Sizes::<N>::K {
                    sum += arms[s].0[plane] * arms[t].0[plane] + arms[s].1[plane] * arms[t].1[plane];
                }
                k[s][t] = sum;
            }
        }
        let inverse = invert_positive_definite(k, slides);
        let mut at = Layout::<N>::SLIDE_MASS;
        for s in 0..slides {
            for t in s..slides {
                self.set(at, inverse[s][t]);
                at += 1;
            }
        }
    }

    /// Twisting rows are the planes of the tangent space; their bivectors are orthonormal. One mass serves them all: the
    /// inverse of a bound on the largest eigenvalue of their response matrix, mean + deviation·√(k−1) (H. Wolkowicz and
    /// G. P. H. Styan, 1980), exact for isotropic bodies, safe for others, and the same for every choice of tangents.
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
        let mass = self.mass_of_turning(row, |index| Layout::<N>::TWIST_ROWS + index * Layout::<N>::TWIST_ROW);
        self.set(Layout::<N>::TWIST_MASS, mass);
    }

    /// Inverse of a bound on the largest eigenvalue of the response matrix of rows whose arms stand at the given positions.
    fn mass_of_turning(&self, rows: usize, place: impl Fn(usize) -> usize) -> f64 {
        let (mut trace, mut trace_of_square) = (0.0, 0.0);
        for s in 0..rows {
            for t in 0..rows {
                let response = self.response_of_arms(place(s), place(t));
                trace += if s == t { response } else { 0.0 };
                trace_of_square += response * response;
            }
        }
        let count = rows.max(1) as f64;
        let mean = trace / count;
        let variance = (trace_of_square / count - mean * mean).max(0.0);
        let largest = mean + (variance * (count - 1.0)).sqrt();
        if largest > 0.0 { 1.0 / largest } else { 0.0 }
    }

    /// Rolling rows are the slopes of the normal field: the planes of the normal and each tangent.
    fn resistance(&mut self, contact: &Contact<N>, tangents: &[Vector<N>; N], block: &Block) {
        let start = Layout::<N>::resistance_start(block);
        let slope = |t: usize| Layout::<N>::field_start(block) + (t + 1) * Layout::<N>::FIELD_ROW;
        self.set(start + Layout::<N>::ROLLING, contact.resistance.0);
        self.set(start + Layout::<N>::TWISTING, contact.resistance.1);
        let mass = self.mass_of_turning(Layout::<N>::SLIDES, slope);
        self.set(start + Layout::<N>::ROLLING_MASS, mass);
        for t in 0..Layout::<N>::SLIDES {
            let plane = Bivector::wedge(tangents[t], contact.manifold.normal);
            self.set(start + Layout::<N>::ROLLING_IMPULSES + t, contact.twist_impulse.dot(&plane));
        }
    }

    /// The field of the normal rows: at the centre, and along the tangents.
    fn field(&mut self, contact: &Contact<N>, centre: Vector<N>, tangents: &[Vector<N>; N], block: &Block) {
        let normal = contact.manifold.normal;
        let r = self.offsets(centre);
        let (mut velocity, acceleration) = self.base_motion(r);
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
        self.responses(points.len(), block);
    }

    /// Responses of the points to each other, L G Lᵀ with L the places of the points and G the responses of the field.
    fn responses(&mut self, points: usize, block: &Block) {
        let rows = Layout::<N>::field_rows(block);
        let field = |t: usize| Layout::<N>::field_start(block) + t * Layout::<N>::FIELD_ROW;
        let mut g = [[0.0; N]; N];
        for s in 0..rows {
            for t in s..rows {
                g[s][t] = self.response_of_arms(field(s), field(t));
                g[t][s] = g[s][t];
            }
        }
        g[0][0] += self.inverse_mass_sum();
        let start = Layout::<N>::response_start(block);
        for i in 0..points {
            let place = self.place(i, block);
            let to_place: [f64; N] = std::array::from_fn(|t| (0..rows).map(|s| place[s] * g[s][t]).sum());
            for j in i..points {
                let other = self.place(j, block);
                let response: f64 = (0..rows).map(|t| to_place[t] * other[t]).sum();
                self.set(start + upper(block.points, i, j), response);
            }
        }
    }

    /// Weights of the rows of the field at a point: one, and its place along the tangents.
    fn place(&self, index: usize, block: &Block) -> [f64; N] {
        let at = Layout::<N>::points_start(block) + index * Layout::<N>::POINT_ROW + Layout::<N>::POINT_LEVER;
        std::array::from_fn(|t| if t == 0 { 1.0 } else { f64::from(self.rows[at + t - 1].0[self.lane]) })
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

/// Inverse of the leading `size`×`size` block of a symmetric positive definite matrix, by Gauss–Jordan elimination,
/// which needs no pivoting there.
pub(crate) fn invert_positive_definite<const N: usize>(mut m: [[f64; N]; N], size: usize) -> [[f64; N]; N] {
    let mut inverse = [[0.0; N]; N];
    for i in 0..size {
        inverse[i][i] = 1.0;
    }
    for k in 0..size {
        let scale = 1.0 / m[k][k];
        for j in 0..size {
            m[k][j] *= scale;
            inverse[k][j] *= scale;
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

//! Coordinates of a joint at given places of its bodies, and the levers by which velocities change them.

use std::f64::consts::TAU;

use hyperbody_math::{Bivector, Matrix, Rotation, Vector};

use super::place::{Place, Spot};
use super::{JointRows, Moving, Row};
use crate::joint::{Coordinate, Coupling};
use crate::solver::bodies::{MAX_PLANES, SolverBody};

/// How the second frame of a joint lies in the first.
pub(super) struct Geometry<const N: usize> {
    offset_a: Vector<N>,
    offset_b: Vector<N>,
    /// Anchor of b minus anchor of a, world.
    pub(super) gap: Vector<N>,
    /// Axes of the first frame in the world, as columns.
    pub(super) axes: Matrix<N>,
    /// Second frame in the first, if some row asks.
    pub(super) relative: Matrix<N>,
    /// Logarithm of what the turn has beside the free groups, in the first frame.
    error: Bivector<N>,
    /// What is coupled, and what that holds.
    coupling: Option<(Coupling, f64)>,
    /// Group of each axis: planes within one are free.
    groups: [u8; N],
    /// How the second frame is about to turn against the first, in the first, rad.
    heading: Bivector<N>,
}

impl<const N: usize> JointRows<N> {
    /// The joint with its bodies at two places, from which they are about to turn.
    pub(super) fn geometry_now(
        &self,
        (a, b): (&Place<N>, &Place<N>),
        rows: &[Row<N>],
        moving: &Moving<'_, N>,
        h: f64,
    ) -> Geometry<N> {
        let mut geometry = self.geometry(&a.now, &b.now, rows);
        if rows.iter().any(|row| matches!(row.spec.coordinate, Coordinate::Swing(_))) {
            let turn = (b.spin_now(moving) - a.spin_now(moving)) * h;
            let in_frame = geometry.axes.transpose() * turn.to_matrix() * geometry.axes;
            geometry.heading = Bivector::from_antisymmetric_part(&in_frame);
        }
        geometry
    }

    /// The joint with its bodies at two spots.
    pub(super) fn geometry(&self, a: &Spot<N>, b: &Spot<N>, rows: &[Row<N>]) -> Geometry<N> {
        let (offset_a, offset_b) = (a.turn * self.offset_a, b.turn * self.offset_b);
        let mut geometry = Geometry {
            offset_a,
            offset_b,
            gap: (b.centre + offset_b) - (a.centre + offset_a),
            axes: Matrix::IDENTITY,
            relative: Matrix::IDENTITY,
            error: Bivector::ZERO,
            coupling: self.coupling,
            groups: self.groups,
            heading: Bivector::ZERO,
        };
        let coordinate = |row: &Row<N>| row.spec.coordinate;
        let framed = |row: &Row<N>| !matches!(coordinate(row), Coordinate::Point(_) | Coordinate::Length);
        if rows.iter().any(framed) {
            geometry.axes = a.turn * self.frame_a;
            let turns = |row: &Row<N>| !matches!(coordinate(row), Coordinate::Slide(_));
            if rows.iter().any(turns) {
                geometry.relative = geometry.axes.transpose() * (b.turn * self.frame_b);
            }
            if rows.iter().any(|row| matches!(coordinate(row), Coordinate::Turn(..))) {
                geometry.error = self.locked_error(&geometry.relative);
            }
        }
        geometry
    }

    /// The turn without what the free groups make of it: log(Q Hᵀ), with H the nearest to Q of SO(n₁) × SO(n₂) × …
    fn locked_error(&self, relative: &Matrix<N>) -> Bivector<N> {
        let mut free = Matrix::from_fn(|i, j| if self.groups[i] == self.groups[j] { relative[i][j] } else { 0.0 });
        let single = |axis: usize| self.groups.iter().filter(|&&group| group == self.groups[axis]).count() == 1;
        for axis in (0..N).filter(|&axis| single(axis)) {
            free[axis][axis] = 1.0;
        }
        if (0..N).all(single) {
            return log(relative);
        }
        // Newton's iteration to the polar factor; each group's block is near orthogonal as long as the joint holds.
        for _ in 0..POLAR_TURNS {
            let gram = free.transpose() * free;
            let correction = Matrix::from_fn(|i, j| (if i == j { 1.5 } else { 0.0 }) - 0.5 * gram[i][j]);
            free = free * correction;
        }
        log(&(*relative * free.transpose()))
    }
}

/// Least way, m, after which a coupling can be as before.
const LEAST_PERIOD: f64 = 1e-9;

/// Turns of the iteration to the nearest rotation: from blocks that are a tenth off, 1e-8 after two and rounding after three.
const POLAR_TURNS: usize = 3;

/// Logarithm of a rotation matrix. Near the identity by the series of the inverse hyperbolic sine of its antisymmetric part,
/// whose remainder at 0.1 rad is 4e-9 rad.
fn log<const N: usize>(m: &Matrix<N>) -> Bivector<N> {
    let mut largest: f64 = 0.0;
    for i in 0..N {
        largest = largest.max(1.0 - m[i][i]);
    }
    if largest > 0.005 {
        let cleaned = Rotation::nearest(m);
        return cleaned.map_or(Bivector::ZERO, |rotation| rotation.log());
    }
    let s = Bivector::from_antisymmetric_part(&m.transpose());
    if largest < 1e-10 {
        return s;
    }
    let (s, sm) = (s, s.to_matrix());
    let cube = sm * sm * sm;
    let fifth = cube * sm * sm;
    s + Bivector::from_antisymmetric_part(&(cube * (-1.0 / 6.0) + fifth * (3.0 / 40.0)))
}

impl<const N: usize> Geometry<N> {
    /// The value of a coordinate, m or rad.
    pub(super) fn value(&self, coordinate: Coordinate) -> f64 {
        match coordinate {
            Coordinate::Point(axis) => self.gap[usize::from(axis)],
            Coordinate::Slide(axis) => self.axes.column(usize::from(axis)).dot(self.gap),
            Coordinate::Turn(i, j) => self.error.get(usize::from(i), usize::from(j)),
            Coordinate::Angle(i, j) => {
                let (i, j) = (usize::from(i), usize::from(j));
                let q = &self.relative;
                hyperbody_math::scalar::atan2(q[j][i] - q[i][j], q[i][i] + q[j][j])
            }
            Coordinate::Swing(axis) => {
                let axis = usize::from(axis);
                let swung = self.relative.column(axis);
                hyperbody_math::scalar::atan2(self.aside(axis).dot(swung), swung[axis])
            }
            Coordinate::Length => self.gap.norm(),
            Coordinate::Coupled => self.coupling.map_or(0.0, |(coupling, phase)| self.off_mesh(&coupling, phase)),
        }
    }

    /// How far locked planes are off together, rad.
    pub(super) fn turned_off(&self) -> f64 {
        self.error.norm()
    }

    /// A change of a coordinate that is next to what its rate lets expect: angles jump from π to −π, couplings by a tooth or a turn.
    pub(super) fn change_near(&self, expected: f64, coordinate: Coordinate, change: f64) -> f64 {
        let period = match (coordinate, &self.coupling) {
            (Coordinate::Angle(..), _) => TAU,
            (Coordinate::Coupled, Some((coupling, _))) => self.mesh_period(coupling),
            _ => return change,
        };
        // Wheels of which one has come to lie in the other mesh nowhere.
        if period < LEAST_PERIOD { change } else { change - period * ((change - expected) / period).round() }
    }

    /// The plane in which a turn or an angle is measured, unit, world.
    pub(super) fn plane(&self, coordinate: Coordinate) -> Bivector<N> {
        let axis = |k: usize| self.axes.column(k);
        match coordinate {
            Coordinate::Turn(i, j) | Coordinate::Angle(i, j) => {
                Bivector::wedge(axis(usize::from(i)), axis(usize::from(j)))
            }
            Coordinate::Swing(k) => {
                let k = usize::from(k);
                Bivector::wedge(axis(k), self.axes * self.aside(k))
            }
            _ => Bivector::ZERO,
        }
    }

    /// In which direction across an axis of the first frame the same of the second one swings, unit, in the first: where it points, or
    /// where it is about to point if it comes past the middle.
    fn aside(&self, k: usize) -> Vector<N> {
        let swung = self.relative.column(k);
        let across = |v: Vector<N>| Vector::from_fn(|i| if i == k { 0.0 } else { v[i] });
        let (now, way) = (across(swung), across(self.heading.act_on(swung)));
        let aside = if now.norm_sq() < way.norm_sq() { now + way } else { now };
        // Straight ahead or back it may go in any plane that is free.
        let free = || (0..N).find(|&i| i != k && self.groups[i] == self.groups[k]).unwrap_or((k + 1) % N);
        aside.try_normalize().unwrap_or_else(|| Vector::unit(free()))
    }

    /// Where the impulse between two anchors acts, as offsets from both centres. Between two moving bodies it is one point,
    /// midway, so that angular momentum is kept to rounding however far apart the anchors are; a fixed anchor stays where it is.
    fn meeting_point(&self, a: &SolverBody<N>, b: &SolverBody<N>) -> (Vector<N>, Vector<N>) {
        if a.inverse_sqrt_mass == 0.0 || b.inverse_sqrt_mass == 0.0 {
            return (self.offset_a, self.offset_b);
        }
        let half = self.gap * 0.5;
        (self.offset_a + half, self.offset_b - half)
    }

    /// Fills what a row needs at this place.
    pub(super) fn fill(&self, row: &mut Row<N>, a: &Place<N>, b: &Place<N>, bodies: &[SolverBody<N>]) {
        let (body_a, body_b) = (&bodies[a.row], &bodies[b.row]);
        row.value = self.value(row.spec.coordinate);
        if let Coordinate::Angle(..) = row.spec.coordinate {
            row.value -= TAU * ((row.value - row.spec.middle) / TAU).round();
        }
        match row.spec.coordinate {
            Coordinate::Turn(..) | Coordinate::Angle(..) | Coordinate::Swing(_) => {
                let plane = self.plane(row.spec.coordinate);
                row.plane = plane;
                row.direction = Vector::ZERO;
                row.base = plane.dot(&b.spin) - plane.dot(&a.spin);
                row.acceleration = plane.dot(&b.spin_up) - plane.dot(&a.spin_up);
                row.arm_a = lever(a, body_a, &plane);
                row.arm_b = lever(b, body_b, &plane);
            }
            coordinate => {
                let mut twist = None;
                let (direction, offset_a, offset_b) = match coordinate {
                    Coordinate::Point(axis) => {
                        let (offset_a, offset_b) = self.meeting_point(body_a, body_b);
                        (Vector::unit(usize::from(axis)), offset_a, offset_b)
                    }
                    // The axis turns with a: what counts is a's velocity where b's anchor is.
                    Coordinate::Slide(axis) => {
                        (self.axes.column(usize::from(axis)), self.offset_a + self.gap, self.offset_b)
                    }
                    // One point of the world for both, so that angular momentum is kept.
                    Coordinate::Coupled => {
                        let Some((coupling, _)) = &self.coupling else { return };
                        let mesh = self.mesh(coupling);
                        twist = mesh.twist;
                        (mesh.direction, self.offset_a + mesh.point, self.offset_b - self.gap + mesh.point)
                    }
                    _ => (self.gap.try_normalize().unwrap_or(Vector::unit(0)), self.offset_a, self.offset_b),
                };
                row.direction = direction;
                let on_a = a.velocity + a.spin.act_on(offset_a);
                let on_b = b.velocity + b.spin.act_on(offset_b);
                row.base = direction.dot(on_b - on_a);
                let on_a = a.acceleration + a.spin_up.act_on(offset_a);
                let on_b = b.acceleration + b.spin_up.act_on(offset_b);
                row.acceleration = direction.dot(on_b - on_a);
                row.arm_a = arm(a, body_a, offset_a, direction);
                row.arm_b = arm(b, body_b, offset_b, direction);
                if let Some(twist) = twist {
                    row.base += twist.dot(&b.spin) - twist.dot(&a.spin);
                    row.acceleration += twist.dot(&b.spin_up) - twist.dot(&a.spin_up);
                    for (arm, more) in row.arm_a.iter_mut().zip(lever(a, body_a, &twist)) {
                        *arm += more;
                    }
                    for (arm, more) in row.arm_b.iter_mut().zip(lever(b, body_b, &twist)) {
                        *arm += more;
                    }
                }
            }
        }
    }
}

fn arm<const N: usize>(
    place: &Place<N>,
    body: &SolverBody<N>,
    offset: Vector<N>,
    direction: Vector<N>,
) -> [f64; MAX_PLANES] {
    if place.row == 0 || body.inverse_sqrt_mass == 0.0 { [0.0; MAX_PLANES] } else { body.arm(offset, direction) }
}

fn lever<const N: usize>(place: &Place<N>, body: &SolverBody<N>, plane: &Bivector<N>) -> [f64; MAX_PLANES] {
    if place.row == 0 || body.inverse_sqrt_mass == 0.0 { [0.0; MAX_PLANES] } else { body.lever(plane) }
}

/// What an impulse in one row changes the rate of another by.
pub(super) fn response<const N: usize>(row: &Row<N>, other: &Row<N>, a: &SolverBody<N>, b: &SolverBody<N>) -> f64 {
    let inverse_mass = a.inverse_sqrt_mass * a.inverse_sqrt_mass + b.inverse_sqrt_mass * b.inverse_sqrt_mass;
    let mut sum = inverse_mass * row.direction.dot(other.direction);
    for k in 0..hyperbody_math::planes::count(N) {
        sum += row.arm_a[k] * other.arm_a[k] + row.arm_b[k] * other.arm_b[k];
    }
    sum
}

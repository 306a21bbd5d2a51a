//! The passes over joints.

use std::f64::consts::TAU;

use hyperbody_math::Bivector;

use super::geometry::response;
use super::place::{Moment, Place};
use super::{JointRows, Joints, Moving, Row, block};
use crate::joint::{Coordinate, Role};
use crate::solver::Real;
use crate::solver::bodies::{Sizes, SolverBody};
use crate::solver::softness::Softness;

/// Most rows of a joint that are held: all of 6D.
const MOST_HELD: usize = 6 + 15 + 1;

/// Which pass.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Pass {
    /// Before positions move.
    Move,
    /// After.
    Settle,
}

/// Gaps of a joint between which it stops being taken for solved, m.
const FIRM: std::ops::Range<f64> = 0.001..0.003;

/// Share of its impulses that a joint forgets a pass while it is not solved at all.
const FORGOTTEN: f64 = 0.1;

impl<const N: usize> Joints<N> {
    /// Makes all rows at the present place.
    pub(crate) fn refresh(&mut self, moving: &Moving<'_, N>, moment: &Moment) {
        for place in &mut self.places {
            place.refresh(moving, moment);
        }
        for joint in &mut self.joints {
            let (a, b) = (&self.places[joint.a], &self.places[joint.b]);
            let rows = &mut self.rows[joint.first..joint.end];
            let geometry = joint.geometry(&a.now, &b.now, rows);
            joint.axes = geometry.axes;
            rows.iter_mut().for_each(|row| geometry.fill(row, a, b, moving.bodies));
            let held = joint.held - joint.first;
            let factors = &mut self.factors[joint.factors..joint.factors + block::len(held)];
            let (body_a, body_b) = (&moving.bodies[a.row], &moving.bodies[b.row]);
            let mut at = 0;
            for i in 0..held {
                for j in 0..=i {
                    factors[at] = response(&rows[i], &rows[j], body_a, body_b);
                    at += 1;
                }
            }
            block::factorize(factors, held);
        }
    }

    /// Accelerations act for one more substep of length `h`, at the same place.
    pub(crate) fn kick(&mut self, h: f64) {
        for place in &mut self.places {
            place.velocity += place.acceleration * h;
            place.spin += place.spin_up * h;
        }
        for row in &mut self.rows {
            row.base += row.acceleration * h;
        }
    }

    /// Applies the impulses that the last substep's pass of the same sort ended with.
    pub(crate) fn warm_start(&mut self, moving: &mut Moving<'_, N>, pass: Pass) {
        for joint in &self.joints {
            let (a, b) = (&self.places[joint.a], &self.places[joint.b]);
            let rows = &mut self.rows[joint.first..joint.end];
            let kept = 1.0 - FORGOTTEN * (1.0 - joint.firmness(rows));
            for row in rows {
                row.impulse *= kept;
                row.settle *= kept;
                let impulse = match pass {
                    Pass::Move => {
                        // Limits, motors and springs have one impulse, which both passes mend.
                        if joint.soft.is_some() || !matches!(row.spec.role, Role::Held(_)) {
                            row.impulse += row.settle;
                            row.settle = 0.0;
                        }
                        row.impulse
                    }
                    Pass::Settle => row.settle,
                };
                row.apply(a, b, moving, impulse);
            }
        }
    }

    /// Finds what each coordinate will change beyond its tangent at the velocities that warm starting left.
    pub(crate) fn look_ahead(&mut self, moving: &Moving<'_, N>, moment: &Moment) {
        for place in &mut self.places {
            place.look_ahead(moving, moment);
        }
        for joint in &self.joints {
            let (a, b) = (&self.places[joint.a], &self.places[joint.b]);
            let rows = &mut self.rows[joint.first..joint.end];
            let ahead = joint.geometry(&a.next, &b.next, rows);
            let firm = joint.firmness(rows);
            for row in rows {
                let mut change = ahead.value(row.spec.coordinate) - row.value;
                if matches!(row.spec.coordinate, Coordinate::Angle(..)) {
                    // The short way round where the angle jumps from π to −π.
                    change -= std::f64::consts::TAU * (change / std::f64::consts::TAU).round();
                }
                row.curve = firm * (change / moment.h - row.rate(a, b, moving));
            }
        }
    }

    /// One sweep over all joints, forth before the move and back after it.
    pub(crate) fn solve(&mut self, moving: &mut Moving<'_, N>, pass: Pass, h: f64, stiff: &Softness) {
        let count = self.joints.len();
        for index in 0..count {
            let joint = match pass {
                Pass::Move => &self.joints[index],
                Pass::Settle => &self.joints[count - 1 - index],
            };
            let (a, b) = (&self.places[joint.a], &self.places[joint.b]);
            let (held, alone) = self.rows[joint.first..joint.end].split_at_mut(joint.held - joint.first);
            for row in alone {
                row.solve(a, b, moving, pass, h, stiff);
            }
            let factors = &self.factors[joint.factors..joint.factors + block::len(held.len())];
            joint.solve_held(held, factors, (a, b), moving, pass, stiff);
        }
    }

    /// Adds the impulses of a substep to those of the step.
    pub(crate) fn add_up(&mut self) {
        for joint in &mut self.joints {
            let mut twist = Bivector::ZERO;
            let mut turned = false;
            for row in &self.rows[joint.first..joint.end] {
                let impulse = row.impulse + row.settle;
                joint.step_impulse += row.direction * impulse;
                if let Coordinate::Turn(i, j) | Coordinate::Angle(i, j) = row.spec.coordinate {
                    let (i, j) = (usize::from(i), usize::from(j));
                    twist.set(i, j, twist.get(i, j) + impulse);
                    turned = true;
                }
            }
            if turned {
                let in_world = joint.axes * twist.to_matrix() * joint.axes.transpose();
                joint.step_twist += Bivector::from_antisymmetric_part(&in_world);
            }
        }
    }
}

impl<const N: usize> JointRows<N> {
    /// One where the held rows of a joint are nearly met, zero where they are far off. One sweep does not solve a large net; what its
    /// joints would change beyond their tangents, and what they pressed before, then lead away from the solution instead of to it. Soft joints have
    /// gaps by design.
    fn firmness(&self, rows: &[Row<N>]) -> f64 {
        if self.soft.is_some() {
            return 1.0;
        }
        let mut gap: f64 = 0.0;
        for row in rows {
            if let (Role::Held(place), Coordinate::Point(_) | Coordinate::Slide(_) | Coordinate::Length) =
                (row.spec.role, row.spec.coordinate)
            {
                gap = gap.max((row.value - place).abs());
            }
        }
        ((FIRM.end - gap) / (FIRM.end - FIRM.start)).clamp(0.0, 1.0)
    }

    /// Solves the held rows together.
    fn solve_held(
        &self,
        rows: &mut [Row<N>],
        factors: &[f64],
        (a, b): (&Place<N>, &Place<N>),
        moving: &mut Moving<'_, N>,
        pass: Pass,
        stiff: &Softness,
    ) {
        if rows.is_empty() || (self.soft.is_some() && matches!(pass, Pass::Settle)) {
            return;
        }
        let soft = self.soft.as_ref().unwrap_or(stiff);
        let mut change = [0.0; MOST_HELD];
        for (wanted, row) in change.iter_mut().zip(rows.iter()) {
            let rate = row.rate(a, b, moving);
            *wanted = match (pass, row.spec.role) {
                (Pass::Move, Role::Held(place)) => rate + row.curve + soft.bias_rate * (row.value - place),
                _ => rate,
            };
        }
        block::solve(factors, rows.len(), &mut change);
        for (change, row) in change.iter_mut().zip(rows.iter()) {
            *change = match pass {
                Pass::Move => -soft.mass_scale * *change - soft.impulse_scale * row.impulse,
                Pass::Settle => -*change,
            };
        }
        if self.soft.is_some() {
            self.weaken(rows, &mut change);
        }
        for (row, change) in rows.iter_mut().zip(change) {
            match pass {
                Pass::Move => row.impulse += change,
                Pass::Settle => row.settle += change,
            }
            row.apply(a, b, moving, change);
        }
    }

    /// Keeps a soft joint within its strength, whatever the direction.
    fn weaken(&self, rows: &[Row<N>], change: &mut [f64; MOST_HELD]) {
        let turns = |row: &Row<N>| matches!(row.spec.coordinate, Coordinate::Turn(..));
        for (turning, limit) in [(false, self.max_impulse), (true, self.max_twist)] {
            let of_sort = || rows.iter().enumerate().filter(move |(_, row)| turns(row) == turning);
            let size =
                of_sort().map(|(k, row)| (row.impulse + change[k]) * (row.impulse + change[k])).sum::<f64>().sqrt();
            if size > limit {
                for (k, row) in of_sort() {
                    change[k] = (row.impulse + change[k]) * (limit / size) - row.impulse;
                }
            }
        }
    }
}

/// Fastest that a limit pushes back what is beyond it, m/s or rad/s.
const PUSH_BACK: f64 = 4.0;

impl<const N: usize> Row<N> {
    /// Rate of the coordinate, impulses included.
    fn rate(&self, a: &Place<N>, b: &Place<N>, moving: &Moving<'_, N>) -> f64 {
        let on = |place: &Place<N>, arm: &[f64]| {
            let inverse_sqrt_mass = moving.bodies[place.row].inverse_sqrt_mass;
            if place.row == 0 || inverse_sqrt_mass == 0.0 {
                return 0.0;
            }
            let at = place.row * Sizes::<N>::STATE;
            let state = &moving.state[at..at + Sizes::<N>::VELOCITY];
            let mut linear = 0.0;
            for i in 0..N {
                linear += self.direction[i] * f64::from(state[i]);
            }
            let mut sum = linear * inverse_sqrt_mass;
            for k in 0..Sizes::<N>::K {
                sum += arm[k] * f64::from(state[N + k]);
            }
            sum
        };
        self.base + on(b, &self.arm_b) - on(a, &self.arm_a)
    }

    /// An impulse on b, and its opposite on a.
    fn apply(&self, a: &Place<N>, b: &Place<N>, moving: &mut Moving<'_, N>, impulse: f64) {
        let mut on = |place: &Place<N>, arm: &[f64], impulse: f64| {
            let body: &SolverBody<N> = &moving.bodies[place.row];
            if place.row == 0 || body.inverse_sqrt_mass == 0.0 {
                return;
            }
            let at = place.row * Sizes::<N>::STATE;
            let state = &mut moving.state[at..at + Sizes::<N>::VELOCITY];
            let linear = impulse * body.inverse_sqrt_mass;
            for i in 0..N {
                state[i] += (self.direction[i] * linear) as Real;
            }
            for k in 0..Sizes::<N>::K {
                state[N + k] += (arm[k] * impulse) as Real;
            }
        };
        on(a, &self.arm_a, -impulse);
        on(b, &self.arm_b, impulse);
    }

    /// Solves a row by itself: a limit, a motor, a spring.
    fn solve(&mut self, a: &Place<N>, b: &Place<N>, moving: &mut Moving<'_, N>, pass: Pass, h: f64, stiff: &Softness) {
        let rate = self.rate(a, b, moving);
        let mut held = self.impulse + self.settle;
        let wanted = match self.spec.role {
            Role::Held(_) => return,
            Role::AtLeast(least) => held + self.push(rate, self.value - least, 1.0, pass, h, stiff).max(-held),
            Role::AtMost(greatest) => held - self.push(-rate, greatest - self.value, -1.0, pass, h, stiff).max(held),
            Role::Driven(motor) => {
                let limit = motor.max_force * h;
                (held - self.mass * (rate - motor.speed)).clamp(-limit, limit)
            }
            Role::Sprung(spring) => {
                if matches!(pass, Pass::Settle) {
                    return;
                }
                let soft = Softness::new(spring.hz, spring.damping_ratio, h);
                let error = rate + self.curve + soft.bias_rate * self.off(spring.target);
                let limit = spring.max_force * h;
                (held - soft.mass_scale * self.mass * error - soft.impulse_scale * held).clamp(-limit, limit)
            }
        };
        let change = wanted - held;
        held = wanted;
        match pass {
            Pass::Move => self.impulse = held - self.settle,
            Pass::Settle => self.settle = held - self.impulse,
        }
        self.apply(a, b, moving, change);
    }

    /// How far the coordinate is from a target; angles the short way round.
    fn off(&self, target: f64) -> f64 {
        let off = self.value - target;
        if matches!(self.spec.coordinate, Coordinate::Angle(..)) { off - TAU * (off / TAU).round() } else { off }
    }

    /// What a limit adds to its impulse, counted inwards: `room` is the distance to it, closing at −`rate`.
    fn push(&self, rate: f64, room: f64, sense: f64, pass: Pass, h: f64, stiff: &Softness) -> f64 {
        let curve = sense * self.curve;
        match pass {
            Pass::Move if room > 0.0 => -self.mass * (rate + curve + room / h),
            Pass::Move => {
                let bias = (stiff.bias_rate * room).max(-PUSH_BACK);
                -stiff.mass_scale * self.mass * (rate + curve + bias) - stiff.impulse_scale * sense * self.impulse
            }
            Pass::Settle => -self.mass * (rate + (room / h).max(0.0)),
        }
    }
}

//! What rows give way, as springs, and how fast they draw back.

use super::aim::PUSH_BACK;
use super::geometry::response;
use super::{JointRows, Row, block};
use crate::joint::{Coordinate, Role, Spring};
use crate::solver::bodies::SolverBody;
use crate::solver::softness::Softness;

/// Most rows of a joint that are held: all of 6D, a rod and a coupling.
const MOST_HELD: usize = 6 + 15 + 2;

/// Least share of a spring's response that its joint can leave it.
const LEAST_FREE: f64 = 1e-6;

/// The part of its speed below which a motor stands still: one that takes minutes to set out is faster after half a second.
const STALLED: f64 = 1e-3;

/// What a spring moves has come to its place where it would go no farther, m or rad, in this time, s, and in that in which the spring acts.
const LEAST_WAY: f64 = 1e-3;
const REST_TIME: f64 = 0.5;

/// The part of its length by which a rigid rod is drawn back at most. Two rods that contradict each other pull as hard as they are
/// off; with k = m ω² a pull of k·ΔL lets what hangs between them swing sideways at √(2 k ΔL/(m L)), which is faster than substeps can follow
/// from an eighth of the length on.
const MOST_STRETCH: f64 = 0.05;

/// How much of the way beyond its place counts for a rigid row: of rods and ropes no more than a part of their length.
pub(super) fn drawn_back(beyond: f64, coordinate: Coordinate, length: f64) -> f64 {
    if coordinate == Coordinate::Length { beyond.min(MOST_STRETCH * length) } else { beyond }
}

impl<const N: usize> JointRows<N> {
    /// Finds what the rows have to do with each other, and what those give way that are not held.
    pub(super) fn weigh(&self, rows: &mut [Row<N>], own: &mut [f64], (a, b): (&SolverBody<N>, &SolverBody<N>), h: f64) {
        let mut at = 0;
        for i in 0..rows.len() {
            for j in 0..=i {
                own[at] = response(&rows[i], &rows[j], a, b);
                at += 1;
            }
            rows[i].response = own[at - 1];
        }
        let of_masses = a.inverse_sqrt_mass * a.inverse_sqrt_mass + b.inverse_sqrt_mass * b.inverse_sqrt_mass;
        for index in 0..rows.len() {
            let row = &rows[index];
            let angle = matches!(row.spec.coordinate, Coordinate::Angle(..) | Coordinate::Swing(..));
            let same = |other: &Row<N>| other.spec.coordinate == row.spec.coordinate;
            let driven = rows.iter().any(|other| same(other) && other.spec.role.drives());
            let response = match row.spec.role {
                Role::Held(_) if !self.exact => 0.0,
                Role::AtLeast(_) | Role::AtMost(_) if driven => row.response,
                Role::Held(_) if row.turns() => row.response_of_own_moments((a, b)),
                Role::AtLeast(_) | Role::AtMost(_) if angle => self.response_while_held(own, index),
                // Not by levers, or what hangs on a long arm would give way far too much.
                Role::Held(_) | Role::AtLeast(_) | Role::AtMost(_) => of_masses,
                Role::Sprung(_) | Role::Elastic(..) => self.response_while_held(own, index),
                Role::Driven(_) => row.response,
            };
            rows[index].compliance = row.compliance(response, self, driven, h);
        }
    }

    /// Finds what the springs of the held rows ask for: back to their places, as fast as is good, and less the more they bear. Where joints are
    /// solved by themselves, by a share of K λ, so that they swing at one frequency in every direction.
    pub(super) fn draw_in(&self, rows: &mut [Row<N>], own: &[f64]) {
        let held = self.held - self.first;
        let compliance = self.soft.compliance();
        let (mut given_sq, mut back_sq) = (0.0, 0.0);
        for i in 0..held {
            let given = if self.exact {
                rows[i].compliance * rows[i].impulse
            } else {
                let of_all = (0..held).map(|j| own[block::len(i.max(j)) + i.min(j)] * rows[j].impulse);
                compliance * of_all.sum::<f64>()
            };
            rows[i].drawn = given;
            given_sq += given * given;
            let back = self.back(&rows[i]);
            back_sq += back * back;
        }
        // What it gives way comes on top, or a great load would open the joint without end.
        let (fastest, wanted) = (PUSH_BACK + given_sq.sqrt(), back_sq.sqrt());
        let share = if wanted > fastest && !self.is_soft { fastest / wanted } else { 1.0 };
        for row in &mut rows[..held] {
            row.drawn += share * self.back(row);
        }
    }

    /// The speed with which the spring of a held row draws back, m/s or rad/s.
    fn back(&self, row: &Row<N>) -> f64 {
        let Role::Held(place) = row.spec.role else { return 0.0 };
        let mut off = row.value - place;
        if !self.is_soft {
            off = off.signum() * drawn_back(off.abs(), row.spec.coordinate, row.value.max(place));
        }
        self.soft.bias_rate * off
    }

    /// What an impulse changes the rate of a row by while the held rows of the joint hold: K_rr − K_rh K_hh⁻¹ K_hr.
    fn response_while_held(&self, own: &[f64], row: usize) -> f64 {
        let held = self.held - self.first;
        let mut factors = [0.0; block::len(MOST_HELD)];
        factors[..block::len(held)].copy_from_slice(&own[..block::len(held)]);
        block::factorize(&mut factors, held);
        let pull = &own[block::len(row)..][..held];
        let mut answer = [0.0; MOST_HELD];
        answer[..held].copy_from_slice(pull);
        block::solve(&factors, held, &mut answer);
        let given: f64 = pull.iter().zip(&answer).map(|(pull, answer)| pull * answer).sum();
        let whole = own[block::len(row) + row];
        (whole - given).max(LEAST_FREE * whole)
    }

    /// Whether a row drives something on, however slowly.
    pub(super) fn creeps(&self, row: &Row<N>, h: f64) -> bool {
        let soft = |spring: &Spring| Softness::new(spring.hz, spring.damping_ratio, h);
        let spring = match &row.spec.role {
            Role::Driven(motor) => return motor.speed != 0.0 && row.rate.abs() > STALLED * motor.speed.abs(),
            Role::Sprung(spring) => soft(spring),
            Role::Elastic(spring, _) if row.impulse != 0.0 => soft(spring),
            Role::Held(_) if self.is_soft => self.soft,
            _ => return false,
        };
        row.rate.abs() * (REST_TIME + spring.settling_time(h)) > LEAST_WAY
    }

    /// Keeps a soft joint within its strength, whatever the direction.
    pub(super) fn weaken(&self, rows: &[Row<N>], change: &mut [f64]) {
        let held = &rows[..self.held - self.first];
        for (turning, limit) in [(false, self.max_impulse), (true, self.max_twist)] {
            let of_sort = || held.iter().enumerate().filter(move |(_, row)| row.turns() == turning);
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

impl<const N: usize> Row<N> {
    /// Whether it tells how far a locked plane is off.
    pub(super) fn turns(&self) -> bool {
        matches!(self.spec.coordinate, Coordinate::Turn(..))
    }

    /// The response of a turn without the moments that bodies got on top for this step. A joint that gave way less the more they got would
    /// press harder for that, and they would get yet more: two welds that contradict each other drove their body that way to
    /// infinity.
    fn response_of_own_moments(&self, bodies: (&SolverBody<N>, &SolverBody<N>)) -> f64 {
        if bodies.0.added_moment == 0.0 && bodies.1.added_moment == 0.0 {
            return self.response;
        }
        let of = |arm: &[f64], body: &SolverBody<N>| -> f64 {
            let inverse = &*body.inverse_sqrt_moments;
            let own = |inverse: &f64| (1.0 - body.added_moment * inverse * inverse).max(f64::EPSILON);
            arm.iter().zip(inverse).map(|(arm, inverse)| arm * arm / own(inverse)).sum()
        };
        of(&self.arm_a, bodies.0) + of(&self.arm_b, bodies.1)
    }
}

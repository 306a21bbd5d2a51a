//! The passes over joints.

use hyperbody_math::Bivector;

use super::aim::PUSH_BACK;
use super::cluster::Cluster;
use super::factor::{self, Parts};
use super::geometry::response;
use super::place::{Moment, Place};
use super::{JointRows, Joints, Moving, Row, block};
use crate::joint::{Coordinate, Role};
use crate::solver::Real;
use crate::solver::bodies::{Sizes, SolverBody};

/// Most rows of a joint that are held: all of 6D, a rod and a coupling.
const MOST_HELD: usize = 6 + 15 + 2;

/// Times that a cluster may change its mind about which limits press and which motors are at their strength.
const ROUNDS: usize = 6;

/// How often a cluster may look ahead, and how far it may miss the place that it foresaw, m or rad, without looking again.
const LOOKS: usize = 4;
const FORESEEN: f64 = 1e-4;

/// The part of the last look's miss that the next one may have. Where joints are far from what they hold, looking ahead does not
/// converge, and would throw the bodies.
const CLOSER: f64 = 0.5;

/// How far locked planes may be off, rad, for what their coordinates do beyond tangents to be told: the logarithm of a turn has other
/// derivatives there than those of its levers, and none at π.
const ASTRAY: f64 = 1.0;

/// Least share of a spring's response that its joint can leave it.
const LEAST_FREE: f64 = 1e-6;

/// The part of its length by which a rigid rod is drawn back at most. Two rods that contradict each other pull as hard as they are
/// off; with k = m ω² a pull of k·ΔL lets what hangs between them swing sideways at √(2 k ΔL/(m L)), which is faster than substeps can follow
/// from an eighth of the length on.
const MOST_STRETCH: f64 = 0.05;

/// How much of the way beyond its place counts for a rigid row: of rods and ropes no more than a part of their length.
pub(super) fn drawn_back(beyond: f64, coordinate: Coordinate, length: f64) -> f64 {
    if coordinate == Coordinate::Length { beyond.min(MOST_STRETCH * length) } else { beyond }
}

/// Which pass.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Pass {
    /// Before positions move.
    Move,
    /// After.
    Settle,
}

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
            let own = &mut self.own[joint.own..][..block::len(rows.len())];
            joint.weigh(rows, own, (&moving.bodies[a.row], &moving.bodies[b.row]), moment.h);
        }
        for index in 0..self.plan.clusters.len() {
            self.factorize(index, moving);
        }
    }

    fn factorize(&mut self, cluster: usize, moving: &Moving<'_, N>) {
        let (joints, rows, own, places) = (&self.joints, &self.rows, &self.own, &self.places);
        let parts = Parts { joints, rows, own, places, bodies: moving.bodies };
        let cluster = &self.plan.clusters[cluster];
        let numbers = (self.factors.as_mut_slice(), &mut self.scratch);
        factor::factorize(&self.plan, cluster, &parts, numbers, moving.processor);
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

    /// Applies the impulses that the last substep's pass of the same sort ended with. `h` is the length of a substep, s.
    pub(crate) fn warm_start(&mut self, moving: &mut Moving<'_, N>, pass: Pass, h: f64) {
        for joint in &self.joints {
            let (a, b) = (&self.places[joint.a], &self.places[joint.b]);
            for row in &mut self.rows[joint.first..joint.end] {
                let impulse = match pass {
                    Pass::Move => {
                        if !joint.splits(row) {
                            // The range is another one when a motor was changed between steps.
                            let (least, most) = row.range(h);
                            row.impulse = (row.impulse + row.settle).clamp(least, most);
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
        for joint in self.joints.iter().filter(|joint| joint.exact || joint.is_soft) {
            joint.bend(&self.places, &mut self.rows, moving, moment.h);
        }
    }

    /// One sweep over all clusters, forth before the move and back after it.
    pub(crate) fn solve(&mut self, moving: &mut Moving<'_, N>, pass: Pass, moment: &Moment) {
        let count = self.plan.clusters.len();
        for index in 0..count {
            let index = match pass {
                Pass::Move => index,
                Pass::Settle => count - 1 - index,
            };
            let looks_ahead = matches!(pass, Pass::Move) && self.plan.clusters[index].whole;
            let mut before = f64::INFINITY;
            for look in 1..=LOOKS {
                let error = self.solve_cluster(index, moving, pass, moment.h);
                if !looks_ahead || error * moment.h < FORESEEN {
                    break;
                }
                if look == LOOKS || error > CLOSER * before {
                    self.look_nowhere(index);
                    self.solve_cluster(index, moving, pass, moment.h);
                    break;
                }
                before = error;
                self.look_further(index, moving, moment);
            }
        }
    }

    /// Leaves a cluster to its tangents, as when nothing is known of what lies ahead.
    fn look_nowhere(&mut self, cluster: usize) {
        for node in self.plan.nodes_of(&self.plan.clusters[cluster]) {
            let joint = &self.joints[node.joint as usize];
            self.rows[joint.first..joint.end].iter_mut().for_each(|row| row.curve = 0.0);
        }
    }

    /// Looks where a cluster goes once more: what it was thought to do was wrong.
    fn look_further(&mut self, cluster: usize, moving: &Moving<'_, N>, moment: &Moment) {
        for node in self.plan.nodes_of(&self.plan.clusters[cluster]) {
            let joint = &self.joints[node.joint as usize];
            for place in [joint.a, joint.b] {
                self.places[place].look_ahead(moving, moment);
            }
        }
        for node in self.plan.nodes_of(&self.plan.clusters[cluster]) {
            let joint = &self.joints[node.joint as usize];
            joint.bend(&self.places, &mut self.rows, moving, moment.h);
        }
    }

    /// Solves the joints of a cluster together, with limits and motors within their ranges: rows that would leave theirs are set to
    /// its end and taken out of the system, until the rest stays within; then rows that should come in, or come back, are taken in, and so on
    /// until nothing changes. Returns the largest error of a rate that it found, m/s or rad/s.
    fn solve_cluster(&mut self, index: usize, moving: &mut Moving<'_, N>, pass: Pass, h: f64) -> f64 {
        let cluster = self.plan.clusters[index].clone();
        self.unknowns.clear();
        self.unknowns.resize(cluster.unknowns as usize, 0.0);
        let (mut solved, mut largest) = (false, None);
        for _ in 0..ROUNDS {
            // Each time but the last takes out one row at least.
            for _ in 0..=cluster.unknowns {
                let (changed, error) = self.wish(&cluster, moving, pass, h);
                largest = largest.or(Some(error));
                if solved && !changed {
                    return largest.unwrap_or(0.0);
                }
                solved = false;
                if changed {
                    self.factorize(index, moving);
                }
                let numbers = (self.factors.as_slice(), &mut self.scratch);
                factor::solve(&self.plan, &cluster, numbers, &mut self.unknowns, moving.processor);
                if !self.stop_at_ends(&cluster, moving, pass, h) {
                    break;
                }
            }
            self.apply(&cluster, moving, pass, h);
            solved = true;
            if !cluster.bounded {
                break;
            }
        }
        largest.unwrap_or(0.0)
    }

    /// Writes what the rows of a cluster want; whether rows came in or went out.
    fn wish(&mut self, cluster: &Cluster, moving: &Moving<'_, N>, pass: Pass, h: f64) -> (bool, f64) {
        let (mut changed, mut largest) = (false, 0.0_f64);
        for node in self.plan.nodes_of(cluster) {
            let joint = &self.joints[node.joint as usize];
            let (a, b) = (&self.places[joint.a], &self.places[joint.b]);
            let unknowns = node.of(&mut self.unknowns);
            let rows = &mut self.rows[joint.first..joint.end];
            if matches!(pass, Pass::Move) {
                joint.draw_in(rows, &self.own[joint.own..]);
            }
            for (unknown, row) in unknowns.iter_mut().zip(rows) {
                let error = row.error(row.rate(a, b, moving), pass, h, joint);
                let engaged = error.is_some_and(|error| !row.stopped && row.engages(error, h));
                changed |= engaged != row.engaged;
                row.engaged = engaged;
                *unknown = if engaged { -error.unwrap_or(0.0) } else { 0.0 };
                largest = largest.max(unknown.abs());
            }
        }
        (changed, largest)
    }

    /// Sets rows that would leave their range to its end; whether there were some.
    fn stop_at_ends(&mut self, cluster: &Cluster, moving: &mut Moving<'_, N>, pass: Pass, h: f64) -> bool {
        let mut stopped = false;
        if !cluster.bounded {
            return false;
        }
        for node in self.plan.nodes_of(cluster) {
            let joint = &self.joints[node.joint as usize];
            let (a, b) = (&self.places[joint.a], &self.places[joint.b]);
            let unknowns = node.of(&mut self.unknowns);
            let rows = self.rows[joint.first..joint.end].iter_mut();
            for (unknown, row) in unknowns.iter().zip(rows).filter(|(_, row)| row.engaged) {
                let (least, most) = row.range(h);
                let impulse = row.impulse + row.settle;
                let wanted = (impulse + unknown).clamp(least, most);
                if wanted != impulse + unknown {
                    row.add(a, b, moving, pass, wanted - impulse);
                    row.stopped = true;
                    stopped = true;
                }
            }
        }
        stopped
    }

    /// Applies the solution.
    fn apply(&mut self, cluster: &Cluster, moving: &mut Moving<'_, N>, pass: Pass, h: f64) {
        for node in self.plan.nodes_of(cluster) {
            let joint = &self.joints[node.joint as usize];
            let (a, b) = (&self.places[joint.a], &self.places[joint.b]);
            let rows = &mut self.rows[joint.first..joint.end];
            let unknowns = node.of(&mut self.unknowns);
            if joint.is_soft {
                joint.weaken(rows, unknowns);
            }
            for (&mut unknown, row) in unknowns.iter_mut().zip(rows) {
                let (least, most) = row.range(h);
                let impulse = row.impulse + row.settle;
                row.add(a, b, moving, pass, (impulse + unknown).clamp(least, most) - impulse);
                row.stopped = false;
            }
        }
    }

    /// Adds the impulses of a substep to those of the step.
    pub(crate) fn add_up(&mut self) {
        for joint in &mut self.joints {
            let rows = &self.rows[joint.first..joint.end];
            let mut twist = Bivector::ZERO;
            let mut turned = false;
            for row in rows {
                let impulse = row.impulse + row.settle;
                joint.step_impulse += row.direction * impulse;
                if let Coordinate::Turn(i, j) | Coordinate::Angle(i, j) = row.spec.coordinate {
                    let (i, j) = (usize::from(i), usize::from(j));
                    twist.set(i, j, twist.get(i, j) + impulse);
                    turned = true;
                }
                if let (Coordinate::Coupled, Some((coupling, _))) = (row.spec.coordinate, &joint.coupling) {
                    let geometry = joint.geometry(&self.places[joint.a].now, &self.places[joint.b].now, rows);
                    joint.step_twist += geometry.mesh(coupling).about(geometry.gap) * impulse;
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
    /// Whether a row has impulses of its own in each pass; limits, motors and springs have one, which both passes mend, and so has
    /// whatever is not solved exactly.
    fn splits(&self, row: &Row<N>) -> bool {
        self.exact && !self.is_soft && matches!(row.spec.role, Role::Held(_))
    }

    /// Finds what each coordinate changes beyond its tangent on the way to where the bodies would be next.
    fn bend(&self, places: &[Place<N>], rows: &mut [Row<N>], moving: &Moving<'_, N>, h: f64) {
        let (a, b) = (&places[self.a], &places[self.b]);
        let rows = &mut rows[self.first..self.end];
        let ahead = self.geometry(&a.next, &b.next, rows);
        let turned_off_sq: f64 = rows.iter().filter(|row| row.turns()).map(|row| row.value * row.value).sum();
        let astray = turned_off_sq > ASTRAY * ASTRAY || ahead.turned_off() > 2.0 * ASTRAY;
        for row in rows {
            if astray && row.depends_on_turns() {
                row.curve = 0.0;
                continue;
            }
            let (rate, change) = (row.rate(a, b, moving), ahead.value(row.spec.coordinate) - row.value);
            row.curve = ahead.change_near(rate * h, row.spec.coordinate, change) / h - rate;
        }
    }

    /// Finds what the rows have to do with each other, and what those give way that are not held.
    fn weigh(&self, rows: &mut [Row<N>], own: &mut [f64], (a, b): (&SolverBody<N>, &SolverBody<N>), h: f64) {
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
            let angle = matches!(row.spec.coordinate, Coordinate::Angle(..));
            let same = |other: &Row<N>| other.spec.coordinate == row.spec.coordinate;
            let driven = rows.iter().any(|other| same(other) && matches!(other.spec.role, Role::Driven(_)));
            let response = match row.spec.role {
                Role::Held(_) if !self.exact => 0.0,
                Role::AtLeast(_) | Role::AtMost(_) if driven => row.response,
                Role::Held(_) if row.turns() => row.response_of_own_moments((a, b)),
                Role::AtLeast(_) | Role::AtMost(_) if angle => self.response_while_held(own, index),
                // Not by levers, or what hangs on a long arm would give way far too much.
                Role::Held(_) | Role::AtLeast(_) | Role::AtMost(_) => of_masses,
                Role::Sprung(_) => self.response_while_held(own, index),
                Role::Driven(_) => row.response,
            };
            rows[index].compliance = row.compliance(response, self, driven, h);
        }
    }

    /// Finds what the springs of the held rows ask for: back to their places, as fast as is good, and less the more they bear. Where joints are
    /// solved by themselves, by a share of K λ, so that they swing at one frequency in every direction.
    fn draw_in(&self, rows: &mut [Row<N>], own: &[f64]) {
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

    /// Keeps a soft joint within its strength, whatever the direction.
    fn weaken(&self, rows: &[Row<N>], change: &mut [f64]) {
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
    fn turns(&self) -> bool {
        matches!(self.spec.coordinate, Coordinate::Turn(..))
    }

    /// Whether its coordinate is defined as long as locked planes are not far off alone.
    fn depends_on_turns(&self) -> bool {
        matches!(self.spec.coordinate, Coordinate::Turn(..) | Coordinate::Angle(..) | Coordinate::Coupled)
    }

    /// The response of a turn without the moments that bodies got on top for this step. A joint that gave way less the more they got would
    /// press harder for that, and they would get yet more: two welds that contradict each other drove their body that way to
    /// infinity.
    fn response_of_own_moments(&self, bodies: (&SolverBody<N>, &SolverBody<N>)) -> f64 {
        if bodies.0.added_moment == 0.0 && bodies.1.added_moment == 0.0 {
            return self.response;
        }
        let of = |arm: &[f64], body: &SolverBody<N>| -> f64 {
            let inverse = &body.inverse_sqrt_moments[..Sizes::<N>::K];
            let own = |inverse: &f64| (1.0 - body.added_moment * inverse * inverse).max(f64::EPSILON);
            arm.iter().zip(inverse).map(|(arm, inverse)| arm * arm / own(inverse)).sum()
        };
        of(&self.arm_a, bodies.0) + of(&self.arm_b, bodies.1)
    }

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

    /// Takes one more impulse, and applies it.
    fn add(&mut self, a: &Place<N>, b: &Place<N>, moving: &mut Moving<'_, N>, pass: Pass, impulse: f64) {
        match pass {
            Pass::Move => self.impulse += impulse,
            Pass::Settle => self.settle += impulse,
        }
        self.apply(a, b, moving, impulse);
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
}

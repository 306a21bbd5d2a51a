//! The passes over joints.

use hyperbody_math::{Bivector, Vector};

use super::ahead::{CLOSER, FORESEEN, LOOKS};
use super::cluster::Cluster;
use super::factor::{self, Parts};
use super::place::{Moment, Place};
use super::{JointRows, Joints, Moving, Row, block};
use crate::joint::{Coordinate, Role};
use crate::solver::Real;
use crate::solver::bodies::{Sizes, SolverBody};

/// Times that a cluster may change its mind about which limits press and which motors are at their strength.
const ROUNDS: usize = 6;

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
            let geometry = joint.geometry_now((a, b), rows, moving, moment.h);
            joint.axes = geometry.axes;
            rows.iter_mut().for_each(|row| geometry.fill(row, a, b, moving.bodies));
            let own = &mut self.own[joint.own..][..block::len(rows.len())];
            joint.weigh(rows, own, (&moving.bodies[a.row], &moving.bodies[b.row]), moment.h);
        }
        for index in 0..self.plan.clusters.len() {
            self.factorize(index, moving);
        }
        self.nets.refresh(&self.plan.nets, moving, moment);
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

    /// One sweep over all clusters, forth before the move and back after it.
    pub(crate) fn solve(&mut self, moving: &mut Moving<'_, N>, pass: Pass, moment: &Moment) {
        match pass {
            Pass::Move => self.nets.before_move(&self.plan.nets, moving, moment.h),
            Pass::Settle => self.nets.after_move(&self.plan.nets, moving),
        }
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
                row.rate = row.rate(a, b, moving);
                let error = row.error(row.rate, pass, h, joint);
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
            let (mut gap, mut pull) = (Vector::ZERO, Vector::ZERO);
            let mut turned = false;
            for row in rows {
                let impulse = row.impulse + row.settle;
                joint.step_impulse += row.direction * impulse;
                if let Coordinate::Turn(i, j) | Coordinate::Angle(i, j) = row.spec.coordinate {
                    let (i, j) = (usize::from(i), usize::from(j));
                    twist.set(i, j, twist.get(i, j) + impulse);
                    turned = true;
                }
                if let Coordinate::Point(axis) = row.spec.coordinate {
                    (gap[usize::from(axis)], pull[usize::from(axis)]) = (row.value, impulse);
                }
                let geometry = || joint.geometry(&self.places[joint.a].now, &self.places[joint.b].now, rows);
                joint.step_twist += match (row.spec.coordinate, &joint.coupling) {
                    (Coordinate::Coupled, Some((coupling, _))) => {
                        let geometry = geometry();
                        geometry.mesh(coupling).about(geometry.gap) * impulse
                    }
                    (Coordinate::Swing(_), _) => row.plane * impulse,
                    _ => continue,
                };
            }
            if joint.meets_midway {
                joint.step_twist += Bivector::wedge(gap * -0.5, pull);
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
}

impl<const N: usize> Row<N> {
    /// Rate of the coordinate, impulses included.
    pub(super) fn rate(&self, a: &Place<N>, b: &Place<N>, moving: &Moving<'_, N>) -> f64 {
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

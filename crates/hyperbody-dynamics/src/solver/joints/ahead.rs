//! Looking ahead: what coordinates change beyond their tangents until the end of the substep, found at the place where the bodies
//! would be.

use super::place::{Moment, Place};
use super::{JointRows, Joints, Moving, Row};
use crate::joint::{Coordinate, Role};

/// How often a cluster may look ahead, and how far it may miss the place that it foresaw, m or rad, without looking again.
pub(super) const LOOKS: usize = 4;
pub(super) const FORESEEN: f64 = 1e-4;

/// The part of the last look's miss that the next one may have. Where joints are far from what they hold, looking ahead does not
/// converge, and would throw the bodies.
pub(super) const CLOSER: f64 = 0.5;

/// How far locked planes may be off, rad, for what their coordinates do beyond tangents to be told: the logarithm of a turn has other
/// derivatives there than those of its levers, and none at π.
const ASTRAY: f64 = 1.0;

impl<const N: usize> Joints<N> {
    /// Finds what each coordinate will change beyond its tangent at the velocities that warm starting left.
    pub(crate) fn look_ahead(&mut self, moving: &Moving<'_, N>, moment: &Moment) {
        for place in &mut self.places {
            place.look_ahead(moving, moment);
        }
        for joint in self.joints.iter().filter(|joint| joint.exact || joint.is_soft) {
            joint.bend(&self.places, &mut self.rows, moving, moment.h);
        }
    }

    /// Leaves a cluster to its tangents, as when nothing is known of what lies ahead.
    pub(super) fn look_nowhere(&mut self, cluster: usize) {
        for node in self.plan.nodes_of(&self.plan.clusters[cluster]) {
            let joint = &self.joints[node.joint as usize];
            self.rows[joint.first..joint.end].iter_mut().for_each(|row| row.curve = 0.0);
        }
    }

    /// Looks where a cluster goes once more: what it was thought to do was wrong.
    pub(super) fn look_further(&mut self, cluster: usize, moving: &Moving<'_, N>, moment: &Moment) {
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
}

impl<const N: usize> JointRows<N> {
    /// Finds what each coordinate changes beyond its tangent on the way to where the bodies would be next.
    fn bend(&self, places: &[Place<N>], rows: &mut [Row<N>], moving: &Moving<'_, N>, h: f64) {
        let (a, b) = (&places[self.a], &places[self.b]);
        let rows = &mut rows[self.first..self.end];
        let ahead = self.geometry(&a.next, &b.next, rows);
        let turned_off_sq: f64 = rows.iter().filter(|row| row.turns()).map(|row| row.value * row.value).sum();
        let astray = turned_off_sq > ASTRAY * ASTRAY || ahead.turned_off() > 2.0 * ASTRAY;
        for row in rows {
            // Where springs let the joint tilt as it likes, what a limit will do is anyone's guess.
            if (astray && row.depends_on_turns()) || (self.is_soft && row.is_limit()) {
                row.curve = 0.0;
                continue;
            }
            let (rate, change) = (row.rate(a, b, moving), ahead.value(row.spec.coordinate) - row.value);
            row.curve = ahead.change_near(rate * h, row.spec.coordinate, change) / h - rate;
        }
    }
}

impl<const N: usize> Row<N> {
    fn is_limit(&self) -> bool {
        matches!(self.spec.role, Role::AtLeast(_) | Role::AtMost(_))
    }

    /// Whether its coordinate is defined as long as locked planes are not far off alone.
    fn depends_on_turns(&self) -> bool {
        matches!(self.spec.coordinate, Coordinate::Turn(..) | Coordinate::Angle(..) | Coordinate::Coupled)
    }
}

//! Bodies that their joints would make swing faster than substeps can follow.
//!
//! A force F at an arm r holds a body upright like a pendulum: turned by an angle, it feels the moment F·r back, so that it
//! swings at √(F·r/I). A ball of a heavily loaded chain has a small I; once its swing takes less than about π substeps, no explicit
//! method follows, and it gains energy each time. Such bodies get as much moment of inertia on top, for this step, as makes
//! the swing slow enough (the geometric stiffness of S. Andrews, M. Teichmann and P. G. Kry, 2017, with its largest value in
//! all planes). Their momentum and energy count their own inertia only. Bodies that the substeps can follow are left as they are.

use crate::JointHandle;
use crate::handle::Arena;
use crate::joint::{Coordinate, Joint};

/// h²·F·r/I that is left alone: substeps of √½ of the swing's inverse frequency. Explicit steps go wrong at 4.
const FOLLOWED: f64 = 2.0;

/// Most that torques can ask for, in parts of the body's own least moment. Loads that can be come to less than one part;
/// joints that are swept or soft and contradict each other by half a radian turn harder the more moment there is, without end.
const MOST_BY_TWIST: f64 = 100.0;

/// What moments of bodies with small inertia have to be at least, by slot, kg·m².
#[derive(Clone, Debug, Default)]
pub(crate) struct Tension {
    least: Vec<f64>,
    /// The part of it that torques ask for.
    by_twist: Vec<f64>,
}

impl Tension {
    /// Takes the forces of the last substep. `h` is the length of a substep, s.
    pub(crate) fn find<const N: usize>(&mut self, joints: &Arena<Joint<N>, JointHandle>, slots: usize, h: f64) {
        self.least.clear();
        self.least.resize(slots, 0.0);
        self.by_twist.clear();
        self.by_twist.resize(slots, 0.0);
        for (_, joint) in joints.iter() {
            let (mut force_sq, mut twist) = (0.0, 0.0);
            for (row, impulses) in joint.rows.iter().zip(&joint.impulses) {
                let impulse = impulses[0] + impulses[1];
                match row.coordinate {
                    Coordinate::Turn(..) | Coordinate::Angle(..) | Coordinate::Swing(_) => twist += impulse.abs(),
                    _ => force_sq += impulse * impulse,
                }
            }
            // h²·F = h times the impulse.
            for (slot, arm) in [(joint.body_a, joint.arm_a), (joint.body_b, joint.arm_b)] {
                if let Some(least) = self.least.get_mut(slot as usize) {
                    *least += h * (force_sq.sqrt() * arm.norm() + twist) / FOLLOWED;
                }
                if let Some(by_twist) = self.by_twist.get_mut(slot as usize) {
                    *by_twist += h * twist / FOLLOWED;
                }
            }
        }
    }

    /// What a body's moments are to be raised by, when the smallest is `smallest`.
    pub(crate) fn added(&self, slot: u32, smallest: f64) -> f64 {
        let (Some(least), Some(by_twist)) = (self.least.get(slot as usize), self.by_twist.get(slot as usize)) else {
            return 0.0;
        };
        let excess = (by_twist - MOST_BY_TWIST * smallest).max(0.0);
        (least - excess - smallest).max(0.0)
    }
}

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

/// What moments of bodies with small inertia have to be at least, by slot, kg·m².
#[derive(Clone, Debug, Default)]
pub(crate) struct Tension {
    least: Vec<f64>,
}

impl Tension {
    /// Takes the forces of the last substep. `h` is the length of a substep, s.
    pub(crate) fn find<const N: usize>(&mut self, joints: &Arena<Joint<N>, JointHandle>, slots: usize, h: f64) {
        self.least.clear();
        self.least.resize(slots, 0.0);
        for (_, joint) in joints.iter() {
            let (mut force_sq, mut twist) = (0.0, 0.0);
            for (row, impulses) in joint.rows.iter().zip(&joint.impulses) {
                let impulse = impulses[0] + impulses[1];
                match row.coordinate {
                    Coordinate::Turn(..) | Coordinate::Angle(..) => twist += impulse.abs(),
                    _ => force_sq += impulse * impulse,
                }
            }
            // h²·F = h times the impulse.
            for (slot, arm) in [(joint.body_a, joint.arm_a), (joint.body_b, joint.arm_b)] {
                if let Some(least) = self.least.get_mut(slot as usize) {
                    *least += h * (force_sq.sqrt() * arm.norm() + twist) / FOLLOWED;
                }
            }
        }
    }

    /// What a body's moments are to be raised by, when the smallest is `smallest`.
    pub(crate) fn added(&self, slot: u32, smallest: f64) -> f64 {
        self.least.get(slot as usize).map_or(0.0, |least| (least - smallest).max(0.0))
    }
}

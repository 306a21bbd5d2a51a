//! What one axis or one plane of a joint may do.

use crate::WorldError;

/// A drive towards a speed, of limited strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// m/s along an axis, rad/s in a plane; of the second body against the first.
    pub speed: f64,
    /// Most that it can push, N, or turn, N·m; ≥ 0.
    pub max_force: f64,
}

/// A spring that draws to a place. Its stiffness follows from the masses, so that it swings at the frequency named whatever
/// hangs on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// Where it draws to: m along an axis, rad in a plane.
    pub target: f64,
    /// Frequency without damping, Hz, 1e-6 to 1e6; capped at a quarter of the substep rate.
    pub hz: f64,
    /// 0 swings on, 1 comes to rest without overshoot; up to 1e6. The integration, which is stable at every frequency, damps by a ratio of about
    /// π·hz·(length of a substep) more: 0.013 at 1 Hz and the default step.
    pub damping_ratio: f64,
    /// Most that it can pull, N, or turn, N·m; may be infinite.
    pub max_force: f64,
}

/// One axis or plane of a joint: what is not locked moves freely between its limits, if it has some.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Freedom {
    /// Nothing moves here.
    pub locked: bool,
    /// Least and greatest value, m or rad. Angles lie within a turn of 0, at most a turn apart (a whole turn limits nothing), and a body
    /// is taken to be beyond the nearer of the two.
    pub limits: Option<(f64, f64)>,
    /// A drive towards a speed.
    pub motor: Option<Motor>,
    /// A drive towards a place.
    pub spring: Option<Spring>,
}

impl Freedom {
    /// Nothing moves.
    pub const LOCKED: Self = Self { locked: true, limits: None, motor: None, spring: None };

    /// Everything moves.
    pub const FREE: Self = Self { locked: false, limits: None, motor: None, spring: None };

    /// Whether it needs to know where it is, not only how fast it moves.
    pub(crate) fn has_place(&self) -> bool {
        self.limits.is_some() || self.spring.is_some()
    }

    pub(crate) fn is_driven(&self) -> bool {
        self.has_place() || self.motor.is_some()
    }

    /// The same seen from the other side: of the plane ji in place of ij.
    pub(crate) fn reversed(self) -> Self {
        Self {
            limits: self.limits.map(|(low, high)| (-high, -low)),
            motor: self.motor.map(|motor| Motor { speed: -motor.speed, ..motor }),
            spring: self.spring.map(|spring| Spring { target: -spring.target, ..spring }),
            ..self
        }
    }

    /// `turn` bounds angles and how far they are apart.
    pub(crate) fn validate(&self, what: &str, turn: f64) -> Result<(), WorldError> {
        if self.locked && self.is_driven() {
            return Err(WorldError::bad_number(format!(
                "{what} is locked; it cannot have limits, a motor or a spring"
            )));
        }
        if let Some((low, high)) = self.limits
            && !(low.is_finite()
                && high.is_finite()
                && low < high
                && low >= -turn
                && high <= turn
                && high - low <= turn)
        {
            let range =
                if turn.is_finite() { ", in radians within a turn of 0 (±2π) and at most a turn apart" } else { "" };
            return Err(WorldError::bad_number(format!(
                "the limits of {what} are {low} and {high}; they must be finite, the lower one first{range} (lock what must not move)"
            )));
        }
        if let Some(motor) = self.motor
            && !(motor.speed.is_finite() && motor.max_force >= 0.0)
        {
            return Err(WorldError::bad_number(format!(
                "the motor of {what} has speed {} and largest force {}; the speed must be finite and the force 0 or more",
                motor.speed, motor.max_force
            )));
        }
        if let Some(spring) = self.spring {
            if !(spring.target.is_finite() && spring.max_force >= 0.0) {
                return Err(WorldError::bad_number(format!(
                    "the spring of {what} has target {} and largest force {}; the target must be finite and the force 0 or more",
                    spring.target, spring.max_force
                )));
            }
            check_spring(what, spring.hz, spring.damping_ratio)?;
        }
        Ok(())
    }
}

pub(crate) fn check_spring(what: &str, hz: f64, damping_ratio: f64) -> Result<(), WorldError> {
    if !(LEAST_HZ..=MOST_HZ).contains(&hz) || !(0.0..=MOST_DAMPING).contains(&damping_ratio) {
        return Err(WorldError::bad_number(format!(
            "the spring of {what} has {hz} Hz and damping ratio {damping_ratio}; the frequency must be from {LEAST_HZ} to {MOST_HZ} Hz, the ratio from 0 to {MOST_DAMPING}"
        )));
    }
    Ok(())
}

/// Frequencies of springs, Hz, and their damping ratios, within which no product of a step overflows or vanishes.
const LEAST_HZ: f64 = 1e-6;
const MOST_HZ: f64 = 1e6;
const MOST_DAMPING: f64 = 1e6;

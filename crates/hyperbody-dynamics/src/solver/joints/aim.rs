//! What each row of a joint wants: the error that its impulse should remove, and the impulses that it may have.

use super::give::drawn_back;
use super::{JointRows, Pass, Row};
use crate::joint::{Bound, Role};
use crate::solver::softness::Softness;

/// Fastest that anything beyond its place is pushed back, m/s or rad/s.
pub(super) const PUSH_BACK: f64 = 4.0;

/// What motors give way, in parts of their response: so little that a motor against a limit, or two motors against each other, end at
/// their strength and not at infinity.
const MOTOR_COMPLIANCE: f64 = 1e-4;

/// The same of limits of what a motor or a spring drives: less than motors, so that none drives through its own limit, however strong.
const LIMIT_COMPLIANCE: f64 = 1e-5;

impl<const N: usize> Row<N> {
    /// What the row wants its rate to change by, negated; nothing in passes that are not its own. `rate` counts all impulses so far.
    pub(super) fn error(&self, rate: f64, pass: Pass, h: f64, joint: &JointRows<N>) -> Option<f64> {
        let impulse = self.impulse + self.settle;
        match (self.spec.role, pass) {
            (Role::Held(_), Pass::Settle) => (!joint.is_soft).then_some(rate),
            (Role::Held(_), Pass::Move) => Some(rate + self.curve + self.drawn),
            (Role::AtLeast(least), _) => Some(self.towards_limit(rate, self.value - least, 1.0, pass, h, joint)),
            (Role::AtMost(greatest), _) => {
                Some(-self.towards_limit(-rate, greatest - self.value, -1.0, pass, h, joint))
            }
            (Role::Driven(motor), _) => Some(rate - motor.speed + self.compliance * impulse),
            (Role::Sprung(_) | Role::Elastic(..), Pass::Settle) => None,
            (Role::Sprung(spring), Pass::Move) => {
                let soft = Softness::new(spring.hz, spring.damping_ratio, h);
                Some(rate + self.curve + soft.bias_rate * (self.value - spring.target) + self.compliance * impulse)
            }
            (Role::Elastic(spring, bound), Pass::Move) => {
                let soft = Softness::new(spring.hz, spring.damping_ratio, h);
                let off = self.value - spring.target;
                let taut = if bound == Bound::Greatest { off > 0.0 } else { off < 0.0 };
                // What is slack is not damped: it feels the part of the substep alone in which it comes to be taut.
                let back = if taut { soft.bias_rate } else { 1.0 / h } * off;
                Some(rate + self.curve + back + self.compliance * impulse)
            }
        }
    }

    /// The impulses that it may have, N·s or N·m·s.
    pub(super) fn range(&self, h: f64) -> (f64, f64) {
        let either_way = |force: f64| (-force * h, force * h);
        match self.spec.role {
            Role::Held(_) => (f64::NEG_INFINITY, f64::INFINITY),
            Role::AtLeast(_) => (0.0, f64::INFINITY),
            Role::AtMost(_) => (f64::NEG_INFINITY, 0.0),
            Role::Driven(motor) => either_way(motor.max_force),
            Role::Sprung(spring) => either_way(spring.max_force),
            Role::Elastic(spring, Bound::Least) => (0.0, spring.max_force * h),
            Role::Elastic(spring, Bound::Greatest) => (-spring.max_force * h, 0.0),
        }
    }

    /// Whether the row can do something about an error.
    pub(super) fn engages(&self, error: f64, h: f64) -> bool {
        let (impulse, (least, most)) = (self.impulse + self.settle, self.range(h));
        (impulse > least || error < 0.0) && (impulse < most || error > 0.0)
    }

    /// The error at a limit, counted inwards: `room` is the distance to it, closing at −`rate`. Beyond it the row is a spring as
    /// held rows are, which gives way: between two limits that contradict each other neither presses without end.
    fn towards_limit(&self, rate: f64, room: f64, sense: f64, pass: Pass, h: f64, joint: &JointRows<N>) -> f64 {
        match pass {
            Pass::Settle => rate + (room / h).max(0.0),
            Pass::Move if room > 0.0 => rate + sense * self.curve + room / h,
            Pass::Move => {
                let beyond = drawn_back(-room, self.spec.coordinate, self.value.max(self.value - sense * room));
                let given = self.compliance * sense * (self.impulse + self.settle);
                // What it gives way comes on top, or a great load would drive it in without end.
                let back = (joint.rigid.bias_rate * beyond).min(PUSH_BACK + given.abs());
                rate + sense * self.curve - back + given
            }
        }
    }

    /// What the row gives way beside its response: a share of `response`, which of springs is that of the joint with its held rows holding.
    /// `driven` tells whether a motor or a spring drives the same coordinate.
    pub(super) fn compliance(&self, response: f64, joint: &JointRows<N>, driven: bool, h: f64) -> f64 {
        match self.spec.role {
            Role::Held(_) => joint.soft.compliance() * response,
            Role::AtLeast(_) | Role::AtMost(_) if driven => LIMIT_COMPLIANCE * response,
            Role::AtLeast(_) | Role::AtMost(_) => joint.rigid.compliance() * response,
            Role::Driven(_) => MOTOR_COMPLIANCE * response,
            Role::Sprung(spring) | Role::Elastic(spring, _) => {
                Softness::new(spring.hz, spring.damping_ratio, h).compliance() * response
            }
        }
    }
}

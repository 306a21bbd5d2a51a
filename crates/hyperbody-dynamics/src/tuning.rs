//! Every tunable number of the step, with unit, default, reason, and when not to touch it.

use crate::WorldError;

/// Numbers that trade stiffness, smoothness and reach. The defaults suit bodies of 0.1 to 10 metres.
///
/// The contact model is that of soft constraints in substeps (E. Catto, "Solver2D", 2024): a contact is a damped
/// spring, stiff enough to be invisible and soft enough that a tall stack converges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// Frequency of the contact spring in Hz; capped at a quarter of the substep rate. Default 45. A stack is an elastic
    /// column: of blocks of edge 1 m it buckles under its own weight above about 15 blocks at 30 Hz and 20 at 45 Hz, in every
    /// dimension; far above, neighbouring contacts start to ring.
    pub contact_hz: f64,
    /// Damping ratio of the contact spring; well over 1, so that overlap is removed without a bounce. Default 4: at 45 Hz one of 10
    /// makes walls and pyramids of twenty rows ring sideways, more every second; one of 3 still settles, deep piles later.
    pub contact_damping_ratio: f64,
    /// Fastest speed at which overlap is pushed apart, m/s. Default 3: deep overlaps dissolve instead of exploding.
    pub push_out_speed: f64,
    /// Overlap that is left alone, m. Default 0.0005: resting contacts stay touching, so they keep their impulses.
    pub slop: f64,
    /// Contacts are made this far ahead of touching, m. Default 0.02. Must stay above `slop`.
    pub speculative_distance: f64,
    /// A contact is kept, with its points carried along by the bodies, until one has moved this far against the other
    /// since the contact was computed, m. Default 0.005. Keeps resting contacts from changing their points, and spares
    /// most of the narrow phase in a settled pile. Only while the two close by less than the difference to
    /// `speculative_distance` a step, 0.9 m/s at the defaults. Below `speculative_distance`, or touching points would be missed.
    pub recycle_distance: f64,
    /// Approach speed below which nothing bounces, m/s. Default 1: balls come to rest.
    pub restitution_threshold: f64,
    /// Frequency of the joint spring in Hz. Default 60. Joints that are solved together have two and a half times as much, swept nets up to about
    /// twice as much; where joints are solved one by one, it is capped at a quarter of the substep rate.
    pub joint_hz: f64,
    /// Damping ratio of the joint spring. Default 5.
    pub joint_damping_ratio: f64,
    /// Most multiplications a substep, about, that a set of joints which hang together may cost to be solved together, and so
    /// exactly; ≥ 0, may be infinite. Default 10 million, some milliseconds a step. Nets of rigid ball joints between balls, cubes and the like get a
    /// fiftieth of it; beyond that they are swept, which is fast: a net of 20 × 20 balls in 3D opens by 30 mm under its weight, and by 5 with a budget of
    /// a thousand million. What else is beyond the budget is solved joint by joint, which stretches under load. Chains, small trees and small loops are always
    /// solved together.
    pub joint_budget: f64,
    /// Speed (of any point of the body) below which a body may fall asleep, m/s. Default 0.05. It also has to stay in one place, within 8 % of the way of
    /// this speed in `sleep_time`, or 2 % if it has joints: 2 mm and 0.5 mm.
    pub sleep_speed: f64,
    /// How long it has to be that slow and stay there, s. Default 0.5.
    pub sleep_time: f64,
    /// Largest speed of a body, m/s: faster ones are slowed to it. Default 4,000: four hundred times 10 m per step
    /// would outrun any broad phase.
    pub max_speed: f64,
    /// Largest angular speed of a body, rad/s. Default 1,000: three turns a step at 60 Hz.
    pub max_spin: f64,
    /// How far the boxes of the dynamic tree stand off their bodies, m. Default 0.05: slow bodies stay in their box
    /// for many steps.
    pub tree_margin: f64,
}

impl Tuning {
    /// The values of [`Tuning::default`].
    pub const DEFAULT: Self = Self {
        contact_hz: 45.0,
        contact_damping_ratio: 4.0,
        push_out_speed: 3.0,
        slop: 0.0005,
        speculative_distance: 0.02,
        recycle_distance: 0.005,
        restitution_threshold: 1.0,
        joint_hz: 60.0,
        joint_damping_ratio: 5.0,
        joint_budget: 1e7,
        sleep_speed: 0.05,
        sleep_time: 0.5,
        max_speed: 4000.0,
        max_spin: 1000.0,
        tree_margin: 0.05,
    };
}

impl Default for Tuning {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl Tuning {
    pub(crate) fn validate(&self) -> Result<(), WorldError> {
        let positive = [
            ("contact_hz", self.contact_hz),
            ("contact_damping_ratio", self.contact_damping_ratio),
            ("push_out_speed", self.push_out_speed),
            ("slop", self.slop),
            ("speculative_distance", self.speculative_distance),
            ("joint_hz", self.joint_hz),
            ("joint_damping_ratio", self.joint_damping_ratio),
            ("sleep_time", self.sleep_time),
            ("max_speed", self.max_speed),
            ("max_spin", self.max_spin),
            ("tree_margin", self.tree_margin),
        ];
        for (name, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(WorldError::bad_number(format!(
                    "tuning.{name} is {value}; it must be finite and positive"
                )));
            }
        }
        let not_negative = [
            ("recycle_distance", self.recycle_distance),
            ("restitution_threshold", self.restitution_threshold),
            ("sleep_speed", self.sleep_speed),
        ];
        for (name, value) in not_negative {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(WorldError::bad_number(format!("tuning.{name} is {value}; it must be finite, 0 or more")));
            }
        }
        if self.joint_budget.is_nan() || self.joint_budget < 0.0 {
            return Err(WorldError::bad_number(format!(
                "tuning.joint_budget is {}; it must be 0 or more",
                self.joint_budget
            )));
        }
        if self.speculative_distance < self.recycle_distance {
            return Err(WorldError::bad_number(format!(
                "tuning.recycle_distance is {}, above tuning.speculative_distance {}; touching points would be missed",
                self.recycle_distance, self.speculative_distance
            )));
        }
        if self.speculative_distance < self.slop {
            return Err(WorldError::bad_number(format!(
                "tuning.speculative_distance is {}, below tuning.slop {}; resting contacts would be forgotten",
                self.speculative_distance, self.slop
            )));
        }
        Ok(())
    }
}

//! Joints of a scene.

use super::{Angle, RotationSpec};

/// What ties two bodies of a scene together, or one to the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// What it keeps, and what it leaves free.
    pub kind: JointKind,
    /// Name of the first body; `None`: the world.
    pub a: Option<String>,
    /// Name of the second body.
    pub b: String,
    /// The anchor in the frame of `a` (of the world where there is none), m. Empty: its origin.
    pub anchor_a: Vec<f64>,
    /// The anchor in the frame of `b`, m. Empty: its origin.
    pub anchor_b: Vec<f64>,
    /// How the joint's axes are turned in the frame of `a`.
    pub rotation_a: RotationSpec,
    /// How the joint's axes are turned in the frame of `b`.
    pub rotation_b: RotationSpec,
    /// Least and greatest angle of a hinge, or place of a slider.
    pub limits: Option<JointLimits>,
    /// How far an axis of a ball or axle joint may swing.
    pub cone: Option<JointCone>,
    /// A drive of what is free in a hinge, slider or motor joint.
    pub motor: Option<JointMotor>,
    /// A spring on what is free in a hinge or slider.
    pub spring: Option<JointSpring>,
    /// Frequency (Hz) and damping ratio of the spring that holds in place of a rigid joint.
    pub softness: Option<[f64; 2]>,
    /// Force at which it breaks, N; `None`: never.
    pub break_force: Option<f64>,
    /// Torque at which it breaks, N·m; `None`: never.
    pub break_torque: Option<f64>,
    /// Whether the two bodies go on colliding.
    pub collide: bool,
}

/// The kinds of [`Joint`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum JointKind {
    /// Keeps a point on a point; all turns stay free.
    Ball,
    /// Turns in one plane of the joint's axes, such as "xz".
    Hinge {
        /// Two axes.
        plane: String,
    },
    /// Keeps the space of the joint's first axes, point by point.
    Axle {
        /// How many axes, 0..=n.
        keeps: u32,
    },
    /// Keeps everything.
    Weld,
    /// Slides along one of the joint's axes, such as "y".
    Slider {
        /// An axis.
        along: String,
    },
    /// Keeps the anchors at a distance.
    Distance {
        /// m, > 0.
        length: f64,
    },
    /// Keeps the anchors from going farther apart.
    Rope {
        /// m, > 0.
        length: f64,
    },
    /// Two wheels that mesh between their anchors.
    Gear {
        /// Two axes.
        plane: String,
        /// Teeth of the first and the second wheel; negative for one that runs inside the other.
        teeth: [i32; 2],
    },
    /// A wheel on a rack, which is the second body.
    Rack {
        /// Two axes of the rack's frame: along it, and across it towards the wheel.
        plane: String,
        /// Of the wheel, m.
        radius: f64,
    },
    /// Goes along an axis as it turns in a plane.
    Screw {
        /// Two axes.
        plane: String,
        /// An axis.
        along: String,
        /// How far it goes in a turn from the first axis of the plane to the second and on, m.
        lead: f64,
    },
    /// Keeps nothing: a motor alone, in one plane.
    Motor {
        /// Two axes.
        plane: String,
    },
}

/// Least and greatest value of what is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits {
    /// m, or rad, or degrees where `degrees` is set.
    pub range: [f64; 2],
    /// Whether the file gives degrees, so that writing it back changes no bit.
    pub degrees: bool,
}

/// How far one of the joint's axes may point away from where it points on the first body.
#[derive(Clone, Debug, PartialEq)]
pub struct JointCone {
    /// An axis, such as "y".
    pub along: String,
    /// Above 0 and below half a turn.
    pub angle: Angle,
}

/// A drive towards a speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointMotor {
    /// m/s or rad/s of `b` against `a`.
    pub speed: f64,
    /// Most that it pushes, N, or turns, N·m.
    pub max_force: f64,
}

/// A spring on what is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointSpring {
    /// m or rad.
    pub target: f64,
    /// Hz.
    pub hz: f64,
    /// 1: comes to rest without overshoot.
    pub damping_ratio: f64,
    /// N or N·m; `None`: as strong as it takes.
    pub max_force: Option<f64>,
}

impl Joint {
    /// A joint of some kind between two bodies, at the origins of their frames.
    #[must_use]
    pub fn new(kind: JointKind, a: impl Into<String>, b: impl Into<String>) -> Self {
        Self {
            kind,
            a: Some(a.into()),
            b: b.into(),
            anchor_a: Vec::new(),
            anchor_b: Vec::new(),
            rotation_a: RotationSpec::default(),
            rotation_b: RotationSpec::default(),
            limits: None,
            cone: None,
            motor: None,
            spring: None,
            softness: None,
            break_force: None,
            break_torque: None,
            collide: false,
        }
    }

    /// A joint of some kind between a body and the world.
    #[must_use]
    pub fn with_world(kind: JointKind, b: impl Into<String>) -> Self {
        Self { a: None, ..Self::new(kind, "", b) }
    }

    /// With anchors in the frames of the bodies, m.
    #[must_use]
    pub fn anchored(mut self, anchor_a: impl Into<Vec<f64>>, anchor_b: impl Into<Vec<f64>>) -> Self {
        self.anchor_a = anchor_a.into();
        self.anchor_b = anchor_b.into();
        self
    }

    /// With limits, degrees.
    #[must_use]
    pub fn limited_deg(mut self, least: f64, greatest: f64) -> Self {
        self.limits = Some(JointLimits { range: [least, greatest], degrees: true });
        self
    }

    /// With an axis that swings no farther than so many degrees.
    #[must_use]
    pub fn within_cone_deg(mut self, along: &str, angle: f64) -> Self {
        self.cone = Some(JointCone { along: along.to_owned(), angle: Angle::Degrees(angle) });
        self
    }

    /// With a motor.
    #[must_use]
    pub fn driven(mut self, speed: f64, max_force: f64) -> Self {
        self.motor = Some(JointMotor { speed, max_force });
        self
    }

    /// With a spring.
    #[must_use]
    pub fn sprung(mut self, target: f64, hz: f64, damping_ratio: f64) -> Self {
        self.spring = Some(JointSpring { target, hz, damping_ratio, max_force: None });
        self
    }

    /// The key under which a file has it.
    pub(crate) fn key(&self) -> &'static str {
        match self.kind {
            JointKind::Ball => "ball",
            JointKind::Hinge { .. } => "hinge",
            JointKind::Axle { .. } => "axle",
            JointKind::Weld => "weld",
            JointKind::Slider { .. } => "slider",
            JointKind::Distance { .. } => "distance",
            JointKind::Rope { .. } => "rope",
            JointKind::Gear { .. } => "gear",
            JointKind::Rack { .. } => "rack",
            JointKind::Screw { .. } => "screw",
            JointKind::Motor { .. } => "motor",
        }
    }
}

//! The definition from which a joint is made.

use std::f64::consts::{PI, TAU};

use hyperbody_math::{Pose, Vector, planes};

use super::freedom::check_spring;
use super::{Coupling, Freedom, Motor, Spring};
use crate::vetting::POSITION_LIMIT;
use crate::{BodyHandle, WorldError, WorldErrorKind};

/// Everything needed to make a joint. Start from one of the named joints, or from [`JointDef::free`] and lock what must not
/// move, and chain what differs.
///
/// Positions are m in the frame of the body; a joint with the world has `a: None` and its first frame in the world.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct JointDef<const N: usize> {
    /// First body; `None` is the world.
    pub a: Option<BodyHandle>,
    /// Second body, another one.
    pub b: BodyHandle,
    /// The joint's frame on the first body: body from joint.
    pub frame_a: Pose<N>,
    /// The joint's frame on the second body.
    pub frame_b: Pose<N>,
    /// What the anchor of `b` may do along each axis of the first frame.
    pub axes: [Freedom; N],
    /// What `b` may do in each plane of the first frame, lexicographic order.
    pub planes: Vec<Freedom>,
    /// An axis of the frames, and the largest angle, rad, from the first frame's to the second's: a cone within which it may point. Turns
    /// that leave the axis where it is stay free.
    pub cone: Option<(u8, f64)>,
    /// Least and greatest distance of the anchors, m; the greatest may be infinite.
    pub distance: Option<(f64, f64)>,
    /// What makes one motion follow another, as teeth and threads do.
    pub coupling: Option<Coupling>,
    /// What the coupling holds: rad for gears, the sum of teeth times angles, else m. Default: as the bodies lie when the joint is
    /// added, whose definition says it from then on.
    pub phase: Option<f64>,
    /// What is locked, and the bounds of the distance, are held by a spring of this frequency (Hz) and damping ratio, in place of
    /// rigidly. A soft rope is elastic: it pulls where it is taut alone.
    pub softness: Option<(f64, f64)>,
    /// Most force that a soft joint holds with, N. Default: infinite, as it must be without `softness`.
    pub max_force: f64,
    /// Most torque that a soft joint holds with, N·m. Default: infinite, as it must be without `softness`.
    pub max_torque: f64,
    /// Force at which the joint breaks, N. Default: infinite.
    pub break_force: f64,
    /// Torque at which the joint breaks, N·m. Default: infinite.
    pub break_torque: f64,
    /// Whether the two bodies go on colliding with each other. Default: no.
    pub collide: bool,
}

impl<const N: usize> JointDef<N> {
    /// A joint of which nothing is locked, with its anchors at the origins of the bodies' frames.
    #[must_use]
    pub fn free(a: impl Into<Option<BodyHandle>>, b: BodyHandle) -> Self {
        Self {
            a: a.into(),
            b,
            frame_a: Pose::IDENTITY,
            frame_b: Pose::IDENTITY,
            axes: [Freedom::FREE; N],
            planes: vec![Freedom::FREE; planes::count(N)],
            cone: None,
            distance: None,
            coupling: None,
            phase: None,
            softness: None,
            max_force: f64::INFINITY,
            max_torque: f64::INFINITY,
            break_force: f64::INFINITY,
            break_torque: f64::INFINITY,
            collide: false,
        }
    }

    /// Keeps a point of `a` on a point of `b`; all N(N−1)/2 turns stay free.
    #[must_use]
    pub fn ball(
        a: impl Into<Option<BodyHandle>>,
        b: BodyHandle,
        anchor_a: impl Into<Vector<N>>,
        anchor_b: impl Into<Vector<N>>,
    ) -> Self {
        let mut def = Self::free(a, b).anchors(anchor_a, anchor_b);
        def.axes = [Freedom::LOCKED; N];
        def
    }

    /// Keeps the frames on each other: the bodies move as one.
    #[must_use]
    pub fn weld(a: impl Into<Option<BodyHandle>>, b: BodyHandle, frame_a: Pose<N>, frame_b: Pose<N>) -> Self {
        let mut def = Self::free(a, b).frames(frame_a, frame_b);
        def.axes = [Freedom::LOCKED; N];
        def.planes.fill(Freedom::LOCKED);
        def
    }

    /// Turns in one plane alone, that of the frames' axes i and j, and keeps the (N−2)-dimensional space across it.
    ///
    /// # Panics
    /// If i = j or an axis is not below `N`.
    #[must_use]
    pub fn hinge(
        a: impl Into<Option<BodyHandle>>,
        b: BodyHandle,
        frame_a: Pose<N>,
        frame_b: Pose<N>,
        (i, j): (usize, usize),
    ) -> Self {
        Self::weld(a, b, frame_a, frame_b).plane(i, j, Freedom::FREE)
    }

    /// Keeps the space of the frames' first `kept` axes point by point; all turns across it are free.
    #[must_use]
    pub fn axle(
        a: impl Into<Option<BodyHandle>>,
        b: BodyHandle,
        frame_a: Pose<N>,
        frame_b: Pose<N>,
        kept: usize,
    ) -> Self {
        let mut def = Self::weld(a, b, frame_a, frame_b);
        for (k, (i, _)) in planes::all(N).enumerate() {
            if i >= kept {
                def.planes[k] = Freedom::FREE;
            }
        }
        def
    }

    /// Slides along one axis of the frames, and does not turn.
    ///
    /// # Panics
    /// If the axis is not below `N`.
    #[must_use]
    pub fn slider(
        a: impl Into<Option<BodyHandle>>,
        b: BodyHandle,
        frame_a: Pose<N>,
        frame_b: Pose<N>,
        axis: usize,
    ) -> Self {
        Self::weld(a, b, frame_a, frame_b).axis(axis, Freedom::FREE)
    }

    /// Keeps two points at a distance, m, as a rod without weight would. [`JointDef::softness`] makes it a spring.
    #[must_use]
    pub fn distance(
        a: impl Into<Option<BodyHandle>>,
        b: BodyHandle,
        anchor_a: impl Into<Vector<N>>,
        anchor_b: impl Into<Vector<N>>,
        length: f64,
    ) -> Self {
        let mut def = Self::free(a, b).anchors(anchor_a, anchor_b);
        def.distance = Some((length, length));
        def
    }

    /// Keeps two points from going farther apart than `length`, m. [`JointDef::softness`] makes it elastic.
    #[must_use]
    pub fn rope(
        a: impl Into<Option<BodyHandle>>,
        b: BodyHandle,
        anchor_a: impl Into<Vector<N>>,
        anchor_b: impl Into<Vector<N>>,
        length: f64,
    ) -> Self {
        let mut def = Self::free(a, b).anchors(anchor_a, anchor_b);
        def.distance = Some((0.0, length));
        def
    }

    /// The spring by which a hand drags the point `anchor` of a body (body frame, m) to `target` (world, m): 5 Hz,
    /// critically damped, with at most `max_force`, N. Move the target with [`World::set_joint_target`].
    ///
    /// [`World::set_joint_target`]: crate::World::set_joint_target
    #[must_use]
    pub fn mouse(body: BodyHandle, anchor: impl Into<Vector<N>>, target: impl Into<Vector<N>>, max_force: f64) -> Self {
        let mut def = Self::ball(None, body, target, anchor).softness(HAND_HZ, 1.0);
        def.max_force = max_force;
        def
    }

    /// A hand that also turns: draws the frame `grip` of a body (body from grip) to `target` (world from grip), as
    /// [`JointDef::mouse`] does, with at most `max_force`, N, and `max_torque`, N·m.
    #[must_use]
    pub fn grip(body: BodyHandle, grip: Pose<N>, target: Pose<N>, max_force: f64, max_torque: f64) -> Self {
        let mut def = Self::weld(None, body, target, grip).softness(HAND_HZ, 1.0);
        def.max_force = max_force;
        def.max_torque = max_torque;
        def
    }

    /// Keeps the origin of a body's frame from moving along some axes of the world, and the body from turning in some planes:
    /// a 3D scene inside 4D locks axis w and the planes xw, yw, zw. `pose` is the body's pose, whose values are kept. To keep
    /// another point, such as a centre of mass that lies elsewhere, give it to [`JointDef::anchors`].
    ///
    /// # Panics
    /// If an axis is not below `N`, or a plane has twice the same.
    #[must_use]
    pub fn lock(body: BodyHandle, pose: Pose<N>, axes: &[usize], planes: &[(usize, usize)]) -> Self {
        let frame_b = Pose::new(pose.rotation.inverse(), Vector::ZERO);
        let mut def = Self::free(None, body).frames(Pose::from_translation(pose.translation), frame_b);
        for &axis in axes {
            def.axes[axis] = Freedom::LOCKED;
        }
        for &(i, j) in planes {
            def = def.plane(i, j, Freedom::LOCKED);
        }
        def
    }

    /// Sets both anchors, each in the frame of its body, m; the first in the world for joints with the world.
    #[must_use]
    pub fn anchors(mut self, anchor_a: impl Into<Vector<N>>, anchor_b: impl Into<Vector<N>>) -> Self {
        self.frame_a = Pose::new(self.frame_a.rotation, anchor_a.into());
        self.frame_b = Pose::new(self.frame_b.rotation, anchor_b.into());
        self
    }

    /// Sets both frames, each in the frame of its body; the first in the world for joints with the world.
    #[must_use]
    pub fn frames(mut self, frame_a: Pose<N>, frame_b: Pose<N>) -> Self {
        self.frame_a = frame_a;
        self.frame_b = frame_b;
        self
    }

    /// Sets what one axis may do.
    ///
    /// # Panics
    /// If the axis is not below `N`.
    #[must_use]
    pub fn axis(mut self, axis: usize, freedom: Freedom) -> Self {
        self.axes[axis] = freedom;
        self
    }

    /// Sets what one plane may do; angles are positive from axis i to axis j.
    ///
    /// # Panics
    /// If i = j or an axis is not below `N`.
    #[must_use]
    pub fn plane(mut self, i: usize, j: usize, freedom: Freedom) -> Self {
        assert!(i != j && i < N && j < N, "a plane needs two different axes below {N}, got ({i}, {j})");
        self.planes[planes::index(N, i.min(j), i.max(j))] = if i < j { freedom } else { freedom.reversed() };
        self
    }

    /// Keeps an axis of the second frame within `largest_angle`, rad, above 0 and below π, of the same axis of the first: what in three dimensions
    /// is called the swing of a ball joint, in every dimension one limit.
    ///
    /// # Panics
    /// If the axis is not below `N`.
    #[must_use]
    pub fn cone(mut self, axis: usize, largest_angle: f64) -> Self {
        assert!(axis < N, "a cone needs an axis below {N}, got {axis}");
        self.cone = Some((axis as u8, largest_angle));
        self
    }

    /// Sets [`JointDef::softness`].
    #[must_use]
    pub fn softness(mut self, hz: f64, damping_ratio: f64) -> Self {
        self.softness = Some((hz, damping_ratio));
        self
    }

    /// Sets force (N) and torque (N·m) at which the joint breaks.
    #[must_use]
    pub fn break_at(mut self, force: f64, torque: f64) -> Self {
        self.break_force = force;
        self.break_torque = torque;
        self
    }

    /// Sets [`JointDef::collide`].
    #[must_use]
    pub fn collide(mut self, collide: bool) -> Self {
        self.collide = collide;
        self
    }

    /// Numbers of translations and turns of `b` against `a` that the joint leaves free when nothing is at a limit. A coupling
    /// takes one more from both together.
    #[must_use]
    pub fn free_motions(&self) -> (usize, usize) {
        let held = |freedom: &&Freedom| !freedom.locked;
        let rod = usize::from(self.distance.is_some_and(|(least, greatest)| least >= greatest));
        if self.softness.is_some() {
            return (N, planes::count(N));
        }
        (self.axes.iter().filter(held).count().saturating_sub(rod), self.planes.iter().filter(held).count())
    }

    /// Adds a motor to a plane, which must be free: rad/s from axis i to axis j, and N·m.
    ///
    /// # Panics
    /// If i = j or an axis is not below `N`.
    #[must_use]
    pub fn motor(self, i: usize, j: usize, speed: f64, max_torque: f64) -> Self {
        let freedom = Freedom { motor: Some(Motor { speed, max_force: max_torque }), ..self.plane_freedom(i, j) };
        self.plane(i, j, freedom)
    }

    /// Limits the angle of a plane, rad from axis i to axis j, which must be free.
    ///
    /// # Panics
    /// If i = j or an axis is not below `N`.
    #[must_use]
    pub fn angle_limits(self, i: usize, j: usize, least: f64, greatest: f64) -> Self {
        let freedom = Freedom { limits: Some((least, greatest)), ..self.plane_freedom(i, j) };
        self.plane(i, j, freedom)
    }

    /// Gives a plane, which must be free, a spring, whose target counts from axis i to axis j.
    ///
    /// # Panics
    /// If i = j or an axis is not below `N`.
    #[must_use]
    pub fn angle_spring(self, i: usize, j: usize, spring: Spring) -> Self {
        let freedom = Freedom { spring: Some(spring), ..self.plane_freedom(i, j) };
        self.plane(i, j, freedom)
    }

    fn plane_freedom(&self, i: usize, j: usize) -> Freedom {
        assert!(i != j && i < N && j < N, "a plane needs two different axes below {N}, got ({i}, {j})");
        let freedom = self.planes[planes::index(N, i.min(j), i.max(j))];
        if i < j { freedom } else { freedom.reversed() }
    }

    pub(crate) fn validate(&self) -> Result<(), WorldError> {
        for (name, frame) in [("frame_a", &self.frame_a), ("frame_b", &self.frame_b)] {
            check_frame(&format!("the anchor of {name}"), frame)?;
        }
        if self.planes.len() != planes::count(N) {
            return Err(WorldError::bad_number(format!(
                "the joint has {} planes; in {N} dimensions there are {}",
                self.planes.len(),
                planes::count(N)
            )));
        }
        for (axis, freedom) in self.axes.iter().enumerate() {
            freedom.validate(&format!("axis {}", planes::AXIS_NAMES[axis]), f64::INFINITY)?;
        }
        for (freedom, (i, j)) in self.planes.iter().zip(planes::all(N)) {
            freedom.validate(&format!("plane {}", planes::name(i, j)), TAU)?;
        }
        if let Some((least, greatest)) = self.distance
            && !(least >= 0.0 && least.is_finite() && least <= greatest && greatest > 0.0)
        {
            return Err(WorldError::bad_number(format!(
                "the distance lies between {least} and {greatest} m; the least must be 0 or more and finite, the greatest no smaller and above 0 (a ball joint keeps the distance 0)"
            )));
        }
        if let Some((axis, angle)) = self.cone {
            self.validate_cone(usize::from(axis), angle)?;
        }
        if let Some(coupling) = &self.coupling {
            coupling.validate(&self.axes, &self.planes)?;
        }
        if let Some(phase) = self.phase
            && !phase.is_finite()
        {
            return Err(WorldError::bad_number(format!("the phase of the coupling is {phase}; it must be finite")));
        }
        if let Some((hz, damping_ratio)) = self.softness {
            check_spring("the joint", hz, damping_ratio)?;
        }
        self.validate_strengths()?;
        self.groups().map(|_| ())
    }

    fn validate_strengths(&self) -> Result<(), WorldError> {
        let strengths = [
            ("max_force", self.max_force),
            ("max_torque", self.max_torque),
            ("break_force", self.break_force),
            ("break_torque", self.break_torque),
        ];
        for (name, value) in strengths {
            if value.is_nan() || value < 0.0 {
                return Err(WorldError::bad_number(format!("{name} is {value}; it must be 0 or more, or infinite")));
            }
        }
        if self.softness.is_none() && (self.max_force.is_finite() || self.max_torque.is_finite()) {
            return Err(WorldError::bad_number(format!(
                "max_force is {} and max_torque {}, but the joint is rigid; give it a softness, or use break_force and break_torque",
                self.max_force, self.max_torque
            )));
        }
        Ok(())
    }

    fn validate_cone(&self, axis: usize, angle: f64) -> Result<(), WorldError> {
        if !(axis < N && angle > 0.0 && angle < PI) {
            return Err(WorldError::bad_number(format!(
                "the cone is about axis {axis} and has the angle {angle}; the axis must be below {N}, the angle above 0 and below π"
            )));
        }
        let swings = |&(i, j): &(usize, usize)| (i == axis || j == axis) && !self.planes[planes::index(N, i, j)].locked;
        if !planes::all(N).any(|plane| swings(&plane)) {
            let name = planes::AXIS_NAMES[axis];
            return Err(WorldError::new(
                WorldErrorKind::NotAllowed,
                format!("all planes with axis {name} are locked, so it cannot swing; free one, or leave the cone out"),
            ));
        }
        Ok(())
    }

    /// The group of each axis: planes within a group are free, those between groups are locked.
    pub(crate) fn groups(&self) -> Result<[u8; N], WorldError> {
        let mut group: [u8; N] = std::array::from_fn(|axis| axis as u8);
        let free = |i: usize, j: usize| !self.planes[planes::index(N, i, j)].locked;
        for (i, j) in planes::all(N).filter(|&(i, j)| free(i, j)) {
            let (keep, give_up) = (group[i].min(group[j]), group[i].max(group[j]));
            group.iter_mut().filter(|other| **other == give_up).for_each(|other| *other = keep);
        }
        for (i, j) in planes::all(N) {
            let name = planes::name(i, j);
            if group[i] == group[j] && !free(i, j) {
                return Err(WorldError::new(
                    WorldErrorKind::NotAllowed,
                    format!(
                        "plane {name} is locked, but turns in the free planes add up to turns in it; free it, or lock more"
                    ),
                ));
            }
            let mates = group.iter().filter(|&&other| other == group[i]).count();
            if free(i, j) && mates > 2 && self.planes[planes::index(N, i, j)].has_place() {
                return Err(WorldError::new(
                    WorldErrorKind::NotAllowed,
                    format!(
                        "plane {name} shares its axes with other free planes: its angle is not defined, so it cannot have limits or a spring; a motor it can have"
                    ),
                ));
            }
        }
        Ok(group)
    }

    /// The frame of `b` whose axes are those of `a`, given how `a` and `b` lie in the world.
    #[must_use]
    pub fn frames_at(mut self, world_from_a: &Pose<N>, world_from_b: &Pose<N>, world_from_joint: &Pose<N>) -> Self {
        self.frame_a = world_from_a.inverse() * *world_from_joint;
        self.frame_b = world_from_b.inverse() * *world_from_joint;
        self
    }
}

/// Largest coordinate of an anchor, m: what lies within the bounds of positions, as seen from a turned frame at their other end.
const ANCHOR_LIMIT: f64 = 10.0 * POSITION_LIMIT;

/// That a frame is one, and near enough to do something.
pub(crate) fn check_frame<const N: usize>(what: &str, frame: &Pose<N>) -> Result<(), WorldError> {
    if frame.translation.max_abs() <= ANCHOR_LIMIT && frame.rotation.matrix().is_finite() {
        return Ok(());
    }
    Err(WorldError::bad_number(format!(
        "{what} is {:?}; its coordinates must lie within ±{ANCHOR_LIMIT:e} m, and its axes must be finite",
        frame.translation.0
    )))
}

/// Frequency of a hand's spring: follows within a tenth of a second.
const HAND_HZ: f64 = 5.0;

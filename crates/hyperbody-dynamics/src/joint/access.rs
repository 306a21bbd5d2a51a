//! Tying, untying, reading and steering joints.

use hyperbody_math::{Bivector, Pose, Vector};

use super::def::check_frame;
use super::{Joint, JointDef, WORLD};
use crate::body::Body;
use crate::world::{is_pair_of, stale};
use crate::{BodyHandle, BodyKind, JointHandle, World, WorldError, WorldErrorKind};

/// A joint as it is between two steps.
#[derive(Clone, Copy, Debug)]
pub struct JointRef<'a, const N: usize> {
    pub(crate) joint: &'a Joint<N>,
    pub(crate) dt: f64,
}

impl<'a, const N: usize> JointRef<'a, N> {
    /// Its definition, as it stands now.
    #[must_use]
    pub fn def(&self) -> &'a JointDef<N> {
        &self.joint.def
    }

    /// Impulse on the second body over the last step, through its anchor, world axes, N·s. The first body felt the
    /// opposite.
    #[must_use]
    pub fn impulse(&self) -> Vector<N> {
        self.joint.step_impulse
    }

    /// Turning impulse on the second body over the last step, beside that of [`JointRef::impulse`], world planes, N·m·s.
    #[must_use]
    pub fn angular_impulse(&self) -> Bivector<N> {
        self.joint.step_twist
    }

    /// Mean force on the second body over the last step, N.
    #[must_use]
    pub fn force(&self) -> Vector<N> {
        self.joint.step_impulse * (1.0 / self.dt)
    }

    /// Mean torque on the second body over the last step, N·m.
    #[must_use]
    pub fn torque(&self) -> Bivector<N> {
        self.joint.step_twist * (1.0 / self.dt)
    }
}

impl<const N: usize> World<N> {
    /// Ties two bodies together, or one to the world. They no longer collide with each other (unless the definition says so),
    /// and both wake.
    ///
    /// # Errors
    /// If a handle is stale, both are the same body, no impulse moves either, or a number of the definition is outside its
    /// range (see [`JointDef`]).
    pub fn add_joint(&mut self, def: JointDef<N>) -> Result<JointHandle, WorldError> {
        def.validate()?;
        let groups = def.groups()?;
        if def.a == Some(def.b) {
            return Err(WorldError::new(WorldErrorKind::NotAllowed, "a joint needs two different bodies"));
        }
        let body_b = self.bodies.get(def.b).ok_or_else(|| stale("body"))?;
        let mut moves = body_b.kind == BodyKind::Dynamic;
        let end_b = (def.b.index, body_b.centre_in_body);
        let end_a = match def.a {
            None => (WORLD, Vector::ZERO),
            Some(handle) => {
                let body = self.bodies.get(handle).ok_or_else(|| stale("body"))?;
                moves |= body.kind == BodyKind::Dynamic;
                (handle.index, body.centre_in_body)
            }
        };
        if !moves {
            return Err(WorldError::new(
                WorldErrorKind::NotAllowed,
                "a joint between two bodies that no impulse moves has nothing to do; make one of them dynamic",
            ));
        }
        let collide = def.collide;
        let def = self.meshed(def)?;
        let full = || WorldError::new(WorldErrorKind::Full, "the world has no more room for joints");
        let handle = self.joints.insert(Joint::new(def, groups, end_a, end_b)).map_err(|_| full())?;
        for slot in [end_a.0, end_b.0] {
            if let Some(body) = self.bodies.at_mut(slot) {
                let position = body.joints.partition_point(|&other| other < handle.index);
                body.joints.insert(position, handle.index);
                if body.kind == BodyKind::Dynamic {
                    self.wake_requests.push(slot);
                }
            }
        }
        if !collide {
            self.drop_pairs(|_, pair| !is_pair_of(pair.body_a, pair.body_b, end_a.0, end_b.0));
        }
        Ok(handle)
    }

    /// Unties two bodies; both wake, and may collide again.
    ///
    /// # Errors
    /// If there is no such joint.
    pub fn remove_joint(&mut self, handle: JointHandle) -> Result<(), WorldError> {
        let Some(joint) = self.joints.remove(handle) else { return Err(stale("joint")) };
        for slot in [joint.body_a, joint.body_b] {
            let Some(body) = self.bodies.at_mut(slot) else { continue };
            body.joints.retain(|&other| other != handle.index);
            for &collider in &body.colliders {
                self.motions[collider as usize].moved = true;
            }
            if body.kind == BodyKind::Dynamic {
                self.wake_requests.push(slot);
            }
        }
        Ok(())
    }

    /// A joint to read, or `None` if the handle is stale.
    #[must_use]
    pub fn joint(&self, handle: JointHandle) -> Option<JointRef<'_, N>> {
        self.joints.get(handle).map(|joint| JointRef { joint, dt: self.dt })
    }

    /// All joints in the order of their slots.
    pub fn joints(&self) -> impl Iterator<Item = (JointHandle, JointRef<'_, N>)> {
        self.joints.iter().map(|(handle, joint)| (handle, JointRef { joint, dt: self.dt }))
    }

    /// Number of joints.
    #[must_use]
    pub fn joint_count(&self) -> usize {
        self.joints.len()
    }

    /// The handles of a joint's bodies; `None` for the world.
    #[must_use]
    pub fn joint_bodies(&self, handle: JointHandle) -> Option<(Option<BodyHandle>, BodyHandle)> {
        self.joints.get(handle).map(|joint| (joint.def.a, joint.def.b))
    }

    /// Moves the first anchor of a joint, keeping the axes there: the target of a mouse joint, in the world, m; of joints
    /// between two bodies, in the frame of the first. Wakes the bodies if it changed.
    ///
    /// # Errors
    /// If there is no such joint, or the target is not finite.
    pub fn set_joint_target(&mut self, handle: JointHandle, target: impl Into<Vector<N>>) -> Result<(), WorldError> {
        let joint = self.joints.get(handle).ok_or_else(|| stale("joint"))?;
        let frame = Pose::new(joint.def.frame_a.rotation, target.into());
        self.set_joint_frame(handle, frame)
    }

    /// Moves the whole first frame of a joint: point and attitude that a [`JointDef::grip`] draws to, world from grip.
    /// Wakes the bodies if it changed.
    ///
    /// # Errors
    /// If there is no such joint, or the frame is not finite.
    pub fn set_joint_frame(&mut self, handle: JointHandle, frame: Pose<N>) -> Result<(), WorldError> {
        let base = self.joints.get(handle).ok_or_else(|| stale("joint"))?.body_a;
        let centre_a = self.bodies.at(base).map_or(Vector::ZERO, |body| body.centre_in_body);
        let joint = self.joints.get_mut(handle).ok_or_else(|| stale("joint"))?;
        check_frame("the target", &frame)?;
        if joint.def.frame_a == frame {
            return Ok(());
        }
        joint.arm_a = frame.translation - centre_a;
        joint.def.frame_a = frame;
        self.wake_ends(handle);
        Ok(())
    }

    /// Changes what a joint does, between the same bodies: motors, limits, springs, strengths. It keeps its handle. Wakes
    /// the bodies.
    ///
    /// # Errors
    /// If there is no such joint, the definition names other bodies, or a number of it is outside its range.
    pub fn set_joint(&mut self, handle: JointHandle, def: JointDef<N>) -> Result<(), WorldError> {
        let joint = self.joints.get(handle).ok_or_else(|| stale("joint"))?;
        def.validate()?;
        let groups = def.groups()?;
        if (def.a, def.b) != (joint.def.a, joint.def.b) {
            return Err(WorldError::new(
                WorldErrorKind::NotAllowed,
                "a joint keeps its bodies; remove it and add another one",
            ));
        }
        let mut def = def;
        if def.coupling != joint.def.coupling && def.phase == joint.def.phase {
            // Other teeth mesh as the wheels lie now.
            def.phase = None;
        }
        let def = self.meshed(def)?;
        let centre = |slot| self.bodies.at(slot).map_or(Vector::ZERO, |body| body.centre_in_body);
        let (a, b) = (joint.body_a, joint.body_b);
        let mut new = Joint::new(def, groups, (a, centre(a)), (b, centre(b)));
        new.go_on_from(joint);
        let collides = (joint.def.collide, new.def.collide);
        if let Some(joint) = self.joints.get_mut(handle) {
            *joint = new;
        }
        match collides {
            (true, false) => self.drop_pairs(|_, pair| !is_pair_of(pair.body_a, pair.body_b, a, b)),
            (false, true) => self.look_again(b),
            _ => {}
        }
        self.wake_ends(handle);
        Ok(())
    }

    /// The definition with what its coupling holds.
    fn meshed(&self, def: JointDef<N>) -> Result<JointDef<N>, WorldError> {
        let pose = |handle| self.bodies.get(handle).map_or(Pose::IDENTITY, Body::world_from_body);
        let (a, b) = (def.a.map_or(Pose::IDENTITY, pose), pose(def.b));
        def.meshed(&a, &b)
    }

    fn look_again(&mut self, body: u32) {
        let Some(body) = self.bodies.at(body) else { return };
        for &collider in &body.colliders {
            self.motions[collider as usize].moved = true;
        }
    }

    /// Joints of a body in quarantine bear nothing.
    pub(crate) fn let_go_of_joints(&mut self, slot: u32) {
        let joints = self.bodies.at(slot).map_or(&[][..], |body| &body.joints);
        joints.iter().for_each(|&joint| self.joints.at_mut(joint).into_iter().for_each(Joint::let_go));
    }

    fn wake_ends(&mut self, handle: JointHandle) {
        let Some(joint) = self.joints.get(handle) else { return };
        for slot in [joint.body_a, joint.body_b] {
            if self.bodies.at(slot).is_some_and(|body| body.kind == BodyKind::Dynamic) {
                self.wake_requests.push(slot);
            }
        }
    }
}

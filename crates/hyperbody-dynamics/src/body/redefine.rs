//! Changing what a body is while the world runs: its shape, its mass, its kind, anything of its definition.
//!
//! The handle stays good, and joints stay tied to the same points of the body's frame. Contacts are forgotten and found
//! anew by the next step, since nothing of them need hold for another shape; what lay on the body wakes.

use hyperbody_geometry::Shape;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Pose, Vector};

use super::{Body, BodyDef, BodyKind, BodyRef};
use crate::balls::is_ball;
use crate::vetting::in_bounds;
use crate::world::{out_of_bounds, reach, stale};
use crate::{BodyHandle, World, WorldError, WorldErrorKind};

/// Convex pieces, each with its pose in the body's frame.
pub(crate) type Pieces<const N: usize> = Vec<(Pose<N>, Piece<N>)>;

impl<const N: usize> BodyRef<'_, N> {
    /// The definition from which a body as this one is now would be made: same pose, velocities and mass. Forces and sleep are no
    /// part of it.
    #[must_use]
    pub fn def(&self) -> BodyDef<N> {
        let body = self.body;
        BodyDef {
            kind: body.kind,
            shape: body.shape.clone(),
            position: self.position(),
            rotation: body.rotation,
            velocity: body.velocity,
            angular_velocity: body.angular_velocity,
            mass: (body.kind == BodyKind::Dynamic).then_some(body.mass),
            material: body.material,
            gravity_scale: body.gravity_scale,
            linear_damping: body.linear_damping,
            angular_damping: body.angular_damping,
            can_sleep: body.can_sleep,
            surface_velocity: body.surface_velocity,
            groups: body.groups,
            sensor: body.sensor,
            one_way: body.one_way,
            contact_hook: body.contact_hook,
        }
    }
}

impl<const N: usize> World<N> {
    /// Makes a body another one, which keeps handle, joints, pairs that are switched off and, if it stays of its kind, its
    /// forces or the pose it is led to: everything else is as the definition says, pose and velocities too. Start from [`BodyRef::def`] and change what differs. It
    /// wakes with what it touched. Nothing is swept out of the way of a larger shape: what it overlaps then is pushed out
    /// softly.
    ///
    /// # Errors
    /// If the handle is stale, the definition is not valid (see [`BodyDef`]), or a joint would be left between two bodies
    /// that no impulse moves; nothing is changed then.
    pub fn set_body(&mut self, handle: BodyHandle, def: BodyDef<N>) -> Result<(), WorldError> {
        if self.bodies.get(handle).is_none() {
            return Err(stale("body"));
        }
        let (body, pieces) = prepare(def)?;
        self.replace_body(handle, body, pieces)
    }

    /// Gives a body another shape, in the same frame. A dynamic one gets the mass that its material's density gives that shape
    /// ([`World::set_body`] takes any other), and each of its points goes on as fast as it did.
    ///
    /// # Errors
    /// If the handle is stale, or a body of this kind cannot have the shape; nothing is changed then.
    ///
    /// ```
    /// use hyperbody_dynamics::{BodyDef, World, WorldDef};
    /// use hyperbody_geometry::Shape;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut world = World::<4>::new(WorldDef::default())?;
    /// let body = world.add_body(BodyDef::new(Shape::cuboid([0.5; 4])?))?;
    /// world.set_shape(body, Shape::cuboid([1.0; 4])?)?;
    /// let mass = world.body(body).ok_or("it kept its handle")?.mass();
    /// assert!((mass - 16.0).abs() < 1e-9, "twice as large in each of four directions");
    /// # Ok(())
    /// # }
    /// ```
    pub fn set_shape(&mut self, handle: BodyHandle, shape: Shape<N>) -> Result<(), WorldError> {
        let now = self.body(handle).ok_or_else(|| stale("body"))?;
        let (mut body, pieces) = prepare(BodyDef { shape, mass: None, ..now.def() })?;
        // Another centre of mass may move at another velocity.
        body.velocity = now.velocity_at(body.centre);
        self.replace_body(handle, body, pieces)
    }

    fn replace_body(&mut self, handle: BodyHandle, body: Body<N>, pieces: Pieces<N>) -> Result<(), WorldError> {
        let slot = handle.index;
        self.check_that_joints_move(slot, body.kind)?;
        self.forget_contacts_of(slot);
        let Some(place) = self.bodies.get_mut(handle) else { return Err(stale("body")) };
        let old = std::mem::replace(place, body);
        place.joints = old.joints;
        match (old.kind, place.kind) {
            (BodyKind::Dynamic, BodyKind::Dynamic) => {
                (place.force, place.torque) = (old.force, old.torque);
                (place.steady_force, place.steady_torque) = (old.steady_force, old.steady_torque);
            }
            // Or the velocity at which it was led would go on for ever.
            (BodyKind::Kinematic, BodyKind::Kinematic) => (place.led_to, place.arrived) = (old.led_to, old.arrived),
            _ => {}
        }
        let centre = place.centre_in_body;
        let joints = place.joints.clone();
        self.remove_colliders(old.colliders);
        for (body_from_collider, piece) in pieces {
            self.add_collider(slot, body_from_collider, piece);
        }
        for joint in joints {
            if let Some(joint) = self.joints.at_mut(joint) {
                joint.put_centre_of(slot, centre);
                // What held another body would throw this one.
                joint.impulses.fill([0.0; 2]);
            }
        }
        self.quarantined.retain(|&other| other != handle);
        self.wake_requests.push(slot);
        Ok(())
    }

    /// That each joint of a body still has a side that moves when the body is of another kind.
    fn check_that_joints_move(&self, slot: u32, kind: BodyKind) -> Result<(), WorldError> {
        let Some(body) = self.bodies.at(slot) else { return Ok(()) };
        if kind == BodyKind::Dynamic {
            return Ok(());
        }
        for joint in body.joints.iter().filter_map(|&joint| self.joints.at(joint)) {
            let other = if joint.body_a == slot { joint.body_b } else { joint.body_a };
            if self.bodies.at(other).is_none_or(|other| other.kind != BodyKind::Dynamic) {
                return Err(WorldError::new(
                    WorldErrorKind::NotAllowed,
                    "a joint ties the body to the world, or to a body that no impulse moves; remove the joint, or let the body stay dynamic",
                ));
            }
        }
        Ok(())
    }
}

/// A body, and the pieces of which its colliders are to be made.
pub(crate) fn prepare<const N: usize>(def: BodyDef<N>) -> Result<(Body<N>, Pieces<N>), WorldError> {
    let mut body = Body::new(def)?;
    if !in_bounds(body.centre) {
        return Err(out_of_bounds(body.centre));
    }
    let pieces = body.shape.pieces();
    body.radius = reach(&pieces, body.centre_in_body);
    body.is_ball = is_ball(&pieces, body.centre_in_body);
    Ok((body, pieces))
}

impl<const N: usize> crate::joint::Joint<N> {
    /// Keeps its anchor on a body where it is when the body's centre of mass, in its frame, becomes another one.
    fn put_centre_of(&mut self, slot: u32, centre_in_body: Vector<N>) {
        if self.body_a == slot {
            self.arm_a = self.def.frame_a.translation - centre_in_body;
        }
        if self.body_b == slot {
            self.arm_b = self.def.frame_b.translation - centre_in_body;
        }
    }
}

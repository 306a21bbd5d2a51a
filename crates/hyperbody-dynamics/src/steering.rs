//! Steering bodies beside forces and velocities: kinematic bodies that are led from pose to pose, and forces that go on.

use hyperbody_math::{Bivector, Pose, Rotation, Vector};

use crate::body::Body;
use crate::vetting::in_bounds;
use crate::world::{out_of_bounds, stale};
use crate::{BodyHandle, BodyKind, World, WorldError, WorldErrorKind};

impl<const N: usize> World<N> {
    /// Leads a kinematic body to a pose, where it will be exactly after the next step; on the way there it pushes and carries
    /// as a body of that velocity does. It rests again after that step unless it is led on.
    ///
    /// # Errors
    /// If there is no such body, it is not kinematic or in quarantine, or the pose is not finite, out of bounds, or farther away than
    /// [`Tuning::max_speed`](crate::Tuning::max_speed) reaches in a step: [`BodyMut::set_pose`](crate::BodyMut::set_pose)
    /// puts bodies elsewhere without a way.
    pub fn move_kinematic(&mut self, handle: BodyHandle, world_from_body: Pose<N>) -> Result<(), WorldError> {
        let (dt, fastest) = (self.dt, self.tuning.max_speed);
        let body = self.bodies.get_mut(handle).ok_or_else(|| stale("body"))?;
        if body.kind != BodyKind::Kinematic {
            return Err(WorldError::new(
                WorldErrorKind::NotAllowed,
                format!("only kinematic bodies are led to a pose; this one is {:?}", body.kind),
            ));
        }
        if body.quarantined {
            let message = "the body is in quarantine; set_pose brings it back".to_owned();
            return Err(WorldError::new(WorldErrorKind::NotAllowed, message));
        }
        let centre = world_from_body.transform_point(body.centre_in_body);
        if !(centre.is_finite() && world_from_body.rotation.matrix().is_finite()) {
            return Err(WorldError::bad_number(format!("the pose is at {:?}; it must be finite", centre.0)));
        }
        if !in_bounds(centre) {
            return Err(out_of_bounds(centre));
        }
        let velocity = (centre - body.centre) * (1.0 / dt);
        if velocity.norm() > fastest {
            return Err(WorldError::bad_number(format!(
                "the pose is {} m away; in a step of {dt} s a body moves at most {} m: use set_pose to put it there",
                velocity.norm() * dt,
                fastest * dt
            )));
        }
        body.velocity = velocity;
        body.angular_velocity = (world_from_body.rotation * body.rotation.inverse()).log() * (1.0 / dt);
        body.led_to = Some((centre, world_from_body.rotation));
        Ok(())
    }

    /// Stops kinematic bodies that were led to a pose and are not led on.
    pub(crate) fn stop_arrived(&mut self) {
        let arrived = |body: &&mut Body<N>| body.kind == BodyKind::Kinematic && body.arrived;
        for body in self.bodies.values_mut().filter(arrived) {
            body.arrived = false;
            if body.led_to.is_none() {
                body.velocity = Vector::ZERO;
                body.angular_velocity = Bivector::ZERO;
            }
        }
    }
}

/// Where a kinematic body was to be led.
pub(crate) type Target<const N: usize> = Option<(Vector<N>, Rotation<N>)>;

//! Reading a body and pushing it.

use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

use super::{Body, BodyKind, def::check_side};
use crate::vetting::in_bounds;
use crate::world::out_of_bounds;
use crate::{BodyHandle, Groups, Material, WorldError, error::WorldErrorKind};

/// A body as it is between two steps.
#[derive(Clone, Copy, Debug)]
pub struct BodyRef<'a, const N: usize> {
    pub(crate) body: &'a Body<N>,
}

impl<'a, const N: usize> BodyRef<'a, N> {
    /// How it takes part.
    #[must_use]
    pub fn kind(&self) -> BodyKind {
        self.body.kind
    }

    /// Its solid, in its own frame.
    #[must_use]
    pub fn shape(&self) -> &'a Shape<N> {
        &self.body.shape
    }

    /// Its material.
    #[must_use]
    pub fn material(&self) -> &'a Material {
        &self.body.material
    }

    /// Origin of its frame in the world, m.
    #[must_use]
    pub fn position(&self) -> Vector<N> {
        self.pose().translation
    }

    /// Attitude.
    #[must_use]
    pub fn rotation(&self) -> Rotation<N> {
        self.body.rotation
    }

    /// World from body.
    #[must_use]
    pub fn pose(&self) -> Pose<N> {
        self.body.world_from_body()
    }

    /// Centre of mass in the world, m. Of static and kinematic bodies: the origin of their frame.
    #[must_use]
    pub fn centre_of_mass(&self) -> Vector<N> {
        self.body.centre
    }

    /// Velocity of the centre of mass, m/s.
    #[must_use]
    pub fn velocity(&self) -> Vector<N> {
        self.body.velocity
    }

    /// Velocity of the point of the body that is at `point` in the world, m/s.
    #[must_use]
    pub fn velocity_at(&self, point: Vector<N>) -> Vector<N> {
        self.body.velocity + self.body.angular_velocity.act_on(point - self.body.centre)
    }

    /// By world planes, rad/s.
    #[must_use]
    pub fn angular_velocity(&self) -> Bivector<N> {
        self.body.angular_velocity
    }

    /// About the centre of mass, by world planes, kg·m²/s. Zero unless dynamic.
    #[must_use]
    pub fn angular_momentum(&self) -> Bivector<N> {
        self.body.angular_momentum
    }

    /// kg; zero unless dynamic.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.body.mass
    }

    /// Principal second moments J_i in kg·m²; plane (i, j) of the principal frame has the moment J_i + J_j. Zero unless
    /// dynamic.
    #[must_use]
    pub fn principal_moments(&self) -> Vector<N> {
        self.body.inertia.moments
    }

    /// How its surface runs along it, body frame, m/s.
    #[must_use]
    pub fn surface_velocity(&self) -> Vector<N> {
        self.body.surface_velocity
    }

    /// Force and torque that go on from step to step, N and N·m.
    #[must_use]
    pub fn steady_force(&self) -> (Vector<N>, Bivector<N>) {
        (self.body.steady_force, self.body.steady_torque)
    }

    /// Which groups it is in and which it meets.
    #[must_use]
    pub fn groups(&self) -> Groups {
        self.body.groups
    }

    /// Whether it only notices what overlaps it.
    #[must_use]
    pub fn is_sensor(&self) -> bool {
        self.body.sensor
    }

    /// Unit, body frame: the side that holds, of one-way bodies.
    #[must_use]
    pub fn one_way(&self) -> Option<Vector<N>> {
        self.body.one_way
    }

    /// J. Zero unless dynamic.
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        self.body.kinetic_energy()
    }

    /// Whether it sleeps: it is at rest, costs nothing, and wakes when touched.
    #[must_use]
    pub fn is_sleeping(&self) -> bool {
        self.body.asleep_in.is_some()
    }

    /// Whether its state turned non-finite and it was taken out of the simulation.
    #[must_use]
    pub fn is_quarantined(&self) -> bool {
        self.body.quarantined
    }
}

/// A body that may be changed between two steps. Every change wakes it.
#[derive(Debug)]
pub struct BodyMut<'a, const N: usize> {
    pub(crate) body: &'a mut Body<N>,
    /// Set when the body must be woken with its island, which the borrow of one body can't reach.
    pub(crate) wake: &'a mut Vec<u32>,
    /// Those in quarantine, from which it is struck when it comes back.
    pub(crate) quarantined: &'a mut Vec<BodyHandle>,
    pub(crate) slot: u32,
}

impl<const N: usize> BodyMut<'_, N> {
    /// The same body for reading.
    #[must_use]
    pub fn as_ref(&self) -> BodyRef<'_, N> {
        BodyRef { body: self.body }
    }

    /// Wakes the body and all that rests with it, at the start of the next step.
    pub fn wake(&mut self) {
        if self.body.kind == BodyKind::Dynamic {
            self.request();
        }
    }

    fn request(&mut self) {
        if self.wake.last() != Some(&self.slot) {
            self.wake.push(self.slot);
        }
    }

    /// Puts the body's frame at `world_from_body`, without sweeping what lies between. Also ends a quarantine, with
    /// velocities set to zero.
    ///
    /// # Errors
    /// If the position is not finite, or farther out than [`crate::POSITION_LIMIT`].
    pub fn set_pose(&mut self, world_from_body: Pose<N>) -> Result<(), WorldError> {
        finite(world_from_body.translation, "position")?;
        let centre = world_from_body.transform_point(self.body.centre_in_body);
        if !in_bounds(centre) {
            return Err(out_of_bounds(centre));
        }
        if self.body.quarantined {
            self.body.quarantined = false;
            let slot = self.slot;
            self.quarantined.retain(|handle| handle.index != slot);
            self.body.force = Vector::ZERO;
            self.body.torque = Bivector::ZERO;
            self.body.velocity = Vector::ZERO;
            self.body.angular_velocity = Bivector::ZERO;
            self.body.angular_momentum = Bivector::ZERO;
        }
        if self.body.stop_leading() {
            self.body.velocity = Vector::ZERO;
            self.body.angular_velocity = Bivector::ZERO;
        }
        let angular_velocity = self.body.angular_velocity;
        self.body.rotation = world_from_body.rotation;
        self.body.centre = centre;
        self.store_angular_velocity(angular_velocity);
        // What it supported or is put beside has to look again, also where it is static.
        self.request();
        Ok(())
    }

    /// Sets the velocity of the centre of mass, m/s.
    ///
    /// # Errors
    /// If it is not finite, or the body is static.
    pub fn set_velocity(&mut self, velocity: impl Into<Vector<N>>) -> Result<(), WorldError> {
        let velocity = velocity.into();
        finite(velocity, "velocity")?;
        self.refuse_static("a velocity")?;
        if self.body.stop_leading() {
            self.body.angular_velocity = Bivector::ZERO;
        }
        self.body.velocity = velocity;
        self.wake();
        Ok(())
    }

    /// Sets the angular velocity by world planes, rad/s.
    ///
    /// # Errors
    /// If it is not finite, or the body is static.
    pub fn set_angular_velocity(&mut self, angular_velocity: Bivector<N>) -> Result<(), WorldError> {
        finite_bivector(&angular_velocity, "angular velocity")?;
        self.refuse_static("an angular velocity")?;
        if self.body.stop_leading() {
            self.body.velocity = Vector::ZERO;
        }
        self.store_angular_velocity(angular_velocity);
        self.wake();
        Ok(())
    }

    /// Adds a force in N through the centre of mass, during the next step.
    ///
    /// # Errors
    /// If it is not finite, or the body is not dynamic.
    pub fn apply_force(&mut self, force: impl Into<Vector<N>>) -> Result<(), WorldError> {
        let force = force.into();
        finite(force, "force")?;
        self.require_dynamic("a force")?;
        self.body.force += force;
        self.wake();
        Ok(())
    }

    /// Adds a force in N at a point of the world, during the next step: a force through the centre of mass and the
    /// torque r ∧ force.
    ///
    /// # Errors
    /// If force or point is not finite, or the body is not dynamic.
    pub fn apply_force_at(
        &mut self,
        force: impl Into<Vector<N>>,
        point: impl Into<Vector<N>>,
    ) -> Result<(), WorldError> {
        let (force, point) = (force.into(), point.into());
        finite(point, "point")?;
        self.apply_force(force)?;
        self.body.torque += Bivector::wedge(point - self.body.centre, force);
        Ok(())
    }

    /// Adds a torque by world planes, N·m, during the next step.
    ///
    /// # Errors
    /// If it is not finite, or the body is not dynamic.
    pub fn apply_torque(&mut self, torque: Bivector<N>) -> Result<(), WorldError> {
        finite_bivector(&torque, "torque")?;
        self.require_dynamic("a torque")?;
        self.body.torque += torque;
        self.wake();
        Ok(())
    }

    /// Takes back the forces and torques that were applied for the next step, and ends the steady ones.
    pub fn clear_forces(&mut self) {
        (self.body.force, self.body.torque) = (Vector::ZERO, Bivector::ZERO);
        if (self.body.steady_force, self.body.steady_torque) != (Vector::ZERO, Bivector::ZERO) {
            (self.body.steady_force, self.body.steady_torque) = (Vector::ZERO, Bivector::ZERO);
            // They may have held the body up.
            self.wake();
        }
    }

    /// Changes the momentum at once, N·s: v' = v + j/m.
    ///
    /// # Errors
    /// If it is not finite, or the body is not dynamic.
    pub fn apply_impulse(&mut self, impulse: impl Into<Vector<N>>) -> Result<(), WorldError> {
        let impulse = impulse.into();
        finite(impulse, "impulse")?;
        self.require_dynamic("an impulse")?;
        self.body.velocity += impulse * self.body.inverse_mass;
        self.wake();
        Ok(())
    }

    /// Strikes the body at a point of the world, N·s: v' = v + j/m, L' = L + r ∧ j.
    ///
    /// # Errors
    /// If impulse or point is not finite, or the body is not dynamic.
    pub fn apply_impulse_at(
        &mut self,
        impulse: impl Into<Vector<N>>,
        point: impl Into<Vector<N>>,
    ) -> Result<(), WorldError> {
        let (impulse, point) = (impulse.into(), point.into());
        finite(point, "point")?;
        self.apply_impulse(impulse)?;
        self.body.angular_momentum += Bivector::wedge(point - self.body.centre, impulse);
        self.body.refresh_angular_velocity();
        Ok(())
    }

    /// Changes the angular momentum at once, by world planes, kg·m²/s.
    ///
    /// # Errors
    /// If it is not finite, or the body is not dynamic.
    pub fn apply_angular_impulse(&mut self, impulse: Bivector<N>) -> Result<(), WorldError> {
        finite_bivector(&impulse, "angular impulse")?;
        self.require_dynamic("an angular impulse")?;
        self.body.angular_momentum += impulse;
        self.body.refresh_angular_velocity();
        self.wake();
        Ok(())
    }

    /// Sets the factor on gravity.
    ///
    /// # Errors
    /// If it is not finite.
    pub fn set_gravity_scale(&mut self, factor: f64) -> Result<(), WorldError> {
        if !factor.is_finite() {
            return Err(WorldError::bad_number(format!("gravity scale is {factor}; it must be finite")));
        }
        self.body.gravity_scale = factor;
        self.wake();
        Ok(())
    }

    /// Sets how the surface runs along the body, body frame, m/s, and wakes what lies on it.
    ///
    /// # Errors
    /// If it is not finite.
    pub fn set_surface_velocity(&mut self, surface_velocity: impl Into<Vector<N>>) -> Result<(), WorldError> {
        let surface_velocity = surface_velocity.into();
        finite(surface_velocity, "surface velocity")?;
        self.body.surface_velocity = surface_velocity;
        self.request();
        Ok(())
    }

    /// Sets a force through the centre of mass, N, and a torque by world planes, N·m, that go on from step to step until they
    /// are set anew. They come on top of those applied for one step.
    ///
    /// # Errors
    /// If one is not finite, or the body is not dynamic.
    pub fn set_steady_force(&mut self, force: impl Into<Vector<N>>, torque: Bivector<N>) -> Result<(), WorldError> {
        let force = force.into();
        finite(force, "force")?;
        finite_bivector(&torque, "torque")?;
        self.require_dynamic("a force")?;
        self.body.steady_force = force;
        self.body.steady_torque = torque;
        self.wake();
        Ok(())
    }

    /// Sets which groups it is in and which it meets. It wakes with what it touched.
    pub fn set_groups(&mut self, groups: Groups) {
        self.body.groups = groups;
        self.refilter();
    }

    /// Makes it a sensor, or solid again. It wakes with what it touched.
    pub fn set_sensor(&mut self, sensor: bool) {
        self.body.sensor = sensor;
        self.refilter();
    }

    /// Sets the side, body frame, on which it holds what comes from there, or `None` for all sides. It wakes with what it
    /// touched.
    ///
    /// # Errors
    /// If the side is zero or not finite.
    pub fn set_one_way(&mut self, side: Option<Vector<N>>) -> Result<(), WorldError> {
        side.map_or(Ok(()), check_side)?;
        self.body.one_way = side.and_then(Vector::try_normalize);
        self.refilter();
        Ok(())
    }

    fn refilter(&mut self) {
        self.body.refilter = true;
        self.request();
    }

    fn store_angular_velocity(&mut self, angular_velocity: Bivector<N>) {
        self.body.angular_velocity = angular_velocity;
        if self.body.kind == BodyKind::Dynamic {
            self.body.angular_momentum = self.body.inertia.momentum(&self.body.rotation, &angular_velocity);
        }
    }

    fn refuse_static(&self, what: &str) -> Result<(), WorldError> {
        if self.body.kind == BodyKind::Static {
            return Err(WorldError::new(
                WorldErrorKind::NotAllowed,
                format!("a static body cannot have {what}; make it kinematic or dynamic"),
            ));
        }
        Ok(())
    }

    fn require_dynamic(&self, what: &str) -> Result<(), WorldError> {
        if self.body.kind != BodyKind::Dynamic {
            return Err(WorldError::new(
                WorldErrorKind::NotAllowed,
                format!("only dynamic bodies feel {what}; this one is {:?}", self.body.kind),
            ));
        }
        Ok(())
    }
}

fn finite<const N: usize>(value: Vector<N>, what: &str) -> Result<(), WorldError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(WorldError::bad_number(format!("{what} is {:?}; every component must be finite", value.0)))
}

fn finite_bivector<const N: usize>(value: &Bivector<N>, what: &str) -> Result<(), WorldError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(WorldError::bad_number(format!("{what} is not finite; every plane must be")))
}

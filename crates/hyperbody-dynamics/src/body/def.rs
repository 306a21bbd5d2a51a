//! The definition from which a body is made.

use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Rotation, Vector};

use crate::{Groups, Material, WorldError};

/// How a body takes part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum BodyKind {
    /// Moved by forces and contacts.
    #[default]
    Dynamic,
    /// Never moves.
    Static,
    /// Moves at the velocity it is given, whatever it meets.
    Kinematic,
}

/// Everything needed to make a body. Start from [`BodyDef::new`], which fills in defaults, and chain what differs.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct BodyDef<const N: usize> {
    /// Default: dynamic.
    pub kind: BodyKind,
    /// The solid, in the frame of the body.
    pub shape: Shape<N>,
    /// Where the origin of the body's frame starts, m. Default: the origin.
    pub position: Vector<N>,
    /// How the body's frame is turned at the start. Default: not at all.
    pub rotation: Rotation<N>,
    /// Velocity of the centre of mass, m/s. Default: zero.
    pub velocity: Vector<N>,
    /// Angular velocity by world planes, rad/s. Default: zero.
    pub angular_velocity: Bivector<N>,
    /// Mass in kg, > 0; wins over the material's density. Default: density × volume.
    pub mass: Option<f64>,
    /// Friction, restitution, density.
    pub material: Material,
    /// Factor on the world's gravity for this body. Default 1.
    pub gravity_scale: f64,
    /// Rate at which the velocity dies away, 1/s, ≥ 0. Default 0.
    pub linear_damping: f64,
    /// Rate at which the angular momentum dies away, 1/s, ≥ 0. Default 0.
    pub angular_damping: f64,
    /// Whether the body may fall asleep. Default true.
    pub can_sleep: bool,
    /// How its surface runs along it, in its own frame, m/s: what rests on it is carried along, as on a conveyor. Default:
    /// zero.
    pub surface_velocity: Vector<N>,
    /// Which groups it is in and which it meets. Default: all.
    pub groups: Groups,
    /// Whether it only notices what overlaps it ([`Events::sensors`](crate::Events::sensors)), and neither pushes nor is
    /// pushed. Two sensors notice each other. Default false.
    pub sensor: bool,
    /// The side, in its own frame, on which it holds what comes from there; the rest passes through, as through a platform
    /// that one jumps onto from below. Any length but zero. Default: none, it holds on all sides.
    pub one_way: Option<Vector<N>>,
    /// Whether the world's [contact hook](crate::ContactHook) is asked about its contacts. Default false.
    pub contact_hook: bool,
}

impl<const N: usize> BodyDef<N> {
    /// A dynamic body of this shape at rest at the origin.
    #[must_use]
    pub fn new(shape: Shape<N>) -> Self {
        Self {
            kind: BodyKind::Dynamic,
            shape,
            position: Vector::ZERO,
            rotation: Rotation::IDENTITY,
            velocity: Vector::ZERO,
            angular_velocity: Bivector::ZERO,
            mass: None,
            material: Material::default(),
            gravity_scale: 1.0,
            linear_damping: 0.0,
            angular_damping: 0.0,
            can_sleep: true,
            surface_velocity: Vector::ZERO,
            groups: Groups::ALL,
            sensor: false,
            one_way: None,
            contact_hook: false,
        }
    }

    /// A static body of this shape at the origin.
    #[must_use]
    pub fn fixed(shape: Shape<N>) -> Self {
        Self::new(shape).kind(BodyKind::Static)
    }

    /// Sets [`BodyDef::shape`].
    #[must_use]
    pub fn shape(mut self, shape: Shape<N>) -> Self {
        self.shape = shape;
        self
    }

    /// Sets [`BodyDef::kind`].
    #[must_use]
    pub fn kind(mut self, kind: BodyKind) -> Self {
        self.kind = kind;
        self
    }

    /// Sets [`BodyDef::position`].
    #[must_use]
    pub fn position(mut self, position: impl Into<Vector<N>>) -> Self {
        self.position = position.into();
        self
    }

    /// Sets [`BodyDef::rotation`].
    #[must_use]
    pub fn rotation(mut self, rotation: Rotation<N>) -> Self {
        self.rotation = rotation;
        self
    }

    /// Sets [`BodyDef::velocity`].
    #[must_use]
    pub fn velocity(mut self, velocity: impl Into<Vector<N>>) -> Self {
        self.velocity = velocity.into();
        self
    }

    /// Sets [`BodyDef::angular_velocity`].
    #[must_use]
    pub fn angular_velocity(mut self, angular_velocity: Bivector<N>) -> Self {
        self.angular_velocity = angular_velocity;
        self
    }

    /// Sets [`BodyDef::mass`].
    #[must_use]
    pub fn mass(mut self, mass: f64) -> Self {
        self.mass = Some(mass);
        self
    }

    /// Sets [`BodyDef::material`].
    #[must_use]
    pub fn material(mut self, material: Material) -> Self {
        self.material = material;
        self
    }

    /// Sets [`BodyDef::gravity_scale`].
    #[must_use]
    pub fn gravity_scale(mut self, gravity_scale: f64) -> Self {
        self.gravity_scale = gravity_scale;
        self
    }

    /// Sets [`BodyDef::linear_damping`].
    #[must_use]
    pub fn linear_damping(mut self, linear_damping: f64) -> Self {
        self.linear_damping = linear_damping;
        self
    }

    /// Sets [`BodyDef::angular_damping`].
    #[must_use]
    pub fn angular_damping(mut self, angular_damping: f64) -> Self {
        self.angular_damping = angular_damping;
        self
    }

    /// Sets [`BodyDef::can_sleep`].
    #[must_use]
    pub fn can_sleep(mut self, can_sleep: bool) -> Self {
        self.can_sleep = can_sleep;
        self
    }

    /// Sets [`BodyDef::surface_velocity`].
    #[must_use]
    pub fn surface_velocity(mut self, surface_velocity: impl Into<Vector<N>>) -> Self {
        self.surface_velocity = surface_velocity.into();
        self
    }

    /// Sets [`BodyDef::groups`].
    #[must_use]
    pub fn groups(mut self, groups: Groups) -> Self {
        self.groups = groups;
        self
    }

    /// Sets [`BodyDef::sensor`].
    #[must_use]
    pub fn sensor(mut self, sensor: bool) -> Self {
        self.sensor = sensor;
        self
    }

    /// Sets [`BodyDef::one_way`].
    #[must_use]
    pub fn one_way(mut self, side: impl Into<Vector<N>>) -> Self {
        self.one_way = Some(side.into());
        self
    }

    /// Sets [`BodyDef::contact_hook`].
    #[must_use]
    pub fn contact_hook(mut self, contact_hook: bool) -> Self {
        self.contact_hook = contact_hook;
        self
    }

    pub(crate) fn validate(&self) -> Result<(), WorldError> {
        self.material.validate()?;
        let vectors =
            [("position", self.position), ("velocity", self.velocity), ("surface_velocity", self.surface_velocity)];
        for (name, vector) in vectors {
            if !vector.is_finite() {
                return Err(WorldError::bad_number(format!(
                    "{name} is {:?}; every component must be finite",
                    vector.0
                )));
            }
        }
        if let Some(side) = self.one_way {
            check_side(side)?;
        }
        if !self.angular_velocity.is_finite() {
            return Err(WorldError::bad_number("angular_velocity is not finite; every plane must be"));
        }
        if let Some(mass) = self.mass
            && !(mass > 0.0 && mass.is_finite())
        {
            return Err(WorldError::bad_number(format!(
                "mass is {mass} kg; it must be finite and positive (a body that never moves is static)"
            )));
        }
        if !self.gravity_scale.is_finite() {
            return Err(WorldError::bad_number(format!("gravity_scale is {}; it must be finite", self.gravity_scale)));
        }
        for (name, value) in [("linear_damping", self.linear_damping), ("angular_damping", self.angular_damping)] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(WorldError::bad_number(format!("{name} is {value} 1/s; it must be finite, 0 or more")));
            }
        }
        Ok(())
    }
}

/// Whether a vector names a side of a one-way body.
pub(crate) fn check_side<const N: usize>(side: Vector<N>) -> Result<(), WorldError> {
    if side.is_finite() && side.try_normalize().is_some() {
        return Ok(());
    }
    let message = format!("one_way is {:?}; it must be finite and not zero, and point to the side that holds", side.0);
    Err(WorldError::bad_number(message))
}

//! Bodies of a scene.

pub use hyperbody::prelude::BodyKind;

use super::{RotationSpec, ShapeSpec};

/// A body of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its name, different from every other; `None` stands for "body N".
    pub name: Option<String>,
    /// Whether forces move it (dynamic), nothing (static), or its velocity alone (kinematic).
    pub kind: BodyKind,
    /// What it is made of.
    pub shape: ShapeSpec,
    /// Where the origin of its shape lies, m. Empty: at the origin.
    pub position: Vec<f64>,
    /// How it is turned.
    pub rotation: RotationSpec,
    /// Velocity of the centre of mass, m/s. Empty: at rest.
    pub velocity: Vec<f64>,
    /// Angular velocity by plane names, rad/s; planes that are not named have zero.
    pub angular_velocity: Vec<(String, f64)>,
    /// In kilograms; `None`: density times volume.
    pub mass: Option<f64>,
    /// In kg/mⁿ, in place of the density of its material.
    pub density: Option<f64>,
    /// Name of its material; `None`: "default".
    pub material: Option<String>,
    /// What gravity is multiplied by for this body.
    pub gravity_scale: f64,
    /// Rate at which the velocity dies out, 1/s.
    pub linear_damping: f64,
    /// Rate at which the angular velocity dies out, 1/s.
    pub angular_damping: f64,
    /// Whether it may fall asleep.
    pub can_sleep: bool,
    /// How its surface runs along it, in its own frame, m/s: a conveyor. Empty: not at all.
    pub surface_velocity: Vec<f64>,
    /// The groups that it is in, of 0 to 31; `None`: all.
    pub groups: Option<Vec<u32>>,
    /// The groups that it meets; `None`: all.
    pub meets: Option<Vec<u32>>,
    /// Whether it only notices what overlaps it.
    pub sensor: bool,
    /// The side, in its own frame, on which it holds what comes from there. Empty: all sides.
    pub one_way: Vec<f64>,
    /// Colour in pictures as red, green, blue in 0..=1; `None`: chosen by the picture.
    pub colour: Option<[f64; 3]>,
}

impl Body {
    /// A dynamic body of the given shape at rest at the origin.
    #[must_use]
    pub fn new(shape: ShapeSpec) -> Self {
        Self {
            name: None,
            kind: BodyKind::Dynamic,
            shape,
            position: Vec::new(),
            rotation: RotationSpec::default(),
            velocity: Vec::new(),
            angular_velocity: Vec::new(),
            mass: None,
            density: None,
            material: None,
            gravity_scale: 1.0,
            linear_damping: 0.0,
            angular_damping: 0.0,
            can_sleep: true,
            surface_velocity: Vec::new(),
            groups: None,
            meets: None,
            sensor: false,
            one_way: Vec::new(),
            colour: None,
        }
    }

    /// With a name.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// Immovable.
    #[must_use]
    pub fn fixed(mut self) -> Self {
        self.kind = BodyKind::Static;
        self
    }

    /// At a position.
    #[must_use]
    pub fn at(mut self, position: impl Into<Vec<f64>>) -> Self {
        self.position = position.into();
        self
    }

    /// Turned by an angle in degrees in a plane, after the turns that it has.
    #[must_use]
    pub fn turned(mut self, plane: &str, angle_deg: f64) -> Self {
        self.rotation.push(plane, angle_deg);
        self
    }

    /// With a velocity, m/s.
    #[must_use]
    pub fn moving(mut self, velocity: impl Into<Vec<f64>>) -> Self {
        self.velocity = velocity.into();
        self
    }

    /// Spinning in a plane, rad/s.
    #[must_use]
    pub fn spinning(mut self, plane: &str, rate: f64) -> Self {
        self.angular_velocity.push((plane.to_owned(), rate));
        self
    }

    /// Of a mass in kilograms.
    #[must_use]
    pub fn weighing(mut self, mass: f64) -> Self {
        self.mass = Some(mass);
        self
    }

    /// Of a named material.
    #[must_use]
    pub fn made_of(mut self, material: impl Into<String>) -> Self {
        self.material = Some(material.into());
        self
    }

    /// In a colour: red, green, blue in 0..=1.
    #[must_use]
    pub fn coloured(mut self, colour: [f64; 3]) -> Self {
        self.colour = Some(colour);
        self
    }
}

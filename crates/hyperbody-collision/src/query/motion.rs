//! How a shape moves in a cast: evenly along a line, and evenly turning about a point of its own.

use hyperbody_math::{Bivector, Pose, Rotation, Vector};

use super::in_range;

/// A motion at constant velocity and constant angular velocity.
///
/// The point `centre` of the shape goes along a straight line; the shape turns about it. In more than three dimensions
/// one constant angular velocity may turn several planes at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<const N: usize> {
    /// `world_from_shape` at time 0.
    pub start: Pose<N>,
    /// Of the centre, m/s in the world.
    pub velocity: Vector<N>,
    /// rad/s in the world.
    pub angular_velocity: Bivector<N>,
    /// The point about which the shape turns, in its own frame. The origin unless set.
    pub centre: Vector<N>,
}

impl<const N: usize> Motion<N> {
    /// Standing still.
    #[must_use]
    pub fn still(start: Pose<N>) -> Self {
        Self::linear(start, Vector::ZERO)
    }

    /// A translation without turning, m/s.
    #[must_use]
    pub fn linear(start: Pose<N>, velocity: impl Into<Vector<N>>) -> Self {
        Self { start, velocity: velocity.into(), angular_velocity: Bivector::ZERO, centre: Vector::ZERO }
    }

    /// The same, turning at an angular velocity in rad/s about the point `centre` of the shape.
    #[must_use]
    pub fn turning(mut self, angular_velocity: Bivector<N>, centre: impl Into<Vector<N>>) -> Self {
        (self.angular_velocity, self.centre) = (angular_velocity, centre.into());
        self
    }

    /// The motion that leads from one pose to another in one unit of time, turning the shortest way about the origin of
    /// the shape.
    #[must_use]
    pub fn between(from: Pose<N>, to: &Pose<N>) -> Self {
        let turn = (to.rotation * from.rotation.inverse()).log();
        Self::linear(from, to.translation - from.translation).turning(turn, Vector::ZERO)
    }

    /// `world_from_shape` at a time in seconds.
    #[must_use]
    pub fn at(&self, time: f64) -> Pose<N> {
        if self.angular_velocity == Bivector::ZERO {
            return Pose::new(self.start.rotation, self.start.translation + self.velocity * time);
        }
        let rotation = Rotation::exp(&(self.angular_velocity * time)) * self.start.rotation;
        let centre = self.start.transform_point(self.centre) + self.velocity * time;
        Pose::new(rotation, centre - rotation.rotate(self.centre))
    }

    /// Whether all numbers are finite, and the start is not beyond [`FARTHEST`](crate::limits::FARTHEST). Casts of any
    /// other motion hit nothing.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        in_range(&self.start)
            && self.velocity.is_finite()
            && self.angular_velocity.is_finite()
            && self.centre.is_finite()
    }

    /// The same motion of a part placed in the shape by `shape_from_part`.
    #[must_use]
    pub fn of_part(&self, shape_from_part: &Pose<N>) -> Self {
        Self {
            start: self.start * *shape_from_part,
            centre: shape_from_part.inverse_transform_point(self.centre),
            ..*self
        }
    }
}

//! Where a body is and how it is turned.

use std::ops::Mul;

use crate::{Rotation, Vector};

/// A rotation followed by a translation. Named by what it maps: `world_from_body`.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Pose<const N: usize> {
    /// Applied first.
    pub rotation: Rotation<N>,
    /// Applied second; the image of the origin, in metres.
    pub translation: Vector<N>,
}

impl<const N: usize> Pose<N> {
    /// Leaves every point where it is.
    pub const IDENTITY: Self = Self { rotation: Rotation::IDENTITY, translation: Vector::ZERO };

    /// The pose with the given parts.
    #[must_use]
    pub const fn new(rotation: Rotation<N>, translation: Vector<N>) -> Self {
        Self { rotation, translation }
    }

    /// A translation without rotation.
    #[must_use]
    pub const fn from_translation(translation: Vector<N>) -> Self {
        Self { rotation: Rotation::IDENTITY, translation }
    }

    /// The image of a point.
    #[inline]
    #[must_use]
    pub fn transform_point(&self, point: Vector<N>) -> Vector<N> {
        self.rotation.rotate(point) + self.translation
    }

    /// The point whose image is `point`.
    #[inline]
    #[must_use]
    pub fn inverse_transform_point(&self, point: Vector<N>) -> Vector<N> {
        self.rotation.inverse_rotate(point - self.translation)
    }

    /// The inverse map.
    #[inline]
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        Self { rotation, translation: -rotation.rotate(self.translation) }
    }

    /// `self⁻¹ · other`: `world_from_a.relative(&world_from_b)` is `a_from_b`.
    #[inline]
    #[must_use]
    pub fn relative(&self, other: &Self) -> Self {
        Self {
            rotation: self.rotation.inverse() * other.rotation,
            translation: self.inverse_transform_point(other.translation),
        }
    }
}

impl<const N: usize> Mul for Pose<N> {
    type Output = Self;
    /// `other` first, then `self`.
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self {
            rotation: self.rotation * other.rotation,
            translation: self.rotation.rotate(other.translation) + self.translation,
        }
    }
}

//! The three-dimensional slice of a world that a picture shows.

use hyperbody::math::{Pose, Rotation, Vector};

/// The slice: a point of the world and an orthonormal frame, whose first three directions are seen and whose others are
/// hidden. A picture shows what of the world has hidden coordinates zero. In two dimensions there are two directions, and
/// the picture is flat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slice<const N: usize> {
    world_from_slice: Pose<N>,
}

impl<const N: usize> Slice<N> {
    /// How many directions are seen.
    pub const SEEN: usize = if N < 3 { N } else { 3 };

    /// The slice through the origin along the first three axes.
    #[must_use]
    pub const fn natural() -> Self {
        Self { world_from_slice: Pose::IDENTITY }
    }

    /// The slice with a frame of its own: slice coordinates to world coordinates.
    #[must_use]
    pub const fn new(world_from_slice: Pose<N>) -> Self {
        Self { world_from_slice }
    }

    /// The slice moved by `offset`, in world coordinates, m.
    #[must_use]
    pub fn moved(mut self, offset: Vector<N>) -> Self {
        self.world_from_slice.translation += offset;
        self
    }

    /// The slice turned about its own point: its direction i towards its direction j. A turn of a seen against a hidden
    /// direction shows another section.
    ///
    /// # Panics
    /// If i = j or a direction is not below `N`.
    #[must_use]
    pub fn turned(mut self, i: usize, j: usize, angle_rad: f64) -> Self {
        self.world_from_slice.rotation = self.world_from_slice.rotation * Rotation::in_plane(i, j, angle_rad);
        self
    }

    /// Slice coordinates to world coordinates.
    #[must_use]
    pub fn pose(&self) -> &Pose<N> {
        &self.world_from_slice
    }

    /// Slice coordinates of a point of the world; from the third on they are hidden.
    #[must_use]
    pub fn coordinates(&self, point: Vector<N>) -> Vector<N> {
        self.world_from_slice.inverse_transform_point(point)
    }

    /// The first three slice coordinates, as far as there are so many.
    #[must_use]
    pub fn seen(coordinates: Vector<N>) -> Vector<3> {
        Vector::from_fn(|i| if i < N { coordinates[i] } else { 0.0 })
    }

    /// The point of the world at three slice coordinates, hidden ones being zero.
    #[must_use]
    pub fn point(&self, seen: Vector<3>) -> Vector<N> {
        self.world_from_slice.transform_point(Vector::from_fn(|i| if i < 3 { seen[i] } else { 0.0 }))
    }
}

impl<const N: usize> Default for Slice<N> {
    fn default() -> Self {
        Self::natural()
    }
}

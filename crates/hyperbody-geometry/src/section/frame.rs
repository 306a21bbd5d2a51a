//! The hyperplane of a slice, with coordinates on it.

use hyperbody_math::{Matrix, Pose, Rotation, Vector};

use crate::error::GeometryErrorKind::BadNumber;
use crate::tolerances::MAX_LENGTH;
use crate::{GeometryError, Result};

/// A hyperplane of `N`-dimensional space with an orthonormal frame: slice coordinates are those along the first `N − 1`
/// axes of a pose, and its last axis is the normal. Moving or turning the pose moves and turns the slice, and its
/// coordinates go along without a jump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliceFrame<const N: usize> {
    space_from_slice: Pose<N>,
}

impl<const N: usize> SliceFrame<N> {
    /// The slice spanned by the first `N − 1` axes of a pose, through its translation.
    #[must_use]
    pub const fn new(space_from_slice: Pose<N>) -> Self {
        Self { space_from_slice }
    }

    /// The hyperplane of all points p with normal·p = offset; the normal may have any length, by which both sides are
    /// divided. Its axes are those of space after the shortest turn that takes the last axis to the normal: for the
    /// normal w in 4D the slice has the axes x, y, z. Its origin is the point nearest to that of space.
    ///
    /// # Errors
    /// `BadNumber` if the normal is zero or not finite, or the hyperplane is farther than [`MAX_LENGTH`] from the origin.
    pub fn from_normal(normal: impl Into<Vector<N>>, offset: f64) -> Result<Self> {
        let normal = normal.into();
        let Some(unit) = normal.try_normalize() else {
            return Err(GeometryError::new(
                BadNumber,
                format!("the normal of a slice is {:?}: it must be finite and not zero", normal.0),
            ));
        };
        let distance = offset / unit.dot(normal);
        if !(-MAX_LENGTH..=MAX_LENGTH).contains(&distance) {
            return Err(GeometryError::new(
                BadNumber,
                format!(
                    "the offset of a slice is {offset} along the normal {:?}, which puts it {distance} m from the origin: \
                     the limit is {MAX_LENGTH:e} m",
                    normal.0
                ),
            ));
        }
        Ok(Self { space_from_slice: Pose::new(turn_last_axis_to(unit), unit * distance) })
    }

    /// The pose whose last axis is the normal.
    #[must_use]
    pub fn space_from_slice(&self) -> &Pose<N> {
        &self.space_from_slice
    }

    /// Unit normal.
    #[must_use]
    pub fn normal(&self) -> Vector<N> {
        self.space_from_slice.rotation.matrix().column(N - 1)
    }

    /// Distance of the hyperplane from the origin along the normal.
    #[must_use]
    pub fn offset(&self) -> f64 {
        self.normal().dot(self.space_from_slice.translation)
    }

    /// The same slice as seen from a body: `self` is a frame in the world.
    #[must_use]
    pub fn seen_from(&self, world_from_body: &Pose<N>) -> Self {
        Self { space_from_slice: world_from_body.relative(&self.space_from_slice) }
    }

    /// Signed distance of a point from the hyperplane, positive on the side of the normal.
    #[inline]
    #[must_use]
    pub fn height(&self, point: Vector<N>) -> f64 {
        self.normal().dot(point - self.space_from_slice.translation)
    }

    /// Slice coordinates of the foot of a point on the hyperplane. `M` has to be `N − 1`.
    #[inline]
    #[must_use]
    pub fn to_slice<const M: usize>(&self, point: Vector<N>) -> Vector<M> {
        const { assert!(M + 1 == N, "a hyperplane has one dimension less than its space") };
        let along = self.space_from_slice.inverse_transform_point(point);
        Vector::from_fn(|axis| along[axis])
    }

    /// Slice coordinates of a direction, without its part along the normal.
    #[inline]
    #[must_use]
    pub fn direction_to_slice<const M: usize>(&self, direction: Vector<N>) -> Vector<M> {
        const { assert!(M + 1 == N, "a hyperplane has one dimension less than its space") };
        let along = self.space_from_slice.rotation.inverse_rotate(direction);
        Vector::from_fn(|axis| along[axis])
    }

    /// The point of space with the given slice coordinates.
    #[inline]
    #[must_use]
    pub fn to_space<const M: usize>(&self, point: Vector<M>) -> Vector<N> {
        self.space_from_slice.translation + self.direction_to_space(point)
    }

    /// The direction of space with the given slice coordinates.
    #[inline]
    #[must_use]
    pub fn direction_to_space<const M: usize>(&self, direction: Vector<M>) -> Vector<N> {
        const { assert!(M + 1 == N, "a hyperplane has one dimension less than its space") };
        let padded = Vector::from_fn(|axis| if axis < M { direction[axis] } else { 0.0 });
        self.space_from_slice.rotation.rotate(padded)
    }
}

/// The rotation in the plane of the last axis e and the unit vector n that takes e to n:
/// 1 − s sᵀ/(1 + e·n) + 2 n eᵀ with s = e + n. Where n = −e leaves the plane open, it is that of e and the first axis.
fn turn_last_axis_to<const N: usize>(n: Vector<N>) -> Rotation<N> {
    let e = Vector::unit(N - 1);
    let s = e + n;
    // 1 + e·n without the cancellation near −e.
    let one_plus_cosine = 0.5 * s.norm_sq();
    if one_plus_cosine > 1e-24 {
        let m = Matrix::IDENTITY - Matrix::outer(s, s) * (1.0 / one_plus_cosine) + Matrix::outer(n, e) * 2.0;
        if let Some(rotation) = Rotation::from_matrix(m) {
            return rotation;
        }
    }
    Rotation::in_plane(0, N - 1, std::f64::consts::PI)
}

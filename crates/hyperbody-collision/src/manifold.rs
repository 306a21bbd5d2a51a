//! Contact manifolds: what the narrow phase finds and the solver works on.
//!
//! Two bodies that rest on each other touch along a patch of dimension up to `N − 1`. To hold it, at least `N` points
//! that span it are needed; one point per pair lets a stack topple. A patch may have many corners (the common part of
//! two cubes has up to 14 vertices or more), so it is reduced to the few points that span it best.

use hyperbody_math::Vector;

/// Capacity of a manifold in any dimension.
pub const MAX_POINTS: usize = 16;

/// Largest number of points of a manifold in `n` dimensions: both ends in the plane, four corners in space, the eight
/// corners of a cubic facet in 4D, and half of the corners of a facet of a box above, eight in 5D and sixteen in 6D.
///
/// Half, because every second corner of a cube spans it as evenly as all of them do (they form a demihypercube), where
/// ten of sixteen would let a box sink deeper on one side: a stack in 5D leans on ten and stands on eight.
#[must_use]
pub const fn max_points(n: usize) -> usize {
    match n {
        0..=2 => 2,
        3 => 4,
        4 | 5 => 8,
        _ => MAX_POINTS,
    }
}

/// One point at which two shapes touch or nearly touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint<const N: usize> {
    /// In world coordinates, midway between the two surfaces along the normal.
    pub position: Vector<N>,
    /// Distance of the two surfaces along the normal at this point, in metres; negative where they penetrate.
    pub separation: f64,
    /// Names the features (facets of both shapes) that meet here: the same from step to step while they stay the same.
    pub id: u32,
}

/// The points at which two shapes touch, with one normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manifold<const N: usize> {
    /// Unit vector from a to b in world coordinates; zero while there are no points.
    pub normal: Vector<N>,
    pub(crate) points: [ContactPoint<N>; MAX_POINTS],
    pub(crate) len: u32,
}

impl<const N: usize> Manifold<N> {
    const NO_POINT: ContactPoint<N> = ContactPoint { position: Vector::ZERO, separation: 0.0, id: 0 };

    /// No contact.
    pub const EMPTY: Self = Self { normal: Vector::ZERO, points: [Self::NO_POINT; MAX_POINTS], len: 0 };

    /// The points, at most [`max_points`] of them.
    #[inline]
    #[must_use]
    pub fn points(&self) -> &[ContactPoint<N>] {
        &self.points[..self.len as usize]
    }

    /// The points, to be changed in place.
    #[inline]
    #[must_use]
    pub fn points_mut(&mut self) -> &mut [ContactPoint<N>] {
        &mut self.points[..self.len as usize]
    }

    /// Whether there is no contact.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Forgets all points and the normal.
    #[inline]
    pub fn clear(&mut self) {
        self.normal = Vector::ZERO;
        self.len = 0;
    }

    /// Adds a point; `false` if the manifold was full and stayed as it was.
    #[inline]
    pub fn push(&mut self, point: ContactPoint<N>) -> bool {
        let room = (self.len as usize) < max_points(N);
        if room {
            self.points[self.len as usize] = point;
            self.len += 1;
        }
        room
    }

    /// The least separation, or `None` without contact.
    #[must_use]
    pub fn least_separation(&self) -> Option<f64> {
        self.points().iter().map(|point| point.separation).reduce(f64::min)
    }

    /// The same contact with the two shapes exchanged.
    #[must_use]
    pub fn flipped(mut self) -> Self {
        self.normal = -self.normal;
        self
    }
}

impl<const N: usize> Default for Manifold<N> {
    fn default() -> Self {
        Self::EMPTY
    }
}

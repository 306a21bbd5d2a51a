//! Axis-aligned boxes: the coarsest bound of a shape, and what the dynamic tree is made of.

use hyperbody_math::Vector;

/// All points p with lower ≤ p ≤ upper in every component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb<const N: usize> {
    /// Lower corner.
    pub lower: Vector<N>,
    /// Upper corner.
    pub upper: Vector<N>,
}

impl<const N: usize> Aabb<N> {
    /// The box of the given centre and half-extents.
    #[must_use]
    pub fn from_centre(centre: Vector<N>, half_extents: Vector<N>) -> Self {
        Self { lower: centre - half_extents, upper: centre + half_extents }
    }

    /// The smallest box that holds both.
    #[inline]
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { lower: self.lower.min(other.lower), upper: self.upper.max(other.upper) }
    }

    /// The box grown by `margin` on every side.
    #[inline]
    #[must_use]
    pub fn grown(&self, margin: f64) -> Self {
        Self { lower: self.lower - Vector::splat(margin), upper: self.upper + Vector::splat(margin) }
    }

    /// Whether the two have a point in common.
    #[inline]
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        let mut apart = false;
        for i in 0..N {
            apart |= self.lower.0[i] > other.upper.0[i] || other.lower.0[i] > self.upper.0[i];
        }
        !apart
    }

    /// Whether `other` lies inside.
    #[inline]
    #[must_use]
    pub fn contains(&self, other: &Self) -> bool {
        let mut inside = true;
        for i in 0..N {
            inside &= self.lower.0[i] <= other.lower.0[i] && other.upper.0[i] <= self.upper.0[i];
        }
        inside
    }

    /// Sum of the edge lengths: the cost measure of the tree. In the plane this orders boxes as their perimeter does;
    /// in more dimensions it stands in for the surface, which vanishes for flat boxes and overflows for large ones.
    #[inline]
    #[must_use]
    pub fn edge_sum(&self) -> f64 {
        let mut sum = 0.0;
        for i in 0..N {
            sum += self.upper.0[i] - self.lower.0[i];
        }
        sum
    }

    /// The centre.
    #[inline]
    #[must_use]
    pub fn centre(&self) -> Vector<N> {
        (self.lower + self.upper) * 0.5
    }
}

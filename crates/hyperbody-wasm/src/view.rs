//! The slice: which flat of the world is drawn, and what lies off it.

use hyperbody::geometry::SliceFrame;
use hyperbody::math::{Matrix, Pose, Rotation, Vector};

/// A slice of an `N`-dimensional world: a frame whose first axes are drawn, and whose others are the off directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View<const N: usize> {
    /// World from slice.
    pub pose: Pose<N>,
    /// Number of drawn axes: 2 or 3, at most `N`.
    pub drawn: usize,
}

impl<const N: usize> View<N> {
    /// The first axes of the world, through its origin.
    #[must_use]
    pub fn home() -> Self {
        Self { pose: Pose::IDENTITY, drawn: N.min(3) }
    }

    /// The view with the given drawn axes and, if given, off directions; else those of `self` are kept as far as can be.
    /// `None` if the numbers make no frame.
    #[must_use]
    pub fn moved(&self, origin: &[f64], axes: &[Vec<f64>], off: Option<&[Vec<f64>]>) -> Option<Self> {
        let drawn = axes.len();
        if !(2..=3).contains(&drawn) || drawn > N {
            return None;
        }
        let origin = Vector::from_slice(origin).filter(|origin| origin.is_finite() && origin.max_abs() < 1e9)?;
        let mut basis: Vec<Vector<N>> = Vec::with_capacity(N);
        for axis in axes {
            push_orthonormal(Vector::from_slice(axis)?, &mut basis, 1e-3)?;
        }
        let own = (drawn..N).map(|k| self.pose.rotation.matrix().column(k));
        let wanted: Vec<Vector<N>> = match off {
            Some(off) => off.iter().map(|axis| Vector::from_slice(axis)).collect::<Option<_>>()?,
            None => own.collect(),
        };
        for direction in wanted {
            if basis.len() < N {
                // What the drawn axes have swallowed is found again below.
                let _ = push_orthonormal(direction, &mut basis, 1e-3);
            }
        }
        while basis.len() < N {
            let (_, best) = (0..N)
                .map(|axis| (rest(Vector::unit(axis), &basis).norm_sq(), Vector::unit(axis)))
                .fold((-1.0, Vector::ZERO), |best, next| if next.0 > best.0 { next } else { best });
            push_orthonormal(best, &mut basis, 1e-3)?;
        }
        let frame =
            |basis: &[Vector<N>]| Rotation::from_matrix(Matrix::from_columns(std::array::from_fn(|axis| basis[axis])));
        let rotation = frame(&basis).or_else(|| {
            // Left-handed: only an off direction may be turned round, what is drawn is the page's.
            let last = (drawn < N).then(|| basis.last_mut()).flatten()?;
            *last = -*last;
            frame(&basis)
        })?;
        Some(Self { pose: Pose::new(rotation, origin), drawn })
    }

    /// Number of off directions.
    #[must_use]
    pub fn off_count(&self) -> usize {
        N - self.drawn
    }

    /// Slice coordinates: the drawn ones, then those along the off directions.
    #[must_use]
    pub fn coordinates(&self, point: Vector<N>) -> Vector<N> {
        self.pose.inverse_transform_point(point)
    }

    /// The point of the world with these drawn coordinates.
    #[must_use]
    pub fn to_world(&self, seen: &[f64]) -> Vector<N> {
        self.pose.transform_point(self.padded(seen))
    }

    /// The direction of the world with these drawn coordinates.
    #[must_use]
    pub fn direction_to_world(&self, seen: &[f64]) -> Vector<N> {
        self.pose.rotation.rotate(self.padded(seen))
    }

    fn padded(&self, seen: &[f64]) -> Vector<N> {
        Vector::from_fn(|axis| if axis < self.drawn { seen.get(axis).copied().unwrap_or(0.0) } else { 0.0 })
    }

    /// The hyperplane of the first cut as the body at `world_from_body` sees it.
    pub(crate) fn frame_in(&self, world_from_body: &Pose<N>) -> SliceFrame<N> {
        SliceFrame::new(world_from_body.relative(&self.pose))
    }

    /// The parallel slice through a point.
    pub(crate) fn through(&self, point: Vector<N>) -> Self {
        let along = self.coordinates(point);
        let off = Vector::from_fn(|axis| if axis < self.drawn { 0.0 } else { along[axis] });
        Self { pose: Pose::new(self.pose.rotation, self.pose.transform_point(off)), drawn: self.drawn }
    }
}

/// The drawn coordinates as three numbers.
pub(crate) fn seen<const N: usize>(coordinates: Vector<N>, drawn: usize) -> Vector<3> {
    Vector::from_fn(|axis| if axis < drawn { coordinates[axis] } else { 0.0 })
}

/// What of a vector is orthogonal to an orthonormal basis.
fn rest<const N: usize>(v: Vector<N>, basis: &[Vector<N>]) -> Vector<N> {
    // Twice is enough (Kahan, in Parlett 1980).
    let once = basis.iter().fold(v, |v, &b| v - b * b.dot(v));
    basis.iter().fold(once, |v, &b| v - b * b.dot(v))
}

/// Adds the part of `v` across the basis; `None` if that is less than `least` of it.
fn push_orthonormal<const N: usize>(v: Vector<N>, basis: &mut Vec<Vector<N>>, least: f64) -> Option<()> {
    let unit = v.try_normalize()?;
    let across = rest(unit, basis);
    if across.norm() < least {
        return None;
    }
    basis.push(across.try_normalize()?);
    Some(())
}

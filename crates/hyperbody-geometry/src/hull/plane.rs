//! Hyperplanes through points.

use hyperbody_math::{Matrix, Vector};

/// All points p with normal·p = offset.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hyperplane<const N: usize> {
    /// Unit length.
    pub(crate) normal: Vector<N>,
    pub(crate) offset: f64,
}

impl<const N: usize> Hyperplane<N> {
    /// Signed distance of `p`, positive on the side of the normal.
    #[inline]
    pub(crate) fn distance(&self, p: Vector<N>) -> f64 {
        self.normal.dot(p) - self.offset
    }

    pub(crate) fn flipped(&self) -> Self {
        Self { normal: -self.normal, offset: -self.offset }
    }

    /// The hyperplane through `N` points, or `None` if they do not fix one to working precision.
    ///
    /// The normal is the null vector of the N−1 edges from the first point, by elimination with complete pivoting on
    /// edges of unit length; sums of cofactors would lose all digits where the edges are nearly parallel.
    pub(crate) fn through(points: &[Vector<N>; N]) -> Option<Self> {
        let mut rows = [Vector::ZERO; N];
        for i in 1..N {
            rows[i - 1] = (points[i] - points[0]).try_normalize()?;
        }
        let normal = null_vector(&mut rows)?;
        let offset = points.iter().map(|&p| normal.dot(p)).sum::<f64>() / N as f64;
        Some(Self { normal, offset })
    }

    /// The hyperplane of least squared distance to `points`, which lie close to `self` and fix a hyperplane: one
    /// Gauss–Newton step from `self`. The unknown is the small tilt, not the normal, so nothing is lost by squaring.
    pub(crate) fn fitted(&self, points: &[Vector<N>]) -> Self {
        let centre = points.iter().fold(Vector::ZERO, |sum, &p| sum + p) / points.len() as f64;
        let tangents = self.normal.orthonormal_complement();
        let mut gram = Matrix::<N>::ZERO;
        let mut right = Vector::ZERO;
        for &p in points {
            let r = p - centre;
            let along = Vector::from_fn(|i| tangents[i].dot(r));
            gram += Matrix::outer(along, along);
            right -= along * self.normal.dot(r);
        }
        // The unused last unknown.
        gram[N - 1][N - 1] = 1.0;
        let tilt = gram.solve(right).unwrap_or(Vector::ZERO);
        let tilted = (0..N - 1).fold(self.normal, |sum, i| sum + tangents[i] * tilt[i]);
        let normal = tilted.try_normalize().unwrap_or(self.normal);
        Self { normal, offset: normal.dot(centre) }
    }
}

/// A unit vector orthogonal to the first N−1 rows, or `None` if they are dependent. Overwrites the rows.
fn null_vector<const N: usize>(rows: &mut [Vector<N>; N]) -> Option<Vector<N>> {
    let mut columns: [usize; N] = std::array::from_fn(|i| i);
    for step in 0..N - 1 {
        let (mut row, mut column, mut largest) = (step, step, 0.0);
        for i in step..N - 1 {
            for j in step..N {
                let size = rows[i][columns[j]].abs();
                if size > largest {
                    (row, column, largest) = (i, j, size);
                }
            }
        }
        if largest < f64::EPSILON {
            return None;
        }
        rows.swap(step, row);
        columns.swap(step, column);
        let pivot = rows[step];
        for i in step + 1..N - 1 {
            let factor = rows[i][columns[step]] / pivot[columns[step]];
            rows[i] -= pivot * factor;
        }
    }
    let mut null = Vector::ZERO;
    null[columns[N - 1]] = 1.0;
    for step in (0..N - 1).rev() {
        let sum: f64 = (step + 1..N).map(|j| rows[step][columns[j]] * null[columns[j]]).sum();
        null[columns[step]] = -sum / rows[step][columns[step]];
    }
    null.try_normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<const N: usize>() {
        // Points on the hyperplane of a known normal, at very different distances from each other.
        let normal = Vector::<N>::from_fn(|i| 1.0 + 0.3 * i as f64).normalize_or_zero();
        let tangents = normal.orthonormal_complement();
        let mut points = [normal * 2.5; N];
        for i in 1..N {
            points[i] += tangents[i - 1] * 1e-3_f64.powi(i as i32 % 3);
        }
        let plane = Hyperplane::through(&points).expect("independent points");
        let plane = if plane.offset < 0.0 { plane.flipped() } else { plane };
        assert!((plane.normal - normal).norm() < 1e-9, "{plane:?}");
        assert!((plane.offset - 2.5).abs() < 1e-9);
        let start = Hyperplane { normal: (normal + tangents[0] * 1e-6).normalize_or_zero(), offset: 2.5 };
        assert!((start.fitted(&points).normal - normal).norm() < 1e-9);
        // N points of which two coincide.
        points[N - 1] = points[0];
        assert!(Hyperplane::through(&points).is_none());
    }

    #[test]
    fn hyperplane_passes_through_its_points() {
        check::<2>();
        check::<3>();
        check::<4>();
        check::<5>();
        check::<6>();
    }
}

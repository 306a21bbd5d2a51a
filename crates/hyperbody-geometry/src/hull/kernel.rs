//! The two ways to decide on which side of a facet a point is.

use std::cmp::Ordering;

use hyperbody_math::Vector;

use super::plane::Hyperplane;
use super::quickhull::Failure;
use super::wide::Wide;

/// What quickhull asks about hyperplanes through `N` points, which it names by their indices.
pub(super) trait Kernel<const N: usize> {
    /// A hyperplane with whatever the kernel needs to judge it.
    type Plane: Clone;

    /// The hyperplane through these points, facing away from the interior.
    fn plane(&self, vertices: [u32; N]) -> Result<Self::Plane, Failure>;

    /// Whether the point is outside of the hyperplane.
    fn sees(&self, plane: &Self::Plane, point: u32) -> bool;

    /// Whether the point lies in the hyperplane.
    fn holds(&self, plane: &Self::Plane, point: u32) -> bool;

    /// The hyperplane of a facet that lies in all these planes and has these vertices.
    fn facet_plane(&self, planes: &[&Self::Plane], widest: usize, vertices: &[u32]) -> Hyperplane<N>;

    /// The hyperplane in plain numbers.
    fn hyperplane(plane: &Self::Plane) -> Hyperplane<N>;
}

/// Hyperplanes as thick as a tolerance.
pub(super) struct Thick<'a, const N: usize> {
    pub(super) points: &'a [Vector<N>],
    pub(super) tolerance: f64,
    pub(super) interior: Vector<N>,
}

impl<const N: usize> Kernel<N> for Thick<'_, N> {
    type Plane = Hyperplane<N>;

    fn plane(&self, vertices: [u32; N]) -> Result<Hyperplane<N>, Failure> {
        let plane = Hyperplane::through(&vertices.map(|v| self.points[v as usize]))
            .ok_or(Failure::Inconsistent("a facet without a hyperplane"))?;
        let height = plane.distance(self.interior);
        if height.abs() <= self.tolerance {
            return Err(Failure::Inconsistent("a facet through the interior"));
        }
        Ok(if height > 0.0 { plane.flipped() } else { plane })
    }

    fn sees(&self, plane: &Hyperplane<N>, point: u32) -> bool {
        plane.distance(self.points[point as usize]) > self.tolerance
    }

    fn holds(&self, plane: &Hyperplane<N>, point: u32) -> bool {
        plane.distance(self.points[point as usize]).abs() <= self.tolerance
    }

    fn facet_plane(&self, planes: &[&Hyperplane<N>], widest: usize, vertices: &[u32]) -> Hyperplane<N> {
        if planes.len() == 1 {
            return *planes[0];
        }
        let positions: Vec<Vector<N>> = vertices.iter().map(|&v| self.points[v as usize]).collect();
        planes[widest].fitted(&positions)
    }

    fn hyperplane(plane: &Hyperplane<N>) -> Hyperplane<N> {
        *plane
    }
}

/// Fractional bits of a coordinate between −1 and 1 on the integer grid of [`Exact`]. Differences then have 41 bits with
/// sign, the cofactors of five of them 207, and signed distances, summed over seven points, 253.
const GRID_BITS: i32 = 39;

/// Exact hyperplanes through points moved to a grid that is finer than any tolerance, for at most six dimensions.
pub(super) struct Exact<const N: usize> {
    points: Vec<[i64; N]>,
    /// Corners of a simplex: their mean is the interior point.
    corners: Vec<u32>,
}

#[derive(Clone)]
pub(super) struct ExactPlane<const N: usize> {
    /// Cofactors of the edges from the first point.
    normal: [Wide; N],
    offset: Wide,
    hyperplane: Hyperplane<N>,
}

impl<const N: usize> Exact<N> {
    pub(super) fn new(points: &[Vector<N>], corners: &[u32]) -> Self {
        let scale = 2_f64.powi(GRID_BITS);
        let points = points.iter().map(|p| p.0.map(|c| (c * scale).round() as i64)).collect();
        Self { points, corners: corners.to_vec() }
    }

    /// normal·p − offset.
    fn height(&self, plane: &ExactPlane<N>, point: u32) -> Wide {
        dot(&plane.normal, &self.points[point as usize]) - plane.offset
    }
}

impl<const N: usize> Kernel<N> for Exact<N> {
    type Plane = ExactPlane<N>;

    fn plane(&self, vertices: [u32; N]) -> Result<ExactPlane<N>, Failure> {
        let base = self.points[vertices[0] as usize];
        let mut edges = [[0; N]; N];
        for i in 1..N {
            edges[i - 1] = std::array::from_fn(|axis| self.points[vertices[i] as usize][axis] - base[axis]);
        }
        let mut normal = cofactors(&edges);
        let mut offset = dot(&normal, &base);
        let height =
            self.corners.iter().fold(Wide::ZERO, |sum, &c| sum + dot(&normal, &self.points[c as usize]) - offset);
        match height.sign() {
            Ordering::Less => {}
            Ordering::Equal => return Err(Failure::Inconsistent("a facet through the interior")),
            Ordering::Greater => {
                normal = normal.map(|c| -c);
                offset = -offset;
            }
        }
        let plain = Vector(normal.map(Wide::to_f64));
        let unit = plain.try_normalize().ok_or(Failure::Inconsistent("a facet without a hyperplane"))?;
        let distance = offset.to_f64() / unit.dot(plain) * 2_f64.powi(-GRID_BITS);
        Ok(ExactPlane { normal, offset, hyperplane: Hyperplane { normal: unit, offset: distance } })
    }

    fn sees(&self, plane: &ExactPlane<N>, point: u32) -> bool {
        self.height(plane, point).sign() == Ordering::Greater
    }

    fn holds(&self, plane: &ExactPlane<N>, point: u32) -> bool {
        self.height(plane, point).sign() == Ordering::Equal
    }

    fn facet_plane(&self, planes: &[&ExactPlane<N>], widest: usize, _: &[u32]) -> Hyperplane<N> {
        planes[widest].hyperplane
    }

    fn hyperplane(plane: &ExactPlane<N>) -> Hyperplane<N> {
        plane.hyperplane
    }
}

fn dot<const N: usize>(normal: &[Wide; N], point: &[i64; N]) -> Wide {
    (0..N).fold(Wide::ZERO, |sum, axis| sum + normal[axis].times(point[axis]))
}

/// The vector orthogonal to the first N−1 rows whose components are their signed minors: Laplace expansion, row by row,
/// with each minor of the first k rows computed once.
fn cofactors<const N: usize>(rows: &[[i64; N]; N]) -> [Wide; N] {
    let mut minors = vec![Wide::ZERO; 1 << N];
    minors[0] = Wide::new(1);
    for set in 1_usize..1 << N {
        let size = set.count_ones() as usize;
        if size == N {
            continue;
        }
        let row = &rows[size - 1];
        let mut sum = Wide::ZERO;
        // The last row's entry in the p-th column of the set has the sign (−1)^(size − 1 − p).
        let mut positive = !size.is_multiple_of(2);
        for axis in (0..N).filter(|&axis| set >> axis & 1 == 1) {
            let term = minors[set & !(1 << axis)].times(row[axis]);
            sum = if positive { sum + term } else { sum - term };
            positive = !positive;
        }
        minors[set] = sum;
    }
    let all = (1 << N) - 1;
    std::array::from_fn(|axis| {
        let minor = minors[all & !(1 << axis)];
        if axis % 2 == 0 { minor } else { -minor }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<const N: usize>() {
        let rows: [[i64; N]; N] =
            std::array::from_fn(|i| std::array::from_fn(|j| ((i * 37 + j * j * 11 + i * j * 5) % 23) as i64 - 11));
        let normal = cofactors(&rows);
        assert!(normal.iter().any(|c| *c != Wide::ZERO));
        for row in &rows[..N - 1] {
            assert_eq!(dot(&normal, row), Wide::ZERO, "{rows:?}");
        }
        // The largest entries that occur do not overflow: a Hadamard-like matrix of ±2⁴⁰.
        let large: [[i64; N]; N] = std::array::from_fn(|i| {
            std::array::from_fn(|j| if (i & (j + 1)).count_ones() % 2 == 0 { 1 << 40 } else { -(1 << 40) })
        });
        let normal = cofactors(&large);
        for row in &large[..N - 1] {
            assert_eq!(dot(&normal, row), Wide::ZERO);
        }
    }

    #[test]
    fn cofactors_are_orthogonal_to_the_rows() {
        check::<2>();
        check::<3>();
        check::<4>();
        check::<5>();
        check::<6>();
    }
}

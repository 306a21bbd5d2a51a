//! Mass properties of whatever a closed surface of simplices bounds, convex or not.
//!
//! Each boundary simplex (v_1 … v_N) spans a solid simplex with a reference point; with M = [v_1 … v_N] relative to it
//! the signed volume is det M / N!, and ∫x xᵀ dV = det M / (N+2)! · (Σ v_i v_iᵀ + s sᵀ), s = Σ v_i. Where the
//! reference point is outside, the signs cancel what is counted too much. (Ten Bosch 2020, §5; in three dimensions
//! B. Mirtich 1996 and F. Tonon 2004.)

use hyperbody_math::{Matrix, Vector};

use super::MassProperties;
use crate::error::GeometryErrorKind::BadMesh;
use crate::volume::factorial;
use crate::{GeometryError, Polytope, Result};

/// Volume and raw moments about a reference point, at unit density.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moments<const N: usize> {
    pub(super) volume: f64,
    pub(super) first: Vector<N>,
    pub(super) second: Matrix<N>,
}

impl<const N: usize> Moments<N> {
    pub(super) const ZERO: Self = Self { volume: 0.0, first: Vector::ZERO, second: Matrix::ZERO };

    /// Adds a simplex of any dimension with the given volume; corners relative to the reference point.
    pub(super) fn add_simplex(&mut self, volume: f64, corners: &[Vector<N>]) {
        let count = corners.len() as f64;
        let sum = corners.iter().fold(Vector::ZERO, |sum, &c| sum + c);
        let squares = corners.iter().fold(Matrix::outer(sum, sum), |total, &c| total + Matrix::outer(c, c));
        self.volume += volume;
        self.first += sum * (volume / count);
        self.second += squares * (volume / (count * (count + 1.0)));
    }

    /// The properties of a body of unit density whose moments about `reference` these are.
    pub(super) fn properties(&self, reference: Vector<N>) -> MassProperties<N> {
        let centre = self.first / self.volume;
        let second = self.second - Matrix::outer(centre, self.first);
        MassProperties { mass: self.volume, centre: reference + centre, second_moments: symmetric(&second) }
    }
}

/// The symmetric part: what rounding leaves beside it means nothing.
pub(super) fn symmetric<const N: usize>(m: &Matrix<N>) -> Matrix<N> {
    Matrix::from_fn(|i, j| 0.5 * (m[i][j] + m[j][i]))
}

impl<const N: usize> MassProperties<N> {
    /// The properties, at unit density, of the solid bounded by `simplices`, each `N` indices into `points`. The
    /// solid may be non-convex and in several pieces. Neighbours have to be oriented alike; if all simplices face
    /// inward, the sign is turned.
    ///
    /// # Errors
    /// `BadMesh` if an index is out of range, the surface is not closed or not oriented alike, or it bounds no volume.
    pub fn of_closed_boundary(points: &[Vector<N>], simplices: &[[u32; N]]) -> Result<Self> {
        if let Some(index) = points.iter().position(|p| !p.is_finite()) {
            return Err(bad_mesh(format!(
                "point {index} of a mesh is {:?}: coordinates must be finite",
                points[index].0
            )));
        }
        check_closed(simplices, points.len())?;
        let mut used: Vec<u32> = simplices.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        let sum = used.iter().fold(Vector::ZERO, |sum, &v| sum + points[v as usize]);
        let reference = sum / used.len().max(1) as f64;
        let mut moments = Moments::<N>::ZERO;
        let mut absolute = 0.0;
        for simplex in simplices {
            let (volume, corners) = cone(reference, &simplex.map(|v| points[v as usize]));
            absolute += volume.abs();
            moments.add_simplex(volume, &corners);
        }
        // Beyond this cancellation no digit of the volume is left.
        if moments.volume.abs() <= 1e-12 * absolute {
            return Err(bad_mesh(format!(
                "the mesh bounds no volume: its {} simplices add up to {:e} m^{N}",
                simplices.len(),
                moments.volume
            )));
        }
        // Turning every simplex around changes the sign of every moment.
        let mut properties = moments.properties(reference);
        if moments.volume < 0.0 {
            properties.mass = -properties.mass;
            properties.second_moments = -properties.second_moments;
        }
        Ok(properties)
    }
}

impl<const N: usize> MassProperties<N> {
    /// The properties at unit density of simplices, each `N + 1` indices into `points`, that do not overlap. All zero for
    /// none.
    pub(crate) fn of_filling(points: &[Vector<N>], simplices: &[Vec<u32>]) -> Self {
        let Some(first) = simplices.first() else {
            return Self { mass: 0.0, centre: Vector::ZERO, second_moments: Matrix::ZERO };
        };
        let reference = points[first[0] as usize];
        let mut moments = Moments::<N>::ZERO;
        for simplex in simplices {
            let base: [Vector<N>; N] = std::array::from_fn(|i| points[simplex[i + 1] as usize]);
            let apex = points[simplex[0] as usize];
            let volume = Matrix::from_columns(base.map(|p| p - apex)).determinant().abs() / factorial(N);
            let corners: Vec<Vector<N>> = simplex.iter().map(|&v| points[v as usize] - reference).collect();
            moments.add_simplex(volume, &corners);
        }
        moments.properties(reference)
    }
}

/// The properties of a convex polytope at unit density.
pub(super) fn of_polytope<const N: usize>(polytope: &Polytope<N>) -> MassProperties<N> {
    let reference = polytope.vertex_mean();
    let mut moments = Moments::<N>::ZERO;
    for simplex in polytope.boundary_simplices() {
        let (volume, corners) = cone(reference, &simplex.map(|v| polytope.vertices()[v as usize]));
        moments.add_simplex(volume, &corners);
    }
    moments.properties(reference)
}

/// The simplex over `base` with its apex at `reference`: signed volume, and corners relative to the apex.
fn cone<const N: usize>(reference: Vector<N>, base: &[Vector<N>; N]) -> (f64, Vec<Vector<N>>) {
    let edges = base.map(|p| p - reference);
    let mut corners = vec![Vector::ZERO];
    corners.extend(edges);
    (Matrix::from_columns(edges).determinant() / factorial(N), corners)
}

/// Every ridge has to be in as many simplices with one orientation as with the other.
fn check_closed<const N: usize>(simplices: &[[u32; N]], point_count: usize) -> Result<()> {
    let mut ridges: Vec<([u32; N], i32, usize)> = Vec::with_capacity(simplices.len() * N);
    for (index, simplex) in simplices.iter().enumerate() {
        if let Some(v) = simplex.iter().find(|&&v| v as usize >= point_count) {
            return Err(bad_mesh(format!("simplex {index} of a mesh names point {v}, but there are {point_count}")));
        }
        for skip in 0..N {
            // The boundary of (v_0 … v_k) is Σ (−1)^i (… without v_i …); the last entry is a stand-in for v_i.
            let mut key = *simplex;
            key.copy_within(skip + 1.., skip);
            key[N - 1] = u32::MAX;
            let sign = if skip % 2 == 0 { 1 } else { -1 };
            let swaps = sort_counting_swaps(&mut key);
            ridges.push((key, if swaps % 2 == 0 { sign } else { -sign }, index));
        }
    }
    ridges.sort_unstable();
    for same in ridges.chunk_by(|a, b| a.0 == b.0) {
        let (key, _, index) = same[0];
        let corners = &key[..N - 1];
        if corners.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err(bad_mesh(format!("simplex {index} of a mesh names a point twice")));
        }
        if same.iter().map(|ridge| ridge.1).sum::<i32>() != 0 {
            let remedy = if same.len().is_multiple_of(2) { "turn one of them around" } else { "close the hole" };
            return Err(bad_mesh(format!(
                "the mesh is not closed and oriented: points {corners:?} are shared by {} simplices (one is number \
                 {index}) whose orientations do not cancel; {remedy}",
                same.len()
            )));
        }
    }
    Ok(())
}

/// Insertion sort; the parity of the swaps is the sign of the permutation.
fn sort_counting_swaps<const N: usize>(key: &mut [u32; N]) -> usize {
    let mut swaps = 0;
    for i in 1..N {
        let mut j = i;
        while j > 0 && key[j - 1] > key[j] {
            key.swap(j - 1, j);
            swaps += 1;
            j -= 1;
        }
    }
    swaps
}

fn bad_mesh(message: String) -> GeometryError {
    GeometryError::new(BadMesh, message)
}

//! The planes that a bivector or a rotation turns independently of each other.
//!
//! Every bivector is a sum Σ θ_k f_2k ∧ f_2k+1 over at most N/2 mutually orthogonal planes, and every rotation a product
//! of turns by θ_k in such planes (the real normal form of antisymmetric and orthogonal matrices; C. Jordan, 1875).
//! One plane is a simple rotation, two are a double rotation, and with equal angles it is isoclinic: its planes are then
//! not unique. Exponential and logarithm are one line each from here, without a special case for any of these.
//!
//! The eigenvectors of KᵀK span the planes of an antisymmetric K, and K itself pairs them: K f_2k = θ_k f_2k+1. For a
//! rotation R the cosines alone do not separate small angles, nor the sines those on both sides of π/2, so its symmetric
//! part first splits space in two, front (small angles) and back (large ones), in the widest gap between the cosines; then K is
//! tan(θ/2) in front and cot(θ/2) at the back, both well away from their poles.

use std::f64::consts::TAU;
use std::ops::Range;

use crate::{Bivector, Matrix, Rotation, Vector, scalar, symmetric_eigen};

/// Cosines beyond ±this are certainly front or back; the split lies between. At least one gap there is wider than a third,
/// as at most three pairs of cosines divide it.
const CERTAIN: f64 = 0.7;

/// A bivector or rotation taken apart into orthogonal planes, each turned by its own value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InvariantPlanes<const N: usize> {
    frame: Rotation<N>,
    /// The first N/2 count.
    values: [f64; N],
}

impl<const N: usize> InvariantPlanes<N> {
    /// Number of planes: N/2, rounded down.
    pub const COUNT: usize = N / 2;

    const NOT_FINITE: Self = Self { frame: Rotation::IDENTITY, values: [f64::NAN; N] };

    /// An orthonormal frame: its columns 2k and 2k + 1 span plane number k. In odd `N` the last column is fixed.
    #[must_use]
    pub fn frame(&self) -> &Rotation<N> {
        &self.frame
    }

    /// The number of each plane, in descending order: for a bivector in its own unit, for a rotation the angle in radians,
    /// at most π. All are positive or zero except that in even `N` the last, which is the smallest in absolute value, takes
    /// the sign that makes the frame a rotation.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values[..Self::COUNT]
    }

    /// Plane number k as a unit bivector, from column 2k of the frame towards column 2k + 1.
    ///
    /// # Panics
    /// If `k` is not below [`InvariantPlanes::COUNT`].
    #[must_use]
    pub fn plane(&self, k: usize) -> Bivector<N> {
        let frame = self.frame.matrix();
        Bivector::wedge(frame.column(2 * k), frame.column(2 * k + 1))
    }

    /// Σ value · plane: the bivector, or of a rotation the logarithm.
    #[must_use]
    pub fn to_bivector(&self) -> Bivector<N> {
        let mut sum = Bivector::ZERO;
        for (k, &value) in self.values().iter().enumerate() {
            sum += self.plane(k) * value;
        }
        sum
    }

    /// The rotation that turns every plane by its value as an angle in radians.
    #[must_use]
    pub fn to_rotation(&self) -> Rotation<N> {
        let mut m = Matrix::IDENTITY;
        for (k, &angle_rad) in self.values().iter().enumerate() {
            let frame = self.frame.matrix();
            let (f, g) = (frame.column(2 * k), frame.column(2 * k + 1));
            let (sin, _) = scalar::sin_cos(angle_rad);
            let (half_sin, _) = scalar::sin_cos(0.5 * angle_rad);
            // 1 − cos without cancellation.
            let versine = 2.0 * half_sin * half_sin;
            m += (Matrix::outer(g, f) + -Matrix::outer(f, g)) * sin;
            m += (Matrix::outer(f, f) + Matrix::outer(g, g)) * -versine;
        }
        let mut rotation = Rotation::from_matrix_unchecked(m);
        rotation.reorthonormalize();
        rotation
    }

    /// The same rotation with the angle of the first plane, which has the furthest to go, replaced by the turn the other
    /// way round: θ − 2π for θ ≥ 0.
    pub(crate) fn other_way_round(mut self) -> Self {
        self.values[0] -= TAU.copysign(self.values[0]);
        self
    }

    /// The planes of a bivector. If a number is not finite, the values are NaN.
    pub(crate) fn of_bivector(b: &Bivector<N>) -> Self {
        if !b.is_finite() {
            return Self::NOT_FINITE;
        }
        // As velocities: r moves at K r.
        let k = b.to_matrix().transpose();
        let scale = k.max_abs();
        let columns = paired_columns(&(if scale > 0.0 { k * (1.0 / scale) } else { k }), N);
        Self::sorted(columns, |f, g| g.dot(b.act_on(f)))
    }

    /// The planes of a rotation, with angles from 0 to π. If an entry is not finite, the values are NaN.
    pub(crate) fn of_rotation(rotation: &Rotation<N>) -> Self {
        let r = rotation.matrix();
        if !r.is_finite() {
            return Self::NOT_FINITE;
        }
        let (cosines, basis) = symmetric_eigen(r);
        let basis = basis.matrix();
        let split = front_size(&cosines);
        // The sines: antisymmetric before the change of basis, so that tiny turns keep their digits.
        let sines = Matrix::from_fn(|i, j| 0.5 * (r[i][j] - r[j][i]));
        let turned = basis.transpose() * sines * *basis;
        let k = Matrix::from_fn(|i, j| {
            let sine = 0.5 * (turned[i][j] - turned[j][i]);
            match (i < split, j < split) {
                (true, true) => sine / ((1.0 + cosines[i]) * (1.0 + cosines[j])).sqrt(),
                (false, false) => sine / ((1.0 - cosines[i]) * (1.0 - cosines[j])).sqrt(),
                _ => 0.0,
            }
        });
        let columns = paired_columns(&k, split).map(|column| *basis * column);
        Self::sorted(columns, |f, g| {
            let sin = g.dot(sines * f);
            let cos = 0.5 * (f.dot(*r * f) + g.dot(*r * g));
            scalar::atan2(sin, cos)
        })
    }

    /// Pairs in descending order of their values, as a frame of determinant one.
    fn sorted(mut columns: [Vector<N>; N], value: impl Fn(Vector<N>, Vector<N>) -> f64) -> Self {
        let mut values = [0.0; N];
        for k in 0..Self::COUNT {
            values[k] = value(columns[2 * k], columns[2 * k + 1]);
            // K f = θ g makes them positive up to rounding.
            if values[k] < 0.0 {
                values[k] = -values[k];
                columns[2 * k + 1] = -columns[2 * k + 1];
            }
        }
        // Insertion sort: at most three pairs.
        for end in 1..Self::COUNT {
            for k in (0..end).rev() {
                if values[k] < values[k + 1] {
                    values.swap(k, k + 1);
                    columns.swap(2 * k, 2 * k + 2);
                    columns.swap(2 * k + 1, 2 * k + 3);
                }
            }
        }
        let mut m = Matrix::from_columns(columns);
        if m.determinant() < 0.0 {
            for row in &mut m.0 {
                row[N - 1] = -row[N - 1];
            }
            if N.is_multiple_of(2) && values[Self::COUNT - 1] != 0.0 {
                values[Self::COUNT - 1] = -values[Self::COUNT - 1];
            }
        }
        let mut frame = Rotation::from_matrix_unchecked(m);
        frame.reorthonormalize();
        Self { frame, values }
    }
}

/// How many of the descending cosines belong to the front: the widest gap between −[`CERTAIN`] and [`CERTAIN`] ends it.
fn front_size<const N: usize>(cosines: &Vector<N>) -> usize {
    let mut previous = CERTAIN;
    let (mut widest, mut size) = (0.0, N);
    for i in 0..=N {
        let next = if i < N { cosines[i].clamp(-CERTAIN, CERTAIN) } else { -CERTAIN };
        if previous - next > widest {
            (widest, size) = (previous - next, i);
        }
        previous = next;
    }
    size
}

/// An orthonormal basis in which an antisymmetric matrix is made of 2×2 blocks, K f_2k = θ_k f_2k+1 with θ_k ≥ 0, followed
/// by what has no partner. `k` must have no entries that join an axis below `split` with one from there on; no basis vector
/// mixes these two parts either.
///
/// The fastest plane is found and split off, again and again: KᵀK holds the squares θ², in which planes slower than 1e-8
/// of the fastest drown, but its largest eigenvector is good to rounding in K itself.
fn paired_columns<const N: usize>(k: &Matrix<N>, split: usize) -> [Vector<N>; N] {
    let mut basis = Basis { columns: [Vector::ZERO; N], paired: 0, apart: 0 };
    for _ in 0..N {
        let left = N - basis.paired - basis.apart;
        // Any two directions span the last plane.
        let fastest = if left > 2 { basis.fastest(k) } else { None };
        let Some(f) = fastest.or_else(|| basis.next_axis(0..N)) else { break };
        basis.columns[basis.paired] = f;
        let part = if f.iter().take(split).any(|c| c != 0.0) { 0..split } else { split..N };
        let moved = (*k * f).try_normalize().and_then(|g| basis.rest(g, 0.5));
        // Without θ, or with one that drowns in the rounding of faster planes, any partner from the same part will do.
        if let Some(g) = moved.or_else(|| basis.next_axis(part)) {
            basis.columns[basis.paired + 1] = g;
            basis.paired += 2;
        } else {
            // The fixed axis of odd dimensions.
            basis.columns[basis.paired] = Vector::ZERO;
            basis.apart += 1;
            basis.columns[N - basis.apart] = f;
        }
    }
    basis.columns
}

/// Orthonormal vectors chosen one by one.
struct Basis<const N: usize> {
    /// Pairs from the first on, those without a partner from the last on; zero between.
    columns: [Vector<N>; N],
    paired: usize,
    apart: usize,
}

impl<const N: usize> Basis<N> {
    /// A unit vector of the plane that `k` moves fastest among those orthogonal to the chosen ones. `None` if `k` moves none
    /// of them, or by no more than rounding.
    fn fastest(&self, k: &Matrix<N>) -> Option<Vector<N>> {
        let mut projector = Matrix::IDENTITY;
        for c in &self.columns {
            projector += -Matrix::outer(*c, *c);
        }
        let k = projector * *k * projector;
        let scale = k.max_abs();
        if scale == 0.0 {
            return None;
        }
        let k = k * (1.0 / scale);
        let (_, eigenvectors) = symmetric_eigen(&(k.transpose() * k));
        self.rest(eigenvectors.matrix().column(0), 0.5)
    }

    /// The unit vector of one of `axes`, made orthogonal to the chosen vectors; of that axis of which most is left.
    fn next_axis(&self, axes: Range<usize>) -> Option<Vector<N>> {
        let left = |axis: usize| 1.0 - self.columns.iter().map(|c| c[axis] * c[axis]).sum::<f64>();
        let best = axes.reduce(|best, axis| if left(axis) > left(best) { axis } else { best })?;
        // Of N axes and one missing direction one axis holds at least 1/√N of it.
        self.rest(Vector::unit(best), 0.3)
    }

    /// What projecting out the chosen vectors leaves of a unit vector, normalised, if that is longer than `least`.
    fn rest(&self, v: Vector<N>, least: f64) -> Option<Vector<N>> {
        let project = |v: Vector<N>| self.columns.iter().fold(v, |rest, c| rest - *c * c.dot(rest));
        let rest = project(v);
        // Twice, so that it is orthogonal to rounding.
        if rest.norm() > least { project(rest).try_normalize() } else { None }
    }
}

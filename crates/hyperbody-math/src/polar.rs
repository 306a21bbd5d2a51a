//! The rotation nearest to a matrix.
//!
//! With the singular value decomposition M = U Σ Vᵀ the rotation nearest in the sum of squares is U diag(1, …, 1, d) Vᵀ,
//! where d = ±1 makes the determinant one (G. Wahba, 1965; W. Kabsch, 1976). The decomposition is the one-sided Jacobi
//! iteration (M. R. Hestenes, 1958): it needs no start, works at any distance and on singular matrices. The Newton step
//! of [`Rotation::reorthonormalize`] is far cheaper, but converges only from nearby.

use crate::order::descending;
use crate::{Matrix, Rotation, Vector};

/// Sweeps over all pairs of columns; like the two-sided iteration, it takes fewer than ten.
const MAX_SWEEPS: usize = 32;

/// Two columns whose cosine is below this count as orthogonal: rounding of an inner product.
const ORTHOGONAL: f64 = 4.0 * f64::EPSILON;

/// The nearest rotation is unique only while σ_(n−1) + d σ_n > 0. A relative value below this leaves fewer than seven
/// digits of the answer to the matrix and the rest to rounding.
const UNIQUE: f64 = 1e-9;

/// See [`Rotation::nearest`].
pub(crate) fn nearest_rotation<const N: usize>(m: &Matrix<N>) -> Option<Rotation<N>> {
    let scale = m.max_abs();
    if !(m.is_finite() && scale > 0.0) {
        return None;
    }
    // Rows of `a` and `v` are the columns of M V and of V.
    let mut a = Matrix::from_fn(|i, j| m[j][i] / scale);
    let mut v = Matrix::IDENTITY;
    for _ in 0..MAX_SWEEPS {
        let mut rotated = false;
        for p in 0..N {
            for q in p + 1..N {
                rotated |= orthogonalize_pair(&mut a, &mut v, p, q);
            }
        }
        if !rotated {
            break;
        }
    }
    let order: [usize; N] = descending(|i| a.row(i).norm_sq());
    let stretched = order.map(|i| a.row(i));
    let v = Matrix(order.map(|i| v.0[i]));

    let mut u = Matrix::ZERO;
    for k in 0..N - 1 {
        u.0[k] = stretched[k].try_normalize()?.0;
    }
    u.0[N - 1] = completion(&u).0;
    if u.determinant() * v.determinant() < 0.0 {
        u.0[N - 1] = (-u.row(N - 1)).0;
    }
    // The smallest singular value, with the sign d.
    let last = stretched[N - 1].dot(u.row(N - 1));
    let second_to_last = stretched[N - 2].norm();
    let unique = second_to_last + last > UNIQUE * stretched[0].norm();
    unique.then(|| {
        let mut rotation = Rotation::from_matrix_unchecked(u.transpose() * v);
        rotation.reorthonormalize();
        rotation
    })
}

/// Turns rows p and q of both matrices in their plane so that those of `a` become orthogonal; returns whether it had to.
fn orthogonalize_pair<const N: usize>(a: &mut Matrix<N>, v: &mut Matrix<N>, p: usize, q: usize) -> bool {
    let (ap, aq) = (a.row(p), a.row(q));
    let (pp, qq, pq) = (ap.norm_sq(), aq.norm_sq(), ap.dot(aq));
    if pq.abs() <= ORTHOGONAL * (pp * qq).sqrt() {
        return false;
    }
    let zeta = 0.5 * (qq / pq - pp / pq);
    let root = if zeta.abs() > 1e150 { 2.0 * zeta.abs() } else { zeta.abs() + (zeta * zeta + 1.0).sqrt() };
    let tan = if zeta < 0.0 { -1.0 / root } else { 1.0 / root };
    let cos = 1.0 / (tan * tan + 1.0).sqrt();
    let sin = cos * tan;
    for m in [a, v] {
        let (mp, mq) = (m.row(p), m.row(q));
        m.0[p] = (mp * cos - mq * sin).0;
        m.0[q] = (mp * sin + mq * cos).0;
    }
    true
}

/// The unit vector orthogonal to the first N − 1 rows, which are orthonormal.
fn completion<const N: usize>(rows: &Matrix<N>) -> Vector<N> {
    // The axis furthest from their span: 1 − Σ over rows of the component squared.
    let squares = |axis: usize| (0..N - 1).map(|k| rows[k][axis] * rows[k][axis]).sum::<f64>();
    let axis = (1..N).fold(0, |best, axis| if squares(axis) < squares(best) { axis } else { best });
    let mut completion = Vector::unit(axis);
    // Twice, so that what remains is orthogonal to rounding (L. Giraud et al., 2005).
    for _ in 0..2 {
        for k in 0..N - 1 {
            completion -= rows.row(k) * rows.row(k).dot(completion);
        }
        completion = completion.normalize_or_zero();
    }
    completion
}

//! Eigenvalues and eigenvectors of symmetric matrices: principal moments and principal axes.
//!
//! Cyclic Jacobi rotations (C. G. J. Jacobi, 1846; threshold and update as in H. Rutishauser, 1966): for matrices of at
//! most six rows nothing converges faster or keeps the eigenvectors orthogonal better, and it uses only the
//! operations that IEEE 754 fixes to the bit.

use crate::order::descending;
use crate::{Matrix, Rotation, Vector};

/// Sweeps over all off-diagonal entries. Convergence is quadratic: the random, graded and degenerate matrices of the
/// tests take at most seven, and the bound only guards against the unforeseen.
const MAX_SWEEPS: usize = 32;

/// The eigenvalues of a symmetric matrix in descending order, and the rotation whose columns are the eigenvectors:
/// with values λ and rotation R, M = R diag(λ) Rᵀ.
///
/// Equal eigenvalues keep the order of the axes they come from, a diagonal matrix is only sorted, without rounding, and
/// an already sorted one gives the identity. Every eigenvector but the last points so that its largest component (the
/// first of equals) is positive; the sign of the last makes the determinant one.
///
/// Only the symmetric part of `m` counts. If an entry is not finite, all values are NaN and the rotation is the identity.
#[must_use]
pub fn symmetric_eigen<const N: usize>(m: &Matrix<N>) -> (Vector<N>, Rotation<N>) {
    if !m.is_finite() {
        return (Vector::splat(f64::NAN), Rotation::IDENTITY);
    }
    let mut a = Matrix::from_fn(|i, j| 0.5 * m[i][j] + 0.5 * m[j][i]);
    let mut vectors = Matrix::IDENTITY;
    for _ in 0..MAX_SWEEPS {
        let mut rotated = false;
        for p in 0..N {
            for q in p + 1..N {
                rotated |= annihilate(&mut a, &mut vectors, p, q);
            }
        }
        if !rotated {
            break;
        }
    }
    sorted(a.diagonal(), &vectors)
}

/// Turns plane (p, q) so that entry (p, q) vanishes; returns whether it had to.
fn annihilate<const N: usize>(a: &mut Matrix<N>, vectors: &mut Matrix<N>, p: usize, q: usize) -> bool {
    let off = a[p][q];
    if off == 0.0 {
        return false;
    }
    // Entries below the rounding of both diagonal neighbours change no eigenvalue.
    let negligible = 0.25 * f64::EPSILON * a[p][p].abs().min(a[q][q].abs());
    a[p][q] = 0.0;
    a[q][p] = 0.0;
    if off.abs() <= negligible {
        return false;
    }
    // tan of the turn: the smaller root of t² + 2θt − 1 = 0, so that no turn exceeds 45° and sorted input stays sorted.
    let theta = 0.5 * (a[q][q] / off - a[p][p] / off);
    let tan = if theta.abs() > 1e150 {
        0.5 / theta
    } else {
        let root = theta.abs() + (theta * theta + 1.0).sqrt();
        if theta < 0.0 { -1.0 / root } else { 1.0 / root }
    };
    let cos = 1.0 / (tan * tan + 1.0).sqrt();
    let sin = tan * cos;
    a[p][p] -= tan * off;
    a[q][q] += tan * off;
    for r in (0..N).filter(|&r| r != p && r != q) {
        let (rp, rq) = (a[r][p], a[r][q]);
        a[r][p] = cos * rp - sin * rq;
        a[r][q] = sin * rp + cos * rq;
        a[p][r] = a[r][p];
        a[q][r] = a[r][q];
    }
    for row in &mut vectors.0 {
        let (vp, vq) = (row[p], row[q]);
        row[p] = cos * vp - sin * vq;
        row[q] = sin * vp + cos * vq;
    }
    true
}

/// Values in descending order with their vectors, signs fixed as [`symmetric_eigen`] promises.
fn sorted<const N: usize>(values: Vector<N>, vectors: &Matrix<N>) -> (Vector<N>, Rotation<N>) {
    let order: [usize; N] = descending(|i| values[i]);
    let columns = order.map(|i| {
        let column = vectors.column(i);
        if column[column.axis_of_max_abs()] < 0.0 { -column } else { column }
    });
    let mut frame = Matrix::from_columns(columns);
    if frame.determinant() < 0.0 {
        for row in &mut frame.0 {
            row[N - 1] = -row[N - 1];
        }
    }
    let mut rotation = Rotation::from_matrix_unchecked(frame);
    rotation.reorthonormalize();
    (Vector::from_fn(|i| values[order[i]]), rotation)
}

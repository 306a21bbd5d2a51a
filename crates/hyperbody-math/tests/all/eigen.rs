//! Symmetric eigenproblems: random, graded, degenerate, diagonal and extreme matrices.

use crate::common::{Random, assert_within};
use hyperbody_math::{Matrix, Rotation, Vector, symmetric_eigen};

mod every_dimension {
    crate::common::in_every_dimension!(random_matrices degenerate_matrices diagonal_is_exact any_scale);
}

/// Checks M = R diag(λ) Rᵀ, the order, the orthogonality and the signs; `scale` is the largest |entry|.
fn check_decomposition<const N: usize>(m: &Matrix<N>) {
    let (values, frame) = symmetric_eigen(m);
    let r = *frame.matrix();
    let scale = m.max_abs();
    let rebuilt = r * Matrix::from_diagonal(values) * r.transpose();
    assert_within((rebuilt - *m).max_abs(), 4e-15 * scale * N as f64, "rebuilt matrix");
    assert_within((r.transpose() * r - Matrix::IDENTITY).max_abs(), 1e-15, "orthogonality");
    assert_within((r.determinant() - 1.0).abs(), 1e-14, "determinant");
    for i in 1..N {
        assert!(values[i - 1] >= values[i], "values descend: {values:?}");
    }
    for j in 0..N - 1 {
        let column = r.column(j);
        assert!(column[column.axis_of_max_abs()] > 0.0, "largest component of vector {j} is positive: {r:?}");
    }
}

fn random_matrices<const N: usize>() {
    let mut random = Random::new(1);
    for _ in 0..300 {
        let m = random.matrix::<N>();
        check_decomposition(&(m + m.transpose()));
        // A covariance, as mass properties make it.
        check_decomposition(&(m * m.transpose()));
    }
}

fn known_values<const N: usize>(values: Vector<N>, seed: u64, limit: f64) {
    let mut random = Random::new(seed);
    let mut expected = values.0;
    expected.sort_by(|a, b| b.total_cmp(a));
    for _ in 0..100 {
        let r = *random.rotation::<N>().matrix();
        let m = r * Matrix::from_diagonal(values) * r.transpose();
        let m = (m + m.transpose()) * 0.5;
        check_decomposition(&m);
        let (found, _) = symmetric_eigen(&m);
        assert_within((found - Vector(expected)).max_abs(), limit * values.max_abs(), "eigenvalues");
    }
}

fn degenerate_matrices<const N: usize>() {
    known_values::<N>(Vector::splat(3.0), 2, 1e-14);
    known_values::<N>(Vector::from_fn(|i| if i < N / 2 { 2.0 } else { 5.0 }), 3, 1e-14);
    known_values::<N>(Vector::from_fn(|i| if i == 0 { 1.0 } else { 0.0 }), 4, 1e-14);
    known_values::<N>(Vector::from_fn(|i| if i == 0 { 1.0 } else { -1.0 }), 5, 1e-14);
    known_values::<N>(Vector::from_fn(|i| 10f64.powi(-4 * i as i32)), 6, 1e-14);
    // Eigenvalues that differ by a few roundings only.
    known_values::<N>(Vector::from_fn(|i| 1.0 + 1e-15 * i as f64), 7, 1e-14);
}

fn diagonal_is_exact<const N: usize>() {
    let descending = Vector::from_fn(|i| 0.1 * (N - i) as f64);
    assert_eq!(symmetric_eigen(&Matrix::<N>::from_diagonal(descending)), (descending, Rotation::IDENTITY));
    assert_eq!(symmetric_eigen(&Matrix::<N>::ZERO), (Vector::ZERO, Rotation::IDENTITY));
    // Ties keep the order of the axes.
    assert_eq!(symmetric_eigen(&Matrix::<N>::IDENTITY), (Vector::splat(1.0), Rotation::IDENTITY));
    let ascending = Vector::from_fn(|i| 0.1 * (i + 1) as f64);
    let (values, frame) = symmetric_eigen(&Matrix::<N>::from_diagonal(ascending));
    for j in 0..N {
        assert_eq!(values[j], ascending[N - 1 - j]);
        assert_eq!(frame.matrix().column(j).abs(), Vector::unit(N - 1 - j));
    }
}

fn any_scale<const N: usize>() {
    let mut random = Random::new(8);
    let m = random.matrix::<N>();
    let m = m + m.transpose();
    let (values, frame) = symmetric_eigen(&m);
    for exponent in [-900, -300, 300, 900] {
        // A power of two changes no rounding, so the result scales to the bit.
        let factor = 2f64.powi(exponent);
        let (scaled_values, scaled_frame) = symmetric_eigen(&(m * factor));
        assert_eq!(scaled_values, values * factor);
        assert_eq!(scaled_frame, frame);
    }
    let mut bad = m;
    bad[0][1] = f64::NAN;
    let (values, frame) = symmetric_eigen(&bad);
    assert!(values.iter().all(f64::is_nan) && frame == Rotation::IDENTITY);
}

/// The second difference matrix has eigenvalues 2 − 2 cos(kπ/(n+1)).
#[test]
fn second_differences_have_their_closed_form_eigenvalues() {
    let m = Matrix::<6>::from_fn(|i, j| [2.0, -1.0, 0.0, 0.0, 0.0, 0.0][i.abs_diff(j)]);
    let (values, _) = symmetric_eigen(&m);
    for k in 1..=6 {
        let expected = 2.0 - 2.0 * (k as f64 * std::f64::consts::PI / 7.0).cos();
        assert_within((values[6 - k] - expected).abs(), 4e-15, "eigenvalue");
    }
}

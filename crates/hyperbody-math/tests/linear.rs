//! Vectors and matrices: products, determinants, solving, normalising, completing a basis.

mod common;

use common::{Random, assert_within};
use hyperbody_math::{Matrix, Vector};

mod every_dimension {
    crate::common::in_every_dimension!(products determinants solving singular_matrices normalizing completing_a_basis
        not_a_number_is_not_hidden);
}

fn products<const N: usize>() {
    let mut random = Random::new(70);
    for _ in 0..20 {
        let (a, b, v, w) = (random.matrix::<N>(), random.matrix(), random.vector(), random.vector());
        assert_within(((a * b) * v - a * (b * v)).max_abs(), 4e-15, "associativity");
        assert_within((a.transpose_mul(v) - a.transpose() * v).max_abs(), 1e-15, "transpose_mul");
        assert_within((w.dot(a * v) - a.transpose_mul(w).dot(v)).abs(), 4e-15, "adjoint");
        assert_within((Matrix::outer(v, w) * w - v * w.norm_sq()).max_abs(), 4e-15, "outer product");
        assert_within(((a * b).trace() - (b * a).trace()).abs(), 1e-14, "trace");
        for i in 0..N {
            assert_eq!(a * Vector::unit(i), a.column(i));
            assert_eq!(a.transpose_mul(Vector::unit(i)), a.row(i));
        }
        assert_eq!(Matrix::from_columns(std::array::from_fn(|j| a.column(j))), a);
        assert_eq!(a * Matrix::IDENTITY, a);
        assert_eq!(Matrix::from_diagonal(v).diagonal(), v);
    }
}

/// Π over i < j of (x_j − x_i).
fn vandermonde<const N: usize>(x: &Vector<N>) -> f64 {
    (0..N).flat_map(|j| (0..j).map(move |i| (i, j))).fold(1.0, |product, (i, j)| product * (x[j] - x[i]))
}

fn determinants<const N: usize>() {
    let mut random = Random::new(71);
    let points = Vector::<N>::from_fn(|i| [2.0, -1.0, 3.0, 0.5, -2.0, 1.0][i]);
    let m = Matrix::<N>::from_fn(|i, j| points[i].powi(j as i32));
    let expected = vandermonde(&points);
    assert_within((m.determinant() / expected - 1.0).abs(), 1e-14, "Vandermonde");
    for _ in 0..50 {
        let (a, b) = (random.matrix::<N>(), random.matrix::<N>());
        assert_within(((a * b).determinant() - a.determinant() * b.determinant()).abs(), 1e-13, "det AB");
        assert_within((a.transpose().determinant() - a.determinant()).abs(), 1e-14, "transpose");
        let rotation = random.rotation::<N>();
        assert_within((rotation.matrix().determinant() - 1.0).abs(), 1e-14, "rotation");
        let mut swapped = a;
        swapped.0.swap(0, N - 1);
        assert_within((swapped.determinant() + a.determinant()).abs(), 1e-14, "two rows swapped");
    }
}

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64).round()
}

/// The Hilbert matrix 1/(i+j+1), condition 1.5e7 in six dimensions, has an inverse of integers
/// (−1)^(i+j) (i+j+1) C(n+i, n−j−1) C(n+j, n−i−1) C(i+j, i)².
fn solving<const N: usize>() {
    let hilbert = Matrix::<N>::from_fn(|i, j| 1.0 / (i + j + 1) as f64);
    let inverse = hilbert.try_inverse().expect("regular");
    for i in 0..N {
        for j in 0..N {
            let sign = if (i + j).is_multiple_of(2) { 1.0 } else { -1.0 };
            let size = binomial(N + i, N - j - 1) * binomial(N + j, N - i - 1) * binomial(i + j, i).powi(2);
            let expected = sign * (i + j + 1) as f64 * size;
            assert_within((inverse[i][j] / expected - 1.0).abs(), 1e-9, "inverse of the Hilbert matrix");
        }
    }
    let mut random = Random::new(72);
    for _ in 0..100 {
        let (m, x) = (random.matrix::<N>(), random.vector::<N>());
        let b = m * x;
        let found = m.solve(b).expect("regular");
        // Backward stable: the residual is small whatever the condition.
        assert_within((m * found - b).max_abs(), 4e-15 * (1.0 + found.max_abs()), "residual");
    }
    // A zero in the first pivot needs a swap.
    let swap = Matrix::<N>::from_fn(|i, j| if i + j == N - 1 { (i + 1) as f64 } else { 0.0 });
    let b = Vector::from_fn(|i| (i + 1) as f64);
    assert_eq!(swap.solve(b), Some(Vector::splat(1.0)));
}

fn singular_matrices<const N: usize>() {
    let v = Vector::<N>::from_fn(|i| (i + 1) as f64);
    for singular in [Matrix::ZERO, Matrix::outer(v, v), Matrix::from_diagonal(v - Vector::splat(1.0))] {
        assert_eq!(singular.determinant(), 0.0);
        assert_eq!(singular.solve(v), None);
        assert_eq!(singular.try_inverse(), None);
    }
    let tiny = Matrix::<N>::IDENTITY * 1e-320;
    assert_eq!(tiny.solve(v), None, "a result that overflows is none");
}

fn normalizing<const N: usize>() {
    let mut random = Random::new(73);
    for scale in [1e-320, 1e-300, 1e-160, 1.0, 1e160, 1e300, 1e307] {
        let v = random.vector::<N>() * scale;
        let unit = v.try_normalize().expect("has a direction");
        assert_within((unit.norm() - 1.0).abs(), 4e-16, "unit length");
        // Subnormal numbers keep few digits themselves.
        assert_within((unit * v.max_abs() - v * unit.max_abs()).max_abs(), 1e-15 * v.max_abs(), "direction");
    }
    for none in [Vector::ZERO, Vector::unit(1) * f64::INFINITY, Vector::splat(f64::NAN)] {
        assert_eq!(Vector::<N>::try_normalize(none), None);
        assert_eq!(none.normalize_or_zero(), Vector::ZERO);
    }
}

fn check_completion<const N: usize>(unit: Vector<N>) {
    let complement = unit.orthonormal_complement();
    assert_eq!(complement[N - 1], Vector::ZERO);
    let mut basis = complement;
    basis[N - 1] = unit;
    let m = Matrix::from_columns(basis);
    assert_within((m.transpose() * m - Matrix::IDENTITY).max_abs(), 1e-15, "orthonormal basis");
}

fn completing_a_basis<const N: usize>() {
    let mut random = Random::new(74);
    for _ in 0..200 {
        check_completion(random.vector::<N>().try_normalize().expect("not zero"));
    }
    for i in 0..N {
        for sign in [1.0, -1.0] {
            check_completion(Vector::<N>::unit(i) * sign);
            for j in (0..N).filter(|&j| j != i) {
                for small in [1e-300, 1e-20, 1e-16, 1e-8, 1.0] {
                    let near = Vector::<N>::unit(i) * sign + Vector::unit(j) * small;
                    check_completion(near.try_normalize().expect("not zero"));
                }
            }
        }
    }
}

fn not_a_number_is_not_hidden<const N: usize>() {
    for i in 0..N {
        let mut m = Matrix::<N>::IDENTITY;
        m[i][0] = f64::NAN;
        assert!(m.max_abs().is_nan() && !m.is_finite());
        assert!(m.column(0).max_abs().is_nan() && !m.column(0).is_finite());
    }
}

//! Invariant planes of bivectors and rotations: random, simple, double, isoclinic, nearly so, and at every angle where a
//! formula could break.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::common::{Random, assert_within};
use hyperbody_math::{Bivector, InvariantPlanes, Matrix, Rotation, symmetric_eigen};

mod every_dimension {
    crate::common::in_every_dimension!(random_bivectors chosen_bivectors chosen_rotations extremes);
}

fn check_form<const N: usize>(planes: &InvariantPlanes<N>) {
    let frame = planes.frame().matrix();
    assert_within((frame.transpose() * *frame - Matrix::IDENTITY).max_abs(), 2e-15, "orthonormal frame");
    assert_within((frame.determinant() - 1.0).abs(), 1e-14, "determinant");
    let values = planes.values();
    assert_eq!(values.len(), N / 2);
    for k in 1..values.len() {
        assert!(values[k - 1] >= values[k].abs(), "descending: {values:?}");
    }
    assert!(N == 2 || values[0] >= 0.0);
    assert!(N.is_multiple_of(2) || values[values.len() - 1] >= 0.0);
    for k in 0..values.len() {
        assert_within((planes.plane(k).norm() - 1.0).abs(), 2e-15, "unit plane");
    }
}

/// Facts about the values that need no planes: Σ θ² is the norm squared, and θ² are the eigenvalues of −B².
fn random_bivectors<const N: usize>() {
    let mut random = Random::new(40);
    for _ in 0..200 {
        let b = random.bivector::<N>();
        let planes = b.invariant_planes();
        check_form(&planes);
        assert_within((planes.to_bivector() - b).norm(), 4e-15, "sum of the planes");
        let squares: f64 = planes.values().iter().map(|v| v * v).sum();
        assert_within((squares - b.norm_sq()).abs(), 1e-14, "norm");
        let (eigenvalues, _) = symmetric_eigen(&-(b.to_matrix() * b.to_matrix()));
        for (k, value) in planes.values().iter().enumerate() {
            assert_within((eigenvalues[2 * k] - value * value).abs(), 1e-14, "eigenvalue of −B²");
        }
    }
}

/// In 4D the values are the sum and difference of the lengths of the two parts P±B (here from their closed form), and
/// their product is the Pfaffian.
#[test]
fn closed_forms_in_4d() {
    let mut random = Random::new(41);
    for _ in 0..200 {
        let b = random.bivector::<4>();
        let planes = b.invariant_planes();
        let length = |sign: f64| {
            let pair = |i, j, k, l, s: f64| b.get(i, j) + sign * s * b.get(k, l);
            let (x, y, z) = (pair(0, 1, 2, 3, 1.0), pair(0, 2, 1, 3, -1.0), pair(0, 3, 1, 2, 1.0));
            0.5 * (x * x + y * y + z * z).sqrt()
        };
        let (plus, minus) = (length(1.0), length(-1.0));
        assert_within((planes.values()[0] - (plus + minus)).abs(), 2e-15, "larger value");
        assert_within((planes.values()[1] - (plus - minus)).abs(), 2e-15, "smaller value, with its sign");
        let pfaffian = b.get(0, 1) * b.get(2, 3) - b.get(0, 2) * b.get(1, 3) + b.get(0, 3) * b.get(1, 2);
        assert_within((planes.values()[0] * planes.values()[1] - pfaffian).abs(), 4e-15, "Pfaffian");
    }
}

/// Every choice of N/2 values.
fn choices<const N: usize>(values: &[f64]) -> impl Iterator<Item = Vec<f64>> {
    (0..values.len().pow((N / 2) as u32))
        .map(|code| (0..N / 2).map(|k| values[code / values.len().pow(k as u32) % values.len()]).collect())
}

fn descending(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

fn chosen_bivectors<const N: usize>() {
    let mut random = Random::new(42);
    for values in choices::<N>(&[0.0, 1e-20, 1e-16, 1e-12, 1e-8, 1e-4, 1.0, 1.0 + 1e-15, 1.0 + 1e-12, 1.0 + 1e-8, 1.1])
    {
        let aligned = values
            .iter()
            .enumerate()
            .fold(Bivector::<N>::ZERO, |sum, (k, &value)| sum + Bivector::plane(2 * k, 2 * k + 1, value));
        let expected = descending(values);
        let found = aligned.invariant_planes();
        check_form(&found);
        assert_eq!(found.to_bivector(), aligned, "coordinate planes are exact");

        let b = random.rotation::<N>().rotate_bivector(&aligned);
        let found = b.invariant_planes();
        check_form(&found);
        assert_within((found.to_bivector() - b).norm(), 1e-15 * (1.0 + 4.0 * b.norm()), "sum of the planes");
        for (value, expected) in found.values().iter().zip(&expected) {
            assert_within((value.abs() - expected).abs(), 4e-15, "value");
        }
    }
}

fn chosen_rotations<const N: usize>() {
    let mut random = Random::new(43);
    let angles = [
        0.0,
        1e-12,
        1e-8,
        1e-4,
        0.795,
        FRAC_PI_2 - 1e-9,
        FRAC_PI_2,
        FRAC_PI_2 + 1e-12,
        2.35,
        PI - 1e-4,
        PI - 1e-8,
        PI - 1e-15,
        PI,
    ];
    for chosen in choices::<N>(&angles) {
        let aligned = chosen
            .iter()
            .enumerate()
            .fold(Rotation::<N>::IDENTITY, |turn, (k, &angle)| turn * Rotation::in_plane(2 * k, 2 * k + 1, angle));
        let frame = random.rotation::<N>();
        let expected = descending(chosen);
        for rotation in [aligned, frame * aligned * frame.inverse()] {
            let found = rotation.invariant_planes();
            check_form(&found);
            let rebuilt = found.to_rotation();
            assert_within((*rebuilt.matrix() - *rotation.matrix()).max_abs(), 5e-15, "rebuilt rotation");
            for (value, expected) in found.values().iter().zip(&expected) {
                assert_within((value.abs() - expected).abs(), 8e-15, "angle");
            }
        }
    }
}

fn extremes<const N: usize>() {
    let mut random = Random::new(44);
    let b = random.bivector::<N>();
    let planes = b.invariant_planes();
    for exponent in [-1000, -500, 500, 1000] {
        let factor = 2f64.powi(exponent);
        let scaled = (b * factor).invariant_planes();
        assert_within((*scaled.frame().matrix() - *planes.frame().matrix()).max_abs(), 1e-13, "frame of any scale");
        for (value, expected) in scaled.values().iter().zip(planes.values()) {
            assert_within((value / factor - expected).abs(), 1e-14, "value of any scale");
        }
    }
    let zero = Bivector::<N>::ZERO.invariant_planes();
    assert_eq!((*zero.frame(), zero.to_bivector()), (Rotation::IDENTITY, Bivector::ZERO));
    assert_eq!(Rotation::<N>::IDENTITY.invariant_planes().to_bivector(), Bivector::ZERO);
    for bad in [f64::NAN, f64::INFINITY] {
        let mut b = b;
        b.set(0, 1, bad);
        assert!(b.invariant_planes().values().iter().all(|value| value.is_nan()));
    }
}

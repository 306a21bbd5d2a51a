//! Validity and repair: what is off must be found, and what is repaired must be right again, and nearest.

use crate::common::dense::Dense;
use crate::common::{Random, assert_within};
use hyperbody_math::{Dim, EvenAlgebra, Matrix, Rotation, Rotor, RotorErrorKind, Vector};

mod every_dimension {
    crate::common::in_every_dimension!(nearest_rotation_is_found nearest_rotation_is_nearest
        ambiguous_matrices_are_refused defects_are_found_and_repaired far_multivectors_are_repaired
        drift_is_repaired bad_coefficients_are_refused);
}

/// M = Q S with S symmetric positive: the nearest rotation is Q by construction. With one negative direction in S, and
/// that the weakest, it still is.
fn nearest_rotation_is_found<const N: usize>() {
    let mut random = Random::new(30);
    for case in 0..300 {
        let q = random.rotation::<N>();
        let axes = *random.rotation::<N>().matrix();
        let exponent = f64::from(case % 7);
        let stretches = Vector::from_fn(|i| match (i, case % 3) {
            (0, 0) => -0.3 * 10f64.powf(-exponent),
            (0, 1) => 0.0,
            _ => 10f64.powf(-exponent * (i as f64 / N as f64)) * (2.0 + random.signed()),
        });
        // The negative direction has to be the weakest.
        let s = axes * Matrix::from_diagonal(stretches) * axes.transpose();
        let m = *q.matrix() * s;
        let found = Rotation::nearest(&m).expect("one nearest");
        assert_within((*found.matrix() - *q.matrix()).max_abs(), 1e-14 * 10f64.powf(exponent), "polar factor");
        let unit = found.matrix().transpose() * *found.matrix() - Matrix::IDENTITY;
        assert_within(unit.max_abs(), 1e-15, "orthogonality");
        assert_within((found.matrix().determinant() - 1.0).abs(), 1e-14, "determinant");
        // Of any scale.
        let scaled = Rotation::nearest(&(m * 2f64.powi(-600))).expect("one nearest");
        assert_within((*scaled.matrix() - *found.matrix()).max_abs(), 1e-14 * 10f64.powf(exponent), "scale");
        // A rotation is its own nearest.
        let same = Rotation::nearest(q.matrix()).expect("one nearest");
        assert_within((*same.matrix() - *q.matrix()).max_abs(), 2e-15, "fixed point");
    }
}

/// No other rotation has a smaller sum of squared differences, for matrices of either determinant.
fn nearest_rotation_is_nearest<const N: usize>() {
    let mut random = Random::new(31);
    for _ in 0..100 {
        let m = random.matrix::<N>();
        let nearest = Rotation::nearest(&m).expect("one nearest");
        let distance = |r: &Rotation<N>| {
            let difference = *r.matrix() - m;
            (difference.transpose() * difference).trace()
        };
        let least = distance(&nearest);
        for _ in 0..20 {
            let other = random.rotation::<N>();
            assert!(distance(&other) >= least);
            let near = Rotation::exp(&(random.bivector() * 1e-3)) * nearest;
            assert!(distance(&near) >= least);
        }
    }
}

fn ambiguous_matrices_are_refused<const N: usize>() {
    let mut random = Random::new(32);
    let q = *random.rotation::<N>().matrix();
    let diagonal = |f: fn(usize) -> f64| q * Matrix::from_diagonal(Vector::from_fn(f));
    assert_eq!(Rotation::nearest(&Matrix::<N>::ZERO), None);
    assert_eq!(Rotation::nearest(&diagonal(|i| if i == 1 { -1.0 } else { 1.0 })), None, "a reflection");
    assert_eq!(Rotation::nearest(&diagonal(|i| if i < 2 { 0.0 } else { 1.0 })), None, "two directions flattened");
    assert_eq!(Rotation::nearest(&diagonal(|i| if i == 1 { f64::NAN } else { 1.0 })), None);
    assert_eq!(Rotation::nearest(&diagonal(|i| if i == 1 { f64::INFINITY } else { 1.0 })), None);
    assert_eq!(Rotation::<N>::from_matrix(diagonal(|i| if i == 1 { -1.0 } else { 1.0 })), None);
    assert_eq!(Rotation::<N>::from_matrix(diagonal(|_| 1.00001)), None);
    assert_eq!(Rotation::<N>::from_matrix(diagonal(|_| f64::NAN)), None);
}

/// The defect by its definition, from the dense product.
fn dense_defect<const N: usize>(coefficients: &[f64]) -> f64 {
    let r = Dense::<N>::even(coefficients);
    let mut worst = (&(&r * &r.reverse()) - &Dense::scalar(1.0)).max_abs();
    for axis in 0..N {
        let turned = &(&r * &Dense::vector(Vector::unit(axis))) * &r.reverse();
        worst = worst.max((&turned - &turned.grade(1)).max_abs());
    }
    worst
}

fn perturbed<const N: usize>(rotor: &Rotor<N>, size: f64, random: &mut Random) -> Vec<f64>
where
    Dim<N>: EvenAlgebra,
{
    rotor.coefficients().iter().map(|c| c + size * random.signed()).collect()
}

fn defects_are_found_and_repaired<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(33);
    for _ in 0..60 {
        let rotor = random.rotor::<N>();
        assert_within((rotor.defect() - dense_defect::<N>(rotor.coefficients())).abs(), 1e-15, "defect of a rotor");
        let off = perturbed(&rotor, 3e-8, &mut random);
        assert!(dense_defect::<N>(&off) > 1e-10, "the perturbation breaks the conditions");
        let repaired = Rotor::<N>::from_coefficients(&off).expect("within the tolerance");
        assert_within(dense_defect::<N>(repaired.coefficients()), 4e-15, "repaired");
        let moved =
            repaired.coefficients().iter().zip(rotor.coefficients()).fold(0.0, |m, (a, b)| f64::max(m, (a - b).abs()));
        assert_within(moved, 2e-7, "repair moves no further than the error");
    }
}

fn far_multivectors_are_repaired<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(34);
    for _ in 0..60 {
        let rotor = random.rotor::<N>();
        let off: Vec<f64> = perturbed(&rotor, 0.1, &mut random).iter().map(|c| c * 1e-190).collect();
        let repaired = Rotor::<N>::nearest(&off).expect("one nearest");
        assert_within(dense_defect::<N>(repaired.coefficients()), 4e-15, "repaired");
        assert!(repaired.dot(&rotor) > 0.7, "still near the rotor it came from");
    }
}

fn drift_is_repaired<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(35);
    let step = random.rotor::<N>();
    let mut drifting = Rotor::IDENTITY;
    for _ in 0..20_000 {
        drifting = step * drifting;
    }
    let defect = drifting.defect();
    assert!(defect > 1e-14 && defect < 1e-9, "rounding has accumulated: {defect:e}");
    assert_within(dense_defect::<N>(drifting.repair().coefficients()), 4e-15, "repaired");
    assert_within(1.0 - drifting.repair().dot(&drifting), 1e-9, "repaired in place");
}

/// In 4D dividing by the length repairs one condition of the two; the repair has to meet both, from any distance.
#[test]
fn both_conditions_hold_in_4d() {
    let mut random = Random::new(36);
    for size in [1e-12, 1e-8, 1e-3, 0.3, 2.0] {
        for _ in 0..50 {
            let off = perturbed(&random.rotor::<4>(), size, &mut random);
            let length = Dense::<4>::even(&off).0.iter().map(|c| c * c).sum::<f64>().sqrt();
            let divided: Vec<f64> = off.iter().map(|c| c / length).collect();
            let square = |c: &[f64]| &Dense::<4>::even(c) * &Dense::even(c).reverse();
            let pseudoscalar = |c: &[f64]| square(c).0[0b1111].abs();
            if size > 1e-6 {
                assert!(pseudoscalar(&divided) > 1e-3 * size.min(0.1) * size.min(0.1), "division leaves the second");
            }
            let repaired = Rotor::<4>::nearest(&off).expect("one nearest");
            assert_within((square(repaired.coefficients()).0[0] - 1.0).abs(), 1e-15, "scalar part");
            assert_within(pseudoscalar(repaired.coefficients()), 1e-15, "pseudoscalar part");
        }
    }
    // One quaternion is zero: nothing to normalise.
    let degenerate = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let error = Rotor::<4>::nearest(&degenerate).expect_err("no direction");
    assert_eq!(error.kind(), RotorErrorKind::NotAVersor);
}

/// cos φ + sin φ e123456 has R R~ = 1 and is no rotor; a phase on top of a rotor has to go.
#[test]
fn six_dimensions_have_one_condition_more() {
    let mut phase = vec![0.0; 32];
    (phase[0], phase[31]) = (0.3f64.cos(), 0.3f64.sin());
    let p = Dense::<6>::even(&phase);
    assert_within((&(&p * &p.reverse()) - &Dense::scalar(1.0)).max_abs(), 1e-15, "R R~ = 1");
    assert!(Rotor::<6>::from_coefficients(&phase).is_err());
    let repaired = Rotor::<6>::nearest(&phase).expect("one nearest");
    assert_within((repaired.dot(&Rotor::IDENTITY) - 1.0).abs(), 1e-15, "the phase is gone");
}

fn bad_coefficients_are_refused<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let good = Random::new(37).rotor::<N>();
    let kind = |c: &[f64]| Rotor::<N>::from_coefficients(c).expect_err("bad coefficients").kind();
    assert_eq!(kind(&[]), RotorErrorKind::WrongCount);
    assert_eq!(kind(&[good.coefficients(), &[0.0]].concat()), RotorErrorKind::WrongCount);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut c = good.coefficients().to_vec();
        c[1] = bad;
        assert_eq!(kind(&c), RotorErrorKind::NotFinite);
        assert!(Rotor::<N>::nearest(&c).is_err());
    }
    let scaled = |factor: f64| -> Vec<f64> { good.coefficients().iter().map(|c| c * factor).collect() };
    for factor in [0.0, 0.99, 1.01, 1e200, f64::MAX] {
        assert_eq!(kind(&scaled(factor)), RotorErrorKind::NotAVersor);
    }
    assert!(Rotor::<N>::nearest(&scaled(0.0)).is_err());
    let message = Rotor::<N>::from_coefficients(&scaled(1.5)).expect_err("too long").to_string();
    assert!(message.contains("1.5") && message.contains("1e-6"), "the message has the value and the limit: {message}");
    let loaded = Rotor::<N>::from_coefficients(good.coefficients()).expect("good");
    assert_within(1.0 - loaded.dot(&good), 1e-15, "good coefficients survive");
}

//! Rotation matrices and poses: what can be checked without rotors.

mod common;

use common::{Random, assert_within};
use hyperbody_math::{Matrix, Pose, Rotation, Vector, planes};

mod every_dimension {
    crate::common::in_every_dimension!(turns_in_a_plane group_laws matrices_are_checked drift_is_removed poses);
}

fn turns_in_a_plane<const N: usize>() {
    let angle = 0.9f64;
    for i in 0..N {
        for j in (0..N).filter(|&j| j != i) {
            let turn = Rotation::<N>::in_plane(i, j, angle);
            for k in 0..N {
                let expected = if k == i {
                    Vector::unit(i) * angle.cos() + Vector::unit(j) * angle.sin()
                } else if k == j {
                    Vector::unit(j) * angle.cos() - Vector::unit(i) * angle.sin()
                } else {
                    Vector::unit(k)
                };
                assert_within((turn.rotate(Vector::unit(k)) - expected).max_abs(), 2e-16, "turned axis");
            }
            assert_eq!(turn.inverse(), Rotation::in_plane(i, j, -angle));
            assert_eq!(turn.inverse(), Rotation::in_plane(j, i, angle));
        }
    }
}

fn group_laws<const N: usize>() {
    let mut random = Random::new(80);
    let distance = |a: Rotation<N>, b: Rotation<N>| (*a.matrix() - *b.matrix()).max_abs();
    for _ in 0..50 {
        let [a, b, c] = [(); 3].map(|()| random.rotation::<N>());
        let (v, w) = (random.vector::<N>(), random.vector::<N>());
        assert_within(distance((a * b) * c, a * (b * c)), 4e-15, "associativity");
        assert_within(distance(a * a.inverse(), Rotation::IDENTITY), 4e-15, "inverse");
        assert_within(distance((a * b).inverse(), b.inverse() * a.inverse()), 4e-15, "inverse of a product");
        assert_within(((a * b).rotate(v) - a.rotate(b.rotate(v))).max_abs(), 4e-15, "b first, then a");
        assert_within((a.inverse_rotate(a.rotate(v)) - v).max_abs(), 4e-15, "and back");
        assert_within((a.rotate(v).dot(a.rotate(w)) - v.dot(w)).abs(), 1e-14, "inner products stay");
        assert_within((a.matrix().determinant() - 1.0).abs(), 1e-14, "determinant");
    }
}

fn matrices_are_checked<const N: usize>() {
    let mut random = Random::new(81);
    for _ in 0..50 {
        let rotation = random.rotation::<N>();
        let worn = *rotation.matrix() + random.matrix() * 1e-7;
        let cleaned = Rotation::from_matrix(worn).expect("seven digits are enough");
        let defect = cleaned.matrix().transpose() * *cleaned.matrix() - Matrix::IDENTITY;
        assert_within(defect.max_abs(), 1e-15, "cleaned");
        assert_within((*cleaned.matrix() - worn).max_abs(), 4e-7, "stays near");
        let nearest = Rotation::nearest(&worn).expect("one nearest");
        assert_within((*cleaned.matrix() - *nearest.matrix()).max_abs(), 4e-15, "two ways to the nearest");
        assert_eq!(Rotation::from_matrix(*rotation.matrix() + random.matrix() * 1e-4), None);
        let mut mirrored = *rotation.matrix();
        mirrored.0.swap(0, 1);
        assert_eq!(Rotation::from_matrix(mirrored), None, "a reflection is no rotation");
    }
}

/// A hundred thousand products without care, and with one cheap step each.
fn drift_is_removed<const N: usize>() {
    let step = planes::all(N).fold(Rotation::IDENTITY, |r, (i, j)| r * Rotation::<N>::in_plane(i, j, 0.1));
    let (mut plain, mut kept) = (Rotation::IDENTITY, Rotation::IDENTITY);
    for _ in 0..100_000 {
        plain = plain * step;
        kept = kept * step;
        kept.reorthonormalize();
    }
    let defect = |r: &Rotation<N>| (r.matrix().transpose() * *r.matrix() - Matrix::IDENTITY).max_abs();
    assert_within(defect(&kept), 2e-15, "kept orthogonal");
    assert!(defect(&plain) > 1e-13, "there was something to remove");
    plain.reorthonormalize();
    assert_within(defect(&plain), 2e-15, "one step removes it");
}

fn poses<const N: usize>() {
    let mut random = Random::new(82);
    for _ in 0..50 {
        let [a, b] = [(); 2].map(|()| Pose::new(random.rotation::<N>(), random.vector()));
        let p = random.vector::<N>();
        let near = |x: Vector<N>, y: Vector<N>, what: &str| assert_within((x - y).max_abs(), 1e-14, what);
        near(a.inverse_transform_point(a.transform_point(p)), p, "and back");
        near(a.inverse().transform_point(p), a.inverse_transform_point(p), "inverse");
        near((a * b).transform_point(p), a.transform_point(b.transform_point(p)), "b first, then a");
        near(a.relative(&b).transform_point(p), (a.inverse() * b).transform_point(p), "relative");
        near(a.transform_point(Vector::ZERO), a.translation, "origin");
        near(Pose::IDENTITY.transform_point(p), p, "identity");
    }
}

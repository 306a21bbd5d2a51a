//! Rotors against the dense multivector oracle and against matrices.

use crate::common::dense::Dense;
use crate::common::{Random, assert_within};
use hyperbody_math::{Bivector, Dim, EvenAlgebra, Rotation, Rotor, Vector, planes};

fn dense<const N: usize>(rotor: &Rotor<N>) -> Dense<N>
where
    Dim<N>: EvenAlgebra,
{
    Dense::even(rotor.coefficients())
}

mod every_dimension {
    crate::common::in_every_dimension!(layout_is_exact convention algebra_matches_the_oracle sandwiches_match_the_oracle
        group_laws turns_in_one_plane matrices_and_rotors_agree half_turns_convert);
}

fn layout_is_exact<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    assert_eq!(Rotor::<N>::COUNT, 1 << (N - 1));
    assert_eq!(size_of::<Rotor<N>>(), 8 << (N - 1));
    let names: Vec<String> = Rotor::<N>::coefficient_names().collect();
    assert_eq!(names.len(), Rotor::<N>::COUNT);
    for (p, (i, j)) in planes::all(N).enumerate() {
        assert_eq!(names[1 + p], planes::name(i, j));
    }
    // The oracle reads the names: each must be the blade of its slot.
    for (slot, name) in names.iter().enumerate().skip(1) {
        let mut coefficients = vec![0.0; names.len()];
        coefficients[slot] = 1.0;
        let blade: Dense<N> = name.chars().fold(Dense::scalar(1.0), |product, letter| {
            let axis = planes::axis_from_name(N, letter).expect("an axis");
            &product * &Dense::vector(Vector::unit(axis))
        });
        assert_eq!(Dense::even(&coefficients), blade, "coefficient {name}");
    }
}

#[test]
fn a_4d_rotor_is_eight_numbers_in_the_published_order() {
    let names: Vec<String> = Rotor::<4>::coefficient_names().collect();
    assert_eq!(names, ["1", "xy", "xz", "xw", "yz", "yw", "zw", "xyzw"]);
    // Half turns in xy and zw: (−e_xy)(−e_zw) = e_xyzw.
    let half = std::f64::consts::PI;
    let both: [f64; 8] = (Rotor::<4>::in_plane(0, 1, half) * Rotor::in_plane(2, 3, half)).to_array();
    assert_within((both[7] - 1.0).abs(), 1e-15, "pseudoscalar");
}

/// R = cos(θ/2) − sin(θ/2) e_i e_j takes axis i towards axis j.
fn convention<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let angle = 0.7f64;
    for i in 0..N {
        for j in (0..N).filter(|&j| j != i) {
            let rotor = Rotor::<N>::in_plane(i, j, angle);
            let ij = &Dense::<N>::vector(Vector::unit(i)) * &Dense::vector(Vector::unit(j));
            let formula = &Dense::scalar((angle / 2.0).cos()) - &(&ij * (angle / 2.0).sin());
            assert_within((&dense(&rotor) - &formula).max_abs(), 1e-16, "cos − sin e_i e_j");
            let turned = rotor.rotate(Vector::unit(i));
            let expected = Vector::unit(i) * angle.cos() + Vector::unit(j) * angle.sin();
            assert_within((turned - expected).max_abs(), 4e-16, "i towards j");
        }
    }
}

fn algebra_matches_the_oracle<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(20);
    for _ in 0..40 {
        let (a, b) = (random.rotor::<N>(), random.rotor::<N>());
        let product = &dense(&a) * &dense(&b);
        assert_within((&dense(&(a * b)) - &product).max_abs(), 2e-15, "product");
        assert_eq!(dense(&a.reverse()), dense(&a).reverse(), "reverse");
        assert_within((a.dot(&b) - (&dense(&a) * &dense(&b).reverse()).0[0]).abs(), 2e-15, "dot");
        assert_eq!(Dense::bivector(&a.bivector_part()), dense(&a).grade(2), "bivector part");
        assert_eq!(a.scalar_part(), dense(&a).0[0], "scalar part");
        assert_within(a.defect(), 1e-14, "defect of a product of turns");
    }
}

fn sandwiches_match_the_oracle<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(21);
    for _ in 0..40 {
        let rotor = random.rotor::<N>();
        let (v, b) = (random.vector::<N>(), random.bivector::<N>());
        let (r, reverse) = (dense(&rotor), dense(&rotor).reverse());
        let turned = &(&r * &Dense::vector(v)) * &reverse;
        assert_within((&turned - &turned.grade(1)).max_abs(), 1e-14, "a turned vector is a vector");
        assert_within((rotor.rotate(v) - turned.to_vector()).max_abs(), 4e-15, "vector");
        assert_within((rotor.inverse_rotate(rotor.rotate(v)) - v).max_abs(), 1e-14, "vector and back");
        let turned = &(&r * &Dense::bivector(&b)) * &reverse;
        assert_within((&turned - &turned.grade(2)).max_abs(), 1e-14, "a turned bivector is a bivector");
        assert_within((rotor.rotate_bivector(&b) - turned.to_bivector()).norm(), 1e-14, "bivector");
        assert_within((rotor.inverse_rotate_bivector(&rotor.rotate_bivector(&b)) - b).norm(), 2e-14, "and back");
        let w = random.vector::<N>();
        let of_turned = Bivector::wedge(rotor.rotate(v), rotor.rotate(w));
        assert_within((rotor.rotate_bivector(&Bivector::wedge(v, w)) - of_turned).norm(), 2e-14, "wedge of turned");
    }
}

fn group_laws<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(22);
    let distance = |a: Rotor<N>, b: Rotor<N>| (&dense(&a) - &dense(&b)).max_abs();
    for _ in 0..60 {
        let [a, b, c] = [(); 3].map(|()| random.rotor::<N>());
        assert_within(distance((a * b) * c, a * (b * c)), 1e-14, "associativity");
        assert_within(distance(a * a.reverse(), Rotor::IDENTITY), 1e-14, "inverse");
        assert_eq!(a * Rotor::IDENTITY, a);
        assert_eq!(Rotor::IDENTITY * a, a);
        assert_within(distance((a * b).reverse(), b.reverse() * a.reverse()), 2e-15, "reverse of a product");
        let v = random.vector::<N>();
        assert_within(((a * b).rotate(v) - a.rotate(b.rotate(v))).max_abs(), 1e-14, "b first, then a");
        assert_within((a.rotate(v).norm() - v.norm()).abs(), 1e-14, "length");
        assert_eq!((-a).rotate(v), a.rotate(v), "the sign does not matter");
        assert_within((a.norm() - 1.0).abs(), 1e-14, "norm");
        assert_eq!((-a).aligned_with(&a), a);
    }
}

/// Turns in one plane add their angles, 2π gives −1 and 4π gives 1.
fn turns_in_one_plane<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let distance = |a: Rotor<N>, b: Rotor<N>| (&dense(&a) - &dense(&b)).max_abs();
    for (i, j) in planes::all(N) {
        let (a, b) = (1.9, -3.3);
        let sum = Rotor::<N>::in_plane(i, j, a) * Rotor::in_plane(i, j, b);
        assert_within(distance(sum, Rotor::in_plane(i, j, a + b)), 1e-15, "sum of angles");
        assert_eq!(Rotor::<N>::in_plane(j, i, a), Rotor::in_plane(i, j, -a));
        let tau = std::f64::consts::TAU;
        assert_within(distance(Rotor::in_plane(i, j, tau), -Rotor::IDENTITY), 1e-15, "turn by 2π");
        assert_within(distance(Rotor::in_plane(i, j, 2.0 * tau), Rotor::IDENTITY), 1e-15, "turn by 4π");
    }
}

fn matrices_and_rotors_agree<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(23);
    for _ in 0..100 {
        let (a, b) = (random.rotation::<N>(), random.rotation::<N>());
        let (ra, rb) = (Rotor::from_rotation(&a), Rotor::from_rotation(&b));
        assert!(ra.scalar_part() >= 0.0);
        assert_within(ra.defect(), 1e-14, "defect");
        assert_within((*ra.to_rotation().matrix() - *a.matrix()).max_abs(), 4e-15, "matrix → rotor → matrix");
        let product = (ra * rb).to_rotation();
        assert_within((*product.matrix() - *(a * b).matrix()).max_abs(), 1e-14, "homomorphism");
        let back = Rotor::from_rotation(&ra.to_rotation()).aligned_with(&ra);
        assert_within((&dense(&back) - &dense(&ra)).max_abs(), 4e-15, "rotor → matrix → rotor");
        let (v, bivector) = (random.vector::<N>(), random.bivector::<N>());
        assert_within((ra.rotate(v) - a.rotate(v)).max_abs(), 1e-14, "vector");
        let difference = ra.rotate_bivector(&bivector) - a.rotate_bivector(&bivector);
        assert_within(difference.norm(), 2e-14, "bivector");
    }
    for (i, j) in planes::all(N) {
        for angle in [-3.1, -1.0, 1e-9, 1e-200, 2.0] {
            let rotor = Rotor::from_rotation(&Rotation::<N>::in_plane(i, j, angle));
            let expected = Rotor::in_plane(i, j, angle);
            assert_within((&dense(&rotor) - &dense(&expected)).max_abs(), 2e-16, "turn in a coordinate plane");
            let part = rotor.bivector_part().get(i, j) / expected.bivector_part().get(i, j);
            assert_within((part - 1.0).abs(), 1e-15, "tiny turns keep their digits");
        }
    }
}

/// Turns by π, exactly and nearly, in every number of planes, seen from random frames.
fn half_turns_convert<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(24);
    for count in 1..=N / 2 {
        for offset in [0.0, 1e-300, 1e-17, 1e-12, 1e-8, -1e-8, 1e-4] {
            for aligned in [true, false] {
                let frame = if aligned { Rotation::IDENTITY } else { random.rotation::<N>() };
                let turn = (0..count).fold(Rotation::IDENTITY, |turn, k| {
                    Rotation::in_plane(2 * k, 2 * k + 1, std::f64::consts::PI - offset) * turn
                });
                let rotation = frame * turn * frame.inverse();
                let rotor = Rotor::from_rotation(&rotation);
                assert_within(rotor.defect(), 1e-14, "defect");
                let back = rotor.to_rotation();
                assert_within((*back.matrix() - *rotation.matrix()).max_abs(), 4e-15, "half turns");
            }
        }
    }
}

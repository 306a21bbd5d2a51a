//! Bivector products against the dense multivector oracle.

use crate::common::dense::Dense;
use crate::common::{Random, assert_within};
use hyperbody_math::{Bivector, Rotation, Vector};

mod every_dimension {
    crate::common::in_every_dimension!(products_match_the_oracle identities sense_of_rotation);
}

/// The oracle itself: e_i² = 1, e_i e_j = −e_j e_i, and products associate.
#[test]
fn the_oracle_is_a_clifford_algebra() {
    let mut random = Random::new(10);
    for i in 0..6 {
        for j in 0..6 {
            let (a, b) = (Dense::<6>::vector(Vector::unit(i)), Dense::vector(Vector::unit(j)));
            let anticommutator = &(&a * &b) + &(&b * &a);
            assert_eq!(anticommutator, Dense::scalar(if i == j { 2.0 } else { 0.0 }));
        }
    }
    let [a, b, c] = [(); 3].map(|()| Dense::<6>((0..64).map(|_| random.signed()).collect()));
    assert_within((&(&(&a * &b) * &c) - &(&a * &(&b * &c))).max_abs(), 1e-13, "associativity");
}

fn products_match_the_oracle<const N: usize>() {
    let mut random = Random::new(11);
    for _ in 0..50 {
        let (r, s) = (random.vector::<N>(), random.vector::<N>());
        let (a, b) = (random.bivector::<N>(), random.bivector::<N>());
        let (rd, sd, ad, bd) = (Dense::vector(r), Dense::vector(s), Dense::bivector(&a), Dense::bivector(&b));

        // Outer product: the grade that adds up.
        let wedge = (&rd * &sd).grade(2);
        assert_eq!(Dense::bivector(&Bivector::wedge(r, s)), wedge, "r ∧ s");
        // Contraction r · B: the grade that subtracts.
        let contraction = (&rd * &bd).grade(1).to_vector();
        assert_within((b.act_on(r) - contraction).max_abs(), 1e-15, "r · B");
        let commutator = &(&(&ad * &bd) - &(&bd * &ad)) * 0.5;
        assert_within((&Dense::bivector(&a.commutator(&b)) - &commutator).max_abs(), 1e-15, "½(AB − BA)");
        // ⟨A B~⟩₀ is the sum over planes of the products.
        assert_within((a.dot(&b) - (&ad * &bd.reverse()).0[0]).abs(), 1e-15, "inner product");
    }
}

fn identities<const N: usize>() {
    let mut random = Random::new(12);
    for _ in 0..50 {
        let [a, b, c] = [(); 3].map(|()| random.bivector::<N>());
        let (r, s) = (random.vector::<N>(), random.vector::<N>());
        let jacobi =
            a.commutator(&b.commutator(&c)) + b.commutator(&c.commutator(&a)) + c.commutator(&a.commutator(&b));
        assert_within(jacobi.norm(), 1e-13, "Jacobi identity");
        // Power of a torque: (r ∧ s) · B = s · (r · B).
        assert_within((Bivector::wedge(r, s).dot(&b) - s.dot(b.act_on(r))).abs(), 1e-14, "power of a torque");
        // What is fixed to a turning body: ⟨r ∧ s⟩ moves by the product rule, at the rate (r ∧ s) × B.
        let rate = Bivector::wedge(b.act_on(r), s) + Bivector::wedge(r, b.act_on(s));
        assert_within((Bivector::wedge(r, s).commutator(&b) - rate).norm(), 1e-14, "rate of a fixed bivector");
        // Turning both factors turns the product.
        let turn = random.rotation::<N>();
        let turned = Bivector::wedge(turn.rotate(r), turn.rotate(s));
        assert_within((turn.rotate_bivector(&Bivector::wedge(r, s)) - turned).norm(), 1e-14, "turned wedge");
        assert_within((turn.inverse_rotate_bivector(&turn.rotate_bivector(&b)) - b).norm(), 1e-14, "turn and back");
    }
}

/// A positive number in plane (i, j) turns axis i towards axis j, in every operation alike.
fn sense_of_rotation<const N: usize>() {
    for i in 0..N {
        for j in (0..N).filter(|&j| j != i) {
            let plane = Bivector::<N>::plane(i, j, 1.0);
            assert_eq!(plane.act_on(Vector::unit(i)), Vector::unit(j));
            assert_eq!(Bivector::wedge(Vector::unit(i), Vector::unit(j)), plane);
            let quarter = Rotation::<N>::in_plane(i, j, std::f64::consts::FRAC_PI_2);
            assert_within((quarter.rotate(Vector::unit(i)) - Vector::unit(j)).max_abs(), 1e-15, "in_plane");
            let exp = Rotation::exp(&(plane * std::f64::consts::FRAC_PI_2));
            assert_within((*exp.matrix() - *quarter.matrix()).max_abs(), 1e-15, "exp");
        }
    }
}

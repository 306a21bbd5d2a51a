//! Exponential, logarithm and interpolation of rotors and rotations.

use std::f64::consts::{PI, TAU};

use crate::common::dense::Dense;
use crate::common::{Random, assert_within};
use hyperbody_math::{Bivector, Dim, EvenAlgebra, Matrix, Rotation, Rotor, planes};

mod every_dimension {
    crate::common::in_every_dimension!(exponentials_match_the_series turns_in_one_plane huge_and_tiny_and_bad
        logarithm_undoes_exponential exponential_undoes_logarithm interpolation angles_between_rotations);
}

fn distance<const N: usize>(a: &Rotation<N>, b: &Rotation<N>) -> f64 {
    (*a.matrix() - *b.matrix()).max_abs()
}

fn rotor_distance<const N: usize>(a: &Rotor<N>, b: &Rotor<N>) -> f64
where
    Dim<N>: EvenAlgebra,
{
    (&Dense::<N>::even(a.coefficients()) - &Dense::even(b.coefficients())).max_abs()
}

/// Σ k b_k with plane k turned by a random frame.
fn double_rotation<const N: usize>(random: &mut Random, values: &[f64]) -> Bivector<N> {
    let aligned = values.iter().take(N / 2).enumerate();
    let aligned = aligned.fold(Bivector::ZERO, |sum, (k, &value)| sum + Bivector::plane(2 * k, 2 * k + 1, value));
    random.rotation::<N>().rotate_bivector(&aligned)
}

/// exp of the matrix that maps r to r · B, by its power series without any scaling.
fn matrix_series<const N: usize>(b: &Bivector<N>) -> Matrix<N> {
    let velocity = b.to_matrix().transpose();
    let mut term = Matrix::IDENTITY;
    let mut sum = Matrix::IDENTITY;
    for k in 1..60 {
        term = term * velocity * (1.0 / f64::from(k));
        sum += term;
    }
    sum
}

/// Both exponentials against power series, Rotor::exp(b) being e^(−b/2), and against each other.
fn exponentials_match_the_series<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(50);
    let mut cases: Vec<Bivector<N>> = (0..30).map(|_| random.bivector() * 2.0).collect();
    cases.push(Bivector::ZERO);
    cases.push(double_rotation(&mut random, &[1.7, 0.4, 0.1]));
    cases.push(double_rotation(&mut random, &[1.2, 1.2, 1.2]));
    cases.push(double_rotation(&mut random, &[1.2, 1.2 + 1e-9, 0.0]));
    cases.push(double_rotation(&mut random, &[PI, 1e-9, 1e-9]));
    cases.push(double_rotation(&mut random, &[PI, PI, PI]));
    for b in cases {
        let rotor = Rotor::exp(&b);
        let series = (&Dense::bivector(&b) * -0.5).exp();
        assert_within((&Dense::even(rotor.coefficients()) - &series).max_abs(), 1e-14, "e^(−b/2)");
        let rotation = Rotation::exp(&b);
        assert_within((*rotation.matrix() - matrix_series(&b)).max_abs(), 4e-14, "matrix series");
        assert_within(distance(&rotation, &rotor.to_rotation()), 1e-14, "rotor and matrix agree");
        assert_within(rotor.defect(), 4e-15, "defect");
        assert_within(rotor_distance(&Rotor::exp(&-b), &rotor.reverse()), 4e-15, "exp(−b) is the reverse");
        let halves = Rotor::exp(&(b * 0.3)) * Rotor::exp(&(b * 0.7));
        assert_within(rotor_distance(&halves, &rotor), 1e-14, "one parameter group");
    }
}

fn turns_in_one_plane<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    for (i, j) in planes::all(N) {
        for angle in [-7.0, -PI, -1e-3, 1e-9, 0.4, 3.0, TAU, 100.0, 1e4] {
            let b = Bivector::<N>::plane(i, j, angle);
            assert_within(rotor_distance(&Rotor::exp(&b), &Rotor::in_plane(i, j, angle)), 2e-16, "rotor");
            let limit = 1e-15 * f64::max(1.0, angle.abs());
            assert_within(distance(&Rotation::exp(&b), &Rotation::in_plane(i, j, angle)), limit, "rotation");
        }
    }
}

/// Any size: the angles are reduced exactly, and what comes out is a rotation whatever goes in.
fn huge_and_tiny_and_bad<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(51);
    let angles = [1e300, 3e15, 1e5];
    let turns = angles.iter().take(N / 2).enumerate();
    let b = turns.clone().fold(Bivector::<N>::ZERO, |sum, (k, &a)| sum + Bivector::plane(2 * k, 2 * k + 1, a));
    let expected = turns.clone().fold(Rotor::IDENTITY, |r, (k, &a)| r * Rotor::in_plane(2 * k, 2 * k + 1, a));
    assert_within(rotor_distance(&Rotor::exp(&b), &expected), 4e-16, "huge turns in coordinate planes");
    assert_within(distance(&Rotation::exp(&b), &expected.to_rotation()), 2e-15, "huge turns, matrix");
    for exponent in [-320, -200, -10, 3, 10, 20, 100, 300] {
        let b = random.bivector::<N>() * 10f64.powi(exponent);
        let (rotor, rotation) = (Rotor::exp(&b), Rotation::exp(&b));
        assert_within(rotor.defect(), 4e-15, "a rotor at any size");
        let unit = rotation.matrix().transpose() * *rotation.matrix() - Matrix::IDENTITY;
        assert_within(unit.max_abs(), 2e-15, "a rotation at any size");
        if exponent < 0 {
            assert_within((rotor.bivector_part() * -2.0 - b).norm(), 1e-9 * b.norm(), "tiny turns keep their digits");
            assert_within((rotor.log() - b).norm(), 1e-14 * b.norm(), "log of a tiny rotor");
            assert_within((rotation.log() - b).norm(), 1e-14 * b.norm(), "log of a tiny rotation");
        }
    }
    let bad = Bivector::<N>::plane(0, 1, f64::NAN);
    assert!(Rotor::exp(&bad).scalar_part().is_nan() && Rotation::exp(&bad).matrix()[0][0].is_nan());
}

fn logarithm_undoes_exponential<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(52);
    // The nearer two planes are to π together, the less the rotation says about which they are.
    let limit = |b: &Bivector<N>, values: [f64; 3]| {
        let to_the_cut = TAU - values[0] - if N > 3 { values[1] } else { 0.0 };
        4e-15 * (1.0 + b.norm()) / f64::min(1.0, to_the_cut)
    };
    // Angles of rotations stay below π.
    for values in [
        [0.5, 0.3, 0.1],
        [1.0, 1.0, 1.0],
        [3.1, 3.1, 0.0],
        [PI - 1e-6, 0.0, 0.0],
        [PI - 1e-4, PI - 2e-4, 1e-9],
        [2.0, 1e-12, 1e-12],
        [1e-5, 1e-9, 1e-13],
    ] {
        for _ in 0..5 {
            let b = double_rotation::<N>(&mut random, &values);
            assert_within((Rotation::exp(&b).log() - b).norm(), limit(&b, values), "log of a rotation");
            assert_within((Rotor::exp(&b).log() - b).norm(), limit(&b, values), "log of a rotor");
        }
    }
    // The two largest of rotors stay below 2π together.
    for values in [[6.0, 0.2, 0.1], [5.0, 1.2, 1.0], [3.3, 2.9, 2.0], [TAU - 1e-4, 0.0, 0.0], [4.0, 2.0, 2.0]] {
        for _ in 0..5 {
            let b = double_rotation::<N>(&mut random, &values);
            assert_within((Rotor::exp(&b).log() - b).norm(), limit(&b, values), "log of a rotor beyond π");
        }
    }
}

fn exponential_undoes_logarithm<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(53);
    let mut rotors: Vec<Rotor<N>> = (0..100).map(|_| random.rotor()).collect();
    rotors.extend([Rotor::IDENTITY, -Rotor::IDENTITY]);
    // On the cut: turns by π and 2π in some planes.
    for values in [[PI, 0.0, 0.0], [PI, PI, 0.0], [PI, PI, PI], [TAU, 1.0, 0.0], [PI, 2.0, PI], [4.0, TAU - 4.0, 0.0]] {
        rotors.push(Rotor::exp(&double_rotation(&mut random, &values)));
    }
    for rotor in rotors {
        for rotor in [rotor, -rotor] {
            let log = rotor.log();
            assert_within(rotor_distance(&Rotor::exp(&log), &rotor), 1e-14, "exp(log) with the sign");
            // Shortest: no way through a turn by 2π more or less is shorter.
            let values = log.invariant_planes();
            let values = values.values();
            assert!(values[0] + values.get(1).map_or(0.0, |v| v.abs()) <= TAU + 1e-12, "{values:?}");
        }
        let rotation = rotor.to_rotation();
        assert_within(distance(&Rotation::exp(&rotation.log()), &rotation), 1e-14, "exp(log) of a rotation");
        assert!(rotation.log().invariant_planes().values()[0].abs() <= PI + 1e-15);
    }
}

fn interpolation<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(54);
    for _ in 0..40 {
        let (a, b) = (random.rotor::<N>(), random.rotor::<N>());
        let (ra, rb) = (a.to_rotation(), b.to_rotation());
        let angle = ra.angle_to(&rb);
        assert_eq!(a.slerp(&b, 0.0), a);
        let end = a.slerp(&b, 1.0);
        assert_within(rotor_distance(&end, &b.aligned_with(&end)), 1e-14, "the end is ± the other rotor");
        assert!(end.dot(&a) >= -1e-15, "no detour through 2π");
        for t in [0.0, 0.25, 0.5, 1.0, 1.0 / 3.0] {
            let (rotor, rotation) = (a.slerp(&b, t), ra.slerp(&rb, t));
            assert_within(distance(&rotor.to_rotation(), &rotation), 2e-14, "rotor and matrix agree");
            assert_within((ra.angle_to(&rotation) - t * angle).abs(), 1e-13, "constant speed");
            let back = rb.slerp(&ra, 1.0 - t);
            assert_within(distance(&back, &rotation), 2e-14, "the same way back");
            assert_within(rotor_distance(&a.slerp(&-b, t), &rotor), 2e-14, "the sign of the end does not matter");
        }
    }
}

fn angles_between_rotations<const N: usize>() {
    let mut random = Random::new(55);
    for _ in 0..40 {
        let [a, b, c] = [(); 3].map(|()| random.rotation::<N>());
        assert_within(a.angle_to(&a), 1e-14, "no distance to itself");
        assert_within((a.angle_to(&b) - b.angle_to(&a)).abs(), 1e-14, "symmetric");
        assert!(a.angle_to(&c) <= a.angle_to(&b) + b.angle_to(&c) + 1e-14, "triangle");
        assert_within(((c * a).angle_to(&(c * b)) - a.angle_to(&b)).abs(), 2e-14, "the same from every frame");
        assert_within(((a * c).angle_to(&(b * c)) - a.angle_to(&b)).abs(), 2e-14, "the same for every body");
        let turned = a * Rotation::in_plane(0, 1, -1.25);
        assert_within((a.angle_to(&turned) - 1.25).abs(), 1e-14, "one plane: its angle");
    }
}

//! Orientation conventions and Euler's equation plane by plane.

use crate::free_top_common::Random;
use hyperbody_dynamics::free_top::{FreeTop, TopState, plane_equations};
use hyperbody_geometry::Shape;
use hyperbody_geometry::regular::{Size, polytope};
use hyperbody_math::{Bivector, Dim, EvenAlgebra, Matrix, Rotation, Vector};

fn random_case<const N: usize>(random: &mut Random) -> (FreeTop<N>, Bivector<N>) {
    let top = FreeTop::new(Vector::from_fn(|_| random.between(0.1, 4.0))).expect("positive moments");
    (top, Bivector::from_fn(|_, _| random.between(-2.0, 2.0)))
}

/// Ω = −B turns Ṙ = RΩ, M = JΩ + ΩJ, Ṁ = [M, Ω] into what this library computes.
fn check_conventions<const N: usize>() {
    let mut random = Random::new(N as u64);
    for _ in 0..20 {
        let (top, spin) = random_case::<N>(&mut random);
        let omega = -spin.to_matrix();
        let j = Matrix::from_diagonal(*top.principal_moments());
        let m = j * omega + omega * j;
        let momentum = top.momentum_from_spin(&spin);
        assert!((momentum.to_matrix() + m).max_abs() < 1e-13, "M = JΩ + ΩJ");
        let rate = top.momentum_rate(&momentum).to_matrix();
        assert!((rate + (m * omega - omega * m)).max_abs() < 1e-12, "Ṁ = [M, Ω]");
        assert!((rate - spin.commutator(&momentum).to_matrix()).max_abs() < 1e-12, "Ṁ = ω × M");
        let of_spin = top.momentum_from_spin(&top.spin_rate(&spin));
        assert!((of_spin.to_matrix() - rate).max_abs() < 1e-12, "dω/dt");

        // R after a short time h is R(1 + hΩ): what Rotation::exp of the spin does.
        let h = 1e-5;
        let turned = Rotation::exp(&(spin * h));
        let difference = (*turned.matrix() - (Matrix::IDENTITY + omega * h)).max_abs();
        assert!(difference < 200.0 * h * h, "Ṙ = RΩ: off by {difference}");
        let point = Vector::from_fn(|_| random.between(-1.0, 1.0));
        assert!((spin.act_on(point) - omega * point).norm() < 1e-13, "r·B = Ωr");
    }
}

#[test]
fn the_matrix_convention_of_the_literature_is_minus_the_bivector() {
    check_conventions::<2>();
    check_conventions::<3>();
    check_conventions::<4>();
    check_conventions::<5>();
    check_conventions::<6>();
}

fn check_plane_equations<const N: usize>() {
    let mut random = Random::new(40 + N as u64);
    let (top, spin) = random_case::<N>(&mut random);
    let rate = top.spin_rate(&spin);
    let equations = plane_equations(&top, &spin);
    for equation in &equations {
        let (i, j) = equation.plane;
        assert!((equation.rate - rate.get(i, j)).abs() < 1e-12, "{N}D: {}", equation.to_text());
        assert_eq!(equation.drives.len(), N - 2);
        // A spin in the planes that never drive it, and in itself, leaves the plane alone.
        let mut others = Bivector::plane(i, j, 1.0);
        for &(k, l) in &equation.never_driven_by {
            others.set(k, l, random.between(-2.0, 2.0));
        }
        assert_eq!(top.spin_rate(&others).get(i, j), 0.0, "{}", equation.to_text());
        for drive in &equation.drives {
            let [(a, b), (c, d)] = drive.planes;
            let pair = Bivector::plane(a, b, 2.0) + Bivector::plane(c, d, 3.0);
            let expected = 6.0 * drive.coefficient;
            assert!((top.spin_rate(&pair).get(i, j) - expected).abs() < 1e-13, "{}", equation.to_text());
        }
    }
    assert_eq!(equations.len(), N * (N - 1) / 2);
}

#[test]
fn planes_drive_each_other_as_the_equations_say() {
    check_plane_equations::<2>();
    check_plane_equations::<3>();
    check_plane_equations::<4>();
    check_plane_equations::<5>();
    check_plane_equations::<6>();
}

#[test]
fn in_three_dimensions_they_are_eulers_equations() {
    let (i1, i2, i3) = (1.7, 2.5, 3.2);
    let top = FreeTop::<3>::from_plane_moments(&[i3, i2, i1]).expect("a body");
    let (w1, w2, w3) = (0.3, -0.8, 1.1);
    let spin = Bivector::from_planes(&[w3, -w2, w1]).expect("three planes");
    let rate = top.spin_rate(&spin);
    assert!((rate.get(1, 2) - (i2 - i3) / i1 * w2 * w3).abs() < 1e-15);
    assert!((-rate.get(0, 2) - (i3 - i1) / i2 * w3 * w1).abs() < 1e-15);
    assert!((rate.get(0, 1) - (i1 - i2) / i3 * w1 * w2).abs() < 1e-15);
}

#[test]
fn in_four_dimensions_the_complement_never_drives() {
    let top = FreeTop::new(Vector([4.0, 3.0, 2.0, 1.0])).expect("a body");
    let text = plane_equations(&top, &Bivector::ZERO)[0].to_text();
    assert_eq!(text, "dω_xy/dt = 0.142857 ω_xz ω_yz + 0.142857 ω_xw ω_yw, never driven by zw");
    let state = TopState::from_spin(&top, Rotation::IDENTITY, &(Bivector::ZERO * f64::NAN));
    assert!(state.is_err(), "a spin that is no number is refused");
}

fn check_shapes_and_rotors<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let half_extents = Vector::<N>::from_fn(|i| 0.3 + 0.2 * i as f64);
    let shape = Shape::cuboid(half_extents).expect("a box");
    let (top, body_from_principal) = FreeTop::from_shape(&shape).expect("a solid");
    for (rank, moment) in top.principal_moments().iter().enumerate() {
        // Descending moments: the axes in reverse.
        let expected = half_extents[N - 1 - rank] * half_extents[N - 1 - rank] / 3.0;
        assert!((moment - expected).abs() < 1e-14, "J = h²/3: {moment} for {expected}");
        assert!((body_from_principal.matrix()[N - 1 - rank][rank].abs() - 1.0).abs() < 1e-14);
    }
    // A regular simplex has equal moments, which come out of the diagonalisation different in their last digits.
    let simplex = polytope::<N>("simplex", Size::Circumradius(1.0)).expect("a simplex");
    let (ball_like, _) = FreeTop::<N>::from_shape(&Shape::Polytope(simplex.into())).expect("a solid");
    let first = ball_like.principal_moments()[0];
    assert!(ball_like.principal_moments().iter().all(|moment| moment == first), "{ball_like:?}");
    let mut random = Random::new(N as u64);
    let (top, spin) = random_case::<N>(&mut random);
    let state = TopState::from_spin(&top, Rotation::exp(&spin), &spin).expect("finite");
    let again = TopState::from_rotor_and_momentum(&state.world_from_body_rotor(), state.momentum_in_body);
    assert!(state.distance(&again) < 1e-14, "{N}D: rotor and matrix differ");
}

#[test]
fn bodies_come_from_shapes_and_attitudes_from_rotors() {
    check_shapes_and_rotors::<2>();
    check_shapes_and_rotors::<3>();
    check_shapes_and_rotors::<4>();
    check_shapes_and_rotors::<5>();
    check_shapes_and_rotors::<6>();
    let ground = Shape::half_space(Vector([0.0, 1.0, 0.0]), 0.0).expect("a half-space");
    assert!(FreeTop::from_shape(&ground).is_err());
}

//! The free-rotation step of the world, in every dimension: order, conservation, reversal, bad input.

use hyperbody_dynamics::free_top::free_rotation_step;
use hyperbody_math::{Bivector, Matrix, Rotation, Vector, planes};

/// J_i of a box with half-extents 0.3, 0.5, 0.7, 1.0, 1.3, 1.6 m and a mass of one kilogram.
fn box_moments<const N: usize>() -> Vector<N> {
    Vector::from_fn(|i| [0.3_f64, 0.5, 0.7, 1.0, 1.3, 1.6][i].powi(2) / 3.0)
}

fn momentum_of_spin<const N: usize>(spin: &Bivector<N>, moments: &Vector<N>) -> Bivector<N> {
    spin.scale_planes(|i, j| moments[i] + moments[j])
}

fn energy<const N: usize>(attitude: &Rotation<N>, momentum_in_world: &Bivector<N>, moments: &Vector<N>) -> f64 {
    let momentum = attitude.inverse_rotate_bivector(momentum_in_world);
    0.5 * momentum.dot(&momentum.scale_planes(|i, j| 1.0 / (moments[i] + moments[j])))
}

/// A spin of the given rate with every plane in it.
fn skew_spin<const N: usize>(rate: f64) -> Bivector<N> {
    let values: Vec<f64> = (0..planes::count(N)).map(|k| [1.0, 0.6, -0.4, 0.5, -0.7, 0.3][k % 6]).collect();
    let spin = Bivector::from_planes(&values).expect("one number per plane");
    spin * (rate / spin.norm())
}

/// A second algorithm: the classical Runge–Kutta method on Ṙ = R Bᵀ, B the spin in the body frame that belongs to the
/// fixed world momentum.
fn runge_kutta<const N: usize>(momentum_in_world: &Bivector<N>, moments: &Vector<N>, seconds: f64) -> Matrix<N> {
    let derivative = |r: Matrix<N>| {
        let momentum = Bivector::from_antisymmetric_part(&(r.transpose() * momentum_in_world.to_matrix() * r));
        let spin = momentum.scale_planes(|i, j| 1.0 / (moments[i] + moments[j]));
        r * spin.to_matrix().transpose()
    };
    let steps = 4000;
    let h = seconds / f64::from(steps);
    let mut r = Matrix::IDENTITY;
    for _ in 0..steps {
        let k1 = derivative(r);
        let k2 = derivative(r + k1 * (0.5 * h));
        let k3 = derivative(r + k2 * (0.5 * h));
        let k4 = derivative(r + k3 * h);
        r += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
    }
    r
}

fn after<const N: usize>(momentum: &Bivector<N>, moments: &Vector<N>, steps: u32, dt: f64) -> Rotation<N> {
    let mut attitude = Rotation::IDENTITY;
    for _ in 0..steps {
        free_rotation_step(&mut attitude, momentum, moments, dt);
    }
    attitude
}

fn check_order<const N: usize>() {
    let moments = box_moments::<N>();
    let momentum = momentum_of_spin(&skew_spin(3.0), &moments);
    let exact = runge_kutta(&momentum, &moments, 1.0);
    let errors: Vec<f64> = [100, 200, 400]
        .map(|steps| (*after(&momentum, &moments, steps, 1.0 / f64::from(steps)).matrix() - exact).max_abs())
        .to_vec();
    if N == 2 {
        assert!(errors[0] < 1e-12, "one plane is solved exactly, got {errors:?}");
        return;
    }
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.03, "{N}D: measured order {order}, errors {errors:?}");
    }
    assert!(errors[2] < 2e-3, "{N}D: {errors:?}");
}

#[test]
fn the_step_is_of_second_order_against_runge_kutta() {
    check_order::<2>();
    check_order::<3>();
    check_order::<4>();
    check_order::<5>();
    check_order::<6>();
}

fn check_minute_of_tumbling<const N: usize>() {
    let moments = box_moments::<N>();
    let momentum = momentum_of_spin(&skew_spin(8.0), &moments);
    let (mut attitude, dt) = (Rotation::IDENTITY, 1.0 / 240.0);
    let start_energy = energy(&attitude, &momentum, &moments);
    let (mut energy_drift, mut norm_drift, mut tumble) = (0.0_f64, 0.0_f64, 0.0_f64);
    for _ in 0..60 * 240 {
        free_rotation_step(&mut attitude, &momentum, &moments, dt);
        let in_body = attitude.inverse_rotate_bivector(&momentum);
        energy_drift = energy_drift.max((energy(&attitude, &momentum, &moments) / start_energy - 1.0).abs());
        norm_drift = norm_drift.max((in_body.norm_sq() / momentum.norm_sq() - 1.0).abs());
        tumble = tumble.max((in_body - momentum).norm() / momentum.norm());
    }
    let defect = (attitude.matrix().transpose() * *attitude.matrix() - Matrix::IDENTITY).max_abs();
    assert!(energy_drift < 1e-3, "{N}D: energy drifts by {energy_drift}");
    assert!(norm_drift < 1e-14 && defect < 1e-14, "{N}D: |M|² drifts by {norm_drift}, RᵀR by {defect}");
    if N > 2 {
        assert!(tumble > 1.0, "{N}D: the momentum moves by {tumble} of itself in the body frame, it should tumble");
    }
}

#[test]
fn a_box_tumbles_for_a_minute_without_losing_energy() {
    check_minute_of_tumbling::<2>();
    check_minute_of_tumbling::<3>();
    check_minute_of_tumbling::<4>();
    check_minute_of_tumbling::<5>();
    check_minute_of_tumbling::<6>();
}

fn check_reversal<const N: usize>() {
    let moments = box_moments::<N>();
    let momentum = momentum_of_spin(&skew_spin(8.0), &moments);
    let start = Rotation::exp(&skew_spin(0.9));
    let mut attitude = start;
    for dt in [1.0 / 60.0, -1.0 / 60.0] {
        for _ in 0..600 {
            free_rotation_step(&mut attitude, &momentum, &moments, dt);
        }
    }
    let error = (*attitude.matrix() - *start.matrix()).max_abs();
    assert!(error < 1e-10, "{N}D: ten seconds forth and back miss the start by {error}");
}

#[test]
fn time_runs_back_to_the_start() {
    check_reversal::<2>();
    check_reversal::<3>();
    check_reversal::<4>();
    check_reversal::<5>();
    check_reversal::<6>();
}

fn check_bad_input<const N: usize>() {
    let spin = skew_spin::<N>(1.0);
    let cases = [
        (spin, Vector::ZERO, 0.1),
        (spin * 1e308, Vector::splat(1e-300), 0.1),
        (spin * 1e308, Vector::splat(1.0), 1e300),
        (spin, Vector::splat(-1.0), 0.1),
        (spin, Vector::from_fn(|i| if i == 0 { 1.0 } else { -1.0 }), 0.1),
        (Bivector::ZERO, Vector::ZERO, 0.1),
        (spin * f64::INFINITY, Vector::splat(1.0), 0.1),
        (spin, Vector::splat(f64::NAN), 0.1),
        (spin, Vector::splat(1.0), f64::NAN),
    ];
    for (case, (momentum, moments, dt)) in cases.into_iter().enumerate() {
        let mut attitude = Rotation::exp(&skew_spin(0.7));
        for _ in 0..20 {
            free_rotation_step(&mut attitude, &momentum, &moments, dt);
        }
        let defect = (attitude.matrix().transpose() * *attitude.matrix() - Matrix::IDENTITY).max_abs();
        assert!(defect < 1e-14, "{N}D, case {case}: the attitude is no rotation any more, off by {defect}");
    }
}

#[test]
fn nonsense_never_spoils_the_attitude() {
    check_bad_input::<2>();
    check_bad_input::<3>();
    check_bad_input::<4>();
    check_bad_input::<5>();
    check_bad_input::<6>();
}

fn check_same_motion_as_in_fewer_dimensions<const LOW: usize, const HIGH: usize>() {
    let moments = Vector::<HIGH>::from_fn(|i| [0.3, 0.5, 0.7, 1.0, 1.3, 1.6][i]);
    let low_moments = Vector::<LOW>::from_fn(|i| moments[i]);
    let spin = skew_spin::<LOW>(2.0);
    let mut high_spin = Bivector::ZERO;
    for (i, j) in planes::all(LOW) {
        high_spin.set(i, j, spin.get(i, j));
    }
    let (steps, dt) = (2000, 1.0 / 2000.0);
    let low = after(&momentum_of_spin(&spin, &low_moments), &low_moments, steps, dt);
    let high = after(&momentum_of_spin(&high_spin, &moments), &moments, steps, dt);
    let mut difference = 0.0_f64;
    for i in 0..LOW {
        for j in 0..LOW {
            difference = difference.max((low.matrix()[i][j] - high.matrix()[i][j]).abs());
        }
    }
    // The rounds of planes come in another order: equal to the accuracy of the step, not to the bit.
    assert!(difference < 1e-6, "{LOW}D inside {HIGH}D differs by {difference}");
    assert_eq!(high.matrix()[HIGH - 1][HIGH - 1], 1.0, "nothing turns the last axis");
}

#[test]
fn a_spin_without_the_last_axes_stays_in_its_subspace() {
    check_same_motion_as_in_fewer_dimensions::<2, 3>();
    check_same_motion_as_in_fewer_dimensions::<3, 4>();
    check_same_motion_as_in_fewer_dimensions::<4, 5>();
    check_same_motion_as_in_fewer_dimensions::<3, 6>();
}

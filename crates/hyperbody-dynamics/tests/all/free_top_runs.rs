//! Runs of the free-rotation laboratory: conservation, orders of convergence, flips, error control, refusals.

use hyperbody_dynamics::free_top::{
    Drift, DriftMeter, ExactMotion, FreeTop, FreeTopErrorKind, Invariants, MapRange, Method, RunPlan, TopRun, TopState,
    map_moments, map_spins, parse_spin, run,
};
use hyperbody_math::{Bivector, Matrix, Rotation, Vector, planes};

fn skew_spin<const N: usize>(rate: f64) -> Bivector<N> {
    let values: Vec<f64> = (0..planes::count(N)).map(|k| [1.0, 0.6, -0.4, 0.5, -0.7, 0.3, 0.8][k % 7]).collect();
    let spin = Bivector::from_planes(&values).expect("one number per plane");
    spin * (rate / spin.norm())
}

/// J = (N, …, 2, 1).
fn descending_top<const N: usize>() -> FreeTop<N> {
    FreeTop::new(Vector::from_fn(|i| (N - i) as f64)).expect("positive moments")
}

fn at_rest_in_the_world<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>) -> TopState<N> {
    TopState::from_spin(top, Rotation::IDENTITY, spin).expect("a finite spin")
}

fn follow<const N: usize>(top: &FreeTop<N>, start: &TopState<N>, plan: &RunPlan) -> TopRun<N> {
    run(top, start, plan, &mut |_, _| {}).expect("a plan that can be followed")
}

/// Drift near the unstable plane 13 over `seconds` at 240 steps a second.
fn drift_near_the_unstable_plane(method: Method, seconds: f64) -> Drift {
    let top = descending_top::<4>();
    let spin = parse_spin("xz=1, xy=0.01, xw=0.01, yz=0.01, yw=0.01, zw=0.01").expect("a spin");
    let plan = RunPlan::new(method, seconds, 1.0 / 240.0).expect("a plan");
    follow(&top, &at_rest_in_the_world(&top, &spin), &plan).drift
}

#[test]
fn splitting_keeps_energy_and_momentum_for_ten_minutes() {
    let drift = drift_near_the_unstable_plane(Method::Splitting4, 600.0);
    assert!(drift.energy <= 1e-12, "{drift:?}");
    assert!(drift.momentum_sq <= 1e-12 && drift.momentum_in_world <= 1e-12, "{drift:?}");
    assert!(drift.pfaffian.is_some_and(|pfaffian| pfaffian <= 1e-12) && drift.manakov <= 1e-11, "{drift:?}");
}

#[test]
fn midpoint_keeps_every_integral_for_ten_minutes() {
    let drift = drift_near_the_unstable_plane(Method::Midpoint, 600.0);
    let all = [drift.energy, drift.momentum_sq, drift.momentum_in_world, drift.pfaffian.expect("4D"), drift.manakov];
    assert!(all.iter().all(|&d| d <= 1e-12), "{drift:?}");
}

/// tr (M + λP²)^k for k up to N and some λ: all of Manakov's integrals, those of higher degree included.
fn traces<const N: usize>(top: &FreeTop<N>, momentum: &Bivector<N>) -> Vec<f64> {
    let mut traces = Vec::new();
    for lambda in [0.0, 0.03, 0.1, 0.3] {
        let moments = top.principal_moments();
        let squares = Matrix::from_diagonal(Vector::from_fn(|i| lambda * moments[i] * moments[i]));
        let matrix = momentum.to_matrix() + squares;
        let mut power = Matrix::IDENTITY;
        for _ in 0..N {
            power = power * matrix;
            traces.push(power.trace());
        }
    }
    traces
}

fn check_integrals_of_any_degree<const N: usize>(method: Method, dt: f64, tolerance: f64) {
    let top = descending_top::<N>();
    let start = at_rest_in_the_world(&top, &skew_spin(1.0));
    let end = *follow(&top, &start, &RunPlan::new(method, 30.0, dt).expect("a plan")).final_state();
    let moved = (end.momentum_in_body - start.momentum_in_body).norm() / start.momentum_in_body.norm();
    assert!(moved > 0.1, "{N}D: the momentum has to move for this to say anything: {moved}");
    let size = start.momentum_in_body.norm() + 0.3 * (N * N) as f64;
    let (before, after) = (traces(&top, &start.momentum_in_body), traces(&top, &end.momentum_in_body));
    for (index, (before, after)) in before.iter().zip(after).enumerate() {
        let scale = size.powi(1 + (index % N) as i32);
        assert!((after - before).abs() <= tolerance * scale, "{N}D, {}: {before} to {after}", method.name());
    }
}

#[test]
fn midpoint_keeps_integrals_of_any_degree_even_in_long_steps() {
    check_integrals_of_any_degree::<3>(Method::Midpoint, 0.25, 1e-13);
    check_integrals_of_any_degree::<4>(Method::Midpoint, 0.25, 1e-13);
    check_integrals_of_any_degree::<5>(Method::Midpoint, 0.25, 1e-13);
    check_integrals_of_any_degree::<6>(Method::Midpoint, 0.25, 1e-13);
    // The exact flow keeps them, too.
    check_integrals_of_any_degree::<6>(Method::Splitting6, 0.01, 1e-12);
}

#[test]
fn the_steps_of_engines_lose_what_the_splitting_keeps() {
    let gyroscopic = drift_near_the_unstable_plane(Method::Gyroscopic, 60.0);
    let explicit = drift_near_the_unstable_plane(Method::Explicit, 60.0);
    let splitting = drift_near_the_unstable_plane(Method::Splitting2, 60.0);
    for drift in [gyroscopic, explicit] {
        assert!(drift.energy > 1e-4 && drift.momentum_sq > 1e-4, "{drift:?}");
    }
    assert!(splitting.energy < 1e-6 && splitting.momentum_sq < 1e-13, "{splitting:?}");
}

fn check_invariants<const N: usize>() {
    let top = descending_top::<N>();
    let plan = RunPlan::new(Method::Splitting6, 20.0, 0.01).expect("a plan");
    let drift = follow(&top, &at_rest_in_the_world(&top, &skew_spin(1.0)), &plan).drift;
    let all = [drift.energy, drift.momentum_sq, drift.momentum_in_world, drift.manakov];
    assert!(all.iter().all(|&d| d < 3e-13), "{N}D: {drift:?}");
    assert_eq!(drift.pfaffian.is_some(), N == 4);
}

#[test]
fn every_integral_is_conserved_in_every_dimension() {
    check_invariants::<2>();
    check_invariants::<3>();
    check_invariants::<4>();
    check_invariants::<5>();
    check_invariants::<6>();
}

#[test]
fn a_wrong_motion_shows_in_the_integrals() {
    // Manakov's integrals see what energy and |M|² cannot: a turn of the momentum in the body that keeps both.
    let top = FreeTop::new(Vector([2.0, 2.0, 2.0, 2.0])).expect("a body");
    let skewed = FreeTop::new(Vector([4.0, 3.0, 2.0, 1.0])).expect("a body");
    let start = at_rest_in_the_world(&top, &skew_spin(1.0));
    let mut meter = DriftMeter::new(&skewed, &start);
    let turned =
        TopState { momentum_in_body: Rotation::in_plane(0, 1, 0.3).rotate_bivector(&start.momentum_in_body), ..start };
    meter.observe(&Invariants::of(&skewed, &turned));
    let drift = meter.drift();
    assert!(drift.manakov > 0.01 && drift.momentum_in_world > 0.01 && drift.momentum_sq < 1e-14, "{drift:?}");
}

/// Errors at the end of a run against the closed form, for steps that halve from `dt`.
fn measured_orders<const N: usize>(method: Method, dt: f64) -> Vec<f64> {
    let top = FreeTop::new(Vector::<N>::from_fn(|i| if i % 2 == 0 { 2.0 } else { 0.6 })).expect("a body");
    let start = at_rest_in_the_world(&top, &skew_spin(1.5));
    let exact = ExactMotion::new(&top, &start).expect("two moments").state_at(4.0);
    let errors: Vec<f64> = (0..3)
        .map(|halvings| {
            let plan = RunPlan::new(method, 4.0, dt / f64::from(1 << halvings)).expect("a plan");
            follow(&top, &start, &plan).final_state().distance(&exact)
        })
        .collect();
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

fn check_orders<const N: usize>() {
    for (method, dt) in [
        (Method::Splitting2, 0.02),
        (Method::Splitting4, 0.1),
        (Method::Splitting6, 0.2),
        (Method::Midpoint, 0.02),
        (Method::Gyroscopic, 0.002),
        (Method::Explicit, 0.002),
    ] {
        let stated = f64::from(method.order().expect("a stepping method"));
        let orders = measured_orders::<N>(method, dt);
        let last = orders[orders.len() - 1];
        assert!((last - stated).abs() < 0.15, "{N}D, {}: measured {orders:?}, stated {stated}", method.name());
    }
}

#[test]
fn every_method_converges_with_its_stated_order() {
    check_orders::<3>();
    check_orders::<4>();
    check_orders::<5>();
    check_orders::<6>();
}

#[test]
fn flips_come_every_half_period_of_jacobi() {
    let top = FreeTop::<3>::from_plane_moments(&[3.2, 2.5, 1.7]).expect("a body");
    let spin = Bivector::from_planes(&[0.02, -1.0, 0.02]).expect("three planes");
    let start = at_rest_in_the_world(&top, &spin);
    let period = ExactMotion::new(&top, &start).expect("three axes").period().expect("periodic");
    let plan = RunPlan::new(Method::Splitting6, 500.0, 0.02).expect("a plan");
    let flips = follow(&top, &start, &plan).flips;
    assert_eq!((flips.plane, flips.times.len()), ((0, 2), 15));
    let measured = flips.period.expect("many flips");
    assert!((measured / period - 1.0).abs() < 1e-8, "measured {measured}, exact {period}");
    assert!(flips.irregularity.expect("many flips") < 1e-8, "{flips:?}");
    // The same plan by the closed form itself, sampled coarsely, finds the same flips.
    let plan = RunPlan::new(Method::Exact, 500.0, 0.02).expect("a plan");
    let exact = follow(&top, &start, &plan);
    assert_eq!(exact.flips.times.len(), 15);
    assert!((exact.flips.period.expect("many flips") - period).abs() < 1e-7);
    assert!(exact.drift.energy < 1e-13 && exact.drift.momentum_in_world < 1e-12, "{:?}", exact.drift);
}

#[test]
fn error_control_reaches_its_tolerance() {
    let top = descending_top::<4>();
    let start = at_rest_in_the_world(&top, &skew_spin(2.0));
    let reference = follow(&top, &start, &RunPlan::new(Method::Splitting6, 5.0, 0.005).expect("a plan"));
    for method in [Method::Splitting2, Method::Splitting4, Method::Splitting6, Method::Midpoint] {
        let mut plan = RunPlan::new(method, 5.0, 0.25).expect("a plan");
        plan.tolerance = Some(1e-7);
        let controlled = follow(&top, &start, &plan);
        let error = controlled.final_state().distance(reference.final_state());
        // Twenty steps of 1e-7 each, some growth on the way.
        assert!(error < 2e-5, "{}: off by {error} with {} parts", method.name(), controlled.most_parts);
        assert!(controlled.most_parts > 1, "{}", method.name());
    }
    let mut plan = RunPlan::new(Method::Splitting2, 1.0, 0.25).expect("a plan");
    plan.tolerance = Some(1e-18);
    let error = run(&top, &start, &plan, &mut |_, _| {}).expect_err("beyond rounding");
    assert_eq!(error.kind(), FreeTopErrorKind::Tolerance);
}

#[test]
fn a_midpoint_step_that_is_too_long_is_refused_or_solved() {
    let top = descending_top::<6>();
    for rate in [1.0, 3.0, 30.0, 1e3, 1e8] {
        let start = at_rest_in_the_world(&top, &skew_spin(rate));
        let mut state = start;
        match Method::Midpoint.step(&top, &mut state, 0.5) {
            Ok(()) => {
                let ratio = state.momentum_in_body.norm_sq() / start.momentum_in_body.norm_sq();
                assert!((ratio - 1.0).abs() < 1e-11, "rate {rate}: |M|² changes by {}", ratio - 1.0);
            }
            Err(error) => {
                assert_eq!(error.kind(), FreeTopErrorKind::NoConvergence);
                assert_eq!(state, start, "a refused step leaves the state alone");
            }
        }
    }
}

#[test]
fn nonsense_is_refused_with_the_reason() {
    let moments_error = |moments: [f64; 4]| FreeTop::new(Vector(moments)).expect_err("no body").to_string();
    assert!(moments_error([1.0, -2.0, 1.0, 1.0]).contains("axis y is -2"));
    assert!(moments_error([1.0, f64::NAN, 1.0, 1.0]).contains("finite"));
    assert!(moments_error([0.0, 1.0, 0.0, 1.0]).contains("plane xz"));
    assert!(FreeTop::new(Vector([0.0, 1.0, 2.0])).is_ok(), "a flat body is a body");

    let inertia_error = |moments: &[f64]| FreeTop::<3>::from_plane_moments(moments).expect_err("no body").to_string();
    assert!(inertia_error(&[1.0, 1.0, 2.5]).contains("triangle inequality"));
    assert!(inertia_error(&[1.0, 1.0]).contains("3 planes"));
    assert!(inertia_error(&[1.0, 0.0, 1.0]).contains("positive"));
    assert!(FreeTop::<3>::from_plane_moments(&[1.0, 1.0, 2.0]).is_ok(), "a flat body meets the inequality");
    let bound =
        FreeTop::<4>::from_plane_moments(&[7.0, 6.0, 5.0, 5.0, 4.0, 3.5]).expect_err("contradiction").to_string();
    assert!(bound.contains("depend on 4 numbers"), "{bound}");
    let exact = FreeTop::<4>::from_plane_moments(&[7.0, 6.0, 5.0, 5.0, 4.0, 3.0]).expect("J = (4, 3, 2, 1)");
    assert!((*exact.principal_moments() - Vector([4.0, 3.0, 2.0, 1.0])).norm() < 1e-14);

    let spin_error = |text: &str| parse_spin::<4>(text).expect_err("no spin").to_string();
    assert!(spin_error("xv=1").contains("xy xz xw yz yw zw"));
    assert!(spin_error("xy").contains("plane=rate"));
    assert!(spin_error("xy=fast").contains("fast"));
    assert!(spin_error("xy=1,yx=2").contains("twice"));
    assert!(spin_error("xy=inf").contains("finite"));

    let plan_error = |seconds, dt| RunPlan::new(Method::Splitting2, seconds, dt).expect_err("no plan").kind();
    for (seconds, dt) in [(0.0, 0.1), (-1.0, 0.1), (f64::NAN, 0.1), (1.0, 0.0), (1.0, f64::INFINITY), (1e30, 1e-9)] {
        assert_eq!(plan_error(seconds, dt), FreeTopErrorKind::Span);
    }
    assert!(Method::from_name("rk4").expect_err("no method").to_string().contains("splitting2"));
    assert!(MapRange::new(1.0, 1.0, 5).is_err() && MapRange::new(0.0, 1.0, 1).is_err());
}

#[test]
fn maps_are_the_same_every_time_and_agree_with_themselves() {
    let top = descending_top::<4>();
    let range = |count| MapRange::new(-1.5, 1.5, count).expect("a range");
    let planes = [(0, 3), (1, 2)];
    let map = map_spins(&top, planes, range(25), range(20), &|_, _| {}).expect("a map");
    assert_eq!(map, map_spins(&top, planes, range(25), range(20), &|_, _| {}).expect("a map"));
    assert_eq!(map.cells.len(), 500);
    for (column, row) in [(0, 0), (24, 19), (3, 17)] {
        let cell = map.cell(column, row).expect("inside");
        assert!((cell.growth_rate - cell.measured_growth_rate).abs() < 1e-3, "{cell:?}");
    }
    assert_eq!(map.cell(25, 0), None);
    assert!(map_spins(&top, [(0, 1), (1, 2)], range(5), range(5), &|_, _| {}).is_err());

    let moments = MapRange::new(0.5, 4.5, 9).expect("a range");
    let spin = Bivector::plane(0, 2, 1.0);
    let map = map_moments(&top, [1, 3], &spin, moments, moments, &|_, _| {}).expect("a map");
    let stable = map.cell(0, 8).expect("inside").verdict.stable();
    assert_eq!(stable, Some(true), "J = (4, 0.5, 2, 4.5): no moment between 4 and 2");
    assert_eq!(map.cell(5, 8).expect("inside").verdict.stable(), Some(false), "J_y = 3 lies between");
}

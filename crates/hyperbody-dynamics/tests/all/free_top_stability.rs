//! Verdicts and growth rates against the published table, the linearised system and measured runs.

use crate::free_top_common::Random;
use hyperbody_dynamics::free_top::stability::{Eigenvalue, inner_turn_threshold};
use hyperbody_dynamics::free_top::sweep::plane_pairs;
use hyperbody_dynamics::free_top::{
    FreeTop, PrincipalRotation, Stability, Verdict, linearised_growth_rate, perturbed_run, stability,
};
use hyperbody_math::{Bivector, Vector, planes};

fn top_4321() -> FreeTop<4> {
    FreeTop::new(Vector([4.0, 3.0, 2.0, 1.0])).expect("a body")
}

fn double<const N: usize>(first: (usize, usize), a: f64, second: (usize, usize), b: f64) -> Bivector<N> {
    Bivector::plane(first.0, first.1, a) + Bivector::plane(second.0, second.1, b)
}

fn judge<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>) -> Stability<N> {
    stability(top, spin).expect("a finite spin")
}

fn random_top<const N: usize>(random: &mut Random) -> FreeTop<N> {
    FreeTop::new(Vector::from_fn(|_| random.between(0.05, 5.0))).expect("positive moments")
}

fn below(random: &mut Random, count: usize) -> usize {
    random.between(0.0, count as f64) as usize
}

/// Rates in a random choice of disjoint planes: simple, double or more.
fn random_rotation<const N: usize>(random: &mut Random) -> Bivector<N> {
    let mut axes: Vec<usize> = (0..N).collect();
    for last in (1..N).rev() {
        axes.swap(last, below(random, last + 1));
    }
    let turns = 1 + below(random, N / 2);
    let mut spin = Bivector::ZERO;
    for turn in 0..turns {
        spin.set(axes[2 * turn], axes[2 * turn + 1], random.between(-2.0, 2.0));
    }
    spin
}

#[test]
fn simple_rotations_have_the_published_growth_rates() {
    let top = top_4321();
    let published =
        [((0, 1), 0.0), ((0, 2), 0.169_031), ((0, 3), 0.333_333), ((1, 2), 0.0), ((1, 3), 0.258_199), ((2, 3), 0.0)];
    for ((i, j), rate) in published {
        let judged = judge(&top, &Bivector::plane(i, j, 1.0));
        assert!((judged.growth_rate - rate).abs() < 5e-7, "plane ({i}, {j}): {}", judged.growth_rate);
        assert_eq!(judged.verdict.stable(), Some(rate == 0.0), "plane ({i}, {j}): {}", judged.why);
        let measured = linearised_growth_rate(&top, &judged.rotation);
        assert!((measured - rate).abs() < 2e-5, "plane ({i}, {j}): measured {measured}");
    }
}

#[test]
fn the_three_pairs_of_planes_have_the_published_verdicts() {
    let top = top_4321();
    let threshold = inner_turn_threshold([4.0, 3.0, 2.0, 1.0]);
    assert!((threshold - 0.958_702_311_072_570_3).abs() < 1e-15, "threshold {threshold}");
    for step in -40..=40 {
        // Never exactly ±1, the isoclinic ratio.
        let b = 0.051 * f64::from(step) + 1e-3;
        let verdict = |first, second| judge(&top, &double(first, 1.0, second, b)).verdict;
        assert_eq!(verdict((0, 1), (2, 3)), Verdict::Stable, "b = {b}");
        assert_eq!(verdict((0, 2), (1, 3)), Verdict::Unstable, "b = {b}");
        let expected = if b.abs() >= threshold { Verdict::Stable } else { Verdict::Unstable };
        assert_eq!(verdict((0, 3), (1, 2)), expected, "b = {b}");
    }
}

#[test]
fn bisection_on_measured_growth_finds_the_threshold() {
    let top = top_4321();
    let grows = |b: f64| {
        let rotation = PrincipalRotation::new(&double((0, 3), 1.0, (1, 2), b)).expect("disjoint planes");
        linearised_growth_rate(&top, &rotation) > 1e-3
    };
    let (mut low, mut high) = (0.5, 0.99);
    assert!(grows(low) && !grows(high));
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if grows(middle) { low = middle } else { high = middle }
    }
    assert!((low / 0.958_702_311_072_570_3 - 1.0).abs() < 5e-4, "threshold {low}");
}

/// Ω̇ linearised entry by entry about a steady spin, independent of the block formulas.
fn linearised_matrix<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>) -> Vec<Vec<f64>> {
    let columns: Vec<Vec<f64>> = planes::all(N)
        .map(|(k, l)| {
            let unit = Bivector::<N>::plane(k, l, 1.0);
            // The right-hand side is quadratic, so this difference is its derivative exactly.
            let derivative = (top.spin_rate(&(*spin + unit)) - top.spin_rate(&(*spin - unit))) * 0.5;
            derivative.planes().collect()
        })
        .collect();
    (0..columns.len()).map(|row| columns.iter().map(|column| column[row]).collect()).collect()
}

fn check_spectrum<const N: usize>() {
    let mut random = Random::new(7 + N as u64);
    for case in 0..200 {
        let (top, spin) = (random_top::<N>(&mut random), random_rotation::<N>(&mut random));
        let matrix = linearised_matrix(&top, &spin);
        let eigenvalues = judge(&top, &spin).eigenvalues;
        let count = planes::count(N);
        assert_eq!(eigenvalues.len(), count);
        // Equal power sums tr Aᵏ = Σ λᵏ for k up to the size fix the whole spectrum (Newton's identities).
        let mut power = matrix.clone();
        let mut roots: Vec<Eigenvalue> = eigenvalues.clone();
        let size = matrix.iter().flatten().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        for k in 1..=count {
            let trace: f64 = (0..count).map(|i| power[i][i]).sum();
            let sum: f64 = roots.iter().map(|root| root.real).sum();
            let scale = count as f64 * (2.0 * size).powi(k as i32);
            assert!((trace - sum).abs() <= 1e-12 * scale, "{N}D, case {case}: tr A^{k} = {trace}, Σ λ^{k} = {sum}");
            let product = |i: usize, j: usize| (0..count).map(|m| power[i][m] * matrix[m][j]).sum();
            power = (0..count).map(|i| (0..count).map(|j| product(i, j)).collect()).collect();
            for (root, &Eigenvalue { real, imaginary }) in roots.iter_mut().zip(&eigenvalues) {
                *root = Eigenvalue {
                    real: root.real * real - root.imaginary * imaginary,
                    imaginary: root.real * imaginary + root.imaginary * real,
                };
            }
        }
    }
}

#[test]
fn the_block_formulas_give_the_spectrum_of_the_linearised_system() {
    check_spectrum::<2>();
    check_spectrum::<3>();
    check_spectrum::<4>();
    check_spectrum::<5>();
    check_spectrum::<6>();
}

fn check_verdicts_against_measured_growth<const N: usize>(cases: usize) {
    let mut random = Random::new(100 + N as u64);
    let mut unstable = 0;
    for case in 0..cases {
        let (top, spin) = (random_top::<N>(&mut random), random_rotation::<N>(&mut random));
        let judged = judge(&top, &spin);
        let measured = linearised_growth_rate(&top, &judged.rotation);
        if judged.growth_rate.max(measured) <= 1e-3 {
            continue;
        }
        unstable += 1;
        assert_eq!(judged.verdict, Verdict::Unstable, "{N}D, case {case}: measured {measured}, {}", judged.why);
        let error = (measured - judged.growth_rate).abs();
        // Next to a threshold λ is the root of a small number, which the step's own error shifts.
        assert!(error < 2e-4, "{N}D, case {case}: {measured} for {}", judged.growth_rate);
    }
    assert!(unstable > cases / 5, "{N}D: only {unstable} of {cases} cases tested anything");
}

#[test]
fn verdicts_agree_with_measured_growth_in_ten_thousand_random_cases() {
    check_verdicts_against_measured_growth::<3>(1000);
    check_verdicts_against_measured_growth::<4>(10_000);
    check_verdicts_against_measured_growth::<5>(500);
    check_verdicts_against_measured_growth::<6>(500);
}

#[test]
fn perturbed_runs_grow_as_the_eigenvalues_say() {
    let top = top_4321();
    for spin in [
        Bivector::plane(0, 2, 1.0),
        Bivector::plane(1, 3, 1.0),
        Bivector::plane(0, 3, 1.0),
        double((0, 2), 1.0, (1, 3), 0.8),
        // Below the threshold: growth that oscillates.
        double((0, 3), 1.0, (1, 2), 0.5),
        double((0, 3), 1.0, (1, 2), 0.9),
        double((0, 3), 1.0, (1, 2), 0.95),
    ] {
        let judged = judge(&top, &spin);
        let (rate, rotation) = (judged.growth_rate, judged.rotation);
        let run = perturbed_run(&top, &rotation, 1500.0).expect("a short run");
        assert!(run.ran_away && (run.growth_rate / rate - 1.0).abs() < 2e-3, "{} for {rate}", run.growth_rate);
    }
    for spin in [Bivector::plane(0, 1, 1.0), double((0, 1), 1.0, (2, 3), 0.3), double((0, 3), 1.0, (1, 2), 1.2)] {
        let rotation = PrincipalRotation::new(&spin).expect("disjoint planes");
        let run = perturbed_run(&top, &rotation, 500.0).expect("a short run");
        assert!(!run.ran_away && run.growth_rate.abs() < 1e-3, "grows at {}", run.growth_rate);
        assert!(run.deviations.iter().all(|&deviation| deviation < 1e-8));
    }
}

#[test]
fn an_interleaved_double_rotation_grows_while_oscillating_or_not_but_always_grows() {
    let mut random = Random::new(3);
    for _ in 0..2000 {
        let mut moments: Vec<f64> = (0..4).map(|_| random.between(0.05, 5.0)).collect();
        moments.sort_by(|a, b| b.total_cmp(a));
        let top = FreeTop::new(Vector::<4>::from_slice(&moments).expect("four")).expect("a body");
        let (a, b) = (random.between(0.1, 2.0), random.between(-2.0, 2.0));
        assert_eq!(judge(&top, &double((0, 2), a, (1, 3), b)).verdict, Verdict::Unstable);
        assert_eq!(judge(&top, &double((0, 1), a, (2, 3), b)).verdict, Verdict::Stable);
        let threshold = inner_turn_threshold([moments[0], moments[1], moments[2], moments[3]]);
        assert!((0.0..=1.0).contains(&threshold));
        let inner = judge(&top, &double((0, 3), a, (1, 2), b));
        assert_eq!(inner.verdict.stable(), Some((b / a).abs() >= threshold), "|b/a| = {}", (b / a).abs());
    }
}

#[test]
fn isoclinic_turns_are_left_open() {
    let top = top_4321();
    for pair in plane_pairs(4) {
        for b in [1.0, -1.0] {
            let judged = judge(&top, &double(pair[0], 1.0, pair[1], b));
            assert_eq!(judged.verdict.stable(), None, "{pair:?}");
            assert_eq!(judged.growth_rate, 0.0);
            assert!(judged.why.contains("isoclinic"), "{}", judged.why);
        }
    }
    // A body with four equal moments turns steadily whatever the spin.
    let ball = FreeTop::new(Vector::<4>::splat(1.0)).expect("a ball");
    assert_eq!(judge(&ball, &double((0, 1), 1.0, (2, 3), 1.0)).verdict, Verdict::Stable);
}

#[test]
fn equal_moments_make_a_disturbance_drift_or_leave_it_bounded() {
    let symmetric = FreeTop::new(Vector([2.0, 2.0, 1.0])).expect("a body");
    let across = judge(&symmetric, &Bivector::plane(0, 2, 1.0));
    assert_eq!(across.verdict, Verdict::Open, "{}", across.why);
    assert!(across.why.contains("precesses"), "{}", across.why);
    assert_eq!(judge(&symmetric, &Bivector::plane(0, 1, 1.0)).verdict, Verdict::Stable);

    // Three equal moments, a turn among them and one beyond: a double zero with complete eigenvectors.
    let blocks = FreeTop::new(Vector([2.0, 2.0, 2.0, 1.0])).expect("a body");
    let judged = judge(&blocks, &double((0, 1), 1.0, (2, 3), 0.4));
    let rotation = PrincipalRotation::new(&double::<4>((0, 1), 1.0, (2, 3), 0.4)).expect("disjoint");
    let run = perturbed_run(&blocks, &rotation, 2000.0).expect("a short run");
    let bounded = run.deviations.iter().all(|&deviation| deviation < 1e-9);
    assert_eq!(judged.verdict.stable(), bounded.then_some(true), "{}", judged.why);

    // Equal moments of the two inner axes with a simple outer turn: twice the same frequency, but no coupling.
    let twin = FreeTop::new(Vector([3.0, 2.0, 1.0, 1.0])).expect("a body");
    assert_eq!(judge(&twin, &Bivector::plane(0, 1, 1.0)).verdict, Verdict::Stable);
}

#[test]
fn disturbed_and_general_spins_say_what_was_judged() {
    let top = top_4321();
    let mut spin = Bivector::plane(0, 2, 1.0);
    spin.set(0, 1, 0.01);
    let judged = judge(&top, &spin);
    assert_eq!(judged.verdict, Verdict::Unstable);
    assert!(judged.why.contains("judged as the rotation in xz"), "{}", judged.why);
    spin.set(0, 1, 0.9);
    let judged = judge(&top, &spin);
    assert_eq!(judged.verdict.stable(), None);
    assert!(judged.why.contains("lies outside"), "{}", judged.why);
    assert_eq!(judge(&top, &Bivector::ZERO).verdict.stable(), None);
    assert!(stability(&top, &(spin * f64::NAN)).is_err());
    assert!(PrincipalRotation::new(&spin).is_err());
}

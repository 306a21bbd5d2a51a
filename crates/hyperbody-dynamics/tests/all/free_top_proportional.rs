//! Bodies whose moments are in proportion, J₁J₄ = J₂J₃: there both λ² coincide at all rates, and moments drawn at random
//! never are. Verdicts against rates by hand and against measured growth, which knows no eigenvalue.

use hyperbody_dynamics::free_top::stability::inner_turn_threshold;
use hyperbody_dynamics::free_top::{
    FreeTop, PrincipalRotation, Stability, Verdict, linearised_growth_rate, perturbed_run, stability,
};
use hyperbody_math::{Bivector, Vector};

/// J₁ > J₂ > J₃ > J₄ with J₁J₄ = J₂J₃; the last two not exactly so in binary.
const PROPORTIONAL: [[f64; 4]; 7] = [
    [8.0, 4.0, 2.0, 1.0],
    [6.0, 3.0, 2.0, 1.0],
    [27.0, 9.0, 3.0, 1.0],
    [36.0, 9.0, 4.0, 1.0],
    [1e3, 1e2, 10.0, 1.0],
    [1.01, 1.005 * 1.01 / 1.0051, 1.0051, 1.005],
    [0.7, 0.3, 0.21, 0.09],
];

/// a in the plane of the axes of J₁ and J₄, b in that of J₂ and J₃, wherever these axes lie.
fn outer_inner<const N: usize>(axes: [usize; 4], a: f64, b: f64) -> Bivector<N> {
    let plane = |i: usize, j: usize, rate: f64| Bivector::plane(i.min(j), i.max(j), rate);
    plane(axes[0], axes[3], a) + plane(axes[1], axes[2], b)
}

fn judge<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>) -> (Stability<N>, f64) {
    let judged = stability(top, spin).expect("a finite spin");
    let measured = linearised_growth_rate(top, &judged.rotation);
    (judged, measured)
}

#[test]
fn growth_below_equal_rates_is_what_the_closed_form_says() {
    // √(r12 r13 (a² − b²)) by hand.
    let by_hand: [([f64; 4], f64, f64); 5] = [
        ([8.0, 4.0, 2.0, 1.0], 0.5, (1.0 / 3.0 * 0.6 * 0.75_f64).sqrt()),
        ([6.0, 3.0, 2.0, 1.0], 0.5, (1.0 / 3.0 * 0.5 * 0.75_f64).sqrt()),
        ([27.0, 9.0, 3.0, 1.0], 0.5, (0.5 * 0.8 * 0.75_f64).sqrt()),
        ([4.0, 2.0, 2.0, 1.0], 0.5, (1.0 / 9.0 * 0.75_f64).sqrt()),
        ([9.0, 3.0, 3.0, 1.0], 0.5, (0.25 * 0.75_f64).sqrt()),
    ];
    for (moments, b, rate) in by_hand {
        let top = FreeTop::new(Vector(moments)).expect("a body");
        let (judged, measured) = judge(&top, &outer_inner([0, 1, 2, 3], 1.0, b));
        assert_eq!(judged.verdict, Verdict::Unstable, "{moments:?}: {}", judged.why);
        assert!((judged.growth_rate / rate - 1.0).abs() < 1e-13, "{moments:?}: {} for {rate}", judged.growth_rate);
        assert!((measured - rate).abs() < 1e-5, "{moments:?}: measured {measured} for {rate}");
        let run = perturbed_run(&top, &judged.rotation, 500.0).expect("a short run");
        assert!(run.ran_away && (run.growth_rate / rate - 1.0).abs() < 2e-3, "{} for {rate}", run.growth_rate);
    }
}

/// The four moments on the given axes and the rest on the others.
fn check<const N: usize>(axes: [usize; 4], rest: f64) {
    for moments in PROPORTIONAL {
        let largest = moments[0];
        let mut all = Vector::<N>::splat(largest * rest);
        for (&axis, &moment) in axes.iter().zip(&moments) {
            all.0[axis] = moment;
        }
        let top = FreeTop::new(all).expect("a body");
        for b in [0.1, -0.5, 0.9, 0.99, -0.999_999, 1.000_001, 1.01, -1.1, 2.0, -10.0] {
            let (judged, measured) = judge(&top, &outer_inner::<N>(axes, 1.3, 1.3 * b));
            let r = |i: usize, j: usize| (moments[i] - moments[j]) / (moments[i] + moments[j]);
            let square = r(0, 1) * r(0, 2) * (1.0 - b * b);
            let rate = 1.3 * square.max(0.0).sqrt();
            assert_eq!(judged.verdict.stable(), Some(f64::abs(b) > 1.0), "{moments:?}, b/a = {b}: {}", judged.why);
            assert!((judged.growth_rate - rate).abs() <= 1e-7 * rate, "{} for {rate}, b/a = {b}", judged.growth_rate);
            assert!((measured - rate).abs() < 3e-4, "{moments:?}, b/a = {b}: measured {measured} for {rate}");
            let relation = if rate > 0.0 { "below" } else { "above" };
            assert!(judged.why.contains(&format!("is {relation} the threshold 1.000000")), "{}", judged.why);
        }
        let isoclinic = judge(&top, &outer_inner::<N>(axes, 1.0, -1.0)).0;
        assert_eq!(isoclinic.verdict, Verdict::Open, "{}", isoclinic.why);
    }
}

#[test]
fn both_sides_of_equal_rates_agree_with_measured_growth_in_every_dimension() {
    check::<4>([0, 1, 2, 3], 1.0);
    check::<4>([2, 0, 3, 1], 1.0);
    check::<5>([0, 1, 2, 3], 1.5);
    check::<5>([4, 1, 0, 2], 2.0);
    check::<6>([1, 5, 0, 3], 1.5);
}

#[test]
fn bodies_next_to_proportion_are_judged_like_those_in_it() {
    for off in [1e-15, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3] {
        for sign in [-1.0, 1.0] {
            let moments = [8.0 * (1.0 + sign * off), 4.0, 2.0, 1.0];
            let top = FreeTop::new(Vector(moments)).expect("a body");
            let threshold = inner_turn_threshold(moments);
            assert!(threshold <= 1.0 + 1e-15 && threshold > 1.0 - off, "{threshold}");
            for b in [0.5, 0.9, 0.999, 1.000_001, 1.001, 2.0] {
                let (judged, measured) = judge(&top, &outer_inner([0, 1, 2, 3], 1.0, b));
                assert_eq!(judged.verdict.stable(), Some(b > 1.0), "{moments:?}, b = {b}: {}", judged.why);
                let error = (judged.growth_rate - measured).abs();
                assert!(error < 3e-4, "{moments:?}, b = {b}: {measured} for {}", judged.growth_rate);
            }
        }
    }
}

#[test]
fn a_stable_turn_in_proportion_stays_small() {
    let top = FreeTop::new(Vector([8.0, 4.0, 2.0, 1.0])).expect("a body");
    let rotation = PrincipalRotation::new(&outer_inner([0, 1, 2, 3], 0.999, 1.0)).expect("disjoint planes");
    let run = perturbed_run(&top, &rotation, 2000.0).expect("a short run");
    assert!(!run.ran_away && run.deviations.iter().all(|&deviation| deviation < 1e-8));
}

#[test]
fn an_idle_axis_does_not_hide_the_growth_between_two_turns() {
    for moments in [[16.0, 8.0, 4.0, 2.0, 1.0], [8.0, 4.0, 2.0, 1.0, 0.1]] {
        let largest_is_idle = moments[0] == 16.0;
        let axes = if largest_is_idle { [1, 2, 3, 4] } else { [0, 1, 2, 3] };
        let top = FreeTop::new(Vector(moments)).expect("a body");
        let (judged, measured) = judge(&top, &outer_inner::<5>(axes, 1.0, 0.5));
        assert_eq!(judged.verdict, Verdict::Unstable, "{}", judged.why);
        assert!((judged.growth_rate - 0.15_f64.sqrt()).abs() < 1e-13 && (measured - judged.growth_rate).abs() < 1e-5);
    }
}

//! Every figure that docs/free-rotation.md states of the laboratory, measured anew; ends with an error if one is missed.
//!
//! `cargo run --release -p hyperbody-dynamics --example free_rotation_claims`, about a minute.

use std::process::ExitCode;
use std::time::Instant;

use hyperbody_dynamics::free_top::{
    Drift, ExactMotion, FlipDetector, FreeTop, MapRange, Method, PrincipalRotation, RunPlan, TopRun, TopState, Verdict,
    linearised_growth_rate, map_spins, parse_spin, perturbed_run, run, stability,
};
use hyperbody_math::{Bivector, Rotation, Vector, planes};

/// Prints figures beside their limits and remembers whether one was missed.
#[derive(Default)]
struct Claims {
    missed: u32,
}

impl Claims {
    fn at_most(&mut self, what: &str, value: f64, limit: f64) {
        self.line(what, &format!("{value:.3e}"), &format!("at most {limit:.0e}"), value <= limit);
    }

    fn holds(&mut self, what: &str, value: &str, limit: &str, held: bool) {
        self.line(what, value, limit, held);
    }

    fn line(&mut self, what: &str, value: &str, limit: &str, held: bool) {
        println!("{what:<66} {value:>22}   {limit}{}", if held { "" } else { "   MISSED" });
        self.missed += u32::from(!held);
    }
}

fn top_4321() -> FreeTop<4> {
    FreeTop::new(Vector([4.0, 3.0, 2.0, 1.0])).expect("a body")
}

fn follow<const N: usize>(top: &FreeTop<N>, start: &TopState<N>, method: Method, seconds: f64, dt: f64) -> TopRun<N> {
    let plan = RunPlan::new(method, seconds, dt).expect("a plan");
    run(top, start, &plan, &mut |_, _| {}).expect("a run")
}

fn start<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>) -> TopState<N> {
    TopState::from_spin(top, Rotation::IDENTITY, spin).expect("a finite spin")
}

fn conservation(claims: &mut Claims) {
    println!("\n1. Ten minutes near the unstable plane xz, J = (4, 3, 2, 1), dt = 1/240 s: relative drift");
    let top = top_4321();
    let spin = parse_spin("xz=1, xy=0.01, xw=0.01, yz=0.01, yw=0.01, zw=0.01").expect("a spin");
    let drift = |method| -> Drift { follow(&top, &start(&top, &spin), method, 600.0, 1.0 / 240.0).drift };
    let splitting = drift(Method::Splitting4);
    claims.at_most("splitting4: energy", splitting.energy, 1e-10);
    claims.at_most("splitting4: |L|²", splitting.momentum_sq, 1e-11);
    claims.at_most("splitting4: L in the world", splitting.momentum_in_world, 1e-11);
    let midpoint = drift(Method::Midpoint);
    claims.at_most("midpoint: energy", midpoint.energy, 1e-10);
    claims.at_most("midpoint: |L|²", midpoint.momentum_sq, 1e-10);
    claims.at_most("midpoint: L in the world", midpoint.momentum_in_world, 1e-10);
    claims.at_most("midpoint: Pfaffian", midpoint.pfaffian.unwrap_or(f64::NAN), 1e-10);
    claims.at_most("midpoint: Manakov's integrals", midpoint.manakov, 1e-10);
}

/// A spin of about the given rate with every plane in it.
fn skew_spin<const N: usize>(rate: f64) -> Bivector<N> {
    let values: Vec<f64> = (0..planes::count(N)).map(|k| [1.0, 0.6, -0.4, 0.5, -0.7, 0.3, 0.8][k % 7]).collect();
    let spin = Bivector::from_planes(&values).expect("one number per plane");
    spin * (rate / spin.norm())
}

fn blocks<const N: usize>(claims: &mut Claims) {
    let mut worst = 0.0_f64;
    // Every way to give two moments to the axes, up to exchange.
    for second in 1..1_usize << (N - 1) {
        let moments = Vector::<N>::from_fn(|i| if second >> i & 1 == 1 { 0.7 } else { 2.0 });
        let top = FreeTop::new(moments).expect("a body");
        let state = start(&top, &skew_spin(1.3));
        let exact = ExactMotion::new(&top, &state).expect("two moments").state_at(100.0);
        worst = worst.max(follow(&top, &state, Method::Splitting6, 100.0, 1e-3).final_state().distance(&exact));
    }
    claims.at_most(&format!("{N}D: attitude and momentum of splitting6 after 100 s, dt = 1/1000"), worst, 1e-9);
}

fn orders<const N: usize>(claims: &mut Claims) {
    let top = FreeTop::new(Vector::<N>::from_fn(|i| if i % 2 == 0 { 2.0 } else { 0.6 })).expect("a body");
    let state = start(&top, &skew_spin(1.5));
    let exact = ExactMotion::new(&top, &state).expect("two moments").state_at(4.0);
    let steps = [
        (Method::Explicit, 1e-4),
        (Method::Gyroscopic, 1e-4),
        (Method::Splitting2, 0.01),
        (Method::Midpoint, 0.01),
        (Method::Splitting4, 0.05),
        (Method::Splitting6, 0.1),
    ];
    for (method, dt) in steps {
        let error = |dt| follow(&top, &state, method, 4.0, dt).final_state().distance(&exact);
        let measured = (error(dt) / error(0.5 * dt)).log2();
        let stated = f64::from(method.order().expect("a stepping method"));
        let held = (measured - stated).abs() < 0.15;
        let what = format!("{N}D: order of convergence of {}", method.name());
        claims.holds(&what, &format!("{measured:.3}"), &format!("{stated}"), held);
    }
}

fn double(first: (usize, usize), a: f64, second: (usize, usize), b: f64) -> Bivector<4> {
    Bivector::plane(first.0, first.1, a) + Bivector::plane(second.0, second.1, b)
}

fn verdicts(claims: &mut Claims) {
    println!("\n3. Stability of double rotations, J = (4, 3, 2, 1)");
    let top = top_4321();
    for (first, second, b, expected) in [
        ((0, 1), (2, 3), 0.5, true),
        ((0, 2), (1, 3), 0.5, false),
        ((0, 3), (1, 2), 0.9587, false),
        ((0, 3), (1, 2), 0.9588, true),
    ] {
        let judged = stability(&top, &double(first, 1.0, second, b)).expect("a finite spin");
        let name = |(i, j)| planes::name(i, j);
        let what = format!("{} = 1 and {} = {b} rad/s", name(first), name(second));
        let say = |stable| if stable { "stable" } else { "unstable" };
        let found = judged.verdict.stable();
        claims.holds(&what, found.map_or("open", say), say(expected), found == Some(expected));
    }
    agreement(claims);
    let grows = |b: f64| {
        let rotation = PrincipalRotation::new(&double((0, 3), 1.0, (1, 2), b)).expect("disjoint planes");
        linearised_growth_rate(&top, &rotation) > 1e-3
    };
    let (mut low, mut high) = (0.5, 0.99);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if grows(middle) { low = middle } else { high = middle }
    }
    let off = (low / 0.958_702_311_072_570_3 - 1.0).abs();
    println!("threshold of |b/a| by bisection on measured growth: {low:.7}, exact 0.9587023");
    claims.at_most("relative error of that threshold", off, 5e-3);
    for (name, spin, exact) in [
        ("xz = 1", double((0, 2), 1.0, (1, 3), 0.0), 0.169_031),
        ("yw = 1", double((0, 2), 0.0, (1, 3), 1.0), 0.258_199),
        ("xw = 1", double((0, 3), 1.0, (1, 2), 0.0), 0.333_333),
        ("xz = 1, yw = 0.9", double((0, 2), 1.0, (1, 3), 0.9), stability_of(&top, "xz=1,yw=0.9")),
        ("xw = 1, yz = 0.9", double((0, 3), 1.0, (1, 2), 0.9), stability_of(&top, "xw=1,yz=0.9")),
    ] {
        let rotation = PrincipalRotation::new(&spin).expect("disjoint planes");
        let rate = perturbed_run(&top, &rotation, 1500.0).expect("a run").growth_rate;
        let what = format!("growth of a run disturbed by 1e-10, {name} rad/s");
        let limit = format!("{exact:.6} within 0.2 %");
        claims.holds(&what, &format!("{rate:.6}"), &limit, (rate / exact - 1.0).abs() < 2e-3);
    }
}

/// The growth rate from the eigenvalues, in 1/s.
fn stability_of(top: &FreeTop<4>, spin: &str) -> f64 {
    stability(top, &parse_spin(spin).expect("a spin")).expect("a finite spin").growth_rate
}

/// Verdicts and measured growth of ten thousand random bodies and double rotations (Knuth's MMIX generator).
fn agreement(claims: &mut Claims) {
    let mut seed = 2026_u64;
    let mut between = |low: f64, high: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((seed >> 11) as f64 / (1_u64 << 53) as f64)
    };
    let pairs = [[(0, 1), (2, 3)], [(0, 2), (1, 3)], [(0, 3), (1, 2)]];
    let (mut growing, mut disagree, mut worst) = (0, 0, 0.0_f64);
    for case in 0..10_000 {
        let top = FreeTop::<4>::new(Vector::from_fn(|_| between(0.05, 5.0))).expect("positive moments");
        let [first, second] = pairs[case % 3];
        let spin = double(first, between(-2.0, 2.0), second, between(-2.0, 2.0));
        let judged = stability(&top, &spin).expect("a finite spin");
        let measured = linearised_growth_rate(&top, &judged.rotation);
        if judged.growth_rate.max(measured) > 1e-3 {
            growing += 1;
            disagree += u32::from(judged.verdict != Verdict::Unstable || measured <= 0.0);
            worst = worst.max((measured - judged.growth_rate).abs());
        }
    }
    println!("{growing} of 10000 random cases grow at more than 1e-3 /s");
    claims.holds("verdicts that disagree with measured growth", &disagree.to_string(), "0", disagree == 0);
    claims.at_most("largest error of the measured rate, 1/s", worst, 1e-3);
}

fn jacobi(claims: &mut Claims) {
    println!("\n4. The wing nut: I = (1.7, 2.5, 3.2), spin (0.02, 1, 0.02) about x, y, z");
    let top = FreeTop::<3>::from_plane_moments(&[3.2, 2.5, 1.7]).expect("a body");
    let spin = Bivector::from_planes(&[0.02, -1.0, 0.02]).expect("three planes");
    let state = start(&top, &spin);
    let period = ExactMotion::new(&top, &state).expect("three axes").period().expect("periodic");
    println!("period {period:.12} s");
    claims.at_most(
        "relative error of the period against 66.40063581426978",
        (period / 66.400_635_814_269_78 - 1.0).abs(),
        1e-8,
    );
    let flips = follow(&top, &state, Method::Splitting6, 1000.0, 0.02).flips;
    let measured = flips.period.unwrap_or(f64::NAN);
    claims.at_most("relative error of the period measured on splitting6", (measured / period - 1.0).abs(), 1e-8);
    let expected = (1000.0 / (0.5 * period)) as usize;
    claims.holds(
        "flips in 1000 s",
        &flips.times.len().to_string(),
        &expected.to_string(),
        flips.times.len() == expected,
    );
    claims.at_most("irregularity of the time between flips", flips.irregularity.unwrap_or(f64::NAN), 1e-8);
}

/// Runs of figures 5 to 9: fifty minutes each, pushed by a thousandth in every plane that does not turn.
fn tumbling(claims: &mut Claims) {
    println!("\n5. Tumbling in four dimensions, J = (4, 3, 2, 1)");
    let top = top_4321();
    let pushed = |spin: &str| -> TopState<4> {
        let spin = parse_spin::<4>(spin).expect("a spin");
        let push = 1e-3 * spin.norm();
        start(&top, &Bivector::from_fn(|i, j| if spin.get(i, j) == 0.0 { push } else { spin.get(i, j) }))
    };
    let run = |spin: &str| follow(&top, &pushed(spin), Method::Splitting6, 3000.0, 0.02);
    let between = |times: &[f64]| -> (f64, f64) {
        let gaps = times.windows(2).map(|pair| pair[1] - pair[0]);
        gaps.fold((f64::INFINITY, 0.0), |(least, most), gap| (least.min(gap), most.max(gap)))
    };

    let clock = run("xz=1").flips;
    println!("xz = 1: {} flips, {:.4} s apart", clock.times.len(), 0.5 * clock.period.unwrap_or(f64::NAN));
    claims.at_most("xz = 1: irregularity of the flips", clock.irregularity.unwrap_or(f64::NAN), 1e-8);
    let three = FreeTop::<3>::new(Vector([4.0, 3.0, 2.0])).expect("a body");
    let spin = parse_spin::<3>("xz=1,xy=0.001,yz=0.001").expect("a spin");
    let exact = ExactMotion::new(&three, &start(&three, &spin)).expect("three axes").period().expect("periodic");
    let off = (clock.period.unwrap_or(f64::NAN) / exact - 1.0).abs();
    claims.at_most("its period against that of J = (4, 3, 2) by Jacobi's functions", off, 1e-3);

    let mut state = pushed("xz=1,yw=0.3");
    let mut detectors = [FlipDetector::new(0, 2), FlipDetector::new(1, 3)];
    for step in 0..150_000 {
        for detector in &mut detectors {
            detector.observe(&top, 0.02 * f64::from(step), &state.momentum_in_body);
        }
        Method::Splitting6.step(&top, &mut state, 0.02).expect("the splitting always succeeds");
    }
    let [first, second] = detectors.map(|detector| detector.flips().times);
    let apart = first.iter().zip(&second).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let counts = format!("{} and {}", first.len(), second.len());
    claims.holds("xz = 1, yw = 0.3: flips of xz and of yw", &counts, "equal", first.len() == second.len());
    claims.at_most("longest time from a flip of xz to that of yw, s", apart, 0.2);

    let irregular = run("xw=1").flips;
    let (least, most) = between(&irregular.times);
    let range = format!("{} flips, {least:.1} to {most:.1} s", irregular.times.len());
    claims.holds(
        "xw = 1: flips, and the time between them",
        &range,
        "5.6 to 57.9 s",
        (least, most) > (5.6, 57.9) && most < 58.0,
    );

    for (spin, reach) in [("xw=1,yz=0.9", 0.6), ("xw=1,yz=0.97", 0.04)] {
        let spins = run(spin).spins;
        let largest = |i: usize, j: usize| spins.iter().map(|spin| spin.get(i, j).abs()).fold(0.0, f64::max);
        let others = [(0, 1), (0, 2), (1, 3), (2, 3)].map(|(i, j)| largest(i, j)).into_iter().fold(0.0, f64::max);
        let slowest = spins.iter().map(|spin| spin.get(0, 3)).fold(f64::INFINITY, f64::min);
        println!("{spin}: xw never below {slowest:.3} rad/s");
        claims.at_most(&format!("{spin}: largest spin in any other plane, rad/s"), others, reach);
    }
}

fn speed(claims: &mut Claims) {
    println!("\n6. Speed on this machine");
    let top = top_4321();
    for (method, limit) in [(Method::Splitting2, 1.0), (Method::Splitting4, 4.0)] {
        let mut state = start(&top, &skew_spin(1.0));
        let clock = Instant::now();
        for _ in 0..1_000_000 {
            method.step(&top, &mut state, 1.0 / 240.0).expect("the splitting always succeeds");
        }
        let seconds = clock.elapsed().as_secs_f64();
        assert!(state.momentum_in_body.is_finite(), "the result has to be used");
        let what = format!("a million steps of one 4D top by {}, one thread", method.name());
        claims.holds(&what, &format!("{seconds:.3} s"), &format!("below {limit} s"), seconds < limit);
    }
    let range = MapRange::new(-1.5, 1.5, 400).expect("a range");
    let clock = Instant::now();
    let map = map_spins(&top, [(0, 3), (1, 2)], range, range, &|_, _| {}).expect("a map");
    let seconds = clock.elapsed().as_secs_f64();
    let what = format!("a stability map of {} cells, growth measured", map.cells.len());
    claims.holds(&what, &format!("{seconds:.2} s"), "below 60 s", seconds < 60.0);
}

fn main() -> ExitCode {
    let mut claims = Claims::default();
    conservation(&mut claims);
    println!("\n2. Block-symmetric bodies, all ways to share two moments; orders of convergence");
    blocks::<3>(&mut claims);
    blocks::<4>(&mut claims);
    blocks::<5>(&mut claims);
    blocks::<6>(&mut claims);
    orders::<3>(&mut claims);
    orders::<4>(&mut claims);
    orders::<5>(&mut claims);
    orders::<6>(&mut claims);
    verdicts(&mut claims);
    jacobi(&mut claims);
    tumbling(&mut claims);
    speed(&mut claims);
    if claims.missed > 0 {
        println!("\n{} figures missed", claims.missed);
        return ExitCode::FAILURE;
    }
    println!("\nall figures met");
    ExitCode::SUCCESS
}

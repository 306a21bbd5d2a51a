//! The closed forms against each other, against published numbers and against the sixth-order splitting.

use hyperbody_dynamics::free_top::{ExactMotion, FreeTop, Invariants, Method, TopState};
use hyperbody_math::{Bivector, Rotation, Vector, planes};

/// A spin of about the given rate with every plane in it.
fn skew_spin<const N: usize>(rate: f64) -> Bivector<N> {
    let values: Vec<f64> = (0..planes::count(N)).map(|k| [1.0, 0.6, -0.4, 0.5, -0.7, 0.3, 0.8][k % 7]).collect();
    let spin = Bivector::from_planes(&values).expect("one number per plane");
    spin * (rate / spin.norm())
}

fn start<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>) -> TopState<N> {
    TopState::from_spin(top, Rotation::exp(&skew_spin(0.8)), spin).expect("a finite spin")
}

/// The moment of inertia about an axis is that of the plane across it: planes xy, xz, yz belong to axes z, y, x.
fn top_from_axis_inertia(x: f64, y: f64, z: f64) -> FreeTop<3> {
    FreeTop::from_plane_moments(&[z, y, x]).expect("moments of a body")
}

fn spin_about(x: f64, y: f64, z: f64) -> Bivector<3> {
    Bivector::from_planes(&[z, -y, x]).expect("three planes")
}

fn follow<const N: usize>(top: &FreeTop<N>, state: &TopState<N>, seconds: f64, dt: f64) -> TopState<N> {
    let mut state = *state;
    for _ in 0..(seconds / dt).abs().round() as usize {
        Method::Splitting6.step(top, &mut state, dt.copysign(seconds)).expect("splitting always succeeds");
    }
    state
}

#[test]
fn the_published_dzhanibekov_period_is_reproduced() {
    let top = top_from_axis_inertia(1.7, 2.5, 3.2);
    let state = start(&top, &spin_about(0.02, 1.0, 0.02));
    let exact = ExactMotion::new(&top, &state).expect("three axes");
    let period = exact.period().expect("Jacobi's motion is periodic");
    assert!((period - 66.400_635_814_269_78).abs() < 1e-11, "period {period}");
    let after = exact.state_at(period);
    assert!((after.momentum_in_body - state.momentum_in_body).norm() < 1e-12, "the momentum returns after a period");
    let half = exact.state_at(0.5 * period);
    assert!((half.momentum_in_body.get(0, 2) + state.momentum_in_body.get(0, 2)).abs() < 1e-12, "and flips after half");
}

#[test]
fn jacobi_motion_agrees_with_the_splitting_in_every_regime() {
    let top = top_from_axis_inertia(1.7, 2.5, 3.2);
    let spins = [
        (0.02, 1.0, 0.02),
        (0.02, -1.0, -0.02),
        (1.0, 0.3, 0.1),
        (-1.0, 0.3, 0.1),
        (0.2, 0.1, 1.0),
        (0.2, -0.4, -1.0),
        (0.0, 0.5, 1.0),
        (0.6, 0.0, -0.5),
        (-0.7, 1.1, 0.3),
        (1e-7, 2.0, 1e-7),
    ];
    for (x, y, z) in spins {
        let state = start(&top, &spin_about(x, y, z));
        let exact = ExactMotion::new(&top, &state).expect("three axes");
        assert!(matches!(exact, ExactMotion::ThreeAxes(_)));
        let begin = exact.state_at(0.0).distance(&state);
        assert!(begin < 1e-13, "spin ({x}, {y}, {z}): the start is missed by {begin}");
        for seconds in [0.7, 9.0, 40.0] {
            let error = exact.state_at(seconds).distance(&follow(&top, &state, seconds, 0.005));
            assert!(error < 3e-11, "spin ({x}, {y}, {z}) after {seconds} s: off by {error}");
        }
        let back = exact.state_at(-3.0).distance(&follow(&top, &state, -3.0, 0.005));
        assert!(back < 3e-11, "spin ({x}, {y}, {z}) three seconds back: off by {back}");
    }
}

#[test]
fn the_separatrix_is_followed_to_its_end() {
    // L² = 2E I₂ exactly: J = (4, 2, 1) has I = (3, 5, 6), and I₁(I₂ − I₁)ω₁² = I₃(I₃ − I₂)ω₃² for ω₁ = ω₃.
    let top = FreeTop::new(Vector([4.0, 2.0, 1.0])).expect("a body");
    let state = start(&top, &spin_about(0.5, 0.0, 0.5));
    let exact = ExactMotion::new(&top, &state).expect("three axes");
    assert_eq!(exact.period(), Some(f64::INFINITY));
    let error = exact.state_at(4.0).distance(&follow(&top, &state, 4.0, 0.002));
    assert!(error < 1e-11, "off by {error}");
    let end = exact.state_at(200.0).spin_in_body(&top);
    assert!((end.get(0, 2).abs() / end.norm() - 1.0).abs() < 1e-14, "it ends in the middle plane, at {end:?}");
}

fn check_inside_more_dimensions<const N: usize>() {
    let top = FreeTop::new(Vector::<N>::from_fn(|i| (i as f64 + 1.0).sqrt())).expect("a body");
    let mut spin = Bivector::ZERO;
    spin.set(0, 2, 1.0);
    spin.set(0, N - 1, -0.4);
    spin.set(2, N - 1, 0.3);
    let state = start(&top, &spin);
    let exact = ExactMotion::new(&top, &state).expect("three axes");
    assert!(matches!(exact, ExactMotion::ThreeAxes(_)));
    let error = exact.state_at(20.0).distance(&follow(&top, &state, 20.0, 0.005));
    assert!(error < 1e-11, "{N}D: off by {error}");
}

#[test]
fn three_axes_are_solved_inside_more_dimensions() {
    check_inside_more_dimensions::<4>();
    check_inside_more_dimensions::<5>();
    check_inside_more_dimensions::<6>();
}

/// Every way to give two moments to the axes, up to exchange, for 100 s (10 s in short) against splitting 6.
fn check_blocks<const N: usize>(seconds: f64) {
    for second_block in 1..1_usize << (N - 1) {
        let moments = Vector::<N>::from_fn(|i| if second_block >> i & 1 == 1 { 0.7 } else { 2.0 });
        let top = FreeTop::new(moments).expect("a body");
        let state = start(&top, &skew_spin(1.3));
        let exact = ExactMotion::new(&top, &state).expect("two different moments");
        let found = exact.state_at(seconds);
        let error = found.distance(&follow(&top, &state, seconds, 1e-3));
        assert!(error < 1e-9, "{N}D, moments {moments:?}: off by {error} after {seconds} s");
        let (before, after) = (Invariants::of(&top, &state), Invariants::of(&top, &found));
        assert!((after.energy / before.energy - 1.0).abs() < 1e-12);
        assert!((after.momentum_in_world - before.momentum_in_world).norm() < 1e-12 * before.momentum_in_world.norm());
    }
}

#[test]
fn block_symmetric_bodies_match_their_closed_form() {
    check_blocks::<3>(3.0);
    check_blocks::<4>(3.0);
    check_blocks::<5>(1.0);
    check_blocks::<6>(0.5);
}

#[test]
#[ignore = "minutes in debug; run with --release -- --ignored"]
fn block_symmetric_bodies_match_their_closed_form_for_a_hundred_seconds() {
    check_blocks::<3>(100.0);
    check_blocks::<4>(100.0);
    check_blocks::<5>(100.0);
    check_blocks::<6>(100.0);
}

#[test]
fn where_two_closed_forms_apply_they_agree() {
    // Blocks (2, 2, 1) inside 4D with a fourth, different moment: three axes. Without it: blocks.
    let wide = FreeTop::new(Vector([2.0, 2.0, 1.0, 0.3])).expect("a body");
    let narrow = FreeTop::new(Vector([2.0, 2.0, 1.0])).expect("a body");
    let mut wide_spin = Bivector::<4>::ZERO;
    let narrow_spin = skew_spin::<3>(2.0);
    for (i, j) in planes::all(3) {
        wide_spin.set(i, j, narrow_spin.get(i, j));
    }
    let wide_start = TopState::from_spin(&wide, Rotation::IDENTITY, &wide_spin).expect("finite");
    let narrow_start = TopState::from_spin(&narrow, Rotation::IDENTITY, &narrow_spin).expect("finite");
    let three_axes = ExactMotion::new(&wide, &wide_start).expect("three axes");
    let blocks = ExactMotion::new(&narrow, &narrow_start).expect("blocks");
    assert!(matches!(three_axes, ExactMotion::ThreeAxes(_)) && matches!(blocks, ExactMotion::Blocks(_)));
    for t in [-7.0, 0.3, 5.0, 300.0] {
        let (a, b) = (three_axes.state_at(t), blocks.state_at(t));
        for i in 0..3 {
            for j in 0..3 {
                let difference = a.world_from_body.matrix()[i][j] - b.world_from_body.matrix()[i][j];
                assert!(difference.abs() < 1e-12, "attitudes differ by {difference} at {t} s");
            }
        }
    }
}

#[test]
fn a_general_spin_in_four_dimensions_has_no_closed_form_here() {
    let top = FreeTop::new(Vector([4.0, 3.0, 2.0, 1.0])).expect("a body");
    let error = ExactMotion::new(&top, &start(&top, &skew_spin(1.0))).expect_err("not solvable here");
    assert!(error.to_string().contains("splitting6"), "{error}");
    let steady = start(&top, &(Bivector::plane(0, 2, 1.0) + Bivector::plane(1, 3, 0.5)));
    assert!(matches!(ExactMotion::new(&top, &steady), Ok(ExactMotion::Steady(_))));
}

type Matrix = [[f64; 4]; 4];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

/// e^A by its series for A/2¹⁰, squared ten times.
fn exponential(a: &Matrix) -> Matrix {
    let small = a.map(|row| row.map(|entry| entry / 1024.0));
    let one: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    let (mut sum, mut term) = (one, one);
    for k in 1..16 {
        term = product(&term, &small).map(|row| row.map(|entry| entry / f64::from(k)));
        sum = std::array::from_fn(|i| std::array::from_fn(|j| sum[i][j] + term[i][j]));
    }
    (0..10).fold(sum, |power, _| product(&power, &power))
}

/// R(t) = e^{t(Ω₀ + rD)} e^{−rtD} with Ω₀ minus the matrix of spins, as docs/free-rotation.md has it.
#[test]
fn the_written_formula_of_block_symmetric_bodies_has_its_signs() {
    let top = FreeTop::new(Vector([2.0, 2.0, 1.0, 1.0])).expect("a body");
    let spin = Bivector::<4>::from_fn(|i, j| [0.7, 0.3, 0.2, -0.4, -0.5, 0.9][planes::index(4, i, j)]);
    let start = TopState::from_spin(&top, Rotation::IDENTITY, &spin).expect("a finite spin");
    let attitude = ExactMotion::new(&top, &start).expect("blocks").state_at(3.0).world_from_body;
    let r = (2.0 - 1.0) / (2.0 + 1.0);
    let by_sign = |sign: f64| {
        let omega: Matrix = std::array::from_fn(|i| {
            std::array::from_fn(|j| match i.cmp(&j) {
                std::cmp::Ordering::Less => sign * spin.get(i, j),
                std::cmp::Ordering::Equal => 0.0,
                std::cmp::Ordering::Greater => -sign * spin.get(j, i),
            })
        });
        let block = |i: usize, j: usize| match (i < 2, j < 2) {
            (true, true) => omega[i][j],
            (false, false) => -omega[i][j],
            _ => 0.0,
        };
        let outer = std::array::from_fn(|i| std::array::from_fn(|j| 3.0 * (omega[i][j] + r * block(i, j))));
        let inner = std::array::from_fn(|i| std::array::from_fn(|j| -3.0 * r * block(i, j)));
        let written = product(&exponential(&outer), &exponential(&inner));
        let off = |i: usize, j: usize| (written[i][j] - attitude.matrix().row(i)[j]).abs();
        (0..4).flat_map(|i| (0..4).map(move |j| (i, j))).map(|(i, j)| off(i, j)).fold(0.0, f64::max)
    };
    assert!(by_sign(-1.0) < 1e-12, "off by {}", by_sign(-1.0));
    assert!(by_sign(1.0) > 0.1, "the other sign is another motion");
}

//! The operators as matrices against the products they stand for.

mod common;

use common::dense::Dense;
use common::{Random, assert_within};
use hyperbody_math::{
    Bivector, BivectorOperator, Dim, EvenAlgebra, Matrix, Rotor, Vector, WedgeOperator, planes, symmetric_eigen,
};

mod every_dimension {
    crate::common::in_every_dimension!(wedge_and_contraction turning_bivectors inertia_of_point_masses turned_inertia
        response_to_an_impulse);
}

fn difference<const N: usize>(a: &BivectorOperator<N>, b: &BivectorOperator<N>) -> f64 {
    (a + &(b * -1.0)).max_abs()
}

/// r ∧ a = [r]⋆ a and r · ω = [r]⋆ᵀ ω, both sides also from the dense multivector product.
fn wedge_and_contraction<const N: usize>() {
    let mut random = Random::new(60);
    for _ in 0..50 {
        let (r, a, omega) = (random.vector::<N>(), random.vector(), random.bivector());
        let operator = WedgeOperator::new(r);
        assert_eq!(operator.rows().len(), N * (N - 1) / 2);
        let wedge = (&Dense::vector(r) * &Dense::vector(a)).grade(2).to_bivector();
        assert_eq!(operator.apply(a), wedge, "[r]⋆ a");
        let contraction = (&Dense::vector(r) * &Dense::bivector(&omega)).grade(1).to_vector();
        assert_within((operator.transpose_apply(&omega) - contraction).max_abs(), 1e-15, "[r]⋆ᵀ ω");
        assert_within((omega.act_on(r) - contraction).max_abs(), 1e-15, "r · ω");
    }
}

fn turning_bivectors<const N: usize>()
where
    Dim<N>: EvenAlgebra,
{
    let mut random = Random::new(61);
    for _ in 0..30 {
        let rotor = random.rotor::<N>();
        let rotation = rotor.to_rotation();
        let turning = BivectorOperator::turning(&rotation);
        let b = random.bivector();
        assert_within((turning.apply(&b) - rotor.rotate_bivector(&b)).norm(), 1e-14, "R B R~");
        assert_within((turning.apply(&b) - rotation.rotate_bivector(&b)).norm(), 1e-14, "by the matrix");
        let identity = BivectorOperator::diagonal(|_, _| 1.0);
        assert_within(difference(&(&turning * &turning.transpose()), &identity), 1e-14, "orthogonal");
        let second = random.rotor::<N>();
        let both = BivectorOperator::turning(&(second * rotor).to_rotation());
        let product = &BivectorOperator::turning(&second.to_rotation()) * &turning;
        assert_within(difference(&both, &product), 1e-14, "turns compose");
        // Column by column the images of the coordinate planes.
        for (column, (i, j)) in planes::all(N).enumerate() {
            let image = rotor.rotate_bivector(&Bivector::plane(i, j, 1.0));
            for (row, value) in image.planes().enumerate() {
                assert_within((turning.entry(row, column) - value).abs(), 4e-15, "entry");
            }
        }
    }
}

/// A cloud of point masses: L = Σ m r ∧ (r · ω), which in matrices is Σ m [r]⋆ [r]⋆ᵀ ω, and P = Σ m r rᵀ.
fn inertia_of_point_masses<const N: usize>() {
    let mut random = Random::new(62);
    let points: Vec<(f64, Vector<N>)> = (0..9).map(|_| (1.0 + random.signed(), random.vector())).collect();
    let second_moments = points.iter().fold(Matrix::ZERO, |sum, &(m, r)| sum + Matrix::outer(r, r) * m);
    let inertia = BivectorOperator::inertia(&second_moments);
    assert_within(difference(&inertia, &inertia.transpose()), 1e-14, "symmetric");
    for _ in 0..20 {
        let omega = random.bivector::<N>();
        let momentum = points.iter().fold(Bivector::ZERO, |sum, &(m, r)| sum + Bivector::wedge(r, omega.act_on(r)) * m);
        assert_within((inertia.apply(&omega) - momentum).norm(), 4e-14, "angular momentum of the points");
        let energy = points.iter().map(|&(m, r)| 0.5 * m * omega.act_on(r).norm_sq()).sum::<f64>();
        assert_within((0.5 * omega.dot(&inertia.apply(&omega)) - energy).abs(), 4e-14, "kinetic energy of the points");
    }
}

/// I′ = [R]₂ I [R]₂ᵀ is the inertia of the turned body, and principal axes make it diagonal with J_i + J_j.
fn turned_inertia<const N: usize>() {
    let mut random = Random::new(63);
    for _ in 0..20 {
        let m = random.matrix::<N>();
        let moments = m * m.transpose();
        let rotation = random.rotation::<N>();
        let r = *rotation.matrix();
        let inertia = BivectorOperator::inertia(&moments);
        let of_turned = BivectorOperator::inertia(&(r * moments * r.transpose()));
        assert_within(difference(&inertia.turned_by(&rotation), &of_turned), 4e-14, "I′");
        let (j, frame) = symmetric_eigen(&moments);
        let principal = BivectorOperator::diagonal(|i, k| j[i] + j[k]);
        assert_within(difference(&principal.turned_by(&frame), &inertia), 4e-14, "principal axes");
    }
}

/// K = 1/m + [r]⋆ᵀ I⁻¹ [r]⋆ gives the velocity that an impulse at r brings to r, as found by carrying it out.
fn response_to_an_impulse<const N: usize>() {
    let mut random = Random::new(64);
    for _ in 0..20 {
        let mass = 1.5 + random.signed();
        let moments = Vector::<N>::from_fn(|_| 1.5 + random.signed());
        let frame = random.rotation::<N>();
        let inverse_inertia = BivectorOperator::diagonal(|i, j| 1.0 / (moments[i] + moments[j])).turned_by(&frame);
        let (r, impulse) = (random.vector::<N>(), random.vector::<N>());
        let response = Matrix::IDENTITY * (1.0 / mass) + WedgeOperator::new(r).sandwich(&inverse_inertia);
        assert_within((response - response.transpose()).max_abs(), 1e-14, "symmetric");

        let in_body = frame.inverse_rotate_bivector(&Bivector::wedge(r, impulse));
        let spin = frame.rotate_bivector(&in_body.scale_planes(|i, j| 1.0 / (moments[i] + moments[j])));
        let velocity = impulse / mass + spin.act_on(r);
        assert_within((response * impulse - velocity).max_abs(), 1e-13, "velocity after the impulse");
        assert!(impulse.dot(response * impulse) > 0.0, "an impulse gains energy");
    }
}

/// In 4D about principal axes: six moments J_i + J_j in the order xy xz xw yz yw zw.
#[test]
fn six_moments_in_4d() {
    let inertia = BivectorOperator::<4>::inertia(&Matrix::from_diagonal(Vector([1.0, 2.0, 4.0, 8.0])));
    let diagonal: Vec<f64> = (0..6).map(|p| inertia.entry(p, p)).collect();
    assert_eq!(diagonal, [3.0, 5.0, 9.0, 6.0, 10.0, 12.0]);
    assert_eq!(inertia, BivectorOperator::diagonal(|i, j| f64::from((1u32 << i) + (1 << j))));
    let turned = inertia.turned_by(&Rotor::in_plane(0, 3, std::f64::consts::FRAC_PI_2).to_rotation());
    let diagonal = Vector::<6>::from_fn(|p| turned.entry(p, p));
    assert_within((diagonal - Vector([10.0, 12.0, 9.0, 6.0, 3.0, 5.0])).max_abs(), 4e-15, "x and w change places");
}

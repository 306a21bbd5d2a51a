//! Mass properties of rounded shapes, each against a second way to the same numbers.

use std::f64::consts::PI;
use std::sync::Arc;

use crate::common::Random;
use hyperbody_geometry::regular::{Size, polytope};
use hyperbody_geometry::{MassProperties, Polytope, Shape, volume};
use hyperbody_math::{Matrix, Pose, Vector};

#[track_caller]
fn assert_close<const N: usize>(found: &MassProperties<N>, expected: &MassProperties<N>, tolerance: f64) {
    let size = (expected.second_moments.trace() / expected.mass).sqrt();
    let moments = expected.second_moments.max_abs();
    assert!((found.mass / expected.mass - 1.0).abs() < tolerance, "mass {} for {}", found.mass, expected.mass);
    let centre = (found.centre - expected.centre).norm();
    assert!(centre < tolerance * size, "centre off by {centre} of {size}");
    let difference = (found.second_moments - expected.second_moments).max_abs();
    assert!(difference < tolerance * moments, "{:?} for {:?}", found.second_moments, expected.second_moments);
}

fn rounded<const N: usize>(points: &[Vector<N>], radius: f64) -> MassProperties<N> {
    let core = Shape::polytope(Arc::new(Polytope::from_points(points).unwrap())).unwrap();
    Shape::rounded(core, radius).unwrap().mass_properties(1.0).unwrap()
}

/// Thirteen nodes on [0, π/2] and their weights: Gauss–Legendre, by bisection between the roots of the polynomial before.
fn quarter_turn() -> Vec<(f64, f64)> {
    const POINTS: usize = 13;
    let legendre = |n: usize, x: f64| {
        let (mut previous, mut value) = (0.0, 1.0);
        for k in 1..=n {
            let k = k as f64;
            (previous, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k);
        }
        (value, previous)
    };
    let mut roots: Vec<f64> = vec![];
    for n in 1..=POINTS {
        let mut bounds = vec![-1.0];
        bounds.extend(&roots);
        bounds.push(1.0);
        roots = bounds
            .windows(2)
            .map(|pair| {
                let (mut low, mut high) = (pair[0], pair[1]);
                let sign = legendre(n, low).0.signum();
                for _ in 0..100 {
                    let middle = 0.5 * (low + high);
                    if legendre(n, middle).0 * sign > 0.0 { low = middle } else { high = middle }
                }
                0.5 * (low + high)
            })
            .collect();
    }
    let weight = |x: f64| 2.0 * (1.0 - x * x) / (POINTS as f64 * legendre(POINTS, x).1).powi(2);
    roots.iter().map(|&x| (PI / 4.0 * (1.0 + x), PI / 4.0 * weight(x))).collect()
}

/// Volume, and ∫x² along axes `a` and `b`, of the box with the first `n` half-extents rounded by `radius`: by slices
/// orthogonal to the last axis, which are smaller rounded boxes.
fn by_slices(rule: &[(f64, f64)], half_extents: &[f64], radius: f64, a: usize, b: usize) -> [f64; 3] {
    let Some((&h, rest)) = half_extents.split_last() else {
        return [1.0, 0.0, 0.0];
    };
    let axis = rest.len();
    let slice = |x: f64, slice_radius: f64, width: f64| {
        let mut part = by_slices(rule, rest, slice_radius, a, b).map(|v| v * width);
        for (slot, which) in [(1, a), (2, b)] {
            if which == axis {
                part[slot] = part[0] * x * x;
            }
        }
        part
    };
    if rest.is_empty() {
        let length = h + radius;
        let square = |which: usize| if which == axis { 2.0 * length.powi(3) / 3.0 } else { 0.0 };
        return [2.0 * length, square(a), square(b)];
    }
    // The middle part has one slice all along, whose x² has the mean h²/3; the two caps are x = h + r sin θ.
    let mut sum = slice(h / 3_f64.sqrt(), radius, 2.0 * h);
    for &(angle, weight) in rule {
        let (sin, cos) = angle.sin_cos();
        let cap = slice(h + radius * sin, radius * cos, 2.0 * weight * radius * cos);
        sum = std::array::from_fn(|i| sum[i] + cap[i]);
    }
    sum
}

fn boxes<const N: usize>() {
    let extents = Vector::<N>::from_fn(|i| [0.5, 0.3, 0.8, 0.2, 0.6, 0.4][i]);
    let radius = 0.25;
    let rule = quarter_turn();
    let found = Shape::rounded(Shape::cuboid(extents).unwrap(), radius).unwrap().mass_properties(1.0).unwrap();
    let [content, first, last] = by_slices(&rule, extents.as_slice(), radius, 0, N - 1);
    assert!((found.mass / content - 1.0).abs() < 1e-10, "{} for {content}", found.mass);
    assert!((found.second_moments[0][0] / first - 1.0).abs() < 1e-10);
    assert!((found.second_moments[N - 1][N - 1] / last - 1.0).abs() < 1e-10);
    // A capsule is a rounded box of no width, a ball one of no length either.
    let flat = |h: f64| Vector::<N>::unit(0) * h;
    let capsule = Shape::<N>::capsule(0.7, radius, 0).unwrap().mass_properties(1.0).unwrap();
    let [content, along, across] = by_slices(&rule, flat(0.7).as_slice(), radius, 0, 1);
    assert!((capsule.mass / content - 1.0).abs() < 1e-10);
    assert!((capsule.second_moments[0][0] / along - 1.0).abs() < 1e-10);
    assert!((capsule.second_moments[1][1] / across - 1.0).abs() < 1e-10);
    let ball = Shape::<N>::ball(radius).unwrap().mass_properties(1.0).unwrap();
    let [content, along, _] = by_slices(&rule, flat(0.0).as_slice(), radius, 0, 1);
    assert!((ball.mass / content - 1.0).abs() < 1e-10);
    assert!((ball.second_moments[0][0] / along - 1.0).abs() < 1e-10);
    // The polytope with the same corners, turned and moved.
    let mut random = Random(600 + N as u64);
    let pose = Pose::new(random.rotation(), random.vector() * 2.0);
    let corners: Vec<Vector<N>> =
        crate::common::cube().iter().map(|c| pose.transform_point(extents.scale(*c))).collect();
    assert_close(&self::rounded(&corners, radius), &found.transformed(&pose), 1e-11);
}

#[test]
fn rounded_boxes_capsules_and_balls_are_the_sum_of_their_slices() {
    boxes::<2>();
    boxes::<3>();
    boxes::<4>();
    boxes::<5>();
    boxes::<6>();
}

/// Corners of the box that satisfy normal·p ≤ offset, and the points where its edges cross the plane.
fn cut_box<const N: usize>(corners: &[Vector<N>], normal: Vector<N>, offset: f64) -> Vec<Vector<N>> {
    let height = |p: Vector<N>| normal.dot(p) - offset;
    let mut points: Vec<Vector<N>> = corners.iter().copied().filter(|&c| height(c) <= 0.0).collect();
    for (i, &a) in corners.iter().enumerate() {
        for axis in 0..N {
            let b = corners[i ^ (1 << axis)];
            if height(a) < 0.0 && height(b) > 0.0 {
                points.push(a.lerp(b, height(a) / (height(a) - height(b))));
            }
        }
    }
    points
}

fn add<const N: usize>(a: &MassProperties<N>, b: &MassProperties<N>, sign: f64) -> MassProperties<N> {
    let b = MassProperties { mass: b.mass * sign, second_moments: b.second_moments * sign, ..*b };
    MassProperties::combined(&[*a, b]).unwrap()
}

/// Rounding is a valuation: where the union of two convex bodies A and B is convex, A and B rounded count as much as
/// A ∪ B and A ∩ B rounded, point by point. With a box cut by two oblique planes, all dihedral angles come in.
fn valuation<const N: usize>() {
    let mut random = Random(700 + N as u64);
    let extents = Vector::<N>::from_fn(|i| 1.0 - 0.1 * i as f64);
    let corners: Vec<Vector<N>> = crate::common::cube().iter().map(|c| extents.scale(*c)).collect();
    let normal = random.direction::<N>();
    let lower = cut_box(&corners, normal, 0.17);
    let upper = cut_box(&corners, -normal, 0.11);
    let both: Vec<Vector<N>> = {
        // The slab between the planes: cut what is left of each edge twice.
        let mut points: Vec<Vector<N>> = lower.iter().chain(&upper).copied().collect();
        points.retain(|&p| normal.dot(p) <= 0.17 + 1e-12 && normal.dot(p) >= -0.11 - 1e-12);
        points
    };
    for radius in [0.05, 1.5] {
        let parts = add(&rounded(&lower, radius), &rounded(&upper, radius), 1.0);
        let whole = add(&parts, &rounded(&both, radius), -1.0);
        let expected = Shape::rounded(Shape::cuboid(extents).unwrap(), radius).unwrap().mass_properties(1.0).unwrap();
        assert_close(&whole, &expected, 1e-9);
    }
}

#[test]
fn rounding_is_a_valuation() {
    valuation::<2>();
    valuation::<3>();
    valuation::<4>();
    valuation::<5>();
    valuation::<6>();
}

/// Steiner's formula at its two ends, for hulls of random points: a tiny radius adds surface times radius, and a huge
/// one leaves a ball, with all solid angles adding up to the full one.
fn ends<const N: usize>() {
    let mut random = Random(800 + N as u64);
    let points = random.points::<N>(N + 4);
    let core = MassProperties::of_polytope(&Polytope::from_points(&points).unwrap());
    let thin = rounded(&points, 4e-6);
    let thinner = rounded(&points, 2e-6);
    let (first, second) = (thin.mass - core.mass, thinner.mass - core.mass);
    assert!((first / second - 2.0).abs() < 1e-4, "{first} {second}");
    let radius = 1e3;
    let large = rounded(&points, radius);
    // V(r) = ω r^N + (mean width) r^(N−1) + …; two radii give the first term to 1e-6.
    let larger = rounded(&points, 2.0 * radius);
    let scaled = |p: &MassProperties<N>, r: f64| p.mass / (volume::unit_ball(N) * r.powi(N as i32));
    let limit = 2.0 * scaled(&larger, 2.0 * radius) - scaled(&large, radius);
    assert!((limit - 1.0).abs() < 1e-4, "{limit}");
    let expected = Matrix::<N>::IDENTITY * (radius * radius / (N as f64 + 2.0));
    assert!((large.second_moments * (1.0 / large.mass) - expected).max_abs() < 0.01 * radius * radius);
}

#[test]
fn rounding_by_little_and_by_much() {
    ends::<2>();
    ends::<3>();
    ends::<4>();
    ends::<5>();
    ends::<6>();
}

/// Steiner's formula with edge lengths and outer angles known in closed form.
#[test]
fn rounded_solids_have_their_volume() {
    let (edge, r) = (1.2_f64, 0.3);
    let round = |name: &str| {
        let core = Shape::polytope(polytope::<3>(name, Size::Edge(edge)).unwrap().into()).unwrap();
        Shape::rounded(core, r).unwrap().mass_properties(1.0).unwrap().mass
    };
    let ball = 4.0 / 3.0 * PI * r.powi(3);
    let steiner = |solid: f64, surface: f64, edges: f64, dihedral: f64| {
        solid + surface * r + edges * edge * (PI - dihedral) / 2.0 * r * r + ball
    };
    let root_2 = 2_f64.sqrt();
    let tetrahedron = steiner(edge.powi(3) / (6.0 * root_2), 3_f64.sqrt() * edge * edge, 6.0, (1.0_f64 / 3.0).acos());
    assert!((round("tetrahedron") / tetrahedron - 1.0).abs() < 1e-12);
    let octahedron =
        steiner(root_2 / 3.0 * edge.powi(3), 2.0 * 3_f64.sqrt() * edge * edge, 12.0, (-1.0_f64 / 3.0).acos());
    assert!((round("octahedron") / octahedron - 1.0).abs() < 1e-12);
    // In the plane: area + perimeter · r + π r².
    let core = Shape::polytope(polytope::<2>("square", Size::Edge(edge)).unwrap().into()).unwrap();
    let square = Shape::rounded(core, r).unwrap().mass_properties(1.0).unwrap().mass;
    assert!((square - (edge * edge + 4.0 * edge * r + PI * r * r)).abs() < 1e-13);
}

/// A tesseract as files bring it: turned, with noise of this size.
fn noisy_tesseract(noise: f64, random: &mut Random) -> Vec<Vector<4>> {
    let turn = random.rotation::<4>();
    let corner = |k: usize| Vector::from_fn(|i| if k >> i & 1 == 1 { 1.0 } else { -1.0 });
    (0..16).map(|k| turn.rotate(corner(k)) + Vector::from_fn(|_| noise * random.symmetric())).collect()
}

/// Facets that noise has split have normal cones too narrow to be measured: volumes of -1e129 came of them, and integrals without end.
#[test]
fn noise_in_the_vertices_is_noise_in_the_mass() {
    let mut random = Random(11);
    let exact = Shape::rounded(Shape::cuboid(Vector([1.0; 4])).unwrap(), 0.2).unwrap().mass_properties(1.0).unwrap();
    for noise in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-12] {
        let start = std::time::Instant::now();
        let found = rounded(&noisy_tesseract(noise, &mut random), 0.2);
        let error = (found.mass / exact.mass - 1.0).abs();
        println!("noise {noise:e}: volume off by {error:.1e}, {:.1?}", start.elapsed());
        assert!(error < 10.0 * noise + 1e-9, "noise {noise:e}: {}", found.mass);
        let (moments, _) = found.principal();
        let (expected, _) = exact.principal();
        assert!(
            moments.iter().zip(expected.iter()).all(|(a, b)| (a / b - 1.0).abs() < 20.0 * noise + 1e-9),
            "{moments:?}"
        );
    }
}

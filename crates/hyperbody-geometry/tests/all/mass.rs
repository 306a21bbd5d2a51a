//! Mass properties against closed forms and against a second way to each number.

use crate::common::Random;
use hyperbody_geometry::regular::{Size, names, polytope};
use hyperbody_geometry::{GeometryErrorKind, MassProperties, Polytope, Shape, volume};
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

fn diagonal<const N: usize>(mass: f64, moments_per_mass: Vector<N>) -> MassProperties<N> {
    let second_moments = Matrix::from_diagonal(moments_per_mass * mass);
    MassProperties { mass, centre: Vector::ZERO, second_moments }
}

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

fn regular<const N: usize>(name: &str, size: Size, volume: f64, moment: f64) {
    let shape = Shape::polytope(polytope::<N>(name, size).unwrap().into()).unwrap();
    assert_close(&shape.mass_properties(1.0).unwrap(), &diagonal(volume, Vector::splat(moment)), 1e-12);
    assert_close(&shape.mass_properties(7.0).unwrap(), &diagonal(7.0 * volume, Vector::splat(moment)), 1e-12);
}

fn closed_forms<const N: usize>() {
    let n = N as f64;
    let (edge, radius) = (1.3_f64, 0.7_f64);
    let simplex = edge.powi(N as i32) / factorial(N) * ((n + 1.0) / 2_f64.powi(N as i32)).sqrt();
    regular::<N>("simplex", Size::Edge(edge), simplex, edge * edge / (2.0 * (n + 1.0) * (n + 2.0)));
    regular::<N>("hypercube", Size::Edge(edge), edge.powi(N as i32), edge * edge / 12.0);
    let cross = (2.0 * radius).powi(N as i32) / factorial(N);
    regular::<N>("orthoplex", Size::Circumradius(radius), cross, 2.0 * radius * radius / ((n + 1.0) * (n + 2.0)));
    let ball = Shape::<N>::ball(radius).unwrap().mass_properties(3.0).unwrap();
    let ball_volume = volume::unit_ball(N) * radius.powi(N as i32);
    assert_close(&ball, &diagonal(3.0 * ball_volume, Vector::splat(radius * radius / (n + 2.0))), 1e-14);
    let half_extents = Vector::<N>::from_fn(|i| 0.3 + 0.2 * i as f64);
    let cuboid = Shape::cuboid(half_extents).unwrap().mass_properties(2.0).unwrap();
    let content: f64 = half_extents.iter().map(|h| 2.0 * h).product();
    assert_close(&cuboid, &diagonal(2.0 * content, half_extents.scale(half_extents) / 3.0), 1e-14);
}

#[test]
fn solids_have_the_moments_of_the_table() {
    closed_forms::<2>();
    closed_forms::<3>();
    closed_forms::<4>();
    closed_forms::<5>();
    closed_forms::<6>();
    let root_5 = 5_f64.sqrt();
    // Icosahedron and dodecahedron of edge one: moments of inertia (φ²/10 and (39φ+28)/150) are twice J.
    let phi = (1.0 + root_5) / 2.0;
    regular::<3>("icosahedron", Size::Edge(1.0), 5.0 * (3.0 + root_5) / 12.0, phi * phi / 20.0);
    regular::<3>("dodecahedron", Size::Edge(1.0), (15.0 + 7.0 * root_5) / 4.0, (39.0 * phi + 28.0) / 300.0);
    let unit = Size::Circumradius(1.0);
    regular::<4>("24-cell", unit, 2.0, 13.0 / 120.0);
    // A 4-polytope of congruent cells with moment J₃ at inradius ρ is a sum of pyramids: J = (ρ² + 3 J₃)/6. With edge a
    // the 120-cell has volume 15/4 (105 + 47√5) a⁴ and the 600-cell 25/4 (2 + √5) a⁴ (Coxeter, table I).
    let edge = 1.0 / (phi * phi * 2_f64.sqrt());
    let inradius_sq = phi.powi(4) / 8.0;
    let volume = 15.0 / 4.0 * (105.0 + 47.0 * root_5) * edge.powi(4);
    regular::<4>("120-cell", unit, volume, (inradius_sq + (39.0 * phi + 28.0) / 100.0 * edge * edge) / 6.0);
    let edge = 1.0 / phi;
    let inradius_sq = 1.0 - 3.0 / 8.0 * edge * edge;
    let volume = 25.0 / 4.0 * (2.0 + root_5) * edge.powi(4);
    regular::<4>("600-cell", unit, volume, (inradius_sq + 3.0 / 40.0 * edge * edge) / 6.0);
    for p in [3_u32, 5, 6, 100] {
        let (sin, cos) = (std::f64::consts::TAU / f64::from(p)).sin_cos();
        regular::<2>(&format!("{{{p}}}"), unit, f64::from(p) / 2.0 * sin, (2.0 + cos) / 12.0);
    }
}

/// The same moments by pyramids from one vertex instead of the middle, and by a rule of points (corners and centre of
/// each simplex, exact for quadratics) instead of a formula.
fn subdivided<const N: usize>(polytope: &Polytope<N>) -> MassProperties<N> {
    let origin = polytope.vertices()[0];
    let (mut mass, mut first, mut second) = (0.0, Vector::ZERO, Matrix::ZERO);
    for simplex in polytope.boundary_simplices() {
        let corners = simplex.map(|v| polytope.vertices()[v as usize] - origin);
        let content = Matrix::from_columns(corners).determinant() / factorial(N);
        let n = N as f64;
        let centre = corners.iter().fold(Vector::ZERO, |sum, &c| sum + c) / (n + 1.0);
        let mut add = |p: Vector<N>, weight: f64| {
            mass += weight;
            first += p * weight;
            second += Matrix::outer(p, p) * weight;
        };
        let corner_weight = content / ((n + 1.0) * (n + 2.0));
        for corner in corners.into_iter().chain([Vector::ZERO]) {
            add(corner, corner_weight);
        }
        add(centre, content * (n + 1.0) / (n + 2.0));
    }
    let centre = first / mass;
    MassProperties { mass, centre: origin + centre, second_moments: second - Matrix::outer(centre, centre) * mass }
}

fn random_hulls<const N: usize>() {
    let mut random = Random(400 + N as u64);
    for count in [N + 1, N + 4, 40, 200] {
        let points = random.points::<N>(count);
        let polytope = Polytope::from_points(&points).unwrap();
        let properties = MassProperties::of_polytope(&polytope);
        assert_close(&subdivided(&polytope), &properties, 1e-11);
        let boundary = polytope.boundary_simplices();
        assert_close(&MassProperties::of_closed_boundary(polytope.vertices(), &boundary).unwrap(), &properties, 1e-11);
        // Turned, moved, scaled and shuffled.
        let pose = Pose::new(random.rotation(), random.vector() * 10.0);
        let mut moved: Vec<Vector<N>> = points.iter().map(|&p| pose.transform_point(p)).collect();
        random.shuffle(&mut moved);
        let moved = Polytope::from_points(&moved).unwrap();
        assert_close(&MassProperties::of_polytope(&moved), &properties.transformed(&pose), 1e-11);
        let scaled = MassProperties::of_polytope(&polytope.scaled(3.0).unwrap());
        let factor = 3_f64.powi(N as i32);
        let expected = MassProperties {
            mass: properties.mass * factor,
            centre: properties.centre * 3.0,
            second_moments: properties.second_moments * (factor * 9.0),
        };
        assert_close(&scaled, &expected, 1e-12);
        let recentred = MassProperties::of_polytope(&polytope.translated(-properties.centre));
        assert!(recentred.centre.norm() < 1e-13);
        // Principal axes put the matrix together again.
        let (moments, body_from_principal) = properties.principal();
        let r = *body_from_principal.matrix();
        let rebuilt = r * Matrix::from_diagonal(moments) * r.transpose();
        assert!((rebuilt - properties.second_moments).max_abs() < 1e-14 * properties.second_moments.max_abs().max(1.0));
        assert!((1..N).all(|i| moments[i] <= moments[i - 1] && moments[i] > 0.0));
    }
}

#[test]
fn hulls_of_random_points_agree_with_a_second_decomposition() {
    random_hulls::<2>();
    random_hulls::<3>();
    random_hulls::<4>();
    random_hulls::<5>();
    random_hulls::<6>();
}

/// A box cut into 2^N boxes, put together again.
fn compounds<const N: usize>() {
    let mut random = Random(500 + N as u64);
    let half_extents = Vector::<N>::from_fn(|i| 0.4 + 0.1 * i as f64);
    let outer = Pose::new(random.rotation(), random.vector() * 3.0);
    let parts = crate::common::cube::<N>()
        .into_iter()
        .map(|corner| {
            let place = outer * Pose::from_translation(corner.scale(half_extents) * 0.5);
            (place, Shape::cuboid(half_extents * 0.5).unwrap())
        })
        .collect();
    let compound = Shape::compound(parts).unwrap().mass_properties(2.0).unwrap();
    let whole = Shape::cuboid(half_extents).unwrap().mass_properties(2.0).unwrap().transformed(&outer);
    assert_close(&compound, &whole, 1e-13);
}

#[test]
fn compounds_add_up() {
    compounds::<2>();
    compounds::<3>();
    compounds::<4>();
    compounds::<5>();
    compounds::<6>();
}

fn non_convex<const N: usize>() {
    // A cube with a smaller cube cut out of its inside, whose boundary faces the other way.
    let outer = polytope::<N>("hypercube", Size::Edge(2.0)).unwrap();
    let inner = polytope::<N>("hypercube", Size::Edge(0.5)).unwrap().translated(Vector::splat(0.2));
    let mut points = outer.vertices().to_vec();
    points.extend_from_slice(inner.vertices());
    let mut simplices = outer.boundary_simplices();
    let shift = outer.vertices().len() as u32;
    for mut simplex in inner.boundary_simplices() {
        simplex.swap(0, 1);
        simplices.push(simplex.map(|v| v + shift));
    }
    let hollow = MassProperties::of_closed_boundary(&points, &simplices).unwrap();
    let filled = MassProperties::combined(&[hollow, MassProperties::of_polytope(&inner)]).unwrap();
    assert_close(&filled, &MassProperties::of_polytope(&outer), 1e-12);
    // All turned around it is the same body; one simplex turned or missing is no body.
    let mut reversed = simplices.clone();
    reversed.iter_mut().for_each(|simplex| simplex.swap(0, 1));
    assert_close(&MassProperties::of_closed_boundary(&points, &reversed).unwrap(), &hollow, 1e-12);
    simplices[3].swap(0, 1);
    let bad = |simplices: &[[u32; N]]| {
        let error = MassProperties::<N>::of_closed_boundary(&points, simplices).unwrap_err();
        assert_eq!(error.kind(), GeometryErrorKind::BadMesh, "{error}");
    };
    bad(&simplices);
    simplices.remove(3);
    bad(&simplices);
    bad(&[[u32::MAX; N]]);
    bad(&[[0; N]]);
    bad(&[]);
}

#[test]
fn meshes_may_be_hollow_but_not_open() {
    non_convex::<2>();
    non_convex::<3>();
    non_convex::<4>();
    non_convex::<5>();
    non_convex::<6>();
}

#[test]
fn bad_densities_and_infinite_bodies_are_refused() {
    let ball = Shape::<4>::ball(1.0).unwrap();
    for density in [f64::NAN, 0.0, -1.0, f64::INFINITY, f64::MAX, f64::MIN_POSITIVE * f64::EPSILON] {
        let error = ball.mass_properties(density).unwrap_err();
        assert_eq!(error.kind(), GeometryErrorKind::BadNumber, "{density}");
    }
    let floor = Shape::<4>::half_space(Vector::unit(1), 0.0).unwrap();
    assert_eq!(floor.mass_properties(1.0).unwrap_err().kind(), GeometryErrorKind::Unsupported);
    assert_eq!(MassProperties::<3>::combined(&[]).unwrap_err().kind(), GeometryErrorKind::BadCount);
    assert!(!names(4).is_empty());
}

//! Pyramids and cones against closed forms, and against simplices and cross-polytopes, which are pyramids too.

use std::f64::consts::PI;

use crate::common::Random;
use hyperbody_geometry::product::Factor;
use hyperbody_geometry::regular::{Size, polytope};
use hyperbody_geometry::{GeometryErrorKind, MassProperties, Polytope, Shape, SliceFrame, SupportMap, volume};
use hyperbody_math::{Matrix, Vector};

/// A base on the axes 0, 1, … without axis 1.
fn base<const K: usize>(shape: &Shape<K>) -> Factor {
    Factor::new(std::array::from_fn(|i| if i == 0 { 0 } else { i + 1 }), shape).unwrap()
}

/// Closed forms per unit mass for a cone over a ball: J = r²/(K+2) · N/(N+2) across, and h² N/((N+1)²(N+2)) along the height.
fn cones<const N: usize, const K: usize>() {
    let (radius, height) = (0.6, 0.9);
    let cone = Shape::<N>::pyramid(base(&Shape::<K>::ball(radius).unwrap()), height).unwrap();
    let mass = cone.mass_properties(1.0).unwrap();
    let n = N as f64;
    let content = volume::unit_ball(K) * radius.powi(K as i32) * height / n;
    assert!((mass.mass / content - 1.0).abs() < 1e-13);
    assert!((mass.centre - Vector::unit(1) * (height / (n + 1.0) - 0.5 * height)).norm() < 1e-14);
    let across = radius * radius / (n + 1.0) * n / (n + 2.0);
    let along = height * height * n / ((n + 1.0).powi(2) * (n + 2.0));
    let expected = Matrix::from_fn(|i, j| match (i, j) {
        (1, 1) => along,
        _ if i == j => across,
        _ => 0.0,
    });
    assert!((mass.second_moments * (1.0 / content) - expected).max_abs() < 1e-13, "N = {N}");
    // Parallel to the base the sections are balls.
    for share in [0.25, 0.5, 0.9] {
        let frame = SliceFrame::from_normal(Vector::<N>::unit(1), (0.5 - share) * height).unwrap();
        let ball = volume::unit_ball(K) * (share * radius).powi(K as i32);
        assert!((cone.section_volume(&frame, 1e-10).unwrap() / ball - 1.0).abs() < 1e-9, "N = {N}");
    }
}

#[test]
fn cones_have_the_closed_forms() {
    cones::<3, 2>();
    cones::<4, 3>();
    cones::<5, 4>();
}

/// The section function of cones against their supports, which know nothing of it, and integrated against the volume.
#[test]
fn sections_of_cones_add_up_and_agree_with_their_supports() {
    #[derive(Debug)]
    struct Plain(std::sync::Arc<hyperbody_geometry::pyramid::Pyramid<3>>);
    impl SupportMap<3> for Plain {
        fn support(&self, direction: Vector<3>) -> Vector<3> {
            self.0.support(direction)
        }
    }
    let mut random = Random(600);
    let cone = Shape::<3>::pyramid(base(&Shape::<2>::ball(0.6).unwrap()), 0.9).unwrap();
    let Shape::Pyramid(pyramid) = &cone else { panic!("not curved") };
    let plain = Plain(std::sync::Arc::clone(pyramid));
    for _ in 0..40 {
        let (normal, offset) = (random.direction::<3>(), 0.4 * random.symmetric());
        let frame = SliceFrame::from_normal(normal, offset).unwrap();
        let (found, expected) =
            (cone.section_volume(&frame, 1e-9).unwrap(), plain.section_volume(normal, offset, 1e-9));
        assert!((found - expected).abs() < 1e-7, "{found} for {expected}");
    }
    let four = Shape::<4>::pyramid(base(&Shape::<3>::capsule(0.4, 0.3, 1).unwrap()), 0.9).unwrap();
    let expected = four.mass_properties(1.0).unwrap().mass;
    let normal = random.direction::<4>();
    let solid = four.solids().remove(0);
    let (low, high) = (-solid.reach(-normal), solid.reach(normal));
    let steps = 400;
    let term = |k: i32| {
        let t = f64::from(k) / f64::from(steps);
        let offset = low + (high - low) * (t - (2.0 * PI * t).sin() / (2.0 * PI));
        let frame = SliceFrame::from_normal(normal, offset).unwrap();
        solid.section_volume(&frame, 1e-8).unwrap() * (high - low) * (1.0 - (2.0 * PI * t).cos()) / f64::from(steps)
    };
    let sum: f64 = (1..steps).map(term).sum();
    println!("4D cone over a capsule: the sections add up to the volume to {:.1e}", (sum / expected - 1.0).abs());
    assert!((sum / expected - 1.0).abs() < 1e-6, "{sum} for {expected}");
}

fn over_polytopes<const N: usize, const K: usize>() {
    // A regular simplex is the pyramid over the one below, with the height √((N+1)/(2N)) of the edge.
    let edge = 0.8;
    let below = Shape::<K>::polytope(polytope("simplex", Size::Edge(edge)).unwrap().into()).unwrap();
    let height = edge * ((N as f64 + 1.0) / (2.0 * N as f64)).sqrt();
    let Shape::Polytope(pyramid) = Shape::<N>::pyramid(base(&below), height).unwrap() else { panic!("not flat") };
    let simplex: Polytope<N> = polytope("simplex", Size::Edge(edge)).unwrap();
    assert_eq!(pyramid.face_lattice().face_counts(), simplex.face_lattice().face_counts());
    let (found, expected) = (MassProperties::of_polytope(&pyramid), MassProperties::of_polytope(&simplex));
    assert!((found.mass / expected.mass - 1.0).abs() < 1e-12);
    for (a, b) in found.principal().0.iter().zip(expected.principal().0.iter()) {
        assert!((a / b - 1.0).abs() < 1e-11, "{a} {b}");
    }
    // A pyramid over a cube has the faces of the cube, one more for each, and the apex.
    let cube = Shape::<K>::cuboid(Vector::splat(0.5)).unwrap();
    let Shape::Polytope(pyramid) = Shape::<N>::pyramid(base(&cube), 1.0).unwrap() else { panic!("not flat") };
    let counts = pyramid.face_lattice().face_counts();
    assert_eq!((counts[0], counts[N - 1]), ((1 << K) + 1, 2 * K + 1));
    assert!((MassProperties::of_polytope(&pyramid).mass - 1.0 / N as f64).abs() < 1e-14);
}

#[test]
fn pyramids_over_polytopes_are_polytopes() {
    over_polytopes::<3, 2>();
    over_polytopes::<4, 3>();
    over_polytopes::<5, 4>();
    over_polytopes::<6, 5>();
}

#[test]
fn bases_that_do_not_fit_are_refused() {
    let disc = || Factor::new([0, 1], &Shape::<2>::ball(0.5).unwrap()).unwrap();
    assert_eq!(Shape::<4>::pyramid(disc(), 1.0).unwrap_err().kind(), GeometryErrorKind::BadCount);
    assert_eq!(Shape::<2>::pyramid(disc(), 1.0).unwrap_err().kind(), GeometryErrorKind::BadCount);
    for bad in [0.0, -1.0, f64::NAN] {
        assert_eq!(Shape::<3>::pyramid(disc(), bad).unwrap_err().kind(), GeometryErrorKind::BadNumber);
    }
}

//! Products: faces, mass, supports and sections against closed forms.

use std::f64::consts::PI;

use crate::common::Random;
use hyperbody_geometry::product::Factor;
use hyperbody_geometry::regular::{Size, polytope};
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Core, GeometryErrorKind, MassProperties, Polytope, Shape, SliceFrame, Solid};
use hyperbody_math::Vector;

fn disc(axes: [usize; 2], radius: f64) -> Factor {
    Factor::new(axes, &Shape::<2>::ball(radius).unwrap()).unwrap()
}

fn regular<const K: usize>(axes: [usize; K], name: &str) -> Factor {
    Factor::new(axes, &Shape::polytope(polytope::<K>(name, Size::Circumradius(1.0)).unwrap().into()).unwrap()).unwrap()
}

fn polytope_of<const N: usize>(shape: &Shape<N>) -> std::sync::Arc<Polytope<N>> {
    match shape {
        Shape::Polytope(polytope) => polytope.clone(),
        other => panic!("{other:?} is no polytope"),
    }
}

#[test]
fn products_of_polytopes_are_their_hulls() {
    let check = |shape: Shape<4>, counts: [usize; 4]| {
        let polytope = polytope_of(&shape);
        assert_eq!(polytope.face_lattice().face_counts(), counts);
        let hull = Polytope::from_points(polytope.vertices()).unwrap();
        assert_eq!(hull.face_lattice().face_counts(), counts);
        let (own, other) = (MassProperties::of_polytope(&polytope), MassProperties::of_polytope(&hull));
        assert!((own.mass / other.mass - 1.0).abs() < 1e-12);
        assert!((own.second_moments - other.second_moments).max_abs() < 1e-12);
    };
    // Faces of a product are products of faces: f(A × B) is the product of the polynomials 3 + 3t + t² and 5 + 5t + t².
    check(Shape::product(vec![regular([0, 2], "triangle"), regular([3, 1], "5-gon")]).unwrap(), [15, 30, 23, 8]);
    check(
        Shape::product(vec![regular([0, 1, 2], "icosahedron"), Factor::segment(3, 0.5).unwrap()]).unwrap(),
        [24, 72, 70, 22],
    );
    let segments = (0..4).map(|axis| Factor::segment(axis, 1.0).unwrap()).collect();
    check(Shape::product(segments).unwrap(), [16, 32, 24, 8]);
    let prism = Shape::<3>::product(vec![regular([1, 0], "7-gon"), Factor::segment(2, 2.0).unwrap()]).unwrap();
    assert_eq!(polytope_of(&prism).face_lattice().face_counts(), [14, 21, 9]);
    let triple = [[0, 1], [2, 3], [4, 5]].map(|axes| regular(axes, "triangle")).to_vec();
    let counts = polytope_of(&Shape::<6>::product(triple).unwrap()).face_lattice().face_counts();
    assert_eq!(counts, [27, 81, 108, 81, 36, 9]);
}

/// Volume and J_i per unit mass, in the order of the axes (PHYSICS: the lists of the factors side by side).
fn check_mass<const N: usize>(shape: &Shape<N>, volume: f64, moments: [f64; N]) {
    let found = shape.mass_properties(2.0).unwrap();
    assert!((found.mass / (2.0 * volume) - 1.0).abs() < 1e-14, "{}", found.mass);
    for i in 0..N {
        for j in 0..N {
            let expected = if i == j { moments[i] } else { 0.0 };
            assert!((found.second_moments[i][j] / found.mass - expected).abs() < 1e-14, "{i} {j}");
        }
    }
    assert!(found.centre.norm() < 1e-15);
}

#[test]
fn curved_products_have_the_mass_of_the_closed_forms() {
    let (r, s) = (0.7_f64, 0.4_f64);
    let duocylinder = Shape::<4>::product(vec![disc([0, 3], r), disc([1, 2], s)]).unwrap();
    let (a, b) = (r * r / 4.0, s * s / 4.0);
    check_mass(&duocylinder, PI * PI * r * r * s * s, [a, b, b, a]);
    let ball = Factor::new([0, 1, 2], &Shape::<3>::ball(r).unwrap()).unwrap();
    let spherinder = Shape::<4>::product(vec![ball, Factor::segment(3, s).unwrap()]).unwrap();
    let a = r * r / 5.0;
    check_mass(&spherinder, 8.0 / 3.0 * PI * r.powi(3) * s, [a, a, a, s * s / 3.0]);
    let square = Factor::new([2, 3], &Shape::<2>::cuboid([s, 2.0 * s]).unwrap()).unwrap();
    let cubinder = Shape::<4>::product(vec![disc([0, 1], r), square]).unwrap();
    let a = r * r / 4.0;
    check_mass(&cubinder, 8.0 * PI * r * r * s * s, [a, a, s * s / 3.0, 4.0 * s * s / 3.0]);
    let cylinder = Shape::<3>::product(vec![disc([0, 2], r), Factor::segment(1, s).unwrap()]).unwrap();
    check_mass(&cylinder, 2.0 * PI * r * r * s, [a, s * s / 3.0, a]);
    // 32³ vertices would be too many for contacts; mass does not ask for them.
    let three_discs = Shape::<6>::product(vec![disc([0, 1], r), disc([2, 3], r), disc([4, 5], r)]).unwrap();
    check_mass(&three_discs, PI.powi(3) * r.powi(6), [a; 6]);
}

#[test]
fn contacts_see_a_polytope_within_the_faceting() {
    let mut random = Random(5);
    let capsule = Factor::new([0, 1, 2], &Shape::<3>::capsule(0.4, 0.3, 1).unwrap()).unwrap();
    let ball = Factor::new([0, 1, 2], &Shape::<3>::ball(0.7).unwrap()).unwrap();
    let shapes = [
        Shape::<4>::product(vec![disc([0, 1], 0.7), disc([2, 3], 0.4)]).unwrap(),
        Shape::product(vec![ball, Factor::segment(3, 0.5).unwrap()]).unwrap(),
        Shape::product(vec![capsule, Factor::segment(3, 0.5).unwrap()]).unwrap(),
    ];
    for shape in shapes {
        let Shape::Product(product) = &shape else { panic!("not curved") };
        let (_, Piece::Convex(seen)) = shape.pieces().remove(0) else { panic!("no convex piece") };
        let Core::Polytope(faceted) = &seen.core else { panic!("no polytope") };
        assert!(product.faceting() < 0.012, "{}", product.faceting());
        let Solid::Curved(exact) = shape.solids().remove(0) else { panic!("no curved solid") };
        let counts = faceted.face_lattice().face_counts();
        assert_eq!(counts.iter().rev().fold(0, |sum, &count| count as i64 - sum), 0, "{counts:?}");
        let mut largest = 0.0_f64;
        for _ in 0..2000 {
            let direction = random.direction::<4>();
            let reach = exact.support(direction).dot(direction);
            let difference = seen.core.support(direction).dot(direction) - reach;
            largest = largest.max(difference.abs());
        }
        // Two curved factors can add up.
        assert!(largest <= 2.0 * product.faceting() && largest > 0.0, "{largest} {}", product.faceting());
    }
}

#[test]
fn sections_of_curved_products_are_exact() {
    let mut random = Random(6);
    let (r, s) = (0.7_f64, 0.4_f64);
    let duocylinder = Shape::<4>::product(vec![disc([0, 1], r), disc([2, 3], s)]).unwrap();
    for _ in 0..30 {
        let w = 0.39 * random.symmetric();
        let frame = SliceFrame::from_normal(Vector::<4>::unit(3), w).unwrap();
        let Some(Solid::Curved(cylinder)) = duocylinder.solids()[0].section::<3>(&frame) else { panic!("no section") };
        let direction = random.direction::<3>();
        let across = (direction[0] * direction[0] + direction[1] * direction[1]).sqrt();
        let expected = r * across + (s * s - w * w).sqrt() * direction[2].abs();
        assert!((cylinder.support(direction).dot(direction) - expected).abs() < 1e-12);
    }
    // The cylinder through the middle, as a polytope: two caps and a mantle.
    let frame = SliceFrame::from_normal(Vector::<4>::unit(3), 0.0).unwrap();
    let solid = duocylinder.solids()[0].section::<3>(&frame).unwrap();
    let volume = 2.0 * PI * r * r * s;
    let mut previous = f64::INFINITY;
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let missing = 1.0 - solid.to_polytope(tolerance).unwrap().unwrap().mass_properties().mass / volume;
        // The mantle is at most the tolerance too far in: 2/r of the volume times that.
        assert!(missing > 0.0 && missing < 2.0 / r * tolerance && missing < previous, "{missing}");
        previous = missing;
    }
    // Turned every way, what is cut still has the volume of a body of bounded size, and a plane through the centre hits.
    for _ in 0..10 {
        let frame = SliceFrame::from_normal(random.direction::<4>(), 0.1).unwrap();
        let solid = duocylinder.solids()[0].section::<3>(&frame).unwrap();
        assert!(solid.to_polytope(1e-2).unwrap().unwrap().mass_properties().mass > 0.5 * volume);
    }
}

#[test]
fn curved_factors_have_up_to_four_dimensions() {
    let four = Factor::new([0, 1, 2, 3], &Shape::<4>::ball(0.7).unwrap()).unwrap();
    let shape = Shape::<5>::product(vec![four, Factor::segment(4, 0.5).unwrap()]).unwrap();
    let a = 0.49 / 6.0;
    check_mass(&shape, PI * PI / 2.0 * 0.7_f64.powi(4), [a, a, a, a, 0.25 / 3.0]);
    let error = Factor::new([0, 1, 2, 3, 4], &Shape::<5>::ball(0.7).unwrap()).unwrap_err();
    assert_eq!(error.kind(), GeometryErrorKind::Unsupported);
}

#[test]
fn factors_that_do_not_fit_are_refused() {
    let kind = |factors| Shape::<4>::product(factors).unwrap_err().kind();
    assert_eq!(kind(vec![]), GeometryErrorKind::BadCount);
    assert_eq!(kind(vec![disc([0, 1], 1.0)]), GeometryErrorKind::BadCount);
    assert_eq!(kind(vec![disc([0, 1], 1.0), disc([1, 2], 1.0)]), GeometryErrorKind::BadCount);
    assert_eq!(kind(vec![disc([0, 1], 1.0), disc([2, 4], 1.0)]), GeometryErrorKind::BadCount);
    let floor = Shape::<2>::half_space([0.0, 1.0], 0.0).unwrap();
    assert_eq!(Factor::new([0, 1], &floor).unwrap_err().kind(), GeometryErrorKind::Unsupported);
    assert_eq!(Factor::segment(0, -1.0).unwrap_err().kind(), GeometryErrorKind::BadNumber);
    let duocylinder = Shape::<4>::product(vec![disc([0, 1], 0.7), disc([2, 3], 0.4)]).unwrap();
    assert_eq!(Shape::rounded(duocylinder, 0.1).unwrap_err().kind(), GeometryErrorKind::Unsupported);
}

/// Products of several curved factors have more vertices than there is room for: contacts see coarser ones.
#[test]
fn products_of_many_curved_factors_are_coarser_for_contacts() {
    let ball3 = |axes| Factor::new(axes, &Shape::<3>::ball(0.5).unwrap()).unwrap();
    let ball4 = Factor::new([2, 3, 4, 5], &Shape::<4>::ball(0.5).unwrap()).unwrap();
    fn check<const N: usize>(what: &str, factors: Vec<Factor>, limit: f64) {
        let shape = Shape::<N>::product(factors).unwrap_or_else(|error| panic!("{what}: {error}"));
        let Shape::Product(product) = &shape else { panic!("{what} is curved") };
        println!("{N}D {what}: contacts see a polytope within {:.3} m", product.faceting());
        assert!(product.faceting() < limit, "{what}: {}", product.faceting());
    }
    check::<5>("disc and ball", vec![disc([0, 1], 0.5), ball3([2, 3, 4])], 0.05);
    check::<6>("three discs", vec![disc([0, 1], 0.5), disc([2, 3], 0.5), disc([4, 5], 0.5)], 0.05);
    check::<6>("two balls", vec![ball3([0, 1, 2]), ball3([3, 4, 5])], 0.15);
    check::<6>("disc and ball of 4D", vec![disc([0, 1], 0.5), ball4], 0.15);
    // Flat factors cannot be coarser.
    let polygon = |axes| regular(axes, "100-gon");
    let error = Shape::<4>::product(vec![polygon([0, 1]), polygon([2, 3])]).unwrap_err();
    assert_eq!(error.kind(), GeometryErrorKind::BadCount, "{error}");
}

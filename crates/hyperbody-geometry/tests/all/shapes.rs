//! The constructors of shapes: what they accept, what they refuse, and what their errors say.

use hyperbody_geometry::{Core, GeometryErrorKind, Piece, Shape};
use hyperbody_math::{Pose, Rotation, Vector};

fn kind<const N: usize>(result: hyperbody_geometry::Result<Shape<N>>) -> GeometryErrorKind {
    result.expect_err("the shape must be refused").kind()
}

fn check_bad_numbers<const N: usize>() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, -1.0, 1e-7, 1e7, f64::MAX] {
        assert_eq!(kind(Shape::<N>::ball(bad)), GeometryErrorKind::BadNumber);
        assert_eq!(kind(Shape::<N>::capsule(bad, 1.0, 0)), GeometryErrorKind::BadNumber);
        assert_eq!(kind(Shape::<N>::capsule(1.0, bad, 0)), GeometryErrorKind::BadNumber);
        let core = Shape::<N>::cuboid(Vector::splat(1.0)).unwrap();
        assert_eq!(kind(Shape::rounded(core, bad)), GeometryErrorKind::BadNumber);
        for axis in 0..N {
            let mut half_extents = Vector::<N>::splat(1.0);
            half_extents[axis] = bad;
            let error = Shape::cuboid(half_extents).unwrap_err();
            assert_eq!(error.kind(), GeometryErrorKind::BadNumber);
            assert!(error.to_string().contains(&format!("half-extent {axis}")), "{error}");
            assert!(error.to_string().contains(&bad.to_string()), "{error}");
        }
    }
    assert_eq!(kind(Shape::<N>::capsule(1.0, 1.0, N)), GeometryErrorKind::BadNumber);
    for normal in [Vector::ZERO, Vector::splat(f64::NAN), Vector::splat(f64::INFINITY)] {
        assert_eq!(kind(Shape::<N>::half_space(normal, 0.0)), GeometryErrorKind::BadNumber);
    }
    for offset in [f64::NAN, f64::INFINITY, 2e6] {
        assert_eq!(kind(Shape::<N>::half_space(Vector::unit(1), offset)), GeometryErrorKind::BadNumber);
    }
}

#[test]
fn bad_numbers_are_refused() {
    check_bad_numbers::<2>();
    check_bad_numbers::<3>();
    check_bad_numbers::<4>();
    check_bad_numbers::<5>();
    check_bad_numbers::<6>();
}

#[test]
fn half_space_is_the_same_for_every_length_of_the_normal() {
    for scale in [1e-200, 1e-3, 1.0, 7.0, 1e200] {
        let Shape::HalfSpace { normal, offset } =
            Shape::half_space(Vector([0.0, 3.0, 0.0, 4.0]) * scale, 10.0 * scale).unwrap()
        else {
            panic!("a half-space");
        };
        assert!((normal - Vector([0.0, 0.6, 0.0, 0.8])).norm() < 1e-15);
        assert!((offset - 2.0).abs() < 1e-14);
    }
}

#[test]
fn rounding_grows_round_shapes() {
    let ball = Shape::<3>::rounded(Shape::ball(1.0).unwrap(), 0.5).unwrap();
    assert!(matches!(ball, Shape::Ball { radius: 1.5 }));
    let twice = Shape::rounded(Shape::rounded(Shape::<3>::cuboid(Vector::splat(1.0)).unwrap(), 0.25).unwrap(), 0.5);
    assert!(matches!(twice.unwrap(), Shape::Rounded { radius: 0.75, .. }));
    let compound = Shape::compound(vec![(Pose::IDENTITY, Shape::<3>::ball(1.0).unwrap())]).unwrap();
    assert_eq!(kind(Shape::rounded(compound, 0.1)), GeometryErrorKind::Unsupported);
}

#[test]
fn compounds_refuse_what_is_not_a_bounded_convex_part() {
    let ball = || (Pose::IDENTITY, Shape::<4>::ball(1.0).unwrap());
    assert_eq!(kind(Shape::<4>::compound(vec![])), GeometryErrorKind::BadCount);
    let nested = Shape::<4>::compound(vec![ball()]).unwrap();
    let error = Shape::compound(vec![ball(), (Pose::IDENTITY, nested)]).unwrap_err();
    assert_eq!(error.kind(), GeometryErrorKind::Unsupported);
    assert!(error.to_string().contains("part 1"), "{error}");
    let floor = Shape::<4>::half_space(Vector::unit(1), 0.0).unwrap();
    assert_eq!(kind(Shape::compound(vec![(Pose::IDENTITY, floor)])), GeometryErrorKind::Unsupported);
    let lost = Pose::<4>::from_translation(Vector::splat(f64::NAN));
    assert_eq!(kind(Shape::compound(vec![(lost, Shape::ball(1.0).unwrap())])), GeometryErrorKind::BadNumber);
}

#[test]
fn pieces_carry_the_poses_of_parts() {
    let pose = Pose::new(Rotation::<3>::in_plane(0, 1, 0.5), Vector([1.0, 2.0, 3.0]));
    let core = Shape::cuboid(Vector([1.0, 2.0, 3.0])).unwrap();
    let parts =
        vec![(Pose::IDENTITY, Shape::capsule(2.0, 0.5, 1).unwrap()), (pose, Shape::rounded(core, 0.125).unwrap())];
    let pieces = Shape::compound(parts).unwrap().pieces();
    assert_eq!(pieces.len(), 2);
    let (Piece::Convex(capsule), Piece::Convex(rounded)) = (&pieces[0].1, &pieces[1].1) else {
        panic!("two convex pieces");
    };
    assert!(matches!(capsule.core, Core::Segment { half } if half == Vector([0.0, 2.0, 0.0])));
    assert!(matches!(rounded.core, Core::Box { .. }));
    assert_eq!((capsule.radius, rounded.radius), (0.5, 0.125));
    assert_eq!(pieces[1].0, pose);
}

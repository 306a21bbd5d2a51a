//! Distance, depth, overlap and nearest points, held against certificates by vertices and facets alone: points in the
//! shapes bound a distance from above, a direction bounds it from below, and where both agree there is nothing left.

use crate::common::draw::{PLACEMENTS, draw};
use crate::common::oracle::{Truth, convex};
use crate::common::{Random, piece};
use hyperbody_collision::Scratch;
use hyperbody_collision::query::{
    Closest, closest, closest_of_pieces, overlap, pieces_overlap, project, project_on_piece, separation,
    separation_of_pieces,
};
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Core, Shape};
use hyperbody_math::{Pose, Vector};

fn separations_are_certified<const N: usize>() {
    let mut scratch = Scratch::default();
    let (mut near, mut deep) = (0, 0);
    for index in 0..400 {
        let pair = draw::<N>(17, PLACEMENTS * index, 30.0);
        let truth = Truth::new(convex(&pair.a), &pair.pose_a, convex(&pair.b), &pair.pose_b);
        let found = separation_of_pieces(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, &mut scratch)
            .expect("convex pieces have a separation");
        let rounding = 1e-8 * truth.scale;
        // The direction proves that nothing is closer (or that so much frees them), the points that nothing is farther.
        let along = truth.separation(found.normal) - truth.rounding;
        assert!((found.distance - along).abs() <= rounding, "{}: {found:?}, {along} along the normal", pair.name);
        let (out_a, out_b) = (truth.outside_a(found.on_a), truth.outside_b(found.on_b));
        assert!(out_a.max(out_b) <= rounding, "{}: {found:?}, {out_a} and {out_b} outside", pair.name);
        let across = found.on_b - found.on_a - found.normal * found.distance;
        assert!(across.norm() <= 1e-6 * truth.scale, "{}: {found:?} is {across:?} askew", pair.name);
        if let Some(least) = truth.least_depth(if N < 5 { 60 } else { 100 }) {
            let depth = -found.distance - truth.rounding;
            assert!((depth - least).abs() <= rounding, "{}: depth {depth}, least possible {least}", pair.name);
            deep += 1;
        }
        let clear = found.distance.abs() > 3.0 * rounding;
        let meet = pieces_overlap(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b);
        assert!(!clear || meet == (found.distance < 0.0), "{}: {found:?}, overlap {meet}", pair.name);
        match closest_of_pieces(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, f64::INFINITY) {
            Closest::Near(closest) => {
                near += 1;
                assert!((closest.distance - found.distance).abs() <= rounding, "{}: {closest:?} {found:?}", pair.name);
            }
            Closest::Overlapping => assert!(found.distance <= rounding, "{}: {found:?}", pair.name),
            Closest::Apart => panic!("{}: nothing is farther than infinity", pair.name),
        }
        let flipped = separation_of_pieces(&pair.b, &pair.pose_b, &pair.a, &pair.pose_a, &mut scratch);
        assert!((flipped.expect("as above").distance - found.distance).abs() <= rounding, "{}", pair.name);
    }
    assert!(near > 40 && deep > 6, "{near} disjoint pairs and {deep} depths compared in {N}D");
}

#[test]
fn distances_and_depths_are_certified() {
    for_every_dimension!(separations_are_certified);
}

/// A point is projected on every kind of shape; the nearest point is on the surface, and no sampled surface point is
/// nearer.
fn nearest_points<const N: usize>() {
    let mut random = Random(3 + N as u64);
    let mut scratch = Scratch::default();
    let (mut inside, mut outside) = (0, 0);
    for index in 0..300 {
        let pair = draw::<N>(23, PLACEMENTS * index, 3.0);
        let away = random.log_range(0.02, 1.5) * convex(&pair.a).bounding_radius();
        let point = pair.pose_a.translation + random.direction::<N>() * away;
        let found = project_on_piece(point, &pair.a, &pair.pose_a, &mut scratch).expect("a finite point");
        let speck = piece(Shape::ball(1e-6).expect("a speck"));
        let truth = Truth::new(convex(&pair.a), &pair.pose_a, convex(&speck), &pair.pose_a);
        let rounding = 1e-8 * truth.scale;
        assert!((point - found.point - found.normal * found.distance).norm() <= rounding, "{}: {found:?}", pair.name);
        // On the surface: in the shape, and the supporting hyperplane along the normal goes through it.
        let reach = support(&pair.a, &pair.pose_a, found.normal);
        let height = reach - found.normal.dot(found.point);
        assert!(height.abs() <= rounding, "{}: the point lies {height} below the farthest one", pair.name);
        assert!(truth.outside_a(found.point) <= rounding, "{}: {found:?}", pair.name);
        // Outside, that proves the distance. Inside, no direction may lead out sooner.
        if found.distance > 0.0 {
            outside += 1;
        } else {
            inside += 1;
            for _ in 0..200 {
                let n = random.direction::<N>();
                let depth = support(&pair.a, &pair.pose_a, n) - n.dot(point);
                assert!(depth >= -found.distance - rounding, "{}: {found:?}, {depth} along {n:?}", pair.name);
            }
        }
    }
    assert!(inside > 30 && outside > 30, "{inside} points inside, {outside} outside in {N}D");
}

fn support<const N: usize>(piece: &Piece<N>, pose: &Pose<N>, n: Vector<N>) -> f64 {
    let convex = convex(piece);
    n.dot(pose.transform_point(convex.core.support(pose.rotation.inverse_rotate(n)))) + convex.radius
}

#[test]
fn nearest_points_lie_on_the_surface_and_none_is_nearer() {
    for_every_dimension!(nearest_points);
}

fn half_spaces_and_compounds<const N: usize>() {
    let floor = Shape::half_space(Vector::<N>::unit(1), 0.5).expect("a floor");
    let cube = Shape::cuboid(Vector::<N>::splat(0.5)).expect("a cube");
    let at = |height: f64| Pose::from_translation(Vector::unit(1) * height);
    for height in [3.0, 1.25, 0.75] {
        let found = separation(&floor, &Pose::IDENTITY, &cube, &at(height)).expect("the cube is bounded");
        assert!((found.distance - (height - 1.0)).abs() < 1e-12 && found.normal == Vector::unit(1), "{found:?}");
        let closest = closest(&cube, &at(height), &floor, &Pose::IDENTITY, 10.0);
        match closest {
            Closest::Near(found) => assert!((found.distance - (height - 1.0)).abs() < 1e-12 && height > 1.0),
            Closest::Overlapping => assert!(height < 1.0),
            Closest::Apart => panic!("{height} is not farther than ten"),
        }
        assert_eq!(overlap(&floor, &Pose::IDENTITY, &cube, &at(height)), height < 1.0);
    }
    let endless = separation(&floor, &Pose::IDENTITY, &floor, &at(1.0)).expect("two half-spaces");
    assert_eq!(endless.distance, f64::NEG_INFINITY, "no way frees them");
    assert_eq!((endless.on_a, endless.on_b), (Vector::unit(1) * 0.5, Vector::unit(1) * 1.5));
    assert!(overlap(&floor, &Pose::IDENTITY, &floor, &at(1.0)));
    let ceiling = Shape::half_space(-Vector::<N>::unit(1), -3.0).expect("a ceiling");
    assert!(!overlap(&floor, &Pose::IDENTITY, &ceiling, &Pose::IDENTITY));
    for height in [0.0, -1.0, -2.5, -4.0] {
        let found = separation(&floor, &Pose::IDENTITY, &ceiling, &at(height)).expect("two half-spaces");
        assert_eq!((found.distance, found.normal), (2.5 + height, Vector::unit(1)));
        assert_eq!((found.on_a, found.on_b), (Vector::unit(1) * 0.5, Vector::unit(1) * (3.0 + height)));
        assert_eq!(overlap(&floor, &Pose::IDENTITY, &ceiling, &at(height)), height <= -2.5);
    }
    assert_eq!(closest(&floor, &Pose::IDENTITY, &ceiling, &Pose::IDENTITY, 2.4), Closest::Apart);

    // A dumb-bell: of two parts the nearer one answers.
    let ball = Shape::ball(0.5).expect("a ball");
    let bell = Shape::compound(vec![
        (Pose::from_translation(Vector::unit(0) * 2.0), ball.clone()),
        (Pose::from_translation(Vector::unit(0) * -2.0), cube),
    ])
    .expect("two parts");
    let found = separation(&ball, &at(0.0), &bell, &Pose::from_translation(Vector::unit(0) * -5.0)).expect("bounded");
    assert!((found.distance - 2.0).abs() < 1e-12 && found.part_b == 0, "{found:?}");
    let found = project(Vector::<N>::unit(0) * -2.1, &bell, &Pose::IDENTITY).expect("finite");
    assert!((found.distance + 0.4).abs() < 1e-12 && found.part == 1, "{found:?}");
    let nan = Pose::from_translation(Vector::<N>::splat(f64::NAN));
    assert_eq!(separation(&ball, &nan, &bell, &Pose::IDENTITY), None);
    assert!(!overlap(&ball, &nan, &bell, &Pose::IDENTITY));
    assert_eq!(project(Vector::<N>::splat(f64::NAN), &bell, &Pose::IDENTITY), None);
    assert!(matches!(convex(&piece(ball)).core, Core::Point));
}

#[test]
fn half_spaces_compounds_and_numbers_that_are_none() {
    for_every_dimension!(half_spaces_and_compounds);
}

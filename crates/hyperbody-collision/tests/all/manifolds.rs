//! Contact manifolds whose every number is known: boxes face on face, bodies on a half-space, balls, capsules.

use crate::common::{Random, piece};
use hyperbody_collision::box_sat::{Feature, axis_count, separate_boxes};
use hyperbody_collision::{Manifold, PairCache, Scratch, collide, max_points};
use hyperbody_geometry::Shape;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Pose, Rotation, Vector};

const MARGIN: f64 = 0.02;

fn contact<const N: usize>(a: &Piece<N>, pose_a: &Pose<N>, b: &Piece<N>, pose_b: &Pose<N>) -> Manifold<N> {
    let mut out = Manifold::EMPTY;
    collide(a, pose_a, b, pose_b, MARGIN, &mut PairCache::default(), &mut Scratch::default(), &mut out);
    out
}

fn cuboid<const N: usize>(half_extents: Vector<N>) -> Piece<N> {
    piece(Shape::cuboid(half_extents).expect("positive half-extents"))
}

/// Dimension of the affine hull of the contact points.
fn rank<const N: usize>(manifold: &Manifold<N>) -> usize {
    let mut basis: Vec<Vector<N>> = Vec::new();
    for point in manifold.points() {
        let mut rest = point.position - manifold.points()[0].position;
        for &direction in &basis {
            rest -= direction * direction.dot(rest);
        }
        if rest.norm() > 1e-6 {
            basis.push(rest / rest.norm());
        }
    }
    basis.len()
}

fn axes_are_counted<const N: usize>() {
    let mut random = Random(1);
    let half = Vector::<N>::splat(1.0);
    let a_from_b = Pose::new(random.rotation(1.0), Vector::splat(0.1));
    let found = separate_boxes(&half, &half, &a_from_b, f64::INFINITY, Feature::None);
    assert_eq!(found.axes_tried, [0, 0, 4, 15, 56, 210, 792][N]);
    assert_eq!(axis_count(N as u32), found.axes_tried);
}

#[test]
fn two_boxes_have_the_binomial_number_of_axes() {
    for_every_dimension!(axes_are_counted);
}

/// A unit cube standing on a larger box, shifted so that its facet lies inside: the patch is the cube's whole facet.
fn cube_on_box<const N: usize>() {
    let (ground, cube) = (cuboid(Vector::<N>::splat(2.0)), cuboid(Vector::splat(0.5)));
    for gap in [-0.003, 0.0, 0.004] {
        let mut centre = Vector::splat(0.3);
        centre[1] = 2.5 + gap;
        let found = contact(&ground, &Pose::IDENTITY, &cube, &Pose::from_translation(centre));
        assert!((found.normal - Vector::unit(1)).norm() < 1e-15);
        assert_eq!(rank(&found), N - 1, "the points must span the patch");
        assert!(found.points().len() >= N && found.points().len() <= max_points(N));
        assert_eq!(found.points().len(), (1 << (N - 1)).min(max_points(N)));
        for point in found.points() {
            assert!((point.separation - gap).abs() < 1e-14);
            let offset = point.position - centre;
            assert!((point.position[1] - (2.0 + gap / 2.0)).abs() < 1e-14, "midway between the surfaces");
            for axis in (0..N).filter(|&axis| axis != 1) {
                assert!((offset[axis].abs() - 0.5).abs() < 1e-14, "at the corners of the patch");
            }
        }
    }
}

#[test]
fn a_cube_on_a_box_touches_with_its_corners() {
    for_every_dimension!(cube_on_box);
}

/// Two boxes whose facets overlap partly: the patch is the intersection of two intervals on every axis.
fn partial_overlap<const N: usize>() {
    let (a, b) = (cuboid(Vector::<N>::splat(1.0)), cuboid(Vector::splat(0.8)));
    let mut centre = Vector::from_fn(|axis| 0.5 + 0.1 * axis as f64);
    centre[0] = 1.8 - 0.01;
    let found = contact(&a, &Pose::IDENTITY, &b, &Pose::from_translation(centre));
    assert_eq!(rank(&found), N - 1);
    for point in found.points() {
        assert!((point.separation + 0.01).abs() < 1e-14);
        for axis in 1..N {
            let place = point.position[axis];
            let at_low = (place - (centre[axis] - 0.8)).abs() < 1e-14;
            assert!(at_low || (place - 1.0).abs() < 1e-14, "axis {axis}: {place}");
        }
    }
}

#[test]
fn the_patch_of_two_facets_is_their_intersection() {
    for_every_dimension!(partial_overlap);
}

/// Whatever turns the world turns the contact with it, and exchanging the shapes flips the normal alone.
fn moves_with_the_world<const N: usize>() {
    let mut random = Random(11);
    let mut seen = 0;
    for _ in 0..400 {
        let a = cuboid::<N>(Vector::from_fn(|_| random.range(0.3, 1.0)));
        let b = cuboid(Vector::from_fn(|_| random.range(0.3, 1.0)));
        let (pose_a, pose_b) = (random.pose(0.7), random.pose(0.7));
        let here = contact(&a, &pose_a, &b, &pose_b);
        let world = random.pose::<N>(5.0);
        let there = contact(&a, &(world * pose_a), &b, &(world * pose_b));
        let swapped = contact(&b, &pose_b, &a, &pose_a);
        assert_eq!(here.points().len(), there.points().len());
        assert_eq!(here.is_empty(), swapped.is_empty());
        seen += usize::from(!here.is_empty());
        if here.is_empty() {
            continue;
        }
        assert!((world.rotation.rotate(here.normal) - there.normal).norm() < 1e-9);
        let least = |m: &Manifold<N>| m.least_separation().expect("not empty");
        assert!((least(&here) - least(&there)).abs() < 1e-9);
        for p in here.points() {
            let q = there.points().iter().find(|q| q.id == p.id).expect("the same features touch");
            assert!(world.transform_point(p.position).distance(q.position) < 1e-8, "N = {N}");
            assert!((p.separation - q.separation).abs() < 1e-9);
        }
        // The tolerances prefer a's facets, so that depths of the exchanged pair agree to these only.
        assert!((least(&here) - least(&swapped)).abs() <= 0.05 * least(&here).abs() + 2e-3);
    }
    assert!(seen > 50, "N = {N}: only {seen} pairs touched; the test must see contacts");
}

#[test]
fn contacts_move_with_the_world() {
    for_every_dimension!(moves_with_the_world);
}

fn on_a_half_space<const N: usize>() {
    let ground = piece(Shape::half_space(Vector::<N>::unit(1), 0.25).expect("a plane"));
    let bodies = [
        Shape::ball(0.5).expect("a ball"),
        Shape::cuboid(Vector::splat(0.5)).expect("a box"),
        Shape::capsule(1.0, 0.5, 0).expect("a capsule"),
    ];
    for (shape, points) in bodies.into_iter().zip([1, (1 << (N - 1)).min(max_points(N)), 2]) {
        let body = piece(shape);
        for gap in [-0.01, 0.01] {
            let centre = Vector::unit(1) * (0.75 + gap);
            let found = contact(&ground, &Pose::IDENTITY, &body, &Pose::from_translation(centre));
            assert!((found.normal - Vector::unit(1)).norm() < 1e-15, "from the ground to the body");
            assert_eq!(found.points().len(), points);
            for point in found.points() {
                assert!((point.separation - gap).abs() < 1e-14);
                assert!((point.position[1] - (0.25 + gap / 2.0)).abs() < 1e-14);
            }
            let swapped = contact(&body, &Pose::from_translation(centre), &ground, &Pose::IDENTITY);
            assert_eq!(swapped.flipped(), found);
        }
    }
}

#[test]
fn bodies_on_a_half_space() {
    for_every_dimension!(on_a_half_space);
}

fn balls_and_capsules<const N: usize>() {
    let (ball, capsule) =
        (piece(Shape::ball(0.5).expect("ball")), piece(Shape::capsule(1.0, 0.25, 0).expect("capsule")));
    let at = |x: f64, y: f64| {
        let mut centre = Vector::ZERO;
        (centre[0], centre[1]) = (x, y);
        Pose::<N>::from_translation(centre)
    };
    // 3-4-5 triangle: distance 1, sum of the radii 1.
    let found = contact(&ball, &at(0.0, 0.0), &ball, &at(0.6, 0.8));
    assert!((found.points()[0].separation).abs() < 1e-15);
    assert!((found.normal[0] - 0.6).abs() < 1e-15 && (found.normal[1] - 0.8).abs() < 1e-15);
    assert!(found.points()[0].position.distance(at(0.3, 0.4).translation) < 1e-15);
    // Ball beside the end of a capsule, then beside its shaft.
    let found = contact(&ball, &at(1.6, 0.0), &capsule, &at(0.0, 0.0));
    assert!((found.points()[0].separation + 0.15).abs() < 1e-15 && (found.normal[0] + 1.0).abs() < 1e-15);
    let found = contact(&capsule, &at(0.0, 0.0), &ball, &at(0.5, 0.7));
    assert!((found.points()[0].separation + 0.05).abs() < 1e-15 && (found.normal[1] - 1.0).abs() < 1e-15);
    // Side by side with an offset: two points at the ends of the common stretch from −0.5 to 1.
    let found = contact(&capsule, &at(0.0, 0.0), &capsule, &at(0.5, 0.5));
    assert_eq!(found.points().len(), 2);
    assert!((found.points()[0].position[0] + 0.5).abs() < 1e-12 && (found.points()[1].position[0] - 1.0).abs() < 1e-12);
    // Crossing at right angles, 0.4 apart along the last axis: one point.
    if N > 2 {
        let mut pose = at(0.0, 0.0);
        pose.translation[N - 1] = 0.4;
        pose.rotation = Rotation::in_plane(0, 1, std::f64::consts::FRAC_PI_2);
        let found = contact(&capsule, &at(0.0, 0.0), &capsule, &pose);
        assert_eq!(found.points().len(), 1);
        assert!((found.points()[0].separation + 0.1).abs() < 1e-15);
    }
    // Coincident: some unit normal, depth the sum of the radii.
    for shape in [&ball, &capsule] {
        let found = contact(shape, &at(0.1, 0.2), shape, &at(0.1, 0.2));
        assert!((found.normal.norm() - 1.0).abs() < 1e-12, "coincident shapes still have a way apart");
    }
}

#[test]
fn balls_and_capsules_have_closed_forms() {
    for_every_dimension!(balls_and_capsules);
}

fn ball_and_box<const N: usize>() {
    let (ball, block) = (piece(Shape::ball(0.5).expect("ball")), cuboid(Vector::<N>::splat(1.0)));
    // At a corner, along the diagonal.
    let diagonal = Vector::splat(1.0 / (N as f64).sqrt());
    let pose = Pose::from_translation(Vector::splat(1.0) + diagonal * 0.45);
    let found = contact(&block, &Pose::IDENTITY, &ball, &pose);
    assert!((found.normal - diagonal).norm() < 1e-12 && (found.points()[0].separation + 0.05).abs() < 1e-12);
    // Centre inside: out through the nearest facet.
    let mut centre = Vector::splat(0.2);
    centre[N - 1] = -0.9;
    let found = contact(&ball, &Pose::from_translation(centre), &block, &Pose::IDENTITY);
    assert!((found.normal - Vector::unit(N - 1)).norm() < 1e-15, "from the ball up into the box");
    assert!((found.points()[0].separation + 0.6).abs() < 1e-15);
}

#[test]
fn a_ball_meets_the_nearest_feature_of_a_box() {
    for_every_dimension!(ball_and_box);
}

fn poses_that_are_not_finite<const N: usize>() {
    let pieces = [
        piece(Shape::ball(0.5).expect("ball")),
        cuboid(Vector::<N>::splat(1.0)),
        piece(Shape::half_space(Vector::unit(0), 0.0).expect("plane")),
        piece(Shape::capsule(0.5, 0.5, 1).expect("capsule")),
    ];
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX] {
        for a in &pieces {
            for b in &pieces {
                let pose = Pose::from_translation(Vector::splat(bad));
                assert!(contact(a, &pose, b, &Pose::IDENTITY).points().iter().all(|p| p.separation.is_finite()));
                assert!(contact(a, &Pose::IDENTITY, b, &pose).points().iter().all(|p| p.separation.is_finite()));
                assert!(bad == f64::MAX || contact(a, &pose, b, &pose).is_empty());
            }
        }
    }
}

#[test]
fn poses_that_are_not_finite_give_no_contact() {
    for_every_dimension!(poses_that_are_not_finite);
}

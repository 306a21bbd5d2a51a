//! The three detectors against each other: they share no search.

use std::sync::Arc;

use crate::common::Random;
use hyperbody_collision::Scratch;
use hyperbody_collision::box_sat::{Feature, axis_count, separate_boxes};
use hyperbody_collision::detect::{NearestFeatures, SeparatingAxes, by_minkowski_difference};
use hyperbody_geometry::regular::{Regular, Size};
use hyperbody_geometry::{Convex, Core, Polytope};
use hyperbody_math::{Pose, Vector};

/// Polytopes of few vertices, of many coplanar ones, flat ones, and regular ones.
fn polytope<const N: usize>(random: &mut Random) -> Arc<Polytope<N>> {
    let points: Vec<Vector<N>> = match random.below(4) {
        0 => (0..N + 1 + random.below(2)).map(|_| random.direction()).collect(),
        1 => (0..2 * N).map(|_| Vector::from_fn(|_| random.below(3) as f64 - 1.0)).collect(),
        2 => {
            (0..N + 3).map(|_| Vector::from_fn(|i| random.range(-1.0, 1.0) * if i == 0 { 0.01 } else { 1.0 })).collect()
        }
        _ => Vec::new(),
    };
    let drawn = Polytope::from_points(&points);
    Arc::new(drawn.or_else(|_| Regular::CrossPolytope.polytope(Size::Circumradius(1.0))).expect("a cross-polytope"))
}

fn solid<const N: usize>(polytope: &Arc<Polytope<N>>) -> Convex<N> {
    Convex { core: Core::Polytope(Arc::clone(polytope)), radius: 0.0 }
}

fn nearest_features_and_differences<const N: usize>() {
    let mut random = Random(8 + N as u64);
    let mut scratch = Scratch::default();
    let mut by_rank = [0; N];
    for index in 0..60 {
        let polytope = polytope::<N>(&mut random);
        let features = NearestFeatures::new(&polytope);
        let lattice = polytope.face_lattice();
        for _ in 0..12 {
            let pose = random.pose::<N>(2.0);
            let centre = pose.translation + random.direction::<N>() * random.log_range(0.01, 3.0);
            let radius = random.log_range(0.01, 1.0);
            let by_features = features.ball(&pose, centre, radius).expect("finite");
            let ball = Convex { core: Core::Point, radius };
            let (other, at) = (solid(&polytope), Pose::from_translation(centre));
            let by_difference = by_minkowski_difference(&other, &pose, &ball, &at, &mut scratch).expect("finite");
            let off = (by_features.distance - by_difference.distance).abs();
            assert!(off < 2e-8, "{N}D, {index}: {by_features:?} {by_difference:?}");
            // The face named holds the point, and the normal is right.
            let near = features.nearest(pose.inverse_transform_point(centre)).expect("finite");
            by_rank[near.rank as usize] += 1;
            let face = &lattice.faces(near.rank as usize)[near.face as usize];
            let height = |v: u32| near.normal.dot(polytope.vertices()[v as usize] - near.point);
            assert!(face.vertices.iter().all(|&v| height(v).abs() < 1e-9), "{N}D, {index}: {near:?} on {face:?}");
            if near.distance > 1e-6 {
                let apart = by_features.normal.distance(by_difference.normal);
                assert!(apart < 1e-6, "{N}D, {index}: {by_features:?} {by_difference:?}");
            }
        }
    }
    assert!(by_rank.iter().all(|&count| count > 0), "faces of every rank must be nearest once: {by_rank:?}");
}

#[test]
fn balls_by_nearest_features_and_by_differences() {
    for_every_dimension!(nearest_features_and_differences);
}

/// On a cube the rank of the nearest face is known, ties included.
fn ranks_on_a_cube<const N: usize>() {
    let cube = Regular::Cube.polytope::<N>(Size::Edge(2.0)).expect("a cube");
    let features = NearestFeatures::new(&cube);
    for beyond in 1..=N {
        for (sideways, rank) in [(0.5, N - beyond), (1.0, 0)] {
            let point = Vector::from_fn(|i| if i < beyond { 1.5 } else { sideways });
            let near = features.nearest(point).expect("finite");
            let nearest = Vector::from_fn(|i| if i < beyond { 1.0 } else { sideways });
            assert_eq!(near.rank as usize, if beyond == N { 0 } else { rank }, "{N}D: {near:?}");
            assert!(
                near.point.distance(nearest) < 1e-12 && (near.distance - 0.5 * (beyond as f64).sqrt()).abs() < 1e-12
            );
        }
    }
    let inside = features.nearest(Vector::unit(0) * 0.75).expect("finite");
    assert!(
        inside.rank as usize == N - 1 && (inside.distance + 0.25).abs() < 1e-12 && inside.normal == Vector::unit(0)
    );
    assert_eq!(features.nearest(Vector::splat(f64::NAN)), None);
}

#[test]
fn the_nearest_face_of_a_cube_has_the_known_rank() {
    for_every_dimension!(ranks_on_a_cube);
}

fn axes_and_differences<const N: usize>() {
    let mut random = Random(80 + N as u64);
    let mut scratch = Scratch::default();
    let (mut deep, mut apart) = (0, 0);
    for index in 0..150 {
        let (a, b) = (polytope::<N>(&mut random), polytope::<N>(&mut random));
        let (axes_a, axes_b) = (SeparatingAxes::new(&a), SeparatingAxes::new(&b));
        if axes_a.pairs_with(&axes_b) > 12_000 {
            continue;
        }
        let (pose_a, pose_b) = (random.pose::<N>(0.3), random.pose::<N>(0.6));
        let by_axes = axes_a.separate(&pose_a, &axes_b, &pose_b).expect("solids have axes");
        let found = by_minkowski_difference(&solid(&a), &pose_a, &solid(&b), &pose_b, &mut scratch).expect("finite");
        if found.distance < -1e-9 {
            deep += 1;
            let off = (by_axes.separation - found.distance).abs();
            assert!(off < 1e-8, "{N}D, {index}: {by_axes:?} {found:?}");
        } else if found.distance > 1e-9 {
            apart += 1;
            let right = by_axes.separation > 0.0 && by_axes.separation <= found.distance + 1e-9;
            assert!(right, "{N}D, {index}: {by_axes:?} {found:?}");
        }
        let back = axes_b.separate(&pose_b, &axes_a, &pose_a).expect("solids have axes");
        assert!((back.separation - by_axes.separation).abs() < 1e-9 && back.axes == by_axes.axes);
    }
    assert!(deep > 5 && apart > 5, "{deep} overlapping and {apart} disjoint pairs in {N}D");
}

#[test]
fn polytopes_by_separating_axes_and_by_differences() {
    for_every_dimension!(axes_and_differences);
}

fn boxes_three_ways<const N: usize>() {
    let mut random = Random(800 + N as u64);
    let mut scratch = Scratch::default();
    for index in 0..60 {
        let halves = [0, 1].map(|_| Vector::<N>::from_fn(|_| random.log_range(0.05, 1.0)));
        let [a, b] = halves.map(|half_extents| Convex { core: Core::Box { half_extents }, radius: 0.0 });
        let (pose_a, pose_b) = (random.pose::<N>(0.1), random.pose::<N>(0.3));
        let (axes_a, axes_b) = (SeparatingAxes::of_core(&a), SeparatingAxes::of_core(&b));
        assert_eq!(axes_a.pairs_with(&axes_b), u64::from(axis_count(N as u32)));
        let by_axes = axes_a.separate(&pose_a, &axes_b, &pose_b).expect("boxes have axes");
        let closed = separate_boxes(&halves[0], &halves[1], &pose_a.relative(&pose_b), f64::INFINITY, Feature::None);
        let off = (by_axes.separation - closed.least.separation).abs();
        assert!(off < 1e-9, "{N}D, {index}: {by_axes:?} {:?}", closed.least);
        // The difference of two boxes in six dimensions may have more facets than its search looks at.
        if N < 6 {
            let found = by_minkowski_difference(&a, &pose_a, &b, &pose_b, &mut scratch).expect("finite");
            let agree = if found.distance < 0.0 {
                (found.distance - by_axes.separation).abs() < 1e-8
            } else {
                by_axes.separation <= found.distance + 1e-9
            };
            assert!(agree, "{N}D, {index}: {by_axes:?} {found:?}");
        }
    }
}

#[test]
fn boxes_by_closed_form_axes_by_all_faces_and_by_differences() {
    for_every_dimension!(boxes_three_ways);
}

//! The narrow phase: any two shapes at any poses get contacts, distances and casts that make sense, never a panic.
#![no_main]

mod bytes;

use bytes::Bytes;
use hyperbody_collision::query::{Motion, project, separation, shape_cast};
use hyperbody_collision::ray::{Ray, cast};
use hyperbody_collision::{Manifold, PairCache, Scratch, collide, max_points};
use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Bivector, Pose, Vector};
use libfuzzer_sys::fuzz_target;

/// Largest coordinate for which more is asked than that nothing panics: beyond, rounding eats small shapes.
const FAR: f64 = 1e4;

/// Largest coordinate whose square is a number, with room for sums.
const BEYOND: f64 = 1e100;

fn contacts<const N: usize>(a: &Piece<N>, pose_a: &Pose<N>, b: &Piece<N>, pose_b: &Pose<N>, margin: f64) {
    let (mut cache, mut scratch, mut out) = (PairCache::default(), Scratch::default(), Manifold::EMPTY);
    for _ in 0..2 {
        collide(a, pose_a, b, pose_b, margin, &mut cache, &mut scratch, &mut out);
        assert!(out.points().len() <= max_points(N));
        if out.is_empty() {
            continue;
        }
        if pose_a.translation.max_abs().max(pose_b.translation.max_abs()) > BEYOND {
            continue;
        }
        assert!((out.normal.norm() - 1.0).abs() < 1e-9, "a normal of length {}", out.normal.norm());
        for point in out.points() {
            assert!(point.position.is_finite() && point.separation.is_finite(), "{point:?}");
        }
    }
}

/// How far a piece reaches along a direction, or `None` for half-spaces.
fn reach<const N: usize>(piece: &Piece<N>, pose: &Pose<N>, n: Vector<N>) -> Option<f64> {
    let Piece::Convex(convex) = piece else { return None };
    Some(n.dot(pose.transform_point(convex.core.support(pose.rotation.inverse_rotate(n)))) + convex.radius)
}

fn check<const N: usize>(bytes: &mut Bytes<'_>) {
    let (Some(a), Some(b)) = (bytes.shape::<N>(1), bytes.shape::<N>(1)) else { return };
    let (pose_a, mut pose_b) = (bytes.pose::<N>(), bytes.pose::<N>());
    if bytes.byte() % 4 == 0 {
        pose_b = pose_a;
    }
    let margin = bytes.number().abs();
    let (parts_a, parts_b) = (a.pieces(), b.pieces());
    for (inner_a, piece_a) in &parts_a {
        for (inner_b, piece_b) in &parts_b {
            contacts(piece_a, &(pose_a * *inner_a), piece_b, &(pose_b * *inner_b), margin);
        }
    }
    if let Some(found) = separation(&a, &pose_a, &b, &pose_b)
        && pose_a.translation.max_abs().max(pose_b.translation.max_abs()) < FAR
    {
        let (inner_a, piece_a) = &parts_a[found.part_a as usize];
        let (inner_b, piece_b) = &parts_b[found.part_b as usize];
        let (at_a, at_b) = (pose_a * *inner_a, pose_b * *inner_b);
        // The normal certifies the distance, or the depth.
        let n = found.normal;
        if let (Some(high_a), Some(low_b)) = (reach(piece_a, &at_a, n), reach(piece_b, &at_b, -n)) {
            let along = -low_b - high_a;
            let size = |piece: &Piece<N>| match piece {
                Piece::Convex(convex) => convex.bounding_radius(),
                Piece::HalfSpace { .. } => 0.0,
            };
            let scale = size(piece_a) + size(piece_b) + at_a.translation.norm() + at_b.translation.norm();
            assert!(
                (along - found.distance).abs() <= 1e-7 * scale,
                "{found:?}, {along} along the normal, size {scale}"
            );
        }
    }
    let _ = project(bytes.vector::<N>(), &a, &pose_a);
    let ray = Ray::new(bytes.vector::<N>(), bytes.vector::<N>()).up_to(bytes.number());
    if let Some(hit) = cast(&ray, &b, &pose_b) {
        assert!(hit.fraction >= 0.0 && hit.fraction <= ray.max_fraction, "{hit:?}");
    }
    let spin = Bivector::from_fn(|_, _| f64::from(bytes.byte()) / 32.0 - 4.0);
    let motion = Motion::linear(pose_a, bytes.vector::<N>()).turning(spin, Vector::ZERO);
    if let Some(hit) = shape_cast(&a, &motion, &b, &pose_b, 1.0, 0.0) {
        assert!((0.0..=1.0).contains(&hit.time), "{hit:?}");
    }
}

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    match bytes.byte() % 5 {
        0 => check::<2>(&mut bytes),
        1 => check::<3>(&mut bytes),
        2 => check::<4>(&mut bytes),
        3 => check::<5>(&mut bytes),
        _ => check::<6>(&mut bytes),
    }
});

//! Construction of shapes: any numbers make a sound shape or an error, never a panic, and never without end.
#![no_main]

mod bytes;

use bytes::Bytes;
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Core, Polytope, Shape, off};
use hyperbody_math::{Pose, Vector};
use libfuzzer_sys::fuzz_target;

/// Every vertex lies behind every facet and on its own ones, to rounding. Hulls may be of any size; only shapes are limited.
/// Where squares of lengths are no numbers, nothing is asked.
fn is_sound<const N: usize>(polytope: &Polytope<N>) {
    let size = polytope.bounding_radius();
    if !(1e-100..=1e100).contains(&size) {
        return;
    }
    for facet in polytope.facets() {
        assert!((facet.normal.norm() - 1.0).abs() < 1e-9, "a normal of length {}", facet.normal.norm());
        assert!(facet.vertices.len() >= N && facet.neighbours.len() >= N);
        for (index, vertex) in polytope.vertices().iter().enumerate() {
            let height = facet.normal.dot(*vertex) - facet.offset;
            assert!(height <= 1e-8 * size, "vertex {index} is {height} in front of a facet, size {size}");
        }
    }
    for vertex in 0..polytope.vertices().len() {
        assert!(polytope.facets_of_vertex(vertex).len() >= N && polytope.neighbours_of_vertex(vertex).len() >= N);
    }
}

fn check<const N: usize>(bytes: &mut Bytes<'_>) {
    if let Some(polytope) = bytes.polytope::<N>() {
        is_sound(&polytope);
        let _ = polytope.scaled(bytes.number()).map(|scaled| is_sound(&scaled));
        if polytope.facets().len() < 300 {
            let counts = polytope.face_lattice().face_counts();
            assert!(counts[0] == polytope.vertices().len() && counts[N - 1] == polytope.facets().len());
        }
    }
    let Some(shape) = bytes.shape::<N>(2) else { return };
    for (pose, piece) in shape.pieces() {
        let Piece::Convex(convex) = piece else { continue };
        assert!(convex.radius >= 0.0 && convex.bounding_radius().is_finite());
        let direction = Vector::from_fn(|i| 1.0 - 0.3 * i as f64);
        let support = convex.core.support(direction);
        assert!(support.norm() <= convex.core.bounding_radius() * (1.0 + 1e-12));
        let aabb = convex.aabb(&pose);
        assert!((0..N).all(|i| aabb.lower[i] <= aabb.upper[i]), "{aabb:?}");
        if let Core::Polytope(polytope) = &convex.core {
            is_sound(polytope);
        }
    }
    let _ = Shape::compound(vec![(Pose::IDENTITY, shape)]);
}

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    match bytes.byte() % 6 {
        0 => check::<2>(&mut bytes),
        1 => check::<3>(&mut bytes),
        2 => check::<4>(&mut bytes),
        3 => check::<5>(&mut bytes),
        4 => check::<6>(&mut bytes),
        _ => {
            if let Ok(text) = std::str::from_utf8(bytes.0) {
                if let Ok(file) = off::parse(text) {
                    let _ = (file.to_polytope::<3>(), file.to_polytope::<4>());
                }
            }
        }
    }
});

//! Sections of curved shapes against closed forms, and the bound on the error of their polytopes.

use std::sync::Arc;

use crate::common::Random;
use hyperbody_geometry::regular::{Size, polytope};
use hyperbody_geometry::section::approximate;
use hyperbody_geometry::{GeometryErrorKind, Shape, SliceFrame, Solid, SupportMap, volume};
use hyperbody_math::{Pose, Rotation, Vector};

fn frame<const N: usize>(normal: Vector<N>, offset: f64) -> SliceFrame<N> {
    SliceFrame::from_normal(normal, offset).unwrap()
}

fn curved<const N: usize>(shape: &Shape<N>) -> Arc<dyn SupportMap<N>> {
    match shape.solids().remove(0) {
        Solid::Curved(body) => body,
        other => panic!("{other:?} is not curved"),
    }
}

fn support_value<const N: usize>(body: &dyn SupportMap<N>, direction: Vector<N>) -> f64 {
    body.support(direction).dot(direction)
}

/// The hyperplane at distance d that holds the axis of a capsule cuts out all points at most √(r² − d²) from the segment;
/// one across the axis at height c beyond the end of the segment a ball of radius √(r² − (c − h)²).
fn capsules<const N: usize, const M: usize>() {
    let mut random = Random(10 + N as u64);
    let (half_length, radius) = (0.8, 0.5);
    let shape = Shape::<N>::capsule(half_length, radius, 0).unwrap();
    let body = curved(&shape);
    for _ in 0..20 {
        let distance = 0.45 * random.unit();
        let along = frame(Vector::unit(N - 1), distance);
        let Some(Solid::Curved(section)) = Solid::Curved(Arc::clone(&body)).section::<M>(&along) else {
            panic!("a section is missing")
        };
        let beyond = half_length + 0.45 * random.symmetric();
        let across = frame(Vector::unit(0), beyond);
        let Some(Solid::Curved(cap)) = Solid::Curved(Arc::clone(&body)).section::<M>(&across) else {
            panic!("a section is missing")
        };
        let direction = random.direction::<M>();
        let closed = half_length * direction[0].abs() + (radius * radius - distance * distance).sqrt();
        assert!((support_value(section.as_ref(), direction) - closed).abs() < 1e-12, "N = {N}");
        let closed = (radius * radius - f64::max(beyond - half_length, 0.0).powi(2)).sqrt();
        assert!((support_value(cap.as_ref(), direction) - closed).abs() < 1e-12, "N = {N}");
    }
    for outside in [0.5, 0.6, -7.0] {
        assert!(Solid::Curved(Arc::clone(&body)).section::<M>(&frame(Vector::unit(1), outside)).is_none());
    }
}

#[test]
fn capsules_are_cut_as_the_closed_forms_say() {
    capsules::<2, 1>();
    capsules::<3, 2>();
    capsules::<4, 3>();
    capsules::<5, 4>();
    capsules::<6, 5>();
}

/// A turned rounded cube: points of the section's boundary lie in the hyperplane, in the body, and nothing of the body in
/// the hyperplane goes beyond. The distance to the cube is a closed form.
fn rounded_cubes<const N: usize, const M: usize>() {
    let mut random = Random(20 + N as u64);
    let (half, radius) = (0.6, 0.25);
    let cube = Shape::<N>::cuboid(Vector::splat(half)).unwrap();
    let pose = Pose::new(random.rotation(), random.vector());
    let shape = Shape::compound(vec![(pose, Shape::rounded(cube, radius).unwrap())]).unwrap();
    let body = curved(&shape);
    let distance = |p: Vector<N>| {
        let inside = pose.inverse_transform_point(p);
        (inside.abs() - Vector::splat(half)).max(Vector::ZERO).norm()
    };
    for _ in 0..10 {
        let slice = frame(random.direction(), 0.0);
        let slice =
            SliceFrame::new(Pose::new(slice.space_from_slice().rotation, pose.translation + random.vector() * 0.5));
        let Some(Solid::Curved(section)) = Solid::Curved(Arc::clone(&body)).section::<M>(&slice) else {
            continue;
        };
        for _ in 0..20 {
            let direction = random.direction::<M>();
            let farthest = section.support(direction);
            assert!((distance(slice.to_space(farthest)) - radius).abs() < 1e-11);
            // Beyond the tangent hyperplane there is nothing of the body.
            for _ in 0..20 {
                let aside = random.vector::<M>();
                let aside = aside - direction * aside.dot(direction);
                let p = slice.to_space(farthest + aside * random.unit() + direction * 1e-7);
                assert!(distance(p) > radius - 1e-9);
            }
        }
    }
}

#[test]
fn sections_of_rounded_cubes_touch_their_boundary() {
    rounded_cubes::<2, 1>();
    rounded_cubes::<3, 2>();
    rounded_cubes::<4, 3>();
    rounded_cubes::<5, 4>();
}

fn balls_and_half_spaces<const N: usize, const M: usize>() {
    let mut random = Random(30 + N as u64);
    let ball = Shape::<N>::ball(0.7).unwrap();
    // ∫ of the volume of the sections, with the closed form of the section and x = r sin t.
    let mut sum = 0.0;
    let steps = 400;
    for k in 0..steps {
        let t = ((f64::from(k) + 0.5) / f64::from(steps) - 0.5) * std::f64::consts::PI;
        let slice = frame(random.direction::<N>(), 0.7 * t.sin());
        let Some(Solid::Ball { radius, centre }) = ball.solids()[0].section::<M>(&slice) else { panic!("no ball") };
        assert!(centre.norm() < 1e-14);
        let weight = 0.7 * t.cos() * std::f64::consts::PI / f64::from(steps);
        sum += weight * volume::unit_ball(M) * radius.powi(M as i32);
    }
    let volume = ball.mass_properties(1.0).unwrap().mass;
    assert!((sum / volume - 1.0).abs() < 1e-5, "{sum} for {volume}");
    let normal = random.direction::<N>();
    let half_space = Shape::half_space(normal, 0.4).unwrap().solids().remove(0);
    let slice = frame(random.direction::<N>(), 0.2);
    let Some(Solid::HalfSpace { normal: within, offset }) = half_space.section::<M>(&slice) else { panic!("none") };
    for _ in 0..20 {
        let p = random.vector::<M>() * 2.0;
        let (outside, inside) = (normal.dot(slice.to_space(p)) - 0.4, within.dot(p) - offset);
        assert!(outside * inside > -1e-13);
    }
    assert!(half_space.section::<M>(&frame(normal, 0.41)).is_none());
    assert!(half_space.section::<M>(&frame(normal, 0.39)).is_some());
    assert_eq!(half_space.to_polytope(0.1).unwrap_err().kind(), GeometryErrorKind::Unsupported);
}

#[test]
fn balls_stay_balls_and_half_spaces_half_spaces() {
    balls_and_half_spaces::<2, 1>();
    balls_and_half_spaces::<3, 2>();
    balls_and_half_spaces::<4, 3>();
    balls_and_half_spaces::<5, 4>();
    balls_and_half_spaces::<6, 5>();
}

#[test]
fn polytopes_of_curved_sections_keep_their_bound() {
    let mut random = Random(40);
    let core = polytope::<4>("24-cell", Size::Circumradius(0.8)).unwrap();
    let shapes = [
        Shape::<4>::capsule(0.7, 0.4, 2).unwrap(),
        Shape::rounded(Shape::polytope(core.into()).unwrap(), 0.2).unwrap(),
        Shape::rounded(Shape::cuboid(Vector([0.4, 0.5, 0.6, 0.7])).unwrap(), 0.1).unwrap(),
    ];
    for shape in shapes {
        let slice = frame(random.direction::<4>(), 0.1);
        let section = shape.solids()[0].section::<3>(&slice).unwrap();
        let Solid::Curved(body) = &section else { panic!("not curved") };
        let mut previous = 0.0;
        for tolerance in [3e-2, 1e-2, 3e-3] {
            let inner = approximate(body.as_ref(), tolerance).unwrap();
            for facet in inner.facets() {
                assert!(support_value(body.as_ref(), facet.normal) - facet.offset <= tolerance);
            }
            for &vertex in inner.vertices() {
                // On the boundary: some support reaches it.
                let outward = vertex - inner.vertex_mean();
                assert!(
                    support_value(body.as_ref(), outward.normalize_or_zero())
                        >= vertex.dot(outward) / outward.norm() - 1e-9
                );
            }
            let content = section.to_polytope(tolerance).unwrap().unwrap().mass_properties().mass;
            assert!(content > previous, "finer polytopes hold more");
            previous = content;
        }
        for bad in [0.0, -1.0, f64::NAN] {
            assert_eq!(section.to_polytope(bad).unwrap_err().kind(), GeometryErrorKind::BadNumber);
        }
    }
}

/// The volume of the sections, integrated over the offset, for shapes of three dimensions: their sections are polygons
/// whose area is right to the tolerance times the perimeter.
#[test]
fn areas_of_curved_sections_add_up() {
    let mut random = Random(50);
    let core = polytope::<3>("octahedron", Size::Circumradius(0.8)).unwrap();
    let turn: Rotation<3> = random.rotation();
    let place = |shape: Shape<3>| Shape::compound(vec![(Pose::new(turn, Vector::ZERO), shape)]).unwrap();
    let shapes = [
        place(Shape::capsule(0.7, 0.4, 2).unwrap()),
        place(Shape::rounded(Shape::polytope(core.into()).unwrap(), 0.2).unwrap()),
        place(Shape::rounded(Shape::cuboid(Vector([0.4, 0.5, 0.6])).unwrap(), 0.1).unwrap()),
    ];
    for shape in shapes {
        let solid = shape.solids().remove(0);
        let body = curved(&shape);
        let normal = Vector::unit(2);
        let (top, bottom) = (support_value(body.as_ref(), normal), -support_value(body.as_ref(), -normal));
        let (middle, half) = (0.5 * (top + bottom), 0.5 * (top - bottom));
        // x = sin t is smooth at both ends, where the area goes to zero; the trapezoidal rule in t.
        let steps = 96;
        let mut sum = 0.0;
        for k in 1..steps {
            let t = (f64::from(k) / f64::from(steps) - 0.5) * std::f64::consts::PI;
            let section = solid.section::<2>(&frame(normal, middle + half * t.sin())).unwrap();
            let area = section.to_polytope(1e-6).unwrap().unwrap().mass_properties().mass;
            sum += area * half * t.cos() * std::f64::consts::PI / f64::from(steps);
        }
        let volume = shape.mass_properties(1.0).unwrap().mass;
        assert!((sum / volume - 1.0).abs() < 2e-5, "{sum} for {volume}");
    }
}

//! Areas in pictures against those of exact sections, to a percent: in two and three dimensions, of sections of sections, in
//! perspective, and of rounded bodies.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use crate::common::{
    PIXEL, SIDE, area_and_perimeter, count, covered, covered_from, cut, far_camera, shadow, turned, world_of,
};
use hyperbody::geometry::section::SectionPolytope;
use hyperbody::geometry::{Polytope, regular};
use hyperbody::math::{Pose, Rotation, Vector};
use hyperbody::prelude::Shape;
use hyperbody_render::{Camera, Slice};

fn is_exact(what: &str, area: f64, exact: f64) {
    assert!(exact > 0.5, "{what}: {exact} prove little");
    assert!((area / exact - 1.0).abs() < 0.01, "{what}: {area} instead of {exact}");
}

fn area<const N: usize>(shape: Shape<N>, pose: Pose<N>, slice: &Slice<N>) -> f64 {
    count(&covered(&world_of(shape, pose), slice)) as f64 * PIXEL * PIXEL
}

fn solid<const N: usize>(polytope: &Polytope<N>) -> Shape<N> {
    Shape::polytope(Arc::new(polytope.clone())).unwrap()
}

fn regular<const N: usize>(name: &str, circumradius: f64) -> Polytope<N> {
    regular::polytope(name, regular::Size::Circumradius(circumradius)).unwrap()
}

#[test]
fn flat_bodies_have_their_area() {
    for name in ["triangle", "square", "pentagon", "hexagon"] {
        let polygon = regular::<2>(name, 1.6);
        let [exact, _] = area_and_perimeter(polygon.vertices());
        is_exact(name, area(solid(&polygon), Pose::new(turned(0.7), Vector([0.1, -0.2])), &Slice::natural()), exact);
    }
    is_exact("a disc", area(Shape::<2>::ball(1.3).unwrap(), Pose::IDENTITY, &Slice::natural()), PI * 1.69);
}

#[test]
fn solids_of_three_dimensions_have_the_area_of_their_shadow() {
    for name in ["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"] {
        let (polytope, pose) = (regular::<3>(name, 1.6), Pose::new(turned(0.9), Vector([0.1, -0.1, 0.3])));
        let [exact, _] = shadow(&SectionPolytope::from_polytope(&polytope).placed(&pose));
        is_exact(name, area(solid(&polytope), pose, &Slice::natural()), exact);
    }
}

/// The vertices of a polytope of x, y and w at both ends of an interval of z.
fn prism(base: &Polytope<3>, half_length: f64) -> Polytope<4> {
    let points: Vec<Vector<4>> = base
        .vertices()
        .iter()
        .flat_map(|v| [-1.0, 1.0].map(|end| Vector([v[0], v[1], end * half_length, v[2]])))
        .collect();
    Polytope::from_points(&points).unwrap()
}

/// A prism along the line of sight shows the two-dimensional section of its base.
#[test]
fn prisms_show_the_flat_sections_of_their_bases() {
    for (name, place) in [("cube", 0.3), ("octahedron", 0.25), ("dodecahedron", 0.5), ("icosahedron", -0.4)] {
        let vertices: Vec<Vector<3>> =
            regular::<3>(name, 1.6).vertices().iter().map(|v| turned::<3>(0.8).rotate(*v)).collect();
        let base = Polytope::from_points(&vertices).unwrap();
        let lowered = Pose::from_translation(Vector([0.0, 0.0, -place]));
        let flat: SectionPolytope<2> = cut(&SectionPolytope::from_polytope(&base).placed(&lowered));
        let [exact, _] = area_and_perimeter(flat.vertices());
        let slice = Slice::natural().moved(Vector::unit(3) * place);
        is_exact(name, area(solid(&prism(&base, 0.7)), Pose::IDENTITY, &slice), exact);
    }
}

/// From nearby: the hull of the vertices of the section as the eye sees them.
#[test]
fn sections_have_the_exact_area_in_perspective() {
    for (name, distance) in [("24-cell", 3.0), ("8-cell", 2.6), ("16-cell", 2.6)] {
        let polytope = regular::<4>(name, 1.5);
        let slice = Slice::<4>::new(Pose::new(turned(0.6), Vector([0.1, -0.1, 0.05, 0.3])));
        let section: SectionPolytope<3> =
            cut(&SectionPolytope::from_polytope(&polytope).placed(&slice.pose().inverse()));
        let camera = Camera { field_of_view: 1.3, ..Camera::around(Vector::ZERO, Vector::unit(1), distance, 0.5, 0.4) };
        let forward = (camera.target - camera.eye).try_normalize().unwrap();
        let right = cross(forward, camera.up).try_normalize().unwrap();
        let above = cross(right, forward);
        let scale = 0.5 * f64::from(SIDE) / (0.5 * camera.field_of_view).tan();
        let seen = |point: &Vector<3>| {
            let from_eye = *point - camera.eye;
            Vector([right, above].map(|axis| scale * from_eye.dot(axis) / from_eye.dot(forward)))
        };
        let places: Vec<Vector<2>> = section.vertices().iter().map(seen).collect();
        let largest = places.iter().map(|place| place.max_abs()).fold(0.0, f64::max);
        assert!((50.0..100.0).contains(&largest), "{name} fills the picture to {largest} of 100 pixels");
        let [exact, _] = area_and_perimeter(&places);
        let world = world_of(solid(&polytope), Pose::IDENTITY);
        is_exact(name, count(&covered_from(&world, &slice, &camera)) as f64, exact);
    }
}

fn cross(a: Vector<3>, b: Vector<3>) -> Vector<3> {
    Vector([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
}

/// The shadow of a body rounded by r is the core's, with a rim of breadth r: A + r P + π r² (J. Steiner, 1840).
fn rounded([area, perimeter]: [f64; 2], radius: f64) -> f64 {
    area + radius * perimeter + PI * radius * radius
}

#[test]
fn rounded_bodies_have_the_area_of_their_sections() {
    let radius = 0.3;
    for name in ["tetrahedron", "cube", "icosahedron"] {
        let core = regular::<3>(name, 1.2);
        let pose = Pose::new(turned(0.9), Vector([0.1, -0.1, 0.3]));
        let exact = rounded(shadow(&SectionPolytope::from_polytope(&core).placed(&pose)), radius);
        is_exact(name, area(Shape::rounded(solid(&core), radius).unwrap(), pose, &Slice::natural()), exact);
        // A prism over it along w: within its length the section is the rounded base, beyond it the base rounded by what
        // the ball has left there.
        let turned_core: Vec<Vector<3>> = core.vertices().iter().map(|v| turned::<3>(0.9).rotate(*v)).collect();
        let ends = turned_core.iter().flat_map(|v| [-0.5, 0.5].map(|w| Vector([v[0], v[1], v[2], w])));
        let long = Polytope::<4>::from_points(&ends.collect::<Vec<_>>()).unwrap();
        let flat: Vec<Vector<2>> = turned_core.iter().map(|v| Vector([v[0], v[1]])).collect();
        for (place, left) in [(0.2, radius), (0.6, (0.09_f64 - 0.01).sqrt()), (-0.75, (0.09_f64 - 0.0625).sqrt())] {
            let slice = Slice::natural().moved(Vector::unit(3) * place);
            let shape = Shape::rounded(solid(&long), radius).unwrap();
            let exact = rounded(area_and_perimeter(&flat), left);
            is_exact(&format!("{name} at w = {place}"), area(shape, Pose::IDENTITY, &slice), exact);
        }
    }
}

/// A capsule along w is a ball in every slice across it; along x it is as long as it is, and as thin as the slice leaves it.
#[test]
fn capsules_have_the_area_of_their_sections() {
    let (half, radius) = (0.8, 0.6);
    for beside in [0.0, 0.3, 0.5] {
        let left = f64::sqrt(radius * radius - beside * beside);
        let slice = Slice::<4>::natural().moved(Vector::unit(3) * beside);
        let along_x = Shape::<4>::capsule(half, radius, 0).unwrap();
        let exact = 4.0 * half * left + PI * left * left;
        is_exact(
            "along x",
            area(along_x.clone(), Pose::new(Rotation::in_plane(0, 1, 0.4), Vector::ZERO), &slice),
            exact,
        );
        let along_w = Pose::new(Rotation::in_plane(0, 3, FRAC_PI_2), Vector::ZERO);
        is_exact("along w", area(along_x, along_w, &slice), PI * radius * radius);
    }
    assert!(far_camera().field_of_view < 1e-3, "areas are measured without perspective");
}

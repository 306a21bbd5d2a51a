//! Projections: known outlines, Cauchy's formula for cubes, straight lines and heights in perspective, shadows of curved bodies.

use crate::common::Random;
use hyperbody_geometry::product::Factor;
use hyperbody_geometry::regular::{Size, polytope};
use hyperbody_geometry::{MassProperties, Projection, SectionPolytope, Shape, SliceFrame, Solid, Wireframe, volume};
use hyperbody_math::Vector;

fn frame<const N: usize>(normal: impl Into<Vector<N>>, offset: f64) -> SliceFrame<N> {
    SliceFrame::from_normal(normal, offset).unwrap()
}

fn tables(name: &str) -> SectionPolytope<4> {
    SectionPolytope::from_polytope(&polytope::<4>(name, Size::Circumradius(1.0)).unwrap())
}

#[test]
fn outlines_of_regular_polytopes_are_the_known_ones() {
    let outline = |name: &str, normal: [f64; 4]| {
        let seen: Wireframe<3> = tables(name).project(&Projection::parallel(frame(normal, 0.0))).unwrap();
        seen.outline().unwrap().face_lattice().face_counts()
    };
    let (w, diagonal) = ([0.0, 0.0, 0.0, 1.0], [1.0; 4]);
    // H. S. M. Coxeter, "Regular Polytopes", §13: a cube; a rhombic dodecahedron; an octahedron; a cube; of the 24-cell a
    // cuboctahedron along the middle of a cell and a rhombic dodecahedron along a vertex.
    assert_eq!(outline("tesseract", w), [8, 12, 6]);
    assert_eq!(outline("tesseract", diagonal), [14, 24, 12]);
    assert_eq!(outline("16-cell", w), [6, 12, 8]);
    assert_eq!(outline("16-cell", diagonal), [8, 12, 6]);
    assert_eq!(outline("24-cell", diagonal), [12, 24, 14]);
    assert_eq!(outline("24-cell", [1.0, 1.0, 0.0, 0.0]), [14, 24, 12]);
    // All edges and faces are there, those behind as well.
    for (name, edges, polygons) in
        [("5-cell", 10, 10), ("24-cell", 96, 96), ("120-cell", 1200, 720), ("600-cell", 720, 1200)]
    {
        let seen: Wireframe<3> = tables(name).project(&Projection::parallel(frame(w, 0.3))).unwrap();
        assert_eq!((seen.edges().len(), seen.polygons().len()), (edges, polygons), "{name}");
        let sides: usize = seen.polygons().iter().map(Vec::len).sum();
        assert_eq!(sides, polygons * if name == "120-cell" { 5 } else { 3 }, "{name}");
    }
}

/// The shadow of the cube [0, 1]^N along a unit vector n has the volume Σ |n_i| (A. Cauchy, 1841): half of the facets, each
/// under the cosine of its normal.
fn cubes<const N: usize, const M: usize>() {
    let mut random = Random(500 + N as u64);
    let cube = Shape::<N>::cuboid(Vector::splat(0.5)).unwrap();
    let mut worst: f64 = 0.0;
    for _ in 0..20 {
        let normal = random.direction::<N>();
        let shadow = cube.solids()[0].shadow::<M>(&frame(normal, random.symmetric())).unwrap();
        worst = worst.max((shadow.volume(1e-9).unwrap() - normal.abs().iter().sum::<f64>()).abs());
    }
    println!("{N}D: shadows of cubes are Cauchy's to {worst:.1e}");
    assert!(worst < 1e-11, "{worst:e}");
}

#[test]
fn shadows_of_cubes_have_cauchys_volume() {
    cubes::<3, 2>();
    cubes::<4, 3>();
    cubes::<5, 4>();
    cubes::<6, 5>();
}

fn perspective<const N: usize, const M: usize>() {
    let mut random = Random(520 + N as u64);
    for _ in 0..40 {
        let slice = frame(random.direction::<N>(), 0.3 * random.symmetric());
        let projection = Projection::perspective(slice, 5.0).unwrap();
        let eye = slice.space_from_slice().translation + slice.normal() * 5.0;
        let point = random.vector::<N>();
        let (landed, height) = projection.point::<M>(point).unwrap();
        // Eye, point and picture are on one line, and the picture is in the hyperplane.
        let (sight, seen) = (slice.to_space(landed) - eye, point - eye);
        let sine_sq = 1.0 - (sight.dot(seen) / (sight.norm() * seen.norm())).powi(2);
        assert!(sine_sq.abs() < 1e-12 && (height - slice.height(point)).abs() < 1e-14);
        // What lies in the hyperplane keeps its size.
        let flat = slice.to_space(random.vector::<M>());
        let (kept, _) = projection.point::<M>(flat).unwrap();
        assert!((kept - slice.to_slice::<M>(flat)).norm() < 1e-12);
        // From far away the two projections are the same.
        let far = Projection::perspective(slice, 1e6).unwrap().point::<M>(point).unwrap().0;
        assert!((far - Projection::parallel(slice).point::<M>(point).unwrap().0).norm() < 1e-5);
        assert!(projection.point::<M>(eye).is_none() && projection.point::<M>(eye + slice.normal()).is_none());
    }
}

#[test]
fn eye_point_and_picture_are_on_one_line() {
    perspective::<2, 1>();
    perspective::<3, 2>();
    perspective::<4, 3>();
    perspective::<5, 4>();
    perspective::<6, 5>();
}

#[test]
fn a_tesseract_is_a_cube_in_a_cube_and_goes_on_to_the_plane() {
    let body = SectionPolytope::from_polytope(&polytope::<4>("tesseract", Size::Edge(2.0)).unwrap());
    let seen: Wireframe<3> =
        body.project(&Projection::perspective(frame([0.0, 0.0, 0.0, 1.0], 0.0), 3.0).unwrap()).unwrap();
    for (v, height) in seen.vertices().iter().zip(seen.heights()) {
        let half = if *height > 0.0 { 1.5 } else { 0.75 };
        assert!(v.iter().all(|c| (c.abs() - half).abs() < 1e-14), "{v:?} at {height}");
    }
    let flat: Wireframe<2> = seen.project(&Projection::perspective(frame([0.0, 0.0, 1.0], 0.0), 6.0).unwrap()).unwrap();
    assert_eq!((flat.vertices().len(), flat.edges().len(), flat.polygons().len()), (16, 32, 24));
    let outline = flat.outline().unwrap();
    // The near face of the large cube, 1.5 before the plane: 1.5 · 6/4.5.
    assert!((MassProperties::of_polytope(&outline).mass - 16.0).abs() < 1e-12);
    let inside = Projection::perspective(frame([0.0, 0.0, 0.0, 1.0], 0.0), 0.5).unwrap();
    assert!(body.project::<3>(&inside).unwrap_err().to_string().contains("farther"));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Projection::perspective(frame([0.0, 0.0, 0.0, 1.0], 0.0), bad).is_err());
    }
}

#[test]
fn shadows_of_curved_bodies_are_as_wide_as_the_bodies() {
    let mut random = Random(540);
    let w = frame(Vector::<4>::unit(3), 0.2);
    let disc = |axes: [usize; 2], radius: f64| Factor::new(axes, &Shape::<2>::ball(radius).unwrap()).unwrap();
    let duocylinder = Shape::<4>::product(vec![disc([0, 1], 0.7), disc([2, 3], 0.4)]).unwrap();
    // Along w the second disc becomes a segment: a cylinder.
    let cylinder = duocylinder.solids()[0].shadow::<3>(&w).unwrap().volume(1e-8).unwrap();
    assert!((cylinder - std::f64::consts::PI * 0.49 * 0.8).abs() < 1e-7, "{cylinder}");
    let Some(Solid::Ball { radius, .. }) = Shape::<4>::ball(0.6).unwrap().solids()[0].shadow::<3>(&w) else {
        panic!("not a ball")
    };
    assert_eq!(radius, 0.6);
    // A capsule along its axis is a ball, across it a capsule.
    let capsule = Shape::<4>::capsule(0.5, 0.3, 0).unwrap();
    let along = capsule.solids()[0].shadow::<3>(&frame(Vector::<4>::unit(0), 0.0)).unwrap().volume(1e-8).unwrap();
    assert!((along - volume::unit_ball(3) * 0.027).abs() < 1e-7);
    for _ in 0..20 {
        let slice = frame(random.direction::<4>(), 0.0);
        let shadow = capsule.solids()[0].shadow::<3>(&slice).unwrap();
        let direction = random.direction::<3>();
        assert!(
            (shadow.reach(direction) - capsule.solids()[0].reach(slice.direction_to_space(direction))).abs() < 1e-14
        );
    }
}

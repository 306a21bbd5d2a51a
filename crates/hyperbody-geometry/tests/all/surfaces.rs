//! Surfaces of sections: closed, oriented, and the same in every file format.

use std::collections::BTreeMap;

use crate::common::Random;
use hyperbody_geometry::regular::{Size, polytope};
use hyperbody_geometry::{Polytope, Shape, SliceFrame, Surface, off, star};
use hyperbody_math::{Matrix, Pose, Vector};

/// Sections of polychora and of curved shapes, with their volumes.
fn samples() -> Vec<(Surface, f64)> {
    let mut random = Random(3);
    let regular = |name| Shape::polytope(polytope::<4>(name, Size::Circumradius(1.0)).unwrap().into()).unwrap();
    let rounded = Shape::rounded(Shape::<4>::cuboid([0.4, 0.5, 0.6, 0.7]).unwrap(), 0.1).unwrap();
    let shapes = [
        regular("tesseract"),
        regular("24-cell"),
        regular("600-cell"),
        regular("120-cell"),
        rounded,
        Shape::ball(1.0).unwrap(),
    ];
    let mut samples = Vec::new();
    for shape in shapes {
        for offset in [0.0, 0.2, 0.5] {
            let frame = SliceFrame::from_normal(random.direction::<4>(), offset).unwrap();
            let solid = shape.solids()[0].section::<3>(&frame).unwrap();
            let mut surface = Surface::new();
            surface.add_solid(&solid, 1e-2, 7).unwrap();
            samples.push((surface, solid.to_polytope(1e-2).unwrap().unwrap().mass_properties().mass));
        }
    }
    samples
}

/// Volume of triangles as pyramids from the origin.
fn volume(triangles: impl Iterator<Item = [Vector<3>; 3]>) -> f64 {
    triangles.map(|corners| Matrix::from_columns(corners).determinant() / 6.0).sum()
}

/// Every side of a triangle has exactly one partner that goes the other way.
fn assert_closed<K: Ord + Copy + std::fmt::Debug>(triangles: impl Iterator<Item = [K; 3]>) {
    let mut sides: BTreeMap<(K, K), u32> = BTreeMap::new();
    for [a, b, c] in triangles {
        for side in [(a, b), (b, c), (c, a)] {
            *sides.entry(side).or_default() += 1;
        }
    }
    for (&(a, b), &count) in &sides {
        assert_eq!((count, sides.get(&(b, a))), (1, Some(&1)), "{a:?} {b:?}");
    }
}

#[test]
fn surfaces_are_closed_and_face_outward() {
    for (surface, content) in samples() {
        assert_closed(surface.triangles().map(|(corners, _)| corners));
        let at = |corners: [u32; 3]| corners.map(|corner| surface.vertices()[corner as usize]);
        let found = volume(surface.triangles().map(|(corners, _)| at(corners)));
        assert!((found / content - 1.0).abs() < 1e-12, "{found} for {content}");
        assert!(surface.triangles().all(|(_, source)| source >= 7));
    }
}

fn single(bytes: &[u8], at: usize) -> f32 {
    f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

#[test]
fn stl_files_are_closed_in_single_precision() {
    for (surface, content) in samples() {
        let bytes = surface.to_stl();
        let count = u32::from_le_bytes([bytes[80], bytes[81], bytes[82], bytes[83]]) as usize;
        assert_eq!(bytes.len(), 84 + 50 * count);
        let corner = |t: usize, k: usize| [0, 1, 2].map(|axis| single(&bytes, 84 + 50 * t + 12 * (k + 1) + 4 * axis));
        assert_closed((0..count).map(|t| [0, 1, 2].map(|k| corner(t, k).map(f32::to_bits))));
        let points = |t: usize| [0, 1, 2].map(|k| Vector(corner(t, k).map(f64::from)));
        let found = volume((0..count).map(points));
        assert!((found / content - 1.0).abs() < 1e-5, "{found} for {content}");
        for t in 0..count {
            let normal = Vector([0, 1, 2].map(|axis| f64::from(single(&bytes, 84 + 50 * t + 4 * axis))));
            assert!((normal.norm() - 1.0).abs() < 1e-6 || normal == Vector::ZERO);
        }
    }
}

#[test]
fn text_files_hold_the_same_polygons() {
    for (surface, content) in samples() {
        let file = off::parse(&surface.to_off()).unwrap();
        assert_eq!(file.elements(2).len(), surface.polygon_count());
        let hull = file.to_polytope::<3>().unwrap();
        assert!((hyperbody_geometry::MassProperties::of_polytope(&hull).mass / content - 1.0).abs() < 1e-9);
        let obj = surface.to_obj();
        let lines = |start: &str| obj.lines().filter(|line| line.starts_with(start)).count();
        assert_eq!((lines("v "), lines("f ")), (surface.vertices().len(), surface.polygon_count()));
        let indices = obj.lines().filter_map(|line| line.strip_prefix("f ")).flat_map(str::split_whitespace);
        let numbers: Vec<usize> = indices.map(|word| word.parse().unwrap()).collect();
        assert_eq!((numbers.iter().min(), numbers.iter().max()), (Some(&1), Some(&surface.vertices().len())));
    }
}

#[test]
fn glb_files_have_the_lengths_that_they_say() {
    let word =
        |bytes: &[u8], at: usize| u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]) as usize;
    for (surface, content) in samples() {
        let bytes = surface.to_glb();
        assert_eq!((&bytes[..4], word(&bytes, 4), word(&bytes, 8)), (&b"glTF"[..], 2, bytes.len()));
        let json = word(&bytes, 12);
        assert_eq!((&bytes[16..20], json % 4), (&b"JSON"[..], 0));
        let text = std::str::from_utf8(&bytes[20..20 + json]).unwrap();
        assert_eq!(text.matches('{').count(), text.matches('}').count());
        let start = 20 + json;
        let binary = word(&bytes, start);
        assert_eq!((&bytes[start + 4..start + 8], start + 8 + binary), (&b"BIN\0"[..], bytes.len()));
        assert!(
            text.contains(&format!("\"byteLength\":{binary}")) && text.contains(&format!("\"count\":{}", binary / 28))
        );
        let corner = |k: usize| Vector([0, 1, 2].map(|axis| f64::from(single(&bytes, start + 8 + 28 * k + 4 * axis))));
        let found = volume((0..binary / 84).map(|t| [0, 1, 2].map(|k| corner(3 * t + k))));
        assert!((found / content - 1.0).abs() < 1e-5, "{found} for {content}");
    }
    assert_eq!(word(&Surface::new().to_glb(), 8), Surface::new().to_glb().len());
}

/// The middle of each polygon, its direction outward and its area.
fn faces(surface: &Surface) -> Vec<(Vector<3>, Vector<3>, f64)> {
    let face = |(corners, _): (&[u32], u32)| {
        let at = |k: usize| surface.vertices()[corners[k] as usize];
        let doubled = (1..corners.len() - 1).fold(Vector::ZERO, |sum, k| {
            let (a, b) = (at(k) - at(0), at(k + 1) - at(0));
            sum + Vector([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
        });
        let middle = (0..corners.len()).fold(Vector::ZERO, |sum, k| sum + at(k)) / corners.len() as f64;
        (middle, doubled.normalize_or_zero(), 0.5 * doubled.norm())
    };
    surface.polygons().map(face).collect()
}

/// The section of a shape of pieces with all walls, and without.
fn with_and_without_walls(shape: &Shape<4>, frame: &SliceFrame<4>) -> [Surface; 2] {
    let mut surface = Surface::new();
    for solid in shape.solids().iter().filter_map(|solid| solid.section::<3>(frame)) {
        surface.add_solid(&solid, 1e-2, 0).unwrap();
    }
    let open = surface.without_walls();
    [surface, open]
}

#[test]
fn walls_between_pieces_are_no_surface() {
    let mut random = Random(91);
    // A box with a smaller one on it, which covers a quarter of its top.
    let large = (Pose::IDENTITY, Shape::<4>::cuboid([1.0, 0.5, 0.5, 1.0]).unwrap());
    let small = (Pose::from_translation(Vector([0.3, 1.0, 0.0, 0.2])), Shape::cuboid([0.25, 0.5, 0.25, 1.0]).unwrap());
    let pose = Pose::new(random.rotation(), random.vector());
    let turned = [&large, &small].map(|(own, shape)| (pose * *own, shape.clone()));
    let turned = Shape::compound(turned.to_vec()).unwrap();
    let shape = Shape::compound(vec![large, small]).unwrap();
    let [closed, open] = with_and_without_walls(&shape, &SliceFrame::from_normal([0.0, 0.0, 0.0, 1.0], 0.1).unwrap());
    let area = |surface: &Surface| faces(surface).iter().map(|face| face.2).sum::<f64>();
    assert!((area(&closed) - area(&open) - 0.5).abs() < 1e-12, "{} {}", area(&closed), area(&open));
    assert!((area(&open) - (10.0 + 4.0 * 0.5)).abs() < 1e-12, "{}", area(&open));
    assert_eq!(
        (closed.polygon_count(), open.polygon_count()),
        (12, 14),
        "the top is four polygons around the small box"
    );
    // In any direction the walls lie on each other to rounding.
    for _ in 0..5 {
        let frame = SliceFrame::from_normal(random.direction::<4>(), 0.1 * random.symmetric()).unwrap();
        let [closed, open] = with_and_without_walls(&turned, &frame);
        let triangles =
            |surface: &Surface| volume(surface.triangles().map(|(t, _)| t.map(|c| surface.vertices()[c as usize])));
        assert!((triangles(&closed) - triangles(&open)).abs() < 1e-9);
        assert!(area(&open) <= area(&closed));
    }
}

/// Just outside of each face there is no cell, and just inside there is one.
#[test]
fn sections_of_stars_are_their_outside() {
    let cells: Vec<Polytope<4>> =
        star::cells(&star::symbol("{5/2,5,3}").unwrap(), Size::Circumradius(1.0), 200).unwrap();
    let place = |cell: &Polytope<4>| (Pose::IDENTITY, Shape::polytope(cell.clone().into()).unwrap());
    let shape = Shape::compound(cells.iter().map(place).collect()).unwrap();
    let mut random = Random(92);
    for offset in [0.05, 0.3] {
        let frame = SliceFrame::from_normal(random.direction::<4>(), offset).unwrap();
        let [closed, open] = with_and_without_walls(&shape, &frame);
        let holds = |point: Vector<3>| {
            let point = frame.space_from_slice().transform_point(Vector([point[0], point[1], point[2], 0.0]));
            cells.iter().any(|cell| cell.facets().iter().all(|f| f.normal.dot(point) <= f.offset))
        };
        for (middle, outward, area) in faces(&open).into_iter().filter(|face| face.2 > 1e-6) {
            assert!(!holds(middle + outward * 1e-6) && holds(middle - outward * 1e-6), "{middle:?}, {area} m²");
        }
        println!("{} polygons, {} without walls", closed.polygon_count(), open.polygon_count());
        assert!(open.polygon_count() < closed.polygon_count());
    }
}

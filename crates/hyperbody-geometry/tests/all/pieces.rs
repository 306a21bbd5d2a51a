//! Pieces of surfaces: polygons of the plane, hollows that touch what is around them, thousands of pieces, and faces that are not flat.

use hyperbody_geometry::decompose::convex_cells;
use hyperbody_geometry::{GeometryErrorKind, MassProperties, OffFile, off};

/// The content of the surface in a file, which has to be that of its convex cells.
fn content<const N: usize>(text: &str) -> f64 {
    let file = off::parse(text).unwrap();
    let (points, surface) = (file.vertices::<N>().unwrap(), file.boundary::<N>().unwrap());
    let properties = MassProperties::of_closed_boundary(&points, &surface).unwrap();
    let (moments, _) = properties.principal();
    assert!(moments.iter().all(|moment| moment > 0.0), "moments of {text}: {moments:?}");
    let cells = convex_cells(&points, &surface).unwrap();
    let sum: f64 = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
    assert!((sum / properties.mass - 1.0).abs() < 1e-9, "cells of {sum}, surface of {} m^{N}: {text}", properties.mass);
    properties.mass
}

/// The corners and faces of an axis-aligned box, faces in any order.
struct Box3 {
    low: [f64; 3],
    high: [f64; 3],
}

const FACES: [&[u32]; 6] = [&[0, 1, 3, 2], &[4, 6, 7, 5], &[0, 4, 5, 1], &[2, 3, 7, 6], &[0, 2, 6, 4], &[1, 5, 7, 3]];

impl Box3 {
    fn corners(&self) -> Vec<[f64; 3]> {
        let at = |k: usize, axis: usize| if k >> (2 - axis) & 1 == 0 { self.low[axis] } else { self.high[axis] };
        (0..8).map(|k| std::array::from_fn(|axis| at(k, axis))).collect()
    }
}

/// Corners and faces.
type Piece<'a> = (Vec<[f64; 3]>, &'a [&'a [u32]]);

/// A file of several pieces.
fn file_of(pieces: &[Piece<'_>]) -> String {
    let (mut vertices, mut faces, mut first, mut count) = (String::new(), String::new(), 0, 0);
    for (corners, own) in pieces {
        corners.iter().for_each(|[x, y, z]| vertices += &format!("{x} {y} {z}\n"));
        for face in *own {
            faces += &face.len().to_string();
            face.iter().for_each(|v| faces += &format!(" {}", v + first));
            faces += "\n";
        }
        first += corners.len() as u32;
        count += own.len();
    }
    format!("OFF\n{first} {count} 0\n{vertices}{faces}")
}

fn cube(half: f64) -> Piece<'static> {
    (Box3 { low: [-half; 3], high: [half; 3] }.corners(), &FACES)
}

#[test]
fn polygons_of_the_plane_are_pieces_like_others() {
    let square = "-2 -2\n2 -2\n2 2\n-2 2\n";
    let beside = "4 1\n6 1\n6 -1\n4 -1\n";
    let hole = "-1 -1\n1 -1\n1 1\n-1 1\n";
    for (second, expected) in [(beside, 20.0), (hole, 12.0)] {
        for order in ["4 5 6 7", "7 6 5 4"] {
            let found = content::<2>(&format!("2OFF\n8 2 0\n{square}{second}4 0 1 2 3\n4 {order}\n"));
            assert!((found - expected).abs() < 1e-12, "{found} for {expected}, second polygon {order}");
        }
    }
    // Side by side with a common edge, which is listed in either direction.
    for order in ["4 3 2 1", "1 2 3 4"] {
        let found = content::<2>(&format!("2OFF\n6 2 7\n0 0\n1 0\n2 0\n2 1\n1 1\n0 1\n4 0 1 4 5\n4 {order}\n"));
        assert!((found - 2.0).abs() < 1e-12, "{found}, second polygon {order}");
    }
}

#[test]
fn hollows_may_touch_the_surface_around_them() {
    // An octahedron with one tip on a face, and all six on the middles of faces: its vertices do not tell then.
    let octahedron: [&[u32]; 8] =
        [&[0, 2, 4], &[2, 1, 4], &[1, 3, 4], &[3, 0, 4], &[2, 0, 5], &[1, 2, 5], &[3, 1, 5], &[0, 3, 5]];
    for (half, middle) in [(0.5, 0.5), (1.0, 0.0)] {
        let mut tips = Vec::new();
        for axis in 0..3 {
            for side in [-half, half] {
                let mut tip = [middle, 0.0, 0.0];
                tip[axis] += side;
                tips.push(tip);
            }
        }
        let found = content::<3>(&file_of(&[cube(1.0), (tips, &octahedron)]));
        let expected = 8.0 - 4.0 / 3.0 * half.powi(3);
        assert!((found / expected - 1.0).abs() < 1e-12, "octahedron of {half}: {found} for {expected}");
    }
    // A pit: a box with one face in that of the cube.
    let pit = Box3 { low: [-0.5, -0.5, 0.0], high: [0.5, 0.5, 1.0] };
    let found = content::<3>(&file_of(&[cube(1.0), (pit.corners(), &FACES)]));
    assert!((found - 7.0).abs() < 1e-12, "{found}");
    // The other way out of the cube, side by side with it, it is a body.
    let tower = Box3 { low: [-0.5, -0.5, 1.0], high: [0.5, 0.5, 2.0] };
    let found = content::<3>(&file_of(&[cube(1.0), (tower.corners(), &FACES)]));
    assert!((found - 9.0).abs() < 1e-12, "{found}");
    // The same cube twice: hollow, body, or a mistake.
    let error = off::parse(&file_of(&[cube(1.0), cube(1.0)])).unwrap().boundary::<3>().unwrap_err();
    assert_eq!(error.kind(), GeometryErrorKind::BadMesh);
    assert!(error.to_string().contains("faces 0 and 6 lie upon each other"), "{error}");
}

/// Thousands of pieces far from each other, in a hollow, and one in the other.
#[test]
fn thousands_of_pieces_are_sorted_in_a_second() {
    let start = std::time::Instant::now();
    let small = |k: usize| {
        let at = |axis: u32| (k / 20_usize.pow(axis) % 20) as f64 - 9.5;
        let low = [at(0), at(1), at(2)];
        (Box3 { low, high: low.map(|c| c + 0.5) }.corners(), &FACES[..])
    };
    let mut pieces: Vec<_> = (0..8000).map(small).collect();
    pieces.extend([cube(11.0), cube(12.0)]);
    let file = off::parse(&file_of(&pieces)).unwrap();
    let surface = file.boundary::<3>().unwrap();
    let found = MassProperties::of_closed_boundary(&file.vertices::<3>().unwrap(), &surface).unwrap().mass;
    let expected = 24.0_f64.powi(3) - 22.0_f64.powi(3) + 1000.0;
    println!("{} pieces sorted: {:.1?}", pieces.len(), start.elapsed());
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} for {expected}");

    let start = std::time::Instant::now();
    // One within the other: each against each other is too much.
    let nested: Vec<_> = (1..=20_000).map(|k| cube(f64::from(k))).collect();
    let error = off::parse(&file_of(&nested)).unwrap().boundary::<3>().unwrap_err();
    println!("{} nested cubes are refused: {:.1?}", nested.len(), start.elapsed());
    assert_eq!(error.kind(), GeometryErrorKind::BadCount);
    assert!(error.to_string().contains("the surface has 20000 pieces"), "{error}");
    // About a second; every pair of the small ones alone took minutes.
    assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
}

fn refusal<const N: usize>(file: &OffFile) -> Option<String> {
    file.check_flat::<N>().err().map(|error| error.to_string())
}

#[test]
fn faces_that_are_not_flat_are_refused_with_line_number_and_distance() {
    let (mut corners, faces) = cube(1.0);
    corners[7] = [1.0, 1.0, 1.3];
    let text = file_of(&[(corners.clone(), faces)]);
    let error = off::parse(&text).unwrap().boundary::<3>().unwrap_err().to_string();
    assert!(
        error.starts_with("OFF, line 14: face 3 of rank 2 is not flat") || error.starts_with("OFF, line 16: face 5"),
        "{error}"
    );
    assert!(error.contains("m off the plane") && error.contains("divide it into triangles"), "{error}");
    // What four digits leave is passed over, and five units of the last place of them are not.
    let (sin, cos) = 0.6_f64.sin_cos();
    let turned = |bump: f64| {
        let (mut corners, faces) = cube(1.0);
        corners[7] = corners[7].map(|c| c + bump);
        let round = |c: f64| (c * 1e4).round() / 1e4;
        let turn = |[x, y, z]: [f64; 3]| {
            let (x, y) = (x * cos - y * sin, x * sin + y * cos);
            [x, y * cos - z * sin, y * sin + z * cos].map(round)
        };
        off::parse(&file_of(&[(corners.into_iter().map(turn).collect(), faces)])).unwrap()
    };
    assert_eq!(refusal::<3>(&turned(0.0)), None);
    assert!(refusal::<3>(&turned(1e-3)).is_some());
    // The cubes of a tesseract have to lie in spaces of three dimensions.
    let name = hyperbody_geometry::regular::Size::Edge(2.0);
    let tesseract = OffFile::from_polytope(&hyperbody_geometry::regular::polytope::<4>("tesseract", name).unwrap());
    assert_eq!(refusal::<4>(&tesseract), None);
    let bent = tesseract.to_string().replacen("-1 -1 -1 -1", "-1 -1 -1 -1.1", 1);
    let error = refusal::<4>(&off::parse(&bent).unwrap()).expect("it is bent");
    assert!(error.contains("of rank 2 is not flat") || error.contains("of rank 3 is not flat"), "{error}");
}

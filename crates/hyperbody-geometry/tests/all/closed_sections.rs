//! Sections of shapes of several pieces as surfaces: closed in every format, and around the volume that the section has.

use std::collections::BTreeMap;

use crate::common::{Random, grid};
use crate::products_of_pieces::star_shape;
use crate::second_hull::{simplices_of_hull, surface as random_mesh};
use hyperbody_geometry::decompose::convex_cells;
use hyperbody_geometry::product::Factor;
use hyperbody_geometry::regular::Size;
use hyperbody_geometry::{MassProperties, Polytope, Shape, SliceFrame, Solid, Surface, cut_pieces, off, star};
use hyperbody_math::{Pose, Vector};

/// The section of all pieces without walls, and its volume as the sum of theirs.
fn section(solids: &[Solid<4>], frame: &SliceFrame<4>) -> (Surface, f64) {
    let mut surface = Surface::new();
    let mut volume = 0.0;
    let cut = solids.iter().zip(cut_pieces(solids, frame)).filter(|(_, cut)| *cut);
    for section in cut.filter_map(|(solid, _)| solid.section::<3>(frame)) {
        let polytope = section.to_polytope(0.02).unwrap().unwrap();
        volume += polytope.mass_properties().mass;
        surface.add_polytope(&polytope, 0);
    }
    (surface.without_walls(), volume)
}

/// How often each directed side is there.
fn sides<K: Ord + Copy>(polygons: impl Iterator<Item = Vec<K>>) -> BTreeMap<(K, K), u32> {
    let mut sides = BTreeMap::new();
    for corners in polygons {
        for (k, &corner) in corners.iter().enumerate() {
            *sides.entry((corner, corners[(k + 1) % corners.len()])).or_default() += 1;
        }
    }
    sides
}

fn assert_balanced<K: Ord + Copy + std::fmt::Debug>(sides: &BTreeMap<(K, K), u32>, name: &str) {
    for (&(a, b), count) in sides {
        assert!(a == b || sides.get(&(b, a)) == Some(count), "{name}: {a:?} {b:?} {count} times");
    }
}

fn single(bytes: &[u8], at: usize) -> u32 {
    // Zeros of both signs are the same place.
    (f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]) + 0.0).to_bits()
}

/// Each side of a polygon is once that of another one, in files too; what the files enclose is `volume`.
fn assert_closed(surface: &Surface, volume: f64, name: &str) {
    let polygons = sides(surface.polygons().map(|(corners, _)| corners.to_vec()));
    assert!(polygons.values().all(|&count| count == 1), "{name}: a side of two polygons");
    assert_balanced(&polygons, name);
    let place = |bytes: &[u8], at: usize| [0, 4, 8].map(|k| single(bytes, at + k));
    let stl = surface.to_stl();
    let triangles = (0..(stl.len() - 84) / 50).map(|t| [12, 24, 36].map(|k| place(&stl, 84 + 50 * t + k)).to_vec());
    assert_balanced(&sides(triangles), name);
    let glb = surface.to_glb();
    let json = u32::from_le_bytes([glb[12], glb[13], glb[14], glb[15]]) as usize;
    let start = 28 + json;
    let triangles =
        (0..(glb.len() - start) / 84).map(|t| [0, 28, 56].map(|k| place(&glb, start + 84 * t + k)).to_vec());
    assert_balanced(&sides(triangles), name);
    let file = off::parse(&surface.to_off()).unwrap();
    let mesh = file.boundary::<3>().unwrap_or_else(|error| panic!("{name}: {error}"));
    let found = MassProperties::of_closed_boundary(&file.vertices::<3>().unwrap(), &mesh).unwrap().mass;
    assert!((found / volume - 1.0).abs() < 1e-9, "{name}: {found} for {volume}");
}

fn compound(cells: &[Polytope<4>]) -> Vec<Solid<4>> {
    let place = |cell: &Polytope<4>| (Pose::IDENTITY, Shape::polytope(cell.clone().into()).unwrap());
    Shape::compound(cells.iter().map(place).collect()).unwrap().solids()
}

fn check(solids: &[Solid<4>], frame: &SliceFrame<4>, name: &str) {
    let (surface, volume) = section(solids, frame);
    if volume > 0.0 {
        let name = format!("{name} across {:?} at {}", frame.normal().0, frame.offset());
        assert_closed(&surface, volume, &name);
    }
}

#[test]
fn sections_of_all_star_polychora_are_closed() {
    let mut random = Random(201);
    for (name, symbol) in star::NAMES.iter().filter(|(_, symbol)| symbol.matches(',').count() == 2) {
        let cells = star::cells::<4>(&star::symbol(symbol).unwrap(), Size::Circumradius(1.0), usize::MAX).unwrap();
        // Of the largest, what takes seconds and not a minute.
        let few = cells.len() > 10_000;
        let solids = compound(&cells);
        let mut frames = vec![SliceFrame::from_normal(random.direction::<4>(), 0.2 * random.symmetric()).unwrap()];
        if !few {
            for (normal, offset) in
                [([0.0, 0.0, 0.0, 1.0], 0.0), ([1.0, 1.0, 1.0, 1.0], 0.4), ([0.0, 0.0, 1.0, 0.0], 0.1)]
            {
                frames.push(SliceFrame::from_normal(normal, offset).unwrap());
            }
        }
        for frame in frames {
            check(&solids, &frame, name);
        }
    }
}

/// Bodies of unit cubes at random touch themselves along edges and in corners all over.
#[test]
fn sections_of_bodies_of_cubes_are_closed() {
    let mut random = Random(202);
    for body in 0..20 {
        let mut parts = Vec::new();
        for corner in grid::<4>(3) {
            if random.unit() < 0.4 {
                parts.push((Pose::from_translation(corner), Shape::cuboid([0.5; 4]).unwrap()));
            }
        }
        let solids = Shape::compound(parts).unwrap().solids();
        let name = format!("body {body}");
        for offset in [0.3, 0.5, 1.0, 1.5] {
            check(&solids, &SliceFrame::from_normal([0.0, 0.0, 0.0, 1.0], offset).unwrap(), &name);
        }
        check(&solids, &SliceFrame::from_normal([1.0, 1.0, 1.0, 1.0], 4.0).unwrap(), &name);
        check(&solids, &SliceFrame::from_normal([1.0, 1.0, 0.0, 1.0], 2.5).unwrap(), &name);
        let through = Vector::splat(1.0) + random.vector() * 0.5;
        let normal = random.direction::<4>();
        check(&solids, &SliceFrame::from_normal(normal, normal.dot(through)).unwrap(), &name);
    }
}

/// Meshes of random simplices, with cells that meet nowhere face to face.
#[test]
fn sections_of_random_meshes_are_closed() {
    let mut random = Random(203);
    for mesh in 0..12 {
        let points = random.sphere_points::<4>(9);
        let some: Vec<Vec<u32>> = simplices_of_hull(&points).into_iter().filter(|_| random.unit() < 0.6).collect();
        if some.is_empty() {
            continue;
        }
        let cells = convex_cells(&points, &random_mesh::<4>(&points, &some)).unwrap();
        let solids = compound(&cells);
        for _ in 0..6 {
            let frame = SliceFrame::from_normal(random.direction::<4>(), 0.4 * random.symmetric()).unwrap();
            check(&solids, &frame, &format!("mesh {mesh}"));
        }
    }
}

/// A prism over an L whose cells are two boxes: the face that both have is one polygon or two, with six corners in all.
#[test]
fn the_section_of_an_l_has_no_corners_to_spare() {
    let corner = Vector([0.5, 0.5, 0.5, 0.5]);
    let long = Shape::cuboid(Vector([1.0, 0.5, 0.5, 0.5])).unwrap();
    let short = Shape::cuboid(corner).unwrap();
    let parts = vec![
        (Pose::from_translation(Vector([1.0, 0.5, 0.5, 0.5])), long),
        (Pose::from_translation(Vector([0.5, 1.5, 0.5, 0.5])), short),
    ];
    let solids = Shape::compound(parts).unwrap().solids();
    for normal in [[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 0.1]] {
        let (surface, volume) = section(&solids, &SliceFrame::from_normal(normal, 0.45).unwrap());
        assert_closed(&surface, volume, "L");
        assert_eq!(
            (surface.vertices().len(), surface.polygon_count()),
            (12, 10),
            "six sides, and two times an L in two"
        );
    }
}

/// Flat walls between curved pieces, whose corners are not the same from both sides.
#[test]
fn sections_of_products_of_stars_are_closed() {
    let mut random = Random(204);
    let star = Factor::new([0, 1], &star_shape::<2>("{5/2}")).unwrap();
    let solid = Factor::new([0, 1, 2], &star_shape::<3>("{5/2,5}")).unwrap();
    let disc = Factor::new([2, 3], &Shape::<2>::ball(0.7).unwrap()).unwrap();
    let other = Factor::new([2, 3], &star_shape::<2>("{5/2}")).unwrap();
    let shapes = [
        ("pentagram times disc", Shape::<4>::product(vec![star.clone(), disc]).unwrap()),
        ("pentagram times pentagram", Shape::product(vec![star, other]).unwrap()),
        ("prism", Shape::product(vec![solid.clone(), Factor::segment(3, 0.4).unwrap()]).unwrap()),
        ("pyramid", Shape::pyramid(solid, 1.2).unwrap()),
    ];
    for (name, shape) in shapes {
        let solids = shape.solids();
        for axis in [0, 2, 3] {
            check(&solids, &SliceFrame::from_normal(Vector::unit(axis), 0.1).unwrap(), name);
        }
        for _ in 0..4 {
            check(&solids, &SliceFrame::from_normal(random.direction::<4>(), 0.2 * random.symmetric()).unwrap(), name);
        }
    }
}

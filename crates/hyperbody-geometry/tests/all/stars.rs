//! Star polytopes: the face counts and densities of the tables, volumes against flags, and bodies of the star polyhedra.

use crate::common::Random;
use hyperbody_geometry::regular::{self, Size};
use hyperbody_geometry::{GeometryErrorKind, MassProperties, OffFile, Polytope, off, star};
use hyperbody_math::{Matrix, Vector};

fn surface(name: &str) -> OffFile {
    star::surface(&star::symbol(name).unwrap(), Size::Circumradius(1.0)).unwrap()
}

fn counts(file: &OffFile) -> Vec<usize> {
    let mut counts = vec![file.vertex_count(), file.edge_count()];
    counts.extend((2..file.dimension()).map(|rank| file.elements(rank).len()));
    counts
}

fn volume<const N: usize>(file: &OffFile) -> f64 {
    let points = file.vertices::<N>().unwrap();
    MassProperties::of_closed_boundary(&points, &file.boundary().unwrap()).unwrap().mass
}

/// Each flag (a vertex, an edge that holds it, …) spans with the centre a simplex whose legs are at right angles: √(R_k² −
/// R_{k+1}²), where R_k is the distance of the middle of a k-face, and R_N = 0. Together they cover the polytope as often as its
/// surface winds.
fn volume_by_flags<const N: usize>(file: &OffFile, group: f64) -> f64 {
    let points = file.vertices::<N>().unwrap();
    let mut middles: Vec<Vec<u32>> = vec![vec![0], file.elements(2)[0][..2].to_vec()];
    let mut faces = file.elements(2).to_vec();
    middles.push(faces[0].clone());
    for rank in 3..N {
        faces = file
            .elements(rank)
            .iter()
            .map(|parts| parts.iter().flat_map(|&p| faces[p as usize].iter().copied()).collect())
            .collect();
        middles.push(faces[0].clone());
    }
    let mut radii: Vec<f64> = middles[..N]
        .iter()
        .map(|face| {
            let mut face = face.clone();
            face.sort_unstable();
            face.dedup();
            let sum = face.iter().fold(Vector::ZERO, |sum, &v| sum + points[v as usize]);
            (sum / face.len() as f64).norm()
        })
        .collect();
    radii.push(0.0);
    let legs: f64 = radii.windows(2).map(|pair| (pair[0] * pair[0] - pair[1] * pair[1]).sqrt()).product();
    group * legs / (1..=N).map(|k| k as f64).product::<f64>()
}

#[test]
fn convex_symbols_give_the_convex_polytopes() {
    fn check<const N: usize>(symbol: &str) {
        let file = surface(symbol);
        let expected: Polytope<N> = regular::polytope(symbol, Size::Circumradius(1.0)).unwrap();
        assert_eq!(counts(&file), expected.face_lattice().face_counts(), "{symbol}");
        let content = MassProperties::of_polytope(&expected).mass;
        assert!((volume::<N>(&file) / content - 1.0).abs() < 1e-11, "{symbol}");
    }
    check::<3>("{5,3}");
    check::<3>("{3,5}");
    check::<4>("{3,4,3}");
    check::<4>("{3,3,5}");
    check::<4>("{5,3,3}");
    check::<5>("{4,3,3,3}");
    check::<6>("{3,3,3,3,4}");
}

#[test]
fn star_polyhedra_have_the_faces_of_the_table_and_the_volume_of_their_flags() {
    // H. S. M. Coxeter, "Regular Polytopes", table I: vertices, edges, faces.
    let table =
        [("{5/2,5}", [12, 30, 12]), ("{5,5/2}", [12, 30, 12]), ("{5/2,3}", [20, 30, 12]), ("{3,5/2}", [12, 30, 20])];
    for (symbol, expected) in table {
        let file = surface(symbol);
        assert_eq!(counts(&file), expected, "{symbol}");
        let (found, by_flags) = (volume::<3>(&file), volume_by_flags::<3>(&file, 120.0));
        println!("{symbol}: volume {found}, by flags {by_flags}");
        assert!((found / by_flags - 1.0).abs() < 1e-12, "{symbol}: {found} for {by_flags}");
    }
}

#[test]
fn star_polychora_have_the_faces_of_the_table_and_the_volume_of_their_flags() {
    // H. S. M. Coxeter, "Regular Polytopes", table I: vertices, edges, faces, cells.
    let table = [
        ("{5/2,5,3}", [120, 1200, 720, 120]),
        ("{3,5,5/2}", [120, 720, 1200, 120]),
        ("{5,5/2,5}", [120, 720, 720, 120]),
        ("{5,3,5/2}", [120, 720, 720, 120]),
        ("{5/2,3,5}", [120, 720, 720, 120]),
        ("{5/2,5,5/2}", [120, 720, 720, 120]),
        ("{5,5/2,3}", [120, 1200, 720, 120]),
        ("{3,5/2,5}", [120, 720, 1200, 120]),
        ("{3,3,5/2}", [120, 720, 1200, 600]),
        ("{5/2,3,3}", [600, 1200, 720, 120]),
    ];
    for (symbol, expected) in table {
        let file = surface(symbol);
        assert_eq!(counts(&file), expected, "{symbol}");
        let (found, by_flags) = (volume::<4>(&file), volume_by_flags::<4>(&file, 14400.0));
        println!("{symbol}: volume {found}, by flags {by_flags}");
        assert!((found / by_flags - 1.0).abs() < 1e-11, "{symbol}: {found} for {by_flags}");
        assert_eq!(off::parse(&file.to_string()).unwrap(), file, "{symbol} survives its file");
    }
}

/// How often a surface winds around a point: the simplices that a ray in some direction passes through.
fn winding<const N: usize>(points: &[Vector<N>], surface: &[[u32; N]], from: Vector<N>) -> i32 {
    let direction = Vector::from_fn(|i| 1.0 / (i as f64 + 1.7));
    let passes = |simplex: &[u32; N]| {
        let corners = Matrix::from_columns(simplex.map(|v| points[v as usize] - from));
        let weights = corners.solve(direction)?;
        let sense = if corners.determinant() > 0.0 { 1 } else { -1 };
        weights.iter().all(|weight| weight > 0.0).then_some(sense)
    };
    surface.iter().filter_map(passes).sum()
}

/// The cells hold a point if and only if the surface winds around it, and then one of them alone does.
fn cells_fill_what_the_surface_winds_around<const N: usize>(name: &str, count: usize) {
    let symbol = star::symbol(name).unwrap();
    let file = star::surface(&symbol, Size::Circumradius(1.0)).unwrap();
    let (points, boundary) = (file.vertices::<N>().unwrap(), file.boundary::<N>().unwrap());
    let cells = star::cells::<N>(&symbol, Size::Circumradius(1.0), count).unwrap();
    assert_eq!(cells.len(), count, "{name}");
    let mut random = Random(N as u64);
    let (mut inside, mut samples) = (0, 0);
    while samples < 400 {
        let point = random.direction::<N>() * random.unit().powf(0.5);
        let holds = |cell: &&Polytope<N>| cell.facets().iter().all(|f| f.normal.dot(point) < f.offset);
        let found = cells.iter().filter(holds).count();
        let wound = winding(&points, &boundary, point);
        assert_eq!(found, usize::from(wound != 0), "{name}: {found} cells at {point:?}, winding number {wound}");
        inside += found;
        samples += 1;
    }
    let volume: f64 = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
    println!("{name}: {count} cells of {volume} together; {inside} of {samples} points inside");
    assert!(inside > 40 && inside < 390, "{name}: {inside}");
}

#[test]
fn bodies_are_what_the_surface_winds_around() {
    cells_fill_what_the_surface_winds_around::<3>("{5/2,5}", 12);
    cells_fill_what_the_surface_winds_around::<3>("{5,5/2}", 30);
    cells_fill_what_the_surface_winds_around::<3>("{5/2,3}", 20);
    cells_fill_what_the_surface_winds_around::<3>("{3,5/2}", 90);
    cells_fill_what_the_surface_winds_around::<4>("{5/2,5,3}", 120);
    cells_fill_what_the_surface_winds_around::<4>("{3,5,5/2}", 1200);
    cells_fill_what_the_surface_winds_around::<4>("{5,5/2,5}", 720);
    cells_fill_what_the_surface_winds_around::<4>("{5/2,3,5}", 120);
    cells_fill_what_the_surface_winds_around::<4>("{5/2,5,5/2}", 3600);
    cells_fill_what_the_surface_winds_around::<4>("{3,5/2,5}", 1440);
    cells_fill_what_the_surface_winds_around::<4>("{5/2,3,3}", 6000);
}

#[test]
fn stars_of_too_many_cells_are_refused_with_their_number() {
    for (symbol, count) in [("{5,5/2,3}", 8400), ("{5,3,5/2}", 14_400), ("{3,3,5/2}", 50_400)] {
        let error = star::cells::<4>(&star::symbol(symbol).unwrap(), Size::Edge(1.0), 4096).unwrap_err();
        assert_eq!(error.kind(), GeometryErrorKind::BadCount, "{symbol}");
        assert!(error.to_string().contains(&format!("{count} convex cells; at most 4096")), "{symbol}: {error}");
    }
    let short = star::cells::<4>(&[(5, 2), (5, 1)], Size::Edge(1.0), 100).unwrap_err();
    assert!(short.to_string().contains("2 entries"), "{short}");
    // Between its tips a heptagram {7/2} has notches where its sides cross.
    let seventh = std::f64::consts::PI / 7.0;
    let notch = (2.0 * seventh).cos() / seventh.cos();
    let cells = star::cells::<2>(&[(7, 2)], Size::Circumradius(1.0), 14).unwrap();
    let area: f64 = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
    assert!((area - 7.0 * seventh.sin() * notch).abs() < 1e-12, "{area}");
    assert!(star::cells::<2>(&[(7, 2)], Size::Circumradius(1.0), 1).is_err());
}

/// Cores with pyramids on their faces: a dodecahedron and an icosahedron, their lateral edges φ times those of the core, and
/// the first stellation of the 120-cell, whose tips are as far out as its cells' hyperplanes meet.
#[test]
fn stellations_are_cores_with_pyramids() {
    let phi = 0.5 * (1.0 + 5.0_f64.sqrt());
    for (symbol, core) in [("{5/2,5}", "dodecahedron"), ("{5/2,3}", "icosahedron")] {
        let cells = star::cells::<3>(&star::symbol(symbol).unwrap(), Size::Circumradius(1.0), 100).unwrap();
        let content: f64 = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
        let core = regular::polytope::<3>(core, Size::Edge(1.0)).unwrap();
        let inner = core.facets()[0].offset;
        let corner = core.bounding_radius().powi(2) - inner * inner;
        let height = (phi * phi - corner).sqrt();
        // A core of n pyramids of the inradius' height, each with another on top.
        let expected = MassProperties::of_polytope(&core).mass * (1.0 + height / inner) / (inner + height).powi(3);
        println!("{symbol}: {content} m³, the solid {expected}");
        assert!((content / expected - 1.0).abs() < 1e-12, "{symbol}: {content} for {expected}");
    }
    let core = regular::polytope::<4>("120-cell", Size::Circumradius(1.0)).unwrap();
    let first = &core.facets()[0];
    let inner = first.offset;
    // The tip over a cell is where the hyperplanes of its twelve neighbours meet.
    let neighbour = core.facets()[first.neighbours[0] as usize].normal.dot(first.normal);
    let tip = inner / neighbour;
    let expected = MassProperties::of_polytope(&core).mass * tip / inner / tip.powi(4);
    let cells = star::cells::<4>(&star::symbol("{5/2,5,3}").unwrap(), Size::Circumradius(1.0), 120).unwrap();
    let content: f64 = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
    println!("{{5/2,5,3}}: {content} m⁴, the solid {expected}");
    assert!((content / expected - 1.0).abs() < 1e-12, "{content} for {expected}");
}

#[test]
fn names_lead_to_symbols_and_others_are_refused() {
    for (name, symbol) in star::NAMES {
        assert_eq!(star::symbol(name).unwrap(), star::symbol(symbol).unwrap());
    }
    for bad in ["{2,3}", "{5/3}", "blob", "{}", "{5/0,3}", "{1e9}"] {
        assert_eq!(star::symbol(bad).unwrap_err().kind(), GeometryErrorKind::UnknownName, "{bad}");
    }
    for (bad, parts) in [("{6/2}", "2 polygons {3}"), ("{10/4}", "2 polygons {5/2}"), ("{9/3,3}", "3 polygons {3}")] {
        let error = star::symbol(bad).unwrap_err();
        assert!(error.to_string().contains(parts) && error.to_string().contains("compound"), "{error}");
    }
    // Flat, hyperbolic and endless.
    for bad in ["{4,4}", "{7,3}", "{5/2,7}", "{4,3,4}", "{7/2,3}"] {
        let error = star::surface(&star::symbol(bad).unwrap(), Size::Edge(1.0)).unwrap_err();
        assert_eq!(error.kind(), GeometryErrorKind::UnknownName, "{bad}");
    }
    let pentagram = star::surface(&[(5, 2)], Size::Circumradius(1.0)).unwrap();
    assert_eq!((pentagram.vertex_count(), pentagram.elements(2).len()), (5, 1));
    assert!((volume::<2>(&pentagram) - 2.5 * (std::f64::consts::TAU * 0.4).sin()).abs() < 1e-14);
}

//! Star polytopes: the face counts and densities of the tables, volumes against flags, and bodies of the star polyhedra.

use hyperbody_geometry::decompose::convex_cells;
use hyperbody_geometry::regular::{self, Size};
use hyperbody_geometry::{GeometryErrorKind, MassProperties, OffFile, Polytope, off, star};

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
            let sum = face.iter().fold(hyperbody_math::Vector::ZERO, |sum, &v| sum + points[v as usize]);
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

/// As bodies: a dodecahedron or icosahedron and what stands on its faces, each region once.
#[test]
fn star_polyhedra_are_bodies_of_convex_cells() {
    let phi = 0.5 * (1.0 + 5.0_f64.sqrt());
    for (symbol, most) in [("{5/2,5}", 60), ("{5/2,3}", 80)] {
        let file = surface(symbol);
        let points = file.vertices::<3>().unwrap();
        let cells = convex_cells(&points, &file.boundary().unwrap()).unwrap();
        let content: f64 = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
        // The core of the pentagrams' planes is a dodecahedron or, for {5/2,3}, an icosahedron's stellation: the pyramids on it
        // reach to the vertices. Both solids are cores plus pyramids over their faces, with lateral edges φ times the core's.
        let (core, faces): (Polytope<3>, f64) = if symbol == "{5/2,5}" {
            (regular::polytope("dodecahedron", Size::Edge(1.0)).unwrap(), 12.0)
        } else {
            (regular::polytope("icosahedron", Size::Edge(1.0)).unwrap(), 20.0)
        };
        let facet = &core.facets()[0];
        let inner = facet.offset;
        let sides = facet.vertices.len() as f64;
        let corner = core.bounding_radius().powi(2) - inner * inner;
        let height = (phi * phi - corner).sqrt();
        let scale = (inner + height).recip();
        let area = 0.5 * sides * corner * (std::f64::consts::TAU / sides).sin();
        let expected = (MassProperties::of_polytope(&core).mass + faces * area * height / 3.0) * scale.powi(3);
        println!("{symbol}: {} cells, {content} m³, the solid {expected}", cells.len());
        assert!((content / expected - 1.0).abs() < 1e-9, "{symbol}: {content} for {expected}");
        assert!(cells.len() <= most, "{symbol}: {} cells", cells.len());
    }
}

#[test]
fn names_lead_to_symbols_and_others_are_refused() {
    for (name, symbol) in star::NAMES {
        assert_eq!(star::symbol(name).unwrap(), star::symbol(symbol).unwrap());
    }
    for bad in ["{2,3}", "{5/3}", "blob", "{}", "{5/0,3}", "{1e9}"] {
        assert_eq!(star::symbol(bad).unwrap_err().kind(), GeometryErrorKind::UnknownName, "{bad}");
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

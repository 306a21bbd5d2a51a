//! Regular polytopes: numbers of faces (Coxeter, tables I), names, sizes, and what an unknown name is told.

use hyperbody_geometry::regular::{Regular, Size, names, polytope};
use hyperbody_geometry::{GeometryErrorKind, Polytope};

fn counts<const N: usize>(name: &str) -> Vec<usize> {
    let polytope = polytope::<N>(name, Size::Circumradius(1.0)).unwrap_or_else(|error| panic!("{name}: {error}"));
    for vertex in polytope.vertices() {
        assert!((vertex.norm() - 1.0).abs() < 1e-15, "{name}: {vertex:?}");
    }
    let lattice = polytope.face_lattice();
    check_lattice(&polytope);
    lattice.face_counts()
}

/// Euler's relation, the diamond property, and that edges and ridges are the neighbours.
fn check_lattice<const N: usize>(polytope: &Polytope<N>) {
    let lattice = polytope.face_lattice();
    assert_eq!(lattice.dimension(), N);
    let counts = lattice.face_counts();
    let euler: i64 = counts.iter().enumerate().map(|(k, &c)| if k % 2 == 0 { c as i64 } else { -(c as i64) }).sum();
    assert_eq!(euler, if N.is_multiple_of(2) { 0 } else { 2 }, "{counts:?}");
    for rank in 1..N {
        for face in lattice.faces(rank) {
            assert!(face.boundary.len() > rank, "{face:?}");
            let parts: Vec<_> = face.boundary.iter().map(|&p| &lattice.faces(rank - 1)[p as usize]).collect();
            let mut corners: Vec<u32> = parts.iter().flat_map(|p| p.vertices.clone()).collect();
            corners.sort_unstable();
            corners.dedup();
            assert_eq!(corners, face.vertices);
            let mut below: Vec<u32> = parts.iter().flat_map(|p| p.boundary.clone()).collect();
            below.sort_unstable();
            assert!(below.chunk_by(|a, b| a == b).all(|same| same.len() == 2), "{face:?}");
        }
    }
    for edge in lattice.faces(1) {
        let [a, b] = edge.vertices[..] else { panic!("an edge has two vertices: {edge:?}") };
        assert!(polytope.neighbours_of_vertex(a as usize).contains(&b));
    }
    let edges: usize = (0..counts[0]).map(|v| polytope.neighbours_of_vertex(v).len()).sum();
    assert_eq!(edges, 2 * counts[1]);
    for (ridge, facets) in lattice.cofaces(N - 2).iter().enumerate() {
        let [a, b] = facets[..] else { panic!("ridge {ridge} has facets {facets:?}") };
        assert!(polytope.facets()[a as usize].neighbours.contains(&b));
    }
    for (face, facet) in lattice.faces(N - 1).iter().zip(polytope.facets()) {
        assert_eq!(face.vertices, facet.vertices);
    }
}

fn binomial(n: usize, k: usize) -> usize {
    (0..k).fold(1, |c, i| c * (n - i) / (i + 1))
}

fn families<const N: usize>() {
    let simplex: Vec<usize> = (0..N).map(|k| binomial(N + 1, k + 1)).collect();
    let cube: Vec<usize> = (0..N).map(|k| binomial(N, k) << (N - k)).collect();
    let cross: Vec<usize> = cube.iter().rev().copied().collect();
    assert_eq!(counts::<N>("simplex"), simplex);
    assert_eq!(counts::<N>("Hypercube"), cube);
    assert_eq!(counts::<N>("cross polytope"), cross);
    assert_eq!(counts::<N>(&format!("{N}-simplex")), simplex);
    assert_eq!(counts::<N>(&format!("{N}-Cube")), cube);
    assert_eq!(counts::<N>(&format!("{N}-orthoplex")), cross);
    for name in names(N) {
        counts::<N>(name);
    }
    for regular in [Regular::Simplex, Regular::Cube, Regular::CrossPolytope] {
        let symbol = regular.symbol(N).unwrap();
        let same = Regular::from_symbol(N, &symbol).unwrap();
        let vertices = |r: Regular| r.vertices::<N>(Size::Edge(1.0)).unwrap();
        assert_eq!(vertices(same).len(), vertices(regular).len());
    }
}

#[test]
fn families_have_their_faces_in_every_dimension() {
    families::<2>();
    families::<3>();
    families::<4>();
    families::<5>();
    families::<6>();
}

#[test]
fn special_polytopes_have_their_faces() {
    for p in 3..40 {
        assert_eq!(counts::<2>(&format!("{{{p}}}")), [p, p]);
    }
    assert_eq!(counts::<2>("1000-gon"), [1000, 1000]);
    assert_eq!(counts::<3>("dodecahedron"), [20, 30, 12]);
    assert_eq!(counts::<3>("{3, 5}"), [12, 30, 20]);
    assert_eq!(counts::<4>("24-cell"), [24, 96, 96, 24]);
    assert_eq!(counts::<4>("3,4,3"), [24, 96, 96, 24]);
    assert_eq!(counts::<4>("{5,3,3}"), [600, 1200, 720, 120]);
    assert_eq!(counts::<4>("Hexacosichoron"), [120, 720, 1200, 600]);
}

fn edges<const N: usize>(name: &str) {
    let polytope = polytope::<N>(name, Size::Edge(0.75)).unwrap();
    for (v, vertex) in polytope.vertices().iter().enumerate() {
        for &w in polytope.neighbours_of_vertex(v) {
            assert!((vertex.distance(polytope.vertices()[w as usize]) - 0.75).abs() < 1e-14, "{name}");
        }
    }
}

#[test]
fn all_edges_have_the_wanted_length() {
    names(2).into_iter().for_each(edges::<2>);
    names(3).into_iter().for_each(edges::<3>);
    names(4).into_iter().for_each(edges::<4>);
    names(5).into_iter().for_each(edges::<5>);
    names(6).into_iter().for_each(edges::<6>);
}

#[test]
fn orientations_are_as_documented() {
    for name in ["tesseract", "24-cell", "120-cell"] {
        let polytope = polytope::<4>(name, Size::Circumradius(1.0)).unwrap();
        let aligned = polytope.facets().iter().filter(|f| f.normal.max_abs() > 1.0 - 1e-12).count();
        assert_eq!(aligned, 8, "{name}");
    }
    for name in ["16-cell", "600-cell"] {
        let polytope = polytope::<4>(name, Size::Circumradius(1.0)).unwrap();
        assert_eq!(polytope.vertices().iter().filter(|v| v.max_abs() > 1.0 - 1e-15).count(), 8, "{name}");
    }
    fn stands<const N: usize>(name: &str) {
        let polytope = polytope::<N>(name, Size::Circumradius(1.0)).unwrap();
        assert!(polytope.facets().iter().any(|f| f.normal[1] < -1.0 + 1e-12), "{name}");
    }
    names(2).into_iter().for_each(stands::<2>);
    stands::<3>("simplex");
    stands::<4>("simplex");
    stands::<5>("simplex");
    stands::<6>("simplex");
}

#[test]
fn unknown_names_are_told_what_exists() {
    let message = |n: usize, name: &str| {
        let error = Regular::from_name(n, name).unwrap_err();
        assert_eq!(error.kind(), GeometryErrorKind::UnknownName, "{name}");
        error.to_string()
    };
    let text = message(4, "teseract");
    assert!(text.contains("\"tesseract\"") && text.contains("24-cell"), "{text}");
    assert!(message(4, "23-cell").contains("\"24-cell\""));
    assert!(message(4, "dodecahedron").contains("has 3 dimensions"));
    assert!(message(3, "{3,4,3}").contains("{3,4,3}"));
    assert!(message(3, "{5,5}").contains("icosahedron"));
    for (n, symbol, space) in [
        (3, "{4,4}", "the plane"),
        (3, "{3,6}", "the plane"),
        (3, "{5,5}", "the hyperbolic plane"),
        (4, "{4,3,4}", "flat space"),
        (4, "{5,3,4}", "hyperbolic space"),
        (4, "{4,4,3}", "hyperbolic space"),
        (5, "{3,4,3,3}", "flat space"),
    ] {
        assert!(
            message(n, symbol).contains(&format!("is a tiling of {space}, not")),
            "{symbol}: {}",
            message(n, symbol)
        );
    }
    assert!(message(6, "").contains("6-cube"));
    assert!(message(5, "4-cube").contains("5-cube"));
    for p in [0, 1, 2, 20_000] {
        assert_eq!(Regular::from_name(2, &format!("{{{p}}}")).unwrap_err().kind(), GeometryErrorKind::BadCount);
    }
    for size in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        let error = polytope::<4>("24-cell", Size::Circumradius(size)).unwrap_err();
        assert_eq!(error.kind(), GeometryErrorKind::BadNumber);
        let error = polytope::<4>("24-cell", Size::Edge(size)).unwrap_err();
        assert_eq!(error.kind(), GeometryErrorKind::BadNumber);
    }
    assert!(Regular::Cell24.polytope::<3>(Size::Edge(1.0)).is_err());
}

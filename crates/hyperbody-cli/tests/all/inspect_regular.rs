//! `inspect --json` of every regular polytope, by its names and Schläfli symbol: face counts, volume and moments of the closed forms.

use crate::common::{file, hyperbody, json_of};

fn binomial(n: u64, k: u64) -> u64 {
    (0..k).fold(1, |product, i| product * (n - i) / (i + 1))
}

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

/// A polytope of circumradius one: face counts, volume, and the moment J per unit mass of every axis.
struct Expected {
    dimension: usize,
    faces: Vec<u64>,
    volume: f64,
    moment: f64,
}

impl Expected {
    /// Asks the program, and gives the largest relative error of volume and moments.
    fn error_of(&self, name: &str) -> f64 {
        let text = format!("{{\"polytope\": {{\"regular\": \"{name}\", \"circumradius\": 1}}}}");
        let path = file(&format!("regular/{}-{name}.json", self.dimension), text);
        let path = path.to_str().expect("UTF-8");
        let report = json_of(&["inspect", path, "--dimension", &self.dimension.to_string(), "--json"]);
        let numbers = |key: &str| report[key].as_array().expect("a list").clone();
        let counts: Vec<u64> = numbers("faces").iter().filter_map(serde_json::Value::as_u64).collect();
        assert_eq!(counts, self.faces, "{name}");
        assert_eq!((report["convex"].as_bool(), report["closed"].as_bool()), (Some(true), Some(true)));
        let moments: Vec<f64> = numbers("principal_moments").iter().filter_map(serde_json::Value::as_f64).collect();
        assert_eq!(moments.len(), self.dimension);
        let of_moments = moments.iter().map(|moment| (moment / self.moment - 1.0).abs()).fold(0.0, f64::max);
        let volume = report["volume"].as_f64().expect("a number");
        let error = f64::max((volume / self.volume - 1.0).abs(), of_moments);
        assert!(error < LIMIT, "{name}: volume {volume} for {}, moments {moments:?} for {}", self.volume, self.moment);
        error
    }

    /// The same polytope under each of its names.
    fn check(&self, names: &[&str]) {
        let worst = names.iter().map(|name| self.error_of(name)).fold(0.0, f64::max);
        let what = format!("{}D {}", self.dimension, names.join(" = "));
        println!("{what:<88} {:<30} {worst:.1e}", format!("{:?}", self.faces));
    }
}

/// What volumes and moments may be off by, relative.
const LIMIT: f64 = 1e-10;

fn check(dimension: usize, names: &[&str], faces: &[u64], volume: f64, moment: f64) {
    Expected { dimension, faces: faces.to_vec(), volume, moment }.check(names);
}

#[test]
fn simplices_cubes_and_cross_polytopes_in_every_dimension() {
    // Names of their own, and the family's; in the plane cube and cross-polytope are one, turned.
    let own: [[&[&str]; 3]; 5] = [
        [&["triangle", "{3}", "3-gon"], &["square", "{4}", "4-gon"], &["{4}"]],
        [&["tetrahedron", "{3,3}"], &["hexahedron", "{4,3}"], &["octahedron", "{3,4}"]],
        [
            &["5-cell", "pentachoron", "{3,3,3}"],
            &["8-cell", "tesseract", "{4,3,3}"],
            &["16-cell", "hexadecachoron", "{3,3,4}"],
        ],
        [&["5-simplex", "{3,3,3,3}"], &["5-cube", "penteract", "{4,3,3,3}"], &["5-orthoplex", "{3,3,3,4}"]],
        [&["6-simplex", "{3,3,3,3,3}"], &["6-cube", "hexeract", "{4,3,3,3,3}"], &["6-orthoplex", "{3,3,3,3,4}"]],
    ];
    for n in 2..=6_usize {
        let (real, whole) = (n as f64, n as u64);
        let names = |family: usize, general: &'static str| [own[n - 2][family], &[general]].concat();
        // The edge of a simplex of circumradius one: R² = L² n / (2 (n + 1)).
        let edge_sq = 2.0 * (real + 1.0) / real;
        let content = edge_sq.powf(real / 2.0) / factorial(n) * ((real + 1.0) / 2_f64.powi(n as i32)).sqrt();
        let faces: Vec<u64> = (0..whole).map(|k| binomial(whole + 1, k + 1)).collect();
        check(n, &names(0, "simplex"), &faces, content, edge_sq / (2.0 * (real + 1.0) * (real + 2.0)));
        let cube: Vec<u64> = (0..whole).map(|k| binomial(whole, k) << (whole - k)).collect();
        check(n, &names(1, "cube"), &cube, (4.0 / real).powf(real / 2.0), 1.0 / (3.0 * real));
        let cross: Vec<u64> = cube.iter().rev().copied().collect();
        let moment = 2.0 / ((real + 1.0) * (real + 2.0));
        check(n, &names(2, "cross-polytope"), &cross, 2_f64.powi(n as i32) / factorial(n), moment);
    }
}

#[test]
fn polygons_and_the_other_platonic_solids() {
    let mut worst: f64 = 0.0;
    for p in (5_u64..=32).chain([100, 1000]) {
        let (sin, cos) = (std::f64::consts::TAU / p as f64).sin_cos();
        let polygon =
            Expected { dimension: 2, faces: vec![p, p], volume: p as f64 / 2.0 * sin, moment: (2.0 + cos) / 12.0 };
        for name in [format!("{p}-gon"), format!("{{{p}}}")] {
            worst = worst.max(polygon.error_of(&name));
        }
    }
    println!("2D polygons of 5 to 32, 100 and 1000 vertices: {worst:.1e}");
    let root_5 = 5_f64.sqrt();
    let phi = (1.0 + root_5) / 2.0;
    let edge = 4.0 / (3_f64.sqrt() * (1.0 + root_5));
    let moment = (39.0 * phi + 28.0) / 300.0 * edge * edge;
    let volume = (15.0 + 7.0 * root_5) / 4.0 * edge.powi(3);
    check(3, &["dodecahedron", "{5,3}"], &[20, 30, 12], volume, moment);
    let edge = 4.0 / (10.0 + 2.0 * root_5).sqrt();
    let volume = 5.0 * (3.0 + root_5) / 12.0 * edge.powi(3);
    check(3, &["icosahedron", "{3,5}"], &[12, 30, 20], volume, phi * phi / 20.0 * edge * edge);
}

/// Volumes by H. S. M. Coxeter, "Regular Polytopes", table I; moments from the pyramids over the cells.
#[test]
fn the_other_polychora() {
    check(4, &["24-cell", "icositetrachoron", "{3,4,3}"], &[24, 96, 96, 24], 2.0, 13.0 / 120.0);
    let root_5 = 5_f64.sqrt();
    let phi = (1.0 + root_5) / 2.0;
    // Edge a and inradius ρ; J = (ρ² + 3 J₃)/6 with the moment J₃ of a cell.
    let (edge_sq, inradius_sq) = (1.0 / (phi * phi), 1.0 - 3.0 / 8.0 / (phi * phi));
    let volume = 25.0 / 4.0 * (2.0 + root_5) * edge_sq * edge_sq;
    let moment = (inradius_sq + 3.0 / 40.0 * edge_sq) / 6.0;
    check(4, &["600-cell", "hexacosichoron", "{3,3,5}"], &[120, 720, 1200, 600], volume, moment);
    let (edge_sq, inradius_sq) = (0.5 / phi.powi(4), phi.powi(4) / 8.0);
    let volume = 15.0 / 4.0 * (105.0 + 47.0 * root_5) * edge_sq * edge_sq;
    let moment = (inradius_sq + (39.0 * phi + 28.0) / 100.0 * edge_sq) / 6.0;
    check(4, &["120-cell", "hecatonicosachoron", "{5,3,3}"], &[600, 1200, 720, 120], volume, moment);
}

/// A cube with one square listed as two triangles.
#[test]
fn flat_neighbours_are_told_to_be_joined() {
    let cube = "OFF\n8 7 13\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n\
                4 1 2 6 5\n4 2 3 7 6\n3 3 0 4\n3 4 7 3\n";
    let path = file("regular/joined.off", cube);
    let path = path.to_str().expect("UTF-8");
    let report = json_of(&["inspect", path, "--json"]);
    assert_eq!(report["faces"], serde_json::json!([8, 12, 6]));
    assert_eq!(report["faces_in_file"], serde_json::json!([8, 13, 7]));
    let text = String::from_utf8_lossy(&hyperbody(&["inspect", path]).stdout).into_owned();
    assert!(text.contains("8 vertices, 13 edges, 7 faces: flat neighbours are joined"), "{text}");
    let whole = cube.replace("3 3 0 4\n3 4 7 3", "4 3 0 4 7").replace("8 7 13", "8 6 12");
    let path = file("regular/whole.off", whole);
    assert!(json_of(&["inspect", path.to_str().expect("UTF-8"), "--json"]).get("faces_in_file").is_none());
}

/// A file that is not convex: a pyramid with a pyramid cut out of its base.
#[test]
fn files_that_are_not_convex_are_weighed_too() {
    let dented = "OFF\n5 6 9\n1 0 0\n-0.5 0.9 0\n-0.5 -0.9 0\n0 0 1\n0 0 0.3\n\
                  3 0 1 3\n3 1 2 3\n3 2 0 3\n3 0 4 1\n3 1 4 2\n3 2 4 0\n";
    let path = file("regular/dented.off", dented);
    let report = json_of(&["inspect", path.to_str().expect("UTF-8"), "--json"]);
    assert_eq!((report["convex"].as_bool(), report["closed"].as_bool()), (Some(false), Some(true)));
    assert_eq!(report["faces"], serde_json::json!([5, 9, 6]));
    assert!((report["volume"].as_f64().expect("a number") - 0.7 * 1.35 / 3.0).abs() < 1e-14);
}

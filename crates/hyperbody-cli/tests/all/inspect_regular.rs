//! `inspect --json` of every regular polytope: face counts, volume and moments of the closed forms.

use crate::common::{file, json_of};

fn binomial(n: u64, k: u64) -> u64 {
    (0..k).fold(1, |product, i| product * (n - i) / (i + 1))
}

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

/// A polytope of circumradius one: face counts, volume, and the moment J per unit mass of every axis.
fn check(dimension: usize, name: &str, faces: &[u64], volume: f64, moment: f64) {
    let text = format!("{{\"polytope\": {{\"regular\": \"{name}\", \"circumradius\": 1}}}}");
    let path = file(&format!("regular/{dimension}-{name}.json"), text);
    let path = path.to_str().expect("UTF-8");
    let report = json_of(&["inspect", path, "--dimension", &dimension.to_string(), "--json"]);
    let counts: Vec<u64> =
        report["faces"].as_array().expect("a list").iter().filter_map(serde_json::Value::as_u64).collect();
    assert_eq!(counts, faces, "{name}");
    let found = report["volume"].as_f64().expect("a number");
    assert!((found / volume - 1.0).abs() < 1e-10, "{name}: volume {found} for {volume}");
    let moments = report["principal_moments"].as_array().expect("a list");
    assert_eq!(moments.len(), dimension);
    for found in moments.iter().filter_map(serde_json::Value::as_f64) {
        assert!((found / moment - 1.0).abs() < 1e-10, "{name}: moment {found} for {moment}");
    }
    assert_eq!((report["convex"].as_bool(), report["closed"].as_bool()), (Some(true), Some(true)));
}

#[test]
fn simplices_cubes_and_cross_polytopes_in_every_dimension() {
    for n in 2..=6_usize {
        let (real, whole) = (n as f64, n as u64);
        // The edge of a simplex of circumradius one: R² = L² n / (2 (n + 1)).
        let edge_sq = 2.0 * (real + 1.0) / real;
        let content = edge_sq.powf(real / 2.0) / factorial(n) * ((real + 1.0) / 2_f64.powi(n as i32)).sqrt();
        let faces: Vec<u64> = (0..whole).map(|k| binomial(whole + 1, k + 1)).collect();
        check(n, "simplex", &faces, content, edge_sq / (2.0 * (real + 1.0) * (real + 2.0)));
        let cube: Vec<u64> = (0..whole).map(|k| binomial(whole, k) << (whole - k)).collect();
        check(n, "cube", &cube, (4.0 / real).powf(real / 2.0), 1.0 / (3.0 * real));
        let cross: Vec<u64> = cube.iter().rev().copied().collect();
        check(n, "cross-polytope", &cross, 2_f64.powi(n as i32) / factorial(n), 2.0 / ((real + 1.0) * (real + 2.0)));
    }
}

#[test]
fn polygons_and_the_other_platonic_solids() {
    for p in [5_u64, 6, 7, 12] {
        let (sin, cos) = (std::f64::consts::TAU / p as f64).sin_cos();
        check(2, &format!("{p}-gon"), &[p, p], p as f64 / 2.0 * sin, (2.0 + cos) / 12.0);
    }
    let root_5 = 5_f64.sqrt();
    let phi = (1.0 + root_5) / 2.0;
    let edge = 4.0 / (3_f64.sqrt() * (1.0 + root_5));
    let moment = (39.0 * phi + 28.0) / 300.0 * edge * edge;
    check(3, "dodecahedron", &[20, 30, 12], (15.0 + 7.0 * root_5) / 4.0 * edge.powi(3), moment);
    let edge = 4.0 / (10.0 + 2.0 * root_5).sqrt();
    check(3, "icosahedron", &[12, 30, 20], 5.0 * (3.0 + root_5) / 12.0 * edge.powi(3), phi * phi / 20.0 * edge * edge);
}

/// Volumes by H. S. M. Coxeter, "Regular Polytopes", table I; moments from the pyramids over the cells.
#[test]
fn the_other_polychora() {
    check(4, "24-cell", &[24, 96, 96, 24], 2.0, 13.0 / 120.0);
    let root_5 = 5_f64.sqrt();
    let phi = (1.0 + root_5) / 2.0;
    // Edge a and inradius ρ; J = (ρ² + 3 J₃)/6 with the moment J₃ of a cell.
    let (edge_sq, inradius_sq) = (1.0 / (phi * phi), 1.0 - 3.0 / 8.0 / (phi * phi));
    let volume = 25.0 / 4.0 * (2.0 + root_5) * edge_sq * edge_sq;
    check(4, "600-cell", &[120, 720, 1200, 600], volume, (inradius_sq + 3.0 / 40.0 * edge_sq) / 6.0);
    let (edge_sq, inradius_sq) = (0.5 / phi.powi(4), phi.powi(4) / 8.0);
    let volume = 15.0 / 4.0 * (105.0 + 47.0 * root_5) * edge_sq * edge_sq;
    let moment = (inradius_sq + (39.0 * phi + 28.0) / 100.0 * edge_sq) / 6.0;
    check(4, "120-cell", &[600, 1200, 720, 120], volume, moment);
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

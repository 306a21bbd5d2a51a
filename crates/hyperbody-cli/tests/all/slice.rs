//! `hyperbody slice`: the files that it writes, and what it refuses.

use crate::common::{file, hyperbody, json_of};

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
fn a_tesseract_across_its_diagonal_is_an_octahedron() {
    let shape = file("slice/tesseract.json", r#"{"box": {"half_extents": [0.5, 0.5, 0.5, 0.5]}}"#);
    let shape = shape.to_str().expect("UTF-8");
    for (extension, start) in [("off", &b"OFF\n"[..]), ("obj", b"# "), ("stl", b"binary STL"), ("glb", b"glTF")] {
        let out = file(&format!("slice/diagonal.{extension}"), "old");
        let out = out.to_str().expect("UTF-8");
        let report = json_of(&["slice", shape, "-o", out, "--normal", "1,1,1,1", "--json"]);
        assert_eq!((report["vertices"].as_u64(), report["faces"].as_u64()), (Some(6), Some(8)), "{report}");
        // The octahedron with edge √2 has the volume √2/3 · √8 = 4/3.
        assert!((number(&report["volume"]) - 4.0 / 3.0).abs() < 1e-12, "{report}");
        assert!(std::fs::read(out).expect("the file is there").starts_with(start));
    }
    let off = file("slice/diagonal.off", "");
    let off = off.to_str().expect("UTF-8");
    json_of(&["slice", shape, "-o", off, "--normal", "-1,-1,-1,-1", "--offset", "-0.5", "--json"]);
    let inspected = json_of(&["inspect", off, "--json"]);
    assert_eq!(inspected["faces"], serde_json::json!([12, 18, 8]), "a truncated tetrahedron");
}

#[test]
fn regular_polytopes_need_no_file() {
    let out = file("slice/by-name.stl", "");
    let out = out.to_str().expect("UTF-8");
    for name in ["tesseract", "{4,3,3}"] {
        // Circumradius 1: edge 1, and across w a cube.
        let report = json_of(&["slice", name, "-o", out, "--json"]);
        assert!((number(&report["volume"]) - 1.0).abs() < 1e-12, "{report}");
    }
    let report = json_of(&["inspect", "great icosahedron", "--json"]);
    assert_eq!(report["faces"], serde_json::json!([12, 30, 20]));
    let report = json_of(&["inspect", "simplex", "--dimension", "6", "--json"]);
    assert_eq!(report["faces"], serde_json::json!([7, 21, 35, 35, 21, 7]));
    for (shape, hint) in [
        (r#"{"polytope": {"regular": "teseract", "edge": 1}}"#, "tesseract"),
        (r#"{"star": {"regular": "great icosaedron", "edge": 1}}"#, "great icosahedron"),
    ] {
        let shape = file("slice/misspelt.json", shape);
        let output = hyperbody(&["inspect", shape.to_str().expect("UTF-8")]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(&format!("the nearest is \"{hint}\"")), "{error}");
    }
}

/// A mesh has the dimension of its file, wherever in the shape it stands.
#[test]
fn shapes_of_files_tell_their_dimension() {
    let simplex = "4OFF\n5 0 0 0\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    file("slice/told/simplex.off", simplex);
    let parts = r#"{"compound": {"parts": [{"shape": {"ball": {"radius": 1}}}, {"shape": {"mesh": {"file": "simplex.off"}}}]}}"#;
    for (number, text) in [
        r#"{"mesh": {"file": "simplex.off"}}"#,
        r#"{"rounded": {"shape": {"polytope": {"file": "simplex.off"}}, "radius": 0.1}}"#,
        parts,
    ]
    .iter()
    .enumerate()
    {
        let shape = file(&format!("slice/told/{number}.json"), text);
        let report = json_of(&["inspect", shape.to_str().expect("UTF-8"), "--json"]);
        assert_eq!(report["dimension"], 4, "{report}");
    }
    let shape = file("slice/told/wrong.json", r#"{"mesh": {"file": "nowhere.off"}}"#);
    let output = hyperbody(&["inspect", shape.to_str().expect("UTF-8")]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && error.contains("mesh.file") && error.contains("nowhere.off"), "{error}");
}

#[test]
fn curved_shapes_and_higher_dimensions_are_cut_too() {
    let shape = file("slice/ball.json", r#"{"ball": {"radius": 2}}"#);
    let shape = shape.to_str().expect("UTF-8");
    let out = file("slice/ball.stl", "");
    let out = out.to_str().expect("UTF-8");
    // From five dimensions at two offsets: a ball of radius √(4 − 1 − 1).
    let arguments = ["slice", shape, "-o", out, "--dimension", "5", "--offset", "1", "--offset", "1", "--json"];
    let coarse = json_of(&arguments);
    let fine = json_of(&[&arguments[..], &["--tolerance", "2e-4"]].concat());
    let ball = 4.0 / 3.0 * std::f64::consts::PI * 2_f64.powf(1.5);
    assert!(fine["faces"].as_u64() > coarse["faces"].as_u64(), "{coarse} {fine}");
    for report in [coarse, fine] {
        assert!(
            (number(&report["volume"]) / ball - 1.0).abs() < 1e-12,
            "the volume is the section's, not the file's: {report}"
        );
    }
}

#[test]
fn the_volume_of_a_curved_section_does_not_depend_on_the_triangles() {
    let factors =
        r#"[{"shape": {"ball": {"radius": 1}}, "axes": "xy"}, {"shape": {"ball": {"radius": 0.5}}, "axes": "zw"}]"#;
    let shape = file("slice/duocylinder.json", format!(r#"{{"product": {{"factors": {factors}}}}}"#));
    let out = file("slice/cylinder.stl", "");
    let [shape, out] = [&shape, &out].map(|path| path.to_str().expect("UTF-8"));
    let report = json_of(&["slice", shape, "-o", out, "--offset", "0.3", "--tolerance", "0.05", "--json"]);
    assert!((number(&report["volume"]) - std::f64::consts::PI * 0.8).abs() < 1e-6, "{report}");
}

#[test]
fn projections_are_wires_and_outlines() {
    let shape = file("slice/wires.json", r#"{"box": {"half_extents": [0.5, 0.5, 0.5, 0.5]}}"#);
    let shape = shape.to_str().expect("UTF-8");
    let obj = file("slice/wires.obj", "");
    let obj = obj.to_str().expect("UTF-8");
    let report = json_of(&["slice", shape, "-o", obj, "--project", "--normal", "1,1,1,1", "--json"]);
    // A rhombic dodecahedron: Cauchy's volume of the shadow of a unit cube, Σ|n_i|.
    assert_eq!((report["vertices"].as_u64(), report["faces"].as_u64()), (Some(14), Some(12)), "{report}");
    assert!((number(&report["volume"]) - 2.0).abs() < 1e-12, "{report}");
    let text = std::fs::read_to_string(obj).expect("the file is there");
    let count = |start: &str| text.lines().filter(|line| line.starts_with(start)).count();
    assert_eq!((count("v "), count("l "), count("f ")), (16, 32, 24));
    let stl = file("slice/outline.stl", "");
    let stl = stl.to_str().expect("UTF-8");
    let report = json_of(&["slice", shape, "-o", stl, "--project", "--eye", "1", "--json"]);
    assert!((number(&report["volume"]) - 8.0).abs() < 1e-12, "the near cube is twice as wide: {report}");
    let output = hyperbody(&["slice", shape, "-o", stl, "--project", "--eye", "0.4"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("farther"));
    let ball = file("slice/curved.json", r#"{"capsule": {"half_length": 1, "radius": 0.5, "along": "w"}}"#);
    let ball = ball.to_str().expect("UTF-8");
    let report = json_of(&["slice", ball, "-o", stl, "--project", "--dimension", "4", "--json"]);
    assert!(
        (number(&report["volume"]) - std::f64::consts::PI / 6.0).abs() < 5e-3,
        "seen along its axis, a ball: {report}"
    );
}

#[test]
fn star_polytopes_are_weighed_and_cut() {
    let star = |name: &str| {
        let text = format!(r#"{{"star": {{"regular": "{name}", "circumradius": 1}}}}"#);
        file(&format!("slice/{name}.json"), text).to_str().expect("UTF-8").to_owned()
    };
    let great = star("great grand stellated 120-cell");
    let report = json_of(&["inspect", &great, "--json"]);
    assert_eq!(report["faces"], serde_json::json!([600, 1200, 720, 120]));
    assert_eq!(report["convex"], serde_json::json!(false));
    // Through two opposite cells of its core, a small stellated 120-cell shows a small stellated dodecahedron and more around it;
    // its volume is that of the union, which is less than what the surface winds around.
    let small = star("small stellated 120-cell");
    let stl = file("slice/star.stl", "");
    let stl = stl.to_str().expect("UTF-8");
    let report = json_of(&["slice", &small, "-o", stl, "--json"]);
    // Cells meet wall on wall in this hyperplane: each wall counts once.
    let beside = json_of(&["slice", &small, "-o", stl, "--json", "--offset", "1e-6"]);
    let middle = number(&report["volume"]);
    assert!((middle - 2.96556).abs() < 1e-4 && (middle / number(&beside["volume"]) - 1.0).abs() < 1e-4, "{report}");
    assert!(number(&report["faces"]) > 100.0, "{report}");
    let output = hyperbody(&["slice", &small, "-o", stl, "--offset", "1.5"]);
    assert_eq!(output.status.code(), Some(2));
}

/// Outlines of pieces lie in each other, and their volumes add up to that of nothing.
#[test]
fn outlines_of_several_pieces_have_no_volume() {
    let out = file("slice/outlines.stl", "");
    let out = out.to_str().expect("UTF-8");
    let report = json_of(&["slice", "{5/2,5,3}", "-o", out, "--project", "--json"]);
    assert_eq!(
        (&report["volume"], &report["enclosed"]),
        (&serde_json::Value::Null, &serde_json::Value::Null),
        "{report}"
    );
    assert_eq!((report["overlapping"].as_bool(), report["pieces"].as_u64()), (Some(true), Some(120)), "{report}");
    let text = String::from_utf8_lossy(&hyperbody(&["slice", "{5/2,5,3}", "-o", out, "--project"]).stdout).into_owned();
    assert!(!text.contains("volume  ") && text.contains("there is no volume to tell"), "{text}");
    let cube =
        |x: f64| format!(r#"{{"shape": {{"box": {{"half_extents": [1, 1, 1, 1]}}}}, "position": [{x}, 0, 0, 0]}}"#);
    let apart = file("slice/apart.json", format!(r#"{{"compound": {{"parts": [{}, {}]}}}}"#, cube(0.0), cube(3.0)));
    let report = json_of(&["slice", apart.to_str().expect("UTF-8"), "-o", out, "--project", "--json"]);
    assert!((number(&report["volume"]) - 16.0).abs() < 1e-9 && report["overlapping"] == false, "{report}");
}

/// Shapes of three dimensions need no cut.
#[test]
fn shapes_of_3d_are_written_as_they_are() {
    let out = file("slice/solid.off", "");
    let out = out.to_str().expect("UTF-8");
    json_of(&["slice", "dodecahedron", "-o", out, "--json"]);
    let inspected = json_of(&["inspect", out, "--json"]);
    assert_eq!(inspected["faces"], serde_json::json!([20, 30, 12]));
    let ball = file("slice/ball3.json", r#"{"ball": {"radius": 1}}"#);
    let report = json_of(&["slice", ball.to_str().expect("UTF-8"), "-o", out, "--dimension", "3", "--json"]);
    assert!((number(&report["volume"]) - 4.0 / 3.0 * std::f64::consts::PI).abs() < 1e-12, "{report}");
    let report = json_of(&["slice", "great dodecahedron", "-o", out, "--json"]);
    let weighed = json_of(&["inspect", "great dodecahedron", "--json"]);
    assert!((number(&report["volume"]) / number(&weighed["body"]["volume"]) - 1.0).abs() < 1e-9, "{report}");
}

/// A star is weighed by its winding numbers, and as a body once; a convex shape is the same either way.
#[test]
fn bodies_of_stars_are_weighed_beside_them() {
    let report = json_of(&["inspect", "pentagram", "--json"]);
    let sin = |fifths: f64| (fifths * std::f64::consts::PI / 5.0).sin();
    // The triangles from the centre to the five edges, and the ten to the sides of the outline, whose inner corners are at 1/φ².
    let inner = (3.0 - 5_f64.sqrt()) / 2.0;
    assert!((number(&report["volume"]) - 2.5 * sin(4.0)).abs() < 1e-12, "{report}");
    assert!((number(&report["body"]["volume"]) - 5.0 * inner * sin(1.0)).abs() < 1e-12, "{report}");
    assert_eq!(report["body"]["second_moments"].as_array().map(Vec::len), Some(2));
    let text = String::from_utf8_lossy(&hyperbody(&["inspect", "pentagram"]).stdout).into_owned();
    assert!(text.contains("as a body: volume") && text.contains("as often as the surface winds"), "{text}");
    assert!(json_of(&["inspect", "24-cell", "--json"]).get("body").is_none());
}

/// What is wrong with a shape is told in its own words, and an OFF file has no keys.
#[test]
fn shapes_are_refused_in_their_own_words() {
    let factor = |shape: &str, axes: &str| format!(r#"{{"shape": {shape}, "axes": "{axes}"}}"#);
    let product = |factors: &[String]| format!(r#"{{"product": {{"factors": [{}]}}}}"#, factors.join(", "));
    let (ball, segment) = (r#"{"ball": {"radius": 0.5}}"#, r#"{"box": {"half_extents": [0.5]}}"#);
    let cylinder = |axes: [&str; 2]| product(&[factor(ball, axes[0]), factor(segment, axes[1])]);
    let pyramid = |base: &str| format!(r#"{{"pyramid": {{"base": {}, "height": 1}}}}"#, factor(base, "xzw"));
    let cone = r#"{"pyramid": {"base": {"shape": {"ball": {"radius": 0.5}}, "axes": "xy"}, "height": 1}}"#;
    let cases = [
        (pyramid(&cylinder(["xz", "w"])), "inside this base its axes x, z, w are called x, y, z"),
        (pyramid(&cylinder(["xy", "z"])), "the base of a pyramid is a product with curved factors"),
        (pyramid(cone), "the base of a pyramid is a cone"),
        (cylinder(["xy", "w"]), "z not at all"),
        (r#"{"sphere": {"radius": 1}}"#.to_owned(), "it is \"ball\" here"),
        (r#"{"polytope": {"regular": "{5/2,5}", "circumradius": 1}}"#.to_owned(), "use \"star\""),
        (r#"{"polytope": {"regular": "{4,4}", "circumradius": 1}}"#.to_owned(), "a tiling of the plane"),
    ];
    for (text, reason) in cases {
        let path = file("slice/refused-shape.json", &text);
        let output = hyperbody(&["inspect", path.to_str().expect("UTF-8")]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && error.contains(reason), "{text}: {error}");
    }
    let open = file("slice/open.off", "OFF\n4 3\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n");
    let error = String::from_utf8_lossy(&hyperbody(&["inspect", open.to_str().expect("UTF-8")]).stderr).into_owned();
    assert!(error.contains("open.off: ") && error.contains("open") && !error.contains("polytope.file"), "{error}");
    // A product of a product is that of all their factors.
    let nested = product(&[factor(&cylinder(["xz", "y"]), "xwy"), factor(segment, "z")]);
    let flat = product(&[factor(ball, "xy"), factor(segment, "w"), factor(segment, "z")]);
    let [nested, flat] = [("nested", nested), ("flat", flat)].map(|(name, text)| {
        let path = file(&format!("slice/{name}-product.json"), text);
        json_of(&["inspect", path.to_str().expect("UTF-8"), "--json"])
    });
    assert_eq!(nested, flat);
}

/// A prism over an L, and a ball far from the origin: what `inspect` weighs, `slice` cuts, wherever it stands.
#[test]
fn files_that_are_not_convex_and_far_ones_are_cut() {
    let mut text = String::from("4OFF\n24 24 0 10\n");
    let hexagon = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]];
    for [x, y] in hexagon {
        [[0, 0], [1, 0], [1, 1], [0, 1]].iter().for_each(|[z, w]| text += &format!("{x} {y} {z} {w}\n"));
    }
    // Faces: 4 hexagons, 24 side by side, 6 squares; cells: 4 prisms over the hexagon, 6 boxes over its sides.
    text = text.replace("24 24 0 10", "24 34 0 10");
    let at = |u: usize, k: usize| 4 * (u % 6) + k % 4;
    let mut line = |parts: Vec<usize>| {
        text += &parts.len().to_string();
        parts.iter().for_each(|part| text += &format!(" {part}"));
        text.push('\n');
    };
    (0..4).for_each(|k| line((0..6).map(|u| at(u, k)).collect()));
    for u in 0..6 {
        (0..4).for_each(|k| line(vec![at(u, k), at(u + 1, k), at(u + 1, k + 1), at(u, k + 1)]));
    }
    (0..6).for_each(|u| line((0..4).map(|k| at(u, k)).collect()));
    let side = |u: usize, k: usize| 4 + 4 * (u % 6) + k % 4;
    (0..4).for_each(|k| line([k, (k + 1) % 4].into_iter().chain((0..6).map(|u| side(u, k))).collect()));
    (0..6).for_each(|u| line([28 + u, 28 + (u + 1) % 6].into_iter().chain((0..4).map(|k| side(u, k))).collect()));
    let shape = file("slice/l.off", text);
    let shape = shape.to_str().expect("UTF-8");
    let out = file("slice/l.obj", "");
    let out = out.to_str().expect("UTF-8");
    assert!((number(&json_of(&["inspect", shape, "--json"])["volume"]) - 3.0).abs() < 1e-12);
    let report = json_of(&["slice", shape, "-o", out, "--offset", "0.5", "--json"]);
    assert!((number(&report["volume"]) - 3.0).abs() < 1e-12 && report["pieces"] == 2, "{report}");
    let far = r#"{"compound": {"parts": [{"shape": {"ball": {"radius": 1}}, "position": [1000, 0, 0, 0]}]}}"#;
    let far = file("slice/far.json", far);
    let report = json_of(&["slice", far.to_str().expect("UTF-8"), "-o", out, "--json"]);
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    assert!((number(&report["volume"]) / ball - 1.0).abs() < 1e-9, "{report}");
    assert!((number(&report["enclosed"]) / ball - 1.0).abs() < 0.01, "{report}");
    let report = json_of(&["slice", far.to_str().expect("UTF-8"), "-o", out, "--project", "--json"]);
    assert!((number(&report["volume"]) / ball - 1.0).abs() < 0.01, "{report}");
}

/// What `slice` writes, `inspect` reads: a closed surface around the volume that the section has.
#[test]
fn sections_of_several_pieces_are_closed_surfaces() {
    let pentagram = |axes: &str| {
        format!(r#"{{"shape": {{"star": {{"regular": "{{5/2}}", "circumradius": 1}}}}, "axes": "{axes}"}}"#)
    };
    let duoprism = format!(r#"{{"product": {{"factors": [{}, {}]}}}}"#, pentagram("xy"), pentagram("zw"));
    let duoprism = file("slice/star-duoprism.json", duoprism);
    let duoprism = duoprism.to_str().expect("UTF-8");
    // The outline of a pentagram is ten triangles with sides 1 and 1/φ².
    let area = 2.5 * (3.0 - 5_f64.sqrt()) * (std::f64::consts::PI / 5.0).sin();
    let weighed = number(&json_of(&["inspect", duoprism, "--json"])["volume"]);
    assert!((weighed / (area * area) - 1.0).abs() < 1e-12, "{weighed}");
    let out = file("slice/closed.off", "");
    let out = out.to_str().expect("UTF-8");
    let oblique = &["--normal", "1,2,3,-1", "--offset", "0.3"][..];
    for (shape, more) in
        [("{5/2,5,3}", &[][..]), ("{5/2,5,3}", oblique), (duoprism, &["--offset", "0.1"]), (duoprism, oblique)]
    {
        let report = json_of(&[&["slice", shape, "-o", out, "--json"], more].concat());
        let inspected = number(&json_of(&["inspect", out, "--json"])["volume"]);
        assert!((inspected / number(&report["volume"]) - 1.0).abs() < 1e-9, "{shape} {more:?}: {inspected}, {report}");
    }
}

#[test]
fn what_cannot_be_cut_is_refused_with_the_reason() {
    let shape = file("slice/cube4.json", r#"{"box": {"half_extents": [1, 1, 1, 1]}}"#);
    let shape5 = file("slice/cube5.json", r#"{"box": {"half_extents": [1, 1, 1, 1, 1]}}"#);
    let flat = file("slice/cube3.json", r#"{"box": {"half_extents": [1, 1, 1]}}"#);
    let floor = file("slice/floor.json", r#"{"half_space": {"normal": [0, 1, 0, 0], "offset": 0}}"#);
    let mesh = file("slice/mesh.stl", "solid mesh");
    let path = |path: &std::path::PathBuf| path.to_str().expect("UTF-8").to_owned();
    let out = path(&file("slice/refused.stl", "old"));
    let cases: &[(&str, &[&str], &str)] = &[
        (&path(&shape), &["--offset", "1.5"], "lies between -1 and 1"),
        (&path(&shape), &["--normal", "1,1,1,1", "--offset", "4.5"], "offset 4.5 leaves nothing"),
        (&path(&shape), &["--normal", "1,1,1,1", "--offset", "4.5"], "lies between -4 and 4"),
        // |x + y + z + w| ≤ 4 where v = 0.5, times two and one more.
        (
            &path(&shape5),
            &["--normal", "0,0,0,0,2", "--offset", "1", "--normal", "2,2,2,2,2", "--offset", "-7.5"],
            "offset -7.5 leaves nothing of what there is to cut, where normal·p lies between -7 and 9",
        ),
        (&path(&shape), &["--normal", "1,2,3"], "has 3 numbers"),
        (&path(&shape), &["--normal", "1,2,x,3"], "\"x\" is not a number"),
        (&path(&shape), &["--normal", "0,0,0,0"], "not zero"),
        (&path(&shape), &["--offset", "1", "--offset", "2"], "given 2 times"),
        (&path(&shape), &["--offset", "nan"], "offset of a slice is NaN"),
        (&path(&flat), &["--normal", "1,1,1"], "--normal is for shapes of 4 to 6 dimensions"),
        (&path(&flat), &["--project"], "neither cut to 2 nor projected"),
        (&path(&floor), &[], "half-space has no end"),
        ("nowhere.off", &[], "nowhere.off"),
        ("triangle", &[], "sections in 3D are those of 4 to 6, and shapes of 3 are written as they are"),
        ("{4,4}", &[], "a tiling of the plane, not a polytope"),
        ("{7,3}", &[], "a tiling of the hyperbolic plane"),
        ("{5/1}", &[], "write 5"),
        ("duocylinder", &[], "it is \"product\" of two balls"),
        ("simplex", &[], "does not tell its dimension"),
        ("600-cel", &[], "no regular polytope of that name; the nearest is \"600-cell\""),
        ("{6/2}", &[], "{6/2} is 2 polygons {3} turned against each other"),
        ("{5/3}", &[], "fractions above 2 in lowest terms"),
        (&path(&mesh), &[], "read from .off files"),
    ];
    for (shape, more, reason) in cases {
        let output = hyperbody(&[&["slice", shape, "-o", &out], *more].concat());
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(reason) && output.stdout.is_empty(), "{more:?}: {error}");
        assert_eq!(std::fs::read(&out).expect("the old file"), b"old", "a refusal leaves the old file");
    }
    let output = hyperbody(&["slice", &path(&shape), "-o", "section.png"]);
    assert_eq!(output.status.code(), Some(2));
}

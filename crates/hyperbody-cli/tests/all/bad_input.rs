//! Bad input: exit status 2, nothing on standard output, one line that says where, what, and what would be right.

use crate::common::{file, hyperbody};

/// A good scene; every case spoils one place of it.
const GOOD: &str = r#"{
  "format": "hyperbody-scene", "version": 1, "name": "base", "dimension": 4,
  "gravity": [0, -9.81, 0, 0], "dt": 0.01, "substeps": 4,
  "materials": {"default": {"friction": 0.5, "restitution": 0.0, "density": 1.0}, "ice": {"friction": 0.1}},
  "bodies": [
    {"name": "floor", "kind": "static", "shape": {"half_space": {"normal": [0, 1, 0, 0], "offset": 0}}},
    {"name": "block", "shape": {"box": {"half_extents": [0.5, 0.5, 0.5, 0.5]}}, "position": [0, 0.5, 0, 0],
     "rotation": [{"plane": "xw", "angle_deg": 30}], "angular_velocity": {"xy": 0.1}, "mass": 2, "material": "ice"},
    {"name": "ball", "shape": {"ball": {"radius": 0.5}}, "position": [2, 1, 0, 0], "velocity": [0, 0, 0, 1]},
    {"name": "die", "shape": {"polytope": {"regular": "24-cell", "circumradius": 0.7}}, "position": [0, 3, 0, 0]},
    {"name": "log", "shape": {"capsule": {"half_length": 1, "radius": 0.2, "along": "x"}}, "position": [0, 5, 0, 0]}
  ],
  "joints": [{"ball": {"a": "block", "b": "ball", "anchor_a": [1, 0, 0, 0], "anchor_b": [-1, 0, 0, 0]}}]
}"#;

/// What is replaced, by what, and what the message has to hold.
type Case = (&'static str, &'static str, &'static [&'static str]);

const STRUCTURE: &[Case] = &[
    ("\"dt\"", "\"dtt\"", &["unknown key \"dtt\"", "nearest known one is \"dt\""]),
    ("\"position\": [2", "\"positon\": [2", &["bodies[2]", "\"positon\"", "\"position\""]),
    ("\"friction\": 0.5", "\"fricton\": 0.5", &["materials.default", "\"fricton\"", "\"friction\""]),
    ("\"box\"", "\"bocks\"", &["bodies[1].shape", "\"bocks\"", "\"box\""]),
    ("\"radius\": 0.5", "\"radios\": 0.5", &["bodies[2].shape.ball", "\"radios\"", "\"radius\""]),
    ("{\"radius\": 0.5}", "{}", &["bodies[2].shape.ball", "no \"radius\""]),
    (
        "{\"ball\": {\"radius\": 0.5}}",
        "{\"ball\": {\"radius\": 0.5}, \"box\": {}}",
        &["bodies[2].shape", "2 keys", "one of"],
    ),
    ("{\"ball\": {\"radius\": 0.5}}", "{\"product\": {\"factors\": []}}", &["bodies[2].shape.product", "0 factors"]),
    (
        "{\"ball\": {\"radius\": 0.5}}",
        "{\"product\": {\"factors\": [{\"shape\": {\"ball\": {\"radius\": 0.5}}, \"axes\": \"xq\"}]}}",
        &["bodies[2].shape.product.factors[0].axes", "unknown axis \"q\""],
    ),
    ("{\"ball\": {\"radius\": 0.5}}", "{\"mesh\": {\"file\": \"a.off\"}}", &["bodies[2].shape.mesh.file", "a.off"]),
    (
        "{\"ball\": {\"radius\": 0.5}}",
        r#"{"product": {"factors": [{"shape": {"ball": {"radius": 0.5}}, "axes": "xy"}, {"shape": {"ball": {"radius": 0.5}}, "axes": "yz"}]}}"#,
        &[
            "bodies[2].shape.product.factors",
            "y more than once and w not at all",
            "\"xy\", \"yz\"",
            "each of x, y, z, w",
        ],
    ),
    (
        "{\"ball\": {\"radius\": 0.5}}",
        r#"{"pyramid": {"base": {"shape": {"ball": {"radius": 0.5}}, "axes": "xx"}, "height": 1}}"#,
        &["bodies[2].shape.pyramid.base.axes", "\"xx\"", "3 axes, each once", "\"xzw\""],
    ),
    ("\"ball\": {\"a\"", "\"hinge\": {\"a\"", &["joints[0].hinge", "has no \"plane\""]),
    ("\"ball\": {\"a\"", "\"bal\": {\"a\"", &["joints[0]", "\"bal\"", "nearest known one is \"ball\""]),
    ("\"dimension\": 4,", "", &["no \"dimension\""]),
    ("\"format\": \"hyperbody-scene\", ", "", &["no \"format\"", "hyperbody-scene"]),
    ("hyperbody-scene", "hyperbodi-scene", &["format: is \"hyperbodi-scene\"", "expected \"hyperbody-scene\""]),
    ("\"version\": 1", "\"version\": 2", &["version: is 2", "version 1"]),
    ("\"version\": 1, ", "", &["no \"version\"", "version 1"]),
    ("\"name\": \"base\"", "\"name\": 7", &["name: is a number, expected a string"]),
    ("\"dt\": 0.01", "\"dt\": \"fast\"", &["dt: is a string, expected a number"]),
    ("[0, 0.5, 0, 0]", "\"here\"", &["bodies[1].position: is a string, expected a list of numbers"]),
    ("[0, 0.5, 0, 0]", "[0, true, 0, 0]", &["bodies[1].position[1]: is true or false, expected a number"]),
    ("\"angle_deg\": 30", "\"angle_deg\": 30, \"angle\": 1", &["bodies[1].rotation[0]", "one of \"angle_deg\""]),
    ("\"circumradius\": 0.7", "\"circumradius\": 0.7, \"edge\": 1", &["both \"circumradius\" and \"edge\""]),
    (", \"circumradius\": 0.7", "", &["bodies[3].shape.polytope", "no size", "circumradius"]),
    ("\"kind\": \"static\"", "\"kind\": \"statick\"", &["bodies[0].kind", "\"statick\"", "nearest is \"static\""]),
    ("\"dt\": 0.01", "\"dt\": 0.01, \"dt\": 0.02", &["line 3", "\"dt\" stands twice"]),
];

const SYNTAX: &[Case] = &[
    ("\"dt\": 0.01", "\"dt\": NaN", &["line 3, column", "no NaN"]),
    ("\"dt\": 0.01", "\"dt\": -Infinity", &["line 3, column", "no NaN or Infinity"]),
    ("\"dt\": 0.01", "\"dt\": 1e999", &["line 3, column", "out of range"]),
    ("0.5, 0.5]}}", "0.5, 0.5,]}}", &["line 7, column", "not JSON", "trailing comma"]),
    ("\"joints\"", "joints", &["line 13, column", "not JSON", "in double quotes"]),
    ("}}]\n}", "}}]\n", &["cut off"]),
];

const VALUES: &[Case] = &[
    ("\"dimension\": 4", "\"dimension\": 7", &["dimension: is 7", "2 to 6"]),
    ("\"dimension\": 4", "\"dimension\": 1", &["dimension: is 1", "2 to 6"]),
    ("\"dimension\": 4", "\"dimension\": 3.5", &["dimension: is 3.5", "whole number"]),
    ("\"dimension\": 4", "\"dimension\": 4e9", &["dimension: is 4000000000", "2 to 6"]),
    ("\"dt\": 0.01", "\"dt\": 0", &["dt is 0", "1e-6"]),
    ("\"dt\": 0.01", "\"dt\": -0.01", &["dt is -0.01"]),
    ("\"substeps\": 4", "\"substeps\": 0", &["substeps is 0", "1 and 64"]),
    ("[0, -9.81, 0, 0]", "[0, -9.81, 0]", &["gravity: has 3 numbers, expected 4"]),
    ("[0, -9.81, 0, 0]", "[]", &["gravity: is an empty list"]),
    ("[0, 0.5, 0, 0]", "[0, 0.5, 0, 0, 0]", &["bodies[1].position: has 5 numbers, expected 4"]),
    ("[0.5, 0.5, 0.5, 0.5]", "[0.5, 0.5, 0.5]", &["bodies[1].shape.box.half_extents: has 3 numbers, expected 4"]),
    ("[0.5, 0.5, 0.5, 0.5]", "[0.5, 0, 0.5, 0.5]", &["bodies[1].shape.box.half_extents", "half-extent 1", "is 0"]),
    ("\"radius\": 0.5", "\"radius\": -0.5", &["bodies[2].shape.ball.radius", "-0.5"]),
    ("\"radius\": 0.5", "\"radius\": 0", &["bodies[2].shape.ball.radius", "is 0"]),
    ("\"radius\": 0.5", "\"radius\": 1e300", &["bodies[2].shape.ball.radius", "1e6"]),
    ("\"along\": \"x\"", "\"along\": \"v\"", &["bodies[4].shape.capsule.along", "\"v\"", "x, y, z, w"]),
    ("\"half_length\": 1", "\"half_length\": -1", &["bodies[4].shape.capsule", "-1"]),
    ("\"mass\": 2", "\"mass\": 0", &["bodies[1]", "mass is 0", "positive"]),
    ("\"mass\": 2", "\"mass\": -2", &["bodies[1]", "mass is -2"]),
    ("\"restitution\": 0.0", "\"restitution\": 1.5", &["materials.default.restitution: is 1.5", "0", "1"]),
    ("\"friction\": 0.1", "\"friction\": -1", &["materials.ice.friction: is -1", "0 or more"]),
    ("\"density\": 1.0", "\"density\": 0", &["materials.default.density: is 0", "above 0"]),
    ("\"mass\": 2", "\"density\": -1", &["bodies[1]", "density", "-1"]),
    ("\"mass\": 2", "\"gravity_scale\": 1, \"linear_damping\": -1", &["bodies[1]", "linear_damping", "-1"]),
    ("\"mass\": 2", "\"colour\": [1, 2, 0]", &["bodies[1].colour", "0 to 1"]),
    ("[0, -9.81, 0, 0]", "[0, -1e300, 0, 0]", &["gravity[1]: is -1e300", "±1e6 m/s²"]),
    ("\"mass\": 2", "\"gravity_scale\": 1e300", &["bodies[1].gravity_scale: is 1e300"]),
    ("\"mass\": 2", "\"mass\": 1e300", &["bodies[1]: the mass comes to 1e300 kg"]),
    ("\"mass\": 2", "\"velocity\": [0, 0, 1e5, 0]", &["bodies[1].velocity[2]: is 100000.0", "±4000 m/s"]),
    ("{\"xy\": 0.1}", "{\"xy\": 1e9}", &["bodies[1].angular_velocity.xy: is 1000000000.0", "rad/s"]),
    ("\"anchor_a\": [1, 0, 0, 0]", "\"anchor_a\": [1, 0, 0, -1e16]", &["joints[0].ball.anchor_a[3]: is -1e16"]),
    ("\"name\": \"ball\"", "\"name\": \"\"", &["bodies[2].name", "is no name"]),
    ("\"name\": \"ball\"", "\"name\": \"a\\u001b[31m\"", &["bodies[2].name", "u{1b}", "control characters"]),
    ("\"normal\": [0, 1, 0, 0]", "\"normal\": [0, 0, 0, 0]", &["bodies[0].shape.half_space", "normal"]),
    ("\"kind\": \"static\", ", "", &["bodies[0]", "half-space"]),
    ("\"24-cell\"", "\"25-cell\"", &["bodies[3].shape.polytope.regular", "25-cell", "24-cell"]),
    ("\"24-cell\"", "\"dodecahedron\"", &["bodies[3].shape.polytope.regular", "dodecahedron"]),
    ("\"circumradius\": 0.7", "\"circumradius\": -0.7", &["bodies[3].shape.polytope", "-0.7"]),
];

const NAMES_AND_ROTATIONS: &[Case] = &[
    ("\"name\": \"ball\"", "\"name\": \"block\"", &["bodies[2].name", "\"block\"", "bodies[1]", "differ"]),
    ("\"a\": \"block\"", "\"a\": \"blok\"", &["joints[0].ball.a", "\"blok\"", "nearest is \"block\""]),
    ("\"a\": \"block\"", "\"a\": \"xyzzy\"", &["joints[0].ball.a", "\"xyzzy\"", "there are \"ball\", \"block\""]),
    ("\"b\": \"ball\"", "\"b\": \"block\"", &["joints[0].ball", "\"block\" to itself"]),
    ("\"anchor_a\": [1, 0, 0, 0]", "\"anchor_a\": [1, 0, 0]", &["joints[0].ball.anchor_a: has 3 numbers"]),
    ("\"material\": \"ice\"", "\"material\": \"icy\"", &["bodies[1].material", "\"icy\"", "nearest is \"ice\""]),
    ("\"plane\": \"xw\"", "\"plane\": \"xv\"", &["bodies[1].rotation[0].plane", "\"xv\"", "xy, xz, xw, yz, yw, zw"]),
    ("\"plane\": \"xw\"", "\"plane\": \"xx\"", &["bodies[1].rotation[0].plane", "\"xx\""]),
    ("{\"xy\": 0.1}", "{\"xq\": 0.1}", &["bodies[1].angular_velocity.xq", "unknown plane"]),
    ("{\"xy\": 0.1}", "{\"xy\": 0.1, \"yx\": 0.2}", &["bodies[1].angular_velocity.yx", "xy is given twice"]),
    (
        "[{\"plane\": \"xw\", \"angle_deg\": 30}]",
        "{\"matrix\": [[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}",
        &["bodies[1].rotation.matrix", "not orthogonal"],
    ),
    (
        "[{\"plane\": \"xw\", \"angle_deg\": 30}]",
        "{\"matrix\": [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}",
        &["bodies[1].rotation.matrix", "reflection"],
    ),
    (
        "[{\"plane\": \"xw\", \"angle_deg\": 30}]",
        "{\"matrix\": [[1]]}",
        &["bodies[1].rotation.matrix: has 1 row, expected 4"],
    ),
    (
        "[{\"plane\": \"xw\", \"angle_deg\": 30}]",
        "{\"rotor\": [1, 0, 0, 0]}",
        &["bodies[1].rotation.rotor", "has 8 numbers", "got 4"],
    ),
    (
        "[{\"plane\": \"xw\", \"angle_deg\": 30}]",
        "{\"rotor\": [2, 0, 0, 0, 0, 0, 0, 0]}",
        &["bodies[1].rotation.rotor", "not a rotor", "length is 2"],
    ),
    ("[{\"plane\": \"xw\", \"angle_deg\": 30}]", "{}", &["bodies[1].rotation", "\"rotor\" and \"matrix\""]),
    (
        "{\"regular\": \"24-cell\", \"circumradius\": 0.7}",
        "{\"vertices\": [[0, 0, 0, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [1, 1, 1, 0]]}",
        &["bodies[3].shape.polytope.vertices", "span"],
    ),
    (
        "{\"regular\": \"24-cell\", \"circumradius\": 0.7}",
        "{\"vertices\": [[0, 0, 0, 0], [1, 0, 0, 0]]}",
        &["bodies[3].shape.polytope.vertices", "2", "5"],
    ),
    (
        "{\"regular\": \"24-cell\", \"circumradius\": 0.7}",
        "{\"vertices\": [[0, 0, 0], [1, 0, 0, 0]]}",
        &["bodies[3].shape.polytope.vertices[0]: has 3 numbers, expected 4"],
    ),
    (
        "{\"regular\": \"24-cell\", \"circumradius\": 0.7}",
        "{\"file\": \"not-there.off\"}",
        &["bodies[3].shape.polytope.file", "not-there.off", "cannot be read"],
    ),
    (
        "{\"regular\": \"24-cell\", \"circumradius\": 0.7}",
        "{\"file\": \"../secret.off\"}",
        &["bodies[3].shape.polytope.file", "beside the scene"],
    ),
    (
        "{\"regular\": \"24-cell\", \"circumradius\": 0.7}",
        "{\"file\": \"good.json\"}",
        &["bodies[3].shape.polytope.file", "OFF, line 1"],
    ),
    ("{\"ball\": {\"radius\": 0.5}}", "{\"compound\": {\"parts\": []}}", &["bodies[2].shape.compound", "0 parts"]),
    (
        "{\"ball\": {\"radius\": 0.5}}",
        "{\"compound\": {\"parts\": [{\"shape\": {\"half_space\": {\"normal\": [1, 0, 0, 0]}}}]}}",
        &["bodies[2].shape.compound", "half-space"],
    ),
    (
        "{\"ball\": {\"radius\": 0.5}}",
        "{\"compound\": {\"parts\": [{\"shape\": {\"box\": {\"half_extents\": [1, 1, 1, -1]}}}]}}",
        &["bodies[2].shape.compound.parts[0].shape.box.half_extents", "-1"],
    ),
    (
        "{\"ball\": {\"radius\": 0.5}}",
        "{\"rounded\": {\"shape\": {\"box\": {\"half_extents\": [1, 1, 1, 1]}}, \"radius\": 0}}",
        &["bodies[2].shape.rounded", "is 0"],
    ),
];

/// Runs the program on a spoilt file and looks at how it ends.
fn assert_refused(name: &str, content: impl AsRef<[u8]>, fragments: &[&str]) {
    let path = file(name, content);
    let path = path.to_str().expect("the path is UTF-8");
    for command in [&["run", path, "--steps", "1"][..], &["bench", path, "--steps", "1"], &["inspect", path]] {
        assert_ends_badly(command, &[fragments, &[name]].concat());
    }
}

fn assert_ends_badly(arguments: &[&str], fragments: &[&str]) {
    let output = hyperbody(arguments);
    let message = String::from_utf8(output.stderr).expect("messages are UTF-8");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert_eq!(output.stdout, b"", "{arguments:?} printed results");
    assert_eq!(message.lines().count(), 1, "{arguments:?} said more than one line: {message}");
    assert!(message.starts_with("error: ") && message.len() < 600, "{arguments:?}: {message}");
    for fragment in fragments {
        assert!(message.contains(fragment), "{arguments:?}: expected {fragment:?} in: {message}");
    }
}

fn assert_all_refused(folder: &str, cases: &[Case]) {
    file(&format!("{folder}/good.json"), GOOD);
    for (index, (from, to, fragments)) in cases.iter().enumerate() {
        assert_eq!(GOOD.matches(from).count(), 1, "{from:?} has to stand once in the good scene");
        assert_refused(&format!("{folder}/{index}.json"), GOOD.replace(from, to), fragments);
    }
}

#[test]
fn the_good_scene_is_good() {
    let path = file("good-scene.json", GOOD);
    crate::common::json_of(&["run", path.to_str().expect("the path is UTF-8"), "--steps", "3", "--json"]);
    let cases = [STRUCTURE, SYNTAX, VALUES, NAMES_AND_ROTATIONS].iter().map(|cases| cases.len()).sum::<usize>();
    assert!(cases >= 40, "{cases} cases");
}

#[test]
fn wrong_structure() {
    assert_all_refused("structure", STRUCTURE);
}

#[test]
fn wrong_syntax() {
    assert_all_refused("syntax", SYNTAX);
}

#[test]
fn wrong_values() {
    assert_all_refused("values", VALUES);
}

#[test]
fn wrong_names_and_rotations() {
    assert_all_refused("names", NAMES_AND_ROTATIONS);
}

#[test]
fn what_is_no_scene_at_all() {
    assert_refused("no/empty.json", "", &["line 1", "cut off"]);
    assert_refused("no/list.json", "[1, 2]", &["is a list, expected"]);
    assert_refused("no/latin1.json", b"{\n\"name\": \"caf\xe9\"}", &["line 2", "not UTF-8"]);
    assert_refused("no/deep.json", "[".repeat(10_000), &["128 levels"]);
    assert_refused("no/large.json", vec![b' '; (64 << 20) + 1], &["larger than 64 MiB"]);
    let folder = env!("CARGO_TARGET_TMPDIR");
    assert_ends_badly(&["run", folder], &["cannot be read"]);
    assert_ends_badly(&["run", "not-there.json"], &["not-there.json: cannot be read"]);
    assert_ends_badly(&["run", "stakc4d"], &["no file \"stakc4d\"", "nearest is \"stack4d\""]);
    let output = hyperbody(&["run", "nosuch"]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(error.contains("no built-in scene of that name (`hyperbody scenes`"), "nothing is like it: {error}");
    assert_refused("no/picture.json", b"\x89PNG\r\n\x1a\n and more", &["is a PNG picture", "name a scene"]);
}

#[test]
fn bad_arguments() {
    for arguments in [
        &["run"][..],
        &["run", "stack4d", "--steps", "-1"],
        &["run", "stack4d", "--steps", "1", "--seconds", "1"],
        &["run", "stack4d", "--seconds", "nan"],
        &["run", "stack4d", "--seconds", "-1"],
        &["run", "stack4d", "--threads", "0"],
        &["run", "stack4d", "--threads", "many"],
        &["run", "stack4d", "--stepz", "1"],
        &["bench", "stack4d", "--steps", "0"],
        &["inspect", "stack4d", "--dimension", "9"],
        &["fly"],
        &[],
    ] {
        let output = hyperbody(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty(), "{arguments:?}");
    }
    assert_ends_badly(&["run", "stack4d", "--seconds", "1e9"], &["at most 10000000 steps"]);
    assert_ends_badly(&["bench", "stack4d", "--steps", "5", "--warmup", "5"], &["--warmup 5", "smaller"]);
    assert_ends_badly(&["inspect", "stack4d", "--dimension", "3"], &["4 dimensions, not 3"]);
}

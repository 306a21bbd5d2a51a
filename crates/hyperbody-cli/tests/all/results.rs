//! What the commands print: the keys that scripts rely on, and what stays the same between runs.

use crate::common::{file, hyperbody, json_of, keys};

#[test]
fn run_prints_the_documented_keys() {
    let run = json_of(&["run", "pendulum4d", "--steps", "30", "--json"]);
    let expected =
        "angular_momentum bodies contacts dimension dt energy hash momentum quarantined scene seconds step_ms steps";
    assert_eq!(keys(&run).join(" "), expected);
    let body = &run["bodies"][1];
    assert_eq!(keys(body).join(" "), "angular_velocity name position rotation sleeping velocity");
    assert_eq!(body["name"], "upper");
    assert_eq!(keys(&body["angular_velocity"]).join(" "), "xw xy xz yw yz zw");
    assert_eq!(keys(&run["angular_momentum"]).join(" "), "xw xy xz yw yz zw");
    for rows in body["rotation"].as_array().expect("rows") {
        assert_eq!(rows.as_array().map(Vec::len), Some(4));
    }
    assert_eq!(keys(&run["energy"]).join(" "), "initial kinetic potential total");
    assert_eq!(keys(&run["energy"]["initial"]).join(" "), "kinetic potential total");
    assert_eq!(keys(&run["contacts"]).join(" "), "count final_max_penetration max_penetration");
    assert_eq!(keys(&run["step_ms"]).join(" "), "max median p95");
    assert_eq!((run["steps"].as_u64(), run["dimension"].as_u64()), (Some(30), Some(4)));
    assert!((run["seconds"].as_f64().expect("a number") - 0.5).abs() < 1e-12);
    let hash = run["hash"].as_str().expect("a text");
    assert!(hash.len() == 16 && hash.chars().all(|digit| digit.is_ascii_hexdigit()), "{hash}");
    // The order of keys is that of planes, and numbers are numbers: a pendulum that was pushed along w.
    let text = String::from_utf8(hyperbody(&["run", "pendulum4d", "--steps", "1", "--json"]).stdout).expect("UTF-8");
    assert!(text.contains(r#"{"xy":"#) && text.contains(r#","zw":"#), "{text}");
    assert!(run["momentum"][3].as_f64().expect("a number") > 0.0);
}

#[test]
fn seconds_and_steps_say_the_same() {
    let hash = |arguments: &[&str]| {
        json_of(&[&["run", "dominoes3d", "--json"], arguments].concat())["hash"].as_str().expect("a text").to_owned()
    };
    let expected = hash(&["--steps", "45"]);
    assert_eq!(hash(&["--seconds", "0.75"]), expected);
    assert_eq!(hash(&["--steps", "45", "--threads", "2"]), expected);
    let seeded = hash(&["--steps", "45", "--seed", "1"]);
    assert_ne!(seeded, expected, "a seed shifts the bodies");
    assert_eq!(seeded, hash(&["--steps", "45", "--seed", "1"]), "always alike");
    assert_ne!(seeded, hash(&["--steps", "45", "--seed", "2"]));
}

#[test]
fn a_written_scene_runs_to_the_same_bits() {
    let folder = format!("{}/written", env!("CARGO_TARGET_TMPDIR"));
    let listed = json_of(&["scenes", "--write", &folder, "--force", "--json"]);
    let scenes = listed["scenes"].as_array().expect("a list");
    assert!(scenes.len() >= 14);
    for scene in scenes {
        assert_eq!(keys(scene).join(" "), "bodies description dimension file joints name");
        let (name, path) = (scene["name"].as_str().expect("a name"), scene["file"].as_str().expect("a path"));
        let hash = |scene: &str| json_of(&["run", scene, "--steps", "5", "--json"])["hash"].clone();
        assert_eq!(hash(path), hash(name), "{name} from its file");
    }
}

/// Written scenes are there to be changed: writing them again must not lose the changes.
#[test]
fn a_changed_scene_is_not_overwritten_unasked() {
    let folder = format!("{}/changed", env!("CARGO_TARGET_TMPDIR"));
    let write = |more: &[&str]| hyperbody(&[&["scenes", "--write", &folder], more].concat());
    assert!(write(&["--force"]).status.success());
    assert!(write(&[]).status.success(), "what has not been changed may be written again");
    let path = format!("{folder}/stack4d.json");
    std::fs::write(&path, "{}").expect("the file can be written");
    let refused = write(&[]);
    assert_eq!(refused.status.code(), Some(2));
    let message = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(message.contains("stack4d.json") && message.contains("--force"), "{message}");
    assert_eq!(std::fs::read_to_string(&path).expect("still there"), "{}");
    assert!(write(&["--force"]).status.success());
}

#[test]
fn bench_prints_the_documented_keys() {
    let arguments = ["bench", "stack4d", "chain3d", "--steps", "20", "--warmup", "5", "--json"];
    let bench = json_of(&arguments);
    assert_eq!(keys(&bench), ["scenes"]);
    let scenes = bench["scenes"].as_array().expect("a list");
    assert_eq!(scenes.len(), 2);
    for scene in scenes {
        for key in "bodies dimension final_max_penetration hash max_penetration name stages_ms step_ms steps threads"
            .split(' ')
        {
            assert!(!scene[key].is_null(), "{key} is missing in {scene}");
        }
        assert_eq!(keys(&scene["step_ms"]).join(" "), "max median p95");
        let stages = scene["stages_ms"].as_object().expect("an object");
        let sum: f64 = stages.values().map(|ms| ms.as_f64().expect("a number")).sum();
        let step = scene["step_ms"]["max"].as_f64().expect("a number");
        assert!(stages.len() >= 4 && sum > 0.0 && sum < 10.0 * step, "{scene}");
    }
    assert_eq!(scenes[0]["hash"], json_of(&["run", "stack4d", "--steps", "20", "--json"])["hash"]);
    let awake = json_of(&["bench", "stack4d", "--steps", "200", "--awake", "--json"]);
    let asleep = json_of(&["bench", "stack4d", "--steps", "200", "--json"]);
    assert_ne!(awake["scenes"][0]["hash"], asleep["scenes"][0]["hash"], "ten boxes at rest for three seconds sleep");
}

#[test]
fn inspect_tells_the_mass_properties_of_shapes() {
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let cell = file("shapes/cell.json", r#"{"polytope": {"regular": "24-cell", "circumradius": 1}}"#);
    let cell = json_of(&["inspect", cell.to_str().expect("UTF-8"), "--json"]);
    let expected = "centroid closed convex dimension faces principal_moments second_moments volume";
    assert_eq!(keys(&cell).join(" "), expected);
    assert_eq!(cell["faces"], serde_json::json!([24, 96, 96, 24]));
    assert_eq!((cell["convex"].as_bool(), cell["closed"].as_bool()), (Some(true), Some(true)));
    assert!((number(&cell["volume"]) - 2.0).abs() < 1e-12);
    for axis in 0..4 {
        assert!((number(&cell["principal_moments"][axis]) - 13.0 / 120.0).abs() < 1e-13);
        assert!((number(&cell["second_moments"][axis][axis]) - 13.0 / 60.0).abs() < 1e-13);
    }
    let block = file("shapes/block.json", r#"{"box": {"half_extents": [1, 3, 2]}}"#);
    let block = json_of(&["inspect", block.to_str().expect("UTF-8"), "--json"]);
    assert_eq!(block["faces"], serde_json::json!([8, 12, 6]));
    // h²/3 per unit mass, descending.
    for (axis, half_extent) in [3.0_f64, 2.0, 1.0].into_iter().enumerate() {
        assert!((number(&block["principal_moments"][axis]) - half_extent * half_extent / 3.0).abs() < 1e-13);
    }
    let off = "OFF\n5 5 8\n1 1 0\n-1 1 0\n-1 -1 0\n1 -1 0\n0 0 3\n4 3 2 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
    let pyramid = file("shapes/pyramid.off", off);
    let pyramid = json_of(&["inspect", pyramid.to_str().expect("UTF-8"), "--json"]);
    assert_eq!(pyramid["faces"], serde_json::json!([5, 8, 5]));
    assert!((number(&pyramid["volume"]) - 4.0).abs() < 1e-12 && (number(&pyramid["centroid"][2]) - 0.75).abs() < 1e-12);
    let scene = file(
        "shapes/scene.json",
        r#"{"format": "hyperbody-scene", "version": 1, "dimension": 3,
            "bodies": [{"shape": {"polytope": {"file": "pyramid.off"}}}]}"#,
    );
    let scene = json_of(&["inspect", scene.to_str().expect("UTF-8"), "--json"]);
    assert!((number(&scene["bodies"][0]["mass"]) - 4.0).abs() < 1e-12, "{scene}");
    assert_eq!(scene["scene"], "scene", "a scene without a name has that of its file");
}

#[test]
fn a_shape_that_does_not_tell_its_dimension_is_asked_for_it() {
    let ball = file("shapes/ball.json", r#"{"ball": {"radius": 1}}"#);
    let ball = ball.to_str().expect("UTF-8");
    let output = hyperbody(&["inspect", ball]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("--dimension"));
    let volume = json_of(&["inspect", ball, "--dimension", "4", "--json"])["volume"].as_f64().expect("a number");
    assert!((volume - std::f64::consts::PI.powi(2) / 2.0).abs() < 1e-12, "the unit ball of 4D has volume π²/2");
}

#[test]
fn people_get_a_table() {
    let output = hyperbody(&["run", "pit4d", "--steps", "3"]);
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    assert!(output.status.success() && output.stderr.is_empty(), "no progress bar where there is no terminal");
    for part in ["pit4d: 4 dimensions, 3 steps", "floor", "… and 68 more bodies", "energy", "state hash", "ms p95"] {
        assert!(text.contains(part), "{part:?} is missing in:\n{text}");
    }
    for arguments in [&["inspect", "dice4d"][..], &["scenes"], &["bench", "chain3d", "--steps", "3"], &["help", "run"]]
    {
        let output = hyperbody(arguments);
        assert!(output.status.success() && output.stdout.len() > 200, "{arguments:?}");
    }
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_no_failure() {
    use std::process::{Command, Stdio};
    let mut child = Command::new(env!("CARGO_BIN_EXE_hyperbody"))
        .args(["scenes", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program was built for this test");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("it ends");
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
}

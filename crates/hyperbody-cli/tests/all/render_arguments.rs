//! `hyperbody render`: what is said of arguments that make no sense, and of those that change nothing.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::common::{file, hyperbody, json_of};

fn place(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("render-arguments");
    std::fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

/// The command is refused with status 2 and a short message that holds the words; nothing is written.
fn refused(arguments: &[&str], words: &str) {
    let picture = place("refused.png");
    let output = hyperbody(&[&["render", "dice4d", "-o", picture.to_str().unwrap()], arguments].concat());
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
    assert!(
        error.contains(words) && error.len() < 300 + arguments.concat().len(),
        "{arguments:?} should speak of {words:?}: {error}"
    );
    assert!(!picture.exists());
}

#[test]
fn every_number_has_a_range_that_is_told() {
    let nines = "9".repeat(400);
    let too_many = format!("w={}...5,3", "9".repeat(5000));
    for (option, value, words) in [
        ("--at", "1e300", "1e300 is not a number from 0 to 1000000000 s"),
        ("--at", "-5", "-5 is not a number from 0 to"),
        ("--slice", "w=1e300", "1e300 is not a number from -1000000 to 1000000 m"),
        ("--turn", "xw=1e300", "1e300 is not a number from -36000 to 36000°"),
        ("--camera", "1e300,0", "from -36000 to 36000°"),
        ("--camera", "0,91", "91 is not a number from -90 to 90° above the horizon"),
        ("--camera", "0,0,1e7", "from 0.001 to 1000000 m away"),
        ("--look-at", "0,1e300,0", "from -1000000 to 1000000 m"),
        ("--field-of-view", "-5", "-5 is not a number from 1 to 150°"),
        ("--sheet", "w=0..1e300,3", "from -1000000 to 1000000 m"),
        ("--sheet", "xw=0..1e300,3", "from -36000 to 36000°"),
        ("--sheet", "t=0..1e300,3", "to 1000000000 s"),
        ("--sheet", "w=0...1,3", "more than two dots; write 0..1, or 0..0.1"),
        ("--sheet", "w=0...,3", "has more than two dots; write FROM..TO, two numbers"),
        ("--sheet", &too_many, "999…\" has more than two dots; write FROM..TO, two numbers"),
        ("--width", "-5", "-5 is not a whole number from 16 to 8192"),
        ("--quality", "-1", "-1 is not a whole number from 1 to 64"),
        ("--threads", "-1", "-1 is not a whole number from 1 to 256"),
        ("--columns", "1.5", "1.5 is not a whole number from 1 to 64"),
        ("--frame-rate", "33.3", "33.3 is not a whole number from 1 to 60"),
        ("--slice", &nines, "is not of the form NAME=NUMBER"),
        ("--look-at", &nines, "999… is not a number from"),
    ] {
        refused(&[option, value], words);
    }
    for (arguments, words) in [
        (["run", "stack4d", "--steps", "-5"], "-5 is not a whole number from 0 to 10000000"),
        (["bench", "stack4d", "--threads", "-5"], "-5 is not a whole number from 1 to 256"),
        (["inspect", "stack4d", "--dimension", "-4"], "-4 is not a whole number from 2 to 6"),
    ] {
        let error = String::from_utf8(hyperbody(&arguments).stderr).unwrap();
        assert!(error.contains(words) && !error.contains("-- -"), "{error}");
    }
}

#[test]
fn an_ending_is_no_name() {
    for name in [".png", "pictures/.gif", ".MP4"] {
        let output = hyperbody(&["render", "dice4d", "-o", name]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains("has no name before its ending"), "{error}");
    }
}

/// What is written on standard error while a small picture of a scene is drawn.
fn said(scene: &str, name: &str, arguments: &[&str]) -> String {
    let picture = place(name);
    let small = ["--width", "48", "--height", "32", "--quality", "1", "-o", picture.to_str().unwrap()];
    let output = hyperbody(&[&["render", scene], &small[..], arguments].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn options_that_change_nothing_in_a_scene_are_told() {
    let said = |scene: &str, name: &str, arguments: &[&str], words: &str| {
        let text = said(scene, name, arguments);
        assert_eq!(text.lines().count(), usize::from(!words.is_empty()), "{text}");
        assert!(text.contains(words) && (text.is_empty() || text.starts_with("warning: ")), "{text}");
    };
    let now: &[&str] = &["--at", "0", "--no-ghosts"];
    said("bounce2d", "flat.png", now, "--no-ghosts changes nothing: 2 dimensions have no hidden axis");
    said("chain3d", "solid.png", &["--at", "0", "--no-strip"], "--no-strip changes nothing: 3 dimensions");
    said("dice4d", "four.png", now, "");
    said("dice4d", "times.png", &["--sheet", "t=0..0.1,2", "--no-strip"], "only sheets of places");
    said("dice4d", "places.png", &["--sheet", "w=0..0.1,2", "--at", "0", "--no-strip"], "");
    let film: &[&str] = &["--seconds", "0.1", "--speed", "0"];
    said("dice4d", "still.gif", film, "all pictures are the same");
    said("dice4d", "moving.gif", &[film, &["--slice-to", "w=1"]].concat(), "");
    // Where the slice is said to go is where it is.
    for (name, options) in [
        ("same-place.gif", &["--slice", "w=1", "--slice-to", "w=1"][..]),
        ("same-turn.gif", &["--turn", "xw=30", "--turn-to", "xw=30"]),
        ("same-backwards.gif", &["--turn", "xw=30", "--turn-to", "wx=-30"]),
        ("no-place.gif", &["--slice-to", "w=0"]),
        ("no-turn.gif", &["--turn-to", "xw=0"]),
    ] {
        said("dice4d", name, &[film, options].concat(), "all pictures are the same");
    }
    said("dice4d", "turning.gif", &[film, &["--turn", "xw=30", "--turn-to", "xw=0"]].concat(), "");
    said("dice4d", "one-place.png", &["--sheet", "w=1..1,2", "--at", "0"], "w ends where it begins: all pictures are");
    said("dice4d", "one-moment.png", &["--sheet", "t=0..0,2"], "t ends where it begins");
}

/// In a high picture the strips leave room; one that leaves none for them says so.
#[test]
fn high_pictures_without_room_for_strips_are_told() {
    let size = |width| ["--at", "0", "--quality", "1", "--width", width, "--height", "200"];
    let draw = |scene: &str, width: &'static str, more: &[&str]| {
        let picture = place("high.png");
        let arguments = ["render", scene, "-o", picture.to_str().unwrap()];
        let output = hyperbody(&[&arguments[..], &size(width)[..], more].concat());
        assert!(output.status.success());
        String::from_utf8(output.stderr).unwrap()
    };
    let told = draw("dice4d", "40", &[]);
    assert!(told.contains("the strip of hidden axes is left out: in 40 × 200 pixels"), "{told}");
    assert_eq!(draw("dice4d", "40", &["--no-strip"]), "");
    assert_eq!(draw("dice4d", "90", &[]), "");
    assert_eq!(draw("chain3d", "40", &[]), "");
}

/// Within a wall there is nothing of it to see; the picture says why it is not there.
#[test]
fn a_slice_within_a_wall_is_told() {
    let text = r#"{"format": "hyperbody-scene", "version": 1, "dimension": 4, "bodies": [
        {"name": "the wall", "kind": "static", "shape": {"half_space": {"normal": [0, 0, 0, 1], "offset": -3}}},
        {"name": "ball", "shape": {"ball": {"radius": 1}}}]}"#;
    let scene = file("render-arguments/walls.json", text);
    let scene = scene.to_str().unwrap();
    let within = said(scene, "within.png", &["--at", "0", "--slice", "w=-4"]);
    assert!(
        within.contains("lies wholly within the half-space \"the wall\"") && within.contains("--slice"),
        "{within}"
    );
    assert_eq!(said(scene, "before.png", &["--at", "0", "--slice", "w=-2.9"]), "");
    let through = said(scene, "through.gif", &["--seconds", "0.2", "--speed", "0", "--slice-to", "w=-6"]);
    assert_eq!(through.lines().count(), 1, "once for a film: {through}");
}

/// A camera of which the angles are said stands as far away as they ask for, and so it does for a field of view.
#[test]
fn framing_follows_the_angles_that_are_said() {
    let camera = |arguments: &[&str]| -> Value {
        let picture = place("framed.png");
        let small = ["--at", "0", "--width", "48", "--quality", "1", "--json", "-o", picture.to_str().unwrap()];
        json_of(&[&["render", "dominoes3d"], &small[..], arguments].concat())["camera"].clone()
    };
    let distance = |camera: &Value| camera["distance"].as_f64().unwrap();
    // The dominoes reach farther along x than along z.
    let (end, front) = (camera(&["--camera", "90,0"]), camera(&["--camera", "0,0"]));
    assert!((distance(&end) / distance(&front) - 1.0).abs() > 0.05, "{end} {front}");
    let (wide, narrow) = (camera(&["--field-of-view", "90"]), camera(&["--field-of-view", "10"]));
    // Were there no depth it would be as the tangents of the halves, 11.4 times; what is near needs room in a wide view.
    assert!((4.0..8.0).contains(&(distance(&narrow) / distance(&wide))), "{wide} {narrow}");
    assert_eq!(camera(&["--camera", "10,20,7", "--look-at", "1,2,3"])["distance"].as_f64().map(f64::round), Some(7.0));
}

/// The poses of a recording are those of its simulation, and have the same hash; a state it has not.
#[test]
fn recordings_have_the_hash_of_their_poses() {
    let recording = place("poses.hbrec");
    let recording = recording.to_str().unwrap();
    json_of(&["run", "cradle2d", "--seconds", "0.5", "--record", recording, "--json"]);
    let picture = place("poses.png");
    let report = |scene: &str, at: &str| {
        json_of(&["render", scene, "--at", at, "--width", "48", "--json", "-o", picture.to_str().unwrap()])
    };
    let (live, played) = (report("cradle2d", "0.5"), report(recording, "0.5"));
    assert_eq!(live["poses_hash"], played["poses_hash"]);
    assert!(live["hash"].is_string() && played["hash"].is_null());
    assert_ne!(report(recording, "0.4")["poses_hash"], played["poses_hash"]);
}

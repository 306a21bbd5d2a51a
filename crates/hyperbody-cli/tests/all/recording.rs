//! `hyperbody run --record`, and what reads recordings.

use std::path::PathBuf;

use crate::common::{file, hyperbody, json_of};

fn place(name: &str) -> (PathBuf, String) {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let text = path.to_str().expect("a path in UTF-8").to_owned();
    (path, text)
}

/// The command ends with status 2 and one line that holds all of the words.
fn refused(arguments: &[&str], words: &[&str]) {
    let output = hyperbody(arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
    assert!(output.stdout.is_empty() && error.starts_with("error: "), "{error}");
    for word in words {
        assert!(error.contains(word), "{arguments:?} should speak of {word:?}: {error}");
    }
}

#[test]
fn a_run_is_recorded_and_inspected() {
    let (path, name) = place("stack.hbrec");
    let run = json_of(&["run", "stack4d", "--steps", "100", "--record", &name, "--json"]);
    assert_eq!(run["recording"]["frames"], 101);
    assert_eq!(run["recording"]["bytes"], std::fs::metadata(&path).unwrap().len());
    let plain = json_of(&["run", "stack4d", "--steps", "100", "--json"]);
    assert_eq!((plain.get("recording"), &plain["hash"]), (None, &run["hash"]), "recording changes nothing");
    let report = json_of(&["inspect", &name, "--json"]);
    assert_eq!((&report["scene"], &report["frames"]), (&"stack4d".into(), &101.into()));
    assert_eq!((&report["dimension"], &report["bodies"]), (&4.into(), &11.into()));
    assert_eq!((&report["first"]["step"], &report["last"]["step"]), (&0.into(), &100.into()));
    assert_eq!(report["last"]["time"], run["seconds"]);
    let asleep = run["bodies"].as_array().unwrap().iter().filter(|body| body["sleeping"] == true).count();
    assert_eq!(report["last"]["sleeping"], asleep);
    let text = String::from_utf8(hyperbody(&["inspect", &name]).stdout).unwrap();
    for word in ["stack4d", "sound to the last byte", "101", "1.66667 s, step 100"] {
        assert!(text.contains(word), "{text}");
    }
    json_of(&["run", "stack4d", "--steps", "100", "--record-every", "30", "--record", &name, "--json"]);
    let every = json_of(&["inspect", &name, "--json"]);
    assert_eq!((&every["frames"], &every["last"]["step"]), (&5.into(), &100.into()), "0, 30, 60, 90 and the last");
}

#[test]
fn recordings_are_taken_where_they_make_sense() {
    let (_, name) = place("chain.hbrec");
    json_of(&["run", "chain3d", "--steps", "5", "--record", &name, "--json"]);
    refused(&["run", &name], &["is a recording", "render"]);
    refused(&["bench", &name], &["is a recording"]);
    refused(&["inspect", &name, "--dimension", "4"], &["has 3 dimensions, not 4"]);
    let output = hyperbody(&["run", "chain3d", "--record-every", "2"]);
    assert_eq!(output.status.code(), Some(2), "--record-every needs --record");
}

#[test]
fn cut_off_damaged_and_foreign_recordings_are_told_apart() {
    let (path, name) = place("whole.hbrec");
    json_of(&["run", "bounce2d", "--steps", "200", "--record", &name, "--json"]);
    let bytes = std::fs::read(path).unwrap();
    let broken = |name: &str, bytes: &[u8], words: &[&str]| {
        let path = file(name, bytes);
        refused(&["inspect", path.to_str().unwrap()], words);
    };
    let half = bytes.len() / 2;
    broken("half.hbrec", &bytes[..half], &["half.hbrec: the recording is cut off at byte", "copy it again"]);
    let mut flipped = bytes.clone();
    flipped[half] ^= 16;
    broken("flipped.hbrec", &flipped, &["damaged at byte", "checksum of block FRMS", "copy it again"]);
    broken("text.hbrec", b"not one", &["is no recording", "--record FILE"]);
    let mut newer = bytes;
    newer[8] = 9;
    broken("newer.hbrec", &newer, &["version 9", "reads version 1"]);
}

#[test]
fn what_cannot_be_recorded_is_refused_before_the_run() {
    refused(&["run", "stack4d", "--record", "/no/such/folder/a.hbrec"], &["--record", "there is no folder"]);
    refused(&["run", "stack4d", "--record", env!("CARGO_TARGET_TMPDIR")], &["is a folder"]);
}

/// A device that is always full stands for the disk.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_the_run_with_a_clear_error() {
    refused(
        &["run", "pit4d", "--steps", "200", "--record", "/dev/full"],
        &["/dev/full: cannot be written: No space left"],
    );
    let device = std::fs::metadata("/dev/full").unwrap();
    assert!(!device.is_file(), "a device stays a device");
}

/// Where files may not grow beyond so many blocks, the recording fails and leaves what was there.
#[cfg(unix)]
#[test]
fn a_failed_recording_leaves_the_old_one() {
    let (path, name) = place("kept/kept.hbrec");
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(&path, b"\x89HBREC of old").unwrap();
    let line = format!(
        "trap '' XFSZ; ulimit -f 8; exec {} run pit4d --steps 300 --record {name}",
        env!("CARGO_BIN_EXE_hyperbody")
    );
    let output = std::process::Command::new("sh").args(["-c", &line]).output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("kept.hbrec: cannot be written"), "{error}");
    assert_eq!(std::fs::read(&path).unwrap(), b"\x89HBREC of old");
    assert_eq!(std::fs::read_dir(path.parent().unwrap()).unwrap().count(), 1, "nothing is left beside it");
}

/// A recording may be called anything: a file that is none is not replaced by one.
#[test]
fn what_is_no_recording_is_not_replaced() {
    let (_, picture) = place("replaced/dice.png");
    std::fs::create_dir_all(PathBuf::from(&picture).parent().unwrap()).unwrap();
    let drawn = hyperbody(&["render", "bounce2d", "--at", "0", "--width", "32", "-o", &picture]);
    assert!(drawn.status.success());
    for (name, content, words) in [
        ("dice.png", None, "dice.png: is a PNG picture, and would be lost"),
        ("film.mp4", Some("\0\0\0\u{1c}ftypisom"), "is an MP4 film"),
        ("other.json", Some(" {\"format\": 1}"), "is a JSON file"),
        ("cube.off", Some("4OFF\n"), "is an OFF file"),
        ("notes.hbrec", Some("to be done"), "is no recording"),
    ] {
        let (path, name) = place(&format!("replaced/{name}"));
        if let Some(content) = content {
            std::fs::write(&path, content).unwrap();
        }
        let before = std::fs::read(&path).unwrap();
        refused(&["run", "bounce2d", "--steps", "5", "--record", &name], &["--record: ", words, "name another file"]);
        assert_eq!(std::fs::read(&path).unwrap(), before);
    }
    let (path, name) = place("replaced/empty.png");
    std::fs::write(&path, "").unwrap();
    for steps in ["5", "6"] {
        json_of(&["run", "bounce2d", "--steps", steps, "--record", &name, "--json"]);
    }
    assert_eq!(json_of(&["inspect", &name, "--json"])["last"]["step"], 6, "a recording is replaced by another");
    refused(
        &["render", &picture, "-o", &name],
        &["dice.png: is a PNG picture; name a scene, a .json file, or a recording"],
    );
}

/// Nor is any file that was read: neither the scene nor the shapes beside it.
#[test]
fn files_that_a_scene_names_are_not_overwritten() {
    let simplex = "4OFF\n5 5 0\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    let off = file("names/simplex.off", simplex);
    let again = file("names/simplex.png", simplex);
    let shape =
        |name: &str| format!(r#"{{"rounded": {{"radius": 0.1, "shape": {{"polytope": {{"file": "{name}"}}}}}}}}"#);
    let scene = |name: &str| {
        let bodies = format!(r#"[{{"shape": {}}}]"#, shape(name));
        format!(r#"{{"format": "hyperbody-scene", "version": 1, "dimension": 4, "bodies": {bodies}}}"#)
    };
    let alone = file("names/shape.json", shape("simplex.off"));
    let first = file("names/scene.json", scene("simplex.off"));
    let second = file("names/picture.json", scene("simplex.png"));
    let [off, again, alone, first, second] =
        [&off, &again, &alone, &first, &second].map(|path| path.to_str().unwrap().to_owned());
    let around = off.replace("names/", "names/../names/");
    for arguments in [
        ["run", &first, "--steps=5", "--record", &off],
        ["run", &first, "--steps=5", "--record", &around],
        ["slice", &alone, "--dimension=4", "--output", &off],
        ["slice", &alone, "--dimension=4", "--output", &around],
        ["render", &second, "--at=0", "--output", &again],
    ] {
        refused(&arguments, &[arguments[3], "is a file that the input names, which would be lost"]);
    }
    refused(&["run", &first, "--record", &first], &["is the input itself"]);
    assert_eq!([&off, &again].map(|path| std::fs::read_to_string(path).unwrap()), [simplex, simplex]);
}

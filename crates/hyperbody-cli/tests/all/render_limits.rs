//! `hyperbody render`: sizes and combinations of options that it refuses before any work, what it says of its work, and
//! what it leaves behind when it is stopped.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::common::hyperbody;

/// An empty folder of this name.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("render-limits").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The command is refused with exit status 2 and all of the words, before any work, and leaves nothing behind.
fn refused(arguments: &[&str], words: &[&str]) {
    let folder = folder("refused");
    let png = folder.join("refused.png");
    let output = hyperbody(&[&["render", "dice4d", "-o", png.to_str().unwrap()], arguments].concat());
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
    for word in words {
        assert!(error.contains(word), "{arguments:?} should speak of {word:?}: {error}");
    }
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0, "{arguments:?} leaves nothing behind");
}

#[test]
fn sizes_that_are_too_large_are_refused_before_the_work() {
    // An hour of simulation and 64 pictures of 67 million pixels stand behind these: a test that did the work would not end.
    refused(
        &["--at", "3600", "--sheet", "w=-1..1,64", "--width", "8192", "--height", "8192"],
        &["--sheet", "64 pictures of 8192 × 8192", "65564 × 65564 pixels", "300 MB are the most", "smaller or fewer"],
    );
    refused(&["--sheet", "t=0..3600,64", "--width", "4096"], &["4096 × 2304", "300 MB"]);
    refused(
        &["--at", "3600", "--height", "8192"],
        &["--height 8192", "14562 × 8192", "8192 across are the most", "--width", "--height of 4608 at most"],
    );
    for side in ["--width", "--height"] {
        refused(&[side, "8193"], &[side, "8193 is not a whole number from 16 to 8192"]);
        refused(&[side, "15"], &[side, "15 is not a whole number from 16 to 8192"]);
    }
}

#[test]
fn what_is_said_twice_is_refused() {
    refused(
        &["--sheet", "w=-1..1,3", "--slice", "w=0.5"],
        &["--slice: w=0.5 and --sheet w=…", "leave one of them out"],
    );
    refused(
        &["--sheet", "xw=0..90,3", "--turn", "xw=30"],
        &["--turn: xw=30 and --sheet xw=…", "leave one of them out"],
    );
    refused(&["--sheet", "wx=0..90,3", "--turn", "xw=30"], &["--turn: xw=30 and --sheet wx=…"]);
    refused(&["--slice", "w=1,w=2"], &["--slice: w is named twice", "once"]);
    refused(&["--slice", "w=1,x=0,w=1"], &["--slice: w is named twice"]);
    refused(&["--turn", "xw=1,xw=2"], &["--turn: the plane xw is named twice"]);
    refused(&["--turn", "xw=1,wx=2"], &["--turn: the plane wx is named twice"]);
    let folder = folder("twice");
    let film = folder.join("twice.gif");
    for (option, list) in [("--slice-to", "w=1,w=2"), ("--turn-to", "xw=1,wx=2")] {
        let output = hyperbody(&["render", "dice4d", "-o", film.to_str().unwrap(), option, list]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(option) && error.contains("named twice"), "{error}");
    }
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
}

/// A folder that takes no files, from nobody.
#[cfg(target_os = "linux")]
#[test]
fn where_nothing_can_be_written_is_said_before_the_work() {
    for name in ["/proc/film.gif", "/proc/picture.png"] {
        let output = hyperbody(&["render", "dice4d", "--at", "3600", "-o", name]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(&format!("--output: {name}: cannot be written")), "{error}");
    }
}

#[test]
fn what_is_no_recording_is_said_and_makes_no_picture() {
    let folder = folder("foreign");
    let draw = |name: &str, bytes: &[u8], words: &[&str]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).unwrap();
        for output in ["foreign.png", "foreign.gif"] {
            let picture = folder.join(output);
            let arguments = ["render", path.to_str().unwrap(), "-o", picture.to_str().unwrap(), "--width", "64"];
            let output = hyperbody(&arguments);
            let error = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{error}");
            for word in words {
                assert!(error.contains(word), "{word:?} should be in {error}");
            }
            assert!(!picture.exists());
        }
        std::fs::remove_file(path).unwrap();
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0, "{name} leaves nothing behind");
    };
    let whole = folder.join("whole.hbrec");
    assert!(hyperbody(&["run", "bounce2d", "--steps", "90", "--record", whole.to_str().unwrap()]).status.success());
    let bytes = std::fs::read(&whole).unwrap();
    std::fs::remove_file(&whole).unwrap();
    draw("foreign.hbrec", b"\x89PNG\r\n\x1a\n and more", &["foreign.hbrec: is no recording", "--record FILE"]);
    draw("empty.hbrec", b"", &["empty.hbrec: is no recording"]);
    for share in [5, 2] {
        draw(
            "cut.hbrec",
            &bytes[..bytes.len() * (share - 1) / share],
            &["cut.hbrec: the recording is cut off at byte"],
        );
    }
    draw("begun.hbrec", &bytes[..4], &["begun.hbrec: the recording is cut off at byte 4"]);
    let mut newer = bytes;
    newer[8] = 7;
    draw("newer.hbrec", &newer, &["version 7", "reads version 1"]);
}

/// Draws into a file of this name, and gives what the program says of it.
fn report(folder: &Path, name: &str, arguments: &[&str]) -> Value {
    let file = folder.join(name);
    let small = ["--width", "96", "--height", "64", "--quality", "1", "--json", "-o", file.to_str().unwrap()];
    let output = hyperbody(&[&["render"], arguments, &small[..]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(file.is_file());
    serde_json::from_slice(&output.stdout).expect("one JSON object and nothing else")
}

/// The state hash of `hyperbody run`.
fn hash_after(scene: &str, steps: &str) -> Value {
    let output = hyperbody(&["run", scene, "--steps", steps, "--json"]);
    serde_json::from_slice::<Value>(&output.stdout).unwrap()["hash"].clone()
}

#[test]
fn a_report_says_what_was_drawn_and_from_where() {
    let folder = folder("reports");
    let still = report(&folder, "still.png", &["dice4d", "--at", "0.5"]);
    assert_eq!((&still["scene"], &still["dimension"], &still["pictures"]), (&"dice4d".into(), &4.into(), &1.into()));
    assert_eq!((&still["width"], &still["height"]), (&96.into(), &64.into()));
    assert_eq!(still["moments"], serde_json::json!([0.5, 0.5]));
    assert_eq!(still["hash"], hash_after("dice4d", "30"), "the state of a run of as many steps");
    // Half a second of pictures from 0.25 s on; the last one begins a twentieth before the end.
    let film = report(
        &folder,
        "film.gif",
        &["dice4d", "--at", "0.25", "--seconds", "0.5", "--frame-rate", "20", "--threads", "2"],
    );
    assert_eq!((&film["pictures"], &film["moments"]), (&10.into(), &serde_json::json!([0.25, 0.7])));
    assert_eq!(film["hash"], hash_after("dice4d", "42"), "0.7 s");
    let sheet = report(&folder, "sheet.png", &["dice4d", "--sheet", "t=0.5..0,3"]);
    assert_eq!((&sheet["width"], &sheet["height"]), (&(2 * 96 + 4).into(), &(2 * 64 + 4).into()));
    assert_eq!((&sheet["pictures"], &sheet["hash"]), (&3.into(), &still["hash"]));
    // The camera that was chosen can be asked for: the same picture comes out.
    let camera = &still["camera"];
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
    };
    let (eye, target) = (numbers(&camera["eye"]), numbers(&camera["look_at"]));
    let away: Vec<f64> = eye.iter().zip(&target).map(|(eye, target)| eye - target).collect();
    let length = away.iter().map(|part| part * part).sum::<f64>().sqrt();
    assert!((length - camera["distance"].as_f64().unwrap()).abs() < 1e-9 * length);
    assert!((camera["field_of_view_degrees"].as_f64().unwrap() - 0.6_f64.to_degrees()).abs() < 1e-9);
}

/// A film that is stopped half-way leaves neither itself nor what it was written into.
#[cfg(unix)]
#[test]
fn a_film_that_is_stopped_leaves_nothing_behind() {
    let folder = folder("stopped");
    let film = folder.join("stopped.apng");
    let names = || -> Vec<String> {
        let entries = std::fs::read_dir(&folder).unwrap();
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect()
    };
    for (signal, status) in [("INT", 130), ("TERM", 143), ("HUP", 129), ("QUIT", 131)] {
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_hyperbody"))
            .args(["render", "tumble4d", "--seconds", "60", "--width", "96", "-o", film.to_str().unwrap()])
            .spawn()
            .unwrap();
        let start = Instant::now();
        while !names().iter().any(|name| name.starts_with(".stopped.apng.") && name.ends_with(".part")) {
            assert!(start.elapsed() < Duration::from_secs(60), "the film is written aside: {:?}", names());
            std::thread::sleep(Duration::from_millis(5));
        }
        let sent = std::process::Command::new("kill").args([&format!("-{signal}"), &child.id().to_string()]).status();
        assert!(sent.unwrap().success());
        assert_eq!(child.wait().unwrap().code(), Some(status), "the status of what was stopped");
        assert_eq!(names(), Vec::<String>::new(), "after {signal}");
    }
}

/// What stops the program at a terminal leaves the shell a line of its own, below the bar.
#[cfg(target_os = "linux")]
#[test]
fn the_bar_ends_its_line_when_the_program_is_stopped() {
    let folder = folder("terminal");
    let [film, pid, seen] = ["film.apng", "pid", "seen"].map(|name| folder.join(name));
    let program = env!("CARGO_BIN_EXE_hyperbody");
    let render = format!("exec {program} render tumble4d --seconds 60 --width 96 -o {}", film.display());
    std::fs::write(folder.join("line.sh"), format!("echo $$ > {}\n{render}\n", pid.display())).unwrap();
    let line = format!("sh {}", folder.join("line.sh").display());
    // The program `script` of util-linux gives a terminal, and writes down what is shown on it.
    let child = std::process::Command::new("script")
        .args(["-qefc", &line, seen.to_str().unwrap()])
        .stdin(std::process::Stdio::null())
        .stdout(std::process::Stdio::null())
        .spawn();
    let Ok(mut child) = child else {
        eprintln!("there is no program `script`, and so no terminal");
        return;
    };
    let start = Instant::now();
    let shown = || String::from_utf8_lossy(&std::fs::read(&seen).unwrap_or_default()).into_owned();
    while !shown().contains("left") {
        assert!(start.elapsed() < Duration::from_secs(60), "the bar is shown: {}", shown());
        std::thread::sleep(Duration::from_millis(20));
    }
    let pid = std::fs::read_to_string(&pid).unwrap();
    assert!(std::process::Command::new("kill").args(["-INT", pid.trim()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let shown = shown();
    let bar = shown.rfind(" left").expect("it was shown");
    // The terminal makes two of it; the last line, which `script` adds, has one.
    assert!(shown[bar..].contains("\r\n"), "{:?}", &shown[bar..]);
}

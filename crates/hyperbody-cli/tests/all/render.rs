//! `hyperbody render`: what it writes, and what it refuses.

use std::path::{Path, PathBuf};

use crate::common::hyperbody;

fn place(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// Draws a small picture of a built-in scene and returns the bytes of the file.
fn draw(name: &str, arguments: &[&str]) -> Vec<u8> {
    let path = place(name);
    let path_text = path.to_str().expect("a path in UTF-8");
    let small = ["--output", path_text, "--at", "0.2", "--width", "96", "--height", "64", "--quality", "1"];
    let output = hyperbody(&[&["render"], arguments, &small].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stdout.is_empty() && output.stderr.is_empty(), "a picture needs no words");
    std::fs::read(path).expect("the picture is there")
}

#[test]
fn every_built_in_scene_has_a_picture() {
    for scene in hyperbody_scene::BUILT_IN {
        let bytes = draw(&format!("{}.png", scene.name), &[scene.name]);
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n", "{} is a PNG file", scene.name);
        assert_eq!((&bytes[16..20], &bytes[20..24]), (&96_u32.to_be_bytes()[..], &64_u32.to_be_bytes()[..]));
        assert!(bytes.len() > 2000, "{} has something to see", scene.name);
    }
}

#[test]
fn threads_change_nothing_and_views_change_the_picture() {
    let one = draw("one.png", &["dice4d", "--threads", "1"]);
    assert_eq!(one, draw("two.png", &["dice4d", "--threads", "2"]));
    let others: [&[&str]; 7] = [
        &["--slice", "w=0.4"],
        &["--turn", "xw=30"],
        &["--camera", "-80,10"],
        &["--look-at", "1,0,0"],
        &["--field-of-view", "60"],
        &["--no-strip"],
        &["--no-caption"],
    ];
    for (index, view) in others.iter().enumerate() {
        let other = draw(&format!("view{index}.png"), &[&["dice4d"], *view].concat());
        assert_ne!(one, other, "{view:?} changes the picture");
    }
}

#[test]
fn films_are_written_and_the_same_every_time() {
    let span: &[&str] =
        &["dice4d", "--seconds", "0.2", "--frame-rate", "20", "--slice", "w=-0.5", "--slice-to", "w=0.5"];
    let gif = draw("film.gif", span);
    assert_eq!(&gif[..6], b"GIF89a");
    // Each picture has a control block with its delay in hundredths of a second.
    let controls = gif.windows(6).filter(|bytes| bytes.starts_with(&[0x21, 0xf9, 4]) && bytes[4..] == [5, 0]).count();
    assert_eq!(controls, 4, "four pictures, 50 ms each");
    assert_eq!(gif, draw("again.gif", &[span, &["--threads", "1"]].concat()));
    let apng = draw("film.apng", span);
    assert_eq!(apng.windows(4).filter(|bytes| bytes == b"fcTL").count(), 4, "four pictures");
}

/// The command is refused with exit status 2, one line that holds the word, and no file.
fn refused(arguments: &[&str], word: &str) {
    let output = hyperbody(&[&["render"], arguments].concat());
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
    assert!(error.contains(word), "{arguments:?} should speak of {word:?}: {error}");
}

#[test]
fn what_makes_no_picture_is_refused_before_the_work() {
    let png = place("refused.png");
    let png = png.to_str().expect("a path in UTF-8");
    refused(&["dice4d", "-o", "dice.jpg"], ".png");
    refused(&["dice4d", "-o", "dice"], ".mp4");
    refused(&["dice4d", "-o", "dice.mp4", "--width", "641", "--height", "361"], "--width 640 --height 360");
    refused(&["dice4d", "-o", "dice.gif", "--frame-rate", "60", "--width", "64"], "50 at most");
    refused(&["dice4d", "-o", "dice.gif", "--speed", "-1"], "time stands still");
    refused(&["dice4d", "-o", "dice.gif", "--seconds", "1e6"], "3600");
    refused(&["dice4d", "-o", "dice.gif", "--frame-rate", "0"], "--frame-rate");
    refused(&["dice4d", "-o", "dice.gif", "--slice-to", "v=1"], "x y z w");
    refused(&["dice4d", "-o", "/no/such/folder/dice.png"], "/no/such/folder");
    refused(&["dice4d", "-o", env!("CARGO_TARGET_TMPDIR")], "png");
    refused(&["dyce4d", "-o", png], "dice4d");
    refused(&["dice4d", "-o", png, "--at", "-1"], "--at");
    refused(&["dice4d", "-o", png, "--at", "1e12"], "steps");
    refused(&["dice4d", "-o", png, "--width", "0"], "--width");
    refused(&["dice4d", "-o", png, "--height", "100000"], "--height");
    refused(&["dice4d", "-o", png, "--slice", "v=1"], "x y z w");
    refused(&["dice4d", "-o", png, "--slice", "w"], "NAME=NUMBER");
    refused(&["dice4d", "-o", png, "--slice", "w=inf"], "finite");
    refused(&["dice4d", "-o", png, "--turn", "xx=30"], "twice");
    refused(&["dice4d", "-o", png, "--turn", "x=30"], "plane");
    refused(&["dice4d", "-o", png, "--camera", "30"], "2 or 3");
    refused(&["dice4d", "-o", png, "--look-at", "1,2"], "3");
    refused(&["dice4d", "-o", png, "--camera", "30,10,0"], "--camera: the distance is 0 m");
    refused(&["dice4d", "-o", png, "--camera", "30,10,-2"], "--camera: the distance is -2 m");
    refused(&["dice4d", "-o", png, "--sheet", "w=0"], "NAME=FROM..TO,COUNT");
    refused(&["dice4d", "-o", png, "--sheet", "w=0..1,1"], "2 to 64");
    refused(&["dice4d", "-o", png, "--sheet", "v=0..1"], "the axes are x y z w, and t is the time");
    refused(&["dice4d", "-o", png, "--sheet", "xq=0..1"], "no axis \"q\"");
    refused(&["dice4d", "-o", png, "--sheet", "t=-1..1"], "time begins at 0");
    refused(&["dice4d", "-o", png, "--field-of-view", "179"], "150");
    assert!(!Path::new(png).exists(), "nothing is left behind");
}

#[test]
fn options_that_would_do_nothing_are_refused() {
    let png = place("mixed.png");
    let png = png.to_str().expect("a path in UTF-8");
    for option in
        [["--seconds", "1"], ["--frame-rate", "10"], ["--speed", "0.5"], ["--slice-to", "w=1"], ["--turn-to", "xw=90"]]
    {
        refused(&[&["dice4d", "-o", png], &option[..]].concat(), &format!("{} is for films", option[0]));
        refused(&[&["dice4d", "-o", png, "--sheet", "w=0..1"], &option[..]].concat(), "is for films");
    }
    refused(&["dice4d", "-o", "dice.gif", "--sheet", "w=0..1"], "name a .png");
    refused(&["dice4d", "-o", png, "--columns", "3"], "--sheet");
    refused(&["dice4d", "-o", png, "--sheet", "t=0..1", "--at", "1"], "leave one of them out");
    assert!(!Path::new(png).exists(), "nothing is left behind");
}

/// Pixels across and down of a PNG.
fn size(png: &[u8]) -> (u32, u32) {
    let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    (number(16), number(20))
}

#[test]
fn sheets_hold_pictures_beside_each_other() {
    let draw_sheet = |name: &str, arguments: &[&str]| {
        let path = place(name);
        let small = ["--width", "96", "--height", "64", "--quality", "1", "-o", path.to_str().unwrap()];
        let output = hyperbody(&[&["render", "dice4d"], arguments, &small].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        std::fs::read(path).unwrap()
    };
    let places = draw_sheet("places.png", &["--sheet", "w=-1..1,5", "--at", "0.2"]);
    assert_eq!(size(&places), (3 * 96 + 2 * 4, 2 * 64 + 4), "three in a row");
    let row = draw_sheet("row.png", &["--sheet", "w=-1..1,5", "--at", "0.2", "--columns", "5"]);
    assert_eq!(size(&row), (5 * 96 + 4 * 4, 64));
    let turns = draw_sheet("turns.png", &["--sheet", "xw=0..90,2", "--at", "0.2"]);
    assert_eq!(size(&turns), (2 * 96 + 4, 64));
    let moments = draw_sheet("moments.png", &["--sheet", "t=0..0.5,4"]);
    assert_eq!(size(&moments), (2 * 96 + 4, 2 * 64 + 4));
    assert_ne!(moments, draw_sheet("reversed.png", &["--sheet", "t=0.5..0,4"]), "the order is that of the values");
}

#[test]
fn recordings_give_the_pictures_of_their_scene() {
    let path = place("render.hbrec");
    let recording = path.to_str().unwrap();
    let run = hyperbody(&["run", "ells4d", "--seconds", "0.5", "--record", recording]);
    assert!(run.status.success());
    let turned: &[&str] = &["--turn", "xw=20"];
    let live = draw("live.png", &[&["ells4d"], turned].concat());
    assert_eq!(live, draw("played.png", &[&[recording], turned].concat()), "the same picture to the last byte");
    let film: &[&str] = &["--seconds", "0.2", "--frame-rate", "20", "--turn-to", "xw=40"];
    let live = draw("live.gif", &[&["ells4d"], film].concat());
    assert_eq!(live, draw("played.gif", &[&[recording], film].concat()), "and the same film");
    refused(&[recording, "-o", "late.png", "--at", "2"], "goes from 0 s to 0.5 s, and 2 s is not in it");
    refused(&[recording, "-o", "late.gif", "--seconds", "4"], "is not in it");
    // What is not said is taken from what there is: the last moment, and a film of all of it.
    let last = place("last.png");
    let small = ["--width", "32", "-o", last.to_str().unwrap()];
    assert!(hyperbody(&[&["render", recording], &small[..]].concat()).status.success());
    let bytes = std::fs::read(&path).unwrap();
    let half = place("half-render.hbrec");
    std::fs::write(&half, &bytes[..bytes.len() / 2]).unwrap();
    refused(&[half.to_str().unwrap(), "-o", "half.png"], "half-render.hbrec: the recording is cut off");
    // A block that is damaged beside the frames that are asked for is found by `inspect`, and by what needs it.
    let mut damaged = bytes;
    let place_in_frames = damaged.len() * 3 / 4;
    damaged[place_in_frames] ^= 1;
    std::fs::write(&half, &damaged).unwrap();
    refused(&[half.to_str().unwrap(), "-o", "half.gif"], "damaged at byte");
}

#[test]
fn a_film_in_which_time_stands_still_ends_as_its_slice_says() {
    // A slice that turns once around comes back to where it was.
    let around = draw(
        "around.apng",
        &["dice4d", "--seconds", "0.15", "--frame-rate", "20", "--speed", "0", "--turn-to", "xw=360", "--no-caption"],
    );
    let frames = chunks(&around, b"IDAT", b"fdAT");
    assert_eq!(frames.len(), 3);
    assert_eq!(frames[0], frames[2], "the last picture is the first");
    assert_ne!(frames[0], frames[1]);
}

/// The packed pictures of an APNG: chunks of the first kind, then of the second without their number.
fn chunks(png: &[u8], first: &[u8; 4], others: &[u8; 4]) -> Vec<Vec<u8>> {
    let mut pictures: Vec<Vec<u8>> = Vec::new();
    let mut at = 8;
    while at + 8 <= png.len() {
        let length = u32::from_be_bytes(png[at..at + 4].try_into().unwrap()) as usize;
        let (kind, data) = (&png[at + 4..at + 8], &png[at + 8..at + 8 + length]);
        match kind {
            b"fcTL" => pictures.push(Vec::new()),
            _ if kind == first => pictures.last_mut().unwrap().extend(data),
            _ if kind == others => pictures.last_mut().unwrap().extend(&data[4..]),
            _ => {}
        }
        at += length + 12;
    }
    pictures
}

/// The program with nothing but these folders on its PATH.
fn with_path(path: &str, arguments: &[&str]) -> std::process::Output {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_hyperbody"));
    command.args(arguments).env("PATH", path).output().expect("the program was built for this test")
}

const SHORT: [&str; 8] = ["--seconds", "0.1", "--frame-rate", "20", "--width", "64", "--height", "48"];

#[test]
fn without_ffmpeg_an_apng_is_written_beside() {
    let mp4 = place("beside.mp4");
    let output = with_path("", &[&["render", "dice4d", "-o", mp4.to_str().unwrap()], &SHORT[..]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("ffmpeg") && said.contains("beside.apng"), "{said}");
    assert!(!mp4.exists());
    assert_eq!(&std::fs::read(place("beside.apng")).unwrap()[..8], b"\x89PNG\r\n\x1a\n");
}

/// A folder with a program called ffmpeg: a script.
#[cfg(unix)]
fn fake_ffmpeg(name: &str, script: &str) -> String {
    use std::os::unix::fs::PermissionsExt;
    let folder = place(name);
    std::fs::create_dir_all(&folder).unwrap();
    let program = folder.join("ffmpeg");
    std::fs::write(&program, format!("#!/bin/sh\n[ \"$1\" = -version ] && exit 0\n{script}\n")).unwrap();
    std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).unwrap();
    format!("{}:/usr/bin:/bin", folder.display())
}

#[cfg(unix)]
#[test]
fn ffmpeg_is_given_every_picture() {
    // In place of an encoder: what it was told, and the pictures as they came, into the last argument.
    let path = fake_ffmpeg("takes", "for last; do :; done\necho \"$@\" > \"$last\"\ncat >> \"$last\"");
    let mp4 = place("film.mp4");
    let output = with_path(&path, &[&["render", "dice4d", "-o", mp4.to_str().unwrap()], &SHORT[..]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let bytes = std::fs::read(&mp4).unwrap();
    let end = bytes.iter().position(|&byte| byte == b'\n').unwrap();
    let told = String::from_utf8_lossy(&bytes[..end]).into_owned();
    for words in ["-video_size 64x48", "-framerate 20", "rgb24", "libx264", "yuv420p", "+faststart"] {
        assert!(told.contains(words), "{told}");
    }
    assert_eq!(bytes.len() - end - 1, 2 * 3 * 64 * 48, "two pictures");
}

#[cfg(unix)]
#[test]
fn what_ffmpeg_complains_of_is_passed_on_and_leaves_no_file() {
    let path =
        fake_ffmpeg("fails", "for last; do :; done\necho half > \"$last\"\necho 'Unknown encoder libx264' >&2\nexit 1");
    let folder = place("failed-film");
    std::fs::create_dir_all(&folder).unwrap();
    let mp4 = folder.join("film.mp4");
    let output = with_path(&path, &[&["render", "dice4d", "-o", mp4.to_str().unwrap()], &SHORT[..]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("film.mp4: cannot be written: ffmpeg: Unknown encoder libx264"), "{said}");
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0, "no half-written film");
}

/// A device that is always full stands for the disk.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_clear_error() {
    for name in ["full.png", "full.gif", "full.apng"] {
        let path = place(name);
        let _ = std::fs::remove_file(&path);
        std::os::unix::fs::symlink("/dev/full", &path).unwrap();
        let mut arguments = vec!["render", "dice4d", "-o", path.to_str().unwrap(), "--width", "96"];
        if !name.ends_with("png") || name.ends_with("apng") {
            arguments.extend(["--seconds", "0.1"]);
        }
        let output = hyperbody(&arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{name}: {said}");
        assert!(said.contains(name) && said.contains("cannot be written: No space left"), "{said}");
    }
}

/// Where files may not grow beyond so many blocks, what was there stays, and nothing is left beside it.
#[cfg(unix)]
#[test]
fn a_failed_film_leaves_the_old_one() {
    let folder = place("kept-film");
    std::fs::create_dir_all(&folder).unwrap();
    let gif = folder.join("kept.gif");
    std::fs::write(&gif, "old").unwrap();
    let program = env!("CARGO_BIN_EXE_hyperbody");
    let line = format!("trap '' XFSZ; ulimit -f 8; exec {program} render pit4d -o {} --seconds 0.4", gif.display());
    let output = std::process::Command::new("sh").args(["-c", &line]).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("kept.gif: cannot be written"), "{said}");
    assert_eq!(std::fs::read(&gif).unwrap(), b"old");
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1);
}

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
    refused(&["dice4d", "-o", "dice.mp4"], ".gif");
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
    refused(&["dice4d", "-o", png, "--camera", "30,10,0"], "camera");
    refused(&["dice4d", "-o", png, "--field-of-view", "179"], "150");
    assert!(!Path::new(png).exists(), "nothing is left behind");
}

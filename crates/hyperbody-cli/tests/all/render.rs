//! `hyperbody render`: what it writes, and what it refuses.

use std::path::{Path, PathBuf};

use crate::common::{file, hyperbody, json_of};

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

/// Pixels across and down of a PNG, and its bytes by rows.
fn decoded(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG file");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut pixels).expect("a whole picture");
    (info.width, info.height, pixels)
}

/// Every built-in scene against the same view of its floors and walls alone: an empty picture would be the same.
#[test]
fn every_built_in_scene_has_a_picture_of_its_bodies() {
    for built_in in hyperbody_scene::BUILT_IN {
        let name = built_in.name;
        let picture = place(&format!("{name}.png"));
        let moment = ["--at", "0.2", "--width", "96", "--height", "64", "--quality", "1", "--no-caption"];
        let report = json_of(&[&["render", name, "--json", "-o", picture.to_str().unwrap()], &moment[..]].concat());
        // From where it was seen, in the words of the options.
        let camera = &report["camera"];
        let numbers = |key: &str| [0, 1, 2].map(|axis: usize| camera[key][axis].as_f64().unwrap());
        let (eye, target) = (numbers("eye"), numbers("look_at"));
        let away = [0, 1, 2].map(|axis| eye[axis] - target[axis]);
        let distance = camera["distance"].as_f64().unwrap();
        let (around, above) = (away[0].atan2(away[2]).to_degrees(), (away[1] / distance).asin().to_degrees());
        let mut bare = hyperbody_scene::built_in(name).unwrap();
        bare.joints.clear();
        bare.bodies.retain(|body| matches!(body.shape, hyperbody_scene::ShapeSpec::HalfSpace { .. }));
        let scene = file(&format!("bare/{name}.json"), bare.to_json());
        let (camera, target) = (format!("{around},{above},{distance}"), target.map(|x| x.to_string()).join(","));
        let empty = place(&format!("bare/{name}.png"));
        let view = ["--camera", &camera, "--look-at", &target, "-o", empty.to_str().unwrap()];
        let output = hyperbody(&[&["render", scene.to_str().unwrap()], &moment[..], &view].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let [full, empty] = [picture, empty].map(|path| decoded(&std::fs::read(path).unwrap()));
        assert_eq!((full.0, full.1, empty.0, empty.1), (96, 64, 96, 64));
        let pixels = full.2.chunks_exact(3).zip(empty.2.chunks_exact(3));
        let differ = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 12);
        let seen = pixels.filter(differ).count();
        assert!(seen > 96 * 64 / 100, "{name}: {seen} pixels show a body");
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
    refused(&["dice4d", "-o", png, "--at", "1e9"], "steps");
    refused(&["dice4d", "-o", png, "--width", "0"], "--width");
    refused(&["dice4d", "-o", png, "--height", "100000"], "--height");
    refused(&["dice4d", "-o", png, "--slice", "v=1"], "x y z w");
    refused(&["dice4d", "-o", png, "--slice", "w"], "NAME=NUMBER");
    refused(&["dice4d", "-o", png, "--slice", "w=inf"], "inf is not a number from -1000000 to 1000000 m");
    refused(&["dice4d", "-o", png, "--turn", "xx=30"], "twice");
    refused(&["dice4d", "-o", png, "--turn", "x=30"], "plane");
    refused(&["dice4d", "-o", png, "--camera", "30"], "2 or 3");
    refused(&["dice4d", "-o", png, "--look-at", "1,2"], "3");
    refused(&["dice4d", "-o", png, "--camera", "30,10,0"], "0 is not a number from 0.001 to 1000000 m away");
    refused(&["dice4d", "-o", png, "--camera", "30,10,-2"], "-2 is not a number from 0.001");
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
    let whole = place("whole.gif");
    let film = ["--width", "32", "--frame-rate", "10", "--json", "-o", whole.to_str().unwrap()];
    assert_eq!(json_of(&[&["render", recording], &film[..]].concat())["moments"], serde_json::json!([0.0, 0.4]));
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

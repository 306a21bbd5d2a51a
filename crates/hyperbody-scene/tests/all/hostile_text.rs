//! Whatever stands in a file, reading it ends with a scene or with a message.

use hyperbody_scene::{AnyWorld, ErrorKind, Scene, built_in};

const SMALL: &str = r#"{
  "format": "hyperbody-scene", "version": 1, "name": "é", "dimension": 3,
  "materials": {"default": {"friction": 0.5}, "ice": {"friction": 1e-2}},
  "bodies": [
    {"name": "floor", "kind": "static", "shape": {"half_space": {"normal": [0, 1, 0], "offset": 0}}},
    {"name": "a", "shape": {"compound": {"parts": [{"shape": {"box": {"half_extents": [0.5, 0.5, 0.5]}}}]}}},
    {"shape": {"polytope": {"regular": "cube", "edge": 1}}, "rotation": [{"plane": "xy", "angle": -0.25}],
     "angular_velocity": {"xz": 1.5}, "material": "ice"}
  ],
  "joints": [{"ball": {"a": "a", "b": "floor", "anchor_a": [0, 1, 0]}}]
}"#;

/// Reads and builds; a panic fails the test.
fn try_to_build(text: &str) -> Result<(), String> {
    let scene = Scene::from_json(text).map_err(|error| error.to_string())?;
    AnyWorld::new(&scene, 1).map(drop).map_err(|error| error.to_string())
}

#[test]
fn every_truncation_is_refused() {
    try_to_build(SMALL).unwrap();
    for end in (0..SMALL.len()).filter(|&end| SMALL.is_char_boundary(end)) {
        let error = Scene::from_json(&SMALL[..end]).expect_err("a part of a scene is no scene");
        assert_eq!(error.kind(), ErrorKind::Syntax, "cut at byte {end}: {error}");
        assert!(error.place().starts_with("line ") && !error.to_string().contains('\n'), "cut at byte {end}: {error}");
    }
}

#[test]
fn no_changed_byte_makes_it_panic() {
    let mut refused = 0;
    for index in 0..SMALL.len() {
        for replacement in [b'"', b'{', b'}', b'[', b']', b',', b':', b'-', b'0', b'9', b'e', b'\0', b' '] {
            let mut bytes = SMALL.as_bytes().to_vec();
            bytes[index] = replacement;
            let Ok(text) = String::from_utf8(bytes) else { continue };
            if let Err(message) = try_to_build(&text) {
                assert!(!message.contains('\n'), "byte {index} to {replacement}: {message:?} has more than one line");
                refused += 1;
            }
        }
    }
    assert!(refused > 1000, "only {refused} changes were refused");
}

#[test]
fn cutting_out_any_word_does_not_make_it_panic() {
    let text = built_in("chain3d").unwrap().to_json();
    let words: Vec<(usize, &str)> = text
        .split_inclusive([' ', '\n'])
        .scan(0, |start, word| {
            *start += word.len();
            Some((*start - word.len(), word))
        })
        .collect();
    for (start, word) in words.into_iter().take(400) {
        let cut = format!("{}{}", &text[..start], &text[start + word.len()..]);
        if let Err(message) = try_to_build(&cut) {
            assert!(!message.contains('\n'), "without {word:?}: {message:?}");
        }
    }
}

#[test]
fn small_texts_cannot_claim_much_memory() {
    let many = format!("[{}0]", "0,".repeat(5_000_000));
    let error = Scene::from_json(&many).unwrap_err();
    assert!(error.to_string().contains("more than 5000000 values"), "{error}");
    let bodies = vec![r#"{"shape":{"ball":{"radius":1}}}"#; 100_001].join(",");
    let crowd = format!(r#"{{"format":"hyperbody-scene","version":1,"dimension":2,"bodies":[{bodies}]}}"#);
    let error = try_to_build(&crowd).unwrap_err();
    assert!(error.contains("bodies: has 100001 entries; a scene holds at most 100000"), "{error}");
}

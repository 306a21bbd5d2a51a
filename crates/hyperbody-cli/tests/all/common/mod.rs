//! Running the program and looking at what it says.

#![allow(dead_code, reason = "every test file uses a part of this")]

use std::path::PathBuf;
use std::process::{Command, Output};

/// The program, with its output captured.
pub(crate) fn hyperbody(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hyperbody")).args(arguments).output().expect("the program was built for this test")
}

/// What the program printed as one JSON object; it has to succeed and to say nothing else.
pub(crate) fn json_of(arguments: &[&str]) -> serde_json::Value {
    let output = hyperbody(arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?} failed: {error}");
    assert_eq!(error, "", "{arguments:?} wrote to standard error");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    assert_eq!(text.lines().count(), 1, "{arguments:?} prints one object on one line");
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{arguments:?} printed no JSON: {error}\n{text}"))
}

/// The keys of a JSON object, sorted.
pub(crate) fn keys(value: &serde_json::Value) -> Vec<&str> {
    let mut keys: Vec<&str> = value.as_object().expect("an object").keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

/// A file of its own for one test.
pub(crate) fn file(name: &str, content: impl AsRef<[u8]>) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("the folder for temporary files can be made");
    std::fs::write(&path, content).expect("the folder for temporary files can be written");
    path
}

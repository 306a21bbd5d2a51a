//! `hyperbody play`: what it serves, and how it refuses.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Stdio};

/// A folder with a small page, for one test.
fn site(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("play-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("assets")).expect("the test folder can be made");
    std::fs::write(folder.join("index.html"), "<!doctype html>").expect("it can be written");
    std::fs::write(folder.join("assets/engine-abc.wasm"), [0, 97, 115, 109]).expect("it can be written");
    folder
}

fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_hyperbody"))
}

/// A server that ends with the test.
struct Serving {
    child: Child,
    /// Kept open: a program whose reader has gone ends.
    _output: BufReader<ChildStdout>,
    port: u16,
    address: String,
}

impl Serving {
    fn start(site: &Path, arguments: &[&str]) -> Self {
        let mut command = program();
        command.args(["play", "--no-open", "--port", "0", "--site"]).arg(site).args(arguments);
        let mut child = command.stdout(Stdio::piped()).spawn().expect("the program starts");
        let mut line = String::new();
        let mut output = BufReader::new(child.stdout.take().expect("it is piped"));
        output.read_line(&mut line).expect("it prints its address");
        let address = line.trim().rsplit(' ').next().unwrap_or_default().to_owned();
        let port = address.split([':', '/']).find_map(|part| part.parse().ok());
        Self { child, _output: output, port: port.unwrap_or_else(|| panic!("no port in {line:?}")), address }
    }

    /// The head and the body of an answer.
    fn ask(&self, request: &str) -> (String, Vec<u8>) {
        self.ask_with(request, "")
    }

    /// The same with further lines in the head of the request.
    fn ask_with(&self, request: &str, lines: &str) -> (String, Vec<u8>) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("it listens");
        stream.set_read_timeout(Some(std::time::Duration::from_secs(20))).expect("a time limit can be set");
        write!(stream, "{request} HTTP/1.1\r\nHost: x\r\n{lines}Connection: close\r\n\r\n").expect("it reads");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("it answers");
        let end = answer.windows(4).position(|four| four == b"\r\n\r\n").expect("a head ends");
        (String::from_utf8_lossy(&answer[..end]).to_lowercase(), answer[end + 4..].to_vec())
    }
}

impl Drop for Serving {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn files_come_with_their_types_and_the_headers_that_shared_memory_needs() {
    let serving = Serving::start(&site("types"), &["stack4d"]);
    assert!(serving.address.ends_with("/?scene=stack4d"), "{}", serving.address);
    let (head, body) = serving.ask("GET /?scene=stack4d");
    assert!(head.starts_with("http/1.1 200") && head.contains("content-type: text/html"), "{head}");
    assert!(head.contains("cross-origin-opener-policy: same-origin"), "{head}");
    assert!(head.contains("cross-origin-embedder-policy: require-corp"), "{head}");
    assert!(head.contains("cache-control: no-cache"), "{head}");
    assert_eq!(body, b"<!doctype html>");
    let (head, body) = serving.ask("GET /assets/engine-abc.wasm");
    assert!(head.contains("content-type: application/wasm") && head.contains("immutable"), "{head}");
    assert_eq!(body, [0, 97, 115, 109]);
    for missing in ["GET /nothing.js", "GET /../Cargo.toml", "GET /assets/../../play.rs", "GET //etc/hostname"] {
        assert!(serving.ask(missing).0.starts_with("http/1.1 404"), "{missing}");
    }
    assert!(serving.ask("POST /").0.starts_with("http/1.1 405"));
}

#[test]
fn what_a_browser_has_already_is_not_sent_again() {
    let folder = site("tags");
    std::fs::write(folder.join("sw.js"), "addEventListener('fetch', () => {});").expect("it can be written");
    let serving = Serving::start(&folder, &[]);
    let tag_of = |head: &str| head.lines().find_map(|line| line.strip_prefix("etag: w/")).map(str::to_owned);
    let (head, _) = serving.ask("GET /");
    let tag = tag_of(&head).unwrap_or_else(|| panic!("no tag: {head}"));
    let ask_with = |tag: &str| serving.ask_with("GET /", &format!("If-None-Match: \"other\", W/{tag}\r\n"));
    let (head, body) = ask_with(&tag);
    assert!(head.starts_with("http/1.1 304") && body.is_empty(), "{head}");
    assert_eq!(tag_of(&head), Some(tag.clone()));
    // Its content is another one, and so is its tag.
    std::fs::write(folder.join("index.html"), "<!doctype html><p>").expect("it can be written");
    let (head, body) = ask_with(&tag);
    assert!(head.starts_with("http/1.1 200") && body == b"<!doctype html><p>", "{head}");
    assert_ne!(tag_of(&head), Some(tag));
    // The worker that keeps an exported page for later must not keep this one.
    let (head, body) = serving.ask("GET /sw.js");
    assert!(head.starts_with("http/1.1 200") && head.contains("content-type: text/javascript"), "{head}");
    assert!(String::from_utf8_lossy(&body).contains("unregister"), "{body:?}");
}

#[test]
fn a_scene_from_a_file_travels_in_the_link() {
    let folder = site("scene");
    let scene = folder.join("mine.json");
    let text = r#"{"format": "hyperbody-scene", "version": 1, "name": "Mine", "dimension": 4, "bodies": []}"#;
    std::fs::write(&scene, text).expect("it can be written");
    let serving = Serving::start(&folder, &[scene.to_str().expect("a plain path")]);
    let path = serving.address.rsplit('/').next().unwrap_or_default();
    let (head, _) = serving.ask(&format!("GET /{path}"));
    assert!(head.starts_with("http/1.1 302") && head.contains("location: /#scene="), "{head}");
}

#[test]
fn what_cannot_be_served_is_refused_with_the_remedy() {
    let refused = |arguments: &[&str]| {
        let output = program().arg("play").args(arguments).output().expect("the program runs");
        assert!(output.stdout.is_empty());
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let folder = site("refusals");
    let folder = folder.to_str().expect("a plain path");
    let (code, message) = refused(&["--no-open", "--site", folder, "stakc4d"]);
    assert!(code == Some(2) && message.contains("stack4d"), "{message}");
    let (code, message) = refused(&["--no-open", "--site", "no/such/folder"]);
    assert!(code == Some(2) && message.contains("index.html"), "{message}");
    let taken = TcpListener::bind("127.0.0.1:0").expect("some port is free");
    let port = taken.local_addr().expect("it has an address").port().to_string();
    let (code, message) = refused(&["--no-open", "--site", folder, "--port", &port]);
    assert!(code == Some(1) && message.contains("--port"), "{message}");
}

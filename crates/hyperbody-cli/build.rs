//! Takes the playground's page into the program: every file of web/dist, compressed once, here. Without that folder the
//! program is built all the same, and `hyperbody play` says how to get the page.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use flate2::Compression;
use flate2::write::GzEncoder;

fn main() -> io::Result<()> {
    let manifest = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").ok_or(io::ErrorKind::NotFound)?);
    let output = PathBuf::from(env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?);
    let site = manifest.join("../../web/dist");
    println!("cargo::rerun-if-changed=build.rs");
    let mut files = Vec::new();
    // A path that is not there would count as changed at every build; `cargo xtask play` touches this file when it comes.
    if site.join("index.html").is_file() {
        println!("cargo::rerun-if-changed={}", site.display());
        collect(&site, &site, &mut files)?;
        files.sort();
    }
    let mut code = String::from("pub(super) static FILES: &[File] = &[\n");
    for (index, (name, path)) in files.iter().enumerate() {
        let plain = fs::read(path)?;
        let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(&plain)?;
        let packed = encoder.finish()?;
        // Pictures are compressed already.
        let compressed = packed.len() * 10 < plain.len() * 9;
        let copy = output.join(format!("site-{index}"));
        fs::write(&copy, if compressed { &packed } else { &plain })?;
        writeln!(code, "File {{ name: {name:?}, compressed: {compressed}, bytes: include_bytes!({copy:?}) }},")
            .map_err(io::Error::other)?;
    }
    code.push_str("];\n");
    fs::write(output.join("site.rs"), code)
}

/// All files below a folder, by their addresses.
fn collect(root: &Path, folder: &Path, files: &mut Vec<(String, PathBuf)>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(root, &path, files)?;
        } else if let Ok(name) = path.strip_prefix(root) {
            let parts: Vec<String> = name.iter().map(|part| part.to_string_lossy().into_owned()).collect();
            files.push((parts.join("/"), path));
        }
    }
    Ok(())
}

//! `xtask-bindgen FILE.wasm FOLDER`: writes the wasm file and its JavaScript, for a page and its workers, into the folder.
//!
//! A program of its own, so that nothing else waits for the library to be compiled; `cargo xtask play` runs it.

use std::path::PathBuf;
use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [input, folder] = arguments.as_slice() else {
        eprintln!("usage: xtask-bindgen FILE.wasm FOLDER");
        return ExitCode::from(2);
    };
    let mut bindgen = Bindgen::new();
    let web = bindgen.input_path(input).typescript(true).remove_name_section(true).remove_producers_section(true);
    match web.web(true).and_then(|bindgen| bindgen.generate(folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask-bindgen: {}: {error:#}", input.display());
            ExitCode::FAILURE
        }
    }
}

//! `cargo xtask scenes`: docs/gallery.md, the list of the built-in scenes, made from the program itself.

use std::fmt::Write;
use std::process::Command;

use clap::Args;
use serde_json::Value;

use crate::Outcome;
use crate::process::{build_hyperbody, read, root};

const GALLERY: &str = "docs/gallery.md";

#[derive(Args)]
pub(crate) struct ScenesArguments {
    /// Only says whether the files are up to date
    #[arg(long)]
    check: bool,
}

pub(crate) fn run(arguments: &ScenesArguments) -> Outcome {
    if arguments.check {
        return check();
    }
    write()
}

/// Writes the generated files.
pub(crate) fn write() -> Outcome {
    let path = root().join(GALLERY);
    std::fs::write(&path, gallery()?).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    println!("{GALLERY} written");
    Ok(())
}

/// Whether the generated files are what would be generated now.
pub(crate) fn check() -> Outcome {
    let present = std::fs::read_to_string(root().join(GALLERY)).unwrap_or_default();
    if present.replace("\r\n", "\n") == gallery()? {
        Ok(())
    } else {
        Err(format!("{GALLERY} is out of date; `cargo xtask scenes` writes it"))
    }
}

fn gallery() -> Outcome<String> {
    let text = read(Command::new(build_hyperbody(true)?).args(["scenes", "--json"]))?;
    let answer: Value =
        serde_json::from_str(&text).map_err(|error| format!("`hyperbody scenes --json` printed no JSON: {error}"))?;
    let scenes = answer["scenes"].as_array().ok_or("`hyperbody scenes --json` has no list `scenes`")?;
    let mut page = String::from(
        "# The built-in scenes\n\n\
         Written by `cargo xtask scenes`; edit the builders in crates/hyperbody-scene/src/gallery instead.\n\
         Each runs with `hyperbody run NAME`, and `hyperbody scenes --write DIR` saves them all as files.\n\n\
         The pictures are drawn by `cargo xtask pictures`; from four dimensions on they show a slice.\n\n\
         | | name | dimension | bodies | what to see |\n|---|---|---|---|---|\n",
    );
    for scene in scenes {
        let field = |key: &str| scene[key].as_str().map_or_else(|| scene[key].to_string(), str::to_owned);
        writeln!(
            page,
            "| <img src=\"pictures/gallery/{0}.png\" width=\"240\" alt=\"\"> | `{0}` | {1} | {2} | {3} |",
            field("name"),
            field("dimension"),
            field("bodies"),
            field("description")
        )
        .expect("writing to a String cannot fail");
    }
    Ok(page)
}

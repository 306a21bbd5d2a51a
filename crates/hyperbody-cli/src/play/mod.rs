//! `hyperbody play`: serves the playground to a browser on this machine, or writes it as files for any web server.

mod link;
mod server;
mod site;

use std::fs;
use std::net::IpAddr;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::failure::Failure;
use crate::output::print;
use crate::source;
use site::Site;

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    hyperbody play                      opens the playground in a browser\n  \
    hyperbody play dice4d               with this scene\n  \
    hyperbody play my-scene.json        with a scene from a file\n  \
    hyperbody play --export site        writes it as files, which any web server can serve, and which need no net\n\n\
    Nothing leaves this machine: the page and the physics come from this program, and run in the browser.")]
pub(crate) struct PlayArguments {
    /// A scene file or the name of a built-in scene
    pub(crate) scene: Option<String>,
    /// Port to serve on; 0 for any that is free [default: 7474, or any that is free if that is taken]
    #[arg(long, value_name = "PORT")]
    pub(crate) port: Option<u16>,
    /// Address to serve on. Others than this machine's own let everybody in the network play along; browsers give VR and
    /// sensors to pages from this machine alone
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    pub(crate) host: IpAddr,
    /// Do not open a browser
    #[arg(long)]
    pub(crate) no_open: bool,
    /// Write the page as files into this folder, which is made if it is not there, and serve nothing
    #[arg(long, value_name = "DIR", conflicts_with_all = ["scene", "port", "no_open"])]
    pub(crate) export: Option<PathBuf>,
    /// Serve the page from this folder instead of the one in this program
    #[arg(long, value_name = "DIR")]
    pub(crate) site: Option<PathBuf>,
}

/// The port unless another is asked for.
const PORT: u16 = 7474;

/// The address that leads to the page with the scene from a file.
const SCENE: &str = "scene";

/// Longest link with a scene in it, bytes: what browsers take in one header.
const LONGEST_LINK: usize = 200_000;

pub(crate) fn play(arguments: &PlayArguments) -> Result<(), Failure> {
    let mut site = match &arguments.site {
        Some(folder) => Site::in_folder(folder)?,
        None => Site::built_in()?,
    };
    if let Some(folder) = &arguments.export {
        return export(&site, folder);
    }
    let path = match &arguments.scene {
        Some(scene) => with_scene(scene, &mut site)?,
        None => String::new(),
    };
    let server = server::Server::start(arguments.host, arguments.port, PORT)?;
    let address = format!("{}/{path}", server.address());
    print(format!("The playground is at {address}\nCtrl+C ends it."))?;
    if !arguments.no_open
        && let Err(error) = open::that_detached(&address)
    {
        eprintln!("note: no browser could be opened ({error}); open the address above yourself");
    }
    server.serve(&site)
}

/// The part of the address that asks for a scene. Scenes from files are checked first; the whole scene goes into a link, as
/// the page makes them for sharing, and a short address leads there.
fn with_scene(argument: &str, site: &mut Site) -> Result<String, Failure> {
    let scene = source::scene(argument)?;
    let Some(file) = &scene.file else { return Ok(format!("?scene={argument}")) };
    // What the scene means is checked where it is built.
    hyperbody_scene::AnyWorld::new(&scene, 1)?;
    let link = format!("/#scene={}", link::packed(&scene.to_json())?);
    if link.len() > LONGEST_LINK {
        let message = "is too large for a link; start the playground without it and drop the file onto the page";
        return Err(Failure::Input(format!("{}: {message}", file.display())));
    }
    site.lead(SCENE, link);
    Ok(SCENE.to_owned())
}

fn export(site: &Site, folder: &Path) -> Result<(), Failure> {
    let refuse =
        |path: &Path, error: std::io::Error| Failure::Work(format!("{}: cannot be written: {error}", path.display()));
    let files = site.files()?;
    for (name, bytes) in &files {
        let path = folder.join(name);
        let parent = path.parent().unwrap_or(folder);
        fs::create_dir_all(parent).map_err(|error| refuse(parent, error))?;
        fs::write(&path, bytes).map_err(|error| refuse(&path, error))?;
    }
    print(format!("{} files written to {}; any web server can serve them", files.len(), folder.display()))
}

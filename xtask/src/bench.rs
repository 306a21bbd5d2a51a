//! `cargo xtask bench`: figures of this commit on this machine, kept where the next ones can be compared with them.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

use clap::Args;
use serde_json::{Value, json};

use crate::Outcome;
use crate::process::{build_hyperbody, read, root, target_directory};

#[derive(Args)]
pub(crate) struct BenchArguments {
    /// Scene files or names of built-in scenes; all built-in scenes if none is given
    scenes: Vec<String>,
    /// Steps to run
    #[arg(long, default_value_t = 420)]
    steps: u32,
    /// How many of these, the first ones, to leave out of the figures
    #[arg(long, default_value_t = 120)]
    warmup: u32,
    /// Threads of the solver
    #[arg(long, default_value_t = 1)]
    threads: u32,
    /// An earlier file of figures: prints how many times longer each scene takes now
    #[arg(long, value_name = "FILE")]
    compare: Option<PathBuf>,
}

pub(crate) fn run(arguments: &BenchArguments) -> Outcome {
    let program = build_hyperbody(true)?;
    let (steps, warmup) = (arguments.steps.to_string(), arguments.warmup.to_string());
    let threads = arguments.threads.to_string();
    let mut command = Command::new(program);
    command.arg("bench").args(&arguments.scenes);
    command.args(["--steps", &steps, "--warmup", &warmup, "--threads", &threads, "--awake", "--json"]);
    let mut figures: Value = serde_json::from_str(&read(&mut command)?)
        .map_err(|error| format!("`hyperbody bench --json` printed no JSON: {error}"))?;
    let commit = commit();
    figures["commit"] = json!(commit);
    figures["machine"] = machine();

    let earlier = arguments.compare.as_deref().map(read_figures).transpose()?;
    print_table(&figures, earlier.as_ref());

    let directory = target_directory()?.join("bench");
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |elapsed| elapsed.as_secs());
    let path = directory.join(format!("{seconds}-{commit}.json"));
    std::fs::create_dir_all(&directory)
        .and_then(|()| std::fs::write(&path, format!("{figures:#}\n")))
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    println!("saved as {}", path.display());
    Ok(())
}

fn read_figures(path: &Path) -> Outcome<Value> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    serde_json::from_str(&text).map_err(|error| format!("{} holds no JSON: {error}", path.display()))
}

fn print_table(figures: &Value, earlier: Option<&Value>) {
    let scenes = |figures: &Value| figures["scenes"].as_array().cloned().unwrap_or_default();
    let before: Vec<Value> = earlier.map(scenes).unwrap_or_default();
    println!("{:24} {:>9} {:>9} {:>9}   now/then", "scene", "median ms", "p95 ms", "max ms");
    for scene in scenes(figures) {
        let milliseconds = |scene: &Value, key: &str| scene["step_ms"][key].as_f64().unwrap_or(f64::NAN);
        let ratio = before.iter().find(|then| then["name"] == scene["name"]).map_or_else(String::new, |then| {
            format!("{:8.2}", milliseconds(&scene, "median") / milliseconds(then, "median"))
        });
        println!(
            "{:24} {:9.3} {:9.3} {:9.3}   {ratio}",
            scene["name"].as_str().unwrap_or("?"),
            milliseconds(&scene, "median"),
            milliseconds(&scene, "p95"),
            milliseconds(&scene, "max")
        );
    }
}

/// The short name of the commit, with `-changed` after it where the tree differs from it.
fn commit() -> String {
    let git = |arguments: &[&str]| {
        let output = Command::new("git").current_dir(root()).args(arguments).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let Some(name) = git(&["rev-parse", "--short", "HEAD"]) else {
        return "unknown".to_owned();
    };
    let changed = git(&["status", "--porcelain"]).is_none_or(|lines| !lines.is_empty());
    if changed { format!("{name}-changed") } else { name }
}

/// What the figures depend on besides the commit.
fn machine() -> Value {
    let processor = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    let rustc = Command::new("rustc").arg("--version").output().ok();
    json!({
        "system": std::env::consts::OS,
        "architecture": std::env::consts::ARCH,
        "processor": processor,
        "logical_cores": std::thread::available_parallelism().map_or(1, usize::from),
        "rustc": rustc.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned()),
    })
}

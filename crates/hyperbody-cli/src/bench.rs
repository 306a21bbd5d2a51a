//! `hyperbody bench`: how long the steps of scenes take.

use std::sync::OnceLock;
use std::time::Instant;

use hyperbody_scene::{AnyWorld, BUILT_IN, Scene};
use serde::{Serialize, Serializer};

use crate::arguments::BenchArguments;
use crate::failure::Failure;
use crate::output::{number, print, print_json, table};
use crate::progress::Progress;
use crate::source;
use crate::step_times::{StepTimes, quantile_ms};

#[derive(Serialize)]
struct Report {
    scenes: Vec<Figures>,
}

#[derive(Serialize)]
struct Figures {
    name: String,
    dimension: usize,
    bodies: usize,
    threads: u16,
    /// Steps that were run, those left out of the figures included.
    steps: u32,
    warmup: u32,
    step_ms: StepTimes,
    /// Median over the steps, by stage.
    #[serde(serialize_with = "as_object")]
    stages_ms: Vec<(&'static str, f64)>,
    /// Over the whole run, warm-up included, m.
    max_penetration: f64,
    final_max_penetration: f64,
    hash: String,
}

pub(crate) fn bench(arguments: &BenchArguments) -> Result<(), Failure> {
    let warmup = arguments.warmup.unwrap_or(arguments.steps / 5);
    if warmup >= arguments.steps {
        return Err(Failure::Input(format!(
            "--warmup {warmup} leaves nothing of --steps {}; it has to be smaller",
            arguments.steps
        )));
    }
    // All scenes are read before the first is timed, so that a bad one is told of at once.
    let names = if arguments.scenes.is_empty() {
        BUILT_IN.iter().map(|scene| scene.name.to_owned()).collect()
    } else {
        arguments.scenes.clone()
    };
    let mut scenes = names.iter().map(|name| source::scene(name)).collect::<Result<Vec<Scene>, Failure>>()?;
    let mut report = Report { scenes: Vec::with_capacity(scenes.len()) };
    for scene in &mut scenes {
        scene.sleeping &= !arguments.awake;
        report.scenes.push(time(scene, arguments, warmup)?);
    }
    if arguments.json { print_json(&report) } else { print(as_text(&report)) }
}

fn as_object<S: Serializer>(pairs: &[(&'static str, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().copied())
}

/// Seconds since the first call.
fn clock() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

fn time(scene: &Scene, arguments: &BenchArguments, warmup: u32) -> Result<Figures, Failure> {
    let mut world = AnyWorld::new(scene, usize::from(arguments.threads))?;
    world.set_clock(Some(clock));
    let mut seconds = Vec::with_capacity((arguments.steps - warmup) as usize);
    let mut stages: Vec<(&'static str, Vec<f64>)> = Vec::new();
    let mut max_penetration: f64 = 0.0;
    let mut progress = Progress::new(&scene.name, u64::from(arguments.steps));
    for step in 0..arguments.steps {
        let start = Instant::now();
        world.step();
        let elapsed = start.elapsed().as_secs_f64();
        max_penetration = max_penetration.max(world.max_penetration());
        if step >= warmup {
            seconds.push(elapsed);
            for (index, (name, stage_seconds)) in world.timings().iter().enumerate() {
                if stages.len() == index {
                    stages.push((name, Vec::new()));
                }
                stages[index].1.push(stage_seconds);
            }
        }
        progress.advance();
    }
    drop(progress);
    let median = |(name, mut seconds): (&'static str, Vec<f64>)| {
        seconds.sort_unstable_by(f64::total_cmp);
        (name, quantile_ms(&seconds, 0.5))
    };
    let final_max_penetration = world.measure_penetration();
    Ok(Figures {
        name: scene.name.clone(),
        dimension: world.dimension(),
        bodies: scene.bodies.len(),
        threads: arguments.threads,
        steps: arguments.steps,
        warmup,
        step_ms: StepTimes::from_seconds(&mut seconds),
        stages_ms: stages.into_iter().map(median).collect(),
        max_penetration: max_penetration.max(final_max_penetration),
        final_max_penetration,
        hash: format!("{:016x}", world.state_hash()),
    })
}

fn as_text(report: &Report) -> String {
    let mut header = vec!["scene", "dim", "bodies", "median ms", "p95 ms", "max ms"];
    let stages = report.scenes.first().map_or(&[][..], |scene| &scene.stages_ms);
    let labels: Vec<String> = stages.iter().map(|(stage, _)| stage.replace('_', " ")).collect();
    header.extend(labels.iter().map(String::as_str));
    header.push("overlap m");
    let mut table = table(&header, 1);
    for scene in &report.scenes {
        let mut row = vec![scene.name.clone(), scene.dimension.to_string(), scene.bodies.to_string()];
        row.extend([scene.step_ms.median, scene.step_ms.p95, scene.step_ms.max].map(|ms| format!("{ms:.3}")));
        row.extend(scene.stages_ms.iter().map(|(_, ms)| format!("{ms:.3}")));
        row.push(number(scene.final_max_penetration));
        table.add_row(row);
    }
    table.to_string()
}

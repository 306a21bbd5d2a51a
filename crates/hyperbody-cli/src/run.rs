//! `hyperbody run`: a scene without a window.

mod record;

use std::time::Instant;

use hyperbody_scene::{AnyWorld, BodyState, Planes, Scene};
use serde::Serialize;

use crate::arguments::{MAX_STEPS, RunArguments};
use crate::failure::Failure;
use crate::files::Target;
use crate::output::{labelled, metres, number, numbers, print, print_json, table};
use crate::progress::Progress;
use crate::source;
use crate::step_times::StepTimes;
use record::{Record, RecordingReport};

/// Simulated seconds if nothing else is said.
const DEFAULT_SECONDS: f64 = 10.0;

/// Rows of the table of bodies.
const SHOWN_BODIES: usize = 20;

#[derive(Serialize)]
struct Report {
    scene: String,
    dimension: usize,
    steps: u32,
    dt: f64,
    seconds: f64,
    bodies: Vec<BodyState>,
    energy: EnergyReport,
    momentum: Vec<f64>,
    angular_momentum: Planes,
    contacts: Contacts,
    quarantined: Vec<String>,
    hash: String,
    step_ms: StepTimes,
    #[serde(skip_serializing_if = "Option::is_none")]
    recording: Option<RecordingReport>,
}

#[derive(Clone, Copy, Serialize)]
struct Energy {
    kinetic: f64,
    potential: f64,
    total: f64,
}

#[derive(Serialize)]
struct EnergyReport {
    #[serde(flatten)]
    now: Energy,
    initial: Energy,
}

#[derive(Serialize)]
struct Contacts {
    count: usize,
    max_penetration: f64,
    final_max_penetration: f64,
}

pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let mut scene = source::scene(&arguments.scene)?;
    if let Some(seed) = arguments.seed {
        scene.jitter(seed);
    }
    let mut world = AnyWorld::new(&scene, usize::from(arguments.threads))?;
    let steps = steps(arguments, &scene)?;
    let target = arguments.record.as_deref().map(|path| Target::anywhere("--record", path)).transpose()?;
    if let Some(target) = &target {
        target.refuse_inputs("--record", &source::files_of(&scene)?)?;
        source::refuse_to_replace_other("--record", target)?;
    }
    let mut record = target.as_ref().map(|target| Record::begin(target, &scene, arguments.record_every)).transpose()?;
    let mut report = simulate(&scene, &mut world, steps, record.as_mut())?;
    report.recording = record.map(|record| record.finish(&world)).transpose()?;
    if !report.quarantined.is_empty() {
        let names = report.quarantined.join(", ");
        eprintln!("warning: taken out of the simulation because their state is no longer finite: {names}");
    }
    if arguments.json { print_json(&report) } else { print(as_text(&report)) }
}

fn steps(arguments: &RunArguments, scene: &Scene) -> Result<u32, Failure> {
    if let Some(steps) = arguments.steps {
        return Ok(steps);
    }
    let seconds = arguments.seconds.unwrap_or(DEFAULT_SECONDS);
    let steps = (seconds / scene.dt).round();
    if steps > f64::from(MAX_STEPS) {
        return Err(Failure::Input(format!(
            "{seconds} s are {steps} steps of {} s; at most {MAX_STEPS} steps are simulated at once",
            scene.dt
        )));
    }
    Ok(steps as u32)
}

fn simulate(
    scene: &Scene,
    world: &mut AnyWorld,
    steps: u32,
    mut record: Option<&mut Record<'_>>,
) -> Result<Report, Failure> {
    let initial = energy(world);
    let mut seconds = Vec::with_capacity(steps as usize);
    let mut max_penetration: f64 = 0.0;
    let mut progress = Progress::new(&scene.name, u64::from(steps));
    if let Some(record) = &mut record {
        record.note(world)?;
    }
    for _ in 0..steps {
        let start = Instant::now();
        world.step();
        seconds.push(start.elapsed().as_secs_f64());
        max_penetration = max_penetration.max(world.max_penetration());
        if let Some(record) = &mut record {
            record.note(world)?;
        }
        progress.advance();
    }
    drop(progress);
    let final_max_penetration = world.measure_penetration();
    Ok(Report {
        scene: scene.name.clone(),
        dimension: world.dimension(),
        steps,
        dt: world.dt(),
        seconds: world.time(),
        bodies: world.body_states(),
        energy: EnergyReport { now: energy(world), initial },
        momentum: world.momentum(),
        angular_momentum: world.angular_momentum(),
        contacts: Contacts {
            count: world.contact_count(),
            max_penetration: max_penetration.max(final_max_penetration),
            final_max_penetration,
        },
        quarantined: world.quarantined().into_iter().map(str::to_owned).collect(),
        hash: format!("{:016x}", world.state_hash()),
        step_ms: StepTimes::from_seconds(&mut seconds),
        recording: None,
    })
}

fn energy(world: &AnyWorld) -> Energy {
    let energy = world.energy();
    Energy { kinetic: energy.kinetic, potential: energy.potential, total: energy.total() }
}

fn as_text(report: &Report) -> String {
    let mut bodies = table(&["body", "position (m)", "speed (m/s)", "spin (rad/s)", ""], 2);
    for body in report.bodies.iter().take(SHOWN_BODIES) {
        let position: Vec<String> = body.position.iter().copied().map(metres).collect();
        let length = |values: &mut dyn Iterator<Item = f64>| values.map(|value| value * value).sum::<f64>().sqrt();
        let state = if report.quarantined.contains(&body.name) {
            "quarantined"
        } else if body.sleeping {
            "asleep"
        } else {
            ""
        };
        bodies.add_row([
            body.name.clone(),
            position.join("  "),
            metres(length(&mut body.velocity.iter().copied())),
            metres(length(&mut body.angular_velocity.0.iter().map(|(_, rate)| *rate))),
            state.to_owned(),
        ]);
    }
    let more = report.bodies.len().saturating_sub(SHOWN_BODIES);
    let more = if more > 0 { format!("… and {more} more bodies (--json shows them all)\n") } else { String::new() };
    format!(
        "{}: {} dimensions, {} steps of {} s: {} s\n\n{bodies}\n{more}\n{}",
        report.scene,
        report.dimension,
        report.steps,
        number(report.dt),
        number(report.seconds),
        totals(report)
    )
}

fn totals(report: &Report) -> String {
    let energy = |energy: &Energy| {
        let parts = [energy.total, energy.kinetic, energy.potential].map(number);
        format!("{} J = {} kinetic + {} potential", parts[0], parts[1], parts[2])
    };
    let contacts = &report.contacts;
    let planes: Vec<String> =
        report.angular_momentum.0.iter().map(|(plane, value)| format!("{plane} {}", number(*value))).collect();
    let mut lines = vec![
        ("energy", energy(&report.energy.now)),
        ("at the start", energy(&report.energy.initial)),
        ("momentum", format!("{} kg m/s", numbers(&report.momentum))),
        ("angular momentum", format!("{} kg m²/s", planes.join(", "))),
        ("contacts", format!("{} points, at most {} m deep", contacts.count, number(contacts.final_max_penetration))),
        ("deepest overlap", format!("{} m in the whole run", number(contacts.max_penetration))),
    ];
    if !report.quarantined.is_empty() {
        lines.push(("quarantined", report.quarantined.join(", ")));
    }
    let ms = &report.step_ms;
    let [median, p95, max] = [ms.median, ms.p95, ms.max].map(|value| format!("{value:.3}"));
    lines.push(("time per step", format!("{median} ms median, {p95} ms p95, {max} ms at most")));
    lines.push(("state hash", report.hash.clone()));
    if let Some(recording) = &report.recording {
        let (frames, kilobytes) = (recording.frames, number((recording.bytes as f64 / 1e3).ceil()));
        lines.push(("recording", format!("{}: {frames} frames, {kilobytes} kB", recording.file)));
    }
    labelled(lines)
}

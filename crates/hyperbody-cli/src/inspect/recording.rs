//! What a recording holds, every block of it being read.

use hyperbody_scene::recording::{Frame, RECORDING_VERSION};
use serde::Serialize;

use crate::failure::Failure;
use crate::output::{labelled, number};
use crate::progress::Progress;
use crate::source::{Recording, recording_failure};

#[derive(Serialize)]
pub(super) struct Report {
    /// Of the recording's format.
    recording_version: u32,
    scene: String,
    description: String,
    dimension: usize,
    bodies: usize,
    joints: usize,
    dt: f64,
    frames: u64,
    /// Of the first and the last frame; null without frames.
    first: Option<Moment>,
    last: Option<Moment>,
    /// Names of the files that the scene needs and the recording carries.
    files: Vec<String>,
    /// Of the file, and what its poses take unpacked.
    bytes: u64,
    raw_bytes: u64,
}

#[derive(Serialize)]
struct Moment {
    step: u64,
    time: f64,
    sleeping: usize,
    quarantined: usize,
}

impl Moment {
    fn of(frame: &Frame) -> Self {
        let count = |holds: &dyn Fn(usize) -> bool| (0..frame.body_count()).filter(|&body| holds(body)).count();
        Self {
            step: frame.step,
            time: frame.time,
            sleeping: count(&|body| frame.is_sleeping(body)),
            quarantined: count(&|body| frame.is_quarantined(body)),
        }
    }
}

pub(super) fn report(mut recording: Recording, argument: &str) -> Result<Report, Failure> {
    let refuse = |error| recording_failure(argument, &error);
    let mut progress = Progress::new("checking", recording.frame_count());
    recording.verify(|frames| progress.reach(frames)).map_err(refuse)?;
    drop(progress);
    let frames = recording.frame_count();
    let first = recording.frame(0).map_err(refuse)?;
    let last = recording.frame(frames.saturating_sub(1)).map_err(refuse)?;
    let scene = recording.scene();
    Ok(Report {
        recording_version: RECORDING_VERSION,
        scene: scene.name.clone(),
        description: scene.description.clone(),
        dimension: scene.dimension,
        bodies: scene.bodies.len(),
        joints: scene.joints.len(),
        dt: scene.dt,
        frames,
        first: first.as_ref().map(Moment::of),
        last: last.as_ref().map(Moment::of),
        files: scene.files.keys().cloned().collect(),
        bytes: recording.byte_count(),
        raw_bytes: recording.raw_byte_count(),
    })
}

impl Report {
    pub(super) fn dimension(&self) -> usize {
        self.dimension
    }

    pub(super) fn as_text(&self) -> String {
        let mut text =
            format!("{}: a recording of {} dimensions, sound to the last byte\n", self.scene, self.dimension);
        if !self.description.is_empty() {
            text += &format!("{}\n", self.description);
        }
        let mut lines = vec![
            ("bodies", format!("{}, and {} joints", self.bodies, self.joints)),
            ("frames", self.frames.to_string()),
        ];
        for (label, moment) in [("from", &self.first), ("to", &self.last)] {
            if let Some(moment) = moment {
                let mut line = format!("{} s, step {}", number(moment.time), moment.step);
                if moment.sleeping > 0 {
                    line += &format!(", {} bodies asleep", moment.sleeping);
                }
                if moment.quarantined > 0 {
                    line += &format!(", {} quarantined", moment.quarantined);
                }
                lines.push((label, line));
            }
        }
        lines.push(("steps of", format!("{} s", number(self.dt))));
        if !self.files.is_empty() {
            lines.push(("files inside", self.files.join(", ")));
        }
        let ratio = self.raw_bytes as f64 / self.bytes as f64;
        lines.push(("size", format!("{} kB, poses packed {ratio:.1} to 1", number((self.bytes as f64 / 1e3).ceil()))));
        text + "\n" + &labelled(lines)
    }
}

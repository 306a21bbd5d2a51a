//! `hyperbody run --record`: the recording that is written beside the run.

use hyperbody_scene::recording::{RecordingError, RecordingErrorKind, RecordingWriter};
use hyperbody_scene::{AnyWorld, Scene};
use serde::Serialize;

use crate::failure::Failure;
use crate::files::{Aside, Target};

/// A recording in the making.
pub(super) struct Record<'a> {
    writer: RecordingWriter<Counted<Aside<'a>>>,
    target: &'a Target,
    every: u64,
    frames: u64,
    last_step: Option<u64>,
}

/// What the report says of a recording.
#[derive(Serialize)]
pub(super) struct RecordingReport {
    pub(super) file: String,
    pub(super) frames: u64,
    pub(super) bytes: u64,
}

/// Counts what is written.
struct Counted<W> {
    writer: W,
    bytes: u64,
}

impl<W: std::io::Write> std::io::Write for Counted<W> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let count = self.writer.write(bytes)?;
        self.bytes += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.writer.flush()
    }
}

impl<'a> Record<'a> {
    /// Begins a recording with every so manyth step.
    pub(super) fn begin(target: &'a Target, scene: &Scene, every: u32) -> Result<Self, Failure> {
        let writer = RecordingWriter::new(Counted { writer: target.open()?, bytes: 0 }, scene)
            .map_err(|error| failure(target, &error))?;
        Ok(Self { writer, target, every: u64::from(every), frames: 0, last_step: None })
    }

    /// Takes the world down, if it is its turn.
    pub(super) fn note(&mut self, world: &AnyWorld) -> Result<(), Failure> {
        if world.step_count().is_multiple_of(self.every) { self.add(world) } else { Ok(()) }
    }

    fn add(&mut self, world: &AnyWorld) -> Result<(), Failure> {
        self.writer.add_world(world).map_err(|error| failure(self.target, &error))?;
        self.frames += 1;
        self.last_step = Some(world.step_count());
        Ok(())
    }

    /// Takes the last step down, whether it is its turn or not, and gives the file its name.
    pub(super) fn finish(mut self, world: &AnyWorld) -> Result<RecordingReport, Failure> {
        if self.last_step != Some(world.step_count()) {
            self.add(world)?;
        }
        let counted = self.writer.finish().map_err(|error| failure(self.target, &error))?;
        counted.writer.finish()?;
        Ok(RecordingReport { file: self.target.display().to_string(), frames: self.frames, bytes: counted.bytes })
    }
}

fn failure(target: &Target, error: &RecordingError) -> Failure {
    match error.kind() {
        RecordingErrorKind::Io => target.unwritable(error),
        _ => Failure::Input(error.to_string()),
    }
}

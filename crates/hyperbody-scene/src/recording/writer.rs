//! Writing a recording while the simulation runs.

use std::io::Write;

use super::block;
use super::codec::{self, FULL_BYTES, Layout, MAX_FRAMES};
use super::index::{Entry, Index, MAX_INDEX_BYTES};
use super::reader::{MAX_CARRIED_BYTES, MAX_FILES};
use super::{Frame, MAGIC, RECORDING_VERSION, RecordingError, Result};
use crate::build::MAX_BODIES;
use crate::dimension::DIMENSIONS;
use crate::model::Scene;
use crate::read::MAX_FILE_BYTES;
use crate::world::AnyWorld;

/// A recording in the making. It holds one block of frames in memory and needs no seeking; without
/// [`RecordingWriter::finish`] the file is cut off, and readers say so.
pub struct RecordingWriter<W: Write> {
    writer: W,
    layout: Layout,
    /// Bytes written so far.
    length: u64,
    /// Of the block that is being filled.
    frames: Vec<Frame>,
    index: Index,
}

/// Refuses to write what readers refuse to read.
fn refuse_large(what: &str, count: u64, most: u64, unit: &str) -> Result<()> {
    if count <= most {
        return Ok(());
    }
    Err(RecordingError::content(format!("{what} {count} {unit}; a recording holds at most {most}")))
}

impl<W: Write> RecordingWriter<W> {
    /// Begins a recording of a scene, which has to be the one that the frames come from, shifts by a seed included. The
    /// files that it names are read and go into the recording.
    ///
    /// # Errors
    /// If the scene's dimension is not in 2..=6, it is larger than docs/recording-format.md allows, a file that it names cannot be read, or the writer fails.
    pub fn new(mut writer: W, scene: &Scene) -> Result<Self> {
        if !DIMENSIONS.contains(&scene.dimension) {
            let message = format!("a scene of {} dimensions cannot be recorded; there are 2 to 6", scene.dimension);
            return Err(RecordingError::content(message));
        }
        refuse_large("the scene has", scene.bodies.len() as u64, MAX_BODIES as u64, "bodies")?;
        let mut scene = scene.clone();
        scene.carry_files()?;
        let text = scene.to_json();
        refuse_large("the scene as text has", text.len() as u64, MAX_FILE_BYTES, "bytes")?;
        refuse_large("the scene names", scene.files.len() as u64, MAX_FILES as u64, "files")?;
        let carried = scene.files.values().map(|text| text.len() as u64).sum();
        refuse_large("the files that the scene names have", carried, MAX_CARRIED_BYTES, "bytes")?;
        writer.write_all(&MAGIC)?;
        writer.write_all(&RECORDING_VERSION.to_le_bytes())?;
        let mut length = MAGIC.len() as u64 + 4;
        length += block::write(&mut writer, block::SCENE, &block::pack(text.as_bytes()))?;
        for (name, text) in &scene.files {
            let name_length = u16::try_from(name.len())
                .map_err(|_| RecordingError::content(format!("the file name {name} is longer than 65535 bytes")))?;
            let mut payload = name_length.to_le_bytes().to_vec();
            payload.extend(name.as_bytes());
            payload.extend(block::pack(text.as_bytes()));
            length += block::write(&mut writer, block::FILE, &payload)?;
        }
        let layout = Layout { dimension: scene.dimension, bodies: scene.bodies.len() };
        Ok(Self { writer, layout, length, frames: Vec::new(), index: Index::default() })
    }

    /// Adds the world as it is now.
    ///
    /// # Errors
    /// As [`RecordingWriter::add`].
    pub fn add_world(&mut self, world: &AnyWorld) -> Result<()> {
        self.add(Frame::of(world))
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// If it has other bodies than the scene, its step does not come after the one before, its time or a pose is not finite,
    /// a place is out of bounds or a matrix no rotation, or the writer fails.
    pub fn add(&mut self, frame: Frame) -> Result<()> {
        if frame.body_count() != self.layout.bodies || frame.poses.len() != self.layout.numbers() {
            return Err(RecordingError::content(format!(
                "a frame of {} bodies and {} numbers does not fit a scene of {} bodies and {} numbers",
                frame.body_count(),
                frame.poses.len(),
                self.layout.bodies,
                self.layout.numbers()
            )));
        }
        if let Some(fault) = frame.fault(self.layout.dimension) {
            let message = format!("step {} cannot be recorded: {fault}", frame.step);
            return Err(RecordingError::content(message));
        }
        let before = self.frames.last().map(|frame| frame.step);
        let before = before.or_else(|| self.index.entries.last().map(|entry| entry.last_step));
        if let Some(before) = before.filter(|&before| before >= frame.step) {
            let message = format!("step {} was to be recorded after step {before}; frames go forward", frame.step);
            return Err(RecordingError::content(message));
        }
        self.frames.push(frame);
        let bytes = self.frames.len() * self.layout.frame_bytes();
        if self.frames.len() == MAX_FRAMES || bytes >= FULL_BYTES { self.write_frames() } else { Ok(()) }
    }

    fn write_frames(&mut self) -> Result<()> {
        let (Some(first), Some(last)) = (self.frames.first(), self.frames.last()) else { return Ok(()) };
        self.index.entries.push(Entry {
            offset: self.length,
            first_frame: self.index.frame_count,
            first_step: first.step,
            last_step: last.step,
        });
        self.index.frame_count += self.frames.len() as u64;
        let payload = codec::encode(&self.frames, self.layout);
        self.length += block::write(&mut self.writer, block::FRAMES, &payload)?;
        self.frames.clear();
        Ok(())
    }

    /// Writes what is left, the index and the end, and gives the writer back, flushed.
    ///
    /// # Errors
    /// If the recording is longer than its index can say, or the writer fails.
    pub fn finish(mut self) -> Result<W> {
        self.write_frames()?;
        let (index_offset, index) = (self.length, self.index.to_bytes());
        refuse_large("the index has", index.len() as u64, MAX_INDEX_BYTES, "bytes")?;
        block::write(&mut self.writer, block::INDEX, &index)?;
        block::write(&mut self.writer, block::END, &index_offset.to_le_bytes())?;
        self.writer.flush()?;
        Ok(self.writer)
    }
}

//! Reading a recording, from any frame.

use std::io::{Read, Seek, SeekFrom};

use super::block::{self, Block, Cursor};
use super::codec::{self, Layout};
use super::index::{Index, MAX_INDEX_BYTES};
use super::{Frame, MAGIC, RECORDING_VERSION, RecordingError, RecordingErrorKind, Result};
use crate::build::{MAX_BODIES, MAX_SHAPE_FILE_BYTES};
use crate::dimension::DIMENSIONS;
use crate::model::Scene;
use crate::read::MAX_FILE_BYTES;

/// Most files that a recording carries.
pub(super) const MAX_FILES: usize = 10_000;

/// Most bytes of all carried files together, unpacked.
pub(super) const MAX_CARRIED_BYTES: u64 = 256 << 20;

/// A recording that is open for reading. Opening reads the scene and the index; frames are read as they are asked for.
pub struct RecordingReader<R: Read + Seek> {
    reader: R,
    length: u64,
    scene: Scene,
    layout: Layout,
    /// Where the blocks of frames begin.
    first_offset: u64,
    index: Index,
    index_offset: u64,
    /// The block that was read last.
    cached: Option<(usize, Vec<Frame>)>,
}

impl<R: Read + Seek> RecordingReader<R> {
    /// Whether a file that begins with these bytes is a recording, of whatever version, or what is left of one.
    #[must_use]
    pub fn is_recording(first_bytes: &[u8]) -> bool {
        first_bytes.starts_with(&MAGIC[..6])
    }

    /// Opens a recording.
    ///
    /// # Errors
    /// If it cannot be read, is something else, of another version, cut off or damaged, or its scene makes no sense to this
    /// program.
    pub fn new(mut reader: R) -> Result<Self> {
        let length = reader.seek(SeekFrom::End(0))?;
        check_head(&mut reader, length)?;
        let (mut scene, mut offset) = read_scene(&mut reader, length)?;
        let layout = Layout { dimension: scene.dimension, bodies: scene.bodies.len() };
        let index_offset = find_index(&mut reader, offset, length)?;
        let index_block = Block::read(&mut reader, block::INDEX, MAX_INDEX_BYTES, index_offset, length)?;
        let index_block = index_block
            .filter(|block| block.end() + block::END_BYTES == length)
            .ok_or_else(|| RecordingError::damaged(index_offset, "the index is not where the end of the file says"))?;
        let index = Index::from_bytes(&index_block.payload, index_offset)?;
        offset = read_files(&mut reader, &mut scene, offset, length)?;
        if index.entries.first().map_or(index_offset, |entry| entry.offset) != offset {
            return Err(RecordingError::damaged(offset, "the first block of frames is not where the index says"));
        }
        Ok(Self { reader, length, scene, layout, first_offset: offset, index, index_offset, cached: None })
    }

    /// The scene, with the files that it names.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Number of frames.
    #[must_use]
    pub fn frame_count(&self) -> u64 {
        self.index.frame_count
    }

    /// Steps of the first and of the last frame; `None` without frames.
    #[must_use]
    pub fn steps(&self) -> Option<(u64, u64)> {
        let (first, last) = (self.index.entries.first()?, self.index.entries.last()?);
        Some((first.first_step, last.last_step))
    }

    /// Bytes of the file.
    #[must_use]
    pub fn byte_count(&self) -> u64 {
        self.length
    }

    /// Bytes that the poses would take unpacked.
    #[must_use]
    pub fn raw_byte_count(&self) -> u64 {
        self.index.frame_count.saturating_mul(self.layout.frame_bytes() as u64)
    }

    /// A frame by number, from 0; `None` beyond the last.
    ///
    /// # Errors
    /// If its block cannot be read or is damaged.
    pub fn frame(&mut self, number: u64) -> Result<Option<Frame>> {
        let Some(block) = self.index.block_of_frame(number) else { return Ok(None) };
        let first = self.index.entries[block].first_frame;
        Ok(self.block(block)?.get((number - first) as usize).cloned())
    }

    /// The frame of a step, or the nearest one, the earlier if two are; `None` without frames.
    ///
    /// # Errors
    /// As [`RecordingReader::frame`].
    pub fn nearest_to_step(&mut self, step: u64) -> Result<Option<Frame>> {
        let Some(block) = self.index.block_of_step(step) else { return Ok(None) };
        let frames = self.block(block)?;
        let after = frames.partition_point(|frame| frame.step < step);
        let mut candidates: Vec<Frame> = frames[after.saturating_sub(1)..].iter().take(2).cloned().collect();
        if after == frames.len() && block + 1 < self.index.entries.len() {
            candidates.extend(self.block(block + 1)?.first().cloned());
        }
        Ok(candidates.into_iter().min_by_key(|frame| (frame.step.abs_diff(step), frame.step)))
    }

    /// Reads every block, whether it is asked for or not, and calls `tell` with the number of frames that are sound so far.
    ///
    /// # Errors
    /// At the first thing that is wrong.
    pub fn verify(&mut self, mut tell: impl FnMut(u64)) -> Result<()> {
        let mut offset = self.first_offset;
        for number in 0..self.index.entries.len() {
            let entry = self.index.entries[number];
            if entry.offset != offset {
                return Err(RecordingError::damaged(offset, "a block of frames is not where the index says"));
            }
            (_, offset) = self.read_block(number)?;
            tell(entry.first_frame + self.index.frames_in(number));
        }
        if offset != self.index_offset {
            return Err(RecordingError::damaged(offset, "the index does not name what stands here"));
        }
        Ok(())
    }

    /// The frames of a block, from memory if it was the last one read.
    fn block(&mut self, number: usize) -> Result<&[Frame]> {
        if self.cached.as_ref().is_none_or(|(cached, _)| *cached != number) {
            let (frames, _) = self.read_block(number)?;
            self.cached = Some((number, frames));
        }
        Ok(self.cached.as_ref().map_or(&[], |(_, frames)| frames))
    }

    /// The frames of a block, and where the next one begins.
    fn read_block(&mut self, number: usize) -> Result<(Vec<Frame>, u64)> {
        let entry = self.index.entries[number];
        let refuse = |what: &str| Err(RecordingError::damaged(entry.offset, what));
        let most = block::most_packed(self.layout.most_block_bytes());
        let Some(block) = Block::read(&mut self.reader, block::FRAMES, most, entry.offset, self.length)? else {
            return refuse("a block of frames is not where the index says");
        };
        let frames = codec::decode(&block.payload, self.layout, entry.offset)?;
        let fits = frames.len() as u64 == self.index.frames_in(number)
            && frames.first().is_some_and(|frame| frame.step == entry.first_step)
            && frames.last().is_some_and(|frame| frame.step == entry.last_step)
            && frames.windows(2).all(|pair| pair[0].step < pair[1].step);
        if !fits {
            return refuse("the frames there are not those of the index");
        }
        let dimension = self.layout.dimension;
        if let Some((step, fault)) = frames.iter().find_map(|frame| Some((frame.step, frame.fault(dimension)?))) {
            return refuse(&format!("at step {step} {fault}"));
        }
        Ok((frames, block.end()))
    }
}

/// Magic and version.
fn check_head(reader: &mut (impl Read + Seek), length: u64) -> Result<()> {
    reader.seek(SeekFrom::Start(0))?;
    let mut head = Vec::new();
    reader.take(12).read_to_end(&mut head)?;
    if !head.starts_with(&MAGIC) {
        if length < MAGIC.len() as u64 && MAGIC.starts_with(&head) && !head.is_empty() {
            return Err(RecordingError::cut_off(length, "only the first bytes are there"));
        }
        let why = if head.starts_with(&MAGIC[..6]) {
            "is a recording that was changed as if it were text; transfer it as binary"
        } else {
            "is no recording; `hyperbody run SCENE --record FILE` makes one"
        };
        return Err(RecordingError::new(RecordingErrorKind::Foreign, why));
    }
    let Some(version) = head.get(8..12).and_then(|bytes| bytes.try_into().ok()).map(u32::from_le_bytes) else {
        return Err(RecordingError::cut_off(length, "the version is missing"));
    };
    if version != RECORDING_VERSION {
        let message = format!(
            "is a recording of version {version}, but this program reads version {RECORDING_VERSION} only; a newer \
             program may read it"
        );
        return Err(RecordingError::new(RecordingErrorKind::Version, message));
    }
    Ok(())
}

fn text_of(bytes: Vec<u8>, offset: u64) -> Result<String> {
    String::from_utf8(bytes).map_err(|_| RecordingError::damaged(offset, "the text there is not UTF-8"))
}

/// The scene, still without its files, and where the next block begins.
fn read_scene(reader: &mut (impl Read + Seek), length: u64) -> Result<(Scene, u64)> {
    let (start, most) = (MAGIC.len() as u64 + 4, block::most_packed(MAX_FILE_BYTES));
    let block = Block::read(reader, block::SCENE, most, start, length)?
        .ok_or_else(|| RecordingError::damaged(start, "the scene should stand here"))?;
    let bytes = block::unpack(&block.payload, MAX_FILE_BYTES as usize, block.offset)?;
    let scene = Scene::from_json(&text_of(bytes, block.offset)?)
        .map_err(|error| RecordingError::content(format!("the scene in the recording: {error}")))?;
    if !DIMENSIONS.contains(&scene.dimension) || scene.bodies.len() > MAX_BODIES {
        return Err(RecordingError::content(format!(
            "the scene in the recording has {} dimensions and {} bodies; there are 2 to 6 dimensions and at most \
             {MAX_BODIES} bodies",
            scene.dimension,
            scene.bodies.len()
        )));
    }
    let end = block.end();
    Ok((scene, end))
}

/// The files that the scene names, from byte `offset` on; gives where they end.
fn read_files(reader: &mut (impl Read + Seek), scene: &mut Scene, mut offset: u64, length: u64) -> Result<u64> {
    let mut left = MAX_CARRIED_BYTES;
    for _ in 0..=MAX_FILES {
        let most = 2 + u64::from(u16::MAX) + block::most_packed(MAX_SHAPE_FILE_BYTES);
        let Some(block) = Block::read(reader, block::FILE, most, offset, length)? else { return Ok(offset) };
        let mut cursor = Cursor::new(&block.payload, offset);
        let name_length = cursor.u16()?;
        let name = text_of(cursor.take(usize::from(name_length))?.to_vec(), offset)?;
        let most = left.min(MAX_SHAPE_FILE_BYTES) as usize;
        let text = text_of(block::unpack(cursor.rest(), most, offset)?, offset)?;
        left -= text.len() as u64;
        if let Some(twice) = scene.files.insert(name.clone(), text).map(|_| name) {
            return Err(RecordingError::damaged(offset, format!("the file {twice:?} is carried twice")));
        }
        offset = block.end();
    }
    Err(RecordingError::damaged(offset, format!("more than {MAX_FILES} files are carried along")))
}

/// Where the index is, from the last block; without that one, where the file stops making sense.
fn find_index(reader: &mut (impl Read + Seek), first_offset: u64, length: u64) -> Result<u64> {
    let end = length.checked_sub(block::END_BYTES).filter(|&end| end >= first_offset);
    if let Some(Ok(Some(block))) = end.map(|end| Block::read(reader, block::END, 8, end, length)) {
        let mut cursor = Cursor::new(&block.payload, block.offset);
        let offset = cursor.u64()?;
        if offset < first_offset || offset >= block.offset {
            return Err(RecordingError::damaged(block.offset, "the index cannot be where the end of the file says"));
        }
        return Ok(offset);
    }
    let mut offset = first_offset;
    // Every block has at least twelve bytes, so this ends.
    while offset < length {
        let (kind, end) = Block::pass(reader, offset, length)?;
        if kind == block::END && end < length {
            let more = length - end;
            return Err(RecordingError::damaged(end, format!("{more} bytes follow the end of the recording")));
        }
        offset = end;
    }
    Err(RecordingError::cut_off(length, "the index and the end are missing, as when a run was interrupted"))
}

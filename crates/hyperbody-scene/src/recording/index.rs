//! The index: which block holds which frames.

use super::block::Cursor;
use super::codec::MAX_FRAMES;
use super::{RecordingError, Result};

/// One block of frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Entry {
    /// Where the block begins.
    pub(super) offset: u64,
    /// Frames before it.
    pub(super) first_frame: u64,
    /// Steps of its first and of its last frame.
    pub(super) first_step: u64,
    pub(super) last_step: u64,
}

/// Most bytes of an index, for which a reader takes memory: two million blocks, 8 TiB of full ones.
pub(super) const MAX_INDEX_BYTES: u64 = 64 << 20;

/// All blocks of frames, and how many frames there are.
#[derive(Clone, Debug, Default)]
pub(super) struct Index {
    pub(super) entries: Vec<Entry>,
    pub(super) frame_count: u64,
}

impl Index {
    pub(super) fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = self.frame_count.to_le_bytes().to_vec();
        for entry in &self.entries {
            for number in [entry.offset, entry.first_frame, entry.first_step, entry.last_step] {
                bytes.extend(number.to_le_bytes());
            }
        }
        bytes
    }

    /// Reads the index that stands at byte `offset`, after all blocks of frames.
    pub(super) fn from_bytes(bytes: &[u8], offset: u64) -> Result<Self> {
        let mut cursor = Cursor::new(bytes, offset);
        let frame_count = cursor.u64()?;
        let mut entries = Vec::with_capacity(bytes.len() / 32);
        for _ in 0..(bytes.len().saturating_sub(8)) / 32 {
            entries.push(Entry {
                offset: cursor.u64()?,
                first_frame: cursor.u64()?,
                first_step: cursor.u64()?,
                last_step: cursor.u64()?,
            });
        }
        cursor.finish()?;
        let ascending =
            |a: &Entry, b: &Entry| a.offset < b.offset && a.first_frame < b.first_frame && a.last_step < b.first_step;
        let counted = entries.iter().map(|entry| entry.first_frame).skip(1).chain([frame_count]);
        let fits = |(entry, next): (&Entry, u64)| next.saturating_sub(entry.first_frame) <= MAX_FRAMES as u64;
        let sound = entries.iter().zip(counted).all(fits)
            && entries.windows(2).all(|pair| ascending(&pair[0], &pair[1]))
            && entries.iter().all(|entry| entry.first_step <= entry.last_step && entry.offset < offset)
            && entries.first().is_none_or(|entry| entry.first_frame == 0)
            && entries.last().map_or(frame_count == 0, |entry| entry.first_frame < frame_count);
        if !sound {
            return Err(RecordingError::damaged(offset, "the index contradicts itself"));
        }
        Ok(Self { entries, frame_count })
    }

    /// The block that holds a frame.
    pub(super) fn block_of_frame(&self, frame: u64) -> Option<usize> {
        (frame < self.frame_count).then(|| self.entries.partition_point(|entry| entry.first_frame <= frame) - 1)
    }

    /// The block with the step, or the last one that begins before it.
    pub(super) fn block_of_step(&self, step: u64) -> Option<usize> {
        (!self.entries.is_empty())
            .then(|| self.entries.partition_point(|entry| entry.first_step <= step).saturating_sub(1))
    }

    /// How many frames the block holds.
    pub(super) fn frames_in(&self, block: usize) -> u64 {
        let end = self.entries.get(block + 1).map_or(self.frame_count, |entry| entry.first_frame);
        end - self.entries[block].first_frame
    }
}

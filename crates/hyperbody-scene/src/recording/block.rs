//! Blocks: what a recording is made of. A kind of four letters, the length of the payload, the payload, and a checksum over
//! all three, so that a reader can skip what it does not know and sees every flipped bit.

use std::io::{Read, Seek, SeekFrom, Write};

use super::{RecordingError, Result};

/// The scene as text, packed.
pub(super) const SCENE: [u8; 4] = *b"SCEN";
/// A file that the scene names: length of the name (u16), the name, the text packed.
pub(super) const FILE: [u8; 4] = *b"FILE";
/// Frames: their number (u32), then packed.
pub(super) const FRAMES: [u8; 4] = *b"FRMS";
/// Where the blocks of frames are.
pub(super) const INDEX: [u8; 4] = *b"INDX";
/// The end: where the index is.
pub(super) const END: [u8; 4] = *b"DONE";

/// Bytes of a block besides its payload.
pub(super) const OVERHEAD: u64 = 12;

/// Bytes of the last block.
pub(super) const END_BYTES: u64 = OVERHEAD + 8;

/// How hard to pack, of 0..=10: beyond 6 frames shrink by less than a percent and take several times as long.
const EFFORT: u8 = 6;

/// Writes a block and returns its length.
pub(super) fn write(writer: &mut impl Write, kind: [u8; 4], payload: &[u8]) -> Result<u64> {
    let length = u32::try_from(payload.len())
        .map_err(|_| RecordingError::content("a block of the recording is larger than 4 GiB; split the scene"))?;
    writer.write_all(&kind)?;
    writer.write_all(&length.to_le_bytes())?;
    writer.write_all(payload)?;
    writer.write_all(&checksum(kind, payload).to_le_bytes())?;
    Ok(payload.len() as u64 + OVERHEAD)
}

/// CRC-32 (ISO 3309, as in PNG and zip) over kind, length and payload.
fn checksum(kind: [u8; 4], payload: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&kind);
    hasher.update(&(payload.len() as u32).to_le_bytes());
    hasher.update(payload);
    hasher.finalize()
}

/// A block that was read, its checksum being right.
pub(super) struct Block {
    pub(super) kind: [u8; 4],
    pub(super) payload: Vec<u8>,
    /// Where it begins.
    pub(super) offset: u64,
}

impl Block {
    /// Where the next one begins.
    pub(super) fn end(&self) -> u64 {
        self.offset + self.payload.len() as u64 + OVERHEAD
    }

    /// The block at `offset` in a file of `file_length` bytes.
    pub(super) fn read(reader: &mut (impl Read + Seek), offset: u64, file_length: u64) -> Result<Self> {
        let left = file_length.saturating_sub(offset);
        if left < OVERHEAD {
            return Err(RecordingError::cut_off(file_length, "a block is missing"));
        }
        reader.seek(SeekFrom::Start(offset))?;
        let mut head = [0; 8];
        reader.read_exact(&mut head)?;
        let [a, b, c, d, length @ ..] = head;
        let (kind, length) = ([a, b, c, d], u32::from_le_bytes(length));
        if !kind.iter().all(u8::is_ascii_uppercase) {
            return Err(RecordingError::damaged(offset, "no block begins here"));
        }
        if u64::from(length) > left - OVERHEAD {
            let name = String::from_utf8_lossy(&kind).into_owned();
            let what = format!("block {name} of {length} bytes began at byte {offset}");
            return Err(RecordingError::cut_off(file_length, what));
        }
        let mut payload = vec![0; length as usize];
        reader.read_exact(&mut payload)?;
        let mut sum = [0; 4];
        reader.read_exact(&mut sum)?;
        if u32::from_le_bytes(sum) != checksum(kind, &payload) {
            let name = String::from_utf8_lossy(&kind).into_owned();
            return Err(RecordingError::damaged(offset, format!("the checksum of block {name} does not fit")));
        }
        Ok(Self { kind, payload, offset })
    }
}

/// DEFLATE in a zlib frame (RFC 1950).
pub(super) fn pack(bytes: &[u8]) -> Vec<u8> {
    miniz_oxide::deflate::compress_to_vec_zlib(bytes, EFFORT)
}

/// What was packed, at most `limit` bytes of it.
pub(super) fn unpack(packed: &[u8], limit: usize, offset: u64) -> Result<Vec<u8>> {
    miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(packed, limit)
        .map_err(|error| RecordingError::damaged(offset, format!("what is packed there does not unpack ({error})")))
}

/// Takes numbers from the front of a payload.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    /// Of the block, for messages.
    offset: u64,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8], offset: u64) -> Self {
        Self { bytes, offset }
    }

    pub(super) fn take(&mut self, count: usize) -> Result<&'a [u8]> {
        let (front, rest) = self
            .bytes
            .split_at_checked(count)
            .ok_or_else(|| RecordingError::damaged(self.offset, "the block is shorter than what it announces"))?;
        self.bytes = rest;
        Ok(front)
    }

    fn array<const K: usize>(&mut self) -> Result<[u8; K]> {
        let mut array = [0; K];
        array.copy_from_slice(self.take(K)?);
        Ok(array)
    }

    pub(super) fn u16(&mut self) -> Result<u16> {
        self.array().map(u16::from_le_bytes)
    }

    pub(super) fn u32(&mut self) -> Result<u32> {
        self.array().map(u32::from_le_bytes)
    }

    pub(super) fn u64(&mut self) -> Result<u64> {
        self.array().map(u64::from_le_bytes)
    }

    pub(super) fn rest(self) -> &'a [u8] {
        self.bytes
    }

    /// Nothing may be left.
    pub(super) fn finish(self) -> Result<()> {
        if self.bytes.is_empty() {
            return Ok(());
        }
        Err(RecordingError::damaged(self.offset, format!("{} bytes too many in the block", self.bytes.len())))
    }
}

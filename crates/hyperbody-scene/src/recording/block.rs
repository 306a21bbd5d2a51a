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

/// Kind and length of a block, which nothing proves yet.
struct Head {
    kind: [u8; 4],
    length: u32,
}

impl Head {
    /// What stands at `offset` in a file of `file_length` bytes; the whole block lies in the file. The payload is next in the reader.
    fn read(reader: &mut (impl Read + Seek), offset: u64, file_length: u64) -> Result<Self> {
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
        let head = Self { kind, length };
        if u64::from(length) > left - OVERHEAD {
            let what = format!("block {} of {length} bytes began at byte {offset}", head.name());
            return Err(RecordingError::cut_off(file_length, what));
        }
        Ok(head)
    }

    fn name(&self) -> String {
        String::from_utf8_lossy(&self.kind).into_owned()
    }

    /// Whether the checksum that is next in the reader is the one of the block.
    fn check(&self, reader: &mut impl Read, expected: u32, offset: u64) -> Result<()> {
        let mut sum = [0; 4];
        reader.read_exact(&mut sum)?;
        if u32::from_le_bytes(sum) == expected {
            return Ok(());
        }
        Err(RecordingError::damaged(offset, format!("the checksum of block {} does not fit", self.name())))
    }
}

/// A block that was read, its checksum being right.
pub(super) struct Block {
    pub(super) payload: Vec<u8>,
    /// Where it begins.
    pub(super) offset: u64,
}

impl Block {
    /// Where the next one begins.
    pub(super) fn end(&self) -> u64 {
        self.offset + self.payload.len() as u64 + OVERHEAD
    }

    /// The block at `offset` in a file of `file_length` bytes, if it is of this kind. Kind and length are looked at before
    /// memory is taken for it: a payload of more than `most` bytes is refused.
    pub(super) fn read(
        reader: &mut (impl Read + Seek),
        kind: [u8; 4],
        most: u64,
        offset: u64,
        file_length: u64,
    ) -> Result<Option<Self>> {
        let head = Head::read(reader, offset, file_length)?;
        if head.kind != kind {
            return Ok(None);
        }
        if u64::from(head.length) > most {
            let what = format!("block {} has {} bytes, where {most} are the most", head.name(), head.length);
            return Err(RecordingError::damaged(offset, what));
        }
        let mut payload = vec![0; head.length as usize];
        reader.read_exact(&mut payload)?;
        head.check(reader, checksum(kind, &payload), offset)?;
        Ok(Some(Self { payload, offset }))
    }

    /// Goes over a block of any kind and length, checks it piece by piece, and gives its kind and where it ends.
    pub(super) fn pass(reader: &mut (impl Read + Seek), offset: u64, file_length: u64) -> Result<([u8; 4], u64)> {
        let head = Head::read(reader, offset, file_length)?;
        let mut hasher = crc32fast::Hasher::new();
        hasher.update(&head.kind);
        hasher.update(&head.length.to_le_bytes());
        let mut piece = [0; 1 << 14];
        let mut left = head.length as usize;
        while left > 0 {
            let next = &mut piece[..left.min(1 << 14)];
            reader.read_exact(next)?;
            hasher.update(next);
            left -= next.len();
        }
        head.check(reader, hasher.finalize(), offset)?;
        Ok((head.kind, offset + u64::from(head.length) + OVERHEAD))
    }
}

/// Most bytes that so many take packed: every packer can store what it cannot make smaller, at an eighth more for those that
/// know fixed codes alone.
pub(super) const fn most_packed(bytes: u64) -> u64 {
    bytes + bytes / 8 + 1024
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

//! Recordings: a simulation as a file, so that it is computed once and shown many times.
//!
//! A recording carries its scene, with every file that the scene names, and the poses of all bodies at each recorded step
//! as the very bits of the simulation. Frames come in blocks of at most a second or so. A block is packed against what the
//! last poses let expect, starts afresh, and has a checksum; an index at the end finds the block of a frame. So a
//! recording is written with bounded memory, any moment is read without what came before, and a file that is cut off,
//! damaged or something else is told from a sound one. docs/recording-format.md gives every byte.
//!
//! | module | holds |
//! |---|---|
//! | `block` | a kind, a length, a payload, a checksum |
//! | `frame` | [`Frame`]: the bodies at one step |
//! | `codec` | frames to bytes and back |
//! | `writer` | [`RecordingWriter`] |
//! | `reader` | [`RecordingReader`] |
//! | `error` | [`RecordingError`] |

mod block;
mod codec;
mod error;
mod frame;
mod index;
mod reader;
mod writer;

pub use error::{RecordingError, RecordingErrorKind};
pub use frame::Frame;
pub use reader::RecordingReader;
pub use writer::RecordingWriter;

/// The first bytes of a recording. As in PNG, the first is no ASCII, and the line ends show a transfer that took the file
/// for text.
pub const MAGIC: [u8; 8] = *b"\x89HBREC\r\n";

/// The version that this crate writes and reads.
pub const RECORDING_VERSION: u32 = 1;

pub(crate) type Result<T> = std::result::Result<T, RecordingError>;

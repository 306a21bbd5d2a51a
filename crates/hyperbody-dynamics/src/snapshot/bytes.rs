//! Snapshots as bytes: for save games, and for other machines and processes.
//!
//! # The form
//!
//! | offset | bytes | what |
//! |---|---|---|
//! | 0 | 8 | [`MAGIC`] |
//! | 8 | 4 | [`VERSION`] of the form |
//! | 12 | 4 | dimension N |
//! | 16 | 8 | length of the state |
//! | 24 | … | the state |
//! | end | 4 | CRC-32 (that of gzip) of everything before |
//!
//! Numbers are little-endian. The state holds what the future depends on, and nothing else: bodies with their shapes by
//! definition, joints, the tree of the broad phase, pairs with contacts and warm starts, islands, events. What follows from
//! it is made anew: convex pieces from shapes, rows of joints from definitions, lists of joints from joints. The same state is
//! always the same bytes.
//!
//! # What does not go along
//!
//! Functions: the contact hook and the clock are the world's and not the snapshot's, and have to be set in the world that a
//! snapshot is restored into, as must the number of threads. Shapes that several bodies share are stored once and shared again.
//!
//! # Trust
//!
//! Bytes may come from anywhere. Reading checks every number, link and count, so that whatever is read can be stepped:
//! what is refused is refused with its place and reason, nothing panics, and no more memory is asked for than a fixed multiple
//! of the bytes given. A checksum that is right proves nothing and is trusted with nothing. What cannot be checked is whether
//! a state is one that steps would lead to: bytes made up with care may hold bodies in each other, or masses that
//! do not fit their shapes.

use std::error::Error;
use std::fmt;

use hyperbody_geometry::bytes::{BytesError, Reader, Stored, Writer};
use hyperbody_math::Pose;

use super::Snapshot;

/// What the bytes of every snapshot begin with. The line ends show when a transfer has changed them.
pub const MAGIC: [u8; 8] = *b"HBSNAP\r\n";

/// Version of the form that is written. Readers take this one only: the state is that of the engine's inside, which changes.
pub const VERSION: u32 = 5;

/// Bytes before the state.
const HEADER: usize = 24;

/// Why bytes are no snapshot: the message gives place, value and remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SnapshotError {
    kind: SnapshotErrorKind,
    message: String,
}

/// The kinds of [`SnapshotError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SnapshotErrorKind {
    /// The bytes begin as no snapshot does.
    NotASnapshot,
    /// Written in another version of the form.
    OtherVersion,
    /// Of a world of another dimension.
    OtherDimension,
    /// The end is missing, or something follows it.
    WrongLength,
    /// The checksum says that bytes were changed.
    WrongChecksum,
    /// The state contradicts itself, or a number is out of its range.
    BadState,
}

impl SnapshotError {
    pub(super) fn new(kind: SnapshotErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
    }

    pub(super) fn bad_state(message: impl fmt::Display) -> Self {
        Self::new(SnapshotErrorKind::BadState, format!("the state of the snapshot cannot be: {message}"))
    }

    /// The kind, for programs.
    #[must_use]
    pub fn kind(&self) -> SnapshotErrorKind {
        self.kind
    }
}

impl fmt::Display for SnapshotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for SnapshotError {}

impl From<BytesError> for SnapshotError {
    fn from(error: BytesError) -> Self {
        Self::bad_state(error)
    }
}

/// What is stored of a collider; the rest follows from its body.
pub(super) struct Placed<const N: usize> {
    pub(super) world_from_collider: Pose<N>,
    pub(super) proxy: Option<u32>,
}

hyperbody_geometry::stored!(Placed<N> { world_from_collider, proxy });

/// The dimension of the world whose snapshot these bytes are, to know which [`Snapshot`] to read.
///
/// # Errors
/// If they do not begin as a snapshot of this version does.
pub fn dimension_of(bytes: &[u8]) -> Result<usize, SnapshotError> {
    if !bytes.starts_with(&MAGIC) {
        return Err(SnapshotError::new(
            SnapshotErrorKind::NotASnapshot,
            "these bytes are no snapshot: they do not begin with its magic number; give what Snapshot::to_bytes returned",
        ));
    }
    let word = |at: usize| {
        let four = bytes.get(at..at + 4).and_then(|four| four.try_into().ok());
        four.map(u32::from_le_bytes).ok_or_else(|| cut_off(bytes.len(), HEADER as u64))
    };
    let version = word(8)?;
    if version != VERSION {
        let remedy = if version > VERSION { "read it with a newer one" } else { "read it with the older one" };
        return Err(SnapshotError::new(
            SnapshotErrorKind::OtherVersion,
            format!("the snapshot has version {version}, and this engine reads version {VERSION} only; {remedy}"),
        ));
    }
    Ok(word(12)? as usize)
}

fn cut_off(there: usize, needed: u64) -> SnapshotError {
    SnapshotError::new(
        SnapshotErrorKind::WrongLength,
        format!("the snapshot has {there} bytes where it says {needed}: it was cut off, or something was added"),
    )
}

impl<const N: usize> Snapshot<N> {
    /// The snapshot as bytes, shapes included, from which [`Snapshot::from_bytes`] makes it anew, in another process or on
    /// another machine, to the last bit. The same state is always the same bytes. See the head of [this module](self) for the
    /// form and for what does not go along.
    ///
    /// A body pushed beyond all numbers since the last step makes bytes that are refused; a step puts it into quarantine.
    ///
    /// ```
    /// use hyperbody_dynamics::{BodyDef, Snapshot, World, WorldDef};
    /// use hyperbody_geometry::Shape;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut world = World::<4>::new(WorldDef::default())?;
    /// world.add_body(BodyDef::fixed(Shape::half_space([0.0, 1.0, 0.0, 0.0], 0.0)?))?;
    /// let tesseract = world.add_body(BodyDef::new(Shape::cuboid([0.5; 4])?).position([0.0, 2.0, 0.0, 0.0]))?;
    /// world.step();
    /// let saved: Vec<u8> = world.snapshot().to_bytes();
    ///
    /// let mut elsewhere = World::<4>::new(WorldDef::default())?;
    /// elsewhere.restore(&Snapshot::from_bytes(&saved)?);
    /// for _ in 0..60 {
    ///     world.step();
    ///     elsewhere.step();
    /// }
    /// assert_eq!(world.state_hash(), elsewhere.state_hash());
    /// assert!(elsewhere.body(tesseract).is_some(), "handles are good there, too");
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut state = Writer::new();
        self.write_state(&mut state);
        let state = state.into_bytes();
        let mut bytes = Vec::with_capacity(HEADER + state.len() + 4);
        bytes.extend_from_slice(&MAGIC);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(&(N as u32).to_le_bytes());
        bytes.extend_from_slice(&(state.len() as u64).to_le_bytes());
        bytes.extend_from_slice(&state);
        let checksum = crc32fast::hash(&bytes);
        bytes.extend_from_slice(&checksum.to_le_bytes());
        bytes
    }

    /// A snapshot from the bytes of [`Snapshot::to_bytes`]. The bytes may come from anywhere: see the head of
    /// [this module](self).
    ///
    /// # Errors
    /// If they are no snapshot of this version and dimension, incomplete, changed, or hold a state that cannot be.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SnapshotError> {
        let dimension = dimension_of(bytes)?;
        if dimension != N {
            return Err(SnapshotError::new(
                SnapshotErrorKind::OtherDimension,
                format!(
                    "the snapshot is of a world of {dimension} dimensions, and this one has {N}; read it as Snapshot<{dimension}>"
                ),
            ));
        }
        let header = bytes.get(16..HEADER).and_then(|eight| eight.try_into().ok());
        let length = u64::from_le_bytes(header.ok_or_else(|| cut_off(bytes.len(), HEADER as u64))?);
        let needed = length.saturating_add(HEADER as u64 + 4);
        if bytes.len() as u64 != needed {
            return Err(cut_off(bytes.len(), needed));
        }
        let (before, checksum) = bytes.split_at(bytes.len() - 4);
        if crc32fast::hash(before).to_le_bytes() != checksum {
            return Err(SnapshotError::new(
                SnapshotErrorKind::WrongChecksum,
                "the checksum of the snapshot is wrong: bytes were changed on the way; fetch it again",
            ));
        }
        let mut from = Reader::new(&before[HEADER..]);
        let snapshot = Self::read_state(&mut from)?;
        Ok(snapshot)
    }

    fn write_state(&self, out: &mut Writer) {
        self.gravity.write(out);
        (self.dt, (self.substeps, self.sleeping)).write(out);
        self.tuning.write(out);
        (self.step_count, (self.max_penetration, self.contact_count as u64)).write(out);
        self.bodies.write(out);
        self.joints.write(out);
        out.length(self.colliders.len());
        for collider in &self.colliders {
            let placed = collider
                .as_ref()
                .map(|collider| Placed { world_from_collider: collider.world_from_collider, proxy: collider.proxy });
            placed.write(out);
        }
        self.motions.write(out);
        self.free_colliders.write(out);
        self.tree.write(out);
        self.pairs.write(out);
        self.ignored.write(out);
        self.islands.write(out);
        self.events.write(out);
        self.quarantined.write(out);
        self.wake_requests.write(out);
    }

    fn read_state(from: &mut Reader<'_>) -> Result<Self, SnapshotError> {
        let gravity = Stored::read(from)?;
        let (dt, (substeps, sleeping)) = Stored::read(from)?;
        let tuning = Stored::read(from)?;
        let (step_count, (max_penetration, contact_count)): (u64, (f64, u64)) = Stored::read(from)?;
        let bodies = Stored::read(from)?;
        let joints = Stored::read(from)?;
        let placed: Vec<Option<Placed<N>>> = Stored::read(from)?;
        let mut snapshot = Self {
            gravity,
            dt,
            substeps,
            sleeping,
            tuning,
            bodies,
            joints,
            colliders: Vec::new(),
            motions: Stored::read(from)?,
            free_colliders: Stored::read(from)?,
            half_spaces: Vec::new(),
            tree: Stored::read(from)?,
            pairs: Stored::read(from)?,
            ignored: Stored::read(from)?,
            islands: Stored::read(from)?,
            events: Stored::read(from)?,
            step_count,
            max_penetration,
            contact_count: usize::try_from(contact_count).map_err(SnapshotError::bad_state)?,
            quarantined: Stored::read(from)?,
            wake_requests: Stored::read(from)?,
        };
        from.finish()?;
        snapshot.assemble(placed)?;
        snapshot.check()?;
        Ok(snapshot)
    }
}

//! Recordings that somebody made to do harm, with checksums that are right: an error, with little memory, and no panic.

use std::io::{Cursor, Read, Result as IoResult, Seek, SeekFrom};

use hyperbody_scene::recording::{Frame, MAGIC, RecordingErrorKind, RecordingReader, RecordingWriter};
use hyperbody_scene::{AnyWorld, MAX_BODIES, Scene, built_in};

/// A file of some bytes and long runs of zeros, which counts what is read of it.
struct Sparse {
    parts: Vec<(Vec<u8>, u64)>,
    place: u64,
    read: u64,
}

impl Sparse {
    fn length(&self) -> u64 {
        self.parts.iter().map(|(bytes, zeros)| bytes.len() as u64 + zeros).sum()
    }

    fn byte(&self, mut place: u64) -> u8 {
        for (bytes, zeros) in &self.parts {
            let length = bytes.len() as u64 + zeros;
            if place < length {
                return bytes.get(place as usize).copied().unwrap_or(0);
            }
            place -= length;
        }
        0
    }
}

impl Read for Sparse {
    fn read(&mut self, out: &mut [u8]) -> IoResult<usize> {
        let count = (out.len() as u64).min(self.length().saturating_sub(self.place)) as usize;
        assert!(self.read + (count as u64) < 1 << 20, "more than a megabyte is read of a block that is too large");
        for byte in &mut out[..count] {
            *byte = self.byte(self.place);
            self.place += 1;
        }
        self.read += count as u64;
        Ok(count)
    }
}

impl Seek for Sparse {
    fn seek(&mut self, to: SeekFrom) -> IoResult<u64> {
        self.place = match to {
            SeekFrom::Start(place) => place,
            SeekFrom::End(back) => self.length().saturating_add_signed(back),
            SeekFrom::Current(on) => self.place.saturating_add_signed(on),
        };
        Ok(self.place)
    }
}

/// A block with the checksum that belongs to it.
fn block(kind: &[u8; 4], payload: &[u8]) -> Vec<u8> {
    let mut bytes = kind.to_vec();
    bytes.extend((payload.len() as u32).to_le_bytes());
    bytes.extend(payload);
    let sum = crc32fast::hash(&bytes);
    bytes.extend(sum.to_le_bytes());
    bytes
}

fn packed(bytes: &[u8]) -> Vec<u8> {
    miniz_oxide::deflate::compress_to_vec_zlib(bytes, 6)
}

/// A disc in a plane: six numbers a frame.
const SCENE: &str = r#"{"format": "hyperbody-scene", "version": 1, "dimension": 2,
    "bodies": [{"shape": {"ball": {"radius": 1}}}]}"#;

/// Magic, version and the scene.
fn start() -> Vec<u8> {
    [&MAGIC[..], &1_u32.to_le_bytes(), &block(b"SCEN", &packed(SCENE.as_bytes()))].concat()
}

/// A block of one frame with this pose, by the rule in docs/recording-format.md: nothing is expected of a first frame.
fn one_frame(time: f64, pose: [f64; 6]) -> Vec<u8> {
    let mut raw = [7_u64.to_le_bytes(), time.to_le_bytes()].concat();
    raw.push(0);
    let distances = pose.map(|number| {
        let bits = number.to_bits() as i64;
        let rank = if bits < 0 { !(bits & i64::MAX) } else { bits };
        (rank << 1 ^ rank >> 63) as u64
    });
    for byte in (0..8).rev() {
        raw.extend(distances.map(|distance| (distance >> (8 * byte)) as u8));
    }
    block(b"FRMS", &[&1_u32.to_le_bytes()[..], &packed(&raw)].concat())
}

/// Index and end for these numbers, the index standing at `offset`.
fn ending(offset: u64, numbers: &[u64]) -> Vec<u8> {
    let index: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    [block(b"INDX", &index), block(b"DONE", &offset.to_le_bytes())].concat()
}

/// A recording of one frame.
fn recording_of(time: f64, pose: [f64; 6]) -> Vec<u8> {
    let (start, frame) = (start(), one_frame(time, pose));
    let (at, index) = (start.len() as u64, (start.len() + frame.len()) as u64);
    [start, frame, ending(index, &[1, at, 0, 7, 7])].concat()
}

/// What is said of it, opened and checked, or read at a frame.
fn complaints(bytes: &[u8]) -> [Option<String>; 2] {
    let open = || RecordingReader::new(Cursor::new(bytes));
    let checked = open().and_then(|mut recording| recording.verify(|_| ()));
    let read = open().and_then(|mut recording| recording.nearest_to_step(7).map(|_| ()));
    [checked, read].map(|result| {
        let error = result.err()?;
        assert_eq!(error.kind(), RecordingErrorKind::Damaged, "{error}");
        Some(error.to_string())
    })
}

#[test]
fn what_is_made_by_the_rules_is_read() {
    let pose = [1.5, -2.0, 0.0, -1.0, 1.0, 0.0];
    let bytes = recording_of(0.25, pose);
    assert_eq!(complaints(&bytes), [None, None]);
    let mut recording = RecordingReader::new(Cursor::new(&bytes[..])).unwrap();
    let frame = recording.frame(0).unwrap().unwrap();
    assert_eq!((frame.step, frame.time, &frame.poses[..]), (7, 0.25, &pose[..]));
    assert_eq!(recording.raw_byte_count(), 16 + 1 + 48);
}

#[test]
fn poses_that_no_simulation_has_are_refused_by_all_who_read() {
    let identity = [1.0, 0.0, 0.0, 1.0];
    let at = |place: [f64; 2], matrix: [f64; 4]| [place[0], place[1], matrix[0], matrix[1], matrix[2], matrix[3]];
    for (time, pose, words) in [
        (0.1, at([f64::NAN, 0.0], identity), "a number of the pose of body 0 is NaN"),
        (0.1, at([0.0, f64::NEG_INFINITY], identity), "is -inf, which is not finite"),
        (0.1, at([0.0, -1e300], identity), "body 0 is at a coordinate of -1e300 m; places lie within ±1e15 m"),
        (0.1, at([3e15, 0.0], identity), "places lie within"),
        (0.1, at([0.0, 0.0], [2.0, 0.0, 0.0, 2.0]), "the matrix of body 0 is no rotation"),
        (0.1, at([0.0, 0.0], [1.0, 0.0, 0.0, -1.0]), "the matrix of body 0 is no rotation"),
        (0.1, at([0.0, 0.0], [f64::MAX, 0.0, 0.0, f64::MAX]), "no rotation"),
        (f64::INFINITY, at([0.0, 0.0], identity), "the time is inf"),
    ] {
        for complaint in complaints(&recording_of(time, pose)) {
            let complaint = complaint.expect("it is refused");
            assert!(complaint.contains(words) && complaint.contains("step 7"), "{complaint}");
        }
    }
}

#[test]
fn an_index_cannot_promise_more_than_the_blocks_hold() {
    let (start, frame) = (start(), one_frame(0.0, [0.0, 0.0, 1.0, 0.0, 0.0, 1.0]));
    let (at, index) = (start.len() as u64, (start.len() + frame.len()) as u64);
    for frames in [0, 65, 1 << 40, u64::MAX] {
        let bytes = [&start[..], &frame, &ending(index, &[frames, at, 0, 7, 7])].concat();
        let [complaint, _] = complaints(&bytes);
        assert!(complaint.as_ref().is_some_and(|text| text.contains("the index contradicts itself")), "{complaint:?}");
    }
    let bytes = [&start[..], &frame, &ending(index, &[2, at, 0, 7, 7])].concat();
    assert!(complaints(&bytes)[0].as_ref().is_some_and(|text| text.contains("not those of the index")));
    // What stands between index and end is named by nothing.
    let stowaway = [&start[..], &frame, &block(b"INDX", &[1_u64, at, 0, 7, 7].map(u64::to_le_bytes).concat())].concat();
    let stowaway = [&stowaway[..], &block(b"XTRA", b"hidden"), &block(b"DONE", &index.to_le_bytes())].concat();
    assert!(complaints(&stowaway)[0].is_some());
}

/// Blocks of gigabytes are refused by their head, wherever they stand.
#[test]
fn no_memory_is_taken_for_blocks_that_are_too_large() {
    let gigabytes = |kind: &[u8; 4]| ([&kind[..], &3_000_000_000_u32.to_le_bytes()].concat(), 3_000_000_004);
    let refused = |parts: Vec<(Vec<u8>, u64)>, words: &str| {
        let file = Sparse { parts, place: 0, read: 0 };
        let error = RecordingReader::new(file).and_then(|mut recording| recording.verify(|_| ())).expect_err(words);
        assert_eq!(error.kind(), RecordingErrorKind::Damaged, "{error}");
        assert!(error.to_string().contains(words), "{error}");
    };
    let head = [&MAGIC[..], &1_u32.to_le_bytes()].concat();
    let join = |front: &[u8], (bytes, zeros): (Vec<u8>, u64)| ([front, &bytes].concat(), zeros);
    let (start, end) = (start(), |offset: u64| (block(b"DONE", &offset.to_le_bytes()), 0));
    refused(vec![join(&head, gigabytes(b"SCEN")), end(20)], "block SCEN has 3000000000 bytes");
    refused(vec![join(&head, gigabytes(b"FRMS")), end(20)], "the scene should stand here");
    let at = start.len() as u64;
    let after = at + 3_000_000_012;
    refused(vec![join(&start, gigabytes(b"INDX")), end(at)], "block INDX has 3000000000 bytes");
    let index = |numbers: &[u64]| (ending(after, numbers), 0);
    refused(vec![join(&start, gigabytes(b"FILE")), index(&[0])], "block FILE has 3000000000 bytes");
    refused(vec![join(&start, gigabytes(b"FRMS")), index(&[1, at, 0, 7, 7])], "block FRMS has 3000000000 bytes");
    refused(vec![join(&start, gigabytes(b"JUNK")), index(&[1, at, 0, 7, 7])], "not where the index says");
}

#[test]
fn a_small_block_that_unpacks_to_gigabytes_is_refused() {
    let bomb = packed(&vec![b' '; 80 << 20]);
    assert!(bomb.len() < 1 << 20);
    let bytes = [&MAGIC[..], &1_u32.to_le_bytes(), &block(b"SCEN", &bomb), &ending(0, &[0])].concat();
    assert!(complaints(&bytes)[0].as_ref().is_some_and(|text| text.contains("does not unpack")));
}

#[test]
fn the_writer_refuses_what_no_reader_takes() {
    let scene = built_in("cradle2d").unwrap();
    let sound = Frame::of(&AnyWorld::new(&scene, 1).unwrap());
    let mut writer = RecordingWriter::new(Vec::new(), &scene).unwrap();
    for (place, number, words) in [
        (0, f64::NAN, "NaN, which is not finite"),
        (7, f64::INFINITY, "body 1 is inf, which is not finite"),
        (1, 1e17, "body 0 is at a coordinate of 1e17 m; places lie within ±1e15 m"),
        (2, 5.0, "the matrix of body 0 is no rotation"),
    ] {
        let mut frame = sound.clone();
        frame.poses[place] = number;
        let error = writer.add(frame).expect_err(words);
        assert_eq!(error.kind(), RecordingErrorKind::Content);
        assert!(
            error.to_string().contains(words) && error.to_string().contains("step 0 cannot be recorded"),
            "{error}"
        );
    }
    assert!(writer.add(Frame { time: f64::NAN, ..sound.clone() }).is_err());
    writer.add(sound).expect("what was refused is not in the way");
    let mut crowd = Scene::from_json(SCENE).unwrap();
    crowd.bodies = vec![crowd.bodies[0].clone(); MAX_BODIES + 1];
    let error = RecordingWriter::new(Vec::new(), &crowd).err().expect("too many bodies").to_string();
    assert!(error.contains("the scene has 100001 bodies; a recording holds at most 100000"), "{error}");
}

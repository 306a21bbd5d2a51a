//! Recordings give back every bit of a run, and anything else is told from a recording.

use std::io::{self, Cursor, Write};

use hyperbody::math::{Dim, EvenAlgebra};
use hyperbody_scene::recording::{Frame, MAGIC, RecordingErrorKind, RecordingReader, RecordingWriter};
use hyperbody_scene::{AnyWorld, DimensionVisitor, Scene, built_in, visit_dimension};

/// A recording of every `every`-th of so many steps, and the frames as they were.
fn record(scene: &Scene, steps: u64, every: u64) -> (Vec<u8>, Vec<Frame>) {
    let mut world = AnyWorld::new(scene, 1).unwrap();
    let mut writer = RecordingWriter::new(Vec::new(), scene).unwrap();
    let mut frames = Vec::new();
    for step in 0..=steps {
        if step > 0 {
            world.step();
        }
        if step % every == 0 {
            frames.push(Frame::of(&world));
            writer.add_world(&world).unwrap();
        }
    }
    (writer.finish().unwrap(), frames)
}

fn open(bytes: &[u8]) -> RecordingReader<Cursor<&[u8]>> {
    RecordingReader::new(Cursor::new(bytes)).unwrap()
}

/// Opens and reads all of it; gives the first complaint.
fn complaint(bytes: &[u8]) -> Option<(RecordingErrorKind, String)> {
    let result = RecordingReader::new(Cursor::new(bytes)).and_then(|mut recording| recording.verify(|_| ()));
    result.err().map(|error| (error.kind(), error.to_string()))
}

fn assert_same_bits(read: &Frame, written: &Frame) {
    assert_eq!((read.step, read.time.to_bits()), (written.step, written.time.to_bits()));
    assert_eq!(read.flags, written.flags);
    let differs = read.poses.iter().zip(&written.poses).position(|(a, b)| a.to_bits() != b.to_bits());
    assert_eq!((differs, read.poses.len()), (None, written.poses.len()), "step {}", read.step);
}

#[test]
fn a_run_comes_back_to_the_bit_in_every_dimension() {
    for name in ["bounce2d", "chain3d", "dice4d", "clouds5d", "balls6d"] {
        let scene = built_in(name).unwrap();
        let (bytes, frames) = record(&scene, 150, 1);
        let mut recording = open(&bytes);
        assert_eq!(recording.scene(), &scene, "{name}");
        assert_eq!((recording.frame_count(), recording.steps()), (151, Some((0, 150))));
        // Backwards: no frame needs what stands before its block.
        for (number, frame) in frames.iter().enumerate().rev() {
            assert_same_bits(&recording.frame(number as u64).unwrap().unwrap(), frame);
        }
        assert_eq!(recording.frame(151).unwrap(), None);
        recording.verify(|_| ()).unwrap();
        assert!(
            (bytes.len() as u64) < recording.raw_byte_count() * 3 / 4,
            "{name} is packed to {} of {} bytes",
            bytes.len(),
            recording.raw_byte_count()
        );
    }
}

/// Poses of a frame as the world gives them.
struct SamePoses<'a>(&'a AnyWorld, &'a Frame);

impl DimensionVisitor for SamePoses<'_> {
    type Output = usize;

    fn visit<const N: usize>(self) -> usize
    where
        Dim<N>: EvenAlgebra,
    {
        let (world, handles) = (self.0.get::<N>().unwrap(), self.0.handles::<N>().unwrap());
        for (index, handle) in handles.iter().enumerate() {
            let body = world.body(*handle).unwrap();
            assert_eq!(self.1.pose::<N>(index), Some(body.pose()));
            assert_eq!(self.1.is_sleeping(index), body.is_sleeping());
        }
        assert_eq!(self.1.pose::<N>(handles.len()), None);
        handles.len()
    }
}

#[test]
fn frames_hold_the_poses_of_the_world_and_who_sleeps() {
    for name in ["pyramid2d", "ramp3d", "stack4d", "stack5d", "balls6d"] {
        let mut world = AnyWorld::new(&built_in(name).unwrap(), 1).unwrap();
        for _ in 0..200 {
            world.step();
        }
        let frame = Frame::of(&world);
        assert_eq!(visit_dimension(world.dimension(), SamePoses(&world, &frame)), Some(frame.body_count()));
        if name == "stack4d" {
            assert!((0..frame.body_count()).any(|body| frame.is_sleeping(body)), "a stack that stands is asleep");
        }
    }
}

#[test]
fn moments_are_found_between_the_recorded_steps() {
    let (bytes, frames) = record(&built_in("cradle2d").unwrap(), 600, 7);
    let mut recording = open(&bytes);
    for step in 0..=610 {
        let nearest = frames.iter().min_by_key(|frame| (frame.step.abs_diff(step), frame.step)).unwrap();
        assert_same_bits(&recording.nearest_to_step(step).unwrap().unwrap(), nearest);
    }
    let (empty, _) = record(&Scene::new("nothing moves", 4), 0, 1);
    assert_eq!(open(&empty).nearest_to_step(3).unwrap().map(|frame| frame.step), Some(0));
}

#[test]
fn a_file_that_ends_anywhere_is_cut_off() {
    let (bytes, _) = record(&built_in("cradle2d").unwrap(), 80, 1);
    assert_eq!(complaint(&bytes), None);
    for length in 1..bytes.len() {
        let (kind, message) = complaint(&bytes[..length]).expect("a part is not the whole");
        assert_eq!(kind, RecordingErrorKind::CutOff, "{length} of {} bytes: {message}", bytes.len());
        assert!(message.contains(&format!("at byte {length}")), "{length}: {message}");
    }
}

#[test]
fn every_flipped_bit_is_noticed() {
    let (bytes, _) = record(&built_in("cradle2d").unwrap(), 70, 10);
    for place in 0..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[place] ^= 1 << (place % 8);
        let (kind, message) = complaint(&damaged).unwrap_or_else(|| panic!("byte {place} was changed unnoticed"));
        let foreign = place < MAGIC.len() && kind == RecordingErrorKind::Foreign;
        let version = (8..12).contains(&place) && kind == RecordingErrorKind::Version;
        // A length that has grown reaches beyond the end of the file.
        let is_named = matches!(kind, RecordingErrorKind::Damaged | RecordingErrorKind::CutOff);
        assert!(foreign || version || (place >= 12 && is_named), "byte {place}: {kind:?}, {message}");
    }
    let mut longer = bytes.clone();
    longer.extend(b"more");
    assert!(complaint(&longer).unwrap().1.contains("4 bytes follow the end"));
}

#[test]
fn other_files_and_other_versions_are_refused() {
    for other in [&b""[..], b"{\"format\": \"hyperbody-scene\"}", b"\x89PNG\r\n\x1a\n", b"GIF89a", &[0; 100]] {
        let (kind, message) = complaint(other).expect("no recording");
        assert_eq!(kind, RecordingErrorKind::Foreign, "{message}");
        assert!(message.contains("--record"), "{message}");
    }
    let (bytes, _) = record(&built_in("cradle2d").unwrap(), 3, 1);
    let mut newer = bytes.clone();
    newer[8] = 2;
    assert_eq!(complaint(&newer).unwrap().0, RecordingErrorKind::Version);
    let as_text = String::from_utf8_lossy(&bytes[8..]).replace("\r\n", "\n").into_bytes();
    let (kind, message) = complaint(&[b"\x89HBREC\n".as_slice(), &as_text].concat()).unwrap();
    assert_eq!(kind, RecordingErrorKind::Foreign);
    assert!(message.contains("binary"), "{message}");
}

#[test]
fn files_that_the_scene_names_travel_along() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("carried");
    std::fs::create_dir_all(&folder).unwrap();
    let off = "4OFF\n5 10 10 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n\
        3 0 1 2\n3 0 1 3\n3 0 1 4\n3 0 2 3\n3 0 2 4\n3 0 3 4\n3 1 2 3\n3 1 2 4\n3 1 3 4\n3 2 3 4\n\
        4 0 1 3 6\n4 0 2 4 7\n4 1 2 5 8\n4 3 4 5 9\n4 6 7 8 9\n";
    std::fs::write(folder.join("cell.off"), off).unwrap();
    let text = r#"{"format": "hyperbody-scene", "version": 1, "dimension": 4, "bodies": [
        {"shape": {"compound": {"parts": [
            {"shape": {"rounded": {"shape": {"polytope": {"file": "cell.off"}}, "radius": 0.1}}},
            {"shape": {"ball": {"radius": 0.2}}, "position": [2, 0, 0, 0]}]}}, "angular_velocity": {"xw": 1}},
        {"shape": {"mesh": {"file": "cell.off"}}, "position": [9, 0, 0, 0]}]}"#;
    std::fs::write(folder.join("scene.json"), text).unwrap();
    let (bytes, frames) = record(&Scene::load(folder.join("scene.json")).unwrap(), 5, 1);
    std::fs::remove_dir_all(&folder).unwrap();
    let mut recording = open(&bytes);
    assert_eq!(recording.scene().files.get("cell.off").map(String::as_str), Some(off));
    let mut world = AnyWorld::new(recording.scene(), 1).expect("everything is inside");
    for frame in &frames {
        assert_same_bits(&Frame::of(&world), frame);
        assert_same_bits(&recording.nearest_to_step(frame.step).unwrap().unwrap(), frame);
        world.step();
    }
    let mut lost = Scene::from_json(text).unwrap();
    let error = lost.carry_files().expect_err("it lies in no folder").to_string();
    assert!(error.contains("bodies[0].shape.compound.parts[0].shape.rounded.shape.polytope.file"), "{error}");
}

/// A disk with so many bytes left.
struct SmallDisk(usize);

impl Write for SmallDisk {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = bytes.len().min(self.0);
        self.0 -= count;
        if count == 0 { Err(io::Error::from(io::ErrorKind::StorageFull)) } else { Ok(count) }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_wherever_it_comes() {
    let scene = built_in("cradle2d").unwrap();
    let (whole, _) = record(&scene, 70, 1);
    let try_with = |bytes: usize| {
        let mut world = AnyWorld::new(&scene, 1).unwrap();
        let mut writer = RecordingWriter::new(SmallDisk(bytes), &scene)?;
        for _ in 0..70 {
            writer.add_world(&world)?;
            world.step();
        }
        writer.add_world(&world)?;
        writer.finish().map(|_| ())
    };
    for bytes in (0..whole.len()).step_by(97) {
        assert_eq!(try_with(bytes).expect_err("too small").kind(), RecordingErrorKind::Io, "{bytes} bytes");
    }
    try_with(whole.len()).expect("just large enough");
}

#[test]
fn frames_have_to_fit_the_scene_and_go_forward() {
    let scene = built_in("cradle2d").unwrap();
    let world = AnyWorld::new(&scene, 1).unwrap();
    let mut writer = RecordingWriter::new(Vec::new(), &scene).unwrap();
    writer.add_world(&world).unwrap();
    assert_eq!(writer.add_world(&world).unwrap_err().kind(), RecordingErrorKind::Content);
    let other = AnyWorld::new(&built_in("bounce2d").unwrap(), 1).unwrap();
    assert_eq!(writer.add_world(&other).unwrap_err().kind(), RecordingErrorKind::Content);
    let mut five = Scene::new("five", 7);
    five.bodies.clear();
    assert!(RecordingWriter::new(Vec::new(), &five).is_err(), "there are no seven dimensions");
}

//! What `hyperbody render --json` says of a picture, film or sheet: what it shows, and from where.

use hyperbody_render::Camera;
use hyperbody_scene::recording::Frame;
use serde::Serialize;

use super::timeline::Timeline;
use crate::files::Target;

/// What was drawn.
#[derive(Serialize)]
pub(super) struct Report {
    file: String,
    /// Pixels across and down of the whole file.
    width: u32,
    height: u32,
    scene: String,
    dimension: usize,
    pictures: usize,
    /// The first and the last moment shown, s.
    moments: [f64; 2],
    /// Hash of the simulation's state at the last moment, as `hyperbody run` prints it; none for recordings, which hold poses
    /// alone.
    hash: Option<String>,
    /// Hash of all poses at the last moment: the same for a simulation and a recording of it.
    poses_hash: String,
    camera: CameraReport,
}

/// The camera, in the words of the options.
#[derive(Serialize)]
struct CameraReport {
    eye: [f64; 3],
    look_at: [f64; 3],
    /// Metres between the two.
    distance: f64,
    field_of_view_degrees: f64,
}

impl Report {
    /// A report on pictures at these moments, which ascend, the last of which shows this frame.
    pub(super) fn new(timeline: &Timeline, camera: &Camera, moments: &[f64], last: Option<&Frame>) -> Self {
        let end = |moment: Option<&f64>| moment.copied().unwrap_or(0.0);
        Self {
            file: String::new(),
            width: 0,
            height: 0,
            scene: timeline.name().to_owned(),
            dimension: timeline.dimension(),
            pictures: moments.len(),
            moments: [end(moments.first()), end(moments.last())],
            hash: timeline.state_hash().map(|hash| format!("{hash:016x}")),
            poses_hash: format!("{:016x}", poses_hash(last.map_or(&[], |frame| &frame.poses))),
            camera: CameraReport {
                eye: camera.eye.0,
                look_at: camera.target.0,
                distance: camera.eye.distance(camera.target),
                field_of_view_degrees: camera.field_of_view.to_degrees(),
            },
        }
    }

    /// The same, with the file that was written.
    pub(super) fn of(mut self, target: &Target, (width, height): (u32, u32)) -> Self {
        self.file = target.display().to_string();
        (self.width, self.height) = (width, height);
        self
    }
}

/// FNV-1a (G. Fowler, L. C. Noll and K.-P. Vo) over the bits of the numbers, lowest byte first.
fn poses_hash(poses: &[f64]) -> u64 {
    let bytes = poses.iter().flat_map(|number| number.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

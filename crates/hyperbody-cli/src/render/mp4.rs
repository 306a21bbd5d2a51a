//! MP4 by way of the program ffmpeg, which is given the pictures as they are drawn.

use std::io::{Read, Write};
use std::process::{ChildStdin, Command, ExitStatus, Stdio};
use std::thread::JoinHandle;

use hyperbody_render::Image;

use crate::failure::Failure;
use crate::files::Target;
use crate::stop;

/// Most that is kept of what ffmpeg complains of, bytes.
const MAX_COMPLAINT: u64 = 4096;

/// Whether there is an ffmpeg.
///
/// # Errors
/// If there is one that does not run: films then are not made otherwise in silence, for it can be mended.
pub(super) fn is_there() -> Result<bool, Failure> {
    let why = match Command::new("ffmpeg").arg("-version").stdin(Stdio::null()).output() {
        Ok(output) if output.status.success() => return Ok(true),
        Ok(output) => first_line(&output.stderr).unwrap_or_else(|| output.status.to_string()),
        Err(_) if !is_on_path() => return Ok(false),
        Err(error) => error.to_string(),
    };
    Err(Failure::Input(format!(
        "ffmpeg is there but does not run: {why}; mend it, or name a .gif or an .apng, which are made without it"
    )))
}

/// Whether a file of that name lies in a folder of the PATH: a folder that may not be read is no sign of one.
fn is_on_path() -> bool {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&folders).any(|folder| folder.join("ffmpeg").is_file())
}

/// The first line that says something.
fn first_line(bytes: &[u8]) -> Option<String> {
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(MAX_COMPLAINT as usize)]).into_owned();
    text.lines().map(str::trim).find(|line| !line.is_empty()).map(|line| line.chars().take(MOST_LETTERS).collect())
}

/// Most letters of a line of ffmpeg that a message repeats.
const MOST_LETTERS: usize = 200;

/// A film that ffmpeg is making.
pub(super) struct Mp4<'a> {
    target: &'a Target,
    pictures: Option<ChildStdin>,
    complaint: Option<JoinHandle<String>>,
    finished: bool,
}

impl<'a> Mp4<'a> {
    /// Starts ffmpeg. It writes aside, and the film gets its name at the end.
    pub(super) fn new(target: &'a Target, (width, height): (u32, u32), rate: u16) -> Result<Self, Failure> {
        let mut command = Command::new("ffmpeg");
        command.args(["-hide_banner", "-loglevel", "error", "-nostdin", "-xerror", "-y"]);
        command.args(["-f", "rawvideo", "-pixel_format", "rgb24"]);
        command.args(["-video_size", &format!("{width}x{height}"), "-framerate", &rate.to_string(), "-i", "pipe:0"]);
        // H.264 in 4:2:0 is what every player shows; the colours are said to be those of BT.709, and converted so.
        command.args(["-vf", "scale=out_color_matrix=bt709:out_range=tv", "-pix_fmt", "yuv420p"]);
        command.args([
            "-color_primaries",
            "bt709",
            "-color_trc",
            "bt709",
            "-colorspace",
            "bt709",
            "-color_range",
            "tv",
        ]);
        command.args(["-c:v", "libx264", "-preset", "slow", "-crf", "18", "-tune", "animation"]);
        // The table of contents comes first, so that a film plays while it is loaded.
        command.args(["-movflags", "+faststart", "-f", "mp4"]).arg(target.draft());
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        // Ctrl-C is for this program alone, which stops ffmpeg itself; otherwise ffmpeg's end would pass for a failure.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        target.begin();
        let (pictures, errors) =
            stop::start_helper(&mut command).map_err(|error| target.unwritable(&format!("ffmpeg: {error}")))?;
        let complaint = errors.map(|mut stderr| {
            std::thread::spawn(move || {
                let mut text = Vec::new();
                // The rest is read too, or ffmpeg would wait for a reader.
                let _ = stderr.by_ref().take(MAX_COMPLAINT).read_to_end(&mut text);
                let _ = std::io::copy(&mut stderr, &mut std::io::sink());
                String::from_utf8_lossy(&text).into_owned()
            })
        });
        Ok(Self { target, pictures, complaint, finished: false })
    }

    /// Adds the next picture.
    pub(super) fn add(&mut self, image: &Image) -> Result<(), Failure> {
        let written = self.pictures.as_mut().map(|pictures| pictures.write_all(image.bytes()));
        match written {
            Some(Ok(())) => Ok(()),
            // It closed the pipe: why, it says itself.
            _ => Err(self.failure()),
        }
    }

    /// Completes the film.
    pub(super) fn finish(mut self) -> Result<(), Failure> {
        drop(self.pictures.take());
        let status = stop::wait_for_helper();
        if status.as_ref().is_ok_and(ExitStatus::success) {
            self.finished = true;
            return self.target.publish_foreign("ffmpeg");
        }
        Err(self.told(status))
    }

    /// What ffmpeg says is wrong, once it has ended.
    fn failure(&mut self) -> Failure {
        drop(self.pictures.take());
        let status = stop::wait_for_helper();
        self.told(status)
    }

    /// What ffmpeg said, and else how it ended.
    fn told(&mut self, status: std::io::Result<ExitStatus>) -> Failure {
        let complaint = self.complaint.take().and_then(|thread| thread.join().ok()).unwrap_or_default();
        let lines: Vec<&str> = complaint.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
        let why = if lines.is_empty() {
            status.map_or_else(|error| error.to_string(), |status| status.to_string())
        } else {
            lines.join("; ")
        };
        self.target.unwritable(&format!("ffmpeg: {why}"))
    }
}

impl Drop for Mp4<'_> {
    fn drop(&mut self) {
        if !self.finished {
            drop(self.pictures.take());
            drop(stop::stop_helper());
            self.target.discard();
        }
    }
}

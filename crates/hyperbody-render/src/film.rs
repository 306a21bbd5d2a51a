//! Films: pictures one after the other, as GIF or as animated PNG, written as they come.

use std::io::Write;

use crate::error::RenderError;
use crate::image::Image;

/// How a film is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmFormat {
    /// Plays everywhere; 256 colours a picture, chosen for each, of which only what changed is stored.
    Gif,
    /// Plays in browsers; all colours, larger files.
    Apng,
}

/// A film in the making; it plays without end.
pub struct Film<W: Write> {
    encoder: Encoder<W>,
    width: u32,
    height: u32,
    /// The picture before, of which a GIF keeps what has not changed.
    last: Vec<u8>,
}

enum Encoder<W: Write> {
    Gif { encoder: Box<gif::Encoder<W>>, centiseconds: u16 },
    Apng(Box<png::Writer<W>>),
}

/// Pictures per second of a film.
pub const FRAME_RATES: std::ops::RangeInclusive<u16> = 1..=60;

/// Most pictures per second of a GIF: it counts in hundredths of a second, and players slow down below two.
pub const MAX_GIF_RATE: u16 = 50;

/// How much the colours of a GIF are searched for, 1 (most) to 30.
const SEARCH: i32 = 10;

impl<W: Write> Film<W> {
    /// Begins a film of `frames` pictures.
    ///
    /// # Errors
    /// If there is no picture, the rate is not in [`FRAME_RATES`], a side is longer than the format can store, or the
    /// writer fails.
    pub fn new(
        writer: W,
        format: FilmFormat,
        (width, height): (u32, u32),
        frames: u32,
        frames_per_second: u16,
    ) -> Result<Self, RenderError> {
        if frames == 0 {
            return Err(RenderError::new("a film has no pictures; make it longer than none"));
        }
        if !FRAME_RATES.contains(&frames_per_second) {
            let (low, high) = (FRAME_RATES.start(), FRAME_RATES.end());
            return Err(RenderError::new(format!(
                "a film has {frames_per_second} pictures a second; it must be between {low} and {high}"
            )));
        }
        let encoder = match format {
            FilmFormat::Gif => {
                if frames_per_second > MAX_GIF_RATE {
                    return Err(RenderError::new(format!(
                        "a GIF has {frames_per_second} pictures a second; it can have {MAX_GIF_RATE} at most"
                    )));
                }
                let side = |side: u32| {
                    u16::try_from(side).map_err(|_| {
                        RenderError::new(format!("{side} pixels are more than a GIF stores: {}", u16::MAX))
                    })
                };
                let mut encoder = gif::Encoder::new(writer, side(width)?, side(height)?, &[])?;
                encoder.set_repeat(gif::Repeat::Infinite)?;
                Encoder::Gif {
                    encoder: Box::new(encoder),
                    centiseconds: (100 + frames_per_second / 2) / frames_per_second,
                }
            }
            FilmFormat::Apng => {
                let mut encoder = png::Encoder::new(writer, width, height);
                encoder.set_color(png::ColorType::Rgb);
                encoder.set_depth(png::BitDepth::Eight);
                encoder.set_filter(png::Filter::Adaptive);
                encoder.set_animated(frames, 0)?;
                encoder.set_frame_delay(1, frames_per_second)?;
                Encoder::Apng(Box::new(encoder.write_header()?))
            }
        };
        Ok(Self { encoder, width, height, last: Vec::new() })
    }

    /// Adds the next picture.
    ///
    /// # Errors
    /// If it has another size than the film, or the writer fails.
    pub fn add(&mut self, image: &Image) -> Result<(), RenderError> {
        if (image.width(), image.height()) != (self.width, self.height) {
            return Err(RenderError::new(format!(
                "a picture of {} × {} pixels does not fit into a film of {} × {}",
                image.width(),
                image.height(),
                self.width,
                self.height
            )));
        }
        match &mut self.encoder {
            Encoder::Gif { encoder, centiseconds } => {
                let changed = Changed::between(&self.last, image);
                let mut frame = changed.frame(image, &self.last);
                frame.delay = *centiseconds;
                encoder.write_frame(&frame)?;
                self.last.clear();
                self.last.extend(image.bytes());
            }
            Encoder::Apng(writer) => writer.write_image_data(image.bytes())?,
        }
        Ok(())
    }

    /// Completes the film.
    ///
    /// # Errors
    /// If pictures are missing or the writer fails.
    pub fn finish(self) -> Result<(), RenderError> {
        match self.encoder {
            Encoder::Gif { encoder, .. } => {
                encoder.into_inner()?;
            }
            Encoder::Apng(writer) => writer.finish()?,
        }
        Ok(())
    }
}

/// The rectangle of a picture that differs from the one before.
struct Changed {
    left: usize,
    top: usize,
    width: usize,
    height: usize,
}

impl Changed {
    /// All of it if there was none before; one pixel if nothing differs, because a GIF has no smaller picture.
    fn between(last: &[u8], image: &Image) -> Self {
        let width = image.width() as usize;
        if last.is_empty() {
            return Self { left: 0, top: 0, width, height: image.height() as usize };
        }
        let (mut left, mut right, mut top, mut bottom) = (usize::MAX, 0, usize::MAX, 0);
        for (index, (old, new)) in last.chunks_exact(3).zip(image.bytes().chunks_exact(3)).enumerate() {
            if old != new {
                (left, right) = (left.min(index % width), right.max(index % width));
                (top, bottom) = (top.min(index / width), bottom.max(index / width));
            }
        }
        if left > right {
            return Self { left: 0, top: 0, width: 1, height: 1 };
        }
        Self { left, top, width: right - left + 1, height: bottom - top + 1 }
    }

    /// The rectangle, transparent where the picture before shows the same: long runs of one colour pack well, and the
    /// colours go to what moves.
    fn frame(&self, image: &Image, last: &[u8]) -> gif::Frame<'static> {
        let mut pixels = Vec::with_capacity(4 * self.width * self.height);
        for y in self.top..self.top + self.height {
            let start = 3 * (y * image.width() as usize + self.left);
            for place in (start..start + 3 * self.width).step_by(3) {
                let new = &image.bytes()[place..place + 3];
                match last.get(place..place + 3) {
                    Some(old) if old == new => pixels.extend([0; 4]),
                    _ => pixels.extend([new[0], new[1], new[2], 255]),
                }
            }
        }
        // Sides fit, as the whole picture does.
        let mut frame = gif::Frame::from_rgba_speed(self.width as u16, self.height as u16, &mut pixels, SEARCH);
        (frame.left, frame.top) = (self.left as u16, self.top as u16);
        frame.dispose = gif::DisposalMethod::Keep;
        frame
    }
}

//! Films: pictures one after the other, as GIF or as animated PNG, written as they come.

use std::io::Write;

use crate::error::RenderError;
use crate::image::Image;

/// How a film is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmFormat {
    /// Plays everywhere; 256 colours a picture, chosen for each.
    Gif,
    /// Plays in browsers; all colours, larger files.
    Apng,
}

/// A film in the making; it plays without end.
pub struct Film<W: Write> {
    encoder: Encoder<W>,
    width: u32,
    height: u32,
}

enum Encoder<W: Write> {
    Gif { encoder: Box<gif::Encoder<W>>, centiseconds: u16 },
    Apng(Box<png::Writer<W>>),
}

/// Pictures per second that both formats can count: GIF counts in hundredths of a second, and players slow down below two.
pub const FRAME_RATES: std::ops::RangeInclusive<u16> = 1..=50;

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
        Ok(Self { encoder, width, height })
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
                let (width, height) = (self.width as u16, self.height as u16);
                let mut frame = gif::Frame::from_rgb_speed(width, height, image.bytes(), SEARCH);
                frame.delay = *centiseconds;
                encoder.write_frame(&frame)?;
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

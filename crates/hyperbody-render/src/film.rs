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
    Gif {
        encoder: Box<gif::Encoder<W>>,
        frames_per_second: u16,
        /// Of the next picture, within its second.
        number: u16,
    },
    Apng(Box<png::Writer<W>>),
}

/// Pictures per second of a film.
pub const FRAME_RATES: std::ops::RangeInclusive<u16> = 1..=60;

/// Most pictures per second of a GIF: it counts in hundredths of a second, and players slow down below two.
pub const MAX_GIF_RATE: u16 = 50;

/// How much the colours of a GIF are searched for, 1 (most) to 30.
const SEARCH: i32 = 10;

/// When picture `number` begins, in hundredths of a second to the nearest: rounding every delay alike would make films of most
/// rates too slow or too fast.
fn centiseconds(number: u16, frames_per_second: u16) -> u16 {
    let rate = u32::from(frames_per_second);
    u16::try_from((200 * u32::from(number) + rate) / (2 * rate)).unwrap_or(u16::MAX)
}

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
                Encoder::Gif { encoder: Box::new(encoder), frames_per_second, number: 0 }
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
            Encoder::Gif { encoder, frames_per_second, number } => {
                let changed = Changed::between(&self.last, image);
                let mut frame = changed.frame(image, &self.last);
                frame.delay = centiseconds(*number + 1, *frames_per_second) - centiseconds(*number, *frames_per_second);
                *number = (*number + 1) % *frames_per_second;
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

    /// The rectangle, transparent where the picture before shows the same: long runs of one colour pack well, and all
    /// colours go to what moves.
    fn frame(&self, image: &Image, last: &[u8]) -> gif::Frame<'static> {
        let mut moved = Vec::with_capacity(3 * self.width * self.height);
        let mut is_moved = Vec::with_capacity(self.width * self.height);
        for y in self.top..self.top + self.height {
            let start = 3 * (y * image.width() as usize + self.left);
            for place in (start..start + 3 * self.width).step_by(3) {
                let new = &image.bytes()[place..place + 3];
                let differs = last.get(place..place + 3) != Some(new);
                is_moved.push(differs);
                if differs {
                    moved.extend(new);
                }
            }
        }
        // Sides fit, as the whole picture does.
        let (width, height) = (self.width as u16, self.height as u16);
        let (palette, indices, transparent) = palette_of(&moved, self.width);
        let mut indices = indices.into_iter();
        let buffer: Vec<u8> =
            is_moved.iter().map(|&moved| if moved { indices.next() } else { None }.unwrap_or(transparent)).collect();
        gif::Frame {
            left: self.left as u16,
            top: self.top as u16,
            width,
            height,
            dispose: gif::DisposalMethod::Keep,
            transparent: Some(transparent),
            palette: Some(palette),
            buffer: buffer.into(),
            ..gif::Frame::default()
        }
    }
}

/// Colours for pixels of red, green and blue, the index of each pixel among them, and an index that no pixel has. The search
/// for colours wants a picture: the pixels are set in rows of `width`, the last one repeated.
fn palette_of(pixels: &[u8], width: usize) -> (Vec<u8>, Vec<u8>, u8) {
    let count = pixels.len() / 3;
    if count == 0 {
        return (vec![0; 3], Vec::new(), 0);
    }
    let mut rows = pixels.to_vec();
    while !rows.len().is_multiple_of(3 * width) {
        rows.extend_from_within(rows.len() - 3..);
    }
    let frame = gif::Frame::from_rgb_speed(width as u16, (rows.len() / (3 * width)) as u16, &rows, SEARCH);
    let (mut palette, mut indices) = (frame.palette.unwrap_or_default(), frame.buffer.into_owned());
    indices.truncate(count);
    if palette.len() / 3 < 256 {
        let free = (palette.len() / 3) as u8;
        palette.extend([0; 3]);
        return (palette, indices, free);
    }
    // All 256 are taken: the two that are most alike become one.
    let colour = |index: usize| [0, 1, 2].map(|part| i32::from(palette[3 * index + part]));
    let apart =
        |a: usize, b: usize| -> i32 { colour(a).into_iter().zip(colour(b)).map(|(a, b)| (a - b) * (a - b)).sum() };
    let pairs = (0..256).flat_map(|b| (0..b).map(move |a| (a, b)));
    let (kept, freed) = pairs.min_by_key(|&(a, b)| apart(a, b)).unwrap_or((0, 255));
    for index in indices.iter_mut().filter(|index| usize::from(**index) == freed) {
        *index = kept as u8;
    }
    (palette, indices, freed as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pixels of many colours, the same every time.
    fn picture(seed: u32) -> Image {
        let byte = |place: u32| (place.wrapping_mul(2_654_435_761).wrapping_add(seed) >> 24) as u8;
        Image::new(40, 30, (0..40 * 30 * 3).map(byte).collect())
    }

    #[test]
    fn a_gif_shows_what_changed_in_its_colours_and_keeps_the_rest() {
        let first = picture(1);
        let mut second = first.clone();
        for x in 10..20 {
            second.blend(x, 12, [250, 20, 30], 1.0);
        }
        let changed = Changed::between(first.bytes(), &second);
        assert_eq!((changed.left, changed.top, changed.width, changed.height), (10, 12, 10, 1));
        let frame = changed.frame(&second, first.bytes());
        let palette = frame.palette.unwrap();
        for &index in frame.buffer.iter() {
            assert_ne!(Some(index), frame.transparent, "every pixel of the rectangle changed");
            assert_eq!(&palette[3 * usize::from(index)..3 * usize::from(index) + 3], &[250, 20, 30]);
        }
        let same = Changed::between(first.bytes(), &first);
        let frame = same.frame(&first, first.bytes());
        assert_eq!((frame.width, frame.height, frame.buffer[0]), (1, 1, frame.transparent.unwrap()));
    }

    #[test]
    fn a_gif_takes_as_long_as_its_pictures() {
        for rate in 1..=MAX_GIF_RATE {
            let delays = (0..rate).map(|number| centiseconds(number + 1, rate) - centiseconds(number, rate));
            let (shortest, sum) = delays.fold((u16::MAX, 0), |(least, sum), delay| (least.min(delay), sum + delay));
            assert!(
                sum == 100 && shortest >= 2,
                "{rate} pictures a second last {sum} hundredths, one of them {shortest}"
            );
        }
    }

    #[test]
    fn an_index_is_free_where_all_colours_are_taken() {
        let image = picture(7);
        let (palette, indices, free) = palette_of(image.bytes(), 40);
        assert_eq!((palette.len(), indices.len()), (3 * 256, 40 * 30));
        assert!(indices.iter().all(|&index| index != free));
    }
}

//! Films: pictures one after the other, as GIF or as animated PNG, written as they come.

use std::io::Write;

use crate::error::RenderError;
use crate::image::Image;
use crate::palette::{self, Palette};

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
    /// What a GIF shows so far; it keeps what has not changed.
    shown: Vec<[u8; 3]>,
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

/// Squared distance, as the eye weighs it, up to which a pixel of a GIF keeps the colour that it shows: two levels of each
/// component. What changes less often flickers less, and packs better.
const UNSEEN_SQ: f32 = 9.0 * 2.0 * 2.0;

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
        Ok(Self { encoder, width, height, shown: Vec::new() })
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
                let mut frame = next_frame(&mut self.shown, image);
                frame.delay = centiseconds(*number + 1, *frames_per_second) - centiseconds(*number, *frames_per_second);
                *number = (*number + 1) % *frames_per_second;
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

/// What has to be drawn over what is shown so that the picture is seen: the rectangle that changes, transparent where the
/// right colour is shown already. Long runs of one colour pack well, and all colours go to what moves.
fn next_frame(shown: &mut Vec<[u8; 3]>, image: &Image) -> gif::Frame<'static> {
    let width = image.width() as usize;
    let pixels = image.bytes().as_chunks::<3>().0;
    let is_first = shown.len() != pixels.len();
    let is_right = |index: usize| !is_first && is_like(shown[index], pixels[index]);
    let changed: Vec<usize> = (0..pixels.len()).filter(|&index| !is_right(index)).collect();
    let palette = Palette::of(&changed.iter().map(|&index| pixels[index]).collect::<Vec<_>>());
    shown.resize(pixels.len(), [0; 3]);
    // One pixel if nothing differs, because a GIF has no smaller picture.
    let columns = || changed.iter().map(|index| index % width);
    let (left, right) = (columns().min().unwrap_or(0), columns().max().unwrap_or(0));
    let (top, bottom) =
        (changed.first().map_or(0, |first| first / width), changed.last().map_or(0, |last| last / width));
    let transparent = palette.colours.len() as u8;
    let frame_width = right - left + 1;
    let mut buffer = vec![transparent; frame_width * (bottom - top + 1)];
    for index in changed {
        let colour = palette.index(pixels[index]);
        shown[index] = palette.colours[usize::from(colour)];
        buffer[(index / width - top) * frame_width + index % width - left] = colour;
    }
    let mut colours = palette.colours.into_flattened();
    colours.extend([0; 3]);
    // Sides fit, as the whole picture does.
    gif::Frame {
        left: left as u16,
        top: top as u16,
        width: frame_width as u16,
        height: (bottom - top + 1) as u16,
        dispose: gif::DisposalMethod::Keep,
        transparent: Some(transparent),
        palette: Some(colours),
        buffer: buffer.into(),
        ..gif::Frame::default()
    }
}

/// Whether nobody sees the difference.
fn is_like(a: [u8; 3], b: [u8; 3]) -> bool {
    palette::distance_sq(a.map(f32::from), b.map(f32::from)) <= UNSEEN_SQ
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
        let mut shown = Vec::new();
        let frame = next_frame(&mut shown, &first);
        assert_eq!((frame.left, frame.top, frame.width, frame.height), (0, 0, 40, 30));
        assert!(frame.buffer.iter().all(|&index| Some(index) != frame.transparent), "every pixel is drawn once");
        // What is shown from now on is right, wherever it is.
        shown = first.bytes().as_chunks::<3>().0.to_vec();
        let frame = next_frame(&mut shown, &second);
        assert_eq!((frame.left, frame.top, frame.width, frame.height), (10, 12, 10, 1));
        let palette = frame.palette.unwrap();
        for &index in frame.buffer.iter() {
            assert_ne!(Some(index), frame.transparent, "every pixel of the rectangle changed");
            assert_eq!(&palette[3 * usize::from(index)..3 * usize::from(index) + 3], &[250, 20, 30]);
        }
        assert_eq!(shown, second.bytes().as_chunks::<3>().0);
        let frame = next_frame(&mut shown, &second);
        assert_eq!((frame.width, frame.height, frame.buffer[0]), (1, 1, frame.transparent.unwrap()));
        assert_eq!(shown, second.bytes().as_chunks::<3>().0, "nothing differs");
    }

    /// What fades slowly is not left behind by changes that are too small to be seen one by one.
    #[test]
    fn errors_of_a_gif_do_not_add_up() {
        let mut shown = Vec::new();
        for grey in 0..=255_u8 {
            let image = Image::new(20, 16, vec![grey; 3 * 20 * 16]);
            next_frame(&mut shown, &image);
            assert!(shown.iter().all(|&pixel| is_like(pixel, [grey; 3])), "{grey} is shown as {:?}", shown[0]);
        }
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
        let frame = next_frame(&mut Vec::new(), &picture(7));
        let transparent = frame.transparent.unwrap();
        assert_eq!(frame.palette.unwrap().len(), 3 * (usize::from(transparent) + 1));
        assert!(frame.buffer.iter().all(|&index| index < transparent));
    }
}

//! Letters on pictures: DejaVu Sans, whose licence lets it be passed on with programs.

use std::borrow::Cow;

use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};

use crate::image::Image;

/// As much of a line of text as is no wider than `most` pixels; an ellipsis stands for the rest.
pub(crate) fn fitted(text: &str, height: f32, most: f32) -> Cow<'_, str> {
    let Ok(font) = FontRef::try_from_slice(dejavu::sans::regular()) else { return Cow::Borrowed(text) };
    let font = font.into_scaled(PxScale::from(height));
    let ellipsis = font.h_advance(font.glyph_id('…'));
    let (mut width, mut end) = (0.0, 0);
    let mut previous = None;
    for (start, letter) in text.char_indices() {
        let id = font.glyph_id(letter);
        width += previous.map_or(0.0, |previous| font.kern(previous, id)) + font.h_advance(id);
        if width > most {
            return Cow::Owned(format!("{}…", text[..end].trim_end()));
        }
        if width + ellipsis <= most {
            end = start + letter.len_utf8();
        }
        previous = Some(id);
    }
    Cow::Borrowed(text)
}

/// Draws a line of text with its baseline at `(x, y)`; returns its width in pixels.
pub(crate) fn draw(image: &mut Image, text: &str, (x, y): (f32, f32), height: f32, colour: [u8; 3], cover: f32) -> f32 {
    let Ok(font) = FontRef::try_from_slice(dejavu::sans::regular()) else { return 0.0 };
    let font = font.into_scaled(PxScale::from(height));
    let mut pen = x;
    let mut previous = None;
    for letter in text.chars() {
        let id = font.glyph_id(letter);
        if let Some(previous) = previous {
            pen += font.kern(previous, id);
        }
        if let Some(outline) = font.outline_glyph(id.with_scale_and_position(height, point(pen, y))) {
            let bounds = outline.px_bounds();
            let (left, top) = (bounds.min.x as i64, bounds.min.y as i64);
            outline.draw(|dx, dy, share| {
                image.blend(left + i64::from(dx), top + i64::from(dy), colour, share * cover);
            });
        }
        pen += font.h_advance(id);
        previous = Some(id);
    }
    pen - x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_are_cut_where_they_would_leave_the_picture() {
        let width = |text: &str| draw(&mut Image::new(16, 16, vec![0; 768]), text, (0.0, 10.0), 20.0, [0; 3], 1.0);
        let text = "a scene of many words, as long as a sentence";
        assert_eq!(fitted(text, 20.0, 1000.0), text);
        for most in [40.0, 100.0, 173.0, 300.0] {
            let cut = fitted(text, 20.0, most);
            let kept = cut.strip_suffix('…').expect("the rest is left out");
            assert!(text.starts_with(kept) && width(&cut) <= most, "{cut} is {} pixels wide", width(&cut));
            assert!(width(&cut) > most - 40.0, "{cut} leaves {} pixels free", most - width(&cut));
        }
        assert_eq!(fitted(text, 20.0, -5.0), "…", "in the smallest picture");
    }
}

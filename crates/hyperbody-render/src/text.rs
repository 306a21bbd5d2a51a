//! Letters on pictures: DejaVu Sans, whose licence lets it be passed on with programs.

use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};

use crate::image::Image;

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

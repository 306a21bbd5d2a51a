//! What is written on a picture: the caption, and the strip that shows where every body is along the hidden directions.

use hyperbody::math::planes::AXIS_NAMES;
use hyperbody::math::scalar;

use crate::colour::{self, Encoder};
use crate::image::Image;
use crate::picture::Settings;
use crate::stage::{BodyLook, Stage};
use crate::text;

const INK: [u8; 3] = [38, 44, 58];

/// Measures of a strip, in pixels of a picture 720 pixels high: its width, and the gaps to the next one and to the edge.
const STRIP: f32 = 96.0;
const GAP: f32 = 10.0;
const BORDER: f32 = 20.0;

/// Most of the width of a picture higher than wide that its strips take up together.
const MOST_SHARE: f32 = 0.25;

/// Width of the narrowest strip in such a picture, in pixels: below, its letter and its bars cannot be told.
const LEAST_STRIP: f32 = 12.0;

/// The share of a picture's width that the strips of its hidden directions take up at its right edge. Bodies behind them are
/// hard to see: [`Camera::with_room`](crate::Camera::with_room) makes room. Pictures higher than wide have narrower ones, a
/// quarter of the width together at most, or none, and 0 is given, where they could not be read.
#[must_use]
pub fn strips_share(dimension: usize, width: u32, height: u32) -> f64 {
    let share = across(dimension) * height as f32 / 720.0 / width as f32;
    if width >= height {
        return f64::from(share).min(0.5);
    }
    let share = share.min(MOST_SHARE);
    let strip = share * width as f32 * STRIP / across(dimension).max(STRIP);
    if strip >= LEAST_STRIP { f64::from(share) } else { 0.0 }
}

/// What the strips take up across with the gaps between them, in pixels of a picture 720 pixels high.
fn across(dimension: usize) -> f32 {
    let strips = dimension.saturating_sub(3) as f32;
    if strips > 0.0 { BORDER + strips * (STRIP + GAP) } else { 0.0 }
}

pub(crate) fn draw<const N: usize>(image: &mut Image, stage: &Stage<N>, settings: &Settings) {
    let unit = image.height() as f32 / 720.0;
    let strips = if settings.strip { strips_share(N, image.width(), image.height()) as f32 } else { 0.0 };
    if strips > 0.0 {
        let is_wide = image.width() >= image.height();
        let narrow = if is_wide { unit } else { strips * image.width() as f32 / across(N) };
        for hidden in 3..N {
            strip(image, stage, hidden, [unit, narrow]);
        }
    }
    // Letters shrink less than pictures do, or nobody could read them.
    let letter = scalar::pow(f64::from(unit), 0.6) as f32;
    let line = 26.0 * letter;
    let mut y = image.height() as f32 - 24.0 * unit - line * (settings.caption.len().saturating_sub(1)) as f32;
    let most = image.width() as f32 * (1.0 - strips) - 48.0 * unit;
    for (index, caption) in settings.caption.iter().enumerate() {
        let height = if index == 0 { 22.0 } else { 18.0 } * letter;
        let caption = text::fitted(caption, height, most);
        text::draw(image, &caption, (24.0 * unit, y), height, INK, 0.85);
        y += line;
    }
}

/// A rounded panel with a bar for each body over its extent along hidden direction `hidden`, and the slice as a line. Lengths are
/// in units of the picture's height down, and in units of the strips across.
fn strip<const N: usize>(image: &mut Image, stage: &Stage<N>, hidden: usize, [unit, narrow]: [f32; 2]) {
    let bars: Vec<(&BodyLook, [f64; 2])> =
        stage.bodies.iter().filter_map(|look| Some((look, *look.hidden_extents.as_ref()?.get(hidden - 3)?))).collect();
    if bars.is_empty() {
        return;
    }
    let reach = bars.iter().flat_map(|(_, extent)| extent).fold(stage.size, |reach, end| reach.max(end.abs())) * 1.08;
    let width = (STRIP * narrow) as i64;
    let (top, bottom) = ((24.0 * unit) as i64, i64::from(image.height()) - (24.0 * unit) as i64);
    let right =
        i64::from(image.width()) - (BORDER * narrow) as i64 - (hidden as i64 - 3) * (width + (GAP * narrow) as i64);
    let left = right - width;
    panel(image, [left, top, right, bottom], (10.0 * narrow) as i64);
    let middle = 0.5 * (top + bottom) as f64;
    let scale = 0.5 * ((bottom - top) as f64 - 60.0 * f64::from(unit)) / reach;
    let (inner_left, inner_width) = (left as f64 + 12.0 * f64::from(narrow), width as f64 - 24.0 * f64::from(narrow));
    let encoder = Encoder::new();
    let bar_width = (inner_width / bars.len() as f64 * 0.7).min(9.0 * f64::from(narrow)).max(1.2);
    for (index, (look, [low, high])) in bars.iter().enumerate() {
        let centre = inner_left + inner_width * (index as f64 + 0.5) / bars.len() as f64;
        let paint = if look.is_cut { look.colour } else { colour::of_side(&look.middle[3..]) };
        let cover = if look.is_cut { 0.95 } else { 0.4 };
        let (from, to) = (middle - high * scale, middle - low * scale);
        rectangle(image, [centre - 0.5 * bar_width, from, centre + 0.5 * bar_width, to], encoder.bytes(paint), cover);
    }
    let line = f64::from(unit).max(1.0);
    rectangle(image, [left as f64, middle - line, right as f64, middle + line], INK, 0.85);
    let name = AXIS_NAMES.get(hidden).copied().unwrap_or('?').to_string();
    // A letter as high as usual, if the strip is wide enough for it.
    let height = (20.0 * unit).min(0.8 * STRIP * narrow);
    text::draw(image, &name, (left as f32 + 12.0 * narrow, top as f32 + 24.0 * unit), height, INK, 0.85);
}

/// A pale panel with round corners.
fn panel(image: &mut Image, [left, top, right, bottom]: [i64; 4], radius: i64) {
    for y in top..bottom {
        for x in left..right {
            let dx = (left + radius - x).max(x - (right - 1 - radius)).max(0) as f32;
            let dy = (top + radius - y).max(y - (bottom - 1 - radius)).max(0) as f32;
            let inside = (radius as f32 + 0.5 - (dx * dx + dy * dy).sqrt()).clamp(0.0, 1.0);
            image.blend(x, y, [250, 251, 253], 0.55 * inside);
        }
    }
}

/// A rectangle with edges anywhere: pixels are covered by the share that lies inside.
fn rectangle(image: &mut Image, [left, top, right, bottom]: [f64; 4], colour: [u8; 3], cover: f32) {
    let share = |low: f64, high: f64, pixel: i64| (high.min(pixel as f64 + 1.0) - low.max(pixel as f64)).max(0.0);
    for y in top.floor() as i64..bottom.ceil() as i64 {
        for x in left.floor() as i64..right.ceil() as i64 {
            image.blend(x, y, colour, cover * (share(left, right, x) * share(top, bottom, y)) as f32);
        }
    }
}

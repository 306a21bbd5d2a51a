//! Colours, line styles, text and numbers of the pictures.

use plotters::element::PathElement;
use plotters::prelude::{Color, Text};
use plotters::series::DashedLineSeries;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{IntoFont, RGBColor, ShapeStyle, TextStyle};

use super::{Area, Drawn, UNITS};
use crate::output::number;

pub(super) const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
pub(super) const GREY: RGBColor = RGBColor(0x77, 0x77, 0x77);
pub(super) const PALE: RGBColor = RGBColor(0xDD, 0xDD, 0xDD);
pub(super) const VERMILLION: RGBColor = RGBColor(0xD5, 0x5E, 0x00);
pub(super) const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xB2);
pub(super) const SKY: RGBColor = RGBColor(0x56, 0xB4, 0xE9);
pub(super) const GREEN: RGBColor = RGBColor(0x00, 0x9E, 0x73);

/// Told apart with every kind of colour vision (M. Okabe and K. Ito, 2008), without the yellow, which is lost on white.
const COLOURS: [RGBColor; 7] =
    [BLUE, VERMILLION, GREEN, RGBColor(0xCC, 0x79, 0xA7), RGBColor(0xE6, 0x9F, 0x00), SKY, RGBColor(0x00, 0x00, 0x00)];

/// Text sizes and line widths in pixels.
pub(super) const TITLE: f64 = 30.0;
pub(super) const LABEL: f64 = 25.0;
pub(super) const SMALL: f64 = 22.0;
pub(super) const LINE: f64 = 3.0;
pub(super) const THIN: f64 = 1.5;

/// Pixels as units.
pub(super) fn units(pixels: f64) -> i32 {
    (pixels * UNITS).round() as i32
}

/// How a series is drawn: its colour, and a dash once the colours have been used up.
#[derive(Clone, Copy)]
pub(super) struct Stroke {
    pub(super) colour: RGBColor,
    /// Dash and gap in pixels.
    dash: Option<(f64, f64)>,
}

impl Stroke {
    /// The stroke of series `index`, of which 21 look different.
    pub(super) fn of_series(index: usize) -> Self {
        let dash = [None, Some((14.0, 7.0)), Some((4.0, 5.0))][index / COLOURS.len() % 3];
        Self { colour: COLOURS[index % COLOURS.len()], dash }
    }

    /// The same stroke drawn over `below` others along the same way: with gaps that let them show, in turns of 48 pixels.
    pub(super) fn over(self, below: usize) -> Self {
        let dash = match below {
            0 => self.dash,
            1 => Some((24.0, 24.0)),
            2 => Some((12.0, 36.0)),
            _ => Some((6.0, 42.0)),
        };
        Self { dash, ..self }
    }

    pub(super) fn dashed(colour: RGBColor) -> Self {
        Self { colour, dash: Some((10.0, 8.0)) }
    }

    /// Dash and gap in pixels, unless the line is solid.
    pub(super) fn dash(self) -> Option<(f64, f64)> {
        self.dash
    }

    /// Draws a line through points in units.
    pub(super) fn draw(self, area: &Area<'_>, points: &[(i32, i32)], width: f64) -> Drawn {
        let style = line(self.colour, width);
        match self.dash {
            None => area.draw(&PathElement::new(points.to_vec(), style))?,
            Some((dash, gap)) => {
                let series = DashedLineSeries::new(points.iter().copied(), units(dash), units(gap), style);
                for element in series {
                    area.draw(&element)?;
                }
            }
        }
        Ok(())
    }
}

/// A number for people in a picture, with a minus sign as long as a plus sign.
pub(super) fn shown(value: f64) -> String {
    number(value).replace('-', "−")
}

/// A line style of the given width in pixels.
pub(super) fn line(colour: RGBColor, width: f64) -> ShapeStyle {
    colour.stroke_width(units(width) as u32)
}

/// Draws the outline of a rectangle in units; the rectangles of plotters have no line width in SVG.
pub(super) fn outline(area: &Area<'_>, [(x1, y1), (x2, y2)]: [(i32, i32); 2], colour: RGBColor) -> Drawn {
    let corners = vec![(x1, y1), (x2, y1), (x2, y2), (x1, y2), (x1, y1)];
    Ok(area.draw(&PathElement::new(corners, line(colour, THIN)))?)
}

/// Writes `words` with its left end, middle or right end at a point in pixels, centred in height.
pub(super) fn write(area: &Area<'_>, words: &str, at: (f64, f64), size: f64, colour: RGBColor, anchor: HPos) -> Drawn {
    // The SVG of plotters divides the size by 1.24.
    let style = TextStyle::from(("sans-serif", 1.24 * size * UNITS).into_font());
    let style = style.color(&colour).pos(Pos::new(anchor, VPos::Center));
    area.draw(&Text::new(words.to_owned(), (units(at.0), units(at.1)), style))?;
    Ok(())
}

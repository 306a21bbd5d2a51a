//! Line charts: series over a common horizontal axis, the vertical one linear or logarithmic, their names beside them.

use std::f64::consts::LOG10_E;

use hyperbody::math::scalar;
use plotters::chart::ChartBuilder;
use plotters::prelude::{Color, IntoFont, LineSeries};
use plotters::series::DashedLineSeries;
use plotters::style::TextStyle;
use plotters::style::text_anchor::HPos;

use super::axis::Axis;
use super::style::{GREY, INK, LABEL, LINE, PALE, SMALL, Stroke, THIN, TITLE, line, units, write};
use super::{Area, Drawn, UNITS, WIDTH};

/// Pixels to the left of the axes, and to the right of them for the names.
pub(super) const LEFT: f64 = 150.0;
const RIGHT: f64 = 330.0;
const TOP: f64 = 76.0;

/// Of that on the left, what is kept free at the edge of the picture.
pub(super) const MARGIN: f64 = 26.0;
const BOTTOM: f64 = 84.0;

/// Series lie on each other if for this part of the time they differ by less than this part of the chart's height.
const TOGETHER: f64 = 0.85;
const CLOSE: f64 = 0.006;

pub(super) struct Chart {
    pub(super) title: String,
    pub(super) y_label: String,
    /// In seconds.
    pub(super) end: f64,
    pub(super) logarithmic: bool,
    pub(super) series: Vec<Series>,
    /// Lines under the names.
    pub(super) notes: Vec<String>,
}

pub(super) struct Series {
    pub(super) name: String,
    pub(super) points: Vec<(f64, f64)>,
}

impl Chart {
    /// Draws the chart over the whole area, which is [`WIDTH`] wide.
    pub(super) fn draw(&self, area: &Area<'_>) -> Drawn {
        let lines: Vec<Vec<(f64, f64)>> = self.series.iter().map(|series| self.on_axis(&series.points)).collect();
        let (low, high) = self.vertical_range(&lines);
        let vertical = if self.logarithmic { Axis::logarithmic(low, high) } else { Axis::linear(low, high, 6) };
        let mut chart = ChartBuilder::on(area)
            .margin_top(units(TOP))
            .margin_right(units(RIGHT))
            .margin_left(units(MARGIN))
            .x_label_area_size(units(BOTTOM))
            .y_label_area_size(units(LEFT - MARGIN))
            .build_cartesian_2d(Axis::linear(0.0, self.end, 8), vertical)?;
        let text = |size: f64| TextStyle::from(("sans-serif", 1.24 * size * UNITS).into_font()).color(&INK);
        chart
            .configure_mesh()
            .bold_line_style(line(PALE, THIN))
            .light_line_style(PALE.mix(0.0))
            .axis_style(line(GREY, THIN))
            .label_style(text(SMALL))
            .axis_desc_style(text(LABEL))
            .x_desc("time (s)")
            .y_desc(&self.y_label)
            .set_all_tick_mark_size(units(7.0))
            .draw()?;
        // The first series last: it is the one that the chart is about.
        let strokes = strokes(&lines, high - low);
        for (points, &stroke) in lines.into_iter().zip(&strokes).rev() {
            let style = line(stroke.colour, LINE);
            match stroke.dash() {
                None => chart.draw_series(LineSeries::new(points, style))?,
                Some((dash, gap)) => {
                    chart.draw_series(DashedLineSeries::new(points, units(dash), units(gap), style))?
                }
            };
        }
        write(area, &self.title, (LEFT, 0.5 * TOP), TITLE, INK, HPos::Left)?;
        self.draw_names(area, &strokes)
    }

    fn on_axis(&self, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
        let finite = points.iter().copied().filter(|(_, y)| y.is_finite());
        if self.logarithmic {
            // Zero has no place on this axis.
            return finite.filter(|(_, y)| *y != 0.0).map(|(x, y)| (x, scalar::ln(y.abs()) * LOG10_E)).collect();
        }
        finite.collect()
    }

    fn vertical_range(&self, lines: &[Vec<(f64, f64)>]) -> (f64, f64) {
        let values = || lines.iter().flatten().map(|point| point.1).filter(|value| value.is_finite());
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        if low > high {
            return if self.logarithmic { (-17.0, -15.0) } else { (0.0, 1.0) };
        }
        if self.logarithmic {
            return (low.floor(), high.ceil().max(low.floor() + 2.0));
        }
        let margin = 0.06 * (high - low).max(0.5 * high.abs().max(low.abs())).max(1e-9);
        (low - margin, high + margin)
    }

    fn draw_names(&self, area: &Area<'_>, strokes: &[Stroke]) -> Drawn {
        let left = WIDTH - RIGHT + 24.0;
        let mut y = TOP + 18.0;
        for (series, stroke) in self.series.iter().zip(strokes) {
            stroke.draw(area, &[(units(left), units(y)), (units(left + 72.0), units(y))], 1.5 * LINE)?;
            write(area, &series.name, (left + 84.0, y), SMALL, INK, HPos::Left)?;
            y += 32.0;
        }
        for note in &self.notes {
            write(area, note, (left, y + 10.0), SMALL, GREY, HPos::Left)?;
            y += 30.0;
        }
        Ok(())
    }
}

/// The stroke of each line; where it covers others, which are drawn before it, they show through its gaps.
fn strokes(lines: &[Vec<(f64, f64)>], height: f64) -> Vec<Stroke> {
    let stroke = |index: usize| {
        let below = lines[index + 1..].iter().filter(|line| together(&lines[index], line, height)).count();
        Stroke::of_series(index).over(below)
    };
    (0..lines.len()).map(stroke).collect()
}

/// Whether two lines that have their points at the same times lie on each other for most of it.
fn together(first: &[(f64, f64)], second: &[(f64, f64)], height: f64) -> bool {
    let pairs = first.iter().rev().zip(second.iter().rev());
    let close = pairs.filter(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() <= CLOSE * height).count();
    close as f64 > TOGETHER * first.len().max(second.len()) as f64
}

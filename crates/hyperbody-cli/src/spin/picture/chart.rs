//! Line charts: series over a common horizontal axis, the vertical one linear or logarithmic, their names beside them.

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
const TOP: f64 = 62.0;
const BOTTOM: f64 = 84.0;

/// What a logarithmic axis shows for zero: less than a double can tell from one.
const FLOOR: f64 = 1e-17;

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
            .x_label_area_size(units(BOTTOM))
            .y_label_area_size(units(LEFT))
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
        for (index, points) in lines.into_iter().enumerate().rev() {
            let stroke = Stroke::of_series(index);
            let style = line(stroke.colour, LINE);
            match stroke.dash() {
                None => chart.draw_series(LineSeries::new(points, style))?,
                Some((dash, gap)) => {
                    chart.draw_series(DashedLineSeries::new(points, units(dash), units(gap), style))?
                }
            };
        }
        write(area, &self.title, (LEFT, 0.5 * TOP), TITLE, INK, HPos::Left)?;
        self.draw_names(area)
    }

    fn on_axis(&self, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
        let value = |y: f64| if self.logarithmic { y.abs().max(FLOOR).log10() } else { y };
        points.iter().map(|&(x, y)| (x, value(y))).collect()
    }

    fn vertical_range(&self, lines: &[Vec<(f64, f64)>]) -> (f64, f64) {
        let values = || lines.iter().flatten().map(|point| point.1).filter(|value| value.is_finite());
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        if low > high {
            return (0.0, 1.0);
        }
        if self.logarithmic {
            return (low.floor(), high.ceil().max(low.floor() + 2.0));
        }
        let margin = 0.06 * (high - low).max(1e-9 + 1e-3 * high.abs());
        (low - margin, high + margin)
    }

    fn draw_names(&self, area: &Area<'_>) -> Drawn {
        let left = WIDTH - RIGHT + 24.0;
        let mut y = TOP + 18.0;
        for (index, series) in self.series.iter().enumerate() {
            let stroke = Stroke::of_series(index);
            stroke.draw(area, &[(units(left), units(y)), (units(left + 54.0), units(y))], 1.5 * LINE)?;
            write(area, &series.name, (left + 66.0, y), SMALL, INK, HPos::Left)?;
            y += 32.0;
        }
        for note in &self.notes {
            write(area, note, (left, y + 10.0), SMALL, GREY, HPos::Left)?;
            y += 30.0;
        }
        Ok(())
    }
}

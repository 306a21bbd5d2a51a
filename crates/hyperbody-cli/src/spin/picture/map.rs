//! Pictures of stability maps: measured growth as colour, the exact boundary as a line.

use plotters::chart::ChartBuilder;
use plotters::prelude::IntoFont;
use plotters::style::TextStyle;
use plotters::style::text_anchor::HPos;

use super::axis::{Axis, tick_text, ticks};
use super::chart::MARGIN;
use super::heat::Scale;
use super::style::{GREY, INK, LABEL, LINE, SMALL, Stroke, THIN, TITLE, line, outline, shown, units, write};
use super::{Drawn, UNITS, svg};
use crate::failure::Failure;
use crate::output::number;
use crate::spin::boundary::Segment;
use crate::spin::map::{MapReport, Side};

/// In pixels: the picture's height, and the square of the map.
const HEIGHT: f64 = 1210.0;
const TOP: f64 = 120.0;
const LEFT: f64 = 150.0;
const BOTTOM: f64 = 90.0;
const RIGHT: f64 = 450.0;

/// Growth that shows as colour, as a part of the largest.
const VISIBLE: f64 = 2e-3;

/// The map as SVG.
pub(in crate::spin) fn draw(report: &MapReport) -> Result<String, Failure> {
    let rates = &report.measured_growth_rate;
    let largest = rates.iter().flatten().fold(0.0, |largest: f64, &rate| largest.max(rate));
    let scale = Scale::new((VISIBLE * largest).max(1e-4), largest);
    svg(HEIGHT, |area| {
        let [x, y] = [&report.x, &report.y].map(cells_with_margin);
        let mut chart = ChartBuilder::on(area)
            .margin_top(units(TOP))
            .margin_right(units(RIGHT))
            .margin_left(units(MARGIN))
            .x_label_area_size(units(BOTTOM))
            .y_label_area_size(units(LEFT - MARGIN))
            .build_cartesian_2d(Axis::linear(x.0, x.1, 7), Axis::linear(y.0, y.1, 7))?;
        let (across, up) = chart.plotting_area().get_pixel_range();
        scale.draw_cells(area, rates, (across.start, across.end), (up.start, up.end))?;
        let text = |size: f64| TextStyle::from(("sans-serif", 1.24 * size * UNITS).into_font()).color(&INK);
        chart
            .configure_mesh()
            .disable_mesh()
            .axis_style(line(GREY, THIN))
            .label_style(text(SMALL))
            .axis_desc_style(text(LABEL))
            .x_desc(label(&report.x))
            .y_desc(label(&report.y))
            .set_all_tick_mark_size(units(7.0))
            .draw()?;
        let frame = [(across.start, up.start), (across.end, up.end)];
        outline(area, frame, GREY)?;
        let place = |point: [f64; 2]| chart.backend_coord(&(point[0], point[1]));
        if report.spin.is_none() {
            let reach = x.1.abs().max(x.0.abs()).max(y.0.abs()).max(y.1.abs());
            for slope in [1.0, -1.0] {
                if let Some(ends) = within(x, y, slope, reach) {
                    Stroke::dashed(GREY).draw(area, &ends.map(place), THIN)?;
                }
            }
        }
        for curve in joined(&report.boundary) {
            let points: Vec<(i32, i32)> = curve.into_iter().map(place).collect();
            Stroke::of_series(1).draw(area, &points, 1.3 * LINE)?;
        }
        draw_heading(area, report)?;
        draw_legend(area, report, &scale)
    })
}

/// The range of a side with half a cell on either end: values are those of the middles of cells.
fn cells_with_margin(side: &Side) -> (f64, f64) {
    let (first, last) = (side.values.first().copied().unwrap_or(0.0), side.values.last().copied().unwrap_or(1.0));
    let half = 0.5 * (last - first) / (side.values.len().max(2) - 1) as f64;
    (first - half, last + half)
}

fn label(side: &Side) -> String {
    if side.unit == "rad/s" {
        format!("spin in plane {} (rad/s)", side.varies)
    } else {
        format!("second moment J of axis {} ({})", side.varies, side.unit)
    }
}

/// The part of the line y = slope · x that lies in the map.
fn within(x: (f64, f64), y: (f64, f64), slope: f64, reach: f64) -> Option<[[f64; 2]; 2]> {
    let (y1, y2) = if slope > 0.0 { (y.0, y.1) } else { (-y.1, -y.0) };
    let (from, to) = (x.0.max(y1).max(-reach), x.1.min(y2).min(reach));
    (from < to).then_some([[from, slope * from], [to, slope * to]])
}

/// Segments that share an end, as curves.
fn joined(segments: &[Segment]) -> Vec<Vec<[f64; 2]>> {
    let mut left: Vec<Segment> = segments.to_vec();
    let mut curves = Vec::new();
    while let Some([first, second]) = left.pop() {
        let mut curve = vec![first, second];
        for _ in 0..2 {
            while let Some(&end) = curve.last()
                && let Some(index) = left.iter().position(|segment| segment.contains(&end))
            {
                let [a, b] = left.swap_remove(index);
                curve.push(if a == end { b } else { a });
            }
            // Then on from the other end.
            curve.reverse();
        }
        curves.push(curve);
    }
    curves
}

fn draw_heading(area: &super::Area<'_>, report: &MapReport) -> Drawn {
    let moments: Vec<String> = report.moments.iter().map(|&moment| number(moment)).collect();
    let moments = moments.join(", ");
    let (title, below) = match &report.spin {
        None => (
            format!("Stability of rotations in the planes {} and {}", report.x.varies, report.y.varies),
            format!("free body in {} dimensions, J = ({moments}) {}", report.dimension, report.moments_unit),
        ),
        Some(spin) => {
            let spin: Vec<String> = spin.0.iter().map(|(plane, rate)| format!("{plane} = {}", shown(*rate))).collect();
            let others: Vec<String> = ["x", "y", "z", "w", "v", "u"]
                .iter()
                .zip(&report.moments)
                .filter(|(axis, _)| **axis != report.x.varies && **axis != report.y.varies)
                .map(|(axis, moment)| format!("J_{axis} = {}", number(*moment)))
                .collect();
            (
                format!("Stability of the rotation {} rad/s", spin.join(", ")),
                format!(
                    "free bodies in {} dimensions, {} {}",
                    report.dimension,
                    others.join(", "),
                    report.moments_unit
                ),
            )
        }
    };
    write(area, &title, (LEFT, 36.0), 1.1 * TITLE, INK, HPos::Left)?;
    write(area, &below, (LEFT, 80.0), LABEL, GREY, HPos::Left)
}

fn draw_legend(area: &super::Area<'_>, report: &MapReport, scale: &Scale) -> Drawn {
    let left = super::WIDTH - RIGHT + 50.0;
    write(area, "measured growth rate (1/s)", (left, TOP + 14.0), LABEL, INK, HPos::Left)?;
    let (top, bottom) = (TOP + 50.0, TOP + 520.0);
    let bar = (units(left), units(left + 46.0));
    scale.draw_bar(area, bar, (units(top), units(bottom)))?;
    outline(area, [(bar.0, units(top)), (bar.1, units(bottom))], GREY)?;
    for value in ticks(0.0, scale.top, 5) {
        let y = bottom - (bottom - top) * value / scale.top;
        let tick = [(units(left + 46.0), units(y)), (units(left + 54.0), units(y))];
        area.draw(&plotters::element::PathElement::new(tick.to_vec(), line(GREY, THIN)))?;
        write(area, &tick_text(value), (left + 64.0, y), SMALL, INK, HPos::Left)?;
    }
    let mut y = bottom + 50.0;
    outline(area, [(bar.0, units(y - 14.0)), (bar.1, units(y + 14.0))], GREY)?;
    write(area, "nothing grows: stable", (left + 64.0, y), SMALL, INK, HPos::Left)?;
    let stroke = |y: f64| [(bar.0, units(y)), (bar.1, units(y))];
    if !report.boundary.is_empty() {
        y += 52.0;
        Stroke::of_series(1).draw(area, &stroke(y), 1.3 * LINE)?;
        write(area, "exact boundary, from the", (left + 64.0, y), SMALL, INK, HPos::Left)?;
        y += 28.0;
        write(area, "eigenvalues in closed form", (left + 64.0, y), SMALL, INK, HPos::Left)?;
        if let (Some(threshold), Some([inner, outer])) = (report.threshold, &report.inner_and_outer) {
            y += 32.0;
            let ratio = format!("|ω {inner}| = {threshold:.7} |ω {outer}|");
            write(area, &ratio, (left + 64.0, y), SMALL, INK, HPos::Left)?;
        }
    }
    if report.spin.is_none() {
        y += 52.0;
        Stroke::dashed(GREY).draw(area, &stroke(y), THIN)?;
        let isoclinic = format!("isoclinic: |ω {}| = |ω {}|", report.x.varies, report.y.varies);
        write(area, &isoclinic, (left + 64.0, y), SMALL, INK, HPos::Left)?;
    }
    Ok(())
}

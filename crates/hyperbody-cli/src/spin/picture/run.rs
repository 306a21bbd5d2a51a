//! Pictures of a run: the panels that were asked for, one below the other.

use plotters::style::text_anchor::HPos;

use super::chart::{Chart, LEFT, Series};
use super::path;
use super::style::{GREY, INK, LABEL, TITLE, write};
use super::{Area, Drawn, Panel, svg};
use crate::failure::Failure;
use crate::output::number;
use crate::spin::report::{DriftSeries, Named, Report};

/// Heights in pixels.
const HEAD: f64 = 178.0;
const CHART: f64 = 620.0;
const SPHERES: f64 = 800.0;

/// Spin below this part of the largest one counts as none.
const NO_SPIN: f64 = 1e-9;

/// Planes whose spin at the start fits into a line, alone and with the push in the others.
const NAMED_PLANES: usize = 5;
const NAMED_WITH_PUSH: usize = 3;

enum Part {
    Chart(Chart),
    Spheres,
}

/// The picture of a run as SVG.
///
/// # Errors
/// If a path is wanted in the plane, where the momentum is one number and does not move.
pub(in crate::spin) fn draw(report: &Report, panels: &[Panel]) -> Result<String, Failure> {
    let mut parts = Vec::new();
    for panel in panels {
        match panel {
            Panel::Spins => parts.push(Part::Chart(spins(report))),
            Panel::Drift if report.compared.is_empty() => parts.push(Part::Chart(drift(report))),
            Panel::Drift => parts.extend(compared_drift(report).map(Part::Chart)),
            Panel::Path if report.dimension == 2 && panels.len() > 1 => {}
            Panel::Path if report.dimension == 2 => {
                return Err(Failure::Input(
                    "--show path: in two dimensions the momentum is one number, which does not move; show spins or drift"
                        .to_owned(),
                ));
            }
            Panel::Path => parts.push(Part::Spheres),
        }
    }
    let height_of = |part: &Part| if matches!(part, Part::Chart(_)) { CHART } else { SPHERES };
    let height = HEAD + parts.iter().map(height_of).sum::<f64>();
    svg(height, |area| {
        let (head, mut rest) = area.split_vertically(super::style::units(HEAD));
        draw_head(&head, report)?;
        for part in &parts {
            let (this, below) = rest.split_vertically(super::style::units(height_of(part)));
            match part {
                Part::Chart(chart) => chart.draw(&this)?,
                Part::Spheres => path::draw(&this, report)?,
            }
            rest = below;
        }
        Ok(())
    })
}

fn draw_head(area: &Area<'_>, report: &Report) -> Drawn {
    let moments: Vec<String> = report.moments.iter().map(|&moment| number(moment)).collect();
    let title = format!("Free body in {} dimensions", report.dimension);
    let moments = format!("second moments J = ({}) {}", moments.join(", "), report.moments_unit);
    let verdict = match report.stability.stable {
        Some(true) => "stable".to_owned(),
        Some(false) => format!("unstable, growth rate {} /s", number(report.stability.growth_rate)),
        None => "no verdict from the linear problem".to_owned(),
    };
    let planes: Vec<&str> = report.stability.rotation.0.iter().map(|(plane, _)| plane.as_str()).collect();
    let named = if report.push == 0.0 { NAMED_PLANES } else { NAMED_WITH_PUSH };
    let spin = format!("spin at the start: {}", report.spin_text(named).replace('-', "−"));
    let judged = if planes.is_empty() {
        "the body does not turn".to_owned()
    } else {
        format!("steady rotation in {}: {verdict}", planes.join(" and "))
    };
    write(area, &title, (LEFT, 36.0), 1.1 * TITLE, INK, HPos::Left)?;
    for (line, text) in [moments, spin, judged].iter().enumerate() {
        write(area, text, (LEFT, 80.0 + 34.0 * line as f64), LABEL, GREY, HPos::Left)?;
    }
    Ok(())
}

fn spins(report: &Report) -> Chart {
    let largest = |values: &[f64]| values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let overall = report.angular_velocity.0.iter().map(|(_, values)| largest(values)).fold(0.0, f64::max);
    let turning = |values: &[f64]| largest(values) > NO_SPIN * overall;
    let Named(planes) = &report.angular_velocity;
    let still: Vec<&str> =
        planes.iter().filter(|(_, values)| !turning(values)).map(|(plane, _)| plane.as_str()).collect();
    let series = planes.iter().filter(|(_, values)| turning(values));
    let mut notes = Vec::new();
    if !still.is_empty() {
        notes.push("no spin in".to_owned());
        notes.extend(still.chunks(5).map(|planes| planes.join(" ")));
    }
    Chart {
        title: "Angular velocity in the body, by plane".to_owned(),
        y_label: "ω (rad/s)".to_owned(),
        end: report.seconds,
        logarithmic: false,
        series: series.map(|(plane, values)| over_time(format!("ω {plane}"), &report.times, values)).collect(),
        notes,
    }
}

fn drift(report: &Report) -> Chart {
    let drift = &report.drift;
    let mut series = vec![("energy", &drift.energy), ("|L|²", &drift.angular_momentum_sq)];
    series.push(("L in the world", &drift.angular_momentum));
    series.extend(drift.pfaffian.iter().map(|values| ("Pfaffian", values)));
    series.push(("Manakov’s", &drift.manakov));
    let series = series.into_iter().map(|(name, values)| over_time(name.to_owned(), &report.times, values));
    drift_chart(format!("Largest relative drift so far, {}", report.method), report, series.collect())
}

/// Energy and momentum of all methods, in two charts.
fn compared_drift(report: &Report) -> impl Iterator<Item = Chart> {
    type Pick = fn(&DriftSeries) -> &Vec<f64>;
    let charts: [(&str, Pick); 2] =
        [("energy", |drift| &drift.energy), ("momentum L in the world", |drift| &drift.angular_momentum)];
    charts.into_iter().map(|(what, pick)| {
        let mut series = vec![over_time(report.method.to_owned(), &report.times, pick(&report.drift))];
        let others = report.compared.iter();
        series.extend(others.map(|other| over_time(other.method.to_owned(), &other.times, pick(&other.drift))));
        drift_chart(format!("Largest relative drift so far, {what}"), report, series)
    })
}

fn drift_chart(title: String, report: &Report, series: Vec<Series>) -> Chart {
    let (series, kept): (Vec<Series>, Vec<Series>) =
        series.into_iter().partition(|series| series.points.iter().any(|point| point.1 != 0.0));
    let mut notes = vec![format!("dt = {}", report.dt_text())];
    if !kept.is_empty() {
        notes.push("kept to the last bit:".to_owned());
        notes.extend(kept.into_iter().map(|series| series.name));
    }
    Chart { title, y_label: "relative drift".to_owned(), end: report.seconds, logarithmic: true, series, notes }
}

fn over_time(name: String, times: &[f64], values: &[f64]) -> Series {
    Series { name, points: times.iter().copied().zip(values.iter().copied()).collect() }
}

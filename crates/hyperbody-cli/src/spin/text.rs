//! A run for people.

use hyperbody::dynamics::free_top::growth::DISTURBANCE;

use super::report::{DriftReport, Report, StabilityReport};
use crate::output::{labelled, number, table};

/// Characters of a sentence to a line, beside its label.
const LINE_LENGTH: usize = 96;

/// Flip times that are listed.
const SHOWN_FLIPS: usize = 6;

pub(super) fn as_text(report: &Report) -> String {
    let moments: Vec<String> = report.moments.iter().map(|&moment| number(moment)).collect();
    let mut parts = vec![
        format!("A free body of {} dimensions, J = ({}) {}", report.dimension, moments.join(", "), report.moments_unit),
        start(report),
        stability(report),
        equations(report),
        drift(report),
    ];
    let regularity = regularity(report);
    if !regularity.is_empty() {
        parts.push(labelled(regularity));
    }
    parts.join("\n\n")
}

fn start(report: &Report) -> String {
    let mut lines = vec![("spin at the start", report.spin_text(usize::MAX)), ("followed for", followed(report))];
    if let Some(warning) = &report.warning {
        let labels = std::iter::once("warning").chain(std::iter::repeat(""));
        lines.extend(labels.zip(wrapped(warning, LINE_LENGTH)));
    }
    labelled(lines)
}

fn followed(report: &Report) -> String {
    let divided = if report.most_parts > 1 {
        format!(", each divided into up to {} parts", report.most_parts)
    } else {
        String::new()
    };
    let (seconds, dt) = (number(report.seconds), report.dt_text());
    let steps = if report.steps == 1 { "1 step".to_owned() } else { format!("{} steps", report.steps) };
    format!("{seconds} s by {} in {steps} of {dt}{divided}", report.method)
}

fn stability(report: &Report) -> String {
    let found = &report.stability;
    let verdict = match found.stable {
        Some(true) => "stable".to_owned(),
        Some(false) => format!(
            "unstable: disturbances grow at {} /s, e-fold in {} s",
            number(found.growth_rate),
            number(1.0 / found.growth_rate)
        ),
        None => "open".to_owned(),
    };
    let mut lines = vec![("steady rotation", verdict)];
    let labels = std::iter::once("why").chain(std::iter::repeat(""));
    lines.extend(labels.zip(wrapped(&found.why, LINE_LENGTH)));
    if let Some(measured) = measured_growth(found) {
        lines.push(("measured growth", measured));
    }
    if found.stable.is_some() && found.disturbance == 0.0 {
        lines.push(("", "the spin is exactly steady; --disturb 0.001 shows what a push does".to_owned()));
    }
    labelled(lines)
}

/// What the disturbed run says of growth, which below the bound is nothing.
fn measured_growth(found: &StabilityReport) -> Option<String> {
    let rate = found.measured_growth_rate?;
    let run = format!("in a run disturbed by {DISTURBANCE:e}");
    Some(match (found.measured_growth_below, found.stable) {
        (None, _) => format!("{} /s, {run}", number(rate)),
        (Some(bound), Some(false)) => format!("too slow to show (below {} /s), {run}", rough(bound)),
        (Some(bound), Some(true)) => format!("does not grow (below {} /s), {run}", rough(bound)),
        (Some(bound), None) => format!("none that is exponential (below {} /s), {run}", rough(bound)),
    })
}

/// Two digits of a bound.
fn rough(bound: f64) -> String {
    number(format!("{bound:.1e}").parse().unwrap_or(bound))
}

/// A sentence in lines of at most `width` characters, broken between words.
fn wrapped(sentence: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in sentence.split(' ') {
        let line = lines.len() - 1;
        if lines[line].is_empty() {
            lines[line].push_str(word);
        } else if lines[line].chars().count() + 1 + word.chars().count() <= width {
            lines[line].push(' ');
            lines[line].push_str(word);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

fn equations(report: &Report) -> String {
    let mut table = table(&["plane", "moment", "driven by", "dω/dt now", "never by"], 1);
    for index in [2, 4] {
        if let Some(column) = table.column_mut(index) {
            column.set_cell_alignment(comfy_table::CellAlignment::Left);
        }
    }
    for equation in &report.equations {
        let drives: Vec<String> = equation
            .drives
            .iter()
            .filter(|drive| drive.coefficient != 0.0)
            .map(|drive| format!("{} {}·{}", coefficient(drive.coefficient), drive.planes[0], drive.planes[1]))
            .collect();
        table.add_row([
            equation.plane.clone(),
            number(equation.moment),
            if drives.is_empty() { "nothing".to_owned() } else { drives.join("  ") },
            number(equation.rate),
            equation.never_driven_by.join(" "),
        ]);
    }
    table.to_string()
}

/// A coefficient with its sign, in a width that suits a column.
fn coefficient(value: f64) -> String {
    if value.abs() < 5e-4 { format!("{value:+.0e}") } else { format!("{value:+.4}") }
}

fn drift(report: &Report) -> String {
    let mut table = table(&["largest relative drift", "energy", "|L|²", "L in the world", "Pfaffian", "Manakov's"], 1);
    let mut row = |method: &str, drift: &DriftReport| {
        let exponent = |value: f64| if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") };
        table.add_row([
            method.to_owned(),
            exponent(drift.energy),
            exponent(drift.angular_momentum_sq),
            exponent(drift.angular_momentum),
            drift.pfaffian.map_or_else(|| "-".to_owned(), exponent),
            exponent(drift.manakov),
        ]);
    };
    row(report.method, &report.max_relative_drift);
    for compared in &report.compared {
        row(compared.method, &compared.max_relative_drift);
    }
    table.to_string()
}

fn regularity(report: &Report) -> Vec<(&'static str, String)> {
    let mut lines = Vec::new();
    let flips = &report.flips;
    if !flips.times.is_empty() {
        let shown: Vec<String> = flips.times.iter().take(SHOWN_FLIPS).map(|&time| number(time)).collect();
        let more = if flips.times.len() > SHOWN_FLIPS { ", …" } else { "" };
        let (count, plane) = (flips.times.len(), &flips.plane);
        lines.push(("flips", format!("{count} of plane {plane}, at {}{more} s", shown.join(", "))));
    }
    if let Some(measured) = report.period.measured {
        let irregularity = flips.irregularity.unwrap_or(0.0);
        let regular = match irregularity {
            below if below < 1e-6 => "regular".to_owned(),
            small if small < 1e-3 => format!("each interval within {small:.0e} of the mean"),
            large => format!("each interval within {:.1} % of the mean", 100.0 * large),
        };
        let period = if irregularity < 1e-6 { format!("{measured:.10}") } else { number(measured) };
        lines.push(("period", format!("{period} s between every other flip, {regular}")));
    } else if flips.times.len() > 2 {
        let between = || flips.times.windows(2).map(|pair| pair[1] - pair[0]);
        let (shortest, longest) = (between().fold(f64::INFINITY, f64::min), between().fold(0.0, f64::max));
        lines.push(("between flips", format!("irregular: from {} to {} s", number(shortest), number(longest))));
    }
    if let Some(exact) = report.period.exact {
        let beside = report.period.measured.map(|measured| format!(", measured {:+.1e} off", measured / exact - 1.0));
        lines.push(("exact period", format!("{exact:.10} s by Jacobi's functions{}", beside.unwrap_or_default())));
    }
    if let Some(closed_form) = &report.closed_form {
        let (kind, error) = (closed_form.kind, closed_form.final_error);
        lines.push(("closed form", format!("{kind}; the run ends {error:.1e} off")));
    }
    lines
}

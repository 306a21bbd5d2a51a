//! Every number of a run as a table.

use std::fmt::Write;

use super::report::{Named, Report};

const AXES: [char; 6] = ['x', 'y', 'z', 'w', 'v', 'u'];

/// One line for each time: t, spins (body frame), energy, |L|², Pfaffian (in 4D), Manakov's integrals, momenta in the world
/// frame (L) and the body frame (M), attitude (R, row and column).
pub(super) fn table(report: &Report) -> String {
    let mut columns: Vec<(String, Vec<f64>)> = vec![("t".to_owned(), report.times.clone())];
    let named = |prefix: &str, series: &Named<Vec<f64>>| {
        series.0.iter().map(|(name, values)| (format!("{prefix}_{name}"), values.clone())).collect::<Vec<_>>()
    };
    columns.extend(named("omega", &report.angular_velocity));
    columns.push(("energy".to_owned(), report.energy.clone()));
    columns.push(("momentum_sq".to_owned(), report.angular_momentum_sq.clone()));
    columns.extend(report.pfaffian.iter().map(|values| ("pfaffian".to_owned(), values.clone())));
    columns.extend(named("manakov", &report.manakov));
    columns.extend(named("L", &report.angular_momentum));
    columns.extend(named("M", &report.angular_momentum_in_body));
    for row in 0..report.dimension {
        for column in 0..report.dimension {
            let values = report.rotation.iter().map(|rotation| rotation[row][column]).collect();
            columns.push((format!("R_{}{}", AXES[row], AXES[column]), values));
        }
    }
    write_table(&columns)
}

/// Columns of equal length with their headings as comma-separated values; numbers in full.
pub(super) fn write_table(columns: &[(String, Vec<f64>)]) -> String {
    let headings: Vec<&str> = columns.iter().map(|(heading, _)| heading.as_str()).collect();
    let mut text = headings.join(",") + "\n";
    for line in 0..columns.first().map_or(0, |(_, values)| values.len()) {
        for (index, (_, values)) in columns.iter().enumerate() {
            let separator = if index == 0 { "" } else { "," };
            // Writing to a string cannot fail.
            let _ = write!(text, "{separator}{}", values[line]);
        }
        text.push('\n');
    }
    text
}

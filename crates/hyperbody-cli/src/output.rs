//! Printing results: tables for people, one JSON object for programs.

use std::fmt::Display;
use std::io::{self, Write};

use comfy_table::{CellAlignment, LineStyle, Table, TableStyle};
use serde::Serialize;

use crate::failure::Failure;

/// Prints a line or more, with a line end after it.
pub(crate) fn print(text: impl Display) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    for line in text.to_string().lines() {
        // Tables fill their last column with spaces.
        writeln!(stdout, "{}", line.trim_end())?;
    }
    Ok(stdout.flush()?)
}

/// Prints a value as one JSON object on one line. Numbers that are not finite become null.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    print(as_json(value)?)
}

/// A value as one JSON object on one line, as [`print_json`] prints it.
pub(crate) fn as_json(value: &impl Serialize) -> Result<String, Failure> {
    serde_json::to_string(value).map_err(|error| Failure::Work(format!("cannot write JSON: {error}")))
}

/// Two spaces between columns and a rule under the header; nothing that gets in the way of copying.
const STYLE: TableStyle = TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

/// An empty table with a header; columns from `first_number` on are aligned to the right.
pub(crate) fn table(header: &[&str], first_number: usize) -> Table {
    let mut table = Table::new();
    table.load_style(STYLE).set_header(header);
    for column in table.column_iter_mut().skip(first_number) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// Lines of a label and a value.
pub(crate) fn labelled<'a>(lines: impl IntoIterator<Item = (&'a str, String)>) -> String {
    let lines: Vec<String> = lines.into_iter().map(|(label, value)| format!(" {label:18} {value}")).collect();
    lines.join("\n")
}

/// A number for people: six significant digits, and no minus before zero.
pub(crate) fn number(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude == 0.0 {
        "0".to_owned()
    } else if (1e-4..1e6).contains(&magnitude) {
        let decimals = (5 - magnitude.log10().floor() as i32).clamp(0, 8) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        format!("{value:.3e}")
    }
}

/// Numbers in parentheses; what is only rounding beside the largest of them, or beside one, is shown as zero.
pub(crate) fn numbers(values: &[f64]) -> String {
    let rounding = 1e-14 * values.iter().fold(1.0, |largest, value| f64::max(largest, value.abs()));
    let values: Vec<String> =
        values.iter().map(|&value| number(if value.abs() < rounding { 0.0 } else { value })).collect();
    format!("({})", values.join(", "))
}

/// A coordinate for people, to the tenth of a millimetre.
pub(crate) fn metres(value: f64) -> String {
    let text = format!("{value:.4}");
    if text == "-0.0000" { "0.0000".to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_six_digits_and_no_more() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (-9.81, "-9.81"),
            (1.0 / 3.0, "0.333333"),
            (123.456_789, "123.457"),
            (99999.96, "100000"),
            (1e-9, "1.000e-9"),
            (2.5e7, "2.500e7"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(number(value), text);
        }
        assert_eq!(metres(-1e-9), "0.0000");
    }
}

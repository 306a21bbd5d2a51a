//! Axes with round numbers on them.

use std::f64::consts::LOG10_E;
use std::ops::Range;

use hyperbody::math::scalar;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// A linear axis, or the logarithm of one to base ten.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    low: f64,
    high: f64,
    ticks: Vec<f64>,
    logarithmic: bool,
}

impl Axis {
    /// From `low` to `high` with about `count` numbers.
    pub(super) fn linear(low: f64, high: f64, count: usize) -> Self {
        Self { low, high, ticks: ticks(low, high, count), logarithmic: false }
    }

    /// From 10^`low` to 10^`high`, both whole; values are given as their logarithms.
    pub(super) fn logarithmic(low: f64, high: f64) -> Self {
        let step = ((high - low) / 9.0).ceil().max(1.0);
        let count = ((high - low) / step).floor() as i32;
        let ticks = (0..=count).map(|index| low + f64::from(index) * step).collect();
        Self { low, high, ticks, logarithmic: true }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let part = (value - self.low) / (self.high - self.low);
        from + (f64::from(to - from) * part).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        // No lines between the numbers.
        if hint.weight().allow_light_points() { Vec::new() } else { self.ticks.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        if self.logarithmic { power_text(value.round() as i32) } else { tick_text(*value) }
    }
}

/// Round numbers between two ends, about `count` of them.
pub(super) fn ticks(from: f64, to: f64, count: usize) -> Vec<f64> {
    let step = (to - from) / count as f64;
    if !(step.is_normal() && step > f64::EPSILON * from.abs().max(to.abs())) {
        // Too narrow a range for numbers in between.
        return vec![from, to];
    }
    // Rounding may choose the power below a whole one; ten times that is among the factors.
    let power = scalar::pow(10.0, (scalar::ln(step) * LOG10_E).floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power).into_iter().find(|&s| s >= step).unwrap_or(step);
    let (first, last) = ((from / step - 1e-9).ceil() as i64, (to / step + 1e-9).floor() as i64);
    (first..=last).map(|index| index as f64 * step).collect()
}

/// A number on an axis: as short as the ticks allow.
pub(super) fn tick_text(value: f64) -> String {
    let rounded = (value * 1e9).round() / 1e9;
    if rounded.abs() >= 1e5 || (rounded != 0.0 && rounded.abs() < 1e-4) {
        return format!("{value:e}").replace('-', "−");
    }
    format!("{}", rounded + 0.0).replace('-', "−")
}

/// 10 to a whole power: "10⁻¹²".
fn power_text(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let sign = if exponent < 0 { "⁻" } else { "" };
    let digits = exponent.unsigned_abs().to_string();
    let digits: String =
        digits.chars().filter_map(|digit| digit.to_digit(10)).map(|digit| DIGITS[digit as usize]).collect();
    format!("10{sign}{digits}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(-1.5, 1.5, 6), [-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5]);
        assert_eq!(ticks(0.0, 60.0, 6), [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
        assert_eq!(ticks(0.0, 0.35, 5).len(), 4);
        assert_eq!(ticks(0.0, 5e-324, 8), [0.0, 5e-324]);
        assert_eq!(ticks(1.0, 1.0 + 1e-15, 6), [1.0, 1.0 + 1e-15]);
        assert_eq!(tick_text(-0.5), "−0.5");
        assert_eq!(tick_text(0.1 + 0.2), "0.3");
        assert_eq!(tick_text(-0.0), "0");
        assert_eq!(power_text(-12), "10⁻¹²");
        assert_eq!(power_text(0), "10⁰");
    }
}

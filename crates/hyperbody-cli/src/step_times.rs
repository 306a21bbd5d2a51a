//! How long steps take.

use serde::Serialize;

/// Milliseconds per step over a run; zero if there was no step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct StepTimes {
    pub(crate) median: f64,
    pub(crate) p95: f64,
    pub(crate) max: f64,
}

impl StepTimes {
    /// The figures of a list of seconds, which is sorted on the way.
    pub(crate) fn from_seconds(seconds: &mut [f64]) -> Self {
        seconds.sort_unstable_by(f64::total_cmp);
        Self { median: quantile_ms(seconds, 0.5), p95: quantile_ms(seconds, 0.95), max: quantile_ms(seconds, 1.0) }
    }
}

/// The smallest of the sorted values that at least `share` of all are not above, in milliseconds.
pub(crate) fn quantile_ms(sorted_seconds: &[f64], share: f64) -> f64 {
    let rank = (share * sorted_seconds.len() as f64).ceil() as usize;
    sorted_seconds.get(rank.saturating_sub(1)).map_or(0.0, |seconds| seconds * 1e3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_values_of_the_list() {
        let mut seconds: Vec<f64> = (1..=100).rev().map(|k| f64::from(k) * 1e-3).collect();
        let times = StepTimes::from_seconds(&mut seconds);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-12;
        assert!(close(times.median, 50.0) && close(times.p95, 95.0) && close(times.max, 100.0), "{times:?}");
        assert_eq!(StepTimes::from_seconds(&mut []), StepTimes::default());
    }
}

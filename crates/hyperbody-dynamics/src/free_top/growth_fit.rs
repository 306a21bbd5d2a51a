//! The growth rate of a recorded disturbance, also where it oscillates while it grows.
//!
//! Two sizes and the time between them give the rate of a disturbance that only grows; one that oscillates, too, is then
//! off by whatever the oscillation was doing at both ends. Prony's method (1795) sees through that: a sum of two
//! exponentials, real or complex, satisfies s(t + 2τ) = α s(t + τ) + β s(t) in every component, so α and β follow by least
//! squares from all components at all times, and the exponentials from z² = αz + β. What is left is the error of the
//! modes that stay bounded, which are small beside a growing one.

use hyperbody_math::{Bivector, scalar};

/// Deviations kept at most; then every other one is dropped.
const MAX_KEPT: usize = 512;

/// The lag τ is the duration divided by this: the recurrence is looked at over a quarter of the record at a time.
const LAGS: usize = 8;

/// Misfit of a single exponential, relative, up to which the record is taken for one.
const ONE_MODE: f64 = 1e-2;

/// A growing disturbance, step by step.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Track<const N: usize> {
    kept: Vec<Bivector<N>>,
    /// Steps from one kept deviation to the next.
    stride: u64,
    /// Steps so far.
    count: u64,
}

impl<const N: usize> Default for Track<N> {
    fn default() -> Self {
        Self { kept: Vec::new(), stride: 1, count: 0 }
    }
}

impl<const N: usize> Track<N> {
    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The deviation after one more step.
    pub(crate) fn push(&mut self, deviation: Bivector<N>) {
        if self.count.is_multiple_of(self.stride) {
            if self.kept.len() == MAX_KEPT {
                let mut index = 0;
                self.kept.retain(|_| {
                    index += 1;
                    index % 2 == 1
                });
                self.stride *= 2;
            }
            if self.count.is_multiple_of(self.stride) {
                self.kept.push(deviation);
            }
        }
        self.count += 1;
    }

    /// Growth of the fastest exponential in one step; zero with fewer than two deviations.
    pub(crate) fn growth_per_step(&self) -> f64 {
        let lag = (self.kept.len().saturating_sub(1) / LAGS).max(1);
        if self.kept.len() <= lag {
            return 0.0;
        }
        let factor = match one_mode(&self.kept, lag) {
            (factor, misfit) if misfit <= ONE_MODE || self.kept.len() <= 2 * lag => factor,
            (factor, _) => two_modes(&self.kept, lag).unwrap_or(factor),
        };
        scalar::ln(factor) / (lag as f64 * self.stride as f64)
    }
}

/// The best z of s(t + τ) = z s(t), its size, and the relative misfit. Every time has the same weight.
fn one_mode<const N: usize>(track: &[Bivector<N>], lag: usize) -> (f64, f64) {
    let pairs = || track.iter().zip(&track[lag..]).map(|(now, then)| (now, then, 1.0 / then.norm_sq()));
    let (mut across, mut along) = (0.0, 0.0);
    for (now, then, weight) in pairs() {
        across += weight * now.dot(then);
        along += weight * now.norm_sq();
    }
    let factor = across / along;
    let (mut misfit, mut count) = (0.0, 0.0);
    for (now, then, weight) in pairs() {
        misfit += weight * (*then - *now * factor).norm_sq();
        count += 1.0;
    }
    (factor.abs(), f64::sqrt(misfit / count))
}

/// The larger root, in size, of z² = αz + β for the best α and β; `None` where the record does not tell two modes apart.
fn two_modes<const N: usize>(track: &[Bivector<N>], lag: usize) -> Option<f64> {
    // Normal equations of then = α·next + β·now.
    let (mut nn, mut mm, mut nm, mut nt, mut mt) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for ((now, next), then) in track.iter().zip(&track[lag..]).zip(&track[2 * lag..]) {
        let weight = 1.0 / then.norm_sq();
        nn += weight * now.norm_sq();
        mm += weight * next.norm_sq();
        nm += weight * now.dot(next);
        nt += weight * now.dot(then);
        mt += weight * next.dot(then);
    }
    let determinant = nn * mm - nm * nm;
    if determinant <= 1e-12 * nn * mm {
        return None;
    }
    let alpha = (nn * mt - nm * nt) / determinant;
    let beta = (mm * nt - nm * mt) / determinant;
    let discriminant = alpha * alpha + 4.0 * beta;
    Some(if discriminant < 0.0 { (-beta).sqrt() } else { 0.5 * (alpha.abs() + discriminant.sqrt()) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track_of(deviation: impl Fn(f64) -> Bivector<4>, steps: u32) -> Track<4> {
        let mut track = Track::default();
        for step in 0..steps {
            track.push(deviation(f64::from(step)));
        }
        track
    }

    fn pair(x: f64, y: f64) -> Bivector<4> {
        Bivector::plane(0, 1, x) + Bivector::plane(2, 3, y)
    }

    #[test]
    fn exponentials_are_found_alone_in_pairs_and_oscillating() {
        for steps in [60, 500, 5000] {
            let rate = 7.0 / f64::from(steps);
            let alone = track_of(|t| pair((rate * t).exp(), -2.0 * (rate * t).exp()), steps);
            assert!((alone.growth_per_step() / rate - 1.0).abs() < 1e-9, "{}", alone.growth_per_step());
            let both = track_of(|t| pair((rate * t).exp(), 3.0 * (0.4 * rate * t).exp()), steps);
            assert!((both.growth_per_step() / rate - 1.0).abs() < 1e-6, "{}", both.growth_per_step());
            let turning =
                track_of(|t| pair((3.0 * rate * t).sin(), 1.7 * (3.0 * rate * t).cos()) * (rate * t).exp(), steps);
            assert!((turning.growth_per_step() / rate - 1.0).abs() < 1e-6, "{}", turning.growth_per_step());
            // In one plane, so that the size passes through zero.
            let beating = track_of(|t| pair((0.8 * rate * t + 0.3).cos() * (rate * t).exp(), 0.0), steps);
            assert!((beating.growth_per_step() / rate - 1.0).abs() < 1e-6, "{}", beating.growth_per_step());
        }
    }

    #[test]
    fn long_records_stay_small() {
        let track = track_of(|t| pair((1e-5 * t).exp(), 1.0), 1_000_000);
        assert!(track.kept.len() <= MAX_KEPT && track.stride == 2048, "{} every {}", track.kept.len(), track.stride);
        assert_eq!(track_of(|_| pair(1.0, 0.0), 1).growth_per_step(), 0.0);
    }
}

//! Flips: when a spin turns over, and how regularly.
//!
//! In the Dzhanibekov effect the momentum of the plane that the body was spun in changes sign again and again: half a
//! period between flips in 3D, exactly. From 4D on the motion has several periods, and the intervals may vary.

use hyperbody_math::{Bivector, planes};

use super::top::FreeTop;

/// Finds the sign changes of one momentum component in a run.
#[derive(Clone, Debug)]
pub struct FlipDetector {
    plane: (usize, usize),
    previous: Option<Sample>,
    times: Vec<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Sample {
    time: f64,
    value: f64,
    rate: f64,
}

/// The flips of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Flips {
    /// The plane whose momentum changes sign.
    pub plane: (usize, usize),
    /// Times of the sign changes in seconds.
    pub times: Vec<f64>,
    /// Mean time from a flip to the next but one; `None` with fewer than three flips.
    pub period: Option<f64>,
    /// Largest deviation of the time between flips from its mean, relative to it; `None` with fewer than three flips.
    pub irregularity: Option<f64>,
}

impl FlipDetector {
    /// A detector for plane (i, j).
    #[must_use]
    pub fn new(i: usize, j: usize) -> Self {
        Self { plane: (i, j), previous: None, times: Vec::new() }
    }

    /// A detector for the plane in which `momentum` is largest; the first of equals.
    #[must_use]
    pub fn for_main_plane<const N: usize>(momentum: &Bivector<N>) -> Self {
        let mut main = (0, 1);
        for (i, j) in planes::all(N) {
            if momentum.get(i, j).abs() > momentum.get(main.0, main.1).abs() {
                main = (i, j);
            }
        }
        Self::new(main.0, main.1)
    }

    /// Takes the momentum (body frame) at a later time into account. The time of a sign change is found on the cubic
    /// through values and rates at both ends, to fourth order in the time between samples.
    pub fn observe<const N: usize>(&mut self, top: &FreeTop<N>, time: f64, momentum: &Bivector<N>) {
        let (i, j) = self.plane;
        let value = momentum.get(i, j);
        if value == 0.0 {
            // Exactly on the change: the next sample finds it, on the side that it goes to.
            return;
        }
        let sample = Sample { time, value, rate: top.momentum_rate(momentum).get(i, j) };
        if let Some(previous) = self.previous
            && (previous.value < 0.0) != (value < 0.0)
        {
            self.times.push(zero_between(previous, sample));
        }
        self.previous = Some(sample);
    }

    /// The flips so far.
    #[must_use]
    pub fn flips(&self) -> Flips {
        let mut flips = Flips { plane: self.plane, times: self.times.clone(), period: None, irregularity: None };
        if let [first, _, .., last] = self.times[..] {
            let intervals = (self.times.len() - 1) as f64;
            let half_period = (last - first) / intervals;
            let worst = self.times.windows(2).map(|pair| (pair[1] - pair[0] - half_period).abs()).fold(0.0, f64::max);
            flips.period = Some(2.0 * half_period);
            flips.irregularity = Some(worst / half_period);
        }
        flips
    }
}

/// The zero of the cubic Hermite interpolant between samples of opposite sign, by bisection.
fn zero_between(from: Sample, to: Sample) -> f64 {
    let h = to.time - from.time;
    let value_at = |s: f64| {
        let (r, s2) = (1.0 - s, s * s);
        let r2 = r * r;
        from.value * r2 * (1.0 + 2.0 * s) + to.value * s2 * (1.0 + 2.0 * r) + h * r * s * (from.rate * r - to.rate * s)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (value_at(middle) < 0.0) == (from.value < 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    from.time + h * 0.5 * (low + high)
}

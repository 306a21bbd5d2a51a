//! Integrals of smooth functions of one variable.

use hyperbody_math::scalar;

/// Halvings of an interval at most; the functions integrated here are analytic, and few need any.
const MAX_DEPTH: u32 = 24;

/// Nodes on [−1, 1] of the Kronrod rule with 15 points: exact for polynomials up to degree 22. Every second one is a
/// node of the Gauss rule with 7 points, exact up to degree 13 (A. S. Kronrod, 1965; R. Piessens et al., QUADPACK, 1983).
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];

const KRONROD_WEIGHTS: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_55,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_83,
];

const GAUSS_WEIGHTS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_7, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

/// ∫ f over [0, 1]. An interval is halved until the two rules differ by at most `tolerance` there: the error of the
/// better rule, which counts, is smaller by the factor that 15 points gain over 7, several orders of magnitude for an
/// analytic function.
pub(crate) fn integrate(tolerance: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    in_halves(tolerance, MAX_SMOOTH_INTERVALS, &mut f)
}

/// Intervals looked at by [`integrate`] at most: an analytic function takes a few dozen, and what takes more is noise.
const MAX_SMOOTH_INTERVALS: usize = 512;

/// Intervals looked at by [`integrate_between`] at most: an integrand that is noisier than the tolerance ends there.
const MAX_INTERVALS: usize = 4096;

/// ∫ f from `low` to `high`, to within about `tolerance`; f may go to zero like a root at both ends, and have kinks and steps
/// in between. With x = low + (high − low)(1 − cos πs)/2 a root at an end becomes analytic.
pub(crate) fn integrate_between(low: f64, high: f64, tolerance: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    use std::f64::consts::PI;
    let width = high - low;
    if width.is_nan() || width <= 0.0 {
        return 0.0;
    }
    let mut g = |s: f64| {
        let (sin, cos) = scalar::sin_cos(PI * s);
        f(low + 0.5 * width * (1.0 - cos)) * (0.5 * PI * width * sin)
    };
    in_halves(tolerance, MAX_INTERVALS, &mut g)
}

/// ∫ f over [0, 1] by halving intervals, `most` of them at most.
fn in_halves(tolerance: f64, most: usize, f: &mut impl FnMut(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    let mut intervals = vec![(0.5, 0.5, 0)];
    for _ in 0..most {
        let Some((centre, half_width, depth)) = intervals.pop() else { break };
        let (gauss, kronrod) = both_rules(f, centre, half_width);
        if (gauss - kronrod).abs() <= tolerance || depth >= MAX_DEPTH {
            sum += kronrod;
        } else {
            let quarter = 0.5 * half_width;
            intervals.push((centre - quarter, quarter, depth + 1));
            intervals.push((centre + quarter, quarter, depth + 1));
        }
    }
    // What the bound has left, by the coarse rule.
    intervals.into_iter().fold(sum, |sum, (centre, half_width, _)| sum + both_rules(f, centre, half_width).1)
}

fn both_rules(f: &mut impl FnMut(f64) -> f64, centre: f64, half_width: f64) -> (f64, f64) {
    let middle = f(centre);
    let mut gauss = GAUSS_WEIGHTS[3] * middle;
    let mut kronrod = KRONROD_WEIGHTS[7] * middle;
    for i in 0..7 {
        let pair = f(centre - half_width * NODES[i]) + f(centre + half_width * NODES[i]);
        kronrod += KRONROD_WEIGHTS[i] * pair;
        if i % 2 == 1 {
            gauss += GAUSS_WEIGHTS[i / 2] * pair;
        }
    }
    (gauss * half_width, kronrod * half_width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_exact_to_their_degree() {
        for power in 0..=22 {
            let (gauss, kronrod) = both_rules(&mut |x| x.powi(power), 0.5, 0.5);
            let exact = 1.0 / f64::from(power + 1);
            assert!((kronrod / exact - 1.0).abs() < 1e-14, "{power}");
            assert_eq!((gauss / exact - 1.0).abs() < 1e-14, power <= 13, "{power}");
        }
    }

    #[test]
    fn integrals_are_those_of_the_tables() {
        assert!((integrate(1e-9, |x| 4.0 / (1.0 + x * x)) - std::f64::consts::PI).abs() < 1e-15);
        let half_disc = integrate_between(-1.0, 1.0, 1e-12, |x| (1.0 - x * x).max(0.0).sqrt());
        assert!((half_disc - 0.5 * std::f64::consts::PI).abs() < 1e-13);
        let step = integrate_between(-1.0, 2.0, 1e-9, |x| if x < 0.3 { 1.0 } else { 0.0 });
        assert!((step - 1.3).abs() < 1e-6, "{step}");
        // A square root that ends at the end of the interval.
        assert!((integrate(1e-12, |x| (1.0 - x).sqrt()) - 2.0 / 3.0).abs() < 1e-11);
    }
}

//! Functions of one variable by pieces, as polynomials that go through their values at a few nodes.
//!
//! On each panel [a, b] the variable is θ in [0, 1] with x = a + (b − a) sin²(πθ/2), in which roots at the ends are analytic; the nodes
//! are those of Chebyshev in θ. Panels next to each other differ in length by [`GROWTH`] at most, so that what is not smooth beyond the
//! end of a panel is never near to it, in parts of the panel.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

use hyperbody_math::scalar;

/// Nodes on a panel. With something not smooth beyond the panel beside, ρ = 3.3 in the bound ρ^(−nodes) of Chebyshev series: 1e-12.
pub(super) const NODES: usize = 24;

/// Breaks nearer to each other than this are one. What happens in between is as small as it is short.
pub(super) const NEAREST: f64 = 1e-10;

/// A panel is at most this many times as long as those beside it.
const GROWTH: f64 = 2.5;

/// Nodes, and integrals of the polynomials that are one at one node and zero at the others.
struct Rule {
    /// θ of each node, ascending.
    nodes: [f64; NODES],
    /// Barycentric weights (H. E. Salzer, 1972).
    barycentric: [f64; NODES],
    /// By polynomial: over [0, 1].
    whole: [f64; NODES],
    /// By node and polynomial: from 0 to the node.
    partial: [[f64; NODES]; NODES],
}

fn rule() -> &'static Rule {
    static RULE: OnceLock<Rule> = OnceLock::new();
    RULE.get_or_init(|| {
        let angle = |j: usize| PI * (1.0 - (j as f64 + 0.5) / NODES as f64);
        let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        // ∫ T_k from −1 to cos φ.
        let integral = |k: usize, phi: f64| {
            let at = |order: usize| (scalar::cos(order as f64 * phi) - sign(order)) / order as f64;
            match k {
                0 => at(1),
                1 => 0.25 * (scalar::cos(2.0 * phi) - 1.0),
                _ => 0.5 * (at(k + 1) - at(k - 1)),
            }
        };
        // Half of it for θ in place of x.
        let of_polynomial = |j: usize, phi: f64| {
            let terms = (0..NODES).map(|k| {
                let share = if k == 0 { 0.5 } else { 1.0 } / NODES as f64;
                share * scalar::cos(k as f64 * angle(j)) * integral(k, phi)
            });
            terms.sum::<f64>()
        };
        Rule {
            nodes: std::array::from_fn(|j| 0.5 * (1.0 + scalar::cos(angle(j)))),
            barycentric: std::array::from_fn(|j| sign(j) * scalar::sin(angle(j))),
            whole: std::array::from_fn(|j| of_polynomial(j, 0.0)),
            partial: std::array::from_fn(|i| std::array::from_fn(|j| of_polynomial(j, angle(i)))),
        }
    })
}

/// The places of the nodes on a panel, and dx/dθ there.
fn places(low: f64, high: f64) -> [(f64, f64); NODES] {
    rule().nodes.map(|theta| {
        let (sin, cos) = scalar::sin_cos(FRAC_PI_2 * theta);
        (low + (high - low) * sin * sin, PI * (high - low) * sin * cos)
    })
}

/// ∫ f over a panel.
pub(super) fn integral(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let terms = places(low, high).into_iter().zip(rule().whole).map(|((x, slope), weight)| weight * slope * f(x));
    terms.sum()
}

/// The values ∫ f from `low` to each node of the panel, and to its end.
pub(super) fn integrals(low: f64, high: f64, f: impl Fn(f64) -> f64) -> ([f64; NODES], f64) {
    let terms = places(low, high).map(|(x, slope)| slope * f(x));
    let sum = |weights: &[f64; NODES]| weights.iter().zip(&terms).map(|(w, t)| w * t).sum::<f64>();
    (std::array::from_fn(|i| sum(&rule().partial[i])), sum(&rule().whole))
}

/// The value at x of the polynomial with these values at the nodes of a panel.
pub(super) fn interpolated(low: f64, high: f64, values: &[f64; NODES], x: f64) -> f64 {
    let (below, above) = ((x - low).max(0.0), (high - x).max(0.0));
    let theta = scalar::atan2(below.sqrt(), above.sqrt()) / FRAC_PI_2;
    let (mut sum, mut weights) = (0.0, 0.0);
    for ((node, weight), value) in rule().nodes.iter().zip(&rule().barycentric).zip(values) {
        let distance = theta - node;
        if distance == 0.0 {
            return *value;
        }
        sum += weight / distance * value;
        weights += weight / distance;
    }
    sum / weights
}

/// Breaks in order, and of such as are nearer to each other than `nearest` one.
pub(super) fn in_order(mut breaks: Vec<f64>, nearest: f64) -> Vec<f64> {
    breaks.sort_unstable_by(f64::total_cmp);
    breaks.dedup_by(|later, earlier| *later - *earlier < nearest);
    breaks
}

/// The ends of panels from `low` to `high` that begin and end at all breaks in between. Breaks beyond count for the lengths.
pub(super) fn graded(breaks: &[f64], [low, high]: [f64; 2]) -> Vec<f64> {
    if high - low < NEAREST {
        return Vec::new();
    }
    let inside = breaks.iter().copied().filter(|x| *x > low + NEAREST && *x < high - NEAREST);
    let mut ends: Vec<f64> = std::iter::once(low).chain(inside).chain([high]).collect();
    let beyond = |from: f64, x: &f64| Some((x - from).abs()).filter(|distance| *distance >= NEAREST);
    let before = breaks.iter().filter(|x| **x < low).filter_map(|x| beyond(low, x)).fold(f64::INFINITY, f64::min);
    let after = breaks.iter().filter(|x| **x > high).filter_map(|x| beyond(high, x)).fold(f64::INFINITY, f64::min);
    loop {
        let lengths: Vec<f64> = ends.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mut split = vec![low];
        for (i, &length) in lengths.iter().enumerate() {
            let left = if i == 0 { before } else { lengths[i - 1] };
            let right = lengths.get(i + 1).copied().unwrap_or(after);
            if length > GROWTH * left.min(right) {
                split.push(if left < right {
                    ends[i] + 0.75 * GROWTH * left
                } else {
                    ends[i + 1] - 0.75 * GROWTH * right
                });
            }
            split.push(ends[i + 1]);
        }
        if split.len() == ends.len() {
            return ends;
        }
        ends = split;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_at_the_ends_are_analytic() {
        let half_disc = |x: f64| ((1.0 - x) * (1.0 + x)).max(0.0).sqrt();
        let (values, whole) = integrals(-1.0, 1.0, half_disc);
        assert!((whole - FRAC_PI_2).abs() < 1e-13 && (integral(-1.0, 1.0, half_disc) - FRAC_PI_2).abs() < 1e-13);
        for x in [-1.0, -0.999, -0.3, 0.0, 0.77, 1.0] {
            let expected = 0.5 * (x * half_disc(x) + x.asin() + FRAC_PI_2);
            let found = interpolated(-1.0, 1.0, &values, x);
            assert!((found - expected).abs() < 1e-13, "{found} for {expected} at {x}");
        }
    }

    #[test]
    fn panels_grow_slowly() {
        let ends = graded(&[-1.0, 0.0, 0.5, 0.500_001, 1.000_01], [0.0, 1.0]);
        let lengths: Vec<f64> = ends.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(lengths.windows(2).all(|pair| pair[0] <= GROWTH * pair[1] && pair[1] <= GROWTH * pair[0]), "{ends:?}");
        assert!(ends.contains(&0.5) && ends.contains(&0.500_001) && lengths[lengths.len() - 1] <= 4e-5, "{ends:?}");
        assert!(ends.len() < 60, "{}", ends.len());
    }
}

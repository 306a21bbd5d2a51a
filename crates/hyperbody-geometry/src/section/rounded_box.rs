//! Volumes of sections of rounded boxes.
//!
//! A point belongs to the box with half-extents h_i rounded by r if Σ (|x_i| − h_i)₊² ≤ r². What lies across one axis at x_K = t is
//! such a box of one dimension less, with r² less (|t| − h_K)₊² for r²; so the volume of the section by n·x = c is an integral over t
//! of those with c − n_K t for c, down to two dimensions, where it is a chord. The two axes that see the hyperplane most
//! steeply are left for the end, so that nothing is divided by a small number.

use hyperbody_math::Vector;

use crate::quadrature::integrate_between;

/// Error of an inner integral, in parts of that of the outer one.
const INNER_SHARE: f64 = 0.1;

/// One axis of a rounded box and of a hyperplane.
#[derive(Clone, Copy)]
struct Axis {
    half_extent: f64,
    /// Component of the normal, made ≥ 0: the box is the same from both sides.
    slope: f64,
}

/// The volume (m^(N−1)) of the section of a rounded box by the hyperplane of all p with normal·p = offset, to within about
/// `tolerance`. The normal is a unit vector.
pub(super) fn section<const N: usize>(
    half_extents: Vector<N>,
    radius: f64,
    normal: Vector<N>,
    offset: f64,
    tolerance: f64,
) -> f64 {
    let axis = |i: usize| Axis { half_extent: half_extents[i], slope: normal[i].abs() };
    let mut axes: [Axis; N] = std::array::from_fn(axis);
    axes.sort_by(|a, b| b.slope.total_cmp(&a.slope));
    density(&axes, radius * radius, offset, tolerance)
}

/// The volume of all points of the rounded box with Σ slope_i x_i between `offset` and `offset + d`, divided by d → 0. Slopes descend.
fn density(axes: &[Axis], radius_sq: f64, offset: f64, tolerance: f64) -> f64 {
    let (last, rest) = match axes {
        [] => return 0.0,
        [only] => {
            let reach = (only.half_extent + radius_sq.sqrt()) * only.slope;
            return if offset.abs() < reach { only.slope.recip() } else { 0.0 };
        }
        [first, second] => return chord([*first, *second], radius_sq, offset),
        [rest @ .., last] => (last, rest),
    };
    let radius = radius_sq.sqrt();
    // Where the rest reaches the hyperplane at all.
    let slope = rest.iter().map(|axis| axis.slope * axis.slope).sum::<f64>().sqrt();
    let reach = rest.iter().map(|axis| axis.slope * axis.half_extent).sum::<f64>() + radius * slope;
    let end = last.half_extent + radius;
    let (low, high) = if last.slope * end > reach * 1e-12 {
        (((offset - reach) / last.slope).max(-end), ((offset + reach) / last.slope).min(end))
    } else {
        (-end, end)
    };
    if high.is_nan() || high <= low {
        return 0.0;
    }
    let inner = INNER_SHARE * tolerance / (high - low);
    let part = |low: f64, high: f64| {
        integrate_between(low, high, tolerance, |t| {
            let out = (t.abs() - last.half_extent).max(0.0);
            density(rest, (radius - out) * (radius + out), offset - last.slope * t, inner)
        })
    };
    // The sides where the box is flat and where it is round meet with a step in the curvature.
    let [from, to] = [-last.half_extent, last.half_extent].map(|step| step.clamp(low, high));
    part(low, from) + part(from, to) + part(to, high)
}

/// Length of the chord of a rounded rectangle over the length of the slopes: of the cross of two rectangles and the four discs in its
/// corners, whose chords make one.
fn chord(axes: [Axis; 2], radius_sq: f64, offset: f64) -> f64 {
    if radius_sq <= 0.0 && axes.iter().any(|axis| axis.half_extent <= 0.0) {
        return 0.0;
    }
    let radius = radius_sq.max(0.0).sqrt();
    let slope = (axes[0].slope * axes[0].slope + axes[1].slope * axes[1].slope).sqrt();
    let normal = axes.map(|axis| axis.slope / slope);
    let foot = offset / slope;
    // Points of the line are foot·normal + s·(−n₁, n₀).
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut meet = |low: f64, high: f64| {
        if low < high {
            (least, most) = (least.min(low), most.max(high));
        }
    };
    for wide in [0, 1] {
        let half = [0, 1].map(|i| axes[i].half_extent + if i == wide { radius } else { 0.0 });
        let [x, y] = [(-normal[1], normal[0] * foot, half[0]), (normal[0], normal[1] * foot, half[1])].map(within);
        meet(x.0.max(y.0), x.1.min(y.1));
    }
    for corner in 0..4 {
        let sign = |i: usize| if corner >> i & 1 == 0 { axes[i].half_extent } else { -axes[i].half_extent };
        let [x, y] = [sign(0), sign(1)];
        let distance = normal[0] * x + normal[1] * y - foot;
        let left = radius_sq - distance * distance;
        if left > 0.0 {
            let along = normal[0] * y - normal[1] * x;
            meet(along - left.sqrt(), along + left.sqrt());
        }
    }
    (most - least).max(0.0) / slope
}

/// For which s |start + s·step| ≤ half.
fn within((step, start, half): (f64, f64, f64)) -> (f64, f64) {
    if step == 0.0 {
        return if start.abs() <= half { (f64::NEG_INFINITY, f64::INFINITY) } else { (0.0, 0.0) };
    }
    let ends = [(-half - start) / step, (half - start) / step];
    (ends[0].min(ends[1]), ends[0].max(ends[1]))
}

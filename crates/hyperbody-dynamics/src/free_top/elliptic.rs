//! Elliptic integrals and Jacobi's functions of real arguments.
//!
//! K by the arithmetic-geometric mean (C. Gauss, 1799), sn, cn, dn by descending Landen transformations along it
//! (R. Bulirsch, 1965), incomplete integrals of the first and third kind by Carlson's symmetric forms and duplication
//! (B. Carlson, 1995). Everything takes the complementary parameter m₁ = 1 − k² instead of the modulus k: near the
//! separatrix k² rounds to one, and all that is left of the motion is in m₁.

use std::f64::consts::PI;

use hyperbody_math::scalar;

/// Steps after which the quadratically convergent mean has long settled, even from m₁ = 1e-300.
const MAX_STEPS: usize = 16;

/// Steps after which duplication, which gains a factor of four each, has settled for any argument.
const MAX_DUPLICATIONS: u32 = 64;

/// The complete integral of the first kind K: a quarter period of sn, for 0 ≤ m₁ ≤ 1. Infinite for m₁ = 0.
#[must_use]
pub fn complete_first(m1: f64) -> f64 {
    if m1 <= 0.0 {
        return f64::INFINITY;
    }
    let (mut a, mut b) = (1.0, m1.sqrt());
    for _ in 0..MAX_STEPS {
        if (a - b).abs() <= f64::EPSILON * a {
            break;
        }
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    PI / (a + b)
}

/// Jacobi's sn, cn and dn of `u`, for 0 ≤ m₁ ≤ 1; hyperbolic functions at m₁ = 0, sine and cosine at m₁ = 1.
#[must_use]
pub fn jacobi(u: f64, m1: f64) -> (f64, f64, f64) {
    if m1 <= 0.0 {
        let (e, f) = (scalar::exp(u.min(700.0)), scalar::exp((-u).min(700.0)));
        let sech = 2.0 / (e + f);
        return ((e - f) / (e + f), sech, sech);
    }
    let mut a = [1.0; MAX_STEPS];
    let mut geometric = [0.0; MAX_STEPS];
    let (mut b, mut mean, mut last) = (m1.sqrt(), 1.0, 0);
    for step in 0..MAX_STEPS {
        last = step;
        a[step] = mean;
        geometric[step] = b;
        let settled = (mean - b).abs() <= 1e-9 * mean;
        (mean, b) = (0.5 * (mean + b), (mean * b).sqrt());
        if settled {
            break;
        }
    }
    let (sine, cosine) = scalar::sin_cos(mean * u);
    if sine == 0.0 {
        return (0.0, cosine, 1.0);
    }
    // Back up the chain: `scaled` is the mean times the cotangent of the amplitude, and dn follows by a ratio without
    // cancellation.
    let (mut scaled, mut dn, mut finer_mean) = (mean * cosine / sine, 1.0, mean);
    for step in (0..=last).rev() {
        let square = scaled * scaled / finer_mean;
        scaled *= dn;
        dn = (geometric[step] + square) / (a[step] + square);
        finer_mean = a[step];
    }
    let sn = (1.0 / (scaled * scaled + 1.0).sqrt()).copysign(sine);
    (sn, scaled * sn, dn)
}

/// The incomplete integral of the first kind F(φ), φ in radians, for 0 ≤ m₁ ≤ 1: the inverse of the amplitude of
/// [`jacobi`]. Infinite from a quarter turn on for m₁ = 0.
#[must_use]
pub fn incomplete_first(phi: f64, m1: f64) -> f64 {
    let half_turns = (phi / PI).round();
    let (sin, cos) = scalar::sin_cos(phi - half_turns * PI);
    let within = sin * carlson_rf(cos * cos, cos * cos + m1 * sin * sin, 1.0);
    if half_turns == 0.0 { within } else { within + 2.0 * half_turns * complete_first(m1) }
}

/// The part of the incomplete integral of the third kind that lies within a quarter turn:
/// ∫ dφ / ((1 + ν sin²φ) √(1 − k² sin²φ)) from 0 to the angle in [−π/2, π/2] with the given sine and cosine, for ν ≥ 0 and
/// 0 ≤ m₁ ≤ 1.
#[must_use]
pub fn third_within_quarter(sin: f64, cos: f64, nu: f64, m1: f64) -> f64 {
    let (x, s2) = (cos * cos, sin * sin);
    let y = x + m1 * s2;
    sin * (carlson_rf(x, y, 1.0) - nu * s2 / 3.0 * carlson_rj(x, y, 1.0, 1.0 + nu * s2))
}

/// Carlson's R_F(x, y, z) for x, y, z ≥ 0, at most one of them zero; infinite for two zeros.
#[must_use]
pub fn carlson_rf(x: f64, y: f64, z: f64) -> f64 {
    if [x, y, z].iter().filter(|&&v| v == 0.0).count() > 1 {
        return f64::INFINITY;
    }
    let (mut x, mut y, mut z) = (x, y, z);
    let mut mean = (x + y + z) / 3.0;
    // The series drops terms of sixth order in the relative spread.
    let mut spread = 400.0 * (mean - x).abs().max((mean - y).abs()).max((mean - z).abs());
    for _ in 0..MAX_DUPLICATIONS {
        if spread < mean {
            break;
        }
        let (rx, ry, rz) = (x.sqrt(), y.sqrt(), z.sqrt());
        let lambda = rx * ry + rx * rz + ry * rz;
        (x, y, z) = (0.25 * (x + lambda), 0.25 * (y + lambda), 0.25 * (z + lambda));
        mean = 0.25 * (mean + lambda);
        spread *= 0.25;
    }
    let (dx, dy) = (1.0 - x / mean, 1.0 - y / mean);
    let dz = -(dx + dy);
    let (e2, e3) = (dx * dy - dz * dz, dx * dy * dz);
    (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0) / mean.sqrt()
}

/// Carlson's R_C(1, y) for y > 0.
fn carlson_rc_of_one(y: f64) -> f64 {
    let (mut x, mut y) = (1.0, y);
    for _ in 0..MAX_DUPLICATIONS {
        let mean = (x + 2.0 * y) / 3.0;
        let s = (y - mean) / mean;
        if s.abs() < 4e-3 {
            let series = 3.0 / 10.0 + s * (1.0 / 7.0 + s * (3.0 / 8.0 + s * (9.0 / 22.0 + s * (159.0 / 208.0))));
            return (1.0 + s * s * series) / mean.sqrt();
        }
        let lambda = 2.0 * (x * y).sqrt() + y;
        (x, y) = (0.25 * (x + lambda), 0.25 * (y + lambda));
    }
    1.0 / y.sqrt()
}

/// Carlson's R_J(x, y, z, p) for x, y, z ≥ 0, at most one of them zero, and p > 0.
#[must_use]
pub fn carlson_rj(x: f64, y: f64, z: f64, p: f64) -> f64 {
    let (mut x, mut y, mut z, mut p) = (x, y, z, p);
    let mut mean = (x + y + z + 2.0 * p) / 5.0;
    let mut spread = 500.0 * [x, y, z, p].iter().map(|v| (mean - v).abs()).fold(0.0, f64::max);
    let mut delta = (p - x) * (p - y) * (p - z);
    let (mut scale, mut sum) = (1.0, 0.0);
    for _ in 0..MAX_DUPLICATIONS {
        if spread < mean {
            break;
        }
        let (rx, ry, rz, rp) = (x.sqrt(), y.sqrt(), z.sqrt(), p.sqrt());
        let lambda = rx * ry + rx * rz + ry * rz;
        let d = (rp + rx) * (rp + ry) * (rp + rz);
        sum += scale / d * carlson_rc_of_one(1.0 + delta / (d * d));
        (x, y, z, p) = (0.25 * (x + lambda), 0.25 * (y + lambda), 0.25 * (z + lambda), 0.25 * (p + lambda));
        mean = 0.25 * (mean + lambda);
        (spread, scale, delta) = (0.25 * spread, 0.25 * scale, delta / 64.0);
    }
    let (dx, dy, dz) = (1.0 - x / mean, 1.0 - y / mean, 1.0 - z / mean);
    let dp = -0.5 * (dx + dy + dz);
    let e2 = dx * dy + dx * dz + dy * dz - 3.0 * dp * dp;
    let e3 = dx * dy * dz + 2.0 * e2 * dp + 4.0 * dp * dp * dp;
    let e4 = (2.0 * dx * dy * dz + e2 * dp + 3.0 * dp * dp * dp) * dp;
    let e5 = dx * dy * dz * dp * dp;
    let series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0 - 3.0 * e4 / 22.0 - 9.0 * e2 * e3 / 52.0
        + 3.0 * e5 / 26.0;
    scale * series / (mean * mean.sqrt()) + 6.0 * sum
}

//! Volumes of balls and spheres, from which those of all round shapes follow.

use std::f64::consts::PI;

/// Volume of the ball of radius one in `n` dimensions, π^{n/2}/Γ(n/2+1): 1, 2, π, 4π/3, π²/2, 8π²/15, π³/6, …
#[must_use]
pub fn unit_ball(n: usize) -> f64 {
    // V_n = V_{n−2} · 2π/n.
    let mut volume = if n.is_multiple_of(2) { 1.0 } else { 2.0 };
    let mut dimension = n % 2;
    while dimension < n {
        dimension += 2;
        volume *= 2.0 * PI / dimension as f64;
    }
    volume
}

/// Surface of the ball of radius one in `n` ≥ 1 dimensions: 2 (two points), 2π, 4π, 2π², 8π²/3, π³, …
#[must_use]
pub fn unit_sphere(n: usize) -> f64 {
    n as f64 * unit_ball(n)
}

/// n!, exact in f64 up to n = 18.
pub(crate) fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volumes_are_those_of_the_tables() {
        let expected = [
            1.0,
            2.0,
            PI,
            4.0 * PI / 3.0,
            PI * PI / 2.0,
            8.0 * PI * PI / 15.0,
            PI * PI * PI / 6.0,
            16.0 * PI * PI * PI / 105.0,
        ];
        for (n, volume) in expected.into_iter().enumerate() {
            assert!((unit_ball(n) / volume - 1.0).abs() < 1e-15, "{n}");
        }
        assert!((unit_sphere(4) / (2.0 * PI * PI) - 1.0).abs() < 1e-15);
    }
}

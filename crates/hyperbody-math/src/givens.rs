//! Turns of two coordinates by an angle, kept so that long products of them stay orthogonal.
//!
//! A turn stores sin θ and cos θ − 1 = −2 sin²(θ/2), not cos θ. Rounding then enters in proportion to θ², where the
//! usual form (cos θ, sin θ) has cos²θ + sin²θ wrong by the same 1e-16 at every step of a steady spin: over 10⁷ small
//! turns that is a drift of 1e-9 (G. Vilmart, 2008, on rounding in rigid-body integrators).

use crate::scalar;

/// A turn by an angle in an oriented plane that is named where the turn is applied (W. Givens, 1958).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Givens {
    sin: f64,
    /// cos θ − 1.
    versine: f64,
}

impl Givens {
    /// No turn.
    pub const IDENTITY: Self = Self { sin: 0.0, versine: 0.0 };

    /// The turn by `angle_rad`; an angle that is not finite gives the identity, so that no NaN can spread from here.
    #[inline]
    #[must_use]
    pub fn from_angle(angle_rad: f64) -> Self {
        if !angle_rad.is_finite() {
            return Self::IDENTITY;
        }
        let (half_sin, half_cos) = scalar::sin_cos(0.5 * angle_rad);
        Self { sin: 2.0 * half_sin * half_cos, versine: -2.0 * half_sin * half_sin }
    }

    /// The turn back.
    #[inline]
    #[must_use]
    pub fn inverse(self) -> Self {
        Self { sin: -self.sin, ..self }
    }

    /// Sine of the angle.
    #[inline]
    #[must_use]
    pub fn sin(self) -> f64 {
        self.sin
    }

    /// Cosine of the angle.
    #[inline]
    #[must_use]
    pub fn cos(self) -> f64 {
        1.0 + self.versine
    }

    /// The components (a, b) of a fixed vector along two axes that have been turned by θ, the first towards the second:
    /// (a cos θ + b sin θ, b cos θ − a sin θ).
    #[inline]
    #[must_use]
    pub fn components_in_turned_axes(self, a: f64, b: f64) -> (f64, f64) {
        (a + (self.versine * a + self.sin * b), b + (self.versine * b - self.sin * a))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bivector, Rotation, planes};

    fn check_against_full_products<const N: usize>() {
        for (i, j) in planes::all(N).chain(planes::all(N).map(|(i, j)| (j, i))) {
            let turn = Givens::from_angle(0.7);
            let full = Rotation::<N>::in_plane(i, j, 0.7);
            let values: Vec<f64> = (0..planes::count(N)).map(|k| 0.3 + k as f64).collect();
            let bivector = Bivector::<N>::from_planes(&values).expect("one number per plane");
            let start = Rotation::exp(&(bivector * 0.1));

            let mut turned = start;
            turned.turn_in_body_plane(i, j, turn);
            assert!((*turned.matrix() - *(start * full).matrix()).max_abs() < 1e-14, "plane ({i}, {j}) in {N}D");

            let mut changed = bivector;
            changed.change_to_turned_frame(i, j, turn);
            let expected = full.inverse_rotate_bivector(&bivector);
            assert!((changed - expected).norm() < 1e-13, "plane ({i}, {j}) in {N}D");
        }
    }

    #[test]
    fn turning_in_place_equals_the_full_products() {
        check_against_full_products::<2>();
        check_against_full_products::<3>();
        check_against_full_products::<4>();
        check_against_full_products::<5>();
        check_against_full_products::<6>();
    }

    #[test]
    fn a_million_small_turns_keep_the_length_and_add_up() {
        let angle = 0.012_345_678_9;
        let turn = Givens::from_angle(angle);
        let (mut a, mut b) = (0.6, 0.8);
        for _ in 0..1_000_000 {
            (a, b) = turn.components_in_turned_axes(a, b);
        }
        assert!((a * a + b * b - 1.0).abs() < 2e-13, "length² {}", a * a + b * b);
        let (sin, cos) = scalar::sin_cos(angle * 1e6);
        assert!((a - (0.6 * cos + 0.8 * sin)).abs() < 1e-10);
        assert!((b - (0.8 * cos - 0.6 * sin)).abs() < 1e-10);
    }

    #[test]
    fn large_angles_agree_with_sine_and_cosine_and_bad_ones_do_nothing() {
        for angle in [0.0, 1e-9, 0.3, -2.0, 3.2, 100.0, -1e6, 1e300] {
            let (sin, cos) = scalar::sin_cos(angle);
            let turn = Givens::from_angle(angle);
            assert!((turn.sin() - sin).abs() < 1e-15 && (turn.cos() - cos).abs() < 1e-15, "angle {angle}");
        }
        for angle in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(Givens::from_angle(angle), Givens::IDENTITY);
        }
    }
}

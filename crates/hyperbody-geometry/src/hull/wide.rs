//! Integers of 256 bits: just what exact hyperplanes of small integer points need.

use std::cmp::Ordering;
use std::ops::{Add, Neg, Sub};

/// Two's complement, least significant limb first. Arithmetic wraps; the callers stay below 2²⁵⁵.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Wide([u64; 4]);

impl Wide {
    pub(super) const ZERO: Self = Self([0; 4]);

    pub(super) fn new(value: i64) -> Self {
        let extension = if value < 0 { u64::MAX } else { 0 };
        Self([value as u64, extension, extension, extension])
    }

    fn is_negative(self) -> bool {
        self.0[3] >> 63 == 1
    }

    /// −1, 0 or 1 as an ordering against zero.
    pub(super) fn sign(self) -> Ordering {
        if self.is_negative() {
            Ordering::Less
        } else if self == Self::ZERO {
            Ordering::Equal
        } else {
            Ordering::Greater
        }
    }

    /// The product with a small number.
    pub(super) fn times(self, factor: i64) -> Self {
        let negative = self.is_negative() != (factor < 0);
        let limbs = if self.is_negative() { (-self).0 } else { self.0 };
        let mut product = [0; 4];
        let mut carry = 0_u128;
        for (limb, out) in limbs.into_iter().zip(&mut product) {
            let sum = u128::from(limb) * u128::from(factor.unsigned_abs()) + carry;
            *out = sum as u64;
            carry = sum >> 64;
        }
        if negative { -Self(product) } else { Self(product) }
    }

    /// The nearest f64 to within a few units of the last place.
    pub(super) fn to_f64(self) -> f64 {
        const LIMB: f64 = 18_446_744_073_709_551_616.0;
        let magnitude = if self.is_negative() { -self } else { self };
        let value = magnitude.0.iter().rev().fold(0.0, |value, &limb| value * LIMB + limb as f64);
        if self.is_negative() { -value } else { value }
    }
}

impl Add for Wide {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let mut sum = [0; 4];
        let mut carry = false;
        for i in 0..4 {
            let (partial, first) = self.0[i].overflowing_add(other.0[i]);
            let (total, second) = partial.overflowing_add(u64::from(carry));
            sum[i] = total;
            carry = first || second;
        }
        Self(sum)
    }
}

impl Neg for Wide {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|limb| !limb)) + Self::new(1)
    }
}

impl Sub for Wide {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_agrees_with_that_of_128_bits() {
        let wide = |v: i128| Wide::new((v >> 64) as i64).times(1 << 32).times(1 << 32) + from_u64(v as u64);
        fn from_u64(v: u64) -> Wide {
            Wide([v, 0, 0, 0])
        }
        let samples = [0, 1, -1, 7, -9, i64::MAX, i64::MIN + 1, 1 << 40, -(1 << 40) + 3, 123_456_789_012];
        for a in samples {
            for b in samples {
                let (x, y) = (i128::from(a), i128::from(b));
                assert_eq!(Wide::new(a).times(b), wide(x * y), "{a} · {b}");
                assert_eq!(Wide::new(a) + Wide::new(b), wide(x + y), "{a} + {b}");
                assert_eq!(Wide::new(a) - Wide::new(b), wide(x - y), "{a} − {b}");
                assert_eq!((Wide::new(a) - Wide::new(b)).sign(), a.cmp(&b));
                let close = ((x * y) as f64 - Wide::new(a).times(b).to_f64()).abs();
                assert!(close <= 1e-15 * ((x * y) as f64).abs());
            }
        }
        // (2⁶²)⁴ = 2²⁴⁸ and back: times and sums carry through every limb.
        let mut large = Wide::new(1 << 62);
        for _ in 0..3 {
            large = large.times(1 << 62);
        }
        assert_eq!(large.to_f64(), 2_f64.powi(248));
        assert_eq!((large - Wide::new(1)) + Wide::new(1) - large, Wide::ZERO);
        assert_eq!((-large).sign(), Ordering::Less);
    }
}

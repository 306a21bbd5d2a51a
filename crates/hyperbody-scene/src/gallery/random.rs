//! The random numbers of the gallery: SplitMix64 (G. Steele, D. Lea, C. Flood, 2014), fixed here for ever, so that a
//! built-in scene never changes its bits with a dependency.

/// A seeded sequence.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Between −1 and 1.
    pub(crate) fn unit(&mut self) -> f64 {
        2.0 * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64) - 1.0
    }

    /// Between −`reach` and `reach`, rounded to four decimals so that written files stay short.
    pub(super) fn around_zero(&mut self, reach: f64) -> f64 {
        (self.unit() * reach * 1e4).round() / 1e4
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequence_is_the_published_one() {
        // First outputs of SplitMix64 from seed 1234567, as in the reference implementation by S. Vigna.
        let mut random = Random::new(1_234_567);
        assert_eq!(random.next(), 6_457_827_717_110_365_317);
        assert_eq!(random.next(), 3_203_168_211_198_807_973);
        let mut random = Random::new(1);
        for _ in 0..1000 {
            let value = random.around_zero(0.5);
            assert!((-0.5..=0.5).contains(&value));
        }
    }
}

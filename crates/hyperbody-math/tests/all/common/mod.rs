//! Seeded random input for the tests: a tiny generator (SplitMix64, G. Steele et al., 2014), so that every run sees the
//! same cases.
#![allow(dead_code, unreachable_pub, reason = "each test program uses its own part")]

pub mod dense;

use hyperbody_math::{Bivector, Dim, EvenAlgebra, Matrix, Rotation, Rotor, Vector, planes};

pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in [−1, 1).
    pub fn signed(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub fn vector<const N: usize>(&mut self) -> Vector<N> {
        Vector::from_fn(|_| self.signed())
    }

    pub fn matrix<const N: usize>(&mut self) -> Matrix<N> {
        Matrix::from_fn(|_, _| self.signed())
    }

    pub fn bivector<const N: usize>(&mut self) -> Bivector<N> {
        let values: Vec<f64> = (0..planes::count(N)).map(|_| self.signed()).collect();
        Bivector::from_planes(&values).expect("as many numbers as planes")
    }

    /// A rotation that mixes all axes: a plane turn by any angle in every coordinate plane.
    pub fn rotation<const N: usize>(&mut self) -> Rotation<N> {
        planes::all(N).fold(Rotation::IDENTITY, |rotation, (i, j)| {
            Rotation::in_plane(i, j, std::f64::consts::PI * self.signed()) * rotation
        })
    }

    /// A rotor that mixes all axes, of either sign.
    pub fn rotor<const N: usize>(&mut self) -> Rotor<N>
    where
        Dim<N>: EvenAlgebra,
    {
        planes::all(N)
            .fold(Rotor::IDENTITY, |rotor, (i, j)| Rotor::in_plane(i, j, std::f64::consts::TAU * self.signed()) * rotor)
    }
}

/// Asserts that a deviation does not exceed its limit; NaN fails.
#[track_caller]
pub fn assert_within(deviation: f64, limit: f64, what: &str) {
    assert!(deviation <= limit, "{what}: deviation {deviation:e} exceeds {limit:e}");
}

/// Makes one test for each of the parent module's checks, run for 2 to 6 dimensions.
macro_rules! in_every_dimension {
    ($($name:ident)*) => {$(
        #[test]
        fn $name() {
            super::$name::<2>();
            super::$name::<3>();
            super::$name::<4>();
            super::$name::<5>();
            super::$name::<6>();
        }
    )*};
}
pub(crate) use in_every_dimension;

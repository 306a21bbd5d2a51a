//! A small seeded generator and random poses, shared by the tests of this crate.
#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part")]

pub mod draw;
pub mod fuzz;
pub mod half_spaces;
pub mod oracle;

use hyperbody_geometry::Shape;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

/// SplitMix64 (Steele, Lea, Flood 2014).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    /// Spread evenly over the logarithm.
    pub fn log_range(&mut self, low: f64, high: f64) -> f64 {
        (self.range(low.ln(), high.ln())).exp()
    }

    pub fn vector<const N: usize>(&mut self, reach: f64) -> Vector<N> {
        Vector::from_fn(|_| self.range(-reach, reach))
    }

    /// A direction, evenly over the sphere.
    pub fn direction<const N: usize>(&mut self) -> Vector<N> {
        // Rejection from the cube; in six dimensions one in twelve is kept.
        for _ in 0..10_000 {
            let v = self.vector::<N>(1.0);
            let length = v.norm();
            if length > 1e-3 && length <= 1.0 {
                return v / length;
            }
        }
        Vector::unit(0)
    }

    pub fn rotation<const N: usize>(&mut self, angle: f64) -> Rotation<N> {
        let mut b = Bivector::ZERO;
        for i in 0..N {
            for j in i + 1..N {
                b.set(i, j, self.range(-angle, angle));
            }
        }
        Rotation::exp(&b)
    }

    pub fn pose<const N: usize>(&mut self, reach: f64) -> Pose<N> {
        Pose::new(self.rotation(3.0), self.vector(reach))
    }
}

/// The one piece of a simple shape.
pub fn piece<const N: usize>(shape: Shape<N>) -> Piece<N> {
    shape.pieces().into_iter().next().expect("a shape has a piece").1
}

/// Runs a check for every dimension.
#[macro_export]
macro_rules! for_every_dimension {
    ($check:ident) => {
        $check::<2>();
        $check::<3>();
        $check::<4>();
        $check::<5>();
        $check::<6>();
    };
}

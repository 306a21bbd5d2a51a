//! What the fuzzer's bytes mean: numbers of every kind, shapes, poses. Whatever the bytes, there is an answer.

use std::sync::Arc;

use hyperbody_geometry::regular::{Regular, Size};
use hyperbody_geometry::{Polytope, Shape};
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

/// Bytes, read from the front; zeros after the end.
pub struct Bytes<'a>(pub &'a [u8]);

/// Numbers at which code has a special case.
const SPECIAL: [f64; 14] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN_POSITIVE,
    -0.0,
    1e-300,
    1e-9,
    -1e-6,
    1e6,
    -1e9,
    1e15,
    0.1,
    1e-3,
];

impl Bytes<'_> {
    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    pub fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }

    /// Mostly on a grid of sixteenths, where coincidences are; now and then any number.
    pub fn number(&mut self) -> f64 {
        match self.byte() {
            byte @ 0..=219 => (f64::from(byte) - 110.0) / 16.0,
            byte @ 220..=233 => SPECIAL[usize::from(byte - 220)],
            _ => f64::from(f32::from_le_bytes([self.byte(), self.byte(), self.byte(), self.byte()])),
        }
    }

    pub fn vector<const N: usize>(&mut self) -> Vector<N> {
        Vector::from_fn(|_| self.number())
    }

    /// Of ordinary size, at any place.
    pub fn pose<const N: usize>(&mut self) -> Pose<N> {
        let rotation = match self.byte() % 4 {
            0 => Rotation::IDENTITY,
            1 => Rotation::in_plane(0, 1, std::f64::consts::FRAC_PI_2),
            2 => Rotation::in_plane(0, N - 1, self.number()),
            _ => Rotation::exp(&Bivector::from_fn(|_, _| f64::from(self.byte()) / 40.0 - 3.2)),
        };
        Pose::new(rotation, self.vector())
    }

    pub fn polytope<const N: usize>(&mut self) -> Option<Arc<Polytope<N>>> {
        let kinds = [Regular::Simplex, Regular::Cube, Regular::CrossPolytope, Regular::Cell24, Regular::Dodecahedron];
        let polytope = match self.below(8) {
            0 => kinds[self.below(kinds.len())].polytope(Size::Circumradius(self.number())),
            1 => kinds[self.below(kinds.len())].polytope(Size::Edge(self.number())),
            _ => {
                let count = N + self.below(2 * N + 4);
                let points: Vec<Vector<N>> = (0..count).map(|_| self.vector()).collect();
                Polytope::from_points(&points)
            }
        };
        polytope.ok().map(Arc::new)
    }

    /// A shape as users make it, or `None` where a constructor refuses.
    pub fn shape<const N: usize>(&mut self, depth: u32) -> Option<Shape<N>> {
        match self.below(if depth > 0 { 8 } else { 5 }) {
            0 => Shape::ball(self.number()).ok(),
            1 => Shape::cuboid(self.vector::<N>()).ok(),
            2 => Shape::capsule(self.number(), self.number(), self.below(N + 1)).ok(),
            3 => Shape::polytope(self.polytope()?).ok(),
            4 => Shape::half_space(self.vector::<N>(), self.number()).ok(),
            5 => Shape::rounded(self.shape(depth - 1)?, self.number()).ok(),
            _ => {
                let parts =
                    (0..self.below(4)).map(|_| Some((self.pose(), self.shape(depth - 1)?))).collect::<Option<_>>()?;
                Shape::compound(parts).ok()
            }
        }
    }
}

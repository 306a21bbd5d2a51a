//! Random numbers, poses, kinds and shapes.

use hyperbody_dynamics::BodyKind;
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Pose, Rotation, Vector, planes};

/// SplitMix64 (S. Vigna, 2015).
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn vector<const N: usize>(&mut self, largest: f64) -> Vector<N> {
        Vector::from_fn(|_| self.between(-largest, largest))
    }

    pub(crate) fn pose<const N: usize>(&mut self) -> Pose<N> {
        let mut turn = Bivector::ZERO;
        for (i, j) in planes::all(N) {
            turn.set(i, j, self.between(-3.0, 3.0));
        }
        Pose::new(Rotation::exp(&turn), self.vector::<N>(2.0) + Vector::unit(1) * 2.5)
    }

    pub(crate) fn kind(&mut self) -> BodyKind {
        [BodyKind::Dynamic, BodyKind::Dynamic, BodyKind::Dynamic, BodyKind::Static, BodyKind::Kinematic][self.below(5)]
    }

    pub(crate) fn shape<const N: usize>(&mut self) -> Shape<N> {
        let size = self.between(0.1, 0.5);
        let long = |size: f64| Vector::from_fn(|i| size * (1.0 + 0.2 * i as f64));
        let shape = match self.below(5) {
            0 => Shape::ball(size),
            1 => Shape::capsule(size, 0.5 * size, self.below(N)),
            2 => Shape::cuboid(long(size)),
            3 => {
                // Two pieces, and a centre of mass that is not the origin.
                let place = Pose::from_translation(Vector::unit(self.below(N)) * (1.4 * size));
                let parts = Shape::cuboid(long(0.6 * size)).and_then(|cuboid| Ok((cuboid, Shape::ball(0.5 * size)?)));
                parts.and_then(|(cuboid, ball)| Shape::compound(vec![(Pose::IDENTITY, cuboid), (place, ball)]))
            }
            _ => Shape::cuboid(Vector::splat(size)),
        };
        shape.expect("lengths are in range")
    }
}

//! One number that differs when two worlds differ in any bit of their state; and the places of keys in maps.

use std::hash::Hasher;

use hyperbody_math::Vector;

use crate::World;
use crate::pairs::Passage;

/// Fowler–Noll–Vo 1a, 64 bits, over whole words (G. Fowler, L. Noll, K.-P. Vo, 1991), with a final mix so that
/// the last words reach every bit.
pub(crate) struct StateHasher(u64);

impl StateHasher {
    pub(crate) const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub(crate) fn word(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        self.0 ^= self.0 >> 32;
    }

    pub(crate) fn number(&mut self, value: f64) {
        self.word(value.to_bits());
    }

    pub(crate) fn vector<const N: usize>(&mut self, vector: Vector<N>) {
        vector.iter().for_each(|c| self.number(c));
    }

    pub(crate) fn finish(mut self) -> u64 {
        self.word(self.0 >> 29);
        self.0
    }
}

impl<const N: usize> World<N> {
    /// Hash of the whole state: poses, velocities, momenta, sleep, and the impulses kept for the next step. Two
    /// worlds that were built and stepped alike have the same hash on every platform, build and number of threads.
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        let mut hasher = StateHasher::new();
        hasher.word(self.step_count);
        for (handle, body) in self.bodies.iter() {
            hasher.word(u64::from(handle.index) << 32 | u64::from(handle.generation));
            hasher.vector(body.centre);
            body.rotation.matrix().0.iter().for_each(|row| hasher.vector(Vector(*row)));
            hasher.vector(body.velocity);
            body.angular_velocity.planes().for_each(|c| hasher.number(c));
            body.angular_momentum.planes().for_each(|c| hasher.number(c));
            hasher.number(body.slow_time);
            hasher.vector(body.strayed.0);
            body.strayed.1.planes().for_each(|c| hasher.number(c));
            hasher.word(u64::from(body.asleep_in.is_some()) | u64::from(body.quarantined) << 1);
        }
        for pair in self.pairs.iter() {
            hasher.word(u64::from(pair.collider_a) << 32 | u64::from(pair.collider_b));
            if pair.overlaps || pair.passage != Passage::Apart {
                hasher.word(u64::from(pair.overlaps) | (pair.passage as u64) << 1);
            }
            let Some(contact) = &pair.contact else { continue };
            for touch in contact.touches.iter() {
                hasher.number(touch.point.separation);
                hasher.word(u64::from(touch.normal_impulse.to_bits()));
            }
        }
        for joint in self.joints.values() {
            joint.impulses.iter().flatten().for_each(|&impulse| hasher.number(impulse));
        }
        hasher.finish()
    }
}

/// Spreads keys by one multiplication (D. Knuth, 1973): nobody gains from keys that collide.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct KeyHasher(u64);

impl Hasher for KeyHasher {
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&byte| self.write_u64(u64::from(byte)));
    }

    fn write_u64(&mut self, key: u64) {
        let product = (self.0 ^ key).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = product ^ product >> 32;
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

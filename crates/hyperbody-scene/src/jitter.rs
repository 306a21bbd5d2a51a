//! Another history of the same scene.

use crate::gallery::Random;
use crate::model::{BodyKind, Scene};

/// Largest shift of a body along each axis, m: a fiftieth of the slop of resting contacts.
pub const JITTER: f64 = 1e-4;

impl Scene {
    /// Shifts every dynamic body by up to [`JITTER`] along every axis, chosen by `seed`; always the same for the same
    /// seed. What is chaotic in the scene then goes another way, what is not hardly changes.
    pub fn jitter(&mut self, seed: u64) {
        let mut random = Random::new(seed);
        for body in self.bodies.iter_mut().filter(|body| body.kind == BodyKind::Dynamic) {
            if body.position.is_empty() {
                body.position = vec![0.0; self.dimension.min(6)];
            }
            for coordinate in &mut body.position {
                *coordinate += JITTER * random.unit();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::built_in;

    #[test]
    fn a_seed_shifts_dynamic_bodies_a_little_and_always_alike() {
        let scene = built_in("dice4d").unwrap();
        let jittered = |seed| {
            let mut scene = scene.clone();
            scene.jitter(seed);
            scene
        };
        assert_eq!(jittered(7), jittered(7));
        assert_ne!(jittered(7), jittered(8));
        for (before, after) in scene.bodies.iter().zip(&jittered(7).bodies) {
            let shift = before.position.iter().zip(&after.position).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let moves = before.kind == BodyKind::Dynamic;
            assert!(shift <= JITTER * 1.000_001 && (shift > 0.0) == moves, "{shift} for {:?}", before.kind);
        }
    }
}

//! Sums over a world: energy, momentum, angular momentum.

use hyperbody_math::{Bivector, Vector};

use crate::{BodyKind, World};

/// Energy of the dynamic bodies of a world, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// ½ m v² + ½ L·ω, summed.
    pub kinetic: f64,
    /// −m g·x, summed: zero at the origin, growing against gravity.
    pub potential: f64,
}

impl Energy {
    /// Kinetic and potential together, J.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential
    }
}

impl<const N: usize> World<N> {
    /// Energy of the dynamic bodies. Quarantined bodies don't count.
    #[must_use]
    pub fn energy(&self) -> Energy {
        let mut energy = Energy::default();
        for body in self.bodies.values().filter(|b| b.kind == BodyKind::Dynamic && !b.quarantined) {
            energy.kinetic += body.kinetic_energy();
            energy.potential -= body.mass * body.gravity_scale * self.gravity.dot(body.centre);
        }
        energy
    }

    /// Total momentum of the dynamic bodies, kg·m/s.
    #[must_use]
    pub fn momentum(&self) -> Vector<N> {
        let mut sum = Vector::ZERO;
        for body in self.bodies.values().filter(|b| b.kind == BodyKind::Dynamic && !b.quarantined) {
            sum += body.velocity * body.mass;
        }
        sum
    }

    /// Total angular momentum of the dynamic bodies about the origin, by world planes, kg·m²/s.
    #[must_use]
    pub fn angular_momentum(&self) -> Bivector<N> {
        let mut sum = Bivector::ZERO;
        for body in self.bodies.values().filter(|b| b.kind == BodyKind::Dynamic && !b.quarantined) {
            sum += body.angular_momentum + Bivector::wedge(body.centre, body.velocity * body.mass);
        }
        sum
    }

    /// Number of pairs of convex pieces that are near enough to be looked at, touching or not.
    #[must_use]
    pub fn pair_count(&self) -> usize {
        self.pairs.iter().count()
    }
}

//! What surfaces are made of.

use crate::{WorldError, error::WorldErrorKind};

/// Surface and bulk properties of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Coulomb coefficient μ ≥ 0, static and kinetic alike. Default 0.5. Two bodies combine by the geometric mean.
    pub friction: f64,
    /// Share e of the approach speed that a bounce gives back, 0..=1. Default 0. Two bodies combine by the larger.
    pub restitution: f64,
    /// Mass per volume in kg/mᴺ, > 0. Default 1.
    pub density: f64,
}

impl Default for Material {
    fn default() -> Self {
        Self { friction: 0.5, restitution: 0.0, density: 1.0 }
    }
}

impl Material {
    pub(crate) fn validate(&self) -> Result<(), WorldError> {
        let refuse = |name: &str, value: f64, range: &str| {
            Err(WorldError::new(WorldErrorKind::BadNumber, format!("{name} is {value}; it must be {range}")))
        };
        if !(self.friction >= 0.0 && self.friction.is_finite()) {
            return refuse("friction", self.friction, "finite and not negative");
        }
        if !(0.0..=1.0).contains(&self.restitution) {
            return refuse("restitution", self.restitution, "between 0 (no bounce) and 1 (no loss)");
        }
        if !(self.density > 0.0 && self.density.is_finite()) {
            return refuse("density", self.density, "finite and positive");
        }
        Ok(())
    }

    /// Friction of two surfaces in contact: the geometric mean, so that ice stays slippery on anything.
    pub(crate) fn combined_friction(&self, other: &Self) -> f64 {
        (self.friction * other.friction).sqrt()
    }

    /// Restitution of two surfaces in contact: the larger, so that a rubber ball bounces on anything.
    pub(crate) fn combined_restitution(&self, other: &Self) -> f64 {
        self.restitution.max(other.restitution)
    }
}

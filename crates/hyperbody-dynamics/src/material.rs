//! What surfaces are made of, and what becomes of two of them in contact.
//!
//! Two bodies in contact may turn against each other in N(N−1)/2 planes, of which sliding friction at a single point resists
//! none. The N−1 planes that contain the normal are those in which one *rolls* on the other; the (N−1)(N−2)/2 planes of the
//! tangent space, none in the plane and one in space, are those in which it *twists*. Resistance to each is a torque of
//! constant size, a length times the load, against the turn within its planes: for rolling the distance by which the load is
//! carried ahead of the middle of the patch (C.-A. de Coulomb, 1781), for twisting the mean arm of the patch times the
//! friction. Bodies that touch in several points twist against the friction at those points as well.

use crate::{WorldError, error::WorldErrorKind};

/// Surface and bulk properties of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Coulomb coefficient μ ≥ 0, static and kinetic alike. Default 0.5. Two bodies combine by the geometric mean, unless one
    /// names another rule.
    pub friction: f64,
    /// Share e of the approach speed that a bounce gives back, 0..=1. Default 0. Two bodies combine by the larger, unless one
    /// names another rule.
    pub restitution: f64,
    /// Mass per volume in kg/mᴺ, > 0. Default 1.
    pub density: f64,
    /// Resistance to rolling: the largest torque in planes that contain the normal, in parts of the load, m, ≥ 0. Default 0.
    /// Two bodies combine by the larger.
    pub rolling_resistance: f64,
    /// Resistance to twisting: the largest torque in planes of the tangent space, beside that of friction, in parts of the
    /// load, m, ≥ 0. Default 0. Two bodies combine by the larger.
    pub twisting_resistance: f64,
    /// How its friction combines with that of others. Default: it leaves that to the other one.
    pub friction_rule: Option<CombineRule>,
    /// How its restitution combines with that of others. Default: it leaves that to the other one.
    pub restitution_rule: Option<CombineRule>,
}

/// How one number of two surfaces becomes that of their contact. Where both name a rule, the one that stands later in this
/// list wins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CombineRule {
    /// √(ab): what is slippery stays slippery on anything. What friction combines by if nobody names a rule.
    GeometricMean,
    /// (a + b)/2.
    Average,
    /// The smaller one.
    Minimum,
    /// ab.
    Multiply,
    /// The larger one: what bounces bounces on anything. What restitution combines by if nobody names a rule.
    Maximum,
}

impl CombineRule {
    /// Of a and b, both ≥ 0.
    #[must_use]
    pub fn combine(self, a: f64, b: f64) -> f64 {
        match self {
            Self::GeometricMean => (a * b).sqrt(),
            Self::Average => 0.5 * (a + b),
            Self::Minimum => a.min(b),
            Self::Multiply => a * b,
            Self::Maximum => a.max(b),
        }
    }
}

impl Default for Material {
    fn default() -> Self {
        Self {
            friction: 0.5,
            restitution: 0.0,
            density: 1.0,
            rolling_resistance: 0.0,
            twisting_resistance: 0.0,
            friction_rule: None,
            restitution_rule: None,
        }
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
        let resistances =
            [("rolling_resistance", self.rolling_resistance), ("twisting_resistance", self.twisting_resistance)];
        for (name, value) in resistances {
            if !(value >= 0.0 && value.is_finite()) {
                return refuse(name, value, "a finite number of metres, 0 or more");
            }
        }
        if !(0.0..=1.0).contains(&self.restitution) {
            return refuse("restitution", self.restitution, "between 0 (no bounce) and 1 (no loss)");
        }
        if !(self.density > 0.0 && self.density.is_finite()) {
            return refuse("density", self.density, "finite and positive");
        }
        Ok(())
    }

    /// Friction of two surfaces in contact.
    pub(crate) fn combined_friction(&self, other: &Self) -> f64 {
        let rule = self.friction_rule.max(other.friction_rule).unwrap_or(CombineRule::GeometricMean);
        rule.combine(self.friction, other.friction)
    }

    /// Restitution of two surfaces in contact.
    pub(crate) fn combined_restitution(&self, other: &Self) -> f64 {
        let rule = self.restitution_rule.max(other.restitution_rule).unwrap_or(CombineRule::Maximum);
        rule.combine(self.restitution, other.restitution)
    }

    /// Resistance to rolling and to twisting of two surfaces in contact, m.
    pub(crate) fn combined_resistance(&self, other: &Self) -> (f64, f64) {
        (self.rolling_resistance.max(other.rolling_resistance), self.twisting_resistance.max(other.twisting_resistance))
    }
}

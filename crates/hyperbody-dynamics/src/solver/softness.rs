//! Soft constraints: a constraint row as a damped spring, integrated implicitly.
//!
//! With angular frequency ω = 2π·hz, damping ratio ζ and substep h: a1 = 2ζ + hω, a2 = hω·a1, a3 = 1/(1 + a2). The
//! row removes the share a2·a3 of the velocity error, drifts back at the rate ω/a1, and gives back the share a3 of
//! its accumulated impulse (E. Catto, "Soft Constraints", 2011, in the form of his "Solver2D", 2024).

/// Coefficients of a soft row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Softness {
    /// 1/s.
    pub(crate) bias_rate: f64,
    pub(crate) mass_scale: f64,
    pub(crate) impulse_scale: f64,
}

impl Default for Softness {
    fn default() -> Self {
        Self::RIGID
    }
}

impl Softness {
    /// Does not give way, and does not draw back.
    pub(crate) const RIGID: Self = Self { bias_rate: 0.0, mass_scale: 1.0, impulse_scale: 0.0 };

    /// For a spring of `hz`, capped at a quarter of the substep rate, beyond which a sweep over such springs would ring.
    pub(crate) fn new(hz: f64, damping_ratio: f64, h: f64) -> Self {
        Self::uncapped(hz.min(0.25 / h), damping_ratio, h)
    }

    /// For springs that are solved together.
    pub(crate) fn uncapped(hz: f64, damping_ratio: f64, h: f64) -> Self {
        let omega = std::f64::consts::TAU * hz;
        let a1 = 2.0 * damping_ratio + h * omega;
        let a2 = h * omega * a1;
        let a3 = 1.0 / (1.0 + a2);
        Self { bias_rate: omega / a1, mass_scale: a2 * a3, impulse_scale: a3 }
    }

    /// How long the spring takes to act and to be damped, s: 1/ω + 2ζ/ω, within a substep.
    pub(crate) fn settling_time(&self, h: f64) -> f64 {
        (h * self.compliance() / self.bias_rate).sqrt() + 1.0 / self.bias_rate
    }

    /// What the row gives way, in parts of its response: 1/a2.
    pub(crate) fn compliance(&self) -> f64 {
        self.impulse_scale / self.mass_scale
    }
}

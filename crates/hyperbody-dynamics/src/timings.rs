//! Where the time of a step goes.

/// Seconds that each stage of the last step took; zero unless the world was given a clock.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageTimings {
    /// Bounding boxes, the dynamic tree, new and ended pairs.
    pub broad_phase: f64,
    /// Contact manifolds.
    pub narrow_phase: f64,
    /// Waking, islands, falling asleep.
    pub islands: f64,
    /// Constraint rows and all substeps.
    pub solver: f64,
    /// Final positions and velocities.
    pub integration: f64,
}

impl StageTimings {
    /// Names and seconds in the order of the step.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, f64)> {
        [
            ("broad_phase", self.broad_phase),
            ("narrow_phase", self.narrow_phase),
            ("islands", self.islands),
            ("solver", self.solver),
            ("integration", self.integration),
        ]
        .into_iter()
    }

    /// Sum of all stages, s.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.iter().map(|(_, seconds)| seconds).sum()
    }
}

//! One step: a short list of stages, through which data goes one way.

use crate::solver::SolverInput;
use crate::{StageTimings, World};

impl<const N: usize> World<N> {
    /// Moves the world on by one [`World::dt`]. Never panics: a body whose state turns non-finite is put into
    /// quarantine and the rest goes on.
    pub fn step(&mut self) {
        let mut watch = Stopwatch::start(self.clock);
        let mut timings = StageTimings::default();

        self.serve_wake_requests();
        self.vet_bodies();
        self.update_broad_phase();
        timings.broad_phase = watch.lap();

        self.update_manifolds();
        timings.narrow_phase = watch.lap();

        self.wake_touched();
        timings.islands = watch.lap();

        self.solve();
        timings.solver = watch.lap();

        self.integrate();
        timings.integration = watch.lap();

        self.fall_asleep();
        timings.islands += watch.lap();

        self.step_count += 1;
        self.timings = timings;
    }

    fn solve(&mut self) {
        self.solver.solve(&mut SolverInput {
            bodies: &mut self.bodies,
            pairs: &mut self.pairs,
            joints: &mut self.joints,
            gravity: self.gravity,
            tuning: &self.tuning,
            dt: self.dt,
            substeps: self.substeps,
            pool: self.pool.as_ref(),
        });
    }
}

/// Seconds between laps, by the clock that the world was given.
struct Stopwatch {
    clock: Option<fn() -> f64>,
    last: f64,
}

impl Stopwatch {
    fn start(clock: Option<fn() -> f64>) -> Self {
        Self { clock, last: clock.map_or(0.0, |clock| clock()) }
    }

    fn lap(&mut self) -> f64 {
        let Some(clock) = self.clock else { return 0.0 };
        let now = clock();
        let lap = now - self.last;
        self.last = now;
        lap
    }
}

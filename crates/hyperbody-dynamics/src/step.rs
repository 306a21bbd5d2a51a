//! One step: a short list of stages, through which data goes one way.

use crate::body::Body;
use crate::solver::SolverInput;
use crate::threads::MANY_BODIES;
use crate::{StageTimings, World};

impl<const N: usize> World<N> {
    /// Moves the world on by one [`World::dt`]. Never panics: a body whose state turns non-finite is put into
    /// quarantine and the rest goes on.
    pub fn step(&mut self) {
        self.events.forget_step();
        if self.is_at_rest() {
            self.step_count += 1;
            self.timings = StageTimings::default();
            return;
        }
        // All of it is done in the pool: each stage that entered it from outside would wait for a thread to wake up.
        match self.pool.clone() {
            Some(pool) if self.solver.bodies.len() >= MANY_BODIES => pool.attend(|| self.advance()),
            Some(pool) => pool.install(|| self.advance()),
            None => self.advance(),
        }
    }

    fn advance(&mut self) {
        let mut watch = Stopwatch::start(self.clock);
        let mut timings = StageTimings::default();

        self.stop_arrived();
        self.serve_wake_requests();
        self.vet_bodies();
        self.update_broad_phase();
        timings.broad_phase = watch.lap();

        self.update_manifolds();
        timings.narrow_phase = watch.lap();

        self.wake_touched();
        self.push_woken();
        timings.islands = watch.lap();

        self.solve();
        timings.solver = watch.lap();

        self.integrate();
        self.stop_at_impacts();
        timings.integration = watch.lap();

        self.fall_asleep();
        self.collect_events();
        timings.islands += watch.lap();

        self.step_count += 1;
        self.timings = timings;
    }

    /// Whether everything sleeps or stands still, and nobody asked for anything since the last step: a step would change no
    /// bit of the state but the count of steps.
    fn is_at_rest(&self) -> bool {
        let still = |body: &Body<N>| !body.is_moving() && !body.drifts() && !body.arrived && body.led_to.is_none();
        self.wake_requests.is_empty()
            && self.islands.nothing_changed()
            && self.bodies.values().all(still)
            && !self.motions.iter().any(|motion| motion.moved)
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
            pool: self.pool.as_deref(),
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

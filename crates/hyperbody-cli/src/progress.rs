//! A bar for work over a second, on standard error and only where that is a terminal.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// Progress through a known number of steps.
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
    shown: bool,
}

impl Progress {
    /// Nothing is drawn yet.
    pub(crate) fn new(what: &str, steps: u64) -> Self {
        let bar =
            ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::hidden()).with_message(what.to_owned());
        let template = "{msg} {wide_bar} {pos}/{len} steps, {eta} left";
        bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { bar, start: Instant::now(), shown: false }
    }

    /// One step more is done.
    pub(crate) fn advance(&mut self) {
        self.reach(self.bar.position() + 1);
    }

    /// This many steps are done.
    pub(crate) fn reach(&mut self, done: u64) {
        self.bar.set_position(done);
        if !self.shown && self.start.elapsed() > PATIENCE {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.shown = true;
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

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
    /// Steps, which are counted for the reader. Nothing is drawn yet.
    pub(crate) fn new(what: &str, steps: u64) -> Self {
        Self::with_template(what, steps, "{msg} {wide_bar} {pos}/{len} steps, {eta} left")
    }

    /// Parts that mean nothing to a reader, told in percent. Nothing is drawn yet.
    pub(crate) fn in_percent(what: &str, parts: u64) -> Self {
        Self::with_template(what, parts, "{msg} {wide_bar} {percent} %, {eta} left")
    }

    fn with_template(what: &str, steps: u64, template: &str) -> Self {
        let bar =
            ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::hidden()).with_message(what.to_owned());
        bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { bar, start: Instant::now(), shown: false }
    }

    /// Says anew what is being done.
    pub(crate) fn say(&self, what: String) {
        self.bar.set_message(what);
    }

    /// One step more is done.
    pub(crate) fn advance(&mut self) {
        self.advance_by(1);
    }

    /// So many steps more are done.
    pub(crate) fn advance_by(&mut self, more: u64) {
        self.reach(self.bar.position() + more);
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

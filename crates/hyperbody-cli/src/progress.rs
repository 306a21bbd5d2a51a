//! A bar for work over a second, on standard error and only where that is a terminal.

use std::io::{IsTerminal, Write, stderr};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// Whether a bar stands on the terminal's last line.
static SHOWN: AtomicBool = AtomicBool::new(false);

/// Ends the line of a bar that nobody will clear any more, so that the shell does not write into it.
pub(crate) fn end_line() {
    if SHOWN.load(Ordering::Relaxed) && stderr().is_terminal() {
        // There is nobody left to tell.
        let _ = writeln!(stderr());
    }
}

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
            SHOWN.store(true, Ordering::Relaxed);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
        if self.shown {
            SHOWN.store(false, Ordering::Relaxed);
        }
    }
}

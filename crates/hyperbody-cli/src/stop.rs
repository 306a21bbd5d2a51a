//! Being told to stop: files in the making are removed, a program that helps is stopped as well, and the exit status says why.

use std::io;
use std::process::{Child, ChildStderr, ChildStdin, Command, ExitStatus};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};
use std::time::Duration;

use crate::files;
use crate::progress;

/// The program that helps, if one runs.
static HELPER: Mutex<Option<Child>> = Mutex::new(None);

/// How long to wait before looking again whether it has ended.
const PATIENCE: Duration = Duration::from_millis(5);

fn helper() -> MutexGuard<'static, Option<Child>> {
    HELPER.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Starts a program that helps, and gives the ends of its input and of its errors. From its first moment on it is stopped with
/// this one.
pub(crate) fn start_helper(command: &mut Command) -> io::Result<(Option<ChildStdin>, Option<ChildStderr>)> {
    let mut helper = helper();
    let mut child = command.spawn()?;
    let ends = (child.stdin.take(), child.stderr.take());
    *helper = Some(child);
    Ok(ends)
}

/// Waits until the program that helps has ended. Another thread can stop it meanwhile.
pub(crate) fn wait_for_helper() -> io::Result<ExitStatus> {
    loop {
        let Some(ended) = helper().as_mut().map(Child::try_wait) else {
            return Err(io::Error::other("it has ended before"));
        };
        if let Some(status) = ended.transpose() {
            *helper() = None;
            return status;
        }
        std::thread::sleep(PATIENCE);
    }
}

/// Stops the program that helps, if it still runs.
pub(crate) fn stop_helper() -> MutexGuard<'static, Option<Child>> {
    let mut helper = helper();
    if let Some(mut child) = helper.take() {
        // It may have ended by itself; then there is nothing to stop.
        let _ = child.kill();
        let _ = child.wait();
    }
    helper
}

/// Ends the program with this status. Nothing that other threads do meanwhile brings a file back.
fn stop(status: i32) {
    let _helper = stop_helper();
    let _drafts = files::remove_drafts();
    progress::end_line();
    std::process::exit(status);
}

/// Listens for being told to stop, from the first call on. Where that cannot be arranged, files in the making stay, under names
/// that say what they are.
pub(crate) fn listen() {
    static LISTENING: Once = Once::new();
    LISTENING.call_once(arrange);
}

#[cfg(unix)]
fn arrange() {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXFSZ};

    // A file that may not grow further is then an error of the one who writes, not the end of the program.
    let _ = signal_hook::flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    let ignored = ignored_signals();
    let heard = [SIGHUP, SIGINT, SIGQUIT, SIGTERM].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    if let Ok(mut signals) = signal_hook::iterator::Signals::new(heard) {
        std::thread::spawn(move || {
            if let Some(signal) = signals.forever().next() {
                // The custom of shells: 130 for Ctrl-C.
                stop(128 + signal);
            }
        });
    }
}

/// The signals that the program was started to ignore, as `nohup` does, one bit each; none where the system does not say.
#[cfg(unix)]
fn ignored_signals() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:")).unwrap_or_default();
    u64::from_str_radix(mask.trim(), 16).unwrap_or(0)
}

#[cfg(not(unix))]
fn arrange() {
    let _ = ctrlc::set_handler(|| stop(130));
}

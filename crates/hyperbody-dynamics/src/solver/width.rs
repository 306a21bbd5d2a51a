//! The vector width that the processor has: passes over contacts are compiled for each and chosen at run time.

/// What the machine can do; found once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Width(pulp::Arch);

impl Width {
    pub(crate) fn of_this_machine() -> Self {
        Self(pulp::Arch::new())
    }

    /// Runs `pass` compiled for this width; the bits of its results are the same for every width.
    pub(crate) fn run<R>(self, pass: impl FnOnce() -> R) -> R {
        if cfg!(target_arch = "wasm32") {
            // A module for browsers has its width from its build: a second copy would only weigh.
            return pass();
        }
        self.0.dispatch(pass)
    }
}

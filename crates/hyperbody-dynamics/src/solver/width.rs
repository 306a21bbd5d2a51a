//! The vector width that the processor has: passes over contacts are compiled for each and chosen at run time.

/// What the machine can do; found once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Width(pulp::Arch);

/// Work that is compiled anew for every width. `run` and all that it calls must be `#[inline(always)]`: a function of its
/// own (the body of a closure is one) is compiled once, for the narrowest vectors.
pub(crate) trait WidePass {
    fn run(self);
}

struct AtWidth<P>(P);

impl<P: WidePass> pulp::WithSimd for AtWidth<P> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.0.run();
    }
}

impl Width {
    pub(crate) fn of_this_machine() -> Self {
        Self(pulp::Arch::new())
    }

    /// Runs `pass` compiled for this width; the bits of its results are the same for every width.
    #[inline]
    pub(crate) fn run(self, pass: impl WidePass) {
        if cfg!(target_arch = "wasm32") {
            // A module for browsers has its width from its build: a second copy would only weigh.
            return pass.run();
        }
        self.0.dispatch(AtWidth(pass));
    }
}

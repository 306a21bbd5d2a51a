//! The threads that share a step.
//!
//! A browser's module has none. There a pool is a type without values, so that the compiler knows that nothing is ever done
//! with one: work for several threads, which is a second copy of the longest functions, is not in the module at all.

/// Bodies from which what is done for each of them alone is worth another thread's while.
pub(crate) const MANY_BODIES: usize = 500;

#[cfg(not(target_family = "wasm"))]
#[derive(Debug)]
pub(crate) struct Pool(rayon::ThreadPool);

#[cfg(not(target_family = "wasm"))]
impl Pool {
    /// So many threads, at least two; or why there are none.
    pub(crate) fn new(threads: usize) -> Result<Self, String> {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().map(Self).map_err(|error| error.to_string())
    }

    /// Does something in the pool, and waits for it.
    pub(crate) fn install<A: Send>(&self, work: impl FnOnce() -> A + Send) -> A {
        self.0.install(work)
    }
}

#[cfg(target_family = "wasm")]
#[derive(Debug)]
pub(crate) enum Pool {}

#[cfg(target_family = "wasm")]
impl Pool {
    pub(crate) fn new(_: usize) -> Result<Self, String> {
        Err("a browser's module has one thread".to_owned())
    }

    pub(crate) fn install<A: Send>(&self, _: impl FnOnce() -> A + Send) -> A {
        match *self {}
    }
}

//! The threads that share a step.
//!
//! A browser's module has none. There a pool is a type without values, so that the compiler knows that nothing is ever done
//! with one: work for several threads, which is a second copy of the longest functions, is not in the module at all.

#[cfg(not(target_family = "wasm"))]
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

/// Bodies from which what is done for each of them alone is worth another thread's while.
pub(crate) const MANY_BODIES: usize = 500;

/// Pieces into which work that is cut beforehand is cut for so many threads: more of them than threads, so that who is done early helps
/// the others.
pub(crate) fn pieces(threads: usize) -> usize {
    const A_THREAD: usize = 4;
    if threads > 1 { threads * A_THREAD } else { 1 }
}

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

    /// Does something in the pool that hands out work many times, with little time between: the other threads stay awake for a while,
    /// which to be woken takes longer than many a piece of work. Telling them allocates a little.
    pub(crate) fn attend<A: Send>(&self, work: impl FnOnce() -> A + Send) -> A {
        self.0.install(|| {
            let here = rayon::current_thread_index();
            let over = Over(Arc::default());
            let seen = Arc::clone(&over.0);
            rayon::spawn_broadcast(move |context| {
                if Some(context.index()) != here {
                    look_for_work(&seen);
                }
            });
            work()
        })
    }

    /// Does two things at the same time, and waits for both.
    fn join(&self, one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
        self.0.install(|| rayon::join(one, other));
    }
}

/// Takes work of the pool that this thread belongs to, until there is no more or none has come for a while. A thread may come here
/// while it waits for a piece of the very work that it would wait for here, so that waiting has to end by itself.
#[cfg(not(target_family = "wasm"))]
fn look_for_work(over: &AtomicBool) {
    let mut in_vain = 0;
    while in_vain < IN_VAIN && !over.load(Ordering::Relaxed) {
        if rayon::yield_now() == Some(rayon::Yield::Executed) {
            in_vain = 0;
        } else {
            in_vain += 1;
            std::thread::yield_now();
        }
    }
}

/// Times that a thread looks for work in vain before it may fall asleep: some half a millisecond.
#[cfg(not(target_family = "wasm"))]
const IN_VAIN: u32 = 1000;

/// Says, when it goes, that no more work comes.
#[cfg(not(target_family = "wasm"))]
struct Over(Arc<AtomicBool>);

#[cfg(not(target_family = "wasm"))]
impl Drop for Over {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
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

    pub(crate) fn attend<A: Send>(&self, _: impl FnOnce() -> A + Send) -> A {
        match *self {}
    }

    fn join(&self, _: impl FnOnce() + Send, _: impl FnOnce() + Send) {
        match *self {}
    }
}

/// Does two things, at the same time where there are threads.
pub(crate) fn both(pool: Option<&Pool>, one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    match pool {
        Some(pool) => pool.join(one, other),
        None => {
            one();
            other();
        }
    }
}

/// Does some work on the numbers of many bodies, so many of each, halves at the same time where there are threads.
pub(crate) fn halves<A: Send>(numbers: &mut [A], each: usize, pool: Option<&Pool>, work: &(impl Fn(&mut [A]) + Sync)) {
    let bodies = numbers.len() / each;
    if pool.is_none() || bodies <= MANY_BODIES {
        return work(numbers);
    }
    let (one, other) = numbers.split_at_mut(bodies / 2 * each);
    both(pool, || halves(one, each, pool, work), || halves(other, each, pool, work));
}

#[cfg(all(test, not(target_family = "wasm")))]
mod tests {
    use super::*;

    /// A thread that looks for work below a piece of work which is waited for gives up, and the piece gets done.
    #[test]
    fn looking_for_work_ends() {
        let pool = Pool::new(2).unwrap();
        let never = AtomicBool::new(false);
        both(Some(&pool), || look_for_work(&never), || look_for_work(&never));
    }

    /// What attends a step ends with it, also when it panics, and the next one is attended.
    #[test]
    fn a_pool_attends_again_after_a_panic() {
        let pool = Pool::new(3).unwrap();
        let panics = || pool.attend(|| panic!("as a contact hook may"));
        assert!(std::panic::catch_unwind(std::panic::AssertUnwindSafe(panics)).is_err());
        let mut numbers = vec![1; 10 * MANY_BODIES];
        pool.attend(|| halves(&mut numbers, 1, Some(&pool), &|some| some.iter_mut().for_each(|number| *number += 1)));
        assert!(numbers.iter().all(|&number| number == 2));
    }
}

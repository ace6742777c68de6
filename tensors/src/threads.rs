//! The threads of rayon. Without the feature `parallel`, and in a browser, there is only one
//! thread.

#[cfg(all(feature = "parallel", not(target_family = "wasm")))]
mod many;
#[cfg(not(all(feature = "parallel", not(target_family = "wasm"))))]
mod one;

#[cfg(all(feature = "parallel", not(target_family = "wasm")))]
pub(crate) use many::{count, join, map};
#[cfg(not(all(feature = "parallel", not(target_family = "wasm"))))]
pub(crate) use one::{count, join, map};

use std::sync::{Mutex, PoisonError};

/// A pool of working states for threads. A state may be large, so states are reused, and there are
/// hardly more states than threads.
pub(crate) struct States<W, I> {
    init: I,
    idle: Mutex<Vec<W>>,
}

impl<W, I: Fn() -> W> States<W, I> {
    /// An empty pool. The function `init` creates a state.
    pub(crate) fn new(init: I) -> Self {
        States { init, idle: Mutex::default() }
    }

    fn idle(&self) -> std::sync::MutexGuard<'_, Vec<W>> {
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes a state out of the pool. The state returns to the pool when the returned value is
    /// dropped.
    fn take(&self) -> Taken<'_, W, I> {
        let idle = self.idle().pop();
        Taken { states: self, state: Some(idle.unwrap_or_else(|| (self.init)())) }
    }
}

/// A state that is in use. It returns to the pool when this value is dropped.
struct Taken<'s, W, I: Fn() -> W> {
    states: &'s States<W, I>,
    state: Option<W>,
}

impl<W, I: Fn() -> W> Drop for Taken<'_, W, I> {
    fn drop(&mut self) {
        self.states.idle().extend(self.state.take());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Many rounds of work create no more states than there are threads. They preserve the order of
    /// the results.
    #[test]
    fn states_are_used_again() {
        let made = AtomicUsize::new(0);
        let states = States::new(|| made.fetch_add(1, Ordering::Relaxed));
        for round in 0..50 {
            let found = map(100, &states, |_, at| round * at);
            assert_eq!(found, (0..100).map(|at| round * at).collect::<Vec<_>>());
        }
        let made = made.load(Ordering::Relaxed);
        assert!((1..=count()).contains(&made), "{made} states");
    }
}

//! The threads of rayon, or one without the feature `parallel`.

#[cfg(feature = "parallel")]
use crate::limits::Limits;
#[cfg(feature = "parallel")]
use crate::stop::checkpoint;
#[cfg(feature = "parallel")]
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// The number of threads.
pub(crate) fn count() -> usize {
    #[cfg(feature = "parallel")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    1
}

/// The states of threads. A state may be large, so it is used again by other work, and there are hardly more states than threads.
pub(crate) struct States<W, I> {
    init: I,
    idle: Mutex<Vec<W>>,
}

impl<W, I: Fn() -> W> States<W, I> {
    /// No states yet; `init` makes one.
    pub(crate) fn new(init: I) -> Self {
        States { init, idle: Mutex::default() }
    }

    fn idle(&self) -> std::sync::MutexGuard<'_, Vec<W>> {
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A state that no other work uses, until the result is dropped.
    fn take(&self) -> Taken<'_, W, I> {
        let idle = self.idle().pop();
        Taken { states: self, state: Some(idle.unwrap_or_else(|| (self.init)())) }
    }
}

/// A state in use.
struct Taken<'s, W, I: Fn() -> W> {
    states: &'s States<W, I>,
    state: Option<W>,
}

impl<W, I: Fn() -> W> Drop for Taken<'_, W, I> {
    fn drop(&mut self) {
        self.states.idle().extend(self.state.take());
    }
}

/// The values of `f` at `0..n`, in order, with a state of each thread.
pub(crate) fn map<W: Send, I: Fn() -> W + Sync, T: Send>(
    n: u64,
    states: &States<W, I>,
    f: impl Fn(&mut W, u64) -> T + Send + Sync,
) -> Vec<T> {
    #[cfg(feature = "parallel")]
    {
        let limits = Limits::current();
        let values: Vec<Mutex<Option<T>>> = (0..n).map(|_| Mutex::new(None)).collect();
        let worker = || {
            let (mut taken, f, values) = (states.take(), &f, &values);
            let mut limits = limits.clone();
            let work = move |at: u64| {
                let Some(state) = &mut taken.state else { return };
                let value = limits.lend(|| {
                    checkpoint();
                    f(state, at)
                });
                *values[at as usize].lock().unwrap_or_else(PoisonError::into_inner) = Some(value);
            };
            Box::new(work) as Box<dyn FnMut(u64) + '_>
        };
        each(n, &worker);
        let value =
            |value: Mutex<Option<T>>| value.into_inner().unwrap_or_else(PoisonError::into_inner);
        values.into_iter().filter_map(value).collect()
    }
    #[cfg(not(feature = "parallel"))]
    (0..n).scan(states.take(), |taken, at| Some(f(taken.state.as_mut()?, at))).collect()
}

/// Calls a worker of each thread with `0..n`. Without generics the machinery of rayon is compiled once.
#[cfg(feature = "parallel")]
fn each<'w>(n: u64, worker: &(dyn Fn() -> Box<dyn FnMut(u64) + 'w> + Sync)) {
    (0..n).into_par_iter().for_each_init(worker, |work, at| work(at));
}

/// The results of both, on two threads if two are free.
pub(crate) fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    #[cfg(feature = "parallel")]
    {
        let limits = Limits::current();
        rayon::join(|| limits.run(a), || limits.run(b))
    }
    #[cfg(not(feature = "parallel"))]
    (a(), b())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Many rounds of work make no more states than there are threads, and keep the order.
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

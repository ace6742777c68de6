//! Work on the threads of rayon.

use super::States;
use crate::limits::Limits;
use crate::stop::checkpoint;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// The number of threads.
pub(crate) fn count() -> usize {
    rayon::current_num_threads()
}

/// The values of `f` at `0..n`, in order. Each thread has its own state.
pub(crate) fn map<W: Send, I: Fn() -> W + Sync, T: Send>(
    n: u64,
    states: &States<W, I>,
    f: impl Fn(&mut W, u64) -> T + Send + Sync,
) -> Vec<T> {
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

/// Runs a worker over `0..n` on each thread. The function is not generic, so that rayon is compiled
/// only once.
fn each<'w>(n: u64, worker: &(dyn Fn() -> Box<dyn FnMut(u64) + 'w> + Sync)) {
    (0..n).into_par_iter().for_each_init(worker, |work, at| work(at));
}

/// The results of the two closures. They run on two threads if two threads are free.
pub(crate) fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    let limits = Limits::current();
    rayon::join(|| limits.run(a), || limits.run(b))
}

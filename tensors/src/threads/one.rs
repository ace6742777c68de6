//! Work on one thread.

use super::States;
use crate::stop::checkpoint;

/// The number of threads.
pub(crate) fn count() -> usize {
    1
}

/// The values of `f` at `0..n`, in order. All calls use one state.
pub(crate) fn map<W: Send, I: Fn() -> W + Sync, T: Send>(
    n: u64,
    states: &States<W, I>,
    f: impl Fn(&mut W, u64) -> T + Send + Sync,
) -> Vec<T> {
    let value = |taken: &mut super::Taken<'_, W, I>, at| {
        checkpoint();
        Some(f(taken.state.as_mut()?, at))
    };
    (0..n).scan(states.take(), value).collect()
}

/// The results of the two closures.
pub(crate) fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    (a(), b())
}

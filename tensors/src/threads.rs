//! The threads of rayon, or one without the feature `parallel`.

#[cfg(feature = "parallel")]
use crate::scalar::effort;
#[cfg(feature = "parallel")]
use rayon::prelude::*;
#[cfg(feature = "parallel")]
use std::sync::{Mutex, PoisonError};

/// The number of threads.
pub(crate) fn count() -> usize {
    #[cfg(feature = "parallel")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    1
}

/// The values of `f` at `0..n`, in order. Each thread makes its own state by `init`.
pub(crate) fn map<W, T: Send>(
    n: u64,
    init: impl Fn() -> W + Send + Sync,
    f: impl Fn(&mut W, u64) -> T + Send + Sync,
) -> Vec<T> {
    #[cfg(feature = "parallel")]
    {
        let limit = effort::current();
        let values: Vec<Mutex<Option<T>>> = (0..n).map(|_| Mutex::new(None)).collect();
        let worker = || {
            let (mut state, f, limit, values) = (init(), &f, &limit, &values);
            let work = move |at: u64| {
                let value = effort::inherit(limit.clone(), || f(&mut state, at));
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
    (0..n).scan(init(), |state, at| Some(f(state, at))).collect()
}

/// Calls a worker of each thread with `0..n`. Without generics the machinery of rayon is compiled once.
#[cfg(feature = "parallel")]
fn each<'w>(n: u64, worker: &(dyn Fn() -> Box<dyn FnMut(u64) + 'w> + Sync)) {
    (0..n).into_par_iter().for_each_init(worker, |work, at| work(at));
}

/// Both, on two threads if two are free.
pub(crate) fn join(a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    rayon::join(a, b);
    #[cfg(not(feature = "parallel"))]
    {
        a();
        b();
    }
}

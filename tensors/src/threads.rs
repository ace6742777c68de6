//! The threads of rayon, or one without the feature `parallel`.

#[cfg(feature = "parallel")]
use crate::scalar::effort;
#[cfg(feature = "parallel")]
use rayon::prelude::*;

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
        let f = |state: &mut W, at: u64| effort::inherit(limit.clone(), || f(state, at));
        (0..n).into_par_iter().map_init(init, f).collect()
    }
    #[cfg(not(feature = "parallel"))]
    (0..n).scan(init(), |state, at| Some(f(state, at))).collect()
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

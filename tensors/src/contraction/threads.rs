//! Threads for a contraction: those of rayon, or one without the feature `parallel`.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// The number of threads.
pub(super) fn count() -> usize {
    #[cfg(feature = "parallel")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    1
}

/// The values of `f` at `0..n`, in order. Each thread makes its own state by `init`.
#[cfg(feature = "parallel")]
pub(super) fn map<W, T: Send>(
    n: u64,
    init: impl Fn() -> W + Send + Sync,
    f: impl Fn(&mut W, u64) -> T + Send + Sync,
) -> Vec<T> {
    (0..n).into_par_iter().map_init(init, f).collect()
}

#[cfg(not(feature = "parallel"))]
pub(super) fn map<W, T>(n: u64, init: impl Fn() -> W, f: impl Fn(&mut W, u64) -> T) -> Vec<T> {
    let mut state = init();
    (0..n).map(|at| f(&mut state, at)).collect()
}

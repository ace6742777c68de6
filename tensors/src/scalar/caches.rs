//! The caches of symbolic computations.

use super::symbolic;

/// Frees the memory of the caches of symbolic computations of this thread: sums, quotients, shapes
/// and texts of short values. Results do not change, but the next computation is slower.
///
/// Each thread stores a limited number of values: at most 131,072 sums, 131,072 shapes and texts,
/// and 114,688 other values. Each value has at most 48 terms. The call
/// `rayon::broadcast(|_| clear_caches())` frees the values of all threads of a pool.
///
/// ```
/// use affinor_tensors::{Symbolic, scalar::clear_caches};
/// let value: Symbolic = "a/(b + c) + b/(b + c)".parse()?;
/// clear_caches();
/// assert_eq!("(a + b)/(b + c)".parse::<Symbolic>()?, value);
/// # Ok::<(), affinor_tensors::expression::ExpressionError>(())
/// ```
pub fn clear_caches() {
    symbolic::clear_caches();
}

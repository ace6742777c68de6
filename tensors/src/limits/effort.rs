//! A limit on the size of symbolic computations.
//!
//! The limit counts terms, not seconds, so a computation ends in the same way on every machine, and
//! with any number of threads.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// A limit on the number of terms in the sums of symbolic values.
///
/// ```
/// use affinor_tensors::{Effort, Symbolic};
/// let power = |effort: &std::sync::Arc<Effort>| {
///     let base: Symbolic = "a + b + c".parse().unwrap();
///     effort.bound(|| (0..20).fold(base.clone(), |power, _| power * &base))
/// };
/// assert!(power(&Effort::new(10_000)).is_ok());
/// let refused = power(&Effort::new(100)).unwrap_err();
/// assert!(refused.to_string().starts_with("the formulas exceed the limit of 100 terms"));
/// ```
#[derive(Debug)]
pub struct Effort {
    limit: u64,
    pub(crate) terms: AtomicU64,
    pub(crate) products: AtomicU64,
}

/// The error of a computation that has exceeded its limit on terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EffortExceeded {
    /// The number of terms that are allowed.
    pub limit: u64,
}

/// The number of products of terms that are allowed for each term.
const PRODUCTS: u64 = 512;

impl Effort {
    /// The default limit of the command line, in terms: about 3 GB of formulas.
    pub const DEFAULT: u64 = 20_000_000;

    /// A limit on the number of terms of all values together, including intermediate values. The
    /// number of products of terms is limited too: 512 products are allowed for each term.
    pub fn new(limit: u64) -> Arc<Self> {
        Arc::new(Effort { limit, terms: AtomicU64::new(0), products: AtomicU64::new(0) })
    }

    /// The number of terms that have been formed so far.
    pub fn terms(&self) -> u64 {
        self.terms.load(Relaxed)
    }

    /// The error if the limit is exceeded. In this case, values that are formed later are
    /// meaningless.
    pub fn exceeded(&self) -> Option<EffortExceeded> {
        let products = self.products.load(Relaxed) > self.limit.saturating_mul(PRODUCTS);
        (products || self.terms() > self.limit).then_some(EffortExceeded { limit: self.limit })
    }
}

impl fmt::Display for EffortExceeded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let products = self.limit.saturating_mul(PRODUCTS);
        write!(
            f,
            "the formulas exceed the limit of {} terms, or of {products} intermediate products of terms",
            self.limit
        )
    }
}

impl std::error::Error for EffortExceeded {}

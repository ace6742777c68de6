//! A limit on the size of symbolic computations.
//!
//! The limit counts terms, not seconds, so the same computation ends in the same way on every
//! machine and with any number of threads.

use crate::limits::Limits;
use crate::stop::checkpoint;
use std::cell::Cell;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// The terms that the sums of symbolic values have formed, and how many they may form.
///
/// ```
/// use affinor_tensors::{Effort, Symbolic};
/// let power = |effort: &std::sync::Arc<Effort>| {
///     let base: Symbolic = "a + b + c".parse().unwrap();
///     effort.bound(|| (0..20).fold(base.clone(), |power, _| power * &base))
/// };
/// assert!(power(&Effort::new(10_000)).is_ok());
/// let refused = power(&Effort::new(100)).unwrap_err();
/// assert!(refused.to_string().starts_with("the formulas pass the limit of 100 terms"));
/// ```
#[derive(Debug)]
pub struct Effort {
    limit: u64,
    terms: AtomicU64,
    products: AtomicU64,
}

/// A computation that passed its limit, and was ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EffortExceeded {
    /// The number of terms allowed.
    pub limit: u64,
}

/// The products of terms that are allowed for each term.
const PRODUCTS: u64 = 512;

thread_local! {
    /// All that this thread counted, with and without a limit.
    static COUNTED: Cell<Counted> = const { Cell::new(Counted { terms: 0, products: 0 }) };
}

/// The terms and the products of terms of a computation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counted {
    terms: u64,
    products: u64,
}

impl Counted {
    /// A result, and what was counted on the way to it; `None` if the limit was passed, and the result is not to be kept.
    pub fn of<T>(work: impl FnOnce() -> T) -> (T, Option<Counted>) {
        let before = COUNTED.get();
        let result = work();
        let after = COUNTED.get();
        let counted = Counted {
            terms: after.terms.wrapping_sub(before.terms),
            products: after.products.wrapping_sub(before.products),
        };
        (result, products(0).then_some(counted))
    }

    /// Counts the same once more, for a result that was kept. So a limit does not depend on what is kept.
    pub fn again(self) {
        charge(self);
    }
}

impl Effort {
    /// The limit that programs set: about 3 GB of formulas.
    pub const DEFAULT: u64 = 20_000_000;

    /// A limit on the number of terms of all values together, intermediate ones included, and on the
    /// products of terms, 512 for each term.
    pub fn new(limit: u64) -> Arc<Self> {
        Arc::new(Effort { limit, terms: AtomicU64::new(0), products: AtomicU64::new(0) })
    }

    /// The terms formed so far.
    pub fn terms(&self) -> u64 {
        self.terms.load(Relaxed)
    }

    /// The result of work within the limit. Beyond it sums are no longer computed, so that the work ends
    /// soon, and its result is thrown away.
    ///
    /// # Errors
    /// [`EffortExceeded`].
    pub fn bound<T>(self: &Arc<Self>, work: impl FnOnce() -> T) -> Result<T, EffortExceeded> {
        let limits = Limits { effort: Some(self.clone()), ..Limits::current() };
        let result = limits.run(work);
        self.exceeded().map_or(Ok(result), Err)
    }

    /// The refusal, once the limit is passed. Values that are formed afterwards are no results.
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
            "the formulas pass the limit of {} terms, or of {products} products of terms on the way",
            self.limit
        )
    }
}

impl std::error::Error for EffortExceeded {}

/// Whether the limit allows this too.
fn charge(by: Counted) -> bool {
    checkpoint();
    let Counted { terms, products } = COUNTED.get();
    COUNTED.set(Counted {
        terms: terms.wrapping_add(by.terms),
        products: products.wrapping_add(by.products),
    });
    Limits::with(|limits| match &limits.effort {
        None => true,
        Some(effort) => {
            effort.terms.fetch_add(by.terms, Relaxed);
            effort.products.fetch_add(by.products, Relaxed);
            effort.exceeded().is_none()
        }
    })
}

/// Counts products of terms before they are formed. Whether the limit allows them.
pub(super) fn products(count: usize) -> bool {
    charge(Counted { terms: 0, products: count as u64 })
}

/// Counts the terms of a value. Whether the limit allows them.
pub(super) fn terms(count: usize) -> bool {
    charge(Counted { terms: count as u64, products: 0 })
}

//! Counts the terms of symbolic values, and compares the count with the limit.

use crate::limits::{Effort, EffortExceeded, Limits};
use crate::stop::checkpoint;
use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::Ordering::Relaxed;

thread_local! {
    /// The number of all terms and products that this thread has counted, with and without a limit.
    static COUNTED: Cell<Counted> = const { Cell::new(Counted { terms: 0, products: 0 }) };
}

/// The numbers of terms and of products of terms in a computation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counted {
    terms: u64,
    products: u64,
}

impl Counted {
    /// Runs `work`. Returns its result and its count. The count is `None` if the limit was
    /// exceeded; in this case, the result must not be cached.
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

    /// Counts the terms of a cached result again, so that the limit does not depend on the content
    /// of the caches.
    pub fn again(self) {
        charge(self);
    }
}

impl Effort {
    /// Runs `work` within the limit. Once the limit is exceeded, sums are no longer computed, so
    /// the work ends soon. Its result is then discarded.
    ///
    /// # Errors
    /// [`EffortExceeded`] if the limit is exceeded.
    pub fn bound<T>(self: &Arc<Self>, work: impl FnOnce() -> T) -> Result<T, EffortExceeded> {
        let limits = Limits { effort: Some(self.clone()), ..Limits::current() };
        let result = limits.run(work);
        self.exceeded().map_or(Ok(result), Err)
    }
}

/// Adds to the count. Returns whether the count is still within the limit.
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

/// Counts products of terms before they are formed. Returns whether the limit allows them.
pub(super) fn products(count: usize) -> bool {
    charge(Counted { terms: 0, products: count as u64 })
}

/// Counts the terms of a value. Returns whether the limit allows them.
pub(super) fn terms(count: usize) -> bool {
    charge(Counted { terms: count as u64, products: 0 })
}

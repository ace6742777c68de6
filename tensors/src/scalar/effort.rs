//! Counts the terms of symbolic values against their limit.

use crate::limits::{Effort, EffortExceeded, Limits};
use crate::stop::checkpoint;
use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::Ordering::Relaxed;

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
}

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

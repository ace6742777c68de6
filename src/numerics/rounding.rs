//! Rejects results that rounding errors may change too much.

use crate::Error;

/// The largest accepted relative change of a result by rounding errors.
const LOST: f64 = 1e-6;

/// Returns an error for the object `what` if rounding errors may change it by more than a
/// millionth; `reason` describes the cause and receives the change as text.
pub(crate) fn expect_digits(
    what: &'static str,
    lost: f64,
    reason: impl FnOnce(String) -> String,
) -> Result<(), Error> {
    if lost > LOST {
        return Err(Error::Invalid { what, reason: reason(format!("{lost:.0e}")) });
    }
    Ok(())
}

/// Like [`expect_digits`], for `log(exp(x) exp(y))`.
pub(crate) fn expect_digits_of_product(lost: f64) -> Result<(), Error> {
    expect_digits("logarithm of the product", lost, |lost| {
        format!("the rounding of exp(x) exp(y) may change it by {lost}: x and y are too large")
    })
}

//! Results that rounding may change too much are refused.

use crate::Error;

/// The largest change of a result by rounding.
const LOST: f64 = 1e-6;

/// Refuses the object `what` if rounding may change it by more than a millionth; `reason` says why, with the change as text.
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

/// [`expect_digits`] of `log(exp(x) exp(y))`.
pub(crate) fn expect_digits_of_product(lost: f64) -> Result<(), Error> {
    expect_digits("logarithm of the product", lost, |lost| {
        format!("the rounding of exp(x) exp(y) may change it by {lost}: x and y are too large")
    })
}

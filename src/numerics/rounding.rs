//! Rejects results that rounding errors may have changed too much.

use crate::Error;

/// The largest accepted relative change of a result due to rounding errors.
const LOST: f64 = 1e-6;

/// Returns an error for the object `what` if rounding errors may change it by more than a
/// millionth. The function `reason` returns the description of the cause; its argument is the
/// change as text.
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

/// Checks the result of `log(exp(x) exp(y))` as in [`expect_digits`].
pub(crate) fn expect_digits_of_product(lost: f64) -> Result<(), Error> {
    expect_digits("logarithm of the product", lost, |lost| {
        format!(
            "x and y are too large: rounding errors of exp(x) exp(y) may change the logarithm by {lost}"
        )
    })
}

//! Records the divisors of a computation that contain parameters.

use super::Symbolic;
use std::cell::RefCell;

thread_local! {
    static DIVISORS: RefCell<Option<Vec<Symbolic>>> = const { RefCell::new(None) };
}

/// Ends the recording when the value is dropped, also if the computation panics.
struct Recording;

impl Drop for Recording {
    fn drop(&mut self) {
        DIVISORS.set(None);
    }
}

/// Runs a computation in this thread. Returns its result, and the values with parameters that were
/// inverted, each of them once.
///
/// An elimination inverts its pivots. If no numerator or denominator of these pivots vanishes for
/// some parameter values, the elimination and the rank are also valid for these values.
///
/// ```
/// use affinor_tensors::scalar::divisors_of;
/// use affinor_tensors::{Symbolic, linear::Matrix};
/// let h = Symbolic::parameter("h");
/// let matrix = Matrix::from_dense(&[vec![h.clone(), h.clone()], vec![h.clone(), "2".parse()?]])?;
/// let (rank, divisors) = divisors_of(|| matrix.rank());
/// assert_eq!(rank?, 2);
/// let divisors: Vec<String> = divisors.iter().map(Symbolic::to_string).collect();
/// assert_eq!(divisors, ["h", "-h + 2"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn divisors_of<T>(work: impl FnOnce() -> T) -> (T, Vec<Symbolic>) {
    DIVISORS.set(Some(vec![]));
    let recording = Recording;
    let result = work();
    let divisors = DIVISORS.take().unwrap_or_default();
    drop(recording);
    (result, divisors)
}

/// Records a divisor if this thread is recording.
pub(super) fn record(value: &Symbolic) {
    DIVISORS.with_borrow_mut(|divisors| {
        if let Some(divisors) = divisors
            && !divisors.contains(value)
        {
            divisors.push(value.clone());
        }
    });
}

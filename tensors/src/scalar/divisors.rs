//! The values with parameters by which a computation divides.

use super::Symbolic;
use std::cell::RefCell;

thread_local! {
    static DIVISORS: RefCell<Option<Vec<Symbolic>>> = const { RefCell::new(None) };
}

/// Ends the recording, also where the computation ends by a panic.
struct Recording;

impl Drop for Recording {
    fn drop(&mut self) {
        DIVISORS.set(None);
    }
}

/// The result of a computation in this thread, and the values with parameters of which it took inverses, each once.
///
/// An elimination takes the inverses of its pivots. Where none of their numerators and denominators vanishes, the elimination is valid
/// for these values of the parameters too, and so is the rank.
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

/// Records a value, if this thread records values.
pub(super) fn record(value: &Symbolic) {
    DIVISORS.with_borrow_mut(|divisors| {
        if let Some(divisors) = divisors
            && !divisors.contains(value)
        {
            divisors.push(value.clone());
        }
    });
}

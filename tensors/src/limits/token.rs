//! A flag that stops computations.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, AtomicUsize, Ordering::Relaxed};

/// The reason why a computation was stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopReason {
    /// A signal, or a request of the user, stops the computation.
    Interrupted,
    /// The limit on the time is exceeded.
    Timeout,
    /// The limit on the memory is exceeded.
    Memory,
}

/// A flag that stops all computations that run under it. Clones share the same flag.
///
/// ```
/// use affinor_tensors::stop::{StopReason, StopToken};
/// use affinor_tensors::Symbolic;
/// use std::{thread, time::Duration};
/// let token = StopToken::new();
/// let watcher = token.clone();
/// thread::spawn(move || {
///     thread::sleep(Duration::from_millis(50));
///     watcher.request(StopReason::Timeout);
/// });
/// // a power of a sum that would never end
/// let sum: Symbolic = "a + b + c".parse()?;
/// let stopped = token.run(|| (0..1_000_000).fold(sum.clone(), |power, _| power * &sum));
/// assert_eq!(stopped.unwrap_err().reason, StopReason::Timeout);
/// # Ok::<(), affinor_tensors::expression::ExpressionError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct StopToken(Arc<Flag>);

/// The value is zero if the flag is not set. Otherwise, it is the position of the reason in
/// [`REASONS`] plus one.
#[derive(Debug, Default)]
struct Flag(AtomicU8);

const REASONS: [StopReason; 3] = [StopReason::Interrupted, StopReason::Timeout, StopReason::Memory];

/// The number of tokens of this process whose flag is set. While the number is zero, a checkpoint
/// costs one load and one branch.
static REQUESTED: AtomicUsize = AtomicUsize::new(0);

impl Drop for Flag {
    fn drop(&mut self) {
        if *self.0.get_mut() != 0 {
            REQUESTED.fetch_sub(1, Relaxed);
        }
    }
}

impl StopToken {
    /// A flag that is not set.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the flag. Only the first reason is stored.
    pub fn request(&self, reason: StopReason) {
        let code = REASONS.iter().position(|own| *own == reason).map_or(0, |at| at as u8 + 1);
        if self.0.0.compare_exchange(0, code, Relaxed, Relaxed).is_ok() {
            REQUESTED.fetch_add(1, Relaxed);
        }
    }

    /// The reason for which the flag is set; `None` if it is not set.
    pub fn requested(&self) -> Option<StopReason> {
        REASONS.get(usize::from(self.0.0.load(Relaxed)).checked_sub(1)?).copied()
    }
}

/// Whether the flag of any token of this process is set.
#[inline]
pub(crate) fn is_any_requested() -> bool {
    REQUESTED.load(Relaxed) != 0
}

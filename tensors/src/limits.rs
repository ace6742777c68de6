//! The limits of a computation. All threads of the computation have the same limits.

mod effort;
mod token;

pub use effort::{Effort, EffortExceeded};
pub(crate) use token::is_any_requested;
pub use token::{StopReason, StopToken};

use std::cell::RefCell;
use std::sync::Arc;

/// The limits under which a thread computes. They are the number of terms of symbolic values
/// ([`Effort`]), a [`StopToken`], and the [stage](crate::stop::stage) that the token reports.
///
/// Kernels pass their limits to their worker threads. Code that starts other threads should pass
/// the limits in the same way:
///
/// ```
/// use affinor_tensors::Limits;
/// use affinor_tensors::stop::{StopReason, StopToken, checkpoint};
/// let token = StopToken::new();
/// token.request(StopReason::Interrupted);
/// let stopped = token.run(|| {
///     let limits = Limits::current();
///     std::thread::scope(|scope| {
///         let worker = scope.spawn(|| limits.run(checkpoint));
///         worker.join().unwrap_or_else(|payload| std::panic::resume_unwind(payload));
///     });
/// });
/// assert_eq!(stopped.unwrap_err().reason, StopReason::Interrupted);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Limits {
    pub(crate) effort: Option<Arc<Effort>>,
    pub(crate) stop: Option<StopToken>,
    pub(crate) stage: &'static str,
}

thread_local! {
    static CURRENT: RefCell<Limits> =
        const { RefCell::new(Limits { effort: None, stop: None, stage: "" }) };
}

impl Limits {
    /// The limits of the current thread.
    pub fn current() -> Self {
        Self::with(Clone::clone)
    }

    /// Runs `work` under these limits.
    pub fn run<T>(&self, work: impl FnOnce() -> T) -> T {
        self.clone().lend(work)
    }

    /// Calls `read` with the limits of the current thread.
    pub(crate) fn with<T>(read: impl FnOnce(&Limits) -> T) -> T {
        CURRENT.with_borrow(read)
    }

    /// Sets the stage of the current thread. Returns the previous stage.
    pub(crate) fn set_stage(stage: &'static str) -> &'static str {
        CURRENT.with_borrow_mut(|limits| std::mem::replace(&mut limits.stage, stage))
    }

    /// Runs `work` after exchanging these limits with the limits of the thread. No references are
    /// counted, so workers call this method for each small piece of work.
    pub(crate) fn lend<T>(&mut self, work: impl FnOnce() -> T) -> T {
        /// Restores the limits of the thread when the value is dropped, also if the work unwinds.
        struct Lent<'l>(&'l mut Limits);
        impl Drop for Lent<'_> {
            fn drop(&mut self) {
                exchange(self.0);
            }
        }
        exchange(self);
        let _lent = Lent(self);
        work()
    }
}

fn exchange(limits: &mut Limits) {
    CURRENT.with_borrow_mut(|current| std::mem::swap(current, limits));
}

//! Computations that can be stopped from outside.
//!
//! A [`StopToken`] is a flag. Kernels poll it at [checkpoints](checkpoint), also on their worker
//! threads. If it is set, the computation unwinds to [`StopToken::run`], which returns [`Stopped`].
//! Therefore, formulas need no error type for stopped computations. No result of a stopped
//! computation is stored, and the next computation starts as in a new process.
//!
//! Unwinding calls no panic hook. Programs that are built with `panic = "abort"` must not use
//! tokens.

pub use crate::limits::{StopReason, StopToken};

use crate::limits::{Limits, is_any_requested};
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::thread;
use std::time::Duration;

impl StopToken {
    /// The token under which this thread computes; `None` if there is no token.
    pub fn current() -> Option<Self> {
        Limits::with(|limits| limits.stop.clone())
    }

    /// Runs `work`, and returns its result. The checkpoints of the work poll this flag and no other
    /// flag. If the work unwinds, values that it changes through references may remain in an
    /// intermediate state.
    ///
    /// # Errors
    /// [`Stopped`] if the flag is set before the work ends.
    pub fn run<T>(&self, work: impl FnOnce() -> T) -> Result<T, Stopped> {
        let limits = Limits { stop: Some(self.clone()), ..Limits::current() };
        catch_unwind(AssertUnwindSafe(|| limits.run(work))).map_err(|payload| {
            match payload.downcast::<Stopped>() {
                Ok(stopped) => *stopped,
                Err(panic) => resume_unwind(panic),
            }
        })
    }
}

/// The error of a computation that was stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stopped {
    /// The reason for which the computation was stopped.
    pub reason: StopReason,
    /// The stage during which the computation was stopped. It is empty if the computation does not
    /// name its stages.
    pub stage: &'static str,
}

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self.reason {
            StopReason::Interrupted => "interrupted",
            StopReason::Timeout => "the computation reached its time limit",
            StopReason::Memory => "the computation reached its memory limit",
        })?;
        match self.stage {
            "" => Ok(()),
            stage => write!(f, ", in the stage `{stage}`"),
        }
    }
}

impl std::error::Error for Stopped {}

/// Ends the computation if the token of this thread is set. Loops call this function if one
/// iteration may take longer than a few microseconds.
///
/// ```
/// use affinor_tensors::stop::{StopReason, StopToken, Stopped, checkpoint, stage};
/// checkpoint();
/// let token = StopToken::new();
/// token.request(StopReason::Memory);
/// let stopped = token.run(|| {
///     let _stage = stage("curvature");
///     checkpoint();
/// });
/// assert_eq!(stopped, Err(Stopped { reason: StopReason::Memory, stage: "curvature" }));
/// ```
#[inline]
pub fn checkpoint() {
    // does not poll in the web page, which has no token and only one thread
    if !cfg!(target_family = "wasm") && is_any_requested() {
        end();
    }
}

/// Unwinds to [`StopToken::run`] if the token of this thread is set.
#[cold]
fn end() {
    let found = Limits::with(|limits| Some((limits.stop.as_ref()?.requested()?, limits.stage)));
    if let Some((reason, stage)) = found
        && !thread::panicking()
    {
        resume_unwind(Box::new(Stopped { reason, stage }));
    }
}

/// Names the current stage of the computation, which [`Stopped`] reports. The stage ends when the
/// returned value is dropped.
#[must_use = "the stage ends when the value is dropped"]
pub fn stage(name: &'static str) -> Stage {
    Stage { before: Limits::set_stage(name) }
}

/// A stage of a computation. It ends when this value is dropped.
#[derive(Debug)]
pub struct Stage {
    before: &'static str,
}

impl Drop for Stage {
    fn drop(&mut self) {
        Limits::set_stage(self.before);
    }
}

/// The interval at which a thread polls while it waits for [`detached`] work.
const OFTEN: Duration = Duration::from_millis(10);

/// The result of long work without checkpoints, such as a function of another library. If this
/// thread has a token, another thread does the work. If the token is set, this thread unwinds, and
/// the result of the other thread is discarded.
///
/// ```
/// use affinor_tensors::stop::{StopReason, StopToken, detached};
/// use std::{sync::mpsc, thread, time::Duration};
/// assert_eq!(detached(|| 2 + 2), 4);
/// let token = StopToken::new();
/// let (done, wait) = mpsc::channel::<()>();
/// token.request(StopReason::Timeout);
/// // it would wait for ever
/// assert!(token.run(|| detached(move || wait.recv())).is_err());
/// drop(done);
/// ```
pub fn detached<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    if cfg!(target_family = "wasm") || Limits::with(|limits| limits.stop.is_none()) {
        return work();
    }
    checkpoint();
    let (send, receive) = mpsc::channel();
    let work = Arc::new(Mutex::new(Some(work)));
    let take = |work: &Mutex<Option<_>>| work.lock().unwrap_or_else(PoisonError::into_inner).take();
    let shared = work.clone();
    let thread = thread::Builder::new().spawn(move || {
        if let Some(work) = take(&shared) {
            // ignores a failure to send, which means that the calling thread has unwound and
            // dropped the receiver
            let _ = send.send(catch_unwind(AssertUnwindSafe(work)));
        }
    });
    if thread.is_err()
        && let Some(work) = take(&work)
    {
        return work();
    }
    loop {
        match receive.recv_timeout(OFTEN) {
            Ok(result) => return result.unwrap_or_else(|panic| resume_unwind(panic)),
            Err(_) => checkpoint(),
        }
    }
}

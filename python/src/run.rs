//! The only way to run computations: without the interpreter lock, in a thread pool of this process, with panics
//! converted to exceptions.

use crate::errors;
use crate::limits::Watch;
use affinor_documents::input::InputError;
use affinor_tensors::Limits;
use affinor_tensors::scalar;
use affinor_tensors::stop::{StopToken, Stopped};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError, mpsc};

/// The thread pool of a process. A pool does not survive `fork`, so a child process creates its own pool.
struct Pool {
    process: u32,
    threads: Arc<ThreadPool>,
}

/// The pool, and the number of threads that was set; 0 means all cores.
static POOL: Mutex<(Option<Pool>, usize)> = Mutex::new((None, 0));

fn pool() -> Result<Arc<ThreadPool>, InputError> {
    let mut state = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some(pool) = state.0.as_ref().filter(|pool| pool.process == process) {
        return Ok(pool.threads.clone());
    }
    // forgets the pool of the parent process without dropping it, because its threads do not exist in this process
    std::mem::forget(state.0.take());
    let threads = ThreadPoolBuilder::new().num_threads(state.1).build();
    let threads =
        threads.map_err(|error| InputError::usage(format!("cannot start the threads: {error}")))?;
    let threads = Arc::new(threads);
    state.0 = Some(Pool { process, threads: threads.clone() });
    Ok(threads)
}

/// Threads that run computations.
pub struct Threads(Arc<ThreadPool>);

impl Threads {
    /// The threads that all computations of this process share.
    pub fn shared(py: Python<'_>) -> PyResult<Self> {
        pool().map(Threads).map_err(|error| errors::raise(py, &error))
    }

    /// Separate threads for one computation: one thread for each of its parts, but at most the number that was set.
    pub fn apart(py: Python<'_>, parts: usize) -> PyResult<Self> {
        let count = Self::shared(py)?.0.current_num_threads().min(parts).max(1);
        let threads = ThreadPoolBuilder::new().num_threads(count).build();
        let failed = |error| InputError::usage(format!("cannot start the threads: {error}"));
        let threads = threads.map_err(|error| errors::raise(py, &failed(error)))?;
        Ok(Threads(threads.into()))
    }

    /// Runs a computation. A signal or a limit in Python stops the computation.
    pub fn run<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> Result<T, InputError> + Send,
    ) -> PyResult<T> {
        if StopToken::current().is_some() {
            // within another computation, the monitor of that computation is sufficient
            let limits = Limits::current();
            let work = || limits.run(|| self.0.install(|| limits.run(work)));
            return finish(py, py.detach(|| catch_unwind(AssertUnwindSafe(work))));
        }
        let mut watch = Watch::begin(py)?;
        let done = py.detach(|| {
            let (token, (end, ended)) = (watch.token(), mpsc::channel());
            self.0.in_place_scope(|scope| {
                scope.spawn(move |_| {
                    let done = catch_unwind(AssertUnwindSafe(|| token.run(work)));
                    // ignores the result: sending cannot fail, because the receiver waits
                    let _ = end.send(done);
                });
                loop {
                    match ended.recv_timeout(watch.pause()) {
                        Ok(done) => break done,
                        Err(_) => watch.look(),
                    }
                }
            })
        });
        match done {
            Ok(done) => watch.finish(py, done)?.map_err(|error| errors::raise(py, &error)),
            Err(panic) => finish(py, Err(panic)),
        }
    }

    /// Runs the same work once on each thread.
    pub fn each(&self, py: Python<'_>, work: &(dyn Fn() + Sync)) -> PyResult<()> {
        self.run(py, || {
            let limits = Limits::current();
            self.0.broadcast(|_| limits.run(work));
            Ok(())
        })
    }
}

/// Runs a computation on the threads of this process.
pub fn run<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, InputError> + Send,
) -> PyResult<T> {
    Threads::shared(py)?.run(py, work)
}

/// Runs a computation in the calling thread, because it takes less time than the start of threads.
pub fn run_here<T>(py: Python<'_>, work: impl FnOnce() -> Result<T, InputError>) -> PyResult<T> {
    finish(py, catch_unwind(AssertUnwindSafe(work)))
}

fn finish<T>(
    py: Python<'_>,
    done: Result<Result<T, InputError>, Box<dyn Any + Send>>,
) -> PyResult<T> {
    match done {
        Ok(result) => result.map_err(|error| errors::raise(py, &error)),
        // the enclosing computation was stopped, so this one ends too
        Err(panic) if panic.is::<Stopped>() => Err(PyKeyboardInterrupt::new_err(())),
        Err(panic) => {
            let text = panic.downcast_ref::<&str>().map(|text| (*text).to_string());
            let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
            Err(errors::internal(py, &text.unwrap_or_default()))
        }
    }
}

/// Sets the number of threads of computations in this process.
///
/// Parameters
/// ----------
/// count : int
///     Number of threads, up to 1024; 0 means all cores.
///
/// Raises
/// ------
/// ValueError
///     The number is negative or too large.
///
/// Examples
/// --------
/// >>> set_threads(2)
/// >>> threads()
/// 2
/// >>> set_threads(0)
#[pyfunction]
pub fn set_threads(count: &Bound<'_, PyAny>) -> PyResult<()> {
    let number = count.extract::<usize>().ok().filter(|count| *count <= MOST_THREADS);
    let expected = format!("a number from 0 (all cores) to {MOST_THREADS}");
    let number = number.ok_or_else(|| errors::wrong("count", &expected, &count.to_string()))?;
    let mut state = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let before = std::mem::replace(&mut *state, (None, number));
    if let Some(pool) = before.0.filter(|pool| pool.process != std::process::id()) {
        std::mem::forget(pool);
    }
    Ok(())
}

/// The largest number of threads of a process.
const MOST_THREADS: usize = 1024;

/// Number of threads that computations in this process use.
///
/// Returns
/// -------
/// int
///
/// Examples
/// --------
/// >>> threads() > 0
/// True
#[pyfunction]
pub fn threads(py: Python<'_>) -> PyResult<usize> {
    run(py, || Ok(rayon::current_num_threads()))
}

/// Frees the caches of symbolic computations in this process.
///
/// Results do not depend on the caches. Each thread stores a limited number of short values. The function waits until
/// other computations have ended.
///
/// Examples
/// --------
/// >>> clear_caches()
#[pyfunction]
pub fn clear_caches(py: Python<'_>) -> PyResult<()> {
    scalar::clear_caches();
    Threads::shared(py)?.each(py, &scalar::clear_caches)
}

/// Panics inside a computation, so that tests can check that Python receives an exception.
#[pyfunction]
pub fn _panic(py: Python<'_>) -> PyResult<()> {
    run(py, || -> Result<(), InputError> { panic!("a panic for the tests") })
}

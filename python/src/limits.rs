//! Monitoring of a computation: signals of Python, and limits on its time and memory.

use crate::errors;
use crate::values::python;
use affinor_documents::budget::{Budget, size};
use affinor_tensors::stop::{StopReason, StopToken, Stopped};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The polling interval.
const OFTEN: Duration = Duration::from_millis(20);

/// Limits that apply at the same time. The limits of the innermost block are first.
#[pyclass(name = "Budget", frozen, module = "affinor._engine")]
#[derive(Clone)]
pub struct PyBudget(Vec<Budget>);

/// Whether this process has ever used limits. If it has not, the context variable need not be read.
static USED: AtomicBool = AtomicBool::new(false);

#[pymethods]
impl PyBudget {
    #[new]
    #[pyo3(signature = (timeout, memory, outer))]
    fn new(
        py: Python<'_>,
        timeout: Option<f64>,
        memory: Option<Bound<'_, PyAny>>,
        outer: Option<PyRef<'_, PyBudget>>,
    ) -> PyResult<Self> {
        let bytes = |memory: Bound<'_, PyAny>| {
            let text = memory.str()?.to_string();
            size(&text).map_err(|expected| errors::wrong("memory", &expected, &text))
        };
        let memory = memory.map(bytes).transpose()?;
        let own = Budget::new(timeout, memory).map_err(|error| errors::raise(py, &error))?;
        USED.store(true, Ordering::Relaxed);
        Ok(PyBudget([vec![own], outer.map_or(vec![], |outer| outer.0.clone())].concat()))
    }
}

impl PyBudget {
    /// The limits that apply in the current context of Python.
    fn current(py: Python<'_>) -> PyResult<Self> {
        static VARIABLE: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        if !USED.load(Ordering::Relaxed) {
            return Ok(PyBudget(vec![]));
        }
        let variable = VARIABLE.get_or_try_init(py, || -> PyResult<_> {
            Ok(python(py, "_limits", "current")?.getattr("get")?.unbind())
        })?;
        let found: Option<Bound<'_, PyBudget>> = variable.call0(py)?.extract(py)?;
        Ok(found.map_or_else(|| PyBudget(vec![]), |found| found.get().clone()))
    }

    /// The first exceeded limit; `None` if no limit is exceeded.
    fn exceeded(&self) -> Option<Passed> {
        self.0.iter().find_map(|budget| Some(Passed { reason: budget.exceeded()?, of: *budget }))
    }
}

/// An exceeded limit.
struct Passed {
    reason: StopReason,
    of: Budget,
}

impl Passed {
    /// The exception for a computation that exceeded this limit in a stage.
    fn raise(&self, py: Python<'_>, stage: &str) -> PyErr {
        let message = self.of.message(self.reason, stage);
        errors::limit(py, &message, self.reason == StopReason::Memory, stage)
    }
}

/// The monitor of a computation.
pub struct Watch {
    token: StopToken,
    budget: PyBudget,
    /// The exception that a signal handler raised.
    raised: Option<PyErr>,
    passed: Option<Passed>,
}

impl Watch {
    /// Starts the monitor.
    ///
    /// # Errors
    /// An error if a limit is already exceeded.
    pub fn begin(py: Python<'_>) -> PyResult<Self> {
        let budget = PyBudget::current(py)?;
        match budget.exceeded() {
            Some(passed) => Err(passed.raise(py, "")),
            None => Ok(Watch { token: StopToken::new(), budget, raised: None, passed: None }),
        }
    }

    /// The stop token of the computation.
    pub fn token(&self) -> StopToken {
        self.token.clone()
    }

    /// The time until the next poll.
    pub fn pause(&self) -> Duration {
        let rests = self.budget.0.iter().filter_map(Budget::rest);
        rests.filter(|rest| !rest.is_zero()).fold(OFTEN, Duration::min)
    }

    /// Polls for signals and limits. Stops the computation if there is a signal or an exceeded limit.
    pub fn look(&mut self) {
        if self.raised.is_none()
            && let Err(error) = Python::attach(|py| py.check_signals())
        {
            self.raised = Some(error);
            self.token.request(StopReason::Interrupted);
        }
        if self.passed.is_none()
            && let Some(passed) = self.budget.exceeded()
        {
            self.token.request(passed.reason);
            self.passed = Some(passed);
        }
    }

    /// Returns the result of the computation, or raises the exception that stopped it.
    pub fn finish<T>(self, py: Python<'_>, done: Result<T, Stopped>) -> PyResult<T> {
        match (self.raised, done) {
            (Some(error), _) => Err(error),
            (None, Ok(result)) => Ok(result),
            (None, Err(stopped)) => Err(match self.passed {
                Some(passed) => passed.raise(py, stopped.stage),
                None => errors::internal(py, &stopped.to_string()),
            }),
        }
    }
}

//! The watch over a computation: signals of Python, and limits on its time and memory.

use crate::errors;
use crate::values::python;
use affinor_documents::budget::{Budget, size};
use affinor_tensors::stop::{StopReason, StopToken, Stopped};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The time between two looks.
pub const OFTEN: Duration = Duration::from_millis(20);

/// Limits that hold at the same time: the innermost block first.
#[pyclass(name = "Budget", frozen, module = "affinor._engine")]
#[derive(Clone)]
pub struct PyBudget(Vec<Budget>);

/// Whether this process ever made limits: the variable of the context need not be read before.
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
    /// The limits of the current context of Python.
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

    /// The limit that is passed, if any.
    fn exceeded(&self) -> Option<(StopReason, &Budget)> {
        self.0.iter().find_map(|budget| Some((budget.exceeded()?, budget)))
    }
}

/// The watch over one computation.
pub struct Watch {
    token: StopToken,
    budget: PyBudget,
    raised: Option<PyErr>,
}

impl Watch {
    /// Begins the watch.
    ///
    /// # Errors
    /// A limit that is passed already.
    pub fn begin(py: Python<'_>) -> PyResult<Self> {
        let watch = Watch { token: StopToken::new(), budget: PyBudget::current(py)?, raised: None };
        match watch.budget.exceeded() {
            Some((reason, _)) => Err(watch.stopped(py, reason, "")),
            None => Ok(watch),
        }
    }

    /// The token of the computation.
    pub fn token(&self) -> StopToken {
        self.token.clone()
    }

    /// The time until the next look.
    pub fn pause(&self) -> Duration {
        self.budget.0.iter().filter_map(Budget::rest).fold(OFTEN, Duration::min)
    }

    /// Looks for signals and limits, and stops the computation if there is one.
    pub fn look(&mut self) {
        if self.raised.is_none()
            && let Err(error) = Python::attach(|py| py.check_signals())
        {
            self.raised = Some(error);
            self.token.request(StopReason::Interrupted);
        }
        if let Some((reason, _)) = self.budget.exceeded() {
            self.token.request(reason);
        }
    }

    /// The result of the computation, or the exception that stopped it.
    pub fn finish<T>(self, py: Python<'_>, done: Result<T, Stopped>) -> PyResult<T> {
        match (self.raised, done) {
            (Some(error), _) => Err(error),
            (None, Ok(result)) => Ok(result),
            (None, Err(Stopped { reason, stage })) => {
                Err(Watch { raised: None, ..self }.stopped(py, reason, stage))
            }
        }
    }

    /// The exception of a limit.
    fn stopped(&self, py: Python<'_>, reason: StopReason, stage: &str) -> PyErr {
        let passed = self.budget.exceeded().filter(|(own, _)| *own == reason);
        let budget = passed.map(|(_, budget)| budget).or(self.budget.0.first());
        let message = budget.map_or("interrupted".into(), |own| own.message(reason, stage));
        errors::limit(py, &message, reason == StopReason::Memory, stage)
    }
}

//! Problems of motion. They are integrated in short pieces, between which Python can interrupt the integration.

use crate::arrays::{Input, batch};
use crate::class::properties;
use crate::errors::{is_a, raise, wrong};
use crate::run::{Threads, run};
use affinor::mechanics::simulation::{ForceFrame, ForceFunction, Method};
use affinor_documents::input::InputError;
use affinor_documents::problem::{Integration, Problem};
use affinor_documents::rows::DenseRows;
use affinor_tensors::stop::checkpoint;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict, PyList};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The time between two polls for a signal.
const PIECE: Duration = Duration::from_millis(20);

/// A problem of motion. The flag tells whether some of its forces are Python functions.
#[pyclass(name = "Problem", frozen, subclass, module = "affinor._engine")]
pub struct PyProblem(Problem, bool);

thread_local! {
    /// The exception that a force raised in the thread of the integration.
    static RAISED: RefCell<Option<PyErr>> = const { RefCell::new(None) };
}

/// Returns the exception that a force has raised since the last call, if any.
fn raised() -> Option<PyErr> {
    RAISED.with_borrow_mut(Option::take)
}

/// Why a run ended early.
enum Failed {
    /// An error of the engine.
    Refused(InputError),
    /// An exception that a force raised.
    Raised(PyErr),
}

impl From<Failed> for PyErr {
    fn from(failed: Failed) -> Self {
        match failed {
            Failed::Refused(error) => Python::attach(|py| raise(py, &error)),
            Failed::Raised(error) => error,
        }
    }
}

/// The result of a step. If a force raised an exception, this exception is returned, and not the error of the engine
/// that the force is not a number.
fn checked<T>(result: Result<T, impl Into<InputError>>) -> Result<T, Failed> {
    match raised() {
        Some(error) => Err(Failed::Raised(error)),
        None => result.map_err(|error| Failed::Refused(error.into())),
    }
}

/// The force that a Python function `force(t, g, omega)` computes. Its argument `g` is the matrix of the element.
fn force(function: Py<PyAny>) -> ForceFunction {
    ForceFunction::new(move |t, g, omega| {
        Python::attach(|py| {
            let call = || -> PyResult<Vec<f64>> {
                let count = omega.len();
                let rows: Vec<f64> = g.transpose().as_slice().to_vec();
                let g = PyArray1::from_vec(py, rows).reshape([g.nrows(), g.ncols()])?;
                let omega = PyArray1::from_slice(py, omega);
                let force = function.call1(py, (t, g, omega))?.into_bound(py);
                let force: Input<'_> = force.extract()?;
                if force.shape() != [count] {
                    let found = format!("of the shape {:?}", force.shape());
                    return Err(wrong(
                        "the force",
                        &format!("a list of {count} components"),
                        &found,
                    ));
                }
                Ok(force.rows(&[], &[]).row(0).to_vec())
            };
            call().unwrap_or_else(|error| {
                RAISED.with_borrow_mut(|raised| {
                    raised.get_or_insert(error);
                });
                vec![]
            })
        })
    })
}

/// The events in a piece of an integration, and whether the motion has ended.
#[derive(Default)]
struct Piece {
    events: Vec<(String, f64)>,
    done: bool,
    failed: Option<Failed>,
}

impl Piece {
    /// Integrates to the end of the motion, or to the end of the piece.
    fn integrate(
        &mut self,
        integration: &mut Integration,
        rows: &mut Vec<f64>,
        more: impl Fn() -> bool,
    ) {
        while !self.done && more() {
            match checked(integration.step()) {
                Ok(step) => {
                    step.rows.iter().for_each(|row| rows.extend_from_slice(row));
                    self.events.extend(step.events);
                    self.done = step.done;
                }
                Err(error) => {
                    (self.failed, self.done) = (Some(error), true);
                }
            }
        }
    }
}

/// The columns, the last row of each run, and for each failed run an exception or a message.
type Many<'py> = (Vec<String>, Bound<'py, PyArray2<f64>>, Vec<Option<Py<PyAny>>>);

fn table<'py>(
    py: Python<'py>,
    rows: Vec<f64>,
    width: usize,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let count = rows.len().checked_div(width).unwrap_or(0);
    PyArray1::from_vec(py, rows).reshape([count, width])
}

properties! { PyProblem, own:
    /// Name of the problem.
    name: &str = &own.0.name;
    /// Number of members of the ensemble; None without an ensemble.
    ensemble_size: Option<u64> = own.0.members();
    /// Names of the parameters that the ensemble varies.
    ensemble_parameters: Vec<String> = own.0.varied().into_iter().map(String::from).collect();
}

#[pymethods]
impl PyProblem {
    /// Creates a problem from a file, or from a text with a name for messages. Options override keys of the file.
    #[new]
    #[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    #[pyo3(signature = (path=None, text=None, set=None, method=None, step=None, tolerance=None, end=None, every=None, body=None, spatial=None))]
    fn new(
        py: Python<'_>,
        path: Option<String>,
        text: Option<(String, String)>,
        set: Option<String>,
        method: Option<String>,
        step: Option<String>,
        tolerance: Option<String>,
        end: Option<String>,
        every: Option<String>,
        body: Option<Py<PyAny>>,
        spatial: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let given = [(ForceFrame::Body, body), (ForceFrame::Spatial, spatial)];
        let given = given.into_iter().filter_map(|(side, function)| Some((side, force(function?))));
        let functions: Vec<_> = given.collect();
        let of_python = !functions.is_empty();
        let problem = run(py, || {
            let mut problem = match (&path, &text) {
                (Some(path), None) => Problem::read(path)?,
                (None, Some((name, text))) => Problem::parse(name, text)?,
                _ => return Err(InputError::usage("give a file or a text")),
            };
            if let Some(set) = &set {
                problem.set(set)?;
            }
            let [method, step, tolerance, end, every] =
                [&method, &step, &tolerance, &end, &every].map(Option::as_deref);
            problem.replace_integration(method, step, tolerance)?;
            problem.replace_times(end, every)?;
            for (side, function) in functions {
                problem = problem.with_force(side, function)?;
            }
            Ok(problem)
        })?;
        Ok(PyProblem(problem, of_python))
    }

    /// Parameters of one member of the ensemble.
    ///
    /// Parameters
    /// ----------
    /// member : int
    ///     Number of the member, from 0.
    ///
    /// Returns
    /// -------
    /// dict of float
    ///     Values of the parameters that the ensemble varies, by name.
    ///
    /// Examples
    /// --------
    /// >>> spins = {"grid": {"spin": "2, 4, 8"}}
    /// >>> top = Problem(space="so3", metric=[2, 2, 1], initial={"velocity": [0, 0, "spin"]}, output={"end": 1}, ensemble=spins)
    /// >>> top.ensemble_size, top.member_parameters(2)
    /// (3, {'spin': 8.0})
    fn member_parameters<'py>(&self, py: Python<'py>, member: u64) -> PyResult<Bound<'py, PyDict>> {
        self.0.varied().into_iter().zip(self.0.variation(member)).into_py_dict(py)
    }

    fn __repr__(&self) -> String {
        let members = self.ensemble_size().map_or(String::new(), |n| format!(", {n} members"));
        format!("<Problem {}{members}>", self.0.name)
    }

    /// Integrates a member. `progress` is called with the fraction of the time that has passed. An interrupt or an
    /// error ends the run, but its rows are returned.
    #[pyo3(signature = (member=0, progress=None))]
    fn _run<'py>(
        &self,
        py: Python<'py>,
        member: u64,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let problem = &self.0;
        // uses separate threads for Python forces: a thread that waits for Python must not begin other work
        let threads = if self.1 { Threads::apart(py, 1)? } else { Threads::shared(py)? };
        let ready = threads.run(py, || Ok(checked(problem.motion(member))))??;
        let names: Vec<String> = ready.columns.iter().map(|column| column.name.clone()).collect();
        let watched: Vec<bool> = ready.columns.iter().map(|column| column.watched).collect();
        let conserved: Vec<bool> = ready.columns.iter().map(|column| column.conserved).collect();
        let (method, why) = (ready.method.name(), ready.method.why());
        let (notes, parameter) = (ready.notes.clone(), ready.parameter.clone());
        // runs in the threads too, because the values of events at the start may call forces
        let mut integration =
            threads.run(py, || Ok(checked(Ok::<_, InputError>(problem.integrate(ready)))))??;
        let (mut rows, mut events) = (Vec::new(), Vec::new());
        let (mut failed, mut interrupt) = (None, None);
        loop {
            let mut piece = Piece::default();
            let stopped = threads.run(py, || {
                let until = Instant::now() + PIECE;
                piece.integrate(&mut integration, &mut rows, || Instant::now() < until);
                Ok(())
            });
            events.extend(piece.events);
            match piece.failed.map(PyErr::from) {
                Some(error) if error.is_instance_of::<PyException>(py) => failed = Some(error),
                // other exceptions, such as KeyboardInterrupt
                error => interrupt = error,
            }
            // a long step was stopped before it was complete
            match stopped {
                Err(error) if is_a(py, &error, "InternalError") => return Err(error),
                Err(error) if is_a(py, &error, "LimitError") => {
                    (failed, piece.done) = (Some(error), true);
                }
                stopped => interrupt = interrupt.or(stopped.err()),
            }
            let told = progress.as_ref().map(|progress| progress.call1((integration.progress(),)));
            let told = told.transpose().and_then(|_| py.check_signals());
            interrupt = told.err().or(interrupt);
            if piece.done || interrupt.is_some() {
                break;
            }
        }
        let found = PyDict::new(py);
        let width = names.len();
        found.set_item("name", &problem.name)?;
        found.set_item("columns", names)?;
        found.set_item("parameter", parameter)?;
        found.set_item("watched", watched)?;
        found.set_item("conserved", conserved)?;
        found.set_item("rows", table(py, rows, width)?)?;
        found.set_item("events", PyList::new(py, events)?)?;
        found.set_item("method", method)?;
        found.set_item("why", why)?;
        found.set_item("notes", notes)?;
        found.set_item("failed", failed)?;
        found.set_item("interrupt", interrupt)?;
        Ok(found)
    }

    /// The columns of a member, and rows that are dense enough to draw a curve.
    fn _curve<'py>(
        &self,
        py: Python<'py>,
        member: u64,
    ) -> PyResult<(Vec<String>, Bound<'py, PyArray2<f64>>)> {
        let problem = &self.0;
        let threads = if self.1 { Threads::apart(py, 1)? } else { Threads::shared(py)? };
        let (names, rows) = threads.run(py, || {
            Ok(checked((|| {
                let mut ready = problem.motion(member)?;
                let names: Vec<String> =
                    ready.columns.iter().map(|column| column.name.clone()).collect();
                let others: Vec<usize> =
                    (0..names.len()).filter(|k| names[*k] != ready.parameter).collect();
                let rows = DenseRows::along(ready.motion.as_mut(), &ready.times, &others)?;
                let names = [ready.parameter.clone()]
                    .into_iter()
                    .chain(others.iter().map(|k| names[*k].clone()));
                Ok::<_, InputError>((names.collect::<Vec<String>>(), rows))
            })()))
        })??;
        let width = names.len();
        Ok((names, table(py, rows.concat(), width)?))
    }

    /// The names of the methods of a class without step-size control, the most accurate method last. The list is empty
    /// for other classes.
    fn _own_methods(&self) -> Vec<&'static str> {
        self.0.own_methods().into_iter().map(Method::name).collect()
    }

    /// Returns the problem with rows at the initial time and at these times.
    fn _at_times(&self, times: Vec<f64>) -> Self {
        PyProblem(self.0.at_times(&times), self.1)
    }

    /// Integrates the problem once for each row of parameter values, on all threads. Returns the columns, the last row
    /// of each run, and the errors of failed runs. An interrupt ends all runs.
    fn _run_many<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        values: Input<'py>,
    ) -> PyResult<Many<'py>> {
        let own = batch("values", values.shape(), &[names.len()])?;
        let rows = values.rows(own, own);
        let count: usize = own.iter().product();
        let problem = self.0.to_the_end();
        let one = |row: &[f64]| {
            let settings = names.iter().zip(row).map(|(name, value)| format!("{name}={value:?}"));
            let mut problem = problem.clone();
            problem.set(&settings.collect::<Vec<_>>().join(",")).map_err(Failed::Refused)?;
            let ready = checked(problem.motion(0))?;
            let columns: Vec<String> =
                ready.columns.iter().map(|column| column.name.clone()).collect();
            let mut found = Vec::new();
            let mut piece = Piece::default();
            piece.integrate(&mut problem.integrate(ready), &mut found, || {
                checkpoint();
                true
            });
            let failed = piece.failed;
            let last = found.split_off(found.len().saturating_sub(columns.len()));
            failed.map_or(Ok((columns, last)), Err)
        };
        // does not run the rows as tasks of a pool, because a thread that waits for Python in a force would begin
        // another task
        let (next, found) = (AtomicUsize::new(0), Mutex::new(vec![]));
        let work = || {
            loop {
                checkpoint();
                let at = next.fetch_add(1, Ordering::Relaxed);
                if at >= count {
                    break;
                }
                let row = one(rows.row(at));
                found.lock().unwrap_or_else(PoisonError::into_inner).push((at, row));
            }
        };
        Threads::apart(py, count)?.each(py, &work)?;
        let mut found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
        found.sort_by_key(|(at, _)| *at);
        let columns = found.iter().find_map(|(_, row)| row.as_ref().ok());
        let columns = columns.map_or(vec![], |(columns, _)| columns.clone());
        let (mut last, mut failed) = (Vec::with_capacity(count * columns.len()), vec![]);
        for (_, row) in found {
            let (row, error) = match row {
                Ok((_, row)) if row.len() == columns.len() => (row, None),
                Ok(_) => (vec![], Some(text(py, "no row was reached")?)),
                Err(Failed::Refused(error)) => (vec![], Some(text(py, &error.message)?)),
                Err(Failed::Raised(error)) if error.is_instance_of::<PyException>(py) => {
                    (vec![], Some(error.into_value(py).into_any()))
                }
                Err(Failed::Raised(error)) => return Err(error),
            };
            last.extend(if error.is_some() { vec![f64::NAN; columns.len()] } else { row });
            failed.push(error);
        }
        let width = columns.len();
        Ok((columns, PyArray1::from_vec(py, last).reshape([count, width])?, failed))
    }
}

fn text(py: Python<'_>, text: &str) -> PyResult<Py<PyAny>> {
    Ok(text.into_pyobject(py)?.into_any().unbind())
}

/// Integration methods.
///
/// Returns
/// -------
/// dict of str
///     The purpose of each method, by its name. ``docs/motion.md`` describes their orders and properties.
///
/// Examples
/// --------
/// >>> methods()["rkmk853"]
/// 'any motion on a group or a homogeneous space, to a tolerance'
#[pyfunction]
pub fn methods() -> BTreeMap<&'static str, &'static str> {
    Method::ALL.iter().map(|method| (method.name(), method.why())).collect()
}

//! Problems of motion, and their integration in short pieces between which Python can interrupt.

use crate::arrays::{Floats, Rows, batch};
use crate::errors::{raise, wrong};
use crate::run::{run, run_here};
use affinor::mechanics::motions::{ForceFunction, Side};
use affinor_documents::definition::InputError;
use affinor_documents::problem::{Problem, Walk};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use rayon::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The time between two looks for a signal.
const PIECE: Duration = Duration::from_millis(20);

/// A problem of motion.
#[pyclass(name = "Problem", frozen, module = "affinor._engine")]
pub struct PyProblem(Problem, Failure);

/// The exception of a force that is a function of Python.
type Failure = Arc<Mutex<Option<PyErr>>>;

/// The force that a function of Python computes: `force(t, g, omega)`, with the element as a matrix.
fn force(function: Py<PyAny>, failure: Failure) -> ForceFunction {
    ForceFunction::new(move |t, g, omega| {
        Python::attach(|py| {
            let call = || -> PyResult<Vec<f64>> {
                let count = omega.len();
                let rows: Vec<f64> = g.transpose().as_slice().to_vec();
                let g = PyArray1::from_vec(py, rows).reshape([g.nrows(), g.ncols()])?;
                let omega = PyArray1::from_slice(py, omega);
                let force = function.call1(py, (t, g, omega))?.into_bound(py);
                let force: Floats<'_> = force.extract()?;
                if force.shape() != [count] {
                    let found = format!("of the shape {:?}", force.shape());
                    return Err(wrong(
                        "the force",
                        &format!("a list of {count} components"),
                        &found,
                    ));
                }
                Ok(Rows::new(&force, &[], &[]).row(0).to_vec())
            };
            call().unwrap_or_else(|error| {
                failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                vec![]
            })
        })
    })
}

impl PyProblem {
    /// The exception that a force raised.
    fn failure(&self) -> Option<PyErr> {
        self.1.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// The events of a piece of a walk, and whether it has ended.
#[derive(Default)]
struct Piece {
    events: Vec<(String, f64)>,
    done: bool,
    failed: Option<InputError>,
}

impl Piece {
    /// Walks until the end of the motion or of the piece.
    fn walk(walk: &mut Walk, rows: &mut Vec<f64>, until: Option<Instant>) -> Self {
        let mut piece = Piece::default();
        while !piece.done && until.is_none_or(|until| Instant::now() < until) {
            match walk.step() {
                Ok(step) => {
                    step.rows.iter().for_each(|row| rows.extend_from_slice(row));
                    piece.events.extend(step.events);
                    piece.done = step.done;
                }
                Err(error) => {
                    (piece.failed, piece.done) = (Some(error.into()), true);
                }
            }
        }
        piece
    }
}

/// The rows of one member of an ensemble, or the reason why there are none, after it the rows so far.
type Member<'py> = (Bound<'py, PyArray2<f64>>, Option<String>);

/// The columns, the last rows, and the reasons of runs that failed.
type Many<'py> = (Vec<String>, Bound<'py, PyArray2<f64>>, Vec<Option<String>>);

fn table<'py>(
    py: Python<'py>,
    rows: Vec<f64>,
    width: usize,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let count = rows.len().checked_div(width).unwrap_or(0);
    PyArray1::from_vec(py, rows).reshape([count, width])
}

#[pymethods]
impl PyProblem {
    /// A problem from a file, or from a text with a name for messages; options replace keys of the file.
    #[new]
    #[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    #[pyo3(signature = (path=None, text=None, set=None, method=None, step=None, tolerance=None, end=None, every=None, body=None, space=None))]
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
        space: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let failure = Failure::default();
        let given = [(Side::Body, body), (Side::Space, space)];
        let given = given.into_iter().filter_map(|(side, function)| Some((side, function?)));
        let functions: Vec<_> =
            given.map(|(side, function)| (side, force(function, failure.clone()))).collect();
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
        Ok(PyProblem(problem, failure))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    #[getter]
    fn text(&self) -> &str {
        self.0.text()
    }

    /// The other files that the problem names.
    #[getter]
    fn files(&self) -> Vec<String> {
        self.0.files().to_vec()
    }

    /// The number of members of the ensemble.
    #[getter]
    fn members(&self) -> Option<u64> {
        self.0.members()
    }

    /// The names of the parameters that the ensemble varies.
    #[getter]
    fn varied(&self) -> Vec<String> {
        self.0.varied().into_iter().map(String::from).collect()
    }

    /// The values of these parameters for a member, from 0.
    fn variation(&self, member: u64) -> Vec<f64> {
        self.0.variation(member)
    }

    /// Integrates a member. `progress` is called with the share of the time that is passed. An interrupt, or an error of
    /// the integration, ends the run and keeps its rows.
    #[pyo3(signature = (member=0, progress=None))]
    fn run<'py>(
        &self,
        py: Python<'py>,
        member: u64,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let problem = &self.0;
        let ready = run(py, || problem.motion(member));
        let ready = ready.map_err(|error| self.failure().unwrap_or(error))?;
        let names: Vec<String> = ready.columns.iter().map(|column| column.name.clone()).collect();
        let watched: Vec<bool> = ready.columns.iter().map(|column| column.watched).collect();
        let (method, why) = (ready.method.name(), ready.method.why());
        let notes = ready.notes.clone();
        let mut walk = problem.walk(ready);
        let (mut rows, mut events) = (Vec::new(), Vec::new());
        let (mut failed, mut interrupt) = (None, None);
        loop {
            let piece =
                run(py, || Ok(Piece::walk(&mut walk, &mut rows, Some(Instant::now() + PIECE))))?;
            events.extend(piece.events);
            if let Some(error) = self.failure() {
                return Err(error);
            }
            failed = failed.or(piece.failed);
            let told = progress.as_ref().map(|progress| progress.call1((walk.share(),)));
            let told = told.transpose().and_then(|_| py.check_signals());
            if let Err(error) = told {
                interrupt = Some(error);
                break;
            }
            if piece.done {
                break;
            }
        }
        let found = PyDict::new(py);
        let width = names.len();
        found.set_item("name", &problem.name)?;
        found.set_item("columns", names)?;
        found.set_item("watched", watched)?;
        found.set_item("rows", table(py, rows, width)?)?;
        found.set_item("events", PyList::new(py, events)?)?;
        found.set_item("method", method)?;
        found.set_item("why", why)?;
        found.set_item("notes", notes)?;
        found.set_item("failed", failed.map(|error| raise(py, &error)))?;
        found.set_item("interrupt", interrupt)?;
        Ok(found)
    }

    /// Integrates the problem once for each row of values of parameters, on all threads: the columns, the last row of each
    /// run, and the reason of its end if it failed.
    fn run_many<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        values: Floats<'py>,
    ) -> PyResult<Many<'py>> {
        let own = batch("values", &values, &[names.len()])?;
        let rows = Rows::new(&values, own, own);
        let count: usize = own.iter().product();
        let problem = self.0.to_the_end();
        let one = |row: &[f64]| {
            let settings = names.iter().zip(row).map(|(name, value)| format!("{name}={value:?}"));
            let mut problem = problem.clone();
            problem.set(&settings.collect::<Vec<_>>().join(","))?;
            let ready = problem.motion(0)?;
            let columns: Vec<String> =
                ready.columns.iter().map(|column| column.name.clone()).collect();
            let mut found = Vec::new();
            let failed = Piece::walk(&mut problem.walk(ready), &mut found, None).failed;
            let last = found.split_off(found.len().saturating_sub(columns.len()));
            failed.map_or(Ok((columns, last)), Err)
        };
        let found = run(py, || {
            Ok((0..count).into_par_iter().map(|at| one(rows.row(at))).collect::<Vec<_>>())
        })?;
        let columns = found.iter().find_map(|row| row.as_ref().ok());
        let columns = columns.map_or(vec![], |(columns, _)| columns.clone());
        let (mut last, mut failed) = (Vec::with_capacity(count * columns.len()), vec![]);
        for row in found {
            let (row, reason) = match row {
                Ok((_, row)) if row.len() == columns.len() => (row, None),
                Ok(_) => (vec![], Some("no row was reached".into())),
                Err(error) => (vec![], Some(error.message)),
            };
            last.extend(if reason.is_some() { vec![f64::NAN; columns.len()] } else { row });
            failed.push(reason);
        }
        let width = columns.len();
        Ok((columns, PyArray1::from_vec(py, last).reshape([count, width])?, failed))
    }

    /// Integrates several members of the ensemble on all threads: the rows of each, and the reason of its end if it failed.
    fn run_members<'py>(
        &self,
        py: Python<'py>,
        members: Vec<u64>,
    ) -> PyResult<(Vec<String>, Vec<Member<'py>>)> {
        let problem = &self.0;
        let first = members.first().copied().unwrap_or(0);
        let ready = run_here(py, || problem.motion(first))?;
        let names: Vec<String> = ready.columns.iter().map(|column| column.name.clone()).collect();
        let found = run(py, || {
            let member = |member: &u64| {
                let mut rows = Vec::new();
                let failed = match problem.motion(*member) {
                    Ok(ready) => Piece::walk(&mut problem.walk(ready), &mut rows, None).failed,
                    Err(error) => Some(error),
                };
                (rows, failed.map(|error| error.message))
            };
            Ok(members.par_iter().map(member).collect::<Vec<_>>())
        })?;
        let tables =
            found.into_iter().map(|(rows, failed)| Ok((table(py, rows, names.len())?, failed)));
        Ok((names.clone(), tables.collect::<PyResult<_>>()?))
    }
}

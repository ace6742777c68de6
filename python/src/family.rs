//! Geometries in bulk: one algebra with a connection, and many numeric metrics.

use crate::arrays::{Floats, fresh};
use crate::group::Array;
use crate::run::{run, run_here};
use crate::source::PySource;
use crate::values::error;
use affinor::Geometry;
use affinor::numerics::blocks::{BlockProgram, Column};
use affinor_documents::input::InputError;
use affinor_documents::report::Quantity;
use affinor_tensors::scalar::StraightLine;
use affinor_tensors::{Recorded, Tensor, Tolerance};
use nalgebra::DMatrix;
use numpy::{PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// An algebra with a connection, and a metric whose entries are inputs of recorded programs.
#[pyclass(name = "Family", frozen, module = "affinor._engine")]
pub struct PyFamily {
    geometry: Geometry<Recorded>,
    dimension: usize,
    parameters: Vec<String>,
    /// The names of the inputs: the upper triangle of the metric row by row, parameters, and two
    /// vectors.
    inputs: Vec<String>,
    /// The programs by the names of their quantities; at most one for each quantity.
    programs: Mutex<HashMap<String, Arc<Recording>>>,
}

/// The program of a quantity, and the shape of its arrays.
struct Recording {
    program: BlockProgram,
    shape: Vec<usize>,
}

/// The number of operations below which starting threads would take longer.
const SHORT: usize = 200_000;

/// The number of operations of one task.
const TASK: usize = 100_000;

/// The name of the sectional curvature, which is not a quantity of tables.
const SECTIONAL: &str = "sectional_curvature";

/// The upper triangle of a matrix: rows and columns from 0.
fn triangle(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i..n).map(move |j| (i, j)))
}

/// The numbers of an array in C order, and the distance between rows, which is 0 if there is one
/// row for all.
fn rows<'a>(array: &'a Floats<'_>, count: usize) -> PyResult<(&'a [f64], usize)> {
    let (numbers, shape) = (array.as_slice()?, array.shape());
    let step = if shape[0] == 1 { 0 } else { shape[1] };
    if shape[0] != 1 && shape[0] != count {
        return Err(PyValueError::new_err("the batches differ"));
    }
    Ok((numbers, step))
}

/// The defect of a metric.
enum Defect {
    NotFinite(f64),
    NotSymmetric([usize; 2]),
    Degenerate,
}

/// Checks a matrix `g` of `n` rows: its entries are finite, it is symmetric and, if it is a metric,
/// its determinant is nonzero up to rounding errors.
fn check(g: &[f64], n: usize, regular: bool) -> Result<(), Defect> {
    let not_a_number = |x: &&f64| !x.is_finite();
    if let Some(value) = g.iter().find(not_a_number) {
        return Err(Defect::NotFinite(*value));
    }
    for (i, j) in triangle(n) {
        let (a, b) = (g[i * n + j], g[j * n + i]);
        if (a - b).abs() > 64.0 * f64::EPSILON * (a.abs() + b.abs()) {
            return Err(Defect::NotSymmetric([i, j]));
        }
    }
    if regular && !is_regular(g, n) { Err(Defect::Degenerate) } else { Ok(()) }
}

/// Whether a symmetric matrix is regular, by elimination with pivots that do not depend on the
/// units of the basis: `g_ij/(d_i d_j)`. `d_i^2` is the larger of the magnitude of the diagonal
/// entry and `m_i^2/M`, where `m_i` is the largest magnitude in the row and `M` the largest in the
/// matrix.
fn is_regular(g: &[f64], n: usize) -> bool {
    let size = |row: &[f64]| row.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let largest = size(g);
    if largest == 0.0 {
        return n == 0;
    }
    let scale = |i: usize| {
        let row = size(&g[i * n..(i + 1) * n]);
        let own = g[i * n + i].abs().max(row * (row / largest));
        if own > 0.0 { own.sqrt().recip() } else { 0.0 }
    };
    let scales: Vec<f64> = (0..n).map(scale).collect();
    let mut m: Vec<f64> = g.to_vec();
    for (at, entry) in m.iter_mut().enumerate() {
        *entry *= scales[at / n] * scales[at % n];
    }
    for k in 0..n {
        let pivot = (k..n).max_by(|a, b| m[a * n + k].abs().total_cmp(&m[b * n + k].abs()));
        let Some(pivot) = pivot.filter(|at| m[at * n + k].abs() > 8.0 * f64::EPSILON * n as f64)
        else {
            return false;
        };
        (0..n).for_each(|column| m.swap(k * n + column, pivot * n + column));
        for i in k + 1..n {
            let factor = m[i * n + k] / m[k * n + k];
            for column in k + 1..n {
                m[i * n + column] -= factor * m[k * n + column];
            }
        }
    }
    true
}

impl PyFamily {
    /// The program of a quantity, recorded on first use.
    fn recording(&self, py: Python<'_>, key: &str) -> PyResult<Arc<Recording>> {
        let known = || self.programs.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known().get(key) {
            return Ok(found.clone());
        }
        let quantity = Quantity::from_key(key);
        if quantity.is_none() && key != SECTIONAL {
            let keys: Vec<&str> = Quantity::ALL.into_iter().map(Quantity::key).collect();
            let reason = format!("{key:?} is not one of {}", keys.join(", "));
            return Err(PyValueError::new_err(reason));
        }
        let n = self.dimension;
        let values = run(py, || match quantity {
            Some(quantity) => Ok(quantity.of(&self.geometry)?),
            None => Ok(self.sectional()?.map(|value| {
                Tensor::from_components(n, &[], [([], value)]).expect("a tensor of rank 0")
            })),
        })?;
        let undefined = || {
            let reason = format!("{key} is not defined for these geometries");
            error(py, "MathematicsError", (reason,))
        };
        let values = values.ok_or_else(undefined)?;
        let recording = run(py, || {
            let shape = vec![n; values.rank()];
            let place = |at: &[usize]| at.iter().fold(0, |place, i| place * n + i);
            let (places, mut entries): (Vec<usize>, Vec<Recorded>) =
                values.components().map(|(at, value)| (place(&at), value.clone())).unzip();
            let mut assigned = vec![false; shape.iter().product()];
            places.iter().for_each(|place| assigned[*place] = true);
            let zeros: Vec<usize> = (0..assigned.len()).filter(|at| !assigned[*at]).collect();
            entries.extend(zeros.iter().map(|_| Recorded::default()));
            let places = [places, zeros].concat();
            let program = BlockProgram::new(&StraightLine::new(&entries), &self.inputs, &places);
            let refused = || InputError::usage("a constant is beyond the range of floats");
            Ok(Recording { program: program.ok_or_else(refused)?, shape })
        })?;
        Ok(known().entry(key.into()).or_insert_with(|| recording.into()).clone())
    }

    /// The sectional curvature of the plane of the two vectors.
    fn sectional(&self) -> Result<Option<Recorded>, InputError> {
        let n = self.dimension;
        let behind = self.inputs.len() - 2 * n;
        let vector = |start: usize| -> Vec<Recorded> {
            self.inputs[start..start + n].iter().map(|name| Recorded::input(name)).collect()
        };
        let metric = self.geometry.metric().ok_or(affinor::Error::NoMetric)?;
        let (x, y) = (vector(behind), vector(behind + n));
        Ok(self.geometry.connection().sectional_curvature(metric, &x, &y)?)
    }

    /// The exception for an invalid matrix.
    fn refused(&self, py: Python<'_>, what: &str, at: usize, defect: &Defect) -> PyErr {
        let of = format!("{what} {at} of the batch");
        let message = match defect {
            Defect::NotFinite(value) => format!("{of} has the entry {value}"),
            Defect::NotSymmetric([i, j]) => {
                format!("{of} is not symmetric: its entries [{i}, {j}] and [{j}, {i}] differ")
            }
            Defect::Degenerate => {
                format!("{of} is degenerate: its determinant is zero to rounding")
            }
        };
        error(py, "MetricError", (message,))
    }
}

#[pymethods]
impl PyFamily {
    /// The family of a source whose metric has parameters with these names as the entries of its
    /// upper triangle.
    #[new]
    fn __new__(
        py: Python<'_>,
        source: PyRef<'_, PySource>,
        entries: Vec<String>,
    ) -> PyResult<Self> {
        let space = source.space(py)?;
        let definition = &space.definition;
        let geometry = run(py, || {
            let tolerance = Tolerance::default();
            let ground = definition.ground::<Recorded>(tolerance)?;
            ground.algebra_for("geometries in bulk")?;
            definition.geometry_over(ground, tolerance)
        })?;
        let dimension = geometry.frame().dimension();
        let mut parameters = definition.parameters();
        parameters.retain(|name| !entries.contains(name));
        // the names contain a space, so no parameter has the same name
        let vector = |letter: &str| (1..=dimension).map(move |i| format!("{letter} {i}")).collect();
        let (x, y): (Vec<String>, Vec<String>) = (vector("x"), vector("y"));
        let inputs = [entries, parameters.clone(), x, y].concat();
        Ok(PyFamily { geometry, dimension, parameters, inputs, programs: Mutex::default() })
    }

    /// The names of the parameters of the brackets and the connection, sorted.
    #[getter]
    fn parameters(&self) -> Vec<String> {
        self.parameters.clone()
    }

    #[getter]
    fn dimension(&self) -> usize {
        self.dimension
    }

    /// The shape of the arrays of a quantity.
    fn shape(&self, py: Python<'_>, key: &str) -> PyResult<Vec<usize>> {
        Ok(self.recording(py, key)?.shape.clone())
    }

    /// Checks matrices (count, n n): metrics, or derivatives of metrics.
    fn check(
        &self,
        py: Python<'_>,
        what: &str,
        matrices: Floats<'_>,
        regular: bool,
    ) -> PyResult<()> {
        let (n, numbers) = (self.dimension, matrices.as_slice()?);
        let size = n * n;
        let first = |(start, rows): (usize, &[f64])| {
            let mut rows = rows.chunks_exact(size).enumerate();
            rows.find_map(|(at, g)| Some((start + at, check(g, n, regular).err()?)))
        };
        const ROWS: usize = 1024;
        let found = if numbers.len() <= ROWS * size {
            first((0, numbers))
        } else {
            run(py, || {
                let tasks = numbers.par_chunks(ROWS * size).enumerate();
                Ok(tasks.find_map_first(|(task, rows)| first((task * ROWS, rows))))
            })?
        };
        found.map_or(Ok(()), |(at, defect)| Err(self.refused(py, what, at, &defect)))
    }

    /// A quantity (count, components) for metrics (count, n n), parameters (count, p) and vectors
    /// x, y (count, 2 n). If derivatives of the metrics (count, n n) are given, the derivative of
    /// the quantity. An argument of one row is used for all rows.
    #[pyo3(signature = (key, count, metrics, parameters, vectors, rates=None))]
    #[allow(clippy::too_many_arguments, reason = "called by the class of Python alone")]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        key: &str,
        count: usize,
        metrics: Floats<'py>,
        parameters: Floats<'py>,
        vectors: Floats<'py>,
        rates: Option<Floats<'py>>,
    ) -> PyResult<Array<'py>> {
        let recording = self.recording(py, key)?;
        let (program, n) = (&recording.program, self.dimension);
        let width: usize = recording.shape.iter().product();
        let out = fresh(py, &[count], &recording.shape)?;
        let columns = |array: &'_ Floats<'py>| rows(array, count).map(|(_, step)| step);
        let steps = [columns(&metrics)?, columns(&parameters)?, columns(&vectors)?];
        let arrays = [metrics.as_slice()?, parameters.as_slice()?, vectors.as_slice()?];
        let inputs: Vec<Column<'_>> = self.columns(arrays, steps).collect();
        let zero = [0.0];
        let none = Column { numbers: &zero, offset: 0, step: 0 };
        let moving: Option<Vec<Column<'_>>> = match &rates {
            None => None,
            Some(rates) => {
                let (numbers, step) = rows(rates, count)?;
                let entry = |(i, j)| Column { numbers, offset: i * n + j, step };
                let rest = std::iter::repeat_n(none, self.inputs.len() - n * (n + 1) / 2);
                Some(triangle(n).map(entry).chain(rest).collect())
            }
        };
        let task = |start: usize, out: &mut [f64]| {
            match &moving {
                None => program.evaluate(&inputs, start, out, width),
                Some(rates) => program.derivative(&inputs, rates, start, out, width),
            }
            // a number times 0 is 0, unless the number is infinite or NaN
            let sum = out.iter().fold(0.0, |sum, x| sum + x * 0.0);
            if sum == 0.0 {
                return Ok(());
            }
            let bad = |row: &[f64]| !row.iter().all(|x| x.is_finite());
            let at = start + out.chunks_exact(width).position(bad).unwrap_or(0);
            let reason = match key {
                SECTIONAL => "the plane is degenerate",
                _ => "the result is not finite",
            };
            Err(InputError::from(affinor::Error::Invalid {
                what: "geometry",
                reason: format!("{reason} in row {at} of the batch"),
            }))
        };
        {
            let mut target = out.readwrite();
            let target = target.as_slice_mut()?;
            let size = program.size() + width;
            if count.saturating_mul(size) <= SHORT {
                run_here(py, || task(0, target))?;
            } else {
                let each = (TASK / size).next_multiple_of(8).clamp(8, 4096);
                run(py, || {
                    let tasks = target.par_chunks_mut(each * width).enumerate();
                    tasks.into_par_iter().try_for_each(|(at, out)| task(at * each, out))
                })?;
            }
        }
        Ok(out)
    }

    /// The eigenvalues (count, n) of symmetric forms with respect to metrics, in ascending order; None if a metric is not
    /// positive definite.
    fn eigenvalues<'py>(
        &self,
        py: Python<'py>,
        metrics: Floats<'py>,
        forms: Floats<'py>,
    ) -> PyResult<Option<Array<'py>>> {
        let (n, count) = (self.dimension, forms.shape()[0]);
        let (numbers, step) = rows(&metrics, count)?;
        let forms = forms.as_slice()?;
        let out = fresh(py, &[count], &[n])?;
        let definite = {
            let mut target = out.readwrite();
            let target = target.as_slice_mut()?;
            let row = |at: usize, out: &mut [f64]| {
                let g = DMatrix::from_row_slice(n, n, &numbers[at * step..at * step + n * n]);
                let form = DMatrix::from_row_slice(n, n, &forms[at * n * n..(at + 1) * n * n]);
                let Some(lower) = g.cholesky().map(|cholesky| cholesky.unpack()) else {
                    return false;
                };
                let Some(half) = lower.solve_lower_triangular(&form) else { return false };
                let Some(whole) = lower.solve_lower_triangular(&half.transpose()) else {
                    return false;
                };
                let mean = (&whole + whole.transpose()) * 0.5;
                out.copy_from_slice(mean.symmetric_eigenvalues().as_slice());
                out.sort_by(f64::total_cmp);
                true
            };
            const ROWS: usize = 64;
            run(py, || {
                let tasks = target.par_chunks_mut(ROWS * n).enumerate();
                let rows = |(task, out): (usize, &mut [f64])| {
                    let mut rows = out.chunks_exact_mut(n).enumerate();
                    rows.all(|(at, out)| row(task * ROWS + at, out))
                };
                Ok(tasks.into_par_iter().all(rows))
            })?
        };
        Ok(definite.then_some(out))
    }
}

impl PyFamily {
    /// The columns of all inputs, as views of the arrays of metrics, parameters and vectors.
    fn columns<'a>(
        &self,
        [metrics, parameters, vectors]: [&'a [f64]; 3],
        steps: [usize; 3],
    ) -> impl Iterator<Item = Column<'a>> {
        let n = self.dimension;
        let entry = move |(i, j)| Column { numbers: metrics, offset: i * n + j, step: steps[0] };
        let parameter = move |offset| Column { numbers: parameters, offset, step: steps[1] };
        let component = move |offset| Column { numbers: vectors, offset, step: steps[2] };
        let entries = triangle(n).map(entry);
        entries.chain((0..self.parameters.len()).map(parameter)).chain((0..2 * n).map(component))
    }
}

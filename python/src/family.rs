//! Many geometries at once: programs of quantities are recorded, and then evaluated for rows of floats.

use crate::arrays::{Floats, fresh};
use crate::geometries::Geometries;
use crate::group::Array;
use crate::run::{run, run_here};
use crate::source::PySource;
use crate::values::error;
use affinor::Geometry;
use affinor::numerics::blocks::{BlockProgram, Column};
use affinor_documents::Coefficient;
use affinor_documents::input::InputError;
use affinor_documents::report::{Programmed, Quantity, SIMPLIFIED_AT_POINTS, TensorProgram};
use affinor_documents::space::Space;
use affinor_tensors::{Effort, Recorded, Tensor, Tolerance};
use nalgebra::DMatrix;
use numpy::{PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// A family of geometries whose quantities are computed for rows of numbers: the metrics of one algebra, or the points
/// of a chart.
#[pyclass(name = "Family", frozen, module = "affinor._engine")]
pub struct PyFamily {
    recorder: Arc<Recorder>,
    parameters: Vec<String>,
    /// The position of each input in a row: metric and parameters, or coordinates and parameters, followed by two
    /// vectors.
    inputs: HashMap<String, usize>,
    /// The names of the inputs before the vectors, if these inputs are a point.
    point: Vec<String>,
}

/// The programs of the quantities of a geometry. A program is recorded when it is used for the first time.
pub struct Recorder {
    geometry: Geometry<Recorded>,
    /// The same geometry over symbolic expressions, in which terms can cancel.
    simplified: Option<Geometries>,
    dimension: usize,
    /// The programs by the names of their quantities; each quantity has at most one program.
    programs: Mutex<HashMap<String, Arc<Recording>>>,
}

/// The program of a quantity, and the shape of its arrays.
struct Recording {
    tensor: TensorProgram,
    program: BlockProgram,
    inputs: Vec<&'static str>,
    shape: Vec<usize>,
}

/// The number of operations up to which one thread is faster than several threads, which must be started first.
const SHORT: usize = 200_000;

/// The number of operations of one task.
const TASK: usize = 100_000;

/// The name of the sectional curvature, which is not a quantity of tables.
const SECTIONAL: &str = "sectional_curvature";

/// The indices of the upper triangle of a matrix: rows and columns from 0.
fn triangle(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i..n).map(move |j| (i, j)))
}

/// The numbers of an array in C order, and the distance between its rows. The distance is 0 if a single row serves all
/// elements.
fn rows<'a>(array: &'a Floats<'_>, count: usize) -> PyResult<(&'a [f64], usize)> {
    let (numbers, shape) = (array.as_slice()?, array.shape());
    let step = if shape[0] == 1 { 0 } else { shape[1] };
    if shape[0] != 1 && shape[0] != count {
        return Err(PyValueError::new_err("the batches have different lengths"));
    }
    Ok((numbers, step))
}

/// The reason why a matrix is not a metric.
enum Defect {
    NotFinite(f64),
    NotSymmetric([usize; 2]),
    Degenerate,
}

/// Checks a matrix `g` with `n` rows. Its entries must be finite, and it must be symmetric. If `regular` is set, its
/// determinant must be nonzero up to rounding errors.
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

/// Whether a symmetric matrix is regular, by elimination with pivots that do not depend on the units of the basis:
/// `g_ij/(d_i d_j)`. Here `d_i^2` is the magnitude of the diagonal entry or `m_i^2/M`, whichever is larger; `m_i` is
/// the largest magnitude in the row, and `M` in the matrix.
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

impl Recorder {
    /// Creates the recorder of a geometry; `simplified` is the same geometry over symbolic expressions.
    pub fn new(geometry: Geometry<Recorded>, simplified: Option<Geometries>) -> Self {
        let dimension = geometry.frame().dimension();
        Recorder { geometry, simplified, dimension, programs: Mutex::default() }
    }

    /// The program of a quantity; `None` if the quantity is not defined for the geometry.
    fn tensor(&self, quantity: Quantity) -> Result<Option<TensorProgram>, InputError> {
        fn of<S: Programmed + Coefficient>(
            quantity: Quantity,
            geometry: &Geometry<S>,
        ) -> Result<Option<TensorProgram>, InputError> {
            quantity.of(geometry)?.map(|tensor| TensorProgram::new(&tensor)).transpose()
        }
        let simplified = match &self.simplified {
            Some(Geometries::Exact(geometry)) => Some(of(quantity, geometry)),
            Some(Geometries::Symbolic(geometry)) => {
                Effort::new(SIMPLIFIED_AT_POINTS).bound(|| of(quantity, geometry)).ok()
            }
            _ => None,
        };
        simplified.unwrap_or_else(|| of(quantity, &self.geometry))
    }

    /// The program of a quantity. It is recorded when it is used for the first time.
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
        let tensor = run(py, || match quantity {
            Some(quantity) => self.tensor(quantity),
            None => self.sectional(),
        })?;
        let undefined = || {
            let reason = format!("{key} is not defined for these geometries");
            error(py, "MathematicsError", (reason,))
        };
        let tensor = tensor.ok_or_else(undefined)?;
        let rank = quantity.map_or(0, |quantity| quantity.slots().len());
        let recording = run(py, || Recording::new(tensor, vec![self.dimension; rank]))?;
        Ok(known().entry(key.into()).or_insert_with(|| recording.into()).clone())
    }

    /// The program of the sectional curvature of the plane that two vectors span.
    fn sectional(&self) -> Result<Option<TensorProgram>, InputError> {
        let vector = |letter: &str| -> Vec<Recorded> {
            vector(letter, self.dimension).map(|name| Recorded::input(&name)).collect()
        };
        let metric = self.geometry.metric().ok_or(affinor::Error::NoMetric)?;
        let (x, y) = (vector("x"), vector("y"));
        let value = self.geometry.connection().sectional_curvature(metric, &x, &y)?;
        let Some(value) = value else { return Ok(None) };
        let scalar = Tensor::from_components(self.dimension, &[], [([], value)])?;
        TensorProgram::new(&scalar).map(Some)
    }
}

/// The names of the components of a vector. They contain a space, which no name of a parameter contains.
fn vector(letter: &str, dimension: usize) -> impl Iterator<Item = String> {
    (1..=dimension).map(move |i| format!("{letter} {i}"))
}

impl Recording {
    fn new(tensor: TensorProgram, shape: Vec<usize>) -> Result<Self, InputError> {
        let n = shape.first().copied().unwrap_or_default();
        let place = |at: &Vec<usize>| at.iter().fold(0, |place, i| place * n + i);
        let places: Vec<usize> = tensor.indices.iter().map(place).collect();
        let inputs: Vec<&str> = tensor.inputs().collect();
        let program = BlockProgram::new(&tensor.program, &inputs, &places);
        let refused = || InputError::usage("a constant is beyond the range of floats");
        let mut program = program.ok_or_else(refused)?;
        program.fill(shape.iter().product());
        Ok(Recording { tensor, program, inputs, shape })
    }
}

impl PyFamily {
    /// Creates a family with these inputs before the vectors. If a name occurs twice, it means the first input.
    fn new(recorder: Arc<Recorder>, names: &[String], parameters: Vec<String>) -> Self {
        let n = recorder.dimension;
        let names = names.iter().cloned().chain(vector("x", n)).chain(vector("y", n));
        let mut inputs = HashMap::new();
        names.enumerate().for_each(|(at, name)| {
            inputs.entry(name).or_insert(at);
        });
        PyFamily { recorder, parameters, inputs, point: vec![] }
    }

    /// Creates the family of points, with inputs named after coordinates, parameters and functions.
    pub fn at_points(
        py: Python<'_>,
        recorder: Arc<Recorder>,
        space: &Space,
        others: &[String],
        names: &[String],
    ) -> PyResult<Self> {
        let point: Vec<String> = run(py, || {
            names.iter().map(|name| space.input(name, others)).collect::<Result<_, _>>()
        })?;
        if let Some(at) = (1..point.len()).find(|at| point[..*at].contains(&point[*at])) {
            return Err(PyValueError::new_err(format!("{} is given twice", point[at])));
        }
        Ok(PyFamily { point: point.clone(), ..Self::new(recorder, &point, vec![]) })
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
                format!("{of} is degenerate: its determinant is zero within rounding errors")
            }
        };
        error(py, "MetricError", (message,))
    }
}

#[pymethods]
impl PyFamily {
    /// Creates the family of a source. The parameters `names` are the entries of its metric, row by row.
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
        let mut parameters = definition.parameters();
        parameters.retain(|name| !entries.contains(name));
        let names = [entries, parameters.clone()].concat();
        Ok(Self::new(Recorder::new(geometry, None).into(), &names, parameters))
    }

    /// The names of the parameters of the brackets and the connection, sorted.
    #[getter]
    fn parameters(&self) -> Vec<String> {
        self.parameters.clone()
    }

    #[getter]
    fn dimension(&self) -> usize {
        self.recorder.dimension
    }

    /// The shape of the arrays of a quantity.
    fn shape(&self, py: Python<'_>, key: &str) -> PyResult<Vec<usize>> {
        Ok(self.recorder.recording(py, key)?.shape.clone())
    }

    /// Checks the matrices of metrics, or of derivatives of metrics: an array of the shape (count, n*n), one matrix per
    /// row.
    fn check(
        &self,
        py: Python<'_>,
        what: &str,
        matrices: Floats<'_>,
        regular: bool,
    ) -> PyResult<()> {
        let (n, numbers) = (self.recorder.dimension, matrices.as_slice()?);
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

    /// Computes a quantity (count, components) for `arrays` (count, k). The columns of these arrays are the inputs,
    /// with the vectors last. If `rates` (count, k) of the first array are given, computes the derivative of the
    /// quantity instead. An array with one row serves all rows. `batch` is the shape of the batch of `count` rows.
    #[pyo3(signature = (key, batch, arrays, rates=None))]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        key: &str,
        batch: Vec<usize>,
        arrays: Vec<Floats<'py>>,
        rates: Option<Floats<'py>>,
    ) -> PyResult<Array<'py>> {
        let recording = self.recorder.recording(py, key)?;
        let count = batch.iter().product();
        let width: usize = recording.shape.iter().product();
        let out = fresh(py, &[count], &recording.shape)?;
        let mut columns = Vec::new();
        for array in &arrays {
            let (numbers, step) = rows(array, count)?;
            columns.extend((0..array.shape()[1]).map(|offset| Column { numbers, offset, step }));
        }
        let missing = |name: &str| {
            let reason = format!("the quantity {key} depends on {name}, which has no value");
            PyValueError::new_err(reason)
        };
        let place = |name: &&str| self.inputs.get(*name).copied().ok_or_else(|| missing(name));
        let places: Vec<usize> = recording.inputs.iter().map(place).collect::<PyResult<_>>()?;
        let inputs: Vec<Column<'_>> = places.iter().map(|place| columns[*place]).collect();
        let zero = [0.0];
        let none = Column { numbers: &zero, offset: 0, step: 0 };
        let moving: Option<Vec<Column<'_>>> = match &rates {
            None => None,
            Some(rates) => {
                let ((numbers, step), width) = (rows(rates, count)?, rates.shape()[1]);
                let rate = |place: &usize| match *place < width {
                    true => Column { numbers, offset: *place, step },
                    false => none,
                };
                Some(places.iter().map(rate).collect())
            }
        };
        let program = &recording.program;
        let task = |start: usize, out: &mut [f64]| {
            match &moving {
                None => program.evaluate(&inputs, start, out, width),
                Some(rates) => program.derivative(&inputs, rates, start, out, width),
            }
            // tests all numbers at once: a number times 0 is 0, unless the number is infinite or NaN
            let sum = out.iter().fold(0.0, |sum, x| sum + x * 0.0);
            if sum == 0.0 {
                return Ok(());
            }
            let bad = |row: &[f64]| !row.iter().all(|x| x.is_finite());
            let at = start + out.chunks_exact(width).position(bad).unwrap_or(0);
            let row: Vec<f64> = inputs.iter().map(|column| column.number(at)).collect();
            Err(self.undefined(key, &recording, &row, at, &batch))
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

    /// The eigenvalues (count, n) of symmetric forms with respect to metrics, in ascending order. The result is None if
    /// a metric is not positive definite.
    fn eigenvalues<'py>(
        &self,
        py: Python<'py>,
        metrics: Floats<'py>,
        forms: Floats<'py>,
    ) -> PyResult<Option<Array<'py>>> {
        let (n, count) = (self.recorder.dimension, forms.shape()[0]);
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
    /// The error for a row whose result is not finite.
    fn undefined(
        &self,
        key: &str,
        recording: &Recording,
        row: &[f64],
        at: usize,
        batch: &[usize],
    ) -> InputError {
        if self.point.is_empty() {
            let reason = match key {
                SECTIONAL => "the plane is degenerate",
                _ => "the result is not finite",
            };
            let reason = format!("{reason} in row {at} of the batch");
            return affinor::Error::Invalid { what: "geometry", reason }.into();
        }
        let names = recording.inputs.iter().zip(row);
        let value = |name: &str| {
            names.clone().find(|(own, _)| **own == name).map_or(f64::NAN, |(_, value)| *value)
        };
        let reason = recording.tensor.program.failure(value);
        let reason = reason.unwrap_or_else(|| "the result is not finite".into());
        let given = self.point.iter().filter(|name| recording.inputs.contains(&name.as_str()));
        let listed: Vec<String> = given.map(|name| format!("{name} = {}", value(name))).collect();
        let place = match batch {
            [] => String::new(),
            _ => format!("[{}], ", indices(at, batch).join(", ")),
        };
        let place = format!("the point {place}{}", listed.join(", "));
        InputError::mathematics(format!("the quantity {key} is not defined at {place}: {reason}"))
    }
}

/// The index of a row in a batch, as one number for each axis.
fn indices(mut at: usize, batch: &[usize]) -> Vec<String> {
    let mut indices: Vec<String> = batch
        .iter()
        .rev()
        .map(|length| {
            let index = at % length;
            at /= length;
            index.to_string()
        })
        .collect();
    indices.reverse();
    indices
}

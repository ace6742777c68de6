//! NumPy arrays as lists of rows, with broadcasting.

use crate::errors::wrong;
use crate::values::python;
use numpy::ndarray::{ArrayView2, ArrayViewD};
use numpy::{
    Element, PyArray1, PyArray2, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArray,
    PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use std::borrow::Cow;
use std::ops::Deref;

/// An argument of floats: any array, list or number that NumPy casts to float64. Complex numbers, dates and records are
/// errors.
pub struct Floats<'py>(PyReadonlyArrayDyn<'py, f64>);

impl<'py> Deref for Floats<'py> {
    type Target = PyReadonlyArrayDyn<'py, f64>;
    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<'py> FromPyObject<'_, 'py> for Floats<'py> {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        static CONVERT: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        let own = value.is_exact_instance_of::<PyUntypedArray>();
        if own
            && let Ok(array) = value.cast::<PyArrayDyn<f64>>().map(|array| array.to_owned())
            && is_regular(&array)
        {
            return Ok(Floats(array.try_readonly()?));
        }
        let py = value.py();
        let array = CONVERT.import(py, "affinor._scalars", "floats")?.call1((value,))?;
        Ok(Floats(array.cast_into::<PyArrayDyn<f64>>()?.try_readonly()?))
    }
}

/// An argument of rows: a copy of a few numbers, or any array of floats.
pub enum Input<'py> {
    /// The numbers of an array with one or two axes in C order, its shape, and the number of its axes.
    Small(Vec<f64>, [usize; 2], usize),
    Array(Floats<'py>),
}

/// The largest number of elements of an array that is copied.
const SMALL: usize = 16;

impl<'py> FromPyObject<'_, 'py> for Input<'py> {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        // copies a few numbers, because NumPy tracks borrowed arrays, which takes longer
        if value.is_exact_instance_of::<PyUntypedArray>()
            && let Ok(array) = value.cast::<PyArrayDyn<f64>>()
            && (1..=2).contains(&array.ndim())
            && array.len() <= SMALL
            && array.is_c_contiguous()
            && array.data().addr().is_multiple_of(size_of::<f64>())
            && let Ok(numbers) = array.to_vec()
        {
            let axes = array.ndim();
            let mut shape = [0; 2];
            shape[..axes].copy_from_slice(array.shape());
            return Ok(Input::Small(numbers, shape, axes));
        }
        Ok(Input::Array(value.extract()?))
    }
}

impl Input<'_> {
    /// The shape of the argument.
    pub fn shape(&self) -> &[usize] {
        match self {
            Input::Small(_, shape, axes) => &shape[..*axes],
            Input::Array(array) => array.shape(),
        }
    }

    /// The rows of the argument, broadcast from the batch shape `own` to the batch shape `batch`.
    pub fn rows(&self, own: &[usize], batch: &[usize]) -> Rows<'_> {
        let shape = self.shape();
        match self {
            Input::Small(numbers, ..) => Rows::of(shape, Some(numbers), own, batch, || {
                ArrayViewD::from_shape(shape, numbers).ok()
            }),
            // the slice of an array may also be in Fortran order, so the order is checked
            Input::Array(array) => {
                let slice = array.as_slice().ok().filter(|_| array.is_c_contiguous());
                Rows::of(shape, slice, own, batch, || Some(array.as_array()))
            }
        }
    }
}

/// Converts an argument to an array of finite real numbers whose number of axes is allowed.
pub fn with_axes<'py>(
    what: &str,
    value: &Bound<'py, PyAny>,
    counts: &[usize],
) -> PyResult<Floats<'py>> {
    python(value.py(), "_scalars", "with_axes")?.call1((what, value, counts.to_vec()))?.extract()
}

/// Whether all strides are multiples of the size of a number. The strides of a field of packed records are not.
fn is_regular(array: &Bound<'_, PyArrayDyn<f64>>) -> bool {
    let size = size_of::<f64>();
    array.data().addr().is_multiple_of(size)
        && array.strides().iter().all(|step| step.unsigned_abs().is_multiple_of(size))
}

/// The batch shape of an argument: its axes except those of a single row.
pub fn batch<'a>(name: &str, shape: &'a [usize], row: &[usize]) -> PyResult<&'a [usize]> {
    match shape.len().checked_sub(row.len()) {
        Some(axes) if shape[axes..] == *row => Ok(&shape[..axes]),
        _ => {
            let row: Vec<String> = row.iter().map(usize::to_string).collect();
            let expected = format!("an array of the shape (..., {})", row.join(", "));
            Err(wrong(name, &expected, &format!("of the shape {}", written(shape))))
        }
    }
}

/// A shape in Python notation.
pub fn written(shape: &[usize]) -> String {
    let list: Vec<String> = shape.iter().map(usize::to_string).collect();
    if list.len() == 1 { format!("({},)", list[0]) } else { format!("({})", list.join(", ")) }
}

/// The shape to which two batches are broadcast.
pub fn common(a: &[usize], b: &[usize]) -> PyResult<Vec<usize>> {
    let rank = a.len().max(b.len());
    let axis =
        |shape: &[usize], at: usize| (at + shape.len()).checked_sub(rank).map_or(1, |at| shape[at]);
    let joined = (0..rank).map(|at| match (axis(a, at), axis(b, at)) {
        (m, n) if m == n || n == 1 => Ok(m),
        (1, n) => Ok(n),
        _ => {
            let shapes = format!("{} and {}", written(a), written(b));
            Err(pyo3::exceptions::PyValueError::new_err(format!(
                "the batches {shapes} cannot be broadcast together"
            )))
        }
    });
    joined.collect()
}

/// The rows of an argument. A single row serves the whole batch.
pub struct Rows<'a> {
    data: Cow<'a, [f64]>,
    width: usize,
    step: usize,
}

impl<'a> Rows<'a> {
    /// The rows of an array, broadcast from the batch shape `own` to `batch`. `slice` contains the numbers of the array
    /// if it is in C order.
    fn of(
        shape: &[usize],
        slice: Option<&'a [f64]>,
        own: &[usize],
        batch: &[usize],
        view: impl Fn() -> Option<ArrayViewD<'a, f64>>,
    ) -> Self {
        let width = shape[own.len()..].iter().product();
        let single = own.iter().product::<usize>() == 1;
        if own == batch || single {
            let copy = || view().map(|view| view.iter().copied().collect()).unwrap_or_default();
            let data = slice.map_or_else(|| Cow::Owned(copy()), Cow::Borrowed);
            return Rows { data, width, step: if single { 0 } else { width } };
        }
        let whole: Vec<usize> = batch.iter().chain(&shape[own.len()..]).copied().collect();
        // broadcasting succeeds, because `common` has already combined the shapes
        let data = view().and_then(|view| Some(view.broadcast(whole)?.iter().copied().collect()));
        Rows { data: Cow::Owned(data.unwrap_or_default()), width, step: width }
    }

    /// The number of numbers in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// The single row that serves the whole batch; `None` if there are several rows.
    pub fn single(&self) -> Option<&[f64]> {
        (self.step == 0).then_some(&self.data)
    }

    /// The numbers of all rows.
    pub fn list(&self) -> &[f64] {
        &self.data
    }

    /// All numbers, if every element of the batch has its own row.
    pub fn all(&self) -> Option<&[f64]> {
        (self.step == self.width || self.data.len() == self.width).then_some(&self.data)
    }

    /// The row of the element with index `at`.
    #[inline]
    pub fn row(&self, at: usize) -> &[f64] {
        let start = at * self.step;
        &self.data[start..start + self.width]
    }
}

/// Creates an array of a few numbers.
pub fn array<'py>(
    py: Python<'py>,
    batch: &[usize],
    row: &[usize],
    numbers: &[f64],
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let refused = |error: numpy::ndarray::ShapeError| {
        pyo3::exceptions::PyValueError::new_err(error.to_string())
    };
    // uses arrays with a fixed number of axes, because they are created faster
    Ok(match (batch, row) {
        ([], [_]) => PyArray1::from_slice(py, numbers).to_dyn().clone(),
        ([], [rows, columns]) => {
            let view = ArrayView2::from_shape((*rows, *columns), numbers).map_err(refused)?;
            PyArray2::from_array(py, &view).to_dyn().clone()
        }
        _ => {
            let view = ArrayViewD::from_shape([batch, row].concat(), numbers).map_err(refused)?;
            PyArrayDyn::from_array(py, &view)
        }
    })
}

/// Creates an array of zeros.
pub fn zeros<'py>(py: Python<'py>, batch: &[usize], row: &[usize]) -> Bound<'py, PyArrayDyn<f64>> {
    PyArrayDyn::zeros(py, [batch, row].concat(), false)
}

/// The size in bytes from which NumPy allocates the memory of an array.
const LARGE: usize = 1 << 14;

/// The number of axes that every version of NumPy supports.
pub const AXES: usize = 32;

/// Creates an array without setting its values. NumPy allocates large arrays, because it requests large pages from the
/// system and does not fill them.
pub fn fresh<'py, T: Element + Default>(
    py: Python<'py>,
    batch: &[usize],
    row: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    static EMPTY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let shape = [batch, row].concat();
    let size = shape.iter().fold(size_of::<T>(), |size, n| size.saturating_mul(*n));
    // leaves all other shapes to NumPy, which raises an exception if there are too many axes or the size is too large
    if size < LARGE && shape.len() <= AXES {
        return Ok(PyArrayDyn::zeros(py, shape, false));
    }
    let empty = EMPTY.import(py, "numpy", "empty")?;
    Ok(empty.call1((shape, T::get_dtype(py)))?.cast_into()?)
}

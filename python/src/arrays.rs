//! Arrays of NumPy as lists of rows, with broadcasting.

use crate::errors::wrong;
use crate::values::python;
use numpy::{
    Element, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use std::borrow::Cow;
use std::ops::Deref;

/// An argument of floats: any array, list or number that NumPy casts to float64.
/// Complex numbers, dates and records are refused.
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

/// Finite real numbers as an array with one of these numbers of axes.
pub fn with_axes<'py>(
    what: &str,
    value: &Bound<'py, PyAny>,
    counts: &[usize],
) -> PyResult<Floats<'py>> {
    python(value.py(), "_scalars", "with_axes")?.call1((what, value, counts.to_vec()))?.extract()
}

/// Whether the steps between numbers are whole numbers, unlike those in a field of packed records.
fn is_regular(array: &Bound<'_, PyArrayDyn<f64>>) -> bool {
    let size = size_of::<f64>();
    array.data().addr().is_multiple_of(size)
        && array.strides().iter().all(|step| step.unsigned_abs().is_multiple_of(size))
}

/// The shape of one row of an argument, in front of which stand the axes of the batch.
pub fn batch<'a>(name: &str, array: &'a Floats<'_>, row: &[usize]) -> PyResult<&'a [usize]> {
    let shape = array.shape();
    match shape.len().checked_sub(row.len()) {
        Some(axes) if shape[axes..] == *row => Ok(&shape[..axes]),
        _ => {
            let row: Vec<String> = row.iter().map(usize::to_string).collect();
            let expected = format!("an array of the shape (..., {})", row.join(", "));
            Err(wrong(name, &expected, &format!("of the shape {}", written(shape))))
        }
    }
}

/// A shape as Python writes it.
fn written(shape: &[usize]) -> String {
    let list: Vec<String> = shape.iter().map(usize::to_string).collect();
    if list.len() == 1 { format!("({},)", list[0]) } else { format!("({})", list.join(", ")) }
}

/// The shape to which both batches are broadcast.
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

/// The rows of an argument. A single row stands for all of the batch.
pub struct Rows<'a> {
    data: Cow<'a, [f64]>,
    width: usize,
    step: usize,
}

impl<'a> Rows<'a> {
    /// The rows of an array of the batch shape `own`, broadcast to `batch`.
    pub fn new(array: &'a Floats<'_>, own: &[usize], batch: &[usize]) -> Self {
        let width = array.shape()[own.len()..].iter().product();
        let single = own.iter().product::<usize>() == 1;
        if own == batch || single {
            // a slice alone may also stand in the order of Fortran
            let slice = array.as_slice().ok().filter(|_| array.is_c_contiguous());
            let copy = || Cow::Owned(array.as_array().iter().copied().collect());
            let data = slice.map_or_else(copy, Cow::Borrowed);
            return Rows { data, width, step: if single { 0 } else { width } };
        }
        let whole: Vec<usize> = batch.iter().chain(&array.shape()[own.len()..]).copied().collect();
        let view = array.as_array();
        // the shapes are compatible: `common` has joined them
        let data = view.broadcast(whole).map(|all| all.iter().copied().collect());
        Rows { data: Cow::Owned(data.unwrap_or_default()), width, step: width }
    }

    /// All numbers, if there is one row for every element.
    pub fn all(&self) -> Option<&[f64]> {
        (self.step == self.width || self.data.len() == self.width).then_some(&self.data)
    }

    /// The row of an index.
    #[inline]
    pub fn row(&self, at: usize) -> &[f64] {
        let start = at * self.step;
        &self.data[start..start + self.width]
    }
}

/// A new array of zeros.
pub fn zeros<'py>(py: Python<'py>, batch: &[usize], row: &[usize]) -> Bound<'py, PyArrayDyn<f64>> {
    PyArrayDyn::zeros(py, [batch, row].concat(), false)
}

/// The size in bytes from which an array is made by NumPy.
const LARGE: usize = 1 << 20;

/// The number of axes that every NumPy takes.
const AXES: usize = 32;

/// A new array, to be overwritten. NumPy makes the large ones: it asks the system for large pages, and fills nothing.
pub fn fresh<'py, T: Element + Default>(
    py: Python<'py>,
    batch: &[usize],
    row: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    static EMPTY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let shape = [batch, row].concat();
    let size = shape.iter().fold(size_of::<T>(), |size, n| size.saturating_mul(*n));
    // NumPy refuses too many axes and too large a size with an exception
    if size < LARGE && shape.len() <= AXES {
        return Ok(PyArrayDyn::zeros(py, shape, false));
    }
    let empty = EMPTY.import(py, "numpy", "empty")?;
    Ok(empty.call1((shape, T::get_dtype(py)))?.cast_into()?)
}

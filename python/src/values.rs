//! Conversion of numbers between Rust and Python: fractions, floats, and expressions as text.

use affinor_documents::Coefficient;
use affinor_tensors::expression::{Evaluator, Expression, is_abbreviation};
use affinor_tensors::{Notation, Rational, Symbolic};
use num_rational::{BigRational, Ratio};
use pyo3::call::PyCallArgs;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple};
use std::cell::RefCell;

/// A function or a class of a module of the Python package.
pub fn python<'py>(py: Python<'py>, module: &str, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import(format!("affinor.{module}"))?.getattr(name)
}

/// An exception of this class of `affinor.errors`.
pub fn error<'py>(py: Python<'py>, class: &str, arguments: impl PyCallArgs<'py>) -> PyErr {
    let error = python(py, "errors", class).and_then(|class| class.call1(arguments));
    error.map_or_else(|failed| failed, PyErr::from_value)
}

/// Converts an integer of any type that has `__index__`, except bool.
pub fn index(what: &str, value: &Bound<'_, PyAny>) -> PyResult<isize> {
    python(value.py(), "_scalars", "index")?.call1((what, value))?.extract()
}

/// Writes a value in the notation of definition files. The SymPy symbols in the value are added to `symbols`.
pub fn text_of(
    value: &Bound<'_, PyAny>,
    symbols: &Bound<'_, PyDict>,
    floats: bool,
) -> PyResult<String> {
    python(value.py(), "_scalars", "text_of")?.call1((value, symbols, floats))?.extract()
}

/// Converts a text of the engine to a Python number: a `Fraction`, a float, or a SymPy expression. Without SymPy, an
/// expression remains a text.
pub fn number<'py>(
    text: &str,
    symbols: &Bound<'py, PyDict>,
    floats: bool,
) -> PyResult<Bound<'py, PyAny>> {
    python(symbols.py(), "_scalars", "number")?.call1((text, symbols, floats))
}

/// Merges the symbols of several objects. Two different symbols with the same name are an error.
pub fn merged<'py, 'a>(
    py: Python<'py>,
    all: impl IntoIterator<Item = &'a Py<PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let joined = PyDict::new(py);
    for (name, symbol) in all.into_iter().flat_map(|symbols| symbols.bind(py).iter()) {
        match joined.get_item(&name)? {
            None => joined.set_item(name, symbol)?,
            Some(known) if known.ne(&symbol)? => {
                let message = format!(
                    "two different symbols are called {}: their assumptions differ",
                    name.repr()?
                );
                return Err(PyValueError::new_err(message));
            }
            Some(_) => {}
        }
    }
    Ok(joined)
}

/// Whether this is the name of an elementary function, or an abbreviation of elementary functions.
#[pyfunction]
pub fn knows(name: &str) -> bool {
    is_abbreviation(name) || Symbolic::function(name, &Symbolic::parameter("x")).is_ok()
}

/// The class `fractions.Fraction`.
fn fraction_class(py: Python<'_>) -> PyResult<&Bound<'_, PyAny>> {
    static CLASS: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    CLASS.import(py, "fractions", "Fraction")
}

/// A rational number as a `Fraction`.
pub fn fraction<'py>(py: Python<'py>, value: &Rational) -> PyResult<Bound<'py, PyAny>> {
    let class = fraction_class(py)?;
    match Ratio::<i64>::try_from(value) {
        Ok(small) => class.call1((*small.numer(), *small.denom())),
        Err(_) => {
            let big = BigRational::from(value);
            class.call1((big.numer().clone(), big.denom().clone()))
        }
    }
}

/// Parses a number or an expression in the notation of definitions.
pub fn read<S: Coefficient>(text: &str) -> PyResult<S> {
    let names = |name: &str| S::parameter(name).ok_or_else(|| format!("`{name}` is not a number"));
    let scalars = affinor_tensors::expression::Scalars(names, S::call);
    let value = Expression::parse(text).and_then(|expression| expression.evaluate(&scalars));
    value.map_err(|error| PyValueError::new_err(format!("in `{text}`: {error}")))
}

/// Evaluates a text with Python objects, by calls of `number(p, q)`, `name(text)` and `function(name, *values)`, and by
/// Python operators.
#[pyfunction]
pub fn evaluate<'py>(
    text: &str,
    number: Bound<'py, PyAny>,
    name: Bound<'py, PyAny>,
    function: Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let objects = Objects { number, name, function, failed: RefCell::new(None) };
    let value = Expression::parse(text).and_then(|expression| expression.evaluate(&objects));
    value.map_err(|error| {
        let failed = objects.failed.borrow_mut().take();
        failed.unwrap_or_else(|| PyValueError::new_err(format!("in `{text}`: {error}")))
    })
}

/// An evaluator of expressions whose values are Python objects.
struct Objects<'py> {
    number: Bound<'py, PyAny>,
    name: Bound<'py, PyAny>,
    function: Bound<'py, PyAny>,
    failed: RefCell<Option<PyErr>>,
}

impl<'py> Objects<'py> {
    /// Stores an exception, because the error of an expression cannot contain it.
    fn keep(&self, result: PyResult<Bound<'py, PyAny>>) -> Result<Bound<'py, PyAny>, String> {
        result.map_err(|error| {
            *self.failed.borrow_mut() = Some(error);
            String::new()
        })
    }
}

impl<'py> Evaluator for Objects<'py> {
    type Value = Bound<'py, PyAny>;
    fn number(&self, number: &Rational) -> Result<Self::Value, String> {
        let big = BigRational::from(number);
        self.keep(self.number.call1((big.numer().clone(), big.denom().clone())))
    }
    fn name(&self, name: &str) -> Result<Self::Value, String> {
        self.keep(self.name.call1((name,)))
    }
    fn add(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, String> {
        self.keep(a.add(b))
    }
    fn multiply(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, String> {
        self.keep(a.mul(b))
    }
    fn negate(&self, a: Self::Value) -> Self::Value {
        a.neg().unwrap_or(a)
    }
    fn reciprocal(&self, a: Self::Value) -> Result<Self::Value, String> {
        self.keep(a.pow(-1, a.py().None()))
    }
    fn raise(&self, base: Self::Value, exponent: Self::Value) -> Result<Self::Value, String> {
        self.keep(base.pow(exponent, base.py().None()))
    }
    fn call(&self, name: &str, arguments: Vec<Self::Value>) -> Result<Self::Value, String> {
        let call = || {
            let py = self.function.py();
            let name = name.into_pyobject(py)?.into_any();
            let all: Vec<_> = std::iter::once(name).chain(arguments).collect();
            let all = PyTuple::new(py, all)?;
            self.function.call1(all)
        };
        self.keep(call())
    }
}

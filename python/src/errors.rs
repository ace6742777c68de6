//! Errors as exceptions of `affinor.errors`, with their witness as data.

use affinor::Error;
use affinor_documents::input::{InputError, Refusal};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// The exception of an error.
pub fn raise(py: Python<'_>, error: &InputError) -> PyErr {
    exception(py, error).unwrap_or_else(|failed| failed)
}

/// The exception of any error that has a message for the input.
pub fn refused(py: Python<'_>, error: impl Into<InputError>) -> PyErr {
    raise(py, &error.into())
}

/// The exception of a panic.
pub fn internal(py: Python<'_>, text: &str) -> PyErr {
    let made = py.import("affinor.errors").and_then(|errors| errors.getattr("InternalError"));
    made.and_then(|class| class.call1((text,))).map_or_else(|failed| failed, PyErr::from_value)
}

/// A wrong value or a wrong shape: what was expected, and what was found.
pub fn wrong(what: &str, expected: &str, found: &str) -> PyErr {
    pyo3::exceptions::PyValueError::new_err(format!("{what} should be {expected}, not {found}"))
}

fn exception(py: Python<'_>, error: &InputError) -> PyResult<PyErr> {
    let data = PyDict::new(py);
    let kind = match error.cause.as_deref() {
        Some(cause) => witness(cause, &data)?,
        None if error.refusal == Refusal::Mathematics => "MathematicsError",
        None => "InputError",
    };
    let place = match &error.at {
        None => None,
        Some(place) => {
            let found = PyDict::new(py);
            found.set_item("source", &place.source.name)?;
            if let Some(span) =
                place.span.clone().filter(|span| place.source.text.get(span.clone()).is_some())
            {
                let before = &place.source.text[..span.start];
                let start = before.rfind('\n').map_or(0, |at| at + 1);
                found.set_item("line", before.matches('\n').count() + 1)?;
                found.set_item("column", before[start..].chars().count() + 1)?;
                found.set_item("text", &place.source.text[span])?;
            }
            Some(found)
        }
    };
    let arguments = (kind, &error.message, &error.help, place, data);
    let made = py.import("affinor.errors")?.getattr("_of_engine")?.call1(arguments)?;
    Ok(PyErr::from_value(made))
}

/// The name of the exception class of a refusal, and its witness.
fn witness(error: &Error, data: &Bound<'_, PyDict>) -> PyResult<&'static str> {
    let py = data.py();
    let pair = |x: &String, y: &String| PyTuple::new(py, [x.clone(), y.clone()]);
    Ok(match error {
        Error::Jacobi { x, y, z, residual } => {
            data.set_item("triple", PyTuple::new(py, [x, y, z])?)?;
            data.set_item("residual", residual)?;
            "JacobiError"
        }
        Error::NotAntisymmetric { x, y, residual }
        | Error::OrdersDisagree { x, y, residual, .. } => {
            data.set_item("pair", pair(x, y)?)?;
            data.set_item("residual", residual)?;
            "AntisymmetryError"
        }
        Error::NotClosed { x, y, residual } => {
            data.set_item("pair", pair(x, y)?)?;
            data.set_item("residual", residual)?;
            "ClosureError"
        }
        Error::NotSubalgebra { x, y: other, bracket }
        | Error::NotIdeal { x, v: other, bracket } => {
            data.set_item("pair", pair(x, other)?)?;
            data.set_item("residual", bracket)?;
            "ConstructionError"
        }
        Error::NotCommutative { x, y, residual } => {
            data.set_item("pair", pair(x, y)?)?;
            data.set_item("residual", residual)?;
            "ConstructionError"
        }
        Error::NotCocycle { x, y, z, residual } | Error::NotAssociative { x, y, z, residual } => {
            data.set_item("triple", PyTuple::new(py, [x, y, z])?)?;
            data.set_item("residual", residual)?;
            "ConstructionError"
        }
        Error::NotDerivation { d, x, y, residual } => {
            data.set_item("derivation", d)?;
            data.set_item("pair", pair(x, y)?)?;
            data.set_item("residual", residual)?;
            "ConstructionError"
        }
        Error::NotAction { x, y, v, residual } => {
            data.set_item("pair", pair(x, y)?)?;
            data.set_item("vector", v)?;
            data.set_item("residual", residual)?;
            "ConstructionError"
        }
        Error::NoLimit { x, y, component, value } => {
            data.set_item("pair", pair(x, y)?)?;
            data.set_item("component", component)?;
            data.set_item("residual", value)?;
            "ConstructionError"
        }
        Error::Dependent { relation } | Error::DegenerateFrame { relation } => {
            data.set_item("relation", relation)?;
            "DependentError"
        }
        Error::NotSymmetric { x, y, residual } => {
            data.set_item("pair", pair(x, y)?)?;
            data.set_item("residual", residual)?;
            "MetricError"
        }
        Error::Degenerate { null, components } => {
            data.set_item("null", null)?;
            data.set_item("components", components.clone())?;
            "MetricError"
        }
        Error::NoMetric => "MetricError",
        Error::Symmetry { at, residual, .. } => {
            data.set_item("at", at.clone())?;
            data.set_item("residual", residual)?;
            "SymmetryError"
        }
        Error::Integration { t, .. } => {
            data.set_item("time", t)?;
            "IntegrationError"
        }
        Error::NotAutoparallel { residual, .. } | Error::NotInvariant { residual, .. } => {
            data.set_item("residual", residual)?;
            "MathematicsError"
        }
        Error::Catalogue(_) | Error::NoGroup { .. } => "InputError",
        Error::Shape { .. } | Error::Tensor(_) => "ShapeError",
        _ => "MathematicsError",
    })
}

//! Representations of reductive algebras as JSON documents, and coupling coefficients of spins.

use crate::report::{Written, all_formats, written};
use crate::run::run;
use crate::values::fraction;
use affinor::representation::{ReductiveAlgebra, Spin};
use affinor_documents::input::InputError;
use affinor_documents::report::{
    CouplingCoefficient, CouplingKind, CouplingReport, Format, MatrixReport, Operations, Power,
    RepresentationReport,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyList;

fn algebra(name: &str) -> Result<ReductiveAlgebra, InputError> {
    name.parse().map_err(|error| InputError::usage(format!("{error}")))
}

/// The report of a representation and of operations on it. A power is a degree and whether it is symmetric.
#[pyfunction]
pub fn _representation(
    py: Python<'_>,
    name: &str,
    weight: &str,
    tensor: Vec<String>,
    power: Option<(usize, bool)>,
    branch: Option<String>,
    weights: bool,
) -> PyResult<Written> {
    run(py, || {
        let kind = |symmetric| if symmetric { Power::Symmetric } else { Power::Exterior };
        let operations = Operations {
            power: power.map(|(degree, symmetric)| (kind(symmetric), degree)),
            tensor,
            branch,
            weights,
            brackets: None,
        };
        all_formats(&RepresentationReport::new(&algebra(name)?, weight, &operations)?)
    })
}

/// The matrices of a representation as JSON.
#[pyfunction]
pub fn _representation_matrices(
    py: Python<'_>,
    name: &str,
    weight: &str,
    all: bool,
) -> PyResult<String> {
    run(py, || written(&MatrixReport::new(&algebra(name)?, weight, all)?, Format::Json))
}

/// Coupling coefficients of two spins with a third one, or a 6j symbol. Returns positions in an array with the indices
/// `m1 + j1`, `m2 + j2`, `m + j`, in row-major order, and values. The values are floats, or signed squares.
#[pyfunction]
pub fn _coupling<'py>(
    py: Python<'py>,
    spins: Vec<String>,
    kind: &str,
    squares: bool,
) -> PyResult<(Vec<i64>, Bound<'py, PyList>)> {
    let Some(kind) = CouplingKind::from_name(kind) else {
        return Err(PyValueError::new_err(format!("unknown kind of coefficients {kind:?}")));
    };
    let report = run(py, || CouplingReport::new(&spins, kind))?;
    let position = |numbers: &[Spin]| {
        let pairs = report.spins().iter().zip(numbers.iter().skip(1));
        pairs.fold(0, |at, (j, m)| at * (j.twice() + 1) + (m.twice() + j.twice()) / 2)
    };
    let positions = report.coefficients().iter().map(|one| position(&one.numbers)).collect();
    let values = PyList::empty(py);
    for CouplingCoefficient { value, .. } in report.coefficients() {
        match squares {
            true => values.append(fraction(py, value.signed_square())?)?,
            false => values.append(value.to_f64())?,
        }
    }
    Ok((positions, values))
}

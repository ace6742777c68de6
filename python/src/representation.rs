//! Representations of reductive algebras, and coupling coefficients of spins, as JSON documents.

use crate::report::{Written, all_formats, written};
use crate::run::run;
use affinor::representation::ReductiveAlgebra;
use affinor_documents::input::InputError;
use affinor_documents::report::{
    CouplingKind, CouplingReport, Format, MatrixReport, Operations, Power, RepresentationReport,
};
use pyo3::prelude::*;

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

/// Coupling coefficients as JSON.
#[pyfunction]
pub fn _coupling(py: Python<'_>, spins: Vec<String>, kind: &str) -> PyResult<String> {
    let kind = match kind {
        "3j" => CouplingKind::ThreeJ,
        "6j" => CouplingKind::SixJ,
        "real" => CouplingKind::Real,
        _ => CouplingKind::ClebschGordan,
    };
    run(py, || written(&CouplingReport::new(&spins, kind)?, Format::Json))
}

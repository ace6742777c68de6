//! KAK factorizations of matrices.

use crate::run::run;
use affinor::group::kak::two_qubit::TwoQubitKak;
use affinor::group::kak::{Kak, SymmetricPair};
use nalgebra::{Complex, DMatrix};
use numpy::ndarray::Array2;
use numpy::{PyArray2, PyReadonlyArray2, ToPyArray};
use pyo3::prelude::*;

type Array<'py> = Bound<'py, PyArray2<Complex<f64>>>;

fn matrix(g: &PyReadonlyArray2<'_, Complex<f64>>) -> DMatrix<Complex<f64>> {
    let view = g.as_array();
    DMatrix::from_fn(view.nrows(), view.ncols(), |i, j| view[[i, j]])
}

fn array<'py>(py: Python<'py>, m: &DMatrix<Complex<f64>>) -> Array<'py> {
    Array2::from_shape_fn(m.shape(), |(i, j)| m[(i, j)]).to_pyarray(py)
}

/// The name of the pair, `k1`, `a`, `k2`, the coordinates of `a`, and the residual.
#[pyfunction]
pub fn _kak<'py>(
    py: Python<'py>,
    g: PyReadonlyArray2<'py, Complex<f64>>,
    pair: &str,
) -> PyResult<(String, [Array<'py>; 3], Vec<f64>, f64)> {
    let g = matrix(&g);
    let kak = run(py, || Ok(Kak::new(&pair.parse::<SymmetricPair>()?, &g)?))?;
    let factors = [kak.k1(), kak.a(), kak.k2()].map(|m| array(py, m));
    Ok((kak.pair().to_string(), factors, kak.coordinates().to_vec(), kak.residual()))
}

/// The gates `A1`, `B1`, `A2`, `B2`, the Weyl coordinates, the phase and the residual.
#[pyfunction]
pub fn _two_qubit_kak<'py>(
    py: Python<'py>,
    gate: PyReadonlyArray2<'py, Complex<f64>>,
) -> PyResult<(Vec<Array<'py>>, Vec<f64>, f64, f64)> {
    let gate = matrix(&gate);
    let kak = run(py, || Ok(TwoQubitKak::new(&gate)?))?;
    let gates = kak.left().iter().chain(kak.right());
    let gates = gates.map(|m| array(py, &DMatrix::from_column_slice(2, 2, m.as_slice())));
    Ok((gates.collect(), kak.coordinates().to_vec(), kak.phase(), kak.residual()))
}

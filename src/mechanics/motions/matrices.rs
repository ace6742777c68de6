//! Motions of isospectral flows of matrices.

use super::Motion;
use super::drive::Drive;
use super::run::{Recorded, Run};
use super::snapshot::Saved;
use crate::Error;
use crate::mechanics::{
    Composed, Isospectral, IsospectralMidpoint, Manakov, MatrixState, Toda, Zeitlin,
};
use nalgebra::DMatrix;
use std::ops::Range;

/// Matrices up to this size have their entries in the rows.
const SMALL: usize = 6;

/// An isospectral flow with its initial condition.
#[derive(Clone, Debug)]
pub enum MatrixFlow {
    /// The Toda lattice: positions and momenta.
    Toda(Vec<f64>, Vec<f64>),
    /// The body in n dimensions: masses and momentum.
    Manakov(Vec<f64>, DMatrix<f64>),
    /// The fluid on the sphere: the `N` of su(N), and the coefficients `(l, m, w_lm)` of spherical harmonics.
    Zeitlin(usize, Vec<(usize, i64, f64)>),
    /// The fluid on the sphere with random coefficients: `N`, a seed, and the largest degree.
    RandomZeitlin(usize, u64, usize),
}

/// A motion with its columns: the name of each, and whether it is conserved.
pub type Started = (Box<dyn Motion>, Vec<(String, bool)>);

/// The motion of a flow by the isospectral midpoint rule of order 2, or composed to order 4 if `fourth`.
///
/// # Errors
/// Those of the constructors of the flow and its state, for an initial condition that is not admissible.
pub fn on_matrices(
    flow: &MatrixFlow,
    time: f64,
    step: f64,
    fourth: bool,
) -> Result<Started, Error> {
    match flow {
        MatrixFlow::Toda(positions, momenta) => {
            let state = Toda.state(time, Toda::lattice(positions, momenta)?)?;
            let row = |toda: &Toda, l: &DMatrix<f64>| {
                let mut row = vec![toda.energy(l)];
                row.extend(toda.spectrum(l));
                row.extend(small(l));
                row
            };
            let n = positions.len();
            let mut names = conserved(&["energy"]);
            names.extend(conserved(&numbered("lambda", n)));
            names.extend(entries("L", n));
            Ok(start(Toda, state, step, fourth, row, names))
        }
        MatrixFlow::Manakov(masses, momentum) => {
            let body = Manakov::new(masses)?;
            let state = body.state(time, momentum.clone())?;
            let row = |body: &Manakov, m: &DMatrix<f64>| {
                let mut row = vec![body.energy(m), body.norm_squared(m), body.pfaffian(m)];
                // tr M^2 A^4 + tr M A^2 M A^2/2
                row.push(0.25 * body.integral(m, 4, 2));
                row.extend(small(m));
                row
            };
            let mut names = conserved(&["energy", "norm_squared", "pfaffian", "manakov"]);
            names.extend(entries("M", masses.len()));
            Ok(start(body, state, step, fourth, row, names))
        }
        MatrixFlow::Zeitlin(size, modes) => {
            let fluid = Zeitlin::new(*size)?;
            let vorticity = fluid.vorticity(modes)?;
            on_sphere(fluid, vorticity, time, step, fourth)
        }
        MatrixFlow::RandomZeitlin(size, seed, degree) => {
            let fluid = Zeitlin::new(*size)?;
            let vorticity = fluid.random(*seed, *degree)?;
            on_sphere(fluid, vorticity, time, step, fourth)
        }
    }
}

fn on_sphere(
    fluid: Zeitlin,
    vorticity: DMatrix<nalgebra::Complex<f64>>,
    time: f64,
    step: f64,
    fourth: bool,
) -> Result<Started, Error> {
    let state = fluid.state(time, vorticity)?;
    let mut names = conserved(&["energy", "enstrophy", "L1", "L2", "L3"]);
    let values = numbered("lambda", fluid.size());
    let last = values.len() - 1;
    names.extend(values.into_iter().enumerate().map(|(k, name)| (name, k == 0 || k == last)));
    names.extend(modes(fluid.size()).map(|(l, m)| (format!("w{l}_{m}"), false)));
    let row = |fluid: &Zeitlin, w: &DMatrix<nalgebra::Complex<f64>>| {
        let mut row = vec![fluid.energy(w), fluid.enstrophy(w)];
        row.extend(fluid.angular_momentum(w));
        row.extend(fluid.spectrum(w));
        row.extend(
            modes(fluid.size()).map(|(l, m)| fluid.coefficient(w, l, m).unwrap_or(f64::NAN)),
        );
        row
    };
    Ok(start(fluid, state, step, fourth, row, names))
}

/// The harmonics `(l, m)` that are columns; none for large matrices.
fn modes(size: usize) -> impl Iterator<Item = (usize, i64)> {
    let degrees = if size > SMALL { 0..0 } else { 1..size };
    degrees.flat_map(|l| (-(l as i64)..=l as i64).map(move |m| (l, m)))
}

fn conserved<T: AsRef<str>>(names: &[T]) -> Vec<(String, bool)> {
    names.iter().map(|name| (name.as_ref().to_string(), true)).collect()
}

fn numbered(stem: &str, n: usize) -> Vec<String> {
    (1..=n).map(|i| format!("{stem}{i}")).collect()
}

/// Columns of the entries of a small matrix, row by row; none for large matrices.
fn entries(stem: &str, n: usize) -> Vec<(String, bool)> {
    let n = if n > SMALL { 0 } else { n };
    (1..=n).flat_map(|i| (1..=n).map(move |j| (format!("{stem}{i}{j}"), false))).collect()
}

/// The entries of a small matrix, row by row; none of large matrices.
fn small(matrix: &DMatrix<f64>) -> Vec<f64> {
    if matrix.nrows() > SMALL { vec![] } else { matrix.transpose().as_slice().to_vec() }
}

fn start<F, R>(
    flow: F,
    state: MatrixState<F::Entry>,
    step: f64,
    fourth: bool,
    row: R,
    mut names: Vec<(String, bool)>,
) -> Started
where
    F: Isospectral<Entry: Saved> + Send + 'static,
    R: Fn(&F, &DMatrix<F::Entry>) -> Vec<f64> + Send + 'static,
{
    let drive = match fourth {
        true => Drive::fixed(Composed(IsospectralMidpoint), step),
        false => Drive::fixed(IsospectralMidpoint, step),
    };
    names.insert(0, ("t".into(), false));
    let values = move |flow: &F,
                       state: &MatrixState<F::Entry>,
                       columns: Range<usize>,
                       list: &mut Vec<f64>| {
        let mut row = row(flow, &state.matrix);
        row.insert(0, state.time);
        list.extend_from_slice(&row[columns]);
    };
    let fits = |_: &F, state: &MatrixState<F::Entry>, now: &MatrixState<F::Entry>| {
        state.matrix.shape() == now.matrix.shape()
    };
    let recorded = Recorded::new(flow, |state| &mut state.time, fits, names.len(), values);
    (Run::boxed(recorded, state, drive), names)
}

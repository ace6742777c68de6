//! Isospectral flows of matrices as motions.

use super::pace::Pace;
use super::{Motion, Snapshot};
use crate::Error;
use crate::dynamics::isospectral::Entry;
use crate::dynamics::{
    Composed, Integrator, Isospectral, IsospectralMidpoint, Manakov, MatrixState, Toda, Zeitlin,
};
use nalgebra::DMatrix;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// Matrices up to this size are written down entry by entry.
const SMALL: usize = 6;

/// A flow with its start.
#[derive(Clone, Debug)]
pub enum MatrixFlow {
    /// The Toda lattice, from positions and momenta.
    Toda(Vec<f64>, Vec<f64>),
    /// The body in n dimensions, from its masses and its momentum.
    Manakov(Vec<f64>, DMatrix<f64>),
    /// The fluid on the sphere, on su(N): coefficients of spherical harmonics `(l, m, w)`.
    Zeitlin(usize, Vec<(usize, i64, f64)>),
    /// The same, from a seed, up to a degree.
    RandomZeitlin(usize, u64, usize),
}

/// A motion, the names of its columns, and whether the change of a column is of interest.
pub type Started = (Box<dyn Motion>, Vec<(String, bool)>);

/// The motion of a flow by the isospectral midpoint rule, of order 4 if so asked, else 2; the names of its columns, and
/// whether the change of a column is of interest.
///
/// # Errors
/// What the flow refuses at its start.
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
            let mut names = watched(&["energy"]);
            names.extend(watched(&numbered("lambda", n)));
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
            let mut names = watched(&["energy", "norm_squared", "pfaffian", "manakov"]);
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
    let mut names = watched(&["energy", "enstrophy", "L1", "L2", "L3"]);
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

/// The harmonics `(l, m)` of a small fluid.
fn modes(size: usize) -> impl Iterator<Item = (usize, i64)> {
    let degrees = if size > SMALL { 0..0 } else { 1..size };
    degrees.flat_map(|l| (-(l as i64)..=l as i64).map(move |m| (l, m)))
}

fn watched<T: AsRef<str>>(names: &[T]) -> Vec<(String, bool)> {
    names.iter().map(|name| (name.as_ref().to_string(), true)).collect()
}

fn numbered(stem: &str, n: usize) -> Vec<String> {
    (1..=n).map(|i| format!("{stem}{i}")).collect()
}

/// Names of the entries of a small matrix, row by row.
fn entries(stem: &str, n: usize) -> Vec<(String, bool)> {
    let n = if n > SMALL { 0 } else { n };
    (1..=n).flat_map(|i| (1..=n).map(move |j| (format!("{stem}{i}{j}"), false))).collect()
}

/// The entries of a small matrix, row by row.
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
    F: Isospectral + Send + 'static,
    F::Entry: Entry + Serialize + DeserializeOwned,
    R: Fn(&F, &DMatrix<F::Entry>) -> Vec<f64> + Send + 'static,
{
    let integrator: Box<dyn Integrator<F> + Send> = match fourth {
        true => Box::new(Composed(IsospectralMidpoint)),
        false => Box::new(IsospectralMidpoint),
    };
    names.insert(0, ("t".into(), false));
    let pace = Pace::new(step);
    (Box::new(OnMatrices { flow, state, integrator, pace, steps: 0, row }), names)
}

struct OnMatrices<F: Isospectral, R> {
    flow: F,
    state: MatrixState<F::Entry>,
    integrator: Box<dyn Integrator<F> + Send>,
    pace: Pace,
    steps: u64,
    row: R,
}

/// The numbers of [`OnMatrices`].
#[derive(Serialize, Deserialize)]
struct Saved<M> {
    time: f64,
    matrix: M,
    pace: Pace,
    steps: u64,
}

impl<F, R> Motion for OnMatrices<F, R>
where
    F: Isospectral + Send,
    F::Entry: Entry + Serialize + DeserializeOwned,
    R: Fn(&F, &DMatrix<F::Entry>) -> Vec<f64> + Send,
{
    fn time(&self) -> f64 {
        self.state.time
    }

    fn step(&mut self, until: f64) -> Result<bool, Error> {
        if self.state.time != until {
            let OnMatrices { flow, state, integrator, pace, .. } = self;
            let time = state.time;
            state.time = pace.step(time, until, |h| integrator.step(flow, state, h))?;
            self.steps = self.steps.saturating_add(1);
        }
        Ok(self.state.time == until)
    }

    fn row(&self) -> Vec<f64> {
        let mut row = (self.row)(&self.flow, &self.state.matrix);
        row.insert(0, self.state.time);
        row
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn save(&self) -> Result<Snapshot, Error> {
        let (matrix, pace, steps) = (&self.state.matrix, self.pace, self.steps);
        Snapshot::of(&Saved { time: self.state.time, matrix, pace, steps })
    }

    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        let saved: Saved<DMatrix<F::Entry>> = snapshot.read()?;
        let fits = saved.matrix.shape() == self.state.matrix.shape();
        if !(fits && self.pace.fits(&saved.pace)) {
            return Err(Error::Snapshot { reason: "it is of another motion".into() });
        }
        self.state = MatrixState { time: saved.time, matrix: saved.matrix };
        (self.pace, self.steps) = (saved.pace, saved.steps);
        Ok(())
    }
}

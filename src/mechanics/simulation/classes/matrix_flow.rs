//! Isospectral flows of matrices.

use crate::Error;
use crate::mechanics::simulation::methods::Method;
use crate::mechanics::simulation::motion::{Motion, ObservedMotion, simulation};
use crate::mechanics::{Isospectral, Manakov, MatrixState, Toda, Zeitlin};
use nalgebra::{Complex, DMatrix};
use std::ops::Range;

/// The entries of matrices up to this size are columns.
const SMALL: usize = 6;

/// An isospectral flow with its initial condition.
#[derive(Clone, Debug)]
pub enum MatrixFlow {
    /// The Toda lattice, with its positions and momenta.
    Toda(Vec<f64>, Vec<f64>),
    /// The free body in n dimensions, with its masses and momentum.
    Manakov(Vec<f64>, DMatrix<f64>),
    /// The fluid on the sphere, with the `N` of su(N) and the coefficients `(l, m, w_lm)` of
    /// spherical harmonics.
    Zeitlin(usize, Vec<(usize, i64, f64)>),
    /// The fluid on the sphere with random coefficients. The values are `N`, a seed, and the
    /// largest degree.
    RandomZeitlin(usize, u64, usize),
}

/// A motion with its columns.
pub struct StartedFlow {
    /// The motion.
    pub motion: Box<dyn Motion>,
    /// The name of each column, and whether it is conserved.
    pub columns: Vec<(String, bool)>,
}

/// Settings of the integration of a flow.
#[derive(Clone, Copy)]
struct How {
    time: f64,
    method: Method,
    step: f64,
}

impl MatrixFlow {
    /// Starts the motion. The method must belong to [`Class::MatrixFlow`](super::super::Class);
    /// steps have at most the size `step`.
    ///
    /// # Errors
    /// The errors of the constructors of the flow and its state, if the initial condition is
    /// invalid; [`Error::Unsupported`] if the method belongs to another class.
    pub fn start(&self, time: f64, method: Method, step: f64) -> Result<StartedFlow, Error> {
        let how = How { time, method, step };
        match self {
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
                start(Toda, state, how, row, names)
            }
            MatrixFlow::Manakov(masses, momentum) => {
                let body = Manakov::new(masses)?;
                let state = body.state(time, momentum.clone())?;
                let row = |body: &Manakov, m: &DMatrix<f64>| {
                    let mut row = vec![body.energy(m), body.norm_squared(m), body.pfaffian(m)];
                    // this value equals tr M^2 A^4 + tr M A^2 M A^2/2
                    row.push(0.25 * body.integral(m, 4, 2));
                    row.extend(small(m));
                    row
                };
                let mut names = conserved(&["energy", "norm_squared", "pfaffian", "manakov"]);
                names.extend(entries("M", masses.len()));
                start(body, state, how, row, names)
            }
            MatrixFlow::Zeitlin(size, modes) => {
                let fluid = Zeitlin::new(*size)?;
                let vorticity = fluid.vorticity(modes)?;
                on_sphere(fluid, vorticity, how)
            }
            MatrixFlow::RandomZeitlin(size, seed, degree) => {
                let fluid = Zeitlin::new(*size)?;
                let vorticity = fluid.random(*seed, *degree)?;
                on_sphere(fluid, vorticity, how)
            }
        }
    }
}

fn on_sphere(
    fluid: Zeitlin,
    vorticity: DMatrix<Complex<f64>>,
    how: How,
) -> Result<StartedFlow, Error> {
    let state = fluid.state(how.time, vorticity)?;
    let mut names = conserved(&["energy", "enstrophy", "L1", "L2", "L3"]);
    let values = numbered("lambda", fluid.size());
    let last = values.len() - 1;
    names.extend(values.into_iter().enumerate().map(|(k, name)| (name, k == 0 || k == last)));
    names.extend(modes(fluid.size()).map(|(l, m)| (format!("w{l}_{m}"), false)));
    let row = |fluid: &Zeitlin, w: &DMatrix<Complex<f64>>| {
        let mut row = vec![fluid.energy(w), fluid.enstrophy(w)];
        row.extend(fluid.angular_momentum(w));
        row.extend(fluid.spectrum(w));
        row.extend(
            modes(fluid.size()).map(|(l, m)| fluid.coefficient(w, l, m).unwrap_or(f64::NAN)),
        );
        row
    };
    start(fluid, state, how, row, names)
}

/// The harmonics `(l, m)` whose coefficients are columns. The list is empty for large matrices.
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

/// The columns for the entries of a small matrix, row by row. The list is empty for large matrices.
fn entries(stem: &str, n: usize) -> Vec<(String, bool)> {
    let n = if n > SMALL { 0 } else { n };
    (1..=n).flat_map(|i| (1..=n).map(move |j| (format!("{stem}{i}{j}"), false))).collect()
}

/// The entries of a small matrix, row by row. The list is empty for large matrices.
fn small(matrix: &DMatrix<f64>) -> Vec<f64> {
    if matrix.nrows() > SMALL { vec![] } else { matrix.transpose().as_slice().to_vec() }
}

fn start<F, R>(
    flow: F,
    state: MatrixState<F::Entry>,
    how: How,
    row: R,
    mut columns: Vec<(String, bool)>,
) -> Result<StartedFlow, Error>
where
    F: Isospectral<Entry: Send> + Send + 'static,
    R: Fn(&F, &DMatrix<F::Entry>) -> Vec<f64> + Send + 'static,
{
    let stepper = how.method.matrix_flow(how.step);
    let stepper = stepper.ok_or_else(|| how.method.refused("it is not for flows of matrices"))?;
    columns.insert(0, ("t".into(), false));
    let moving = Moving { flow, row, count: columns.len() };
    Ok(StartedFlow { motion: simulation(moving, state, stepper), columns })
}

/// A flow, with the values of the columns that follow the time.
struct Moving<F, R> {
    flow: F,
    row: R,
    count: usize,
}

impl<F, R> ObservedMotion for Moving<F, R>
where
    F: Isospectral<Entry: Send> + Send + 'static,
    R: Fn(&F, &DMatrix<F::Entry>) -> Vec<f64> + Send + 'static,
{
    type System = F;

    fn system(&self) -> &F {
        &self.flow
    }

    fn set_time(&self, state: &mut MatrixState<F::Entry>, time: f64) {
        state.time = time;
    }

    fn column_count(&self) -> usize {
        self.count
    }

    fn values(&self, state: &MatrixState<F::Entry>, columns: Range<usize>, list: &mut Vec<f64>) {
        let mut row = (self.row)(&self.flow, &state.matrix);
        row.insert(0, state.time);
        list.extend_from_slice(&row[columns]);
    }
}

//! The equations of curves on a chart as programs in floats.

use super::{ChartEquations, VelocityPolynomial};
use crate::Error;
use crate::algebra::frame::formula;
use crate::mechanics::systems::System;
use crate::numerics::blocks::BlockProgram;
use affinor_tensors::scalar::StraightLine;
use affinor_tensors::{Recorded, Ring, Symbolic, Tensor};
use nalgebra::{DMatrix, DVector};
use std::cell::RefCell;
use std::sync::Arc;

/// A function of the coordinates whose sign is constant on the chart.
#[derive(Clone, Debug)]
pub struct Edge {
    /// The function.
    pub function: Symbolic,
    /// Whether the function is positive. Otherwise its sign is the sign at the start of the curve.
    pub positive: bool,
    /// The reason why a curve ends where the function changes its sign, as in "the metric
    /// degenerates".
    pub reason: String,
}

/// The programs of [`ChartEquations`], for all values of the parameters.
#[derive(Clone, Debug)]
pub struct ChartProgram {
    coordinates: Vec<String>,
    /// The number of polynomials in the velocity.
    quantities: usize,
    edges: Vec<Edge>,
    has_metric: bool,
    /// The accelerations, then the edges, then the square of the velocity.
    motion: BlockProgram,
    /// The metric, then the symmetric matrix `Lambda^i_(jk) v^k`, both row by row.
    local: BlockProgram,
    /// The polynomials in the velocity.
    observed: BlockProgram,
}

/// A curve on a chart, for given values of the parameters.
#[derive(Clone, Debug)]
pub struct ChartSystem {
    program: Arc<ChartProgram>,
    parameters: Vec<f64>,
    /// The signs of the edges.
    signs: Vec<f64>,
    /// The diagonal of the metric at the start.
    diagonal: Vec<f64>,
    /// Whether the state contains the length of the curve.
    has_length: bool,
    buffers: RefCell<Buffers>,
}

#[derive(Clone, Debug, Default)]
struct Buffers {
    inputs: Vec<f64>,
    values: Vec<f64>,
    out: Vec<f64>,
    /// The edge that the last rejected point has crossed, or the reason why it has no acceleration.
    trouble: Option<String>,
}

/// A point of a curve: the coordinates, the velocity and, if the system computes it, the length.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartState {
    /// The parameter of the curve.
    pub parameter: f64,
    /// The numbers.
    pub numbers: DVector<f64>,
}

impl System for ChartSystem {
    type State = ChartState;

    fn time(&self, state: &ChartState) -> f64 {
        state.parameter
    }
}

impl ChartProgram {
    /// Compiles the equations, the polynomials in the velocity and the edges of the chart. All of
    /// them may depend on the parameters with these names.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a function of the coordinates without a value.
    pub fn new(
        equations: &ChartEquations,
        parameters: &[String],
        quantities: &[VelocityPolynomial],
        edges: Vec<Edge>,
    ) -> Result<Self, Error> {
        let coordinates = equations.coordinates().to_vec();
        let n = coordinates.len();
        let velocity: Vec<String> = coordinates.iter().map(|name| format!("v_{name}")).collect();
        let v: Vec<Recorded> = velocity.iter().map(|name| Recorded::input(name)).collect();
        let inputs: Vec<&String> = coordinates.iter().chain(&velocity).chain(parameters).collect();
        let compile = |values: &[Recorded]| {
            let program = StraightLine::new(values);
            let places: Vec<usize> = (0..values.len()).collect();
            if let Some(missing) =
                program.inputs().find(|input| inputs.iter().all(|name| *name != input.text()))
            {
                let message = format!("the equations depend on `{missing}`, which has no value");
                return Err(Error::Unsupported(message));
            }
            let compiled = BlockProgram::new(&program, &inputs, &places);
            let mut compiled = compiled.ok_or_else(|| {
                Error::Unsupported(
                    "the equations have a constant beyond the range of floats".into(),
                )
            })?;
            compiled.fill(values.len());
            Ok(compiled)
        };
        let gamma = equations.connection().affinities();
        let half = Symbolic::from_i64(1) / &Symbolic::from_i64(2);
        let symmetric = formula("L^i_jk + L^i_kj -> ^i_jk", &[("L", gamma)]).scale(&half);
        let mut spin = vec![Vec::new(); n * n];
        for (at, value) in symmetric.components() {
            spin[at[0] * n + at[1]].push(recorded(value)? * &v[at[2]]);
        }
        let spin: Vec<Recorded> = spin.into_iter().map(total).collect();
        let mut motion = Vec::with_capacity(n);
        for i in 0..n {
            let mut terms: Vec<Recorded> =
                (0..n).map(|j| -(spin[i * n + j].clone() * &v[j])).collect();
            for (j, v) in v.iter().enumerate() {
                terms.push(recorded(&equations.linear.get(&[i, j]))? * v);
            }
            terms.push(recorded(&equations.constant.get(&[i]))?);
            motion.push(total(terms));
        }
        for edge in &edges {
            motion.push(recorded(&edge.function)?);
        }
        let metric = match equations.metric() {
            Some(metric) => {
                motion.push(polynomial(&equations.norm()?, &v)?);
                matrix(metric.components(), n)?
            }
            None => vec![Recorded::default(); n * n],
        };
        let observed: Result<Vec<Recorded>, Error> =
            quantities.iter().map(|quantity| polynomial(quantity, &v)).collect();
        Ok(ChartProgram {
            has_metric: equations.metric().is_some(),
            quantities: quantities.len(),
            motion: compile(&motion)?,
            local: compile(&[metric, spin].concat())?,
            observed: compile(&observed?)?,
            coordinates,
            edges,
        })
    }

    /// The metric at a position; `None` without a metric.
    pub fn metric(&self, position: &[f64], parameters: &[f64]) -> Option<DMatrix<f64>> {
        let n = self.coordinates.len();
        let mut inputs = position.to_vec();
        inputs.resize(2 * n, 0.0);
        inputs.extend_from_slice(parameters);
        let mut out = vec![0.0; 2 * n * n];
        self.local.evaluate_row(&inputs, &mut vec![], &mut out);
        self.has_metric.then(|| DMatrix::from_row_slice(n, n, &out[..n * n]))
    }

    /// The names of the coordinates.
    pub fn coordinates(&self) -> &[String] {
        &self.coordinates
    }
}

fn recorded(value: &Symbolic) -> Result<Recorded, Error> {
    Recorded::try_from(value).map_err(Error::Unsupported)
}

fn total(terms: Vec<Recorded>) -> Recorded {
    terms.into_iter().fold(Recorded::default(), |sum, term| sum + &term)
}

fn matrix(tensor: &Tensor<Symbolic>, n: usize) -> Result<Vec<Recorded>, Error> {
    (0..n * n).map(|at| recorded(&tensor.get(&[at / n, at % n]))).collect()
}

/// The value of a polynomial in the velocity.
fn polynomial(quantity: &VelocityPolynomial, v: &[Recorded]) -> Result<Recorded, Error> {
    let mut terms = vec![recorded(&quantity.constant)?];
    for (at, value) in quantity.linear.components() {
        terms.push(recorded(value)? * &v[at[0]]);
    }
    for (at, value) in quantity.quadratic.components() {
        terms.push(recorded(value)? * &v[at[0]] * &v[at[1]]);
    }
    Ok(total(terms))
}

impl ChartSystem {
    /// The system for these values of the parameters, with the signs that the edges have at the
    /// start.
    ///
    /// # Errors
    /// [`Error::CurveEnds`] if the start is not in the chart, or if the equations have no finite
    /// value there.
    pub fn new(
        program: Arc<ChartProgram>,
        parameters: Vec<f64>,
        start: &ChartState,
        has_length: bool,
    ) -> Result<Self, Error> {
        let signs = program.edges.iter().map(|edge| f64::from(u8::from(edge.positive)));
        let signs = signs.collect();
        let buffers = RefCell::default();
        let diagonal = vec![];
        let mut system = ChartSystem { program, parameters, signs, diagonal, has_length, buffers };
        let slope = system.slope(&start.numbers);
        if !slope.iter().all(|value| value.is_finite()) {
            return Err(system.ends(start));
        }
        let n = system.program.coordinates.len();
        let values = system.buffers.borrow().out[n..].to_vec();
        for (sign, value) in system.signs.iter_mut().zip(values) {
            *sign = value.signum();
        }
        system.diagonal = system.metric(start).map_or(vec![], |g| g.diagonal().data.into());
        Ok(system)
    }

    /// The dimension of the chart.
    pub fn dimension(&self) -> usize {
        self.program.coordinates.len()
    }

    fn evaluate<T>(
        &self,
        program: &BlockProgram,
        width: usize,
        numbers: &DVector<f64>,
        take: impl FnOnce(&[f64]) -> T,
    ) -> T {
        let Buffers { inputs, values, out, .. } = &mut *self.buffers.borrow_mut();
        inputs.clear();
        inputs.extend_from_slice(&numbers.as_slice()[..2 * self.dimension()]);
        inputs.extend_from_slice(&self.parameters);
        out.clear();
        out.resize(width, 0.0);
        program.evaluate_row(inputs, values, out);
        take(out)
    }

    /// The derivative of the numbers of a state. It is NaN outside of the chart.
    pub(crate) fn slope(&self, numbers: &DVector<f64>) -> DVector<f64> {
        let (n, program) = (self.dimension(), &*self.program);
        let edges = program.edges.len();
        let width = n + edges + usize::from(program.has_metric);
        let (slope, trouble) = self.evaluate(&program.motion, width, numbers, |out| {
            let mut slope = DVector::zeros(numbers.len());
            slope.rows_mut(0, n).copy_from(&numbers.rows(n, n));
            slope.rows_mut(n, n).copy_from_slice(&out[..n]);
            if self.has_length {
                slope[2 * n] = out[n + edges].abs().sqrt();
            }
            let crossed = self.signs.iter().zip(&out[n..n + edges]).zip(&program.edges);
            let mut crossed =
                crossed.filter(|((sign, value), _)| **sign * **value < 0.0 || **value == 0.0);
            let crossed = crossed.next().map(|(_, edge)| edge);
            let trouble = crossed.map(|edge| edge.reason.clone());
            if trouble.is_some() {
                slope.fill(f64::NAN);
            }
            (slope, trouble)
        });
        if trouble.is_some() {
            self.buffers.borrow_mut().trouble = trouble;
        }
        slope
    }

    /// Forgets why an earlier point was rejected.
    pub(crate) fn forget(&self) {
        self.buffers.borrow_mut().trouble = None;
    }

    /// The values of the polynomials in the velocity.
    pub fn quantities(&self, state: &ChartState) -> Vec<f64> {
        let ChartProgram { observed, quantities, .. } = &*self.program;
        self.evaluate(observed, *quantities, &state.numbers, <[f64]>::to_vec)
    }

    /// The metric and the matrix `Lambda^i_(jk) v^k` at a state.
    fn local(&self, numbers: &DVector<f64>) -> [DMatrix<f64>; 2] {
        let n = self.dimension();
        self.evaluate(&self.program.local, 2 * n * n, numbers, |out| {
            let (metric, spin) = out.split_at(n * n);
            [metric, spin].map(|part| DMatrix::from_row_slice(n, n, part))
        })
    }

    /// The metric at a state; `None` without a metric.
    pub fn metric(&self, state: &ChartState) -> Option<DMatrix<f64>> {
        self.program.has_metric.then(|| self.local(&state.numbers)[0].clone())
    }

    /// The sizes of the coordinate vectors at a state, in which components are compared. They change
    /// with the units of the coordinates as the vectors do. They are negative for vectors with
    /// negative squares. Without a metric, the size of a vector is the reciprocal of the component
    /// of the velocity.
    pub(crate) fn sizes(&self, numbers: &DVector<f64>) -> DVector<f64> {
        let n = self.dimension();
        if !self.program.has_metric {
            let size =
                |i: usize| if numbers[n + i] == 0.0 { 0.0 } else { 1.0 / numbers[n + i].abs() };
            return DVector::from_fn(n, |i, _| size(i));
        }
        let [g, _] = self.local(numbers);
        DVector::from_fn(n, |i, _| {
            // a null vector has the size of its part along another coordinate vector
            let along = |j: usize| match g[(j, j)].abs() {
                _ if j == i => g[(i, i)].abs(),
                0.0 => 0.0,
                square => g[(i, j)] * g[(i, j)] / square,
            };
            let square = (0..n).map(along).fold(0.0, f64::max);
            let null = || g.row(i).iter().fold(0.0, |most: f64, value| most.max(value.abs()));
            let size = if square == 0.0 { null() } else { square }.sqrt();
            if g[(i, i)] < 0.0 { -size } else { size }
        })
    }

    /// The largest rate at which the velocity changes its direction, or at which the coordinate
    /// frame rotates along the curve.
    pub(crate) fn rate(&self, state: &ChartState) -> f64 {
        let (n, numbers) = (self.dimension(), &state.numbers);
        let [_, spin] = self.local(numbers);
        let sizes = self.sizes(numbers);
        let ratio = |i: usize, j: usize| match sizes[j] {
            0.0 => 0.0,
            size => spin[(i, j)] * sizes[i] / size,
        };
        let rotation = DMatrix::from_fn(n, n, ratio).norm();
        let slope = self.slope(numbers);
        let size = |part: &DVector<f64>, from: usize| {
            (0..n).map(|i| (sizes[i] * part[from + i]).powi(2)).sum::<f64>().sqrt()
        };
        let (speed, force) = (size(numbers, n), size(&slope, n));
        let turn = if speed > 0.0 { force / speed } else { 0.0 };
        rotation.max(turn)
    }

    /// The error for a curve that cannot be continued beyond a state: where it ends, and why.
    pub(crate) fn ends(&self, state: &ChartState) -> Error {
        let (n, names) = (self.dimension(), &self.program.coordinates);
        let at = names.iter().zip(state.numbers.iter()).map(|(name, x)| format!("{name} = {x}"));
        let at = at.collect::<Vec<_>>().join(", ");
        let trouble = self.buffers.borrow().trouble.clone();
        let reason = trouble.unwrap_or_else(|| {
            let metric = self.metric(state);
            let diagonal = metric.iter().flat_map(|g| (0..n).map(|i| (i, g[(i, i)])));
            let ratio = |(i, value): &(usize, f64)| {
                (value / self.diagonal.get(*i).filter(|g| **g != 0.0).unwrap_or(&1.0)).abs()
            };
            let extreme = diagonal
                .filter(|component| !(SMALL..LARGE).contains(&ratio(component)))
                .map(|(i, value)| format!("g_{0},{0} = {value:.1e}", names[i]));
            let extreme: Vec<String> = extreme.collect();
            match extreme.is_empty() {
                true => "the equations are singular there: steps become too small".into(),
                false => format!("the metric is singular there: {}", extreme.join(", ")),
            }
        });
        Error::CurveEnds { parameter: state.parameter, reason: format!("{reason}; at {at}") }
    }
}

/// If steps become too small, components of the metric beyond these ratios to their values at the
/// start are a sign of a singular metric.
const SMALL: f64 = 1e-6;
const LARGE: f64 = 1e6;

//! Geodesics between two points of a chart.

use super::{Geodesic, ROUNDING, Shooting, TOLERANCE, spread};
use crate::Error;
use crate::mechanics::integrators::ChartSteps;
use crate::mechanics::systems::chart::{ChartProgram, ChartState, ChartSystem};
use crate::mechanics::{Adaptive, stopped};
use affinor_tensors::stop::checkpoint;
use nalgebra::DVector;
use std::sync::Arc;

/// The largest number of steps of one curve.
const STEPS: usize = 2_000;
/// The part of the segment up to the first point of a continued start, and the largest number of
/// points.
const FIRST: f64 = 1.0 / 16.0;
const POINTS: usize = 60;

/// A curve between two points of a chart. Coordinates are compared as numbers: a curve around an
/// axis ends at another value of its angle.
///
/// The miss is the difference of the coordinates, in the sizes `sqrt|g_ii|` of the coordinate
/// vectors at the end.
#[derive(Clone, Debug)]
pub struct ChartShooting {
    program: Arc<ChartProgram>,
    parameters: Vec<f64>,
    from: DVector<f64>,
    to: DVector<f64>,
    /// The sizes of the coordinate vectors at both ends.
    sizes: [DVector<f64>; 2],
    has_metric: bool,
}

impl ChartShooting {
    /// The problem of two points, for these values of the parameters of the program.
    ///
    /// # Errors
    /// [`Error::CurveEnds`] if the start is not in the chart; [`Error::EndPoint`] if the end is not
    /// in the same part of the chart, or if the points are equal.
    pub fn new(
        program: Arc<ChartProgram>,
        parameters: Vec<f64>,
        from: &[f64],
        to: &[f64],
    ) -> Result<Self, Error> {
        let outside = |reason: &str| Error::EndPoint { reason: reason.into() };
        let (from, to) = (DVector::from_column_slice(from), DVector::from_column_slice(to));
        if from == to {
            return Err(super::equal_points());
        }
        let has_metric = program.metric(from.as_slice(), &parameters).is_some();
        let at = |position: &DVector<f64>| {
            let zeros = vec![0.0; position.len()];
            let numbers = DVector::from_vec([position.as_slice(), &zeros].concat());
            ChartState { parameter: 0.0, numbers }
        };
        let system = ChartSystem::new(program.clone(), parameters.clone(), &at(&from), false)?;
        if !system.slope(&at(&to).numbers).iter().all(|value| value.is_finite()) {
            let Error::CurveEnds { reason, .. } = system.ends(&at(&to)) else {
                return Err(outside("is not in the chart"));
            };
            return Err(outside(&format!("is not in the chart: {reason}")));
        }
        let sizes = [&from, &to].map(|position| match has_metric {
            true => system.sizes(&at(position).numbers).abs(),
            false => DVector::from_element(position.len(), 1.0),
        });
        Ok(ChartShooting { program, parameters, from, to, sizes, has_metric })
    }

    /// The end of the curve with an initial velocity: the coordinates, the velocity, the length.
    fn end(&self, velocity: &DVector<f64>, tolerance: f64) -> Result<DVector<f64>, Error> {
        let length: &[f64] = if self.has_metric { &[0.0] } else { &[] };
        let numbers = [self.from.as_slice(), velocity.as_slice(), length].concat();
        let mut state = ChartState { parameter: 0.0, numbers: DVector::from_vec(numbers) };
        let (program, parameters) = (self.program.clone(), self.parameters.clone());
        let system = ChartSystem::new(program, parameters, &state, self.has_metric)?;
        let control = ChartSteps(Adaptive { span: 1.0, ..Adaptive::of_order_8(tolerance) });
        let mut next = control.first_step(&system, &state);
        for _ in 0..STEPS {
            checkpoint();
            control.step(&system, &mut state, &mut next, 1.0)?;
            if state.parameter == 1.0 {
                return Ok(state.numbers);
            }
        }
        Err(stopped(state.parameter, "too many steps"))
    }

    /// The velocity that results if the end moves along a segment from the start. Each geodesic
    /// predicts the next one, by linear extrapolation.
    fn continued(&self) -> Option<DVector<f64>> {
        let whole = &self.to - &self.from;
        let mut step = FIRST;
        let mut before = (0.0, DVector::zeros(whole.len()));
        let mut reached = before.clone();
        for _ in 0..POINTS {
            let part = (reached.0 + step).min(1.0);
            let start = match reached.0 - before.0 {
                0.0 => &whole * part,
                last => &reached.1 + (&reached.1 - &before.1) * ((part - reached.0) / last),
            };
            let problem = ChartShooting { to: &self.from + &whole * part, ..self.clone() };
            if let Ok(super::Solution::Found(geodesic)) = super::solve(&problem, start) {
                (before, reached) = (reached, (part, geodesic.velocity));
                if part == 1.0 {
                    return Some(reached.1);
                }
                step *= 2.0;
            } else {
                step *= 0.25;
            }
        }
        None
    }
}

impl Shooting for ChartShooting {
    type Curve = Geodesic;

    fn miss(&self, velocity: &DVector<f64>, tolerance: f64) -> Result<DVector<f64>, Error> {
        let n = self.from.len();
        let end = self.end(velocity, tolerance)?;
        Ok((end.rows(0, n) - &self.to).component_mul(&self.sizes[1]))
    }

    fn geodesic(
        &self,
        velocity: &DVector<f64>,
        miss: &DVector<f64>,
        regularity: f64,
    ) -> Result<Geodesic, Error> {
        let n = self.from.len();
        let end = self.end(velocity, TOLERANCE)?;
        let metric = self.program.metric(self.from.as_slice(), &self.parameters);
        Ok(Geodesic {
            velocity: velocity.clone(),
            end_velocity: end.rows(n, n).into(),
            square: metric.map(|g| velocity.dot(&(g * velocity))),
            length: self.has_metric.then(|| end[2 * n]),
            residual: miss.norm(),
            regularity,
        })
    }

    fn starts(&self, count: usize) -> Vec<DVector<f64>> {
        let direct = &self.to - &self.from;
        let size = direct.component_mul(&self.sizes[0]).norm();
        let others = (1..count).map(|index| {
            let spread = spread(index, direct.len()) * size;
            &direct + spread.component_div(&self.sizes[0])
        });
        self.continued().into_iter().chain([direct.clone()]).chain(others).collect()
    }

    fn sizes(&self) -> DVector<f64> {
        self.sizes[0].clone()
    }

    fn resolution(&self) -> f64 {
        ROUNDING * self.to.component_mul(&self.sizes[1]).norm()
    }
}

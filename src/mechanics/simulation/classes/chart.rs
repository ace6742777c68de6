//! Curves on charts: autoparallels and geodesics, with potentials and charges.

use crate::Error;
use crate::mechanics::formula::{Formula, Workspace};
use crate::mechanics::integrators::ChartSteps;
use crate::mechanics::simulation::integration::Integration;
use crate::mechanics::simulation::methods::{Class, Method};
use crate::mechanics::simulation::motion::{ObservedMotion, Started, simulation};
use crate::mechanics::simulation::stepper::Stepper;
use crate::mechanics::systems::chart::{ChartProgram, ChartState, ChartSystem};
use nalgebra::DVector;
use std::cell::RefCell;
use std::ops::Range;
use std::sync::Arc;

/// The specification of a curve on a chart.
pub struct ChartSpec {
    /// The equations, and the polynomials in the velocity that are columns.
    pub program: Arc<ChartProgram>,
    /// The values of the parameters of the program.
    pub parameters: Vec<f64>,
    /// The initial parameter of the curve.
    pub start: f64,
    /// The initial coordinates.
    pub position: Vec<f64>,
    /// The initial velocity, in the coordinate frame.
    pub velocity: Vec<f64>,
    /// How the length of the curve is computed.
    pub length: CurveLength,
    /// The method and its settings.
    pub integration: Integration,
    /// The columns.
    pub columns: ChartColumns,
}

/// How the length of a curve, or its proper time, is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CurveLength {
    /// The chart has no metric, so curves have no length.
    None,
    /// The speed `sqrt|g(v, v)|` is constant, and has this value.
    Speed(f64),
    /// The speed changes, so the length is integrated together with the curve.
    Integral,
}

/// The columns of a curve on a chart, as formulas in its quantities.
///
/// The quantities are, in this order: the parameter, the coordinates, the components of the velocity,
/// the length, the polynomials in the velocity, and the derived quantities.
#[derive(Clone, Debug, Default)]
pub struct ChartColumns {
    /// Formulas in the quantities before them; their values are quantities too.
    pub derived: Vec<Formula>,
    /// The formulas of the columns.
    pub formulas: Vec<Formula>,
}

impl ChartSpec {
    /// Starts the motion.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if the method belongs to another class; [`Error::CurveEnds`] if the
    /// start is not in the chart.
    pub fn start(self) -> Result<Started, Error> {
        let method = self.integration.method.unwrap_or(Method::DormandPrince853);
        if method.class() != Class::Chart {
            let names = Method::names_of(&[Class::Chart]);
            return Err(method.refused(&format!("curves on a chart need one of {names}")));
        }
        self.integration.step_of(method)?;
        let mut numbers = [self.position, self.velocity].concat();
        let has_length = self.length == CurveLength::Integral;
        numbers.extend(has_length.then_some(0.0));
        let state = ChartState { parameter: self.start, numbers: DVector::from_vec(numbers) };
        let system = ChartSystem::new(self.program, self.parameters, &state, has_length)?;
        let control = ChartSteps(self.integration.control);
        let first = control.first_step(&system, &state);
        let step = move |system: &ChartSystem, state: &mut ChartState, next: &mut f64, end| {
            control.step(system, state, next, end)
        };
        let stepper = Stepper::by(step, self.integration.control.max_steps, first);
        let curve = Curve {
            system,
            length: self.length,
            start: self.start,
            columns: self.columns,
            buffers: RefCell::default(),
        };
        Ok(Started { motion: simulation(curve, state, stepper), method })
    }
}

/// The motion, with the values of its columns.
struct Curve {
    system: ChartSystem,
    length: CurveLength,
    start: f64,
    columns: ChartColumns,
    buffers: RefCell<(Vec<f64>, Workspace)>,
}

impl Curve {
    /// Replaces `values` by the quantities at a state.
    fn quantities(&self, state: &ChartState, values: &mut Vec<f64>, workspace: &mut Workspace) {
        let n = self.system.dimension();
        let numbers = state.numbers.as_slice();
        values.clear();
        values.push(state.parameter);
        values.extend_from_slice(&numbers[..2 * n]);
        values.push(match self.length {
            CurveLength::None => f64::NAN,
            CurveLength::Speed(speed) => speed * (state.parameter - self.start).abs(),
            CurveLength::Integral => numbers[2 * n].abs(),
        });
        values.extend(self.system.quantities(state));
        for formula in &self.columns.derived {
            let value = formula.value_in(values, workspace);
            values.push(value);
        }
    }
}

impl ObservedMotion for Curve {
    type System = ChartSystem;

    fn system(&self) -> &ChartSystem {
        &self.system
    }

    fn set_time(&self, state: &mut ChartState, time: f64) {
        state.parameter = time;
    }

    fn column_count(&self) -> usize {
        self.columns.formulas.len()
    }

    fn values(&self, state: &ChartState, columns: Range<usize>, list: &mut Vec<f64>) {
        let (values, workspace) = &mut *self.buffers.borrow_mut();
        self.quantities(state, values, workspace);
        let formulas = &self.columns.formulas[columns];
        list.extend(formulas.iter().map(|formula| formula.value_in(values, workspace)));
    }

    fn rate(&self, state: &ChartState) -> f64 {
        self.system.rate(state)
    }
}

//! Motions of systems with holonomic constraints.

use super::configuration::ConfigurationGroup;
use super::drive::Drive;
use super::observables::{Buffers, Point};
use super::quantities::{Names, Quantity, Scope};
use super::run::{Recorded, Run};
use super::{Forces, Motion};
use crate::Error;
use crate::group::{Coordinates, Generator};
use crate::mechanics::formula::Formula;
use crate::mechanics::systems::constrained::ConstrainedState;
use crate::mechanics::{Constrained, Constraint, GeneralisedAlpha};
use affinor_tensors::expression::ExpressionError;
use nalgebra::{DMatrix, DVector};
use std::cell::RefCell;
use std::ops::Range;

/// Holonomic constraints `Phi(g) = 0`: formulas of the entries of the element and the parameters.
#[derive(Clone, Debug)]
pub struct Equations<G: ConfigurationGroup> {
    group: G,
    scope: Scope,
    formulas: Vec<Formula>,
    parameters: Vec<f64>,
    rows: usize,
    generators: Vec<Generator>,
    /// Also the derivatives of a formula by the quantities, and of the entries along the invariant fields.
    buffers: RefCell<(Buffers, [Vec<f64>; 2])>,
}

impl<G: ConfigurationGroup> Equations<G> {
    /// No constraints yet.
    pub fn new(group: G, parameters: Vec<f64>) -> Self {
        let (rows, generators) = (group.write(&group.identity()).nrows(), Generator::of(&group));
        let (scope, formulas, buffers) = (Scope::default(), vec![], RefCell::default());
        Equations { group, scope, formulas, parameters, rows, generators, buffers }
    }

    /// Adds a constraint: a formula that must vanish.
    ///
    /// # Errors
    /// As [`Formula::parse`]; also for quantities other than entries of the element and parameters.
    pub fn add(&mut self, text: &str, names: &Names) -> Result<(), ExpressionError> {
        let allowed = |quantity| matches!(quantity, Quantity::Parameter(_) | Quantity::Entry(..));
        self.formulas.push(self.scope.read(text, names, &allowed)?);
        Ok(())
    }

    /// Evaluates the quantities at an element.
    fn evaluate(&self, element: &G::Element, buffers: &mut Buffers) {
        let Buffers { values, entries, .. } = buffers;
        self.group.entries(element, entries);
        let value = |quantity| match quantity {
            Quantity::Parameter(k) => self.parameters[k],
            Quantity::Entry(row, column) => entries[row + column * self.rows],
            _ => f64::NAN,
        };
        self.scope.evaluate(value, values);
    }
}

impl<G: ConfigurationGroup> Constraint<G> for Equations<G> {
    fn value(&self, element: &G::Element) -> DVector<f64> {
        let (buffers, _) = &mut *self.buffers.borrow_mut();
        self.evaluate(element, buffers);
        let Buffers { values, workspace, .. } = buffers;
        DVector::from_fn(self.formulas.len(), |a, _| self.formulas[a].value_in(values, workspace))
    }

    fn gradient(&self, element: &G::Element) -> DMatrix<f64> {
        let (buffers, [partial, fields]) = &mut *self.buffers.borrow_mut();
        self.evaluate(element, buffers);
        let Buffers { values, entries, workspace } = buffers;
        self.group.slopes(element, entries, &self.generators, fields);
        partial.resize(values.len(), 0.0);
        let mut gradient = DMatrix::zeros(self.formulas.len(), self.group.dimension());
        for (a, formula) in self.formulas.iter().enumerate() {
            formula.gradient_in(values, partial, workspace);
            for (i, field) in fields.chunks_exact(entries.len()).enumerate() {
                gradient[(a, i)] = self.scope.along(partial, field, self.rows);
            }
        }
        gradient
    }
}

/// The system of a [`Constrained`] motion.
pub type ConstrainedSystem<G> = Constrained<G, Equations<G>, Forces<G>>;

/// The motion from an element with a velocity in the frame of the equations, by the generalised-alpha method. A row holds the
/// first `visible` formulas, the Lagrange multipliers, the largest violation of a constraint, and the other formulas.
///
/// # Errors
/// As [`Constrained::state`].
pub fn on_constraints<G: ConfigurationGroup>(
    system: ConstrainedSystem<G>,
    (time, element, velocity): (f64, G::Element, G::Vector),
    step: f64,
    columns: (Scope, Vec<Formula>),
    visible: usize,
) -> Result<Box<dyn Motion>, Error> {
    let state = system.state(time, element, &velocity)?;
    let recorded = OnConstraints { system, columns, visible, buffers: RefCell::default() };
    Ok(Run::boxed(recorded, state, Drive::fixed(GeneralisedAlpha::default(), step)))
}

struct OnConstraints<G: ConfigurationGroup> {
    system: ConstrainedSystem<G>,
    columns: (Scope, Vec<Formula>),
    visible: usize,
    buffers: RefCell<Buffers>,
}

impl<G: ConfigurationGroup> Recorded for OnConstraints<G> {
    type System = ConstrainedSystem<G>;

    fn system(&self) -> &Self::System {
        &self.system
    }

    fn set_time(state: &mut ConstrainedState<G>, time: f64) {
        state.time = time;
    }

    fn fits(&self, state: &ConstrainedState<G>, now: &ConstrainedState<G>) -> bool {
        let vectors = [Some(&state.velocity), Some(&state.acceleration), state.lead.as_ref()];
        let n = self.system.group().dimension();
        vectors.into_iter().flatten().all(|vector| vector.components().len() == n)
            && self.system.group().has_shape(&state.element)
            && state.multipliers.len() == now.multipliers.len()
    }

    fn width(&self) -> usize {
        self.columns.1.len() + self.system.constraint().formulas.len() + 1
    }

    fn values(&self, state: &ConstrainedState<G>, columns: Range<usize>, list: &mut Vec<f64>) {
        let forces = self.system.force();
        let point = Point::new(state.time, &state.element, &state.velocity);
        let load = |quantity| match quantity {
            Quantity::Potential => forces.potential(&point),
            _ => forces.power(&point),
        };
        let between = self.visible..self.visible + state.multipliers.len() + 1;
        let buffers = &mut *self.buffers.borrow_mut();
        // a column of the formulas on either side of those between, by its number among the formulas
        let mut formulas = |columns: Range<usize>, list: &mut Vec<f64>| {
            let at = (&point, &load as &dyn Fn(Quantity) -> f64);
            forces.observables().formulas(&self.columns, columns, at, buffers, list);
        };
        formulas(columns.start.min(between.start)..columns.end.min(between.start), list);
        for column in columns.start.max(between.start)..columns.end.min(between.end) {
            let multiplier = state.multipliers.get(column - between.start);
            list.push(multiplier.copied().unwrap_or_else(|| self.system.violation(state)));
        }
        let [start, end] =
            [columns.start, columns.end].map(|at| at.max(between.end) - between.len());
        formulas(start..end, list);
    }

    fn trouble(&self) -> Option<String> {
        self.system.force().observables().trouble()
    }
}

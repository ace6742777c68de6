//! Motions of systems with holonomic constraints.

use super::SimulationGroup;
use super::drive::Drive;
use super::observables::{Buffers, Point};
use super::quantities::{Names, Quantity, Scope};
use super::run::{Recorded, Run};
use super::{Forces, Motion};
use crate::Error;
use crate::group::{Coordinates, Generator, Partial};
use crate::mechanics::formula::{Formula, Gradient};
use crate::mechanics::systems::constrained::ConstrainedState;
use crate::mechanics::{Constrained, Constraint, GeneralisedAlpha};
use affinor_tensors::expression::ExpressionError;
use nalgebra::{DMatrix, DVector};
use std::cell::RefCell;
use std::ops::Range;

/// Holonomic constraints `Phi(g) = 0`: formulas of the entries of the element and the parameters.
#[derive(Clone, Debug)]
pub struct Equations<G: SimulationGroup> {
    group: G,
    scope: Scope,
    /// Each formula, and the same with its derivatives.
    formulas: Vec<(Formula, Gradient)>,
    rows: usize,
    generators: Vec<Generator>,
    /// Also derivatives of a formula by the entries.
    buffers: RefCell<(Buffers, Vec<Partial>)>,
}

impl<G: SimulationGroup> Equations<G> {
    /// No constraints yet.
    pub fn new(group: G) -> Self {
        let (rows, generators) = (group.write(&group.identity()).nrows(), Generator::of(&group));
        let (scope, formulas, buffers) = (Scope::default(), vec![], RefCell::default());
        Equations { group, scope, formulas, rows, generators, buffers }
    }

    /// The same constraints on a group of the same shape.
    pub(super) fn on<H: SimulationGroup>(self, group: &H) -> Equations<H> {
        let Equations { scope, formulas, rows, generators, buffers, .. } = self;
        Equations { group: group.clone(), scope, formulas, rows, generators, buffers }
    }

    /// Adds a constraint: a formula that must vanish.
    ///
    /// # Errors
    /// As [`Formula::parse`]; also for quantities other than entries of the element and parameters.
    pub fn add(&mut self, text: &str, names: &Names) -> Result<(), ExpressionError> {
        let allowed = |quantity| matches!(quantity, Quantity::Parameter(_) | Quantity::Entry(..));
        let formula = self.scope.read(text, names, &allowed)?;
        self.formulas.push((formula.clone(), formula.differentiated()));
        Ok(())
    }

    /// Evaluates the quantities at an element.
    fn evaluate(&self, element: &G::Element, buffers: &mut Buffers) {
        let Buffers { values, entries, .. } = buffers;
        self.group.entries(element, entries);
        let value = |quantity| match quantity {
            Quantity::Entry(row, column) => entries[row + column * self.rows],
            _ => f64::NAN,
        };
        self.scope.evaluate(value, values);
    }
}

impl<G: SimulationGroup> Constraint<G> for Equations<G> {
    fn value(&self, element: &G::Element) -> DVector<f64> {
        let (buffers, ..) = &mut *self.buffers.borrow_mut();
        self.evaluate(element, buffers);
        let Buffers { values, workspace, .. } = buffers;
        DVector::from_fn(self.formulas.len(), |a, _| self.formulas[a].0.value_in(values, workspace))
    }

    fn gradient(&self, element: &G::Element) -> DMatrix<f64> {
        let (buffers, partial) = &mut *self.buffers.borrow_mut();
        self.evaluate(element, buffers);
        let Buffers { values, entries, workspace } = buffers;
        let mut gradient = DMatrix::zeros(self.formulas.len(), self.group.dimension());
        for (a, (_, formula)) in self.formulas.iter().enumerate() {
            let (_, slopes) = formula.evaluate(values, workspace);
            self.scope.by_entries(slopes, partial);
            let row = self.group.derivatives(element, entries, &self.generators, partial);
            gradient.row_mut(a).copy_from_slice(row.components());
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
pub fn on_constraints<G: SimulationGroup>(
    system: ConstrainedSystem<G>,
    (time, element, velocity): (f64, G::Element, G::Vector),
    step: f64,
    columns: (Scope, Vec<Formula>),
    visible: usize,
) -> Result<Box<dyn Motion>, Error> {
    let state = system.state(time, element, &velocity).map_err(|error| {
        let trouble = system.force().observables().trouble();
        trouble.map_or(error, |reason| Error::Invalid { what: "state", reason })
    })?;
    let (count, buffers) = (state.multipliers.len() + 1, RefCell::default());
    let (width, behind) = (columns.1.len() + count, visible + count);
    let values = move |system: &ConstrainedSystem<G>,
                       state: &ConstrainedState<G>,
                       range: Range<usize>,
                       list: &mut Vec<f64>| {
        let forces = system.force();
        let point = Point::new(state.time, &state.element, &state.velocity);
        let load = |quantity| match quantity {
            Quantity::Potential => forces.potential(&point),
            _ => forces.power(&point),
        };
        let buffers = &mut *buffers.borrow_mut();
        // the columns of formulas on one side, by their numbers among the formulas
        let mut formulas = |range: Range<usize>, list: &mut Vec<f64>| {
            let at = (&point, &load as &dyn Fn(Quantity) -> f64);
            forces.observables().formulas(&columns, range, at, buffers, list);
        };
        formulas(range.start.min(visible)..range.end.min(visible), list);
        for column in range.start.max(visible)..range.end.min(behind) {
            let multiplier = state.multipliers.get(column - visible);
            list.push(multiplier.copied().unwrap_or_else(|| system.violation(state)));
        }
        let [start, end] = [range.start, range.end].map(|at| at.max(behind) - count);
        formulas(start..end, list);
    };
    let fits =
        |system: &ConstrainedSystem<G>, state: &ConstrainedState<G>, now: &ConstrainedState<G>| {
            let vectors = [Some(&state.velocity), Some(&state.acceleration), state.lead.as_ref()];
            let n = system.group().dimension();
            vectors.into_iter().flatten().all(|vector| vector.components().len() == n)
                && system.group().has_shape(&state.element)
                && state.multipliers.len() == now.multipliers.len()
        };
    let mut recorded = Recorded::new(system, |state| &mut state.time, fits, width, values);
    recorded.trouble = |system| system.force().observables().trouble();
    Ok(Run::boxed(recorded, state, Drive::fixed(GeneralisedAlpha::default(), step)))
}

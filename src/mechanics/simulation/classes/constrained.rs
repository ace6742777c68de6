//! Euler-Poincare equations with holonomic constraints.

use crate::group::{AnyGroup, Coordinates, Generator, Partial};
use crate::mechanics::formula::{Formula, Gradient};
use crate::mechanics::simulation::forces::{Forces, ForcesOn};
use crate::mechanics::simulation::group::{GroupVisitor, SimulationGroup, element, vector, visit};
use crate::mechanics::simulation::methods::Method;
use crate::mechanics::simulation::motion::{Motion, ObservedMotion, simulation};
use crate::mechanics::simulation::observables::{Buffers, ColumnFormulas, ObservationPoint};
use crate::mechanics::simulation::quantities::{FormulaScope, MotionQuantity, SymbolTable};
use crate::mechanics::{Constrained, ConstrainedState, Constraint};
use crate::{Connection, Error, Metric};
use affinor_tensors::expression::ExpressionError;
use nalgebra::{DMatrix, DVector};
use std::cell::RefCell;
use std::ops::Range;

/// Holonomic constraints `Phi(g) = 0`, given as formulas of the entries of the element and the
/// parameters.
#[derive(Clone, Debug, Default)]
pub struct Constraints {
    scope: FormulaScope,
    /// For each constraint, the formula, and the formula with its derivatives.
    formulas: Vec<(Formula, Gradient)>,
}

impl Constraints {
    /// Adds a constraint. The formula must vanish.
    ///
    /// # Errors
    /// The errors of [`Formula::parse`]; also an error if the formula contains quantities other
    /// than entries of the element and parameters.
    pub fn add(&mut self, text: &str, names: &SymbolTable) -> Result<(), ExpressionError> {
        let allowed =
            |quantity| matches!(quantity, MotionQuantity::Parameter(_) | MotionQuantity::Entry(..));
        let formula = self.scope.read(text, names, &allowed)?;
        self.push(formula);
        Ok(())
    }

    /// Adds a constraint that is a polynomial in entries of the element: terms with a coefficient and
    /// their factors.
    pub fn add_polynomial(&mut self, terms: &[(f64, Vec<MotionQuantity>)]) {
        let formula = self.scope.polynomial(terms);
        self.push(formula);
    }

    fn push(&mut self, formula: Formula) {
        let gradient = formula.differentiated();
        self.formulas.push((formula, gradient));
    }
}

/// [`Constraints`] on a group.
#[derive(Debug)]
struct ConstraintsOn<G> {
    group: G,
    constraints: Constraints,
    rows: usize,
    generators: Vec<Generator>,
    /// Buffers for values, and for derivatives of a formula with respect to the entries.
    buffers: RefCell<(Buffers, Vec<Partial>)>,
}

impl<G: SimulationGroup> ConstraintsOn<G> {
    fn new(group: &G, constraints: Constraints) -> Self {
        let (rows, generators) = (group.write(&group.identity()).nrows(), Generator::of(group));
        let buffers = RefCell::default();
        ConstraintsOn { group: group.clone(), constraints, rows, generators, buffers }
    }

    /// Evaluates the quantities of the formulas at an element.
    fn evaluate(&self, element: &G::Element, buffers: &mut Buffers) {
        let Buffers { values, entries, .. } = buffers;
        self.group.entries(element, entries);
        let value = |quantity| match quantity {
            MotionQuantity::Entry(row, column) => entries[row + column * self.rows],
            _ => f64::NAN,
        };
        self.constraints.scope.evaluate(value, values);
    }

    /// The value and the gradient of the constraint `a`, once the quantities are evaluated.
    fn row(
        &self,
        element: &G::Element,
        a: usize,
        buffers: &mut Buffers,
        partial: &mut Vec<Partial>,
    ) -> (f64, G::Vector) {
        let Buffers { values, entries, workspace } = buffers;
        let Constraints { scope, formulas } = &self.constraints;
        let (value, slopes) = formulas[a].1.evaluate(values, workspace);
        scope.by_entries(slopes, partial);
        (value, self.group.derivatives(element, entries, &self.generators, partial))
    }
}

impl<G: SimulationGroup> Constraint<G> for ConstraintsOn<G> {
    fn value(&self, element: &G::Element) -> DVector<f64> {
        let (buffers, ..) = &mut *self.buffers.borrow_mut();
        self.evaluate(element, buffers);
        let Buffers { values, workspace, .. } = buffers;
        let formulas = &self.constraints.formulas;
        DVector::from_fn(formulas.len(), |a, _| formulas[a].0.value_in(values, workspace))
    }

    fn gradient(&self, element: &G::Element) -> DMatrix<f64> {
        let (buffers, partial) = &mut *self.buffers.borrow_mut();
        self.evaluate(element, buffers);
        let count = self.constraints.formulas.len();
        let mut gradient = DMatrix::zeros(count, self.group.dimension());
        for a in 0..count {
            let (_, row) = self.row(element, a, buffers, partial);
            gradient.row_mut(a).copy_from_slice(row.components());
        }
        gradient
    }

    fn single(&self, element: &G::Element, a: usize) -> (f64, DVector<f64>) {
        let (buffers, partial) = &mut *self.buffers.borrow_mut();
        self.evaluate(element, buffers);
        let (value, row) = self.row(element, a, buffers, partial);
        (value, DVector::from_column_slice(row.components()))
    }
}

/// The specification of a motion with constraints. The group is a separate argument.
pub struct ConstrainedSpec<'s> {
    /// The connection `Lambda` in `DH/Dt = M`.
    pub connection: &'s Connection<f64>,
    /// The metric `J`.
    pub metric: &'s Metric<f64>,
    /// The forces.
    pub forces: Forces,
    /// The constraints.
    pub constraints: Constraints,
    /// The initial time.
    pub time: f64,
    /// The embedding coordinates of the initial element.
    pub element: DVector<f64>,
    /// The initial velocity, in the frame of the equations.
    pub velocity: DVector<f64>,
    /// The method, which must belong to [`Class::Constrained`](super::super::Class).
    pub method: Method,
    /// The largest step size.
    pub step: f64,
    /// The formulas of the columns. A row contains the first `visible` formulas, the Lagrange
    /// multipliers, the largest violation of a constraint, and the other formulas.
    pub columns: ColumnFormulas,
    /// The number of formulas before the multipliers.
    pub visible: usize,
}

impl ConstrainedSpec<'_> {
    /// Starts the motion on a group.
    ///
    /// # Errors
    /// The errors of [`Constrained::new`] and [`Constrained::state`]; [`Error::Unsupported`] if the
    /// method belongs to another class.
    pub fn start(self, group: &AnyGroup) -> Result<Box<dyn Motion>, Error> {
        visit(group, self)
    }
}

impl GroupVisitor for ConstrainedSpec<'_> {
    type Output = Result<Box<dyn Motion>, Error>;

    fn visit<G: SimulationGroup>(self, group: &G) -> Self::Output {
        let (forces, constraints) =
            (ForcesOn::new(group, self.forces), ConstraintsOn::new(group, self.constraints));
        let system =
            Constrained::new(group.clone(), self.connection, self.metric, forces, constraints)?;
        let (element, velocity) = (element(group, &self.element), vector(&self.velocity));
        let state = system.state(self.time, element, &velocity).map_err(|error| {
            let trouble = system.force().forces.observables().take_trouble();
            trouble.map_or(error, |reason| Error::Invalid { what: "state", reason })
        })?;
        let stepper = self.method.constrained(self.step);
        let stepper = stepper.ok_or_else(|| self.method.refused("it is not for constraints"))?;
        let moving = Moving {
            system,
            columns: self.columns,
            visible: self.visible,
            count: state.multipliers.len() + 1,
            buffers: RefCell::default(),
        };
        Ok(simulation(moving, state, stepper))
    }
}

/// The motion, with the values of its columns.
struct Moving<G: SimulationGroup> {
    system: Constrained<G, ConstraintsOn<G>, ForcesOn<G>>,
    columns: ColumnFormulas,
    visible: usize,
    /// The number of columns of the multipliers and the violation.
    count: usize,
    buffers: RefCell<Buffers>,
}

impl<G: SimulationGroup> ObservedMotion for Moving<G> {
    type System = Constrained<G, ConstraintsOn<G>, ForcesOn<G>>;

    fn system(&self) -> &Self::System {
        &self.system
    }

    fn set_time(&self, state: &mut ConstrainedState<G>, time: f64) {
        state.time = time;
    }

    fn column_count(&self) -> usize {
        self.columns.formulas.len() + self.count
    }

    fn values(&self, state: &ConstrainedState<G>, range: Range<usize>, list: &mut Vec<f64>) {
        let (forces, group) = (self.system.force(), self.system.group());
        let point = ObservationPoint::new(state.time, &state.element, &state.velocity);
        let load = |quantity| match quantity {
            MotionQuantity::Potential => forces.potential(&point),
            _ => forces.power(&point),
        };
        let (visible, behind) = (self.visible, self.visible + self.count);
        let buffers = &mut *self.buffers.borrow_mut();
        // appends the values of the formulas whose indices are in a range
        let mut formulas = |range: Range<usize>, list: &mut Vec<f64>| {
            let observables = forces.forces.observables();
            self.columns.values(range, group, observables, &point, &load, buffers, list);
        };
        formulas(range.start.min(visible)..range.end.min(visible), list);
        for column in range.start.max(visible)..range.end.min(behind) {
            let multiplier = state.multipliers.get(column - visible);
            list.push(multiplier.copied().unwrap_or_else(|| self.system.violation(state)));
        }
        let [start, end] = [range.start, range.end].map(|at| at.max(behind) - self.count);
        formulas(start..end, list);
    }

    fn take_trouble(&self) -> Option<String> {
        self.system.force().forces.observables().take_trouble()
    }
}

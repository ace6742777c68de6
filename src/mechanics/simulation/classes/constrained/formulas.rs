//! Constraints that are given by formulas.

use crate::group::{Coordinates, Generator, Partial};
use crate::mechanics::Constraint;
use crate::mechanics::formula::{Formula, Gradient, affine_terms};
use crate::mechanics::simulation::group::SimulationGroup;
use crate::mechanics::simulation::observables::Buffers;
use crate::mechanics::simulation::quantities::{FormulaScope, MotionQuantity, SymbolTable};
use affinor_tensors::expression::ExpressionError;
use nalgebra::{DMatrix, DVector};
use std::cell::RefCell;

/// Constraints that are given by formulas: holonomic constraints `Phi(t, g) = 0`, and constraints
/// that are affine in the velocity.
#[derive(Clone, Debug, Default)]
pub struct Constraints {
    scope: FormulaScope,
    /// For each holonomic constraint, the formula, and the formula with its derivatives.
    holonomic: Vec<(Formula, Gradient)>,
    /// For each constraint on the velocity, the formula with its derivatives.
    affine: Vec<Gradient>,
    /// Whether a constraint on the velocity has terms without the velocity.
    has_constant: bool,
}

/// Whether a quantity is a component of the velocity in one of the two invariant frames.
fn is_velocity(quantity: MotionQuantity) -> bool {
    matches!(quantity, MotionQuantity::Velocity(_) | MotionQuantity::OtherVelocity(_))
}

/// Whether a holonomic constraint may depend on a quantity.
fn is_position(quantity: MotionQuantity) -> bool {
    use MotionQuantity::{Entry, Parameter, Time};
    matches!(quantity, Time | Parameter(_) | Entry(..))
}

impl Constraints {
    /// Adds a holonomic constraint. The formula must vanish.
    ///
    /// # Errors
    /// The errors of [`Formula::parse`]; also an error if the formula contains quantities other
    /// than the time, entries of the element and parameters.
    pub fn add(&mut self, text: &str, names: &SymbolTable) -> Result<(), ExpressionError> {
        let formula = self.scope.read(text, names, &is_position)?;
        self.push(formula);
        Ok(())
    }

    /// Adds a holonomic constraint that is a polynomial in entries of the element: terms with a
    /// coefficient and their factors.
    pub fn add_polynomial(&mut self, terms: &[(f64, Vec<MotionQuantity>)]) {
        let formula = self.scope.polynomial(terms);
        self.push(formula);
    }

    /// Adds a constraint on the velocity. The formula must vanish. It is affine in the components
    /// of the velocity in both invariant frames.
    ///
    /// # Errors
    /// The errors of [`Formula::parse`]; also an error if the formula is not affine in the velocity,
    /// or does not contain the velocity. Other quantities than components of the velocity, the time,
    /// entries of the element and parameters are errors too.
    pub fn add_affine(&mut self, text: &str, names: &SymbolTable) -> Result<(), ExpressionError> {
        let allowed = |quantity| is_position(quantity) || is_velocity(quantity);
        let formula = self.scope.read(text, names, &allowed)?;
        let terms = affine_terms(text, &|name| names.find(name).is_some_and(is_velocity))?;
        if !terms.linear {
            let reason = "the constraint does not contain the velocity".into();
            return Err(ExpressionError { span: 0..text.len(), reason });
        }
        self.has_constant |= terms.constant;
        self.affine.push(formula.differentiated());
        Ok(())
    }

    /// The number of constraints.
    pub fn count(&self) -> usize {
        self.holonomic.len() + self.affine.len()
    }

    /// Whether a holonomic constraint depends on the time.
    pub fn depend_on_time(&self) -> bool {
        let quantities = self.scope.quantities();
        let mut used = self.holonomic.iter().flat_map(|(formula, _)| formula.variables());
        used.any(|k| quantities[*k] == MotionQuantity::Time)
    }

    /// Whether the forces of the constraints do no work: no holonomic constraint depends on the
    /// time, and all constraints on the velocity are homogeneous.
    pub fn are_workless(&self) -> bool {
        !self.depend_on_time() && !self.has_constant
    }

    fn push(&mut self, formula: Formula) {
        let gradient = formula.differentiated();
        self.holonomic.push((formula, gradient));
    }
}

/// [`Constraints`] on a group.
#[derive(Debug)]
pub(in crate::mechanics::simulation) struct ConstraintsOn<G> {
    group: G,
    constraints: Constraints,
    is_timed: bool,
    rows: usize,
    generators: Vec<Generator>,
    /// Buffers for values, for derivatives of a formula with respect to the entries, and for rates
    /// of change of the values.
    buffers: RefCell<(Buffers, Vec<Partial>, Vec<f64>)>,
}

impl<G: SimulationGroup> ConstraintsOn<G> {
    pub(in crate::mechanics::simulation) fn new(group: &G, constraints: Constraints) -> Self {
        let (rows, generators) = (group.write(&group.identity()).nrows(), Generator::of(group));
        let (buffers, is_timed) = (RefCell::default(), constraints.depend_on_time());
        ConstraintsOn { group: group.clone(), constraints, is_timed, rows, generators, buffers }
    }

    /// Evaluates the quantities of the formulas at a time, an element and a velocity.
    fn evaluate(
        &self,
        time: f64,
        element: &G::Element,
        velocity: Option<&G::Vector>,
        buffers: &mut Buffers,
    ) {
        let Buffers { values, entries, .. } = buffers;
        self.group.entries(element, entries);
        let mut other = None;
        let value = |quantity| match (quantity, velocity) {
            (MotionQuantity::Time, _) => time,
            (MotionQuantity::Entry(row, column), _) => entries[row + column * self.rows],
            (MotionQuantity::Velocity(i), Some(velocity)) => velocity.components()[i],
            (MotionQuantity::OtherVelocity(i), Some(velocity)) => {
                let other = other.get_or_insert_with(|| self.group.adjoint(element, velocity));
                other.components()[i]
            }
            (MotionQuantity::Velocity(_) | MotionQuantity::OtherVelocity(_), None) => 0.0,
            _ => f64::NAN,
        };
        self.constraints.scope.evaluate(value, values);
    }

    /// The derivatives along the invariant fields of a function of the element, given by its
    /// derivatives with respect to the entries.
    fn derivatives(
        &self,
        element: &G::Element,
        entries: &[f64],
        partial: &[Partial],
    ) -> DVector<f64> {
        let row = self.group.derivatives(element, entries, &self.generators, partial);
        DVector::from_column_slice(row.components())
    }

    /// The value and the gradient of the holonomic constraint `a`, once the quantities are
    /// evaluated.
    fn row(
        &self,
        element: &G::Element,
        a: usize,
        buffers: &mut Buffers,
        partial: &mut Vec<Partial>,
    ) -> (f64, DVector<f64>) {
        let Buffers { values, entries, workspace } = buffers;
        let Constraints { scope, holonomic, .. } = &self.constraints;
        let (value, slopes) = holonomic[a].1.evaluate(values, workspace);
        scope.by_entries(slopes, partial);
        (value, self.derivatives(element, entries, partial))
    }

    /// The derivative of a formula with respect to time, once the quantities are evaluated.
    fn by_time(&self, gradient: &Gradient, buffers: &mut Buffers) -> f64 {
        let quantities = self.constraints.scope.quantities();
        let (_, slopes) = gradient.evaluate(&buffers.values, &mut buffers.workspace);
        let times = slopes.filter(|(k, _)| quantities[*k] == MotionQuantity::Time);
        times.map(|(_, slope)| slope).sum()
    }
}

impl<G> ConstraintsOn<G> {
    /// The number of constraints.
    pub(in crate::mechanics::simulation) fn count(&self) -> usize {
        self.constraints.count()
    }
}

impl<G: SimulationGroup> Constraint<G> for ConstraintsOn<G> {
    fn value(&self, time: f64, element: &G::Element) -> DVector<f64> {
        let (buffers, ..) = &mut *self.buffers.borrow_mut();
        self.evaluate(time, element, None, buffers);
        let Buffers { values, workspace, .. } = buffers;
        let formulas = &self.constraints.holonomic;
        DVector::from_fn(formulas.len(), |a, _| formulas[a].0.value_in(values, workspace))
    }

    fn gradient(&self, time: f64, element: &G::Element) -> DMatrix<f64> {
        let (buffers, partial, _) = &mut *self.buffers.borrow_mut();
        self.evaluate(time, element, None, buffers);
        let count = self.constraints.holonomic.len();
        let mut gradient = DMatrix::zeros(count, self.group.dimension());
        for a in 0..count {
            let (_, row) = self.row(element, a, buffers, partial);
            gradient.row_mut(a).copy_from(&row.transpose());
        }
        gradient
    }

    fn single(&self, time: f64, element: &G::Element, a: usize) -> (f64, DVector<f64>) {
        let (buffers, partial, _) = &mut *self.buffers.borrow_mut();
        self.evaluate(time, element, None, buffers);
        self.row(element, a, buffers, partial)
    }

    fn rate(&self, time: f64, element: &G::Element) -> Option<DVector<f64>> {
        if !self.is_timed {
            return None;
        }
        let (buffers, ..) = &mut *self.buffers.borrow_mut();
        self.evaluate(time, element, None, buffers);
        let formulas = &self.constraints.holonomic;
        Some(DVector::from_fn(formulas.len(), |a, _| self.by_time(&formulas[a].1, buffers)))
    }

    /// Computed by the chain rule: the derivatives of the formula change, and the entries of the
    /// element have second derivatives.
    fn second_rate(
        &self,
        time: f64,
        element: &G::Element,
        velocity: &G::Vector,
    ) -> Option<DVector<f64>> {
        let (buffers, partial, rates) = &mut *self.buffers.borrow_mut();
        self.evaluate(time, element, None, buffers);
        let Buffers { values, entries, workspace } = buffers;
        let Constraints { scope, holonomic, .. } = &self.constraints;
        let v = DVector::from_column_slice(velocity.components());
        let along = |partial: &[Partial]| self.derivatives(element, entries, partial).dot(&v);
        let rate = |quantity| match quantity {
            MotionQuantity::Time => 1.0,
            MotionQuantity::Entry(row, column) => along(&[(row, column, 1.0)]),
            _ => 0.0,
        };
        scope.evaluate(rate, rates);
        let mut changes: Vec<Partial> = vec![];
        let mut second = |gradient: &Gradient| {
            let (mut sum, slopes) = (0.0, gradient.along(values, rates, workspace));
            partial.clear();
            changes.clear();
            for (k, slope, change) in slopes {
                match scope.quantities()[k] {
                    MotionQuantity::Time => sum += change,
                    MotionQuantity::Entry(row, column) => {
                        // omits zero derivatives, because 0 times an infinite entry is NaN
                        partial.extend((slope != 0.0).then_some((row, column, slope)));
                        changes.extend((change != 0.0).then_some((row, column, change)));
                    }
                    _ => {}
                }
            }
            let (group, generators) = (&self.group, &self.generators);
            let bent = group.second_derivative(element, entries, generators, partial, velocity);
            sum + along(&changes) + bent
        };
        Some(DVector::from_fn(holonomic.len(), |a, _| second(&holonomic[a].1)))
    }

    fn affine(&self, time: f64, element: &G::Element) -> Option<(DMatrix<f64>, DVector<f64>)> {
        let Constraints { scope, affine, .. } = &self.constraints;
        if affine.is_empty() {
            return None;
        }
        let (buffers, ..) = &mut *self.buffers.borrow_mut();
        self.evaluate(time, element, None, buffers);
        let n = self.group.dimension();
        let (mut matrix, mut right) =
            (DMatrix::zeros(affine.len(), n), DVector::zeros(affine.len()));
        for (a, gradient) in affine.iter().enumerate() {
            let (value, slopes) = gradient.evaluate(&buffers.values, &mut buffers.workspace);
            // the derivatives with respect to the components in the other invariant frame
            let mut other = DVector::zeros(n);
            for (k, slope) in slopes {
                match scope.quantities()[k] {
                    MotionQuantity::Velocity(i) => matrix[(a, i)] += slope,
                    MotionQuantity::OtherVelocity(i) => other[i] += slope,
                    _ => {}
                }
            }
            if other.iter().any(|slope| *slope != 0.0) {
                let other = G::Vector::from_components(other.as_slice());
                let own = self.group.coadjoint(element, &other);
                own.components().iter().enumerate().for_each(|(i, slope)| matrix[(a, i)] += slope);
            }
            // subtracts, because the negative of 0 is written as -0
            right[a] = 0.0 - value;
        }
        Some((matrix, right))
    }

    /// The components of a constant velocity in the other invariant frame are constant too, because
    /// `exp(s v)` commutes with `v`. So only the explicit dependence on the time and the entries
    /// contributes.
    fn affine_rate(&self, time: f64, element: &G::Element, velocity: &G::Vector) -> DVector<f64> {
        let (buffers, partial, _) = &mut *self.buffers.borrow_mut();
        self.evaluate(time, element, Some(velocity), buffers);
        let Constraints { scope, affine, .. } = &self.constraints;
        let v = DVector::from_column_slice(velocity.components());
        DVector::from_fn(affine.len(), |a, _| {
            let by_time = self.by_time(&affine[a], buffers);
            let Buffers { values, entries, workspace } = buffers;
            let (_, slopes) = affine[a].evaluate(values, workspace);
            scope.by_entries(slopes, partial);
            by_time + self.derivatives(element, entries, partial).dot(&v)
        })
    }

    fn invariant(&self) -> Option<DMatrix<f64>> {
        let Constraints { scope, holonomic, has_constant, .. } = &self.constraints;
        let is_own = |quantity: &MotionQuantity| matches!(quantity, MotionQuantity::Velocity(_));
        if !holonomic.is_empty() || *has_constant || !scope.quantities().iter().all(is_own) {
            return None;
        }
        self.affine(0.0, &self.group.identity()).map(|(matrix, _)| matrix)
    }
}

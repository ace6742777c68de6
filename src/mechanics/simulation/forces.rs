//! Forces on motions: formulas of components, potentials as formulas, tables over time, and
//! functions of the calling program.

use super::group::SimulationGroup;
use super::observables::{Buffers, Observables, ObservationPoint};
use super::quantities::{FormulaScope, MotionQuantity, SymbolTable};
use super::table::{ForceTable, Interval};
use crate::group::{Coordinates, Generator, Partial};
use crate::mechanics::formula::{Formula, Gradient};
use crate::mechanics::systems::euler_poincare::Torque;
use affinor_tensors::expression::ExpressionError;
use nalgebra::DMatrix;
use std::cell::{Cell, RefCell};
use std::fmt;
use std::sync::Arc;

/// One of the two invariant frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceFrame {
    /// The left-invariant frame, with body components.
    Body,
    /// The right-invariant frame, with spatial components.
    Spatial,
}

/// A covector as a function of time, of the [written](crate::group::MatrixNotation::write) element
/// and of the body velocity. For right-invariant equations, the velocity is the spatial velocity.
/// Missing components of the result count as NaN.
#[derive(Clone)]
pub struct ForceFunction(Arc<Covector>);

type Covector = dyn Fn(f64, &DMatrix<f64>, &[f64]) -> Vec<f64> + Send + Sync;

impl ForceFunction {
    /// A force with the components `M_i = function(t, element, velocity)_i`.
    pub fn new(
        function: impl Fn(f64, &DMatrix<f64>, &[f64]) -> Vec<f64> + Send + Sync + 'static,
    ) -> Self {
        ForceFunction(Arc::new(function))
    }
}

impl fmt::Debug for ForceFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a function")
    }
}

/// The forces on a system: formulas for components of covectors, a potential, and a table over
/// time.
///
/// The potential `V` contributes `M_i = -e_i(V)`, the derivative along the invariant field `e_i`.
#[derive(Debug)]
pub struct Forces {
    observables: Observables,
    scope: FormulaScope,
    /// The formulas of components. Each has its frame, its index and its text.
    terms: Vec<(ForceFrame, usize, Formula, String)>,
    /// The potential: its formula, the formula with derivatives, and its text.
    potential: Option<(Formula, Gradient, String)>,
    table: Option<(ForceFrame, ForceTable)>,
    functions: Vec<(ForceFrame, ForceFunction)>,
    /// The interval of the table in which the current step has begun.
    interval: Cell<Option<Interval>>,
    buffers: RefCell<(Buffers, Sums)>,
}

/// Buffers for sums of forces and derivatives of a potential.
#[derive(Debug, Default)]
struct Sums {
    /// The components of the force in the frame of the equations, followed by the components in the
    /// other frame.
    sums: Vec<f64>,
    /// The derivatives of the potential with respect to the entries.
    partial: Vec<Partial>,
}

impl Forces {
    /// An empty collection of forces for a system with the inertia `inertia`.
    pub fn none<G: SimulationGroup>(
        group: &G,
        inertia: DMatrix<f64>,
        parameters: Vec<(String, f64)>,
    ) -> Self {
        Forces {
            observables: Observables::new(group, Some(inertia), parameters),
            scope: FormulaScope::default(),
            terms: vec![],
            potential: None,
            table: None,
            functions: vec![],
            interval: Cell::default(),
            buffers: RefCell::default(),
        }
    }

    /// The quantities that formulas may use.
    pub fn observables(&self) -> &Observables {
        &self.observables
    }

    /// The names that formulas may use.
    pub fn names(&self) -> &SymbolTable {
        self.observables.names()
    }

    /// Whether forces may depend on a quantity. All quantities are allowed, except energies and the
    /// power.
    pub fn may_depend_on(quantity: MotionQuantity) -> bool {
        use MotionQuantity::{Energy, Kinetic, Potential, Power};
        !matches!(quantity, Kinetic | Potential | Energy | Power)
    }

    /// Adds the formula of the component `i` (from 0) of a covector.
    ///
    /// # Errors
    /// The errors of [`Formula::parse`]; also an error if the formula contains quantities on which
    /// no force [may depend](Self::may_depend_on).
    pub fn add(&mut self, side: ForceFrame, i: usize, text: &str) -> Result<(), ExpressionError> {
        let formula = self.scope.read(text, self.observables.names(), &Self::may_depend_on)?;
        self.terms.push((side, i, formula, text.trim().into()));
        Ok(())
    }

    /// Sets the potential, a function of time and of the entries of the element.
    ///
    /// # Errors
    /// The errors of [`Formula::parse`]; also an error if the formula contains other quantities of
    /// the motion.
    pub fn set_potential(&mut self, text: &str) -> Result<(), ExpressionError> {
        let allowed = |q| {
            matches!(
                q,
                MotionQuantity::Time | MotionQuantity::Parameter(_) | MotionQuantity::Entry(..)
            )
        };
        let formula = self.scope.read(text, self.observables.names(), &allowed)?;
        let gradient = formula.differentiated();
        self.potential = Some((formula, gradient, text.trim().into()));
        Ok(())
    }

    /// Sets a potential that is a polynomial in entries of the element: terms with a coefficient and
    /// their factors. Messages call the potential by the name.
    pub fn set_polynomial_potential(&mut self, terms: &[(f64, Vec<MotionQuantity>)], name: &str) {
        let formula = self.scope.polynomial(terms);
        let gradient = formula.differentiated();
        self.potential = Some((formula, gradient, name.into()));
    }

    /// Sets a table of the values of a covector over time.
    pub fn set_table(&mut self, side: ForceFrame, table: ForceTable) {
        self.table = Some((side, table));
    }

    /// Adds a covector that is given as a function.
    pub fn add_function(&mut self, side: ForceFrame, function: ForceFunction) {
        self.functions.push((side, function));
    }

    /// Begins a step from the time `from` towards `until`. Returns the time at which a step of
    /// controlled size must end: the next kink of the table, or `until`. If the two times are
    /// equal, no step is in progress.
    pub(super) fn begin_step(&self, from: f64, until: f64) -> f64 {
        let table = self.table.as_ref().filter(|_| from != until);
        self.interval.set(table.map(|(_, table)| table.interval(from, until)));
        let corner = self.table.as_ref().and_then(|(_, table)| table.corner(from, until));
        corner.unwrap_or(until)
    }

    /// Whether there are no forces.
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
            && self.potential.is_none()
            && self.table.is_none()
            && self.functions.is_empty()
    }

    /// Whether no force depends on the velocity.
    pub fn are_positional(&self) -> bool {
        use MotionQuantity::{Entry, Named, Time};
        let of_place = |q: &MotionQuantity| matches!(q, Time | Entry(..) | Named(_));
        self.functions.is_empty() && self.scope.quantities().iter().all(of_place)
    }

    /// Whether the only force is a potential that does not depend on time, so that the energy is
    /// conserved.
    pub fn are_conservative(&self) -> bool {
        let timeless = !self.scope.quantities().contains(&MotionQuantity::Time);
        self.terms.is_empty() && self.table.is_none() && self.functions.is_empty() && timeless
    }
}

/// [`Forces`] on a group.
#[derive(Debug)]
pub struct ForcesOn<G> {
    group: G,
    pub(super) forces: Forces,
    /// The generators of the group, for the derivatives of a potential.
    generators: Vec<Generator>,
}

impl<G: SimulationGroup> ForcesOn<G> {
    pub(super) fn new(group: &G, forces: Forces) -> Self {
        let generators = if forces.potential.is_some() { Generator::of(group) } else { vec![] };
        ForcesOn { group: group.clone(), forces, generators }
    }

    /// The potential `V` at a point.
    pub(super) fn potential(&self, at: &ObservationPoint<G>) -> f64 {
        let ForcesOn { group, forces, .. } = self;
        let Some((formula, ..)) = &forces.potential else { return 0.0 };
        let (buffers, _) = &mut *forces.buffers.borrow_mut();
        forces.observables.evaluate(group, &forces.scope, at, buffers);
        formula.value_in(&buffers.values, &mut buffers.workspace)
    }

    /// The power `M(Omega)` of all forces.
    pub(super) fn power(&self, at: &ObservationPoint<G>) -> f64 {
        let force = self.total(at);
        force.components().iter().zip(at.velocity.components()).map(|(m, omega)| m * omega).sum()
    }

    /// The sum of all forces, in the frame of the equations.
    fn total(&self, at: &ObservationPoint<G>) -> G::Vector {
        let ForcesOn { group, forces, generators } = self;
        let (buffers, Sums { sums, partial }) = &mut *forces.buffers.borrow_mut();
        let n = group.dimension();
        forces.observables.evaluate(group, &forces.scope, at, buffers);
        let Buffers { values, entries, workspace } = buffers;
        let mut total = G::Vector::zeros(n);
        if !(forces.terms.is_empty() && forces.table.is_none() && forces.functions.is_empty()) {
            sums.clear();
            sums.resize(2 * n, 0.0);
            let (mine, other) = sums.split_at_mut(n);
            let own = if group.is_right() { ForceFrame::Spatial } else { ForceFrame::Body };
            for (side, i, formula, text) in &forces.terms {
                let value = formula.value_in(values, workspace);
                if !value.is_finite() {
                    self.note(&format!("the force {text}"), value, at);
                }
                (if *side == own { &mut *mine } else { &mut *other })[*i] += value;
            }
            if let Some((side, table)) = &forces.table {
                table.add(at.time, forces.interval.get(), if *side == own { mine } else { other });
            }
            for (side, function) in &forces.functions {
                let found =
                    (function.0)(at.time, &group.write(at.element), at.velocity.components());
                let sums = if *side == own { &mut *mine } else { &mut *other };
                for (i, sum) in sums.iter_mut().enumerate() {
                    let value = found.get(i).copied().unwrap_or(f64::NAN);
                    if !value.is_finite() {
                        self.note(&format!("component {} of the force", i + 1), value, at);
                    }
                    *sum += value;
                }
            }
            total = G::Vector::from_components(mine);
            if other.iter().any(|component| *component != 0.0) {
                total = total + group.coadjoint(at.element, &G::Vector::from_components(other));
            }
        }
        if let Some((_, gradient, text)) = &forces.potential {
            let (value, slopes) = gradient.evaluate(values, workspace);
            if value.is_finite() {
                forces.scope.by_entries(slopes, partial);
                let slopes = group.derivatives(at.element, entries, generators, partial);
                if let Some(slope) = slopes.components().iter().find(|slope| !slope.is_finite()) {
                    self.note(&format!("the derivative of the potential {text}"), *slope, at);
                }
                total = total - slopes;
            } else {
                self.note(&format!("the potential {text}"), value, at);
                total = total * f64::NAN;
            }
        }
        total
    }

    /// Records that a force is not finite, with the point.
    #[cold]
    fn note(&self, what: &str, value: f64, at: &ObservationPoint<G>) {
        let list =
            |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
        let names = self.forces.names();
        // transposes the matrix, so that the entries are listed row by row
        let element = self.group.write(at.element).transpose();
        self.forces.observables.record(format!(
            "{what} is {value} at t = {}, {} = [{}], {} = [{}]",
            at.time,
            names.velocity(),
            list(at.velocity.components()),
            names.element_stem(),
            list(element.as_slice())
        ));
    }
}

impl<G: SimulationGroup> Torque<G> for ForcesOn<G> {
    fn is_absent(&self) -> bool {
        self.forces.is_empty()
    }

    fn add(&self, time: f64, element: &G::Element, velocity: &G::Vector, force: &mut G::Vector) {
        if !self.forces.is_empty() {
            *force = force.clone() + self.total(&ObservationPoint::new(time, element, velocity));
        }
    }
}

//! Values of quantities at points of a motion.

use super::group::SimulationGroup;
use super::quantities::{FormulaScope, MotionQuantity, SymbolTable};
use crate::group::Coordinates;
use crate::mechanics::formula::{Formula, Workspace};
use nalgebra::DMatrix;
use std::cell::RefCell;
use std::ops::Range;

/// A point of a motion. The velocity is in the frame of the equations.
pub struct ObservationPoint<'p, G: SimulationGroup> {
    /// The time.
    pub time: f64,
    /// The element.
    pub element: &'p G::Element,
    /// The velocity.
    pub velocity: &'p G::Vector,
    /// The momentum in the frame of the equations. If it is missing, `J Omega` is used.
    pub momentum: Option<&'p G::Vector>,
    /// The energy. It is missing if the energy is the sum of a kinetic and a potential energy.
    pub energy: Option<f64>,
}

impl<'p, G: SimulationGroup> ObservationPoint<'p, G> {
    /// A point of a system with an inertia.
    pub fn new(time: f64, element: &'p G::Element, velocity: &'p G::Vector) -> Self {
        ObservationPoint { time, element, velocity, momentum: None, energy: None }
    }
}

/// The quantities of motions on a group: their names, and all data on which their values depend in
/// addition to the point.
#[derive(Clone, Debug)]
pub struct Observables {
    names: SymbolTable,
    /// The number of rows of a written element. It is stored, because each stage of a step needs
    /// it.
    rows: usize,
    /// The inertia `J`, if the system has an inertia.
    inertia: Option<DMatrix<f64>>,
    /// The reason why the last force or velocity is not a number.
    trouble: RefCell<Option<String>>,
}

/// Buffers for the values of quantities and formulas.
#[derive(Clone, Debug, Default)]
pub(super) struct Buffers {
    /// The values of the quantities of a [`FormulaScope`].
    pub(super) values: Vec<f64>,
    /// The entries of the element, column by column.
    pub(super) entries: Vec<f64>,
    pub(super) workspace: Workspace,
}

impl Observables {
    /// The quantities on a group with named parameters. The matrix `inertia` is the `J` of
    /// `H = J Omega`.
    pub fn new<G: SimulationGroup>(
        group: &G,
        inertia: Option<DMatrix<f64>>,
        parameters: Vec<(String, f64)>,
    ) -> Self {
        let names = SymbolTable::new(group, parameters);
        let rows = names.rows();
        Observables { names, rows, inertia, trouble: RefCell::default() }
    }

    /// The names that formulas may use.
    pub fn names(&self) -> &SymbolTable {
        &self.names
    }

    /// The momentum `J Omega`. The components are NaN if there is no inertia.
    pub fn momentum<V: Coordinates>(&self, velocity: &V) -> V {
        let omega = velocity.components();
        let entry = |i, j| self.inertia.as_ref().map_or(f64::NAN, |inertia| inertia[(i, j)]);
        let row = |i: usize| (0..omega.len()).map(|j| entry(i, j) * omega[j]).sum();
        V::from_fn(omega.len(), row)
    }

    /// Records the reason why a force or a velocity is not a number.
    pub(super) fn record(&self, trouble: String) {
        self.trouble.replace(Some(trouble));
    }

    /// Removes and returns the last recorded reason.
    pub(super) fn take_trouble(&self) -> Option<String> {
        self.trouble.take()
    }

    /// Replaces the values in `buffers` by the values of the quantities of a scope. If an entry of
    /// the element is among these quantities, the entries are replaced too. The function `load`
    /// returns the potential and the power.
    pub(super) fn evaluate<G: SimulationGroup>(
        &self,
        group: &G,
        scope: &FormulaScope,
        at: &ObservationPoint<G>,
        buffers: &mut Buffers,
    ) {
        let mut values = Values::new(group, self, at, &|_| f64::NAN, &mut buffers.entries);
        scope.evaluate(|quantity| values.of(quantity), &mut buffers.values);
    }
}

/// The formulas of the columns of a motion, and the scope of these formulas.
#[derive(Clone, Debug, Default)]
pub struct ColumnFormulas {
    /// The quantities of the formulas.
    pub scope: FormulaScope,
    /// The formulas, one for each column.
    pub formulas: Vec<Formula>,
}

impl ColumnFormulas {
    /// Appends the values at a point of the columns in a range to `list`. The function `load`
    /// returns the potential and the power.
    #[allow(clippy::too_many_arguments, reason = "a point and its surroundings")]
    pub(super) fn values<G: SimulationGroup>(
        &self,
        range: Range<usize>,
        group: &G,
        observables: &Observables,
        at: &ObservationPoint<G>,
        load: &dyn Fn(MotionQuantity) -> f64,
        buffers: &mut Buffers,
        list: &mut Vec<f64>,
    ) {
        let Buffers { values: found, entries, workspace } = buffers;
        let mut values = Values::new(group, observables, at, load, entries);
        found.clear();
        found.resize(self.scope.quantities().len(), f64::NAN);
        for formula in &self.formulas[range] {
            for &k in formula.variables() {
                // computes only the values that formulas use, each of them once
                if found[k].is_nan() {
                    found[k] = values.of(self.scope.quantities()[k]);
                }
            }
            list.push(formula.value_in(found, workspace));
        }
    }
}

/// The values at a point. Common subexpressions are computed once, when they are needed for the
/// first time.
struct Values<'v, G: SimulationGroup> {
    group: &'v G,
    observables: &'v Observables,
    at: &'v ObservationPoint<'v, G>,
    load: &'v dyn Fn(MotionQuantity) -> f64,
    momentum: Option<G::Vector>,
    other_momentum: Option<G::Vector>,
    other_velocity: Option<G::Vector>,
    /// The entries of the element. They are valid if `written` is set.
    entries: &'v mut Vec<f64>,
    written: bool,
}

impl<'v, G: SimulationGroup> Values<'v, G> {
    fn new(
        group: &'v G,
        observables: &'v Observables,
        at: &'v ObservationPoint<'v, G>,
        load: &'v dyn Fn(MotionQuantity) -> f64,
        entries: &'v mut Vec<f64>,
    ) -> Self {
        let (momentum, other_momentum, other_velocity) = (None, None, None);
        let written = false;
        Values {
            group,
            observables,
            at,
            load,
            momentum,
            other_momentum,
            other_velocity,
            entries,
            written,
        }
    }

    /// The value of a quantity. Quantities that a force may use are cheap, because each stage of a
    /// step computes them.
    #[inline(always)]
    fn of(&mut self, quantity: MotionQuantity) -> f64 {
        match quantity {
            MotionQuantity::Time => self.at.time,
            MotionQuantity::Velocity(i) => self.at.velocity.components()[i],
            MotionQuantity::Entry(row, column) => {
                if !self.written {
                    self.group.entries(self.at.element, self.entries);
                    self.written = true;
                }
                self.entries[row + column * self.observables.rows]
            }
            _ => self.computed(quantity),
        }
    }

    fn computed(&mut self, quantity: MotionQuantity) -> f64 {
        let Values { group, observables, at, load, .. } = *self;
        match quantity {
            MotionQuantity::Time | MotionQuantity::Velocity(_) | MotionQuantity::Entry(..) => {
                self.of(quantity)
            }
            MotionQuantity::Parameter(k) => observables.names.parameters[k].1,
            MotionQuantity::Named(k) => group.named(at.element, k),
            MotionQuantity::Momentum(i) => self.momentum().components()[i],
            MotionQuantity::OtherVelocity(i) => {
                let velocity = || group.adjoint(at.element, at.velocity);
                self.other_velocity.get_or_insert_with(velocity).components()[i]
            }
            MotionQuantity::OtherMomentum(i) => {
                if self.other_momentum.is_none() {
                    let momentum = group.coadjoint(&group.inverse(at.element), self.momentum());
                    self.other_momentum = Some(momentum);
                }
                self.other_momentum.as_ref().map_or(f64::NAN, |h| h.components()[i])
            }
            MotionQuantity::Kinetic => at.energy.unwrap_or_else(|| self.kinetic()),
            MotionQuantity::Potential | MotionQuantity::Power => load(quantity),
            MotionQuantity::Energy => {
                at.energy.unwrap_or_else(|| self.kinetic() + load(MotionQuantity::Potential))
            }
        }
    }

    fn momentum(&mut self) -> &G::Vector {
        let Values { observables, at, .. } = *self;
        let computed = || at.momentum.cloned().unwrap_or_else(|| observables.momentum(at.velocity));
        self.momentum.get_or_insert_with(computed)
    }

    /// The kinetic energy `T = H(Omega)/2` (98).
    fn kinetic(&mut self) -> f64 {
        let velocity = self.at.velocity.components();
        let products = self.momentum().components().iter().zip(velocity);
        0.5 * products.map(|(h, omega)| h * omega).sum::<f64>()
    }
}

//! Motions with a velocity that is given over time: `g' = g Omega(t)`.

use super::Motion;
use super::SimulationGroup;
use super::drive::Drive;
use super::observables::{Buffers, Observables, Point};
use super::quantities::{Names, Quantity, Scope};
use super::run::{Recorded, Run};
use crate::group::{Coordinates, LieGroup};
use crate::mechanics::formula::Formula;
use crate::mechanics::integrators::{KinematicState, Linear, Magnus};
use affinor_tensors::expression::ExpressionError;
use std::cell::RefCell;
use std::ops::Range;

/// A velocity over time: formulas of `t` and the parameters for its components.
#[derive(Clone, Debug, Default)]
pub struct GivenVelocity {
    scope: Scope,
    formulas: Vec<Formula>,
    buffers: RefCell<Buffers>,
}

impl GivenVelocity {
    /// Adds the next component.
    ///
    /// # Errors
    /// As [`Formula::parse`], and if the formula uses other names than `t` and parameters.
    pub fn add(&mut self, text: &str, names: &Names) -> Result<(), ExpressionError> {
        let allowed = |quantity| matches!(quantity, Quantity::Time | Quantity::Parameter(_));
        self.formulas.push(self.scope.read(text, names, &allowed)?);
        Ok(())
    }

    fn at<V: Coordinates>(&self, time: f64) -> V {
        let Buffers { values, workspace, .. } = &mut *self.buffers.borrow_mut();
        self.scope.evaluate(|_| time, values);
        V::from_fn(self.formulas.len(), |i| self.formulas[i].value_in(values, workspace))
    }
}

/// The motion `g' = g Omega(t)` from an element at a time, by a Magnus method with steps of at most a size. `columns` are the formulas
/// of the rows.
pub fn on_given<G: SimulationGroup>(
    group: G,
    velocity: GivenVelocity,
    (time, element): (f64, G::Element),
    (method, step): (Magnus, f64),
    columns: (Scope, Vec<Formula>),
    observables: Observables<G>,
) -> Box<dyn Motion> {
    let (given, width, buffers) = (velocity.clone(), columns.1.len(), RefCell::default());
    let rate: Rate<G> = Box::new(move |time| given.at(time));
    let values = move |_: &_, state: &KinematicState<G>, range: Range<usize>, list: &mut _| {
        let velocity: G::Vector = velocity.at(state.time);
        let point = Point::new(state.time, &state.element, &velocity);
        let buffers = &mut *buffers.borrow_mut();
        observables.formulas(&columns, range, (&point, &|_| 0.0), buffers, list);
    };
    let system = Linear { group, velocity: rate };
    let fits = |system: &Linear<G, _>, state: &KinematicState<G>, _: &_| {
        system.group.has_shape(&state.element)
    };
    let recorded = Recorded::new(system, |state| &mut state.time, fits, width, values);
    Run::boxed(recorded, KinematicState { time, element }, Drive::fixed(method, step))
}

type Rate<G> = Box<dyn Fn(f64) -> <G as LieGroup>::Vector + Send>;

//! Motions of Lie-Poisson systems, whose Hamiltonian is a formula of the momentum.

use super::drive::{Drive, refused};
use super::forces::Forces;
use super::observables::{Observables, Point};
use super::on_cotangent::{Observed, on_cotangent};
use super::quantities::{Quantity, Scope};
use super::simulated::SimulationGroup;
use super::{Method, Motion};
use crate::Error;
use crate::group::Coordinates;
use crate::mechanics::formula::{Formula, Gradient, Workspace};
use crate::mechanics::{Adaptive, CotangentSystem, State, System};
use affinor_tensors::expression::ExpressionError;
use std::cell::RefCell;

/// `E(H)` as a formula of the components of the momentum and the parameters.
#[derive(Clone, Debug)]
pub struct Hamiltonian {
    scope: Scope,
    gradient: Gradient,
    text: String,
    /// Values of the quantities, and derivatives by the components of the momentum.
    buffers: RefCell<(Vec<f64>, Vec<f64>, Workspace)>,
}

impl Hamiltonian {
    /// Reads the formula.
    ///
    /// # Errors
    /// As [`Formula::parse`]; also for quantities other than components of the momentum and parameters.
    pub fn read<G: SimulationGroup>(
        text: &str,
        observables: &Observables<G>,
    ) -> Result<Self, ExpressionError> {
        let mut scope = Scope::default();
        let allowed = |quantity| matches!(quantity, Quantity::Momentum(_) | Quantity::Parameter(_));
        let gradient = scope.read(text, observables.names(), &allowed)?.differentiated();
        Ok(Hamiltonian { scope, gradient, text: text.trim().into(), buffers: RefCell::default() })
    }

    /// The value, and its derivatives by the components of the momentum.
    fn evaluate<V: Coordinates>(&self, momentum: &V) -> (f64, V) {
        let (values, slopes, workspace) = &mut *self.buffers.borrow_mut();
        let h = momentum.components();
        let value = |quantity| match quantity {
            Quantity::Momentum(i) => h[i],
            _ => f64::NAN,
        };
        self.scope.evaluate(value, values);
        let (value, derivatives) = self.gradient.evaluate(values, workspace);
        if !value.is_finite() {
            return (value, V::from_fn(h.len(), |_| f64::NAN));
        }
        slopes.clear();
        slopes.resize(h.len(), 0.0);
        for (k, slope) in derivatives {
            if let Quantity::Momentum(i) = self.scope.quantities()[k] {
                slopes[i] = slope;
            }
        }
        (value, V::from_components(slopes))
    }
}

/// The motion of a Hamiltonian from an element with a momentum in the frame of the equations, and its method.
///
/// # Errors
/// [`Error::NoMethod`] for a method that is for bodies.
pub fn on_hamiltonian<G: SimulationGroup>(
    observables: Observables<G>,
    hamiltonian: Hamiltonian,
    (time, element, momentum): (f64, G::Element, G::Vector),
    (method, step, control): (Option<Method>, Option<f64>, Adaptive),
    columns: (Scope, Vec<Formula>),
) -> Result<(Box<dyn Motion>, Method), Error> {
    let default = if step.is_some() { Method::MuntheKaas } else { Method::to(control.tolerance) };
    let method = method.unwrap_or(default);
    let group = &observables.group;
    let drive = Drive::of_any_system(group, method, step, control)?.0.ok_or_else(|| {
        refused(method, "a Hamiltonian has rkmk54, rkmk853, rkmk4, projected ones, cf4, cg3")
    })?;
    let state = State::with_momentum(group, time, element, &momentum);
    let system = HamiltonianSystem { hamiltonian, observables };
    Ok((on_cotangent(system, state, drive, columns), method))
}

/// The Lie-Poisson equations of a Hamiltonian that is a formula.
struct HamiltonianSystem<G: SimulationGroup> {
    hamiltonian: Hamiltonian,
    observables: Observables<G>,
}

impl<G: SimulationGroup> System for HamiltonianSystem<G> {
    type State = State<G>;

    fn time(&self, state: &State<G>) -> f64 {
        state.time
    }
}

impl<G: SimulationGroup> CotangentSystem for HamiltonianSystem<G> {
    type Group = G;

    fn group(&self) -> &G {
        &self.observables.group
    }

    fn velocity_of(&self, momentum: &G::Vector) -> G::Vector {
        let (value, velocity) = self.hamiltonian.evaluate(momentum);
        if !velocity.is_finite() {
            let (text, at) = (&self.hamiltonian.text, momentum.components());
            let name = self.observables.names().momentum();
            self.observables.record(format!(
                "the Hamiltonian {text} is {value}, its derivatives {:?}, at {name} = {at:?}",
                velocity.components()
            ));
        }
        velocity
    }

    fn is_free(&self) -> bool {
        true
    }
}

impl<G: SimulationGroup> Observed for HamiltonianSystem<G> {
    fn observables(&self) -> &Observables<G> {
        &self.observables
    }

    fn forces(&self) -> Option<&Forces<G>> {
        None
    }

    fn at<R>(&self, state: &State<G>, look: impl FnOnce(&Point<G>) -> R) -> R {
        let momentum = state.momentum(&self.observables.group);
        let (energy, velocity) = self.hamiltonian.evaluate(&momentum);
        let point = Point::new(state.time, &state.element, &velocity);
        look(&Point { momentum: Some(&momentum), energy: Some(energy), ..point })
    }
}

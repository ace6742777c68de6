//! Lie-Poisson equations, whose Hamiltonian is a formula of the momentum.

use super::cotangent::{CotangentMotion, ObservedSystem, any_system};
use crate::Error;
use crate::group::{AnyGroup, Coordinates};
use crate::mechanics::formula::{Gradient, Workspace};
use crate::mechanics::simulation::group::{GroupVisitor, SimulationGroup, element, vector, visit};
use crate::mechanics::simulation::integration::Integration;
use crate::mechanics::simulation::methods::{Class, Method};
use crate::mechanics::simulation::motion::{Started, simulation};
use crate::mechanics::simulation::observables::{ColumnFormulas, Observables, ObservationPoint};
use crate::mechanics::simulation::quantities::{FormulaScope, MotionQuantity};
use crate::mechanics::{CotangentSystem, State, System};
use affinor_tensors::expression::ExpressionError;
use nalgebra::DVector;
use std::cell::RefCell;

/// The Hamiltonian `E(H)`, given as a formula of the components of the momentum and the parameters.
#[derive(Clone, Debug)]
pub struct Hamiltonian {
    scope: FormulaScope,
    gradient: Gradient,
    text: String,
    /// Buffers for the values of the quantities, and for the derivatives with respect to the
    /// components of the momentum.
    buffers: RefCell<(Vec<f64>, Vec<f64>, Workspace)>,
}

impl Hamiltonian {
    /// Parses the formula of the Hamiltonian.
    ///
    /// # Errors
    /// The errors of [`Formula::parse`](crate::mechanics::formula::Formula::parse); also an error
    /// if the formula contains quantities other than components of the momentum and parameters.
    pub fn read(text: &str, observables: &Observables) -> Result<Self, ExpressionError> {
        let mut scope = FormulaScope::default();
        let allowed = |quantity| {
            matches!(quantity, MotionQuantity::Momentum(_) | MotionQuantity::Parameter(_))
        };
        let gradient = scope.read(text, observables.names(), &allowed)?.differentiated();
        Ok(Hamiltonian { scope, gradient, text: text.trim().into(), buffers: RefCell::default() })
    }

    /// The value of the Hamiltonian, and its derivatives with respect to the components of the
    /// momentum.
    fn evaluate<V: Coordinates>(&self, momentum: &V) -> (f64, V) {
        let (values, slopes, workspace) = &mut *self.buffers.borrow_mut();
        let h = momentum.components();
        let value = |quantity| match quantity {
            MotionQuantity::Momentum(i) => h[i],
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
            if let MotionQuantity::Momentum(i) = self.scope.quantities()[k] {
                slopes[i] = slope;
            }
        }
        (value, V::from_components(slopes))
    }
}

/// The specification of a motion of Lie-Poisson equations. The group is a separate argument.
pub struct LiePoissonSpec {
    /// The names of quantities.
    pub observables: Observables,
    /// The Hamiltonian.
    pub hamiltonian: Hamiltonian,
    /// The initial time.
    pub time: f64,
    /// The embedding coordinates of the initial element.
    pub element: DVector<f64>,
    /// The initial momentum, in the frame of the equations.
    pub momentum: DVector<f64>,
    /// The method and its settings. The default is `rkmk4` if there is a step size; otherwise it is
    /// a method with step-size control.
    pub integration: Integration,
    /// The columns.
    pub columns: ColumnFormulas,
}

impl LiePoissonSpec {
    /// Starts the motion on a group.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if the method applies only to bodies.
    pub fn start(self, group: &AnyGroup) -> Result<Started, Error> {
        visit(group, self)
    }
}

impl GroupVisitor for LiePoissonSpec {
    type Output = Result<Started, Error>;

    fn visit<G: SimulationGroup>(self, group: &G) -> Result<Started, Error> {
        let Integration { method, step, control } = self.integration;
        let default =
            if step.is_some() { Method::MuntheKaas4 } else { Method::to(control.tolerance) };
        let method = method.unwrap_or(default);
        let step = self.integration.step_of(method)?;
        let stepper = any_system(group, method, step, control)?.ok_or_else(|| {
            let names = Method::names_of(&[Class::AnySystem, Class::Projection]);
            method.refused(&format!("the methods for a Hamiltonian are {names}"))
        })?;
        let (element, momentum) = (element(group, &self.element), vector(&self.momentum));
        let state = State::with_momentum(group, self.time, element, &momentum);
        let system = HamiltonianSystem {
            group: group.clone(),
            hamiltonian: self.hamiltonian,
            observables: self.observables,
        };
        let motion = simulation(CotangentMotion::new(system, self.columns), state, stepper);
        Ok(Started { motion, method })
    }
}

/// The Lie-Poisson equations of a Hamiltonian that is given by a formula.
struct HamiltonianSystem<G> {
    group: G,
    hamiltonian: Hamiltonian,
    observables: Observables,
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
        &self.group
    }

    fn velocity_of(&self, momentum: &G::Vector) -> G::Vector {
        let (value, velocity) = self.hamiltonian.evaluate(momentum);
        if !velocity.is_finite() {
            let (text, at) = (&self.hamiltonian.text, momentum.components());
            let name = self.observables.names().momentum();
            self.observables.record(format!(
                "the Hamiltonian {text} is {value} and its derivatives are {:?} at {name} = {at:?}",
                velocity.components()
            ));
        }
        velocity
    }

    fn is_free(&self) -> bool {
        true
    }
}

impl<G: SimulationGroup> ObservedSystem for HamiltonianSystem<G> {
    fn observables(&self) -> &Observables {
        &self.observables
    }

    fn at<R>(&self, state: &State<G>, look: impl FnOnce(&ObservationPoint<G>) -> R) -> R {
        let momentum = state.momentum(&self.group);
        let (energy, velocity) = self.hamiltonian.evaluate(&momentum);
        let point = ObservationPoint::new(state.time, &state.element, &velocity);
        look(&ObservationPoint { momentum: Some(&momentum), energy: Some(energy), ..point })
    }
}

//! Lie-Poisson systems as motions: a Hamiltonian as a formula of the momentum.

use super::drive::{Drive, NO_NUMBERS};
use super::on_cotangent::{OnCotangent, Seen};
use super::quantities::{Quantity, Scope};
use super::{Forces, Method, Motion, Point, Simulated};
use crate::Error;
use crate::dynamics::{Adaptive, CotangentSystem, LiePoissonSystem, State, System};
use crate::formula::Formula;
use crate::group::{Coordinates, LieGroup};
use affinor_tensors::expression::ExpressionError;

/// `E(H)` as a formula of the components of the momentum and the parameters.
#[derive(Clone, Debug)]
pub struct Hamiltonian {
    scope: Scope,
    formula: Formula,
    text: String,
    parameters: Vec<f64>,
}

impl Hamiltonian {
    /// Reads the formula, with the names of `forces`.
    ///
    /// # Errors
    /// As [`Formula::parse`].
    pub fn read<G: Simulated>(text: &str, forces: &Forces<G>) -> Result<Self, ExpressionError> {
        let mut scope = Scope::default();
        let allowed = |quantity| matches!(quantity, Quantity::Momentum(_) | Quantity::Parameter(_));
        let formula = scope.read(text, forces.names(), &allowed)?;
        let (text, parameters) = (text.trim().into(), forces.parameters.clone());
        Ok(Hamiltonian { scope, formula, text, parameters })
    }

    fn values(&self, momentum: &[f64]) -> Vec<f64> {
        let value = |quantity: &Quantity| match *quantity {
            Quantity::Momentum(i) => momentum[i],
            Quantity::Parameter(k) => self.parameters[k],
            _ => f64::NAN,
        };
        self.scope.quantities().iter().map(value).collect()
    }

    fn energy(&self, momentum: &[f64]) -> f64 {
        self.formula.value(&self.values(momentum))
    }

    /// No numbers where the value is none.
    fn gradient<V: Coordinates>(&self, momentum: &V) -> V {
        let values = self.values(momentum.components());
        let mut slopes = vec![0.0; values.len()];
        let value = self.formula.gradient(&values, &mut slopes);
        let n = momentum.components().len();
        if !value.is_finite() {
            return V::from_fn(n, |_| f64::NAN);
        }
        let mut gradient = vec![0.0; n];
        for (quantity, slope) in self.scope.quantities().iter().zip(&slopes) {
            if let Quantity::Momentum(i) = quantity {
                gradient[*i] = *slope;
            }
        }
        V::from_components(&gradient)
    }
}

/// The motion from an element with a momentum in the frame of the equations, and its method.
///
/// # Errors
/// [`Error::NoMethod`] for a method that is for bodies.
pub fn on_hamiltonian<G: Simulated>(
    names: Forces<G>,
    hamiltonian: Hamiltonian,
    (time, element, momentum): (f64, G::Element, G::Vector),
    (method, step, control): (Option<Method>, Option<f64>, Adaptive),
    columns: (Scope, Vec<Formula>),
) -> Result<(Box<dyn Motion>, Method), Error> {
    let default = if step.is_some() { Method::MuntheKaas } else { Method::to(control.tolerance) };
    let method = method.unwrap_or(default);
    method.expect_resolved(control.tolerance)?;
    let refused = |reason: &str| Error::NoMethod { method: method.name(), reason: reason.into() };
    let step = match step {
        Some(step) => step,
        None if method.has_steps() => return Err(refused("it needs a step")),
        None => 0.0,
    };
    let drive = match Drive::of_any_system(method, step, control) {
        Some(drive) => drive,
        None if method.is_projected() => return Err(refused(NO_NUMBERS)),
        None => {
            return Err(refused(
                "a Hamiltonian has rkmk54, rkmk853, rkmk4, projected ones, cf4, cg3",
            ));
        }
    };
    let of = hamiltonian.clone();
    let gradient: Gradient<G> = Box::new(move |momentum| of.gradient(momentum));
    let equations = LiePoissonSystem { group: names.group.clone(), gradient };
    let state = equations.state(time, element, &momentum);
    let system = Named { equations, hamiltonian, names };
    Ok((Box::new(OnCotangent { system, state, drive, steps: 0, columns }), method))
}

type Gradient<G> = Box<dyn Fn(&<G as LieGroup>::Vector) -> <G as LieGroup>::Vector + Send>;

/// The system with its names.
struct Named<G: Simulated> {
    equations: LiePoissonSystem<G, Gradient<G>>,
    hamiltonian: Hamiltonian,
    names: Forces<G>,
}

impl<G: Simulated> System for Named<G> {
    type State = State<G>;

    fn time(&self, state: &State<G>) -> f64 {
        state.time
    }
}

impl<G: Simulated> CotangentSystem for Named<G> {
    type Group = G;

    fn group(&self) -> &G {
        &self.equations.group
    }

    fn velocity_of(&self, momentum: &G::Vector) -> G::Vector {
        let velocity = self.equations.velocity_of(momentum);
        if !velocity.is_finite() {
            let (text, at) = (&self.hamiltonian.text, momentum.components());
            let value = self.hamiltonian.energy(at);
            let name = self.names.names().momentum();
            self.names.tell(format!(
                "the Hamiltonian {text} is {value}, its derivatives {:?}, at {name} = {at:?}",
                velocity.components()
            ));
        }
        velocity
    }

    fn is_free(&self) -> bool {
        self.equations.is_free()
    }
}

impl<G: Simulated> Seen for Named<G> {
    fn forces(&self) -> &Forces<G> {
        &self.names
    }

    fn seen<R>(&self, state: &State<G>, look: impl FnOnce(&Point<G>) -> R) -> R {
        let momentum = self.equations.momentum(state);
        let velocity = self.hamiltonian.gradient(&momentum);
        let energy = Some(self.hamiltonian.energy(momentum.components()));
        let point = Point::new(state.time, &state.element, &velocity);
        look(&Point { momentum: Some(&momentum), energy, ..point })
    }
}

//! Motions on groups chosen at run time.
//!
//! A group in closed form takes its own type, so that a step allocates nothing. Elements and vectors at the start are lists of
//! numbers, as those of [`AnyGroup`] are.

use super::quantities::Scope;
use super::{
    Equations, Forces, GivenVelocity, Hamiltonian, Method, Motion, Observables, Setup,
    SimulationGroup,
};
use crate::group::{AnyGroup, Coordinates, Embedded, Opposite, So3};
#[cfg(not(target_family = "wasm"))]
use crate::group::{Se2, Se3, Sl2, So2};
use crate::mechanics::formula::Formula;
use crate::mechanics::{Adaptive, Constrained, Magnus};
use crate::{Connection, Error, Metric};
use nalgebra::DVector;

/// Returns the value of an expression of a group, with the group in its own type.
macro_rules! return_in_own_type {
    ($group:ident => $value:expr) => {
        return_in_own_type!(So3: $group => $value);
        // for a browser the size of the program counts more
        #[cfg(not(target_family = "wasm"))]
        return_in_own_type!(So2 Se2 Se3 Sl2: $group => $value);
        // the equations of a right-invariant system
        return_in_own_type!(Opposite<AnyGroup>: $group => $value);
        return $value
    };
    ($($Group:ty)*: $group:ident => $value:expr) => {
        $(if let Some($group) = $group.downcast_ref::<$Group>() {
            return $value;
        })*
    };
}

/// [`on_group`](super::on_group()): the motion of an Euler-Poincare system, and its method.
///
/// # Errors
/// As there.
pub fn on_group(
    group: &AnyGroup,
    setup: Setup<AnyGroup>,
) -> Result<(Box<dyn Motion>, Method), Error> {
    return_in_own_type!(group => super::on_group(group.to_owned(), setup.on(group)));
}

/// [`on_constraints`](super::on_constraints()) for the system of a connection, a metric, forces and constraints.
///
/// # Errors
/// As there, and as [`Constrained::new`].
pub fn on_constraints(
    group: &AnyGroup,
    (connection, metric): (&Connection<f64>, &Metric<f64>),
    (forces, constraints): (Forces<AnyGroup>, Equations<AnyGroup>),
    (time, element, velocity): (f64, DVector<f64>, DVector<f64>),
    step: f64,
    columns: (Scope, Vec<Formula>),
    visible: usize,
) -> Result<Box<dyn Motion>, Error> {
    return_in_own_type!(group => {
        let (forces, constraints) = (forces.on(group), constraints.on(group));
        let system = Constrained::new(group.to_owned(), connection, metric, forces, constraints)?;
        let start = (time, element_of(group, &element), vector(&velocity));
        super::on_constraints(system, start, step, columns, visible)
    });
}

/// [`on_hamiltonian`](super::on_hamiltonian()): the motion of a Lie-Poisson system, and its method.
///
/// # Errors
/// As there.
pub fn on_hamiltonian(
    group: &AnyGroup,
    (observables, hamiltonian): (Observables<AnyGroup>, Hamiltonian),
    (time, element, momentum): (f64, DVector<f64>, DVector<f64>),
    integration: (Option<Method>, Option<f64>, Adaptive),
    columns: (Scope, Vec<Formula>),
) -> Result<(Box<dyn Motion>, Method), Error> {
    return_in_own_type!(group => {
        let start = (time, element_of(group, &element), vector(&momentum));
        super::on_hamiltonian(observables.on(group), hamiltonian, start, integration, columns)
    });
}

/// [`on_given`](super::on_given()): the motion with a velocity over time.
pub fn on_given(
    group: &AnyGroup,
    (velocity, observables): (GivenVelocity, Observables<AnyGroup>),
    (time, element): (f64, DVector<f64>),
    integration: (Magnus, f64),
    columns: (Scope, Vec<Formula>),
) -> Box<dyn Motion> {
    return_in_own_type!(group => {
        let start = (time, element_of(group, &element));
        let observables = observables.on(group);
        super::on_given(group.to_owned(), velocity, start, integration, columns, observables)
    });
}

impl<'s> Setup<'s, AnyGroup> {
    /// The same data on the group in its own type.
    fn on<G: SimulationGroup>(self, group: &G) -> Setup<'s, G> {
        Setup {
            connection: self.connection,
            metric: self.metric,
            forces: self.forces.on(group),
            time: self.time,
            element: element_of(group, &self.element),
            momentum: vector(&self.momentum),
            method: self.method,
            step: self.step,
            control: self.control,
            columns: self.columns,
        }
    }
}

fn element_of<G: Embedded>(group: &G, numbers: &DVector<f64>) -> G::Element {
    group.from_numbers(&G::Numbers::from_components(numbers.as_slice()))
}

fn vector<V: Coordinates>(components: &DVector<f64>) -> V {
    V::from_components(components.as_slice())
}

//! Motions of Euler-Poincare systems with forces.

use super::drive::{Drive, refused};
use super::observables::{Observables, Point};
use super::on_cotangent::{Observed, on_cotangent};
use super::quantities::Scope;
use super::simulated::{Body, SimulationGroup};
use super::{Forces, Method, Motion};
use crate::mechanics::formula::Formula;
use crate::mechanics::integrators::kick;
use crate::mechanics::integrators::moser_veselov::Order;
use crate::mechanics::{Adaptive, CotangentSystem, EulerPoincare, State};
use crate::{Connection, Error, Metric};

/// The data of a motion on a group, beside the group.
pub struct Setup<'s, G: SimulationGroup> {
    /// The connection `Lambda` of `DH/Dt = M`.
    pub connection: &'s Connection<f64>,
    /// The metric `J`.
    pub metric: &'s Metric<f64>,
    /// The forces.
    pub forces: Forces<G>,
    /// The time at the start.
    pub time: f64,
    /// The element at the start.
    pub element: G::Element,
    /// The momentum at the start, in the frame of the equations.
    pub momentum: G::Vector,
    /// The method, or `None` for the default of this class of problems.
    pub method: Option<Method>,
    /// The step size of methods with fixed steps.
    pub step: Option<f64>,
    /// Step-size control: its tolerances, its longest step, the most steps from one output time to the next.
    pub control: Adaptive,
    /// The formulas of the columns, over their scope.
    pub columns: (Scope, Vec<Formula>),
}

/// The motion of an Euler-Poincare system on a group, and its method.
///
/// # Errors
/// As [`EulerPoincare::new`]; [`Error::NoMethod`] with the reason for a method that does not solve this problem.
pub fn on_group<G: SimulationGroup>(
    group: G,
    setup: Setup<G>,
) -> Result<(Box<dyn Motion>, Method), Error> {
    let inertia = setup.metric.components().to_dmatrix()?;
    let body = group.body(&inertia).filter(|_| is_plus(setup.connection));
    let free = setup.forces.is_empty();
    // an indefinite metric is no inertia of a body; it has the methods of all groups
    let is_body = matches!(body, Some(Ok(_)));
    let method = setup.method.unwrap_or(match (is_body, setup.step) {
        (true, None) if free => Method::Exact,
        (_, None) => Method::to(setup.control.tolerance),
        (true, Some(_)) if free => Method::MoserVeselov(Order::Ten),
        (true, Some(_)) if setup.forces.are_conservative() => Method::Kick(kick::Order::Four),
        (_, Some(_)) => Method::MuntheKaas,
    });
    let needed = match method {
        Method::Exact | Method::MoserVeselov(_) | Method::Splitting(_) => "no forces",
        Method::Kick(_) => "forces that depend on no velocity",
        _ => "",
    };
    let has = needed.is_empty() || free || (needed != "no forces" && setup.forces.are_positional());
    let system = EulerPoincare::new(group.clone(), setup.connection, setup.metric, setup.forces)?;
    let start = system.state_with_momentum(setup.time, setup.element, &setup.momentum);
    let refused = |reason: &str| refused(method, reason);
    let drive = match Drive::of_any_system(&group, method, setup.step, setup.control)? {
        (Some(drive), _) => drive,
        (None, step) => {
            let inertia =
                body.ok_or_else(|| refused("it is for a body: so(3), connection plus"))?;
            if !has {
                return Err(refused(&format!("it asks for {needed}")));
            }
            let own = group.body_drive(method, &system, &inertia?, &start, step);
            own.ok_or_else(|| refused("it is not for equations of motion on a group"))??
        }
    };
    Ok((on_cotangent(system, start, drive, setup.columns), method))
}

/// The factor `s` of a connection `Lambda = s c`, if it is of this family: its equations have `s` times the rate of change of
/// `H` that those of Euler and Poincare have without forces.
pub fn share_of_plus(connection: &Connection<f64>) -> Option<f64> {
    let (gamma, structure) = (connection.gamma(), connection.frame().structure());
    let (indices, value) = structure.components().next()?;
    let share = gamma.get(&indices) / value;
    (*gamma == structure.scale(&share)).then_some(share)
}

/// Whether the connection is `plus`, that of the Euler-Poincare equations.
pub fn is_plus(connection: &Connection<f64>) -> bool {
    connection.gamma() == connection.frame().structure()
}

impl<G: SimulationGroup> Observed for Body<G> {
    fn observables(&self) -> &Observables<G> {
        self.torque().observables()
    }

    fn forces(&self) -> Option<&Forces<G>> {
        Some(self.torque())
    }

    fn at<R>(&self, state: &State<G>, look: impl FnOnce(&Point<G>) -> R) -> R {
        let momentum = self.momentum(state);
        let velocity = self.velocity_of(&momentum);
        let point = Point::new(state.time, &state.element, &velocity);
        look(&Point { momentum: Some(&momentum), ..point })
    }
}

//! Euler-Poincare systems with forces as motions.

use super::drive::{Drive, NO_NUMBERS};
use super::on_cotangent::{OnCotangent, Seen};
use super::quantities::Scope;
use super::{Body, Forces, Method, Motion, Point, Simulated};
use crate::dynamics::integrators::kick;
use crate::dynamics::moser_veselov::Order;
use crate::dynamics::{Adaptive, EulerPoincare, State};
use crate::formula::Formula;
use crate::{Connection, Error, Metric};

/// What a motion on a group needs.
pub struct Setup<'s, G: Simulated> {
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
    /// The method; where none is named, that of the class of the problem.
    pub method: Option<Method>,
    /// The length of steps.
    pub step: Option<f64>,
    /// Step-size control: its tolerances, its longest step, the most steps from one wanted time to the next.
    pub control: Adaptive,
    /// Formulas to be computed along the way, over their scope.
    pub columns: (Scope, Vec<Formula>),
}

/// The motion of a system on a group, and its method.
///
/// # Errors
/// As [`EulerPoincare::new`]; [`Error::NoMethod`] for a method that is not for this problem, and the reason.
pub fn on_group<G: Simulated>(
    group: G,
    setup: Setup<G>,
) -> Result<(Box<dyn Motion>, Method), Error> {
    let inertia = crate::dense::to_dmatrix(setup.metric.components())?;
    let body = group.body(&inertia).filter(|_| is_plus(setup.connection));
    let free = setup.forces.is_empty();
    // an indefinite metric is no inertia, and has the methods of all groups
    let is_body = matches!(body, Some(Ok(_)));
    let method = setup.method.unwrap_or(match (is_body, setup.step) {
        (true, None) if free => Method::Exact,
        (_, None) => Method::to(setup.control.tolerance),
        (true, Some(_)) if free => Method::MoserVeselov(Order::Ten),
        (true, Some(_)) if setup.forces.are_conservative() => Method::Kick(kick::Order::Four),
        (_, Some(_)) => Method::MuntheKaas,
    });
    let refused = |reason: &str| Error::NoMethod { method: method.name(), reason: reason.into() };
    method.expect_resolved(setup.control.tolerance)?;
    let needed = match method {
        Method::Exact | Method::MoserVeselov(_) | Method::Splitting(_) => "no forces",
        Method::Kick(_) => "forces that depend on no velocity",
        _ => "",
    };
    let has = needed.is_empty() || free || (needed != "no forces" && setup.forces.are_positional());
    let system = EulerPoincare::new(group.clone(), setup.connection, setup.metric, setup.forces)?;
    let start = system.state_with_momentum(setup.time, setup.element, &setup.momentum);
    let step = match setup.step {
        Some(step) => step,
        None if method.has_steps() => return Err(refused("it needs a step")),
        None => 0.0,
    };
    let drive = match Drive::of_any_system(method, step, setup.control) {
        Some(drive) => drive,
        None if method.is_projected() => return Err(refused(NO_NUMBERS)),
        None => {
            let inertia =
                body.ok_or_else(|| refused("it is for a body: so(3), connection plus"))?;
            if !has {
                return Err(refused(&format!("it asks for {needed}")));
            }
            let own = group.own_drive(method, &system, &inertia?, &start, step);
            own.ok_or_else(|| refused("it is not for equations of motion on a group"))??
        }
    };
    let columns = setup.columns;
    Ok((Box::new(OnCotangent { system, state: start, drive, steps: 0, columns }), method))
}

/// Whether the connection is the one of Euler-Poincare.
pub fn is_plus(connection: &Connection<f64>) -> bool {
    connection.gamma() == connection.frame().structure()
}

impl<G: Simulated> Seen for Body<G> {
    fn forces(&self) -> &Forces<G> {
        self.torque()
    }

    fn seen<R>(&self, state: &State<G>, look: impl FnOnce(&Point<G>) -> R) -> R {
        let velocity = self.velocity(state);
        look(&Point::new(state.time, &state.element, &velocity))
    }
}

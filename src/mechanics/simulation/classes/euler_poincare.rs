//! Euler-Poincare equations with forces.

use super::cotangent::{CotangentMotion, ObservedSystem, any_system};
use super::free_body::{Body, FreeStart};
use crate::group::{AnyGroup, So3};
use crate::mechanics::simulation::forces::{Forces, ForcesOn};
use crate::mechanics::simulation::group::{GroupVisitor, SimulationGroup, element, vector, visit};
use crate::mechanics::simulation::integration::Integration;
use crate::mechanics::simulation::methods::{Class, Method};
use crate::mechanics::simulation::motion::{Started, simulation};
use crate::mechanics::simulation::observables::{ColumnFormulas, Observables, ObservationPoint};
use crate::mechanics::simulation::stepper::Stepper;
use crate::mechanics::{CotangentSystem, EulerPoincare, Inertia, State};
use crate::{Connection, Error, Metric};
use nalgebra::DVector;
use std::any::Any;

/// The specification of a motion of Euler-Poincare equations. The group is a separate argument.
pub struct EulerPoincareSpec<'s> {
    /// The connection `Lambda` in `DH/Dt = M`.
    pub connection: &'s Connection<f64>,
    /// The metric `J`.
    pub metric: &'s Metric<f64>,
    /// The forces.
    pub forces: Forces,
    /// The initial time.
    pub time: f64,
    /// The embedding coordinates of the initial element.
    pub element: DVector<f64>,
    /// The initial momentum, in the frame of the equations.
    pub momentum: DVector<f64>,
    /// The method and its settings. If there is no method, the default of this class of problems is
    /// used.
    pub integration: Integration,
    /// The columns.
    pub columns: ColumnFormulas,
}

impl EulerPoincareSpec<'_> {
    /// Starts the motion on a group.
    ///
    /// # Errors
    /// The errors of [`EulerPoincare::new`]; [`Error::Unsupported`], with the reason, if the method
    /// does not apply to this problem.
    pub fn start(self, group: &AnyGroup) -> Result<Started, Error> {
        visit(group, self)
    }

    /// The default method. It is exact for a free body; otherwise it depends on the forces and the
    /// step.
    fn default_method(&self, is_body: bool) -> Method {
        let free = self.forces.is_empty();
        match (is_body, self.integration.step) {
            (true, None) if free => Method::Exact,
            (_, None) => Method::to(self.integration.control.tolerance),
            (true, Some(_)) if free => Method::MoserVeselov10,
            (true, Some(_)) if self.forces.are_conservative() => Method::Kick4,
            (_, Some(_)) => Method::MuntheKaas4,
        }
    }
}

impl GroupVisitor for EulerPoincareSpec<'_> {
    type Output = Result<Started, Error>;

    fn visit<G: SimulationGroup>(self, group: &G) -> Result<Started, Error> {
        let inertia = self.metric.components().to_dmatrix()?;
        let body = group.body(&inertia).filter(|_| is_plus(self.connection));
        // uses the methods for all groups if the metric is indefinite, because only a definite
        // metric is the inertia of a body
        let is_body = matches!(body, Some(Ok(_)));
        let method = self.integration.method.unwrap_or_else(|| self.default_method(is_body));
        let free = self.forces.is_empty();
        let lacks = match method.class() {
            Class::FreeBody if !free => Some("a body without forces"),
            Class::BodyInPotential if !self.forces.are_positional() => {
                Some("forces that do not depend on the velocity")
            }
            _ => None,
        };
        let forces = ForcesOn::new(group, self.forces);
        let system = EulerPoincare::new(group.clone(), self.connection, self.metric, forces)?;
        let element = element(group, &self.element);
        let start = system.state_with_momentum(self.time, element, &vector(&self.momentum));
        let step = self.integration.step_of(method)?;
        let stepper = match any_system(group, method, step, self.integration.control)? {
            Some(stepper) => stepper,
            None => {
                let inertia = body.ok_or_else(|| {
                    method.refused("it is for a rigid body: so(3) with the connection plus")
                })?;
                if let Some(needed) = lacks {
                    return Err(method.refused(&format!("it needs {needed}")));
                }
                let stepper = body_stepper(method, inertia?, &system, &start, step);
                let other = || method.refused("it is not for equations of motion on a group");
                stepper.ok_or_else(other)??
            }
        };
        let motion = simulation(CotangentMotion::new(system, self.columns), start, stepper);
        Ok(Started { motion, method })
    }
}

/// The stepper of a method for bodies. Returns `None` on groups other than SO(3), and for methods
/// of other classes.
fn body_stepper<G: SimulationGroup>(
    method: Method,
    inertia: Inertia,
    system: &Body<G>,
    start: &State<G>,
    step: f64,
) -> Option<Result<Stepper<Body<G>>, Error>> {
    let body: &Body<So3> = (system as &dyn Any).downcast_ref()?;
    let state: &State<So3> = (start as &dyn Any).downcast_ref()?;
    let momentum = body.momentum(state);
    let stepper = method.body(&FreeStart { inertia, state: state.clone(), momentum }, step)?;
    // the cast succeeds, because `G` is SO(3) in this branch
    let own_type = |stepper| (Box::new(stepper) as Box<dyn Any>).downcast().ok();
    stepper.map(own_type).transpose().map(|stepper| stepper.map(|stepper| *stepper))
}

/// The factor `s` if the connection is `Lambda = s c`. Without forces, the time derivative of `H`
/// is then `s` times the time derivative in the Euler-Poincare equations.
pub fn cartan_schouten_factor(connection: &Connection<f64>) -> Option<f64> {
    let (gamma, structure) = (connection.affinities(), connection.frame().structure_functions());
    let (indices, value) = structure.components().next()?;
    let share = gamma.get(&indices) / value;
    (*gamma == structure.scale(&share)).then_some(share)
}

/// Whether the connection is `plus`, which is the connection of the Euler-Poincare equations.
pub fn is_plus(connection: &Connection<f64>) -> bool {
    connection.affinities() == connection.frame().structure_functions()
}

impl<G: SimulationGroup> ObservedSystem for Body<G> {
    fn observables(&self) -> &Observables {
        self.torque().forces.observables()
    }

    fn forces(&self) -> Option<&ForcesOn<G>> {
        Some(self.torque())
    }

    fn at<R>(&self, state: &State<G>, look: impl FnOnce(&ObservationPoint<G>) -> R) -> R {
        let momentum = self.momentum(state);
        let velocity = self.velocity_of(&momentum);
        let point = ObservationPoint::new(state.time, &state.element, &velocity);
        look(&ObservationPoint { momentum: Some(&momentum), ..point })
    }
}

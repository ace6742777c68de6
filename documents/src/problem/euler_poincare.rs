//! Equations of motion of a kinetic energy and forces, with or without constraints.

use super::body::{Bodies, Moved};
use super::forces::ForceFormulas;
use super::initial::InitialMomentum;
use super::keys::Keys;
use super::on_group::{OnGroup, Start};
use super::output::RowFormulas;
use super::reader::Reader;
use super::ready::{Kept, Ready};
use super::solid::Solid;
use crate::input::InputError;
use affinor::group::{AnyGroup, LieGroup, So3};
use affinor::mechanics::simulation::{
    EulerPoincareSpec, ForceFrame, ForceFunction, Forces, SimulationGroup, cartan_schouten_factor,
    is_plus,
};
use affinor::{CanonicalConnection, Connection, Error, Metric};
use affinor_tensors::{Symbolic, Tolerance};
use nalgebra::{DMatrix, DVector};
use std::borrow::Cow;
use std::sync::OnceLock;

/// The data of the equations of motion `DH/Dt = M`: the metric of a kinetic energy, a connection,
/// forces, and an initial velocity or momentum.
#[derive(Clone, Debug)]
pub(super) struct EulerPoincare {
    /// The moving bodies, which define the metric.
    bodies: Option<Bodies>,
    /// The initial velocity or momentum; `None` if joints define it.
    initial: Option<InitialMomentum>,
    forces: ForceFormulas,
    casimirs: Vec<Symbolic>,
    /// Whether there are constraint forces in addition to the forces.
    is_constrained: bool,
    /// The kinetic energy, if it does not depend on parameters. All members of an ensemble share
    /// it.
    shared: OnceLock<KineticEnergy>,
}

/// The metric of a kinetic energy, and the connection of the equations of motion.
#[derive(Clone, Debug)]
pub(super) struct KineticEnergy {
    pub metric: Metric<f64>,
    pub connection: Connection<f64>,
    /// The parameters that the bodies define, with their values.
    of_body: Vec<(String, f64)>,
    /// The parts of each body.
    pub solids: Vec<Vec<Solid>>,
}

/// The equations of one motion, and its initial condition.
pub(super) struct System<'d> {
    pub energy: Cow<'d, KineticEnergy>,
    /// The matrix of the metric.
    pub inertia: DMatrix<f64>,
    pub forces: Forces,
    pub rows: RowFormulas,
    pub element: DVector<f64>,
    pub momentum: DVector<f64>,
    pub notes: Vec<String>,
}

impl EulerPoincare {
    pub fn read(keys: &Keys, on_group: &OnGroup, reader: &Reader) -> Result<Self, InputError> {
        if keys.metric.is_some() && keys.inertia.is_some() {
            let error = reader.source.refused("inertia", "the metric is given twice");
            return Err(error.help("give one of metric, inertia"));
        }
        let forces = ForceFormulas::read(&keys.forces, reader)?;
        let bodies = keys.inertia.as_ref().map(|keys| Bodies::read(keys, reader)).transpose()?;
        let initial = Some(InitialMomentum::read(&keys.initial, reader)?);
        let casimirs = on_group.casimirs();
        let shared = OnceLock::new();
        Ok(EulerPoincare { bodies, initial, forces, casimirs, is_constrained: false, shared })
    }

    /// The dynamics of moving bodies.
    #[cfg(feature = "mechanisms")]
    pub fn new(bodies: Bodies, initial: Option<InitialMomentum>, forces: ForceFormulas) -> Self {
        let (bodies, casimirs, shared) = (Some(bodies), vec![], OnceLock::new());
        EulerPoincare { bodies, initial, forces, casimirs, is_constrained: false, shared }
    }

    /// Adds a force that is given as a function.
    pub fn add_force(&mut self, side: ForceFrame, function: ForceFunction) {
        self.forces.add(side, function);
    }

    /// Marks the problem as constrained: constraint forces change the Casimir functions and the
    /// momentum.
    pub fn constrained(self) -> Self {
        EulerPoincare { casimirs: vec![], is_constrained: true, ..self }
    }

    /// Prepares a motion without constraints.
    pub fn motion(&self, start: &Start) -> Result<Ready, InputError> {
        let member = start.member;
        let System { energy, inertia, forces, rows, element, momentum, notes } =
            self.system(start, None)?;
        let spec = EulerPoincareSpec {
            connection: &energy.connection,
            metric: &energy.metric,
            forces,
            time: member.times[0],
            element,
            momentum,
            integration: member.integration()?,
            columns: rows.formulas,
        };
        let started = spec.start(start.group)?;
        let ready = Ready::new(started, &member.times, rows.columns, rows.events);
        let solids = energy.solids.clone();
        Ok(Ready { inertia: Some(inertia), solids, notes, ..ready })
    }

    fn energy(&self, start: &Start) -> Result<KineticEnergy, InputError> {
        let group = start.group;
        let tolerance = Tolerance::default();
        let ground = start.definition.ground(tolerance)?;
        let (metric, of_body, solids) = match &self.bodies {
            Some(bodies) => {
                let labels = group.algebra()?.labels().to_vec();
                let Moved { metric, names, solids } =
                    bodies.metric(group, &labels, &start.member.values())?;
                (Some(metric), names, solids)
            }
            None => (start.definition.metric(&ground, tolerance)?, vec![], vec![]),
        };
        let metric = metric.ok_or_else(|| {
            let error = InputError::mathematics("the metric of the kinetic energy is missing");
            error.help("give metric = \"diag(...)\", or rows; on so(3) and se(3) also [inertia]")
        })?;
        let connection = if start.definition.connection_is_default() {
            Connection::canonical(&group.algebra()?, CanonicalConnection::Plus)
        } else if group.is_right() {
            let message = "right-invariant equations always use the connection plus of the right-invariant frame";
            return Err(InputError::usage(message).help("name no connection"));
        } else {
            start.definition.geometry_over(ground, tolerance)?.connection().clone()
        };
        Ok(KineticEnergy { metric, connection, of_body, solids })
    }

    /// The equations of one motion, and its initial condition; `velocity` is the initial velocity if
    /// the problem has none.
    pub fn system(
        &self,
        start: &Start,
        velocity: Option<DVector<f64>>,
    ) -> Result<System<'_>, InputError> {
        let (group, member, values) = (start.group, start.member, start.member.values());
        let energy = match self.shared.get() {
            Some(energy) => Cow::Borrowed(energy),
            None => Cow::Owned(self.energy(start)?),
        };
        let is_new = self.shared.get().is_none() && self.bodies.is_none();
        if is_new && start.on_group.definition().parameters().is_empty() {
            // ignores an error, because another thread may have stored the same value in the
            // meantime
            let _ = self.shared.set(energy.clone().into_owned());
        }
        let inertia = energy.metric.components().to_dmatrix().map_err(affinor::Error::from)?;
        let mut notes = notes(group, &inertia);
        if !is_plus(&energy.connection) {
            let rate = cartan_schouten_factor(&energy.connection).map_or(String::new(), |share| {
                format!(": without forces, H' is {share} times its value there")
            });
            let not =
                "the connection is not plus, so the equations are not the Euler-Poincare equations";
            notes.push(format!("{not}{rate}"));
        }
        start.expect_new_names(&energy.of_body)?;
        let parameters = [&member.parameters[..], &energy.of_body].concat();
        let mut forces = Forces::none(group, inertia.clone(), parameters);
        self.forces.apply(&mut forces, start.definition.dimension())?;
        // shows Casimir functions only without forces, because forces change the coadjoint orbit
        let casimirs = if forces.is_empty() { &self.casimirs[..] } else { &[] };
        let kept = Kept {
            energy: forces.are_conservative() && is_plus(&energy.connection),
            momentum: forces.is_empty() && is_plus(&energy.connection) && !self.is_constrained,
        };
        let rows =
            member.output.formulas(forces.names(), &|_| true, casimirs, kept, member.source)?;
        let element = start.on_group.element().at(group, &values)?;
        let momentum = match (&self.initial, velocity) {
            (Some(initial), _) => initial.at(group, &element, forces.observables(), &values)?,
            (None, Some(velocity)) => &inertia * velocity,
            (None, None) => DVector::zeros(inertia.nrows()),
        };
        Ok(System { energy, inertia, forces, rows, element, momentum, notes })
    }
}

/// Warnings about a metric that a rigid body cannot have.
fn notes(group: &AnyGroup, inertia: &DMatrix<f64>) -> Vec<String> {
    let eigenvalues = inertia.symmetric_eigenvalues();
    if eigenvalues.max() < 0.0 {
        return vec!["the metric is negative definite, so the kinetic energy is negative".into()];
    }
    if eigenvalues.min() <= 0.0 {
        return vec!["the metric is indefinite, so the energy does not bound the velocity".into()];
    }
    let Some(Ok(body)) = group.downcast_ref::<So3>().and_then(|so3| so3.body(inertia)) else {
        return vec![];
    };
    body.require_physical().err().iter().map(Error::to_string).collect()
}

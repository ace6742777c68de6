//! Problems with Euler-Poincare equations and constraints.

use super::euler_poincare::{EulerPoincare, System};
#[cfg(feature = "mechanisms")]
use super::joined::Joints;
use super::keys::Keys;
use super::on_group::{OnGroup, Start};
use super::reader::{Reader, Written};
use super::ready::{Column, Ready};
use crate::input::{InputError, forms::Text};
use affinor::Metric;
use affinor::mechanics::simulation::quantities::SymbolTable;
use affinor::mechanics::simulation::{
    Class, ConstrainedSpec, Constraints, ForceFrame, ForceFunction, Integration, Method, Started,
};
use nalgebra::DVector;

/// Equations of motion with Lagrange multipliers.
#[derive(Clone, Debug)]
pub(super) struct Constrained {
    dynamics: EulerPoincare,
    constraints: Given,
}

/// The origin of the constraints.
#[derive(Clone, Debug)]
enum Given {
    /// Formulas, each of which must vanish: of the time and the entries of the element, and of these
    /// and the velocity.
    Written { holonomic: Vec<Written>, affine: Vec<Written> },
    #[cfg(feature = "mechanisms")]
    Joints(Box<Joints>),
}

impl Constrained {
    pub fn read(keys: &Keys, on_group: &OnGroup, reader: &Reader) -> Result<Self, InputError> {
        let written = |texts: &[Text]| -> Vec<Written> {
            texts.iter().map(|text| reader.written(text)).collect()
        };
        let holonomic = written(keys.constraints.as_deref().unwrap_or(&[]));
        let affine = written(keys.velocity_constraints());
        let is_given = |key: &str| reader.source.has_key(key);
        reader.refuse_empty("constraints", holonomic.is_empty() && is_given("constraints"))?;
        let key = "velocity_constraints";
        reader.refuse_empty(key, affine.is_empty() && is_given(key))?;
        let dynamics = EulerPoincare::read(keys, on_group, reader)?.constrained();
        Ok(Constrained { dynamics, constraints: Given::Written { holonomic, affine } })
    }

    /// The dynamics of bodies with joints.
    #[cfg(feature = "mechanisms")]
    pub fn of_joints(dynamics: EulerPoincare, joints: Joints) -> Self {
        Constrained { dynamics, constraints: Given::Joints(Box::new(joints)) }
    }

    /// Adds a force that is given as a function.
    pub fn add_force(&mut self, side: ForceFrame, function: ForceFunction) {
        self.dynamics.add_force(side, function);
    }

    pub fn motion(&self, start: &Start) -> Result<Ready, InputError> {
        let (group, member) = (start.group, start.member);
        let velocity = match &self.constraints {
            Given::Written { .. } => None,
            #[cfg(feature = "mechanisms")]
            Given::Joints(joints) => Some(joints.velocity(&member.values())?),
        };
        let System { energy, inertia, forces, rows, element, momentum, notes } =
            self.dynamics.system(start, velocity)?;
        let integration = member.integration()?;
        let method = method_of(&integration)?;
        let step = match method.has_steps() {
            true => member.needed_step("a system with constraints")?,
            false => f64::NAN,
        };
        let (constraints, count, forces, more) = match &self.constraints {
            Given::Written { holonomic, affine } => {
                let constraints = written(holonomic, affine, forces.names())?;
                (constraints, holonomic.len() + affine.len(), forces, vec![])
            }
            #[cfg(feature = "mechanisms")]
            Given::Joints(joints) => {
                let forces = joints.with_gravity(&member.values(), &inertia, forces)?;
                let constraints = joints.constraints(&member.values(), forces.names())?;
                (constraints, joints.count(), forces, joints.notes())
            }
        };
        let notes = notes.into_iter().chain(more).collect();
        let mut columns = rows.columns;
        if !constraints.are_workless() {
            let energies = columns.iter_mut().filter(|column| column.name == "energy");
            energies.for_each(|column| column.conserved = false);
        }
        let visible = columns.len();
        let multipliers = (1..=count).map(|a| format!("lambda{a}"));
        columns.extend(multipliers.map(|name| Column::new(name, false)));
        columns.push(Column::new("violation", true));
        let velocity = velocity_of(&energy.metric, &momentum)?;
        let spec = ConstrainedSpec {
            connection: &energy.connection,
            metric: &energy.metric,
            forces,
            constraints,
            time: member.times[0],
            element,
            velocity,
            method,
            step,
            columns: rows.formulas,
            visible,
        };
        let motion = match method.class() {
            #[cfg(feature = "mechanisms")]
            Class::AnySystem | Class::Projection => {
                spec.start_reduced(group, integration.control)?
            }
            _ => spec.start(group)?,
        };
        let started = Started { motion, method };
        let ready = Ready::new(started, &member.times, columns, rows.events);
        let solids = energy.solids.clone();
        Ok(Ready { inertia: Some(inertia), solids, notes, ..ready })
    }
}

/// The classes of methods for constraints.
const CLASSES: &[Class] = if cfg!(feature = "mechanisms") {
    &[Class::Constrained, Class::AnySystem, Class::Projection]
} else {
    &[Class::Constrained]
};

/// The method of a motion with constraints. By default, it has step-size control unless there is a
/// step.
fn method_of(integration: &Integration) -> Result<Method, InputError> {
    let method = integration.method.unwrap_or(match integration.step {
        None if cfg!(feature = "mechanisms") => Method::to(integration.control.tolerance),
        _ => Method::GeneralisedAlpha,
    });
    if CLASSES.contains(&method.class()) {
        return Ok(method);
    }
    let message = format!("the method {method} does not support constraints");
    let names = Method::names_of(CLASSES);
    Err(InputError::mathematics(message).help(format!("methods for constraints: {names}")))
}

/// The constraints that are given as formulas.
fn written(
    holonomic: &[Written],
    affine: &[Written],
    names: &SymbolTable,
) -> Result<Constraints, InputError> {
    let mut constraints = Constraints::default();
    let entries = names.entries();
    for written in holonomic {
        let help = format!("a constraint may contain t, the entries {entries} and parameters");
        let added = constraints.add(written.text(), names);
        added.map_err(|error| written.refused(error, help))?;
    }
    for written in affine {
        let [own, other] = ["Omega", "omega"].map(|stem| names.expand(stem).join(", "));
        let help = format!(
            "a constraint on the velocity is a sum of components {own} or {other}, with \
             coefficients in t, the entries {entries} and parameters"
        );
        let added = constraints.add_affine(written.text(), names);
        added.map_err(|error| written.refused(error, help))?;
    }
    Ok(constraints)
}

/// The velocity `J^-1 H` for the momentum `h`.
fn velocity_of(metric: &Metric<f64>, h: &DVector<f64>) -> Result<DVector<f64>, InputError> {
    let inverse = metric.inverse().to_dmatrix().map_err(affinor::Error::from)?;
    Ok(DVector::from_fn(h.len(), |i, _| (0..h.len()).map(|j| inverse[(i, j)] * h[j]).sum()))
}

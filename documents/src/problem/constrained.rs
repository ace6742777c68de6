//! Problems with Euler-Poincare equations and holonomic constraints.

use super::euler_poincare::{EulerPoincare, System};
#[cfg(feature = "mechanisms")]
use super::joined::Joints;
use super::keys::Keys;
use super::on_group::{OnGroup, Start};
use super::reader::{Reader, Written};
use super::ready::{Column, Ready};
use crate::input::InputError;
use affinor::Metric;
use affinor::mechanics::simulation::quantities::SymbolTable;
use affinor::mechanics::simulation::{
    Class, ConstrainedSpec, Constraints, ForceFrame, ForceFunction, Method, Started,
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
    /// Formulas in the entries of the element, each of which must vanish.
    Written(Vec<Written>),
    #[cfg(feature = "mechanisms")]
    Joints(Box<Joints>),
}

impl Constrained {
    pub fn read(keys: &Keys, on_group: &OnGroup, reader: &Reader) -> Result<Self, InputError> {
        let constraints: Vec<_> = keys.constraints.iter().flatten().collect();
        reader.refuse_empty("constraints", constraints.is_empty())?;
        let constraints = constraints.into_iter().map(|text| reader.written(text)).collect();
        let dynamics = EulerPoincare::read(keys, on_group, reader)?.constrained();
        Ok(Constrained { dynamics, constraints: Given::Written(constraints) })
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
            Given::Written(_) => None,
            #[cfg(feature = "mechanisms")]
            Given::Joints(joints) => Some(joints.velocity(&member.values())?),
        };
        let System { energy, inertia, forces, rows, element, momentum, notes } =
            self.dynamics.system(start, velocity)?;
        let method = member.method().unwrap_or(Method::GeneralisedAlpha);
        if method.class() != Class::Constrained {
            let message = format!("the method {method} does not support constraints");
            let names = Method::names_of(&[Class::Constrained]);
            return Err(
                InputError::mathematics(message).help(format!("methods for constraints: {names}"))
            );
        }
        let step = member.needed_step("a system with constraints")?;
        let (constraints, count, forces, note) = match &self.constraints {
            Given::Written(list) => (written(list, forces.names())?, list.len(), forces, None),
            #[cfg(feature = "mechanisms")]
            Given::Joints(joints) => {
                let forces = joints.with_gravity(&member.values(), &inertia, forces)?;
                let constraints = joints.constraints(&member.values(), forces.names())?;
                (constraints, joints.count(), forces, joints.note())
            }
        };
        let notes = notes.into_iter().chain(note).collect();
        let mut columns = rows.columns;
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
        let started = Started { motion: spec.start(group)?, method };
        let ready = Ready::new(started, &member.times, columns, rows.events);
        let solids = energy.solids.clone();
        Ok(Ready { inertia: Some(inertia), solids, notes, ..ready })
    }
}

/// The constraints that are given as formulas.
fn written(list: &[Written], names: &SymbolTable) -> Result<Constraints, InputError> {
    let mut constraints = Constraints::default();
    for written in list {
        let help =
            format!("a constraint may contain the entries {} and parameters", names.entries());
        let added = constraints.add(written.text(), names);
        added.map_err(|error| written.refused(error, help))?;
    }
    Ok(constraints)
}

/// The velocity `J^-1 H` for the momentum `h`.
fn velocity_of(metric: &Metric<f64>, h: &DVector<f64>) -> Result<DVector<f64>, InputError> {
    let inverse = metric.inverse().to_dmatrix().map_err(affinor::Error::from)?;
    Ok(DVector::from_fn(h.len(), |i, _| (0..h.len()).map(|j| inverse[(i, j)] * h[j]).sum()))
}

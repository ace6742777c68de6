//! Problems of Euler-Poincare equations with holonomic constraints.

use super::dynamics::{Dynamics, System};
use super::keys::Keys;
use super::on_group::{OnGroup, Start};
use super::reader::{Reader, Written};
use super::ready::{Column, Ready};
use crate::definition::InputError;
use affinor::Metric;
use affinor::mechanics::motions::chosen::on_constraints;
use affinor::mechanics::motions::{Equations, Method};
use nalgebra::DVector;

/// Equations of motion with Lagrange multipliers.
#[derive(Clone, Debug)]
pub(super) struct Constrained {
    dynamics: Dynamics,
    /// Formulas of the entries of the element, each of which must vanish.
    constraints: Vec<Written>,
}

impl Constrained {
    pub fn read(keys: &Keys, on_group: &OnGroup, reader: &Reader) -> Result<Self, InputError> {
        let constraints: Vec<_> = keys.constraints.iter().flatten().collect();
        reader.refuse_empty("constraints", constraints.is_empty())?;
        let constraints = constraints.into_iter().map(|text| reader.written(text)).collect();
        let dynamics = Dynamics::read(keys, on_group, reader)?.without_casimirs();
        Ok(Constrained { dynamics, constraints })
    }

    pub fn motion(&self, start: &Start) -> Result<Ready, InputError> {
        let (group, member) = (start.group, start.member);
        let System { energy, inertia, forces, rows, element, momentum, notes } =
            self.dynamics.system(start)?;
        if let Some(method) = member.method().filter(|m| *m != Method::GeneralisedAlpha) {
            let message = format!("the method {method} is not for constraints");
            return Err(InputError::mathematics(message)
                .help("the method for constraints is generalised-alpha"));
        }
        let step = member.needed_step("a system with constraints")?;
        let mut equations = Equations::new(group.clone());
        for written in &self.constraints {
            let added = equations.add(written.text(), forces.names());
            let entries = forces.names().entries();
            let help = format!("a constraint is a formula of the entries {entries} and parameters");
            added.map_err(|error| written.refused(error, help))?;
        }
        let mut columns = rows.columns;
        let visible = columns.len();
        let multipliers = (1..=self.constraints.len()).map(|a| format!("lambda{a}"));
        columns.extend(multipliers.map(|name| Column::new(name, false)));
        columns.push(Column::new("violation", true));
        let velocity = velocity_of(&energy.metric, &momentum)?;
        let motion = on_constraints(
            group,
            (&energy.connection, &energy.metric),
            (forces, equations),
            (member.times[0], element, velocity),
            step,
            rows.formulas,
            visible,
        )?;
        let motion = (motion, Method::GeneralisedAlpha);
        let ready = Ready::new(motion, &member.times, columns, rows.events);
        Ok(Ready { inertia: Some(inertia), notes, ..ready })
    }
}

/// The velocity `J^-1 H` of a momentum.
fn velocity_of(metric: &Metric<f64>, h: &DVector<f64>) -> Result<DVector<f64>, InputError> {
    let inverse = metric.inverse().to_dmatrix().map_err(affinor::Error::from)?;
    Ok(DVector::from_fn(h.len(), |i, _| (0..h.len()).map(|j| inverse[(i, j)] * h[j]).sum()))
}

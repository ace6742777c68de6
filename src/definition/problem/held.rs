//! Problems with constraints.

use super::launch::{Formulas, Launch};
use super::{Column, numbers_of};
use crate::definition::InputError;
use crate::dense::to_dmatrix;
use crate::dynamics::Constrained;
use crate::group::Coordinates;
use crate::simulation::{Equations, Forces, Method, Motion, Simulated, on_constraints};
use crate::{Connection, Metric};

/// What a motion with constraints needs beside its group and its start.
pub(super) struct Held<'h, G: Simulated> {
    pub metric: &'h Metric<f64>,
    pub connection: &'h Connection<f64>,
    pub forces: Forces<G>,
    pub step: Option<f64>,
}

impl Launch<'_> {
    /// A motion that constraints hold, and its columns.
    pub(super) fn constrained<G: Simulated>(
        &self,
        group: G,
        held: Held<G>,
        start: (f64, G::Element, G::Vector),
        mut columns: Vec<Column>,
        formulas: Formulas,
    ) -> Result<(Box<dyn Motion>, Vec<Column>), InputError> {
        if let Some(method) = self.problem.method.filter(|m| *m != Method::GeneralisedAlpha) {
            let message = format!("the method {method} is not for constraints");
            return Err(InputError::mathematics(message).help("that is generalised-alpha"));
        }
        let Some(step) = held.step else {
            return Err(InputError::mathematics("a system with constraints needs a step"));
        };
        let values = numbers_of(&self.parameters);
        let mut equations = Equations::new(group.clone(), values);
        for written in &self.on_group.constraints {
            let added = equations.add(&written.text, held.forces.names());
            let entries = held.forces.names().entries();
            let help = format!("a constraint is a formula of the entries {entries} and parameters");
            added.map_err(|error| written.refused(error, help))?;
        }
        let visible = columns.len();
        let multipliers =
            (1..=self.on_group.constraints.len()).map(|a| (format!("lambda{a}"), false));
        for (name, watched) in multipliers.chain([("violation".to_string(), true)]) {
            columns.push(Column { name, formula: None, watched });
        }
        let Held { metric, connection, forces, .. } = held;
        let system = Constrained::new(group, connection, metric, forces, equations)?;
        Ok((on_constraints(system, start, step, formulas, visible)?, columns))
    }
}

/// `J^-1 H`.
pub(super) fn velocity_of<V: Coordinates>(metric: &Metric<f64>, h: &V) -> Result<V, InputError> {
    let (inverse, h) = (to_dmatrix(metric.inverse())?, h.components());
    Ok(V::from_fn(h.len(), |i| (0..h.len()).map(|j| inverse[(i, j)] * h[j]).sum()))
}

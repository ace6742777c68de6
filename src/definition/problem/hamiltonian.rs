//! Problems of a Hamiltonian.

use super::launch::Launch;
use super::{Course, Ready, Written, numbers_of};
use crate::definition::InputError;
use crate::simulation::{Forces, Hamiltonian, Simulated, on_hamiltonian};
use nalgebra::DMatrix;

impl Launch<'_> {
    /// A Lie-Poisson motion.
    pub(super) fn hamiltonian<G: Simulated>(
        &self,
        group: G,
        written: &Written,
    ) -> Result<Ready, InputError> {
        let refused = |message: &str| Err(InputError::usage(message).at(&written.place));
        let on_group = self.on_group;
        let forced = !on_group.forces.is_empty() || on_group.potential.is_some();
        if forced || on_group.table.is_some() || !on_group.constraints.is_empty() {
            return refused("a Hamiltonian has no forces and no constraints beside it");
        }
        if on_group.inertia.is_some() || self.definition.has_metric() {
            return refused("a Hamiltonian stands in the place of a metric");
        }
        if !self.definition.connection_is_default() {
            return refused(
                "a Hamiltonian has the equations of Lie and Poisson, and no connection",
            );
        }
        if !matches!(on_group.course, Course::Momentum(..)) {
            return refused("a Hamiltonian starts from a momentum");
        }
        let n = group.dimension();
        let values = numbers_of(&self.parameters);
        let names = Forces::none(group.clone(), DMatrix::identity(n, n), self.parameters.clone());
        self.expect_new_names(&group, &[])?;
        let hamiltonian = Hamiltonian::read(&written.text, &names).map_err(|error| {
            let momentum = names.names().momentum();
            let help = format!("it is a formula of {momentum}1..{momentum}{n} and the parameters");
            written.refused(error, help)
        })?;
        let (columns, mut formulas) = self.columns(&names, &|_| true)?;
        let events = self.events(&names, &|_| true, &mut formulas)?;
        let element = self.element(&group, &values)?;
        let momentum = self.momentum(&group, &element, &names, &values)?;
        let problem = self.problem;
        let control = problem.control_at(&values, self.times)?;
        let how = (problem.method, problem.step_at(&values)?, control);
        let start = (self.times[0], element, momentum);
        let (motion, method) = on_hamiltonian(names, hamiltonian, start, how, formulas)?;
        let (times, notes) = (self.times.to_vec(), vec![]);
        Ok(Ready { motion, method, times, columns, events, inertia: None, notes })
    }
}

//! Problems with Lie-Poisson equations, given by a Hamiltonian function of the momentum.

use super::initial::InitialMomentum;
use super::keys::Keys;
use super::on_group::{OnGroup, Start};
use super::reader::{Reader, Written};
use super::ready::{Kept, Ready};
use crate::input::{InputError, forms::Text};
use affinor::group::LieGroup;
use affinor::mechanics::simulation::{Hamiltonian, LiePoissonSpec, Observables};
use affinor_tensors::Symbolic;

/// A motion on coadjoint orbits.
#[derive(Clone, Debug)]
pub(super) struct LiePoisson {
    hamiltonian: Written,
    initial: InitialMomentum,
    casimirs: Vec<Symbolic>,
}

impl LiePoisson {
    pub fn read(
        hamiltonian: &Text,
        keys: &Keys,
        on_group: &OnGroup,
        reader: &Reader,
    ) -> Result<Self, InputError> {
        let hamiltonian = reader.written(hamiltonian);
        let refused = |message: &str| Err(InputError::usage(message).at(&hamiltonian.place()));
        let forces = &keys.forces;
        let forced = forces.body.is_some() || forces.spatial.is_some() || forces.table.is_some();
        if forced || forces.potential.is_some() || keys.constraints.is_some() {
            return refused("forces and constraints cannot be combined with a Hamiltonian");
        }
        let initial = InitialMomentum::read(&keys.initial, reader)?;
        if keys.inertia.is_some() || on_group.definition().has_metric() {
            return refused("give either a Hamiltonian or a metric, not both");
        }
        if !on_group.definition().connection_is_default() {
            return refused(
                "a connection cannot be combined with a Hamiltonian, whose equations are Lie-Poisson equations",
            );
        }
        if !initial.is_momentum() {
            return refused("with a Hamiltonian, give the initial momentum instead of a velocity");
        }
        Ok(LiePoisson { hamiltonian, initial, casimirs: on_group.casimirs() })
    }

    pub fn motion(&self, start: &Start) -> Result<Ready, InputError> {
        let (group, member, values) = (start.group, start.member, start.member.values());
        let n = group.dimension();
        let observables = Observables::new(group, None, member.parameters.clone());
        let names = observables.names();
        start.expect_new_names(&[])?;
        let hamiltonian =
            Hamiltonian::read(self.hamiltonian.text(), &observables).map_err(|error| {
                let momentum = names.momentum();
                let help = format!("it may contain {momentum}1..{momentum}{n} and the parameters");
                self.hamiltonian.refused(error, help)
            })?;
        let kept = Kept { energy: true, momentum: true };
        let rows = member.output.formulas(names, &|_| true, &self.casimirs, kept, member.source)?;
        let element = start.on_group.element().at(group, &values)?;
        let momentum = self.initial.at(group, &element, &observables, &values)?;
        let spec = LiePoissonSpec {
            observables,
            hamiltonian,
            time: member.times[0],
            element,
            momentum,
            integration: member.integration()?,
            columns: rows.formulas,
        };
        Ok(Ready::new(spec.start(group)?, &member.times, rows.columns, rows.events))
    }
}

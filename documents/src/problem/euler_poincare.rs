//! Problems of Euler-Poincare equations: a kinetic energy, with or without forces.

use super::dynamics::{Dynamics, System};
use super::keys::Keys;
use super::member::Member;
use super::on_group::{GroupClass, Start};
use super::reader::Reader;
use super::ready::Ready;
use crate::definition::InputError;
use affinor::mechanics::motions::{Setup, SimulationGroup, on_group};

/// Equations of motion `DH/Dt = M` of a kinetic energy.
#[derive(Clone, Debug)]
pub(super) struct EulerPoincare(Dynamics);

impl EulerPoincare {
    pub fn read(keys: &Keys, reader: &Reader) -> Result<Self, InputError> {
        Dynamics::read(keys, reader).map(EulerPoincare)
    }

    pub fn motion(&self, member: &Member) -> Result<Ready, InputError> {
        self.0.on_group.motion(self, member)
    }
}

impl GroupClass for EulerPoincare {
    fn motion<G: SimulationGroup>(&self, group: G, start: &Start) -> Result<Ready, InputError> {
        let member = start.member;
        let System { energy, inertia, forces, rows, element, momentum, notes, .. } =
            self.0.system(&group, start)?;
        let setup = Setup {
            connection: &energy.connection,
            metric: &energy.metric,
            forces,
            time: member.times[0],
            element,
            momentum,
            method: member.method(),
            step: member.step()?,
            control: member.control()?,
            columns: rows.formulas,
        };
        let motion = on_group(group, setup)?;
        let ready = Ready::new(motion, &member.times, rows.columns, rows.events);
        Ok(Ready { inertia: Some(inertia), notes, ..ready })
    }
}

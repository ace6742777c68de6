//! The classes of problems on a Lie group.

use super::constrained::Constrained;
use super::euler_poincare::EulerPoincare;
use super::integrator::Member;
use super::keys::Keys;
use super::lie_poisson::LiePoisson;
use super::on_group::{OnGroup, Start};
use super::prescribed_velocity::PrescribedVelocity;
use super::reader::Reader;
use super::ready::Ready;
use crate::definition::input::InputError;
use affinor::group::{AnyGroup, Opposite};
use affinor_tensors::Tolerance;

/// The classes of problems on a group.
#[derive(Clone, Debug)]
pub(super) enum GroupClass {
    EulerPoincare(Box<EulerPoincare>),
    Constrained(Box<Constrained>),
    LiePoisson(Box<LiePoisson>),
    PrescribedVelocity(Box<PrescribedVelocity>),
}

impl GroupClass {
    pub fn read(keys: &Keys, on_group: &OnGroup, reader: &Reader) -> Result<Self, InputError> {
        Ok(if let Some(prescribed) = &keys.prescribed {
            Self::PrescribedVelocity(PrescribedVelocity::read(prescribed, reader)?.into())
        } else if let Some(hamiltonian) = &keys.hamiltonian {
            Self::LiePoisson(LiePoisson::read(hamiltonian, keys, on_group, reader)?.into())
        } else if keys.constraints.is_some() {
            Self::Constrained(Constrained::read(keys, on_group, reader)?.into())
        } else {
            Self::EulerPoincare(EulerPoincare::read(keys, on_group, reader)?.into())
        })
    }

    /// The motion of a member on the group of the problem.
    pub fn motion(&self, on_group: &OnGroup, member: &Member) -> Result<Ready, InputError> {
        let space = on_group.valued(member)?;
        let definition = space.in_floats()?;
        let group = definition.group(Tolerance::default())?;
        let group = if on_group.is_right() { AnyGroup::new(Opposite(group)) } else { group };
        let start = Start { on_group, group: &group, member, definition };
        match self {
            Self::EulerPoincare(class) => class.motion(&start),
            Self::Constrained(class) => class.motion(&start),
            Self::LiePoisson(class) => class.motion(&start),
            Self::PrescribedVelocity(class) => class.motion(&start),
        }
    }
}

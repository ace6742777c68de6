//! The classes of problems on a Lie group.

use super::constrained::Constrained;
use super::dynamics::Dynamics;
use super::given_velocity::GivenVelocity;
use super::integration::Member;
use super::keys::Keys;
use super::lie_poisson::LiePoisson;
use super::on_group::{OnGroup, Start};
use super::reader::Reader;
use super::ready::Ready;
use crate::definition::input::InputError;
use affinor::group::{AnyGroup, Opposite};
use affinor_tensors::Tolerance;

/// The classes of problems on a group.
#[derive(Clone, Debug)]
pub(super) enum GroupClass {
    EulerPoincare(Box<Dynamics>),
    Constrained(Box<Constrained>),
    LiePoisson(Box<LiePoisson>),
    GivenVelocity(Box<GivenVelocity>),
}

impl GroupClass {
    pub fn read(keys: &Keys, on_group: &OnGroup, reader: &Reader) -> Result<Self, InputError> {
        Ok(if let Some(given) = &keys.given {
            Self::GivenVelocity(GivenVelocity::read(given, reader)?.into())
        } else if let Some(hamiltonian) = &keys.hamiltonian {
            Self::LiePoisson(LiePoisson::read(hamiltonian, keys, on_group, reader)?.into())
        } else if keys.constraints.is_some() {
            Self::Constrained(Constrained::read(keys, on_group, reader)?.into())
        } else {
            Self::EulerPoincare(Dynamics::read(keys, on_group, reader)?.into())
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
            Self::GivenVelocity(class) => class.motion(&start),
        }
    }
}

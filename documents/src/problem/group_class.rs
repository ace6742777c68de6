//! The classes of problems on a Lie group, and the choice of the type of the group.

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
use affinor::group::{Opposite, So3};
#[cfg(not(target_family = "wasm"))]
use affinor::group::{Se2, Se3, Sl2, So2};
use affinor::mechanics::motions::SimulationGroup;
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
        on_group.valued(member)?.in_floats(Tolerance::default(), |definition, reading| {
            let start = Start { on_group, member, definition, reading };
            let group = definition.group(reading)?;
            if on_group.is_right() {
                return self.motion_on(Opposite(group), &start);
            }
            // with its own type, a group in closed form needs no allocation in a step
            macro_rules! with_its_type {
                ($($Group:ty)*) => {
                    $(if let Some(group) = group.downcast_ref::<$Group>() {
                        return self.motion_on(*group, &start);
                    })*
                };
            }
            // for a browser the size of the program counts more
            #[cfg(target_family = "wasm")]
            with_its_type!(So3);
            #[cfg(not(target_family = "wasm"))]
            with_its_type!(So2 So3 Se2 Se3 Sl2);
            self.motion_on(group, &start)
        })
    }

    fn motion_on<G: SimulationGroup>(&self, group: G, start: &Start) -> Result<Ready, InputError> {
        match self {
            Self::EulerPoincare(class) => class.motion(group, start),
            Self::Constrained(class) => class.motion(group, start),
            Self::LiePoisson(class) => class.motion(group, start),
            Self::GivenVelocity(class) => class.motion(group, start),
        }
    }
}

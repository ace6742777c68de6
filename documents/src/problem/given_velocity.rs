//! Problems of kinematics: a velocity that is given over time.

use super::keys::{GivenKeys, OF_DYNAMICS};
use super::on_group::Start;
use super::reader::{Reader, Written};
use super::ready::Ready;
use crate::definition::InputError;
use affinor::group::LieGroup;
use affinor::mechanics::integrators::Magnus;
use affinor::mechanics::motions::chosen::on_given;
use affinor::mechanics::motions::quantities::Quantity;
use affinor::mechanics::motions::{Method, Observables, Side, SimulationGroup};

/// The element that moves with a given velocity.
#[derive(Clone, Debug)]
pub(super) struct GivenVelocity {
    side: Side,
    /// The components of the velocity, as formulas in `t` and the parameters.
    velocity: Vec<Written>,
}

impl GivenVelocity {
    pub fn read(given: &GivenKeys, reader: &Reader) -> Result<Self, InputError> {
        reader.refuse("a velocity given over time", &OF_DYNAMICS)?;
        let (side, list) = match (&given.velocity, &given.space_velocity) {
            (Some(list), None) => (Side::Body, list),
            (None, Some(list)) => (Side::Space, list),
            _ => {
                return Err(reader.source.refused("given", "give one of velocity, space_velocity"));
            }
        };
        let velocity = list.iter().map(|number| reader.written(&number.0)).collect();
        Ok(GivenVelocity { side, velocity })
    }

    pub fn motion(&self, start: &Start) -> Result<Ready, InputError> {
        let (group, member, values) = (start.group, start.member, start.member.values());
        let n = group.dimension();
        if (self.side == Side::Space) != group.is_right() {
            let message =
                "a given velocity is in the body frame; with invariance = \"right\" it is in space";
            let place = self.velocity.first().map(Written::place);
            return Err(InputError::usage(message).or_at(place.as_ref()));
        }
        if self.velocity.len() != n {
            let found = self.velocity.len();
            let message = format!("the velocity has {found} components, the dimension is {n}");
            return Err(member.source.refused("given", message));
        }
        let method = member.method().unwrap_or(Method::Magnus(Magnus::Six));
        let Method::Magnus(magnus) = method else {
            let message = format!("the method {method} is not for a velocity over time");
            return Err(InputError::mathematics(message)
                .help("the methods for a velocity over time are magnus4 and magnus6"));
        };
        let step = member.needed_step("a velocity over time")?;
        start.expect_new_names(&[])?;
        let observables = Observables::new(group.clone(), None, member.parameters.clone());
        let names = observables.names();
        let mut velocity = affinor::mechanics::motions::GivenVelocity::default();
        for formula in &self.velocity {
            let added = velocity.add(formula.text(), names);
            let help = "the velocity is a formula of t and the parameters";
            added.map_err(|error| formula.refused(error, help))?;
        }
        // there is no inertia
        let kinematic = |quantity: Quantity| {
            use Quantity::{Energy, Kinetic, Momentum, OtherMomentum, Potential, Power};
            !matches!(
                quantity,
                Momentum(_) | OtherMomentum(_) | Kinetic | Potential | Energy | Power
            )
        };
        let rows = member.output.formulas(names, &kinematic, &[], member.source)?;
        let initial = (member.times[0], start.on_group.element().at(group, &values)?);
        let moved = (velocity, observables);
        let motion = on_given(group, moved, initial, (magnus, step), rows.formulas);
        Ok(Ready::new((motion, method), &member.times, rows.columns, rows.events))
    }
}

//! Problems of kinematics, given by a prescribed velocity.

use super::keys::{OF_DYNAMICS, PrescribedKeys};
use super::on_group::Start;
use super::reader::{Reader, Written};
use super::ready::{Kept, Ready};
use crate::input::InputError;
use affinor::group::LieGroup;
use affinor::mechanics::simulation::quantities::MotionQuantity;
use affinor::mechanics::simulation::{
    Class, ForceFrame, Method, Observables, PrescribedVelocitySpec, SimulationGroup, Started,
    VelocityFormulas,
};

/// The data of a motion with a prescribed velocity.
#[derive(Clone, Debug)]
pub(super) struct PrescribedVelocity {
    side: ForceFrame,
    /// The components of the velocity, as formulas in `t` and the parameters.
    velocity: Vec<Written>,
}

impl PrescribedVelocity {
    pub fn read(keys: &PrescribedKeys, reader: &Reader) -> Result<Self, InputError> {
        reader.refuse("a prescribed velocity", &OF_DYNAMICS)?;
        let (side, list) = match (&keys.velocity, &keys.spatial_velocity) {
            (Some(list), None) => (ForceFrame::Body, list),
            (None, Some(list)) => (ForceFrame::Spatial, list),
            _ => {
                return Err(reader
                    .source
                    .refused("prescribed", "give one of velocity, spatial_velocity"));
            }
        };
        let velocity = list.iter().map(|number| reader.written(&number.0)).collect();
        Ok(PrescribedVelocity { side, velocity })
    }

    pub fn motion(&self, start: &Start) -> Result<Ready, InputError> {
        let (group, member, values) = (start.group, start.member, start.member.values());
        let n = group.dimension();
        if (self.side == ForceFrame::Spatial) != group.is_right() {
            let message = "give `velocity` in the body frame, or `spatial_velocity` with invariance = \"right\"";
            let place = self.velocity.first().map(Written::place);
            return Err(InputError::usage(message).or_at(place.as_ref()));
        }
        if self.velocity.len() != n {
            let found = self.velocity.len();
            let message = format!("the velocity has {found} components, but the dimension is {n}");
            return Err(member.source.refused("prescribed", message));
        }
        let method = member.method().unwrap_or(Method::Magnus6);
        if method.class() != Class::PrescribedVelocity {
            let message = format!("the method {method} does not support a prescribed velocity");
            let names = Method::names_of(&[Class::PrescribedVelocity]);
            return Err(InputError::mathematics(message)
                .help(format!("methods for a prescribed velocity: {names}")));
        }
        let step = member.needed_step("a velocity over time")?;
        start.expect_new_names(&[])?;
        let observables = Observables::new(group, None, member.parameters.clone());
        let names = observables.names();
        let mut velocity = VelocityFormulas::default();
        for formula in &self.velocity {
            let added = velocity.add(formula.text(), names);
            let help = "the velocity may contain t and the parameters";
            added.map_err(|error| formula.refused(error, help))?;
        }
        // forbids quantities that need an inertia
        let kinematic = |quantity: MotionQuantity| {
            use MotionQuantity::{Energy, Kinetic, Momentum, OtherMomentum, Potential, Power};
            !matches!(
                quantity,
                Momentum(_) | OtherMomentum(_) | Kinetic | Potential | Energy | Power
            )
        };
        let kept = Kept { energy: false, momentum: false };
        let rows = member.output.formulas(names, &kinematic, &[], kept, member.source)?;
        let spec = PrescribedVelocitySpec {
            velocity,
            observables,
            time: member.times[0],
            element: start.on_group.element().at(group, &values)?,
            method,
            step,
            columns: rows.formulas,
        };
        let started = Started { motion: spec.start(group)?, method };
        Ok(Ready::new(started, &member.times, rows.columns, rows.events))
    }
}

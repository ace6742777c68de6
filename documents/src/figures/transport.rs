//! The velocity of a motion, transported to the identity by several connections: figure 3 of the
//! paper.

use super::images::{Moment, with_motion};
use super::{Connected, Figure, Panel, Path, Role, ball};
use affinor::Error;
use nalgebra::{DVector, Vector3};

/// The number of transported vectors that are drawn; the last one is at the identity.
const STOPS: u32 = 5;

/// Draws the velocity `w` at the time `t`, its images `Omega` and `omega`, and the vector that each
/// connection transports along the autoparallel to `e`. The transported vector is `omega` for
/// `plus` (57) and `Omega` for `minus`; for `zero` (71) it is halfway between them.
///
/// # Errors
/// No errors occur for rotations.
pub fn transport(connections: &[Connected], path: &Path, t: f64) -> Result<Figure, Error> {
    let panels = connections.iter().map(|connected| panel(connected, path, t));
    let title = "Parallel transport of the angular velocity w to the identity".into();
    Ok(Figure { title, panels: panels.collect::<Result<_, _>>()? })
}

fn panel(connected: &Connected, path: &Path, t: f64) -> Result<Panel, Error> {
    let mut panel = Panel::ball(&connected.name);
    let Moment { x, velocity, scale } = with_motion(&mut panel, path, t)?;
    let identity = Vector3::zeros();
    let left = ball::arrow(&identity, &velocity.body, scale)?;
    panel.arrow(Role::Left, ["Ω", "Ω, left image"], left);
    let right = ball::arrow(&identity, &velocity.spatial, scale)?;
    panel.arrow(Role::Right, ["ω", "ω, right image"], right);
    let u = DVector::from_column_slice(velocity.body.as_slice());
    for stop in 1..=STOPS {
        let s = f64::from(stop) / f64::from(STOPS);
        let carried = connected.translation.along_subgroup(&(x * -s))? * &u;
        let carried = Vector3::from_column_slice(carried.as_slice());
        let ends = ball::arrow(&(x * (1.0 - s)), &carried, scale)?;
        if stop < STOPS {
            panel.arrow(Role::Trace, ["", "w, transported along η"], ends);
        } else {
            panel.arrow(Role::Carried, ["ω′", "ω′, w transported to e"], ends);
        }
    }
    Ok(panel)
}

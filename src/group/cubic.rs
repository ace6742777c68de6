//! Tangent operators in closed form, for the groups with `ad_x^3 = -z(x) ad_x`.

use super::stumpff::{FAR, Stumpff, inverse_tangent};
use super::{Coordinates, LieGroup};
use crate::Error;

/// `T_left(x) v = v - c_2 [x, v] + c_3 [x, [x, v]]` with the Stumpff functions of `z(x)`.
pub(super) fn tangent_left<G: LieGroup + ?Sized>(
    group: &G,
    z: f64,
    x: &G::Vector,
    v: &G::Vector,
) -> G::Vector {
    if z > FAR {
        // the mean over a turn: the part that commutes with x
        let unit = x.clone() * x.largest().recip();
        let twice = group.bracket(&unit, &group.bracket(&unit, v));
        let z = group.cubic(&unit).map_or(f64::NAN, |[z, _]| z);
        return v.clone() + twice * z.recip();
    }
    let c = Stumpff::at(z);
    let once = group.bracket(x, v);
    v.clone() - once.clone() * c.c2 + group.bracket(x, &once) * c.c3
}

/// `T_left(x)^-1 v = v + [x, v]/2 + d [x, [x, v]]` with `d` of [`inverse_tangent`] at `z(x)`; singular at
/// `z = (2 pi k)^2`, `k > 0`, to the rounding of `z`, whose terms have sizes that sum to `size`.
pub(super) fn tangent_left_inverse<G: LieGroup + ?Sized>(
    group: &G,
    [z, size]: [f64; 2],
    x: &G::Vector,
    v: &G::Vector,
) -> Result<G::Vector, Error> {
    let singular = || Error::SingularTangent { x: x.components().to_vec() };
    let d = inverse_tangent(z, size).filter(|_| z <= FAR).ok_or_else(singular)?;
    let once = group.bracket(x, v);
    Ok(v.clone() + once.clone() * 0.5 + group.bracket(x, &once) * d)
}

//! Tangent operators of exp. For any group, they are computed by series in `ad`. For groups with
//! `ad_x^3 = -z(x) ad_x`, they are computed in closed form.

use super::{Coordinates, LieGroup};
use crate::numerics::exponential::phi1;
use crate::numerics::stumpff::{FAR, Stumpff, inverse_tangent};
use crate::{Error, Law};
use nalgebra::linalg::{SVD, Schur};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// The matrix `-ad_x`. The operator `T_left(x)` is the function [`phi1`] of this matrix.
fn ad<G: LieGroup + ?Sized>(group: &G, x: &G::Vector) -> DMatrix<f64> {
    let columns: Vec<_> = group.basis().iter().map(|v| group.bracket(v, x)).collect();
    DMatrix::from_fn(columns.len(), columns.len(), |i, k| columns[k].components()[i])
}

/// Whether a matrix has an eigenvalue near `2 pi i k`, `k != 0`. The tolerance is large, because
/// the eigenvalues of a Jordan block are accurate only to a root of the machine precision.
fn turns(m: &DMatrix<f64>) -> bool {
    const NEAR: f64 = 1e-3;
    let steps = 100 * m.nrows();
    // returns true if the eigenvalues cannot be computed, because the operator may then be singular
    let Some(schur) = Schur::try_new(m.clone(), 4.0 * f64::EPSILON, steps) else { return true };
    schur.complex_eigenvalues().iter().any(|value| {
        let k = (value.im / TAU).round();
        k != 0.0 && value.re.hypot(value.im - k * TAU) <= NEAR * value.im.abs()
    })
}

/// The operator `T_left(x) v`, computed by its series.
pub(super) fn by_series<G: LieGroup + ?Sized>(
    group: &G,
    x: &G::Vector,
    v: &G::Vector,
) -> G::Vector {
    let v = DVector::from_column_slice(v.components());
    G::Vector::from_components((phi1(&ad(group, x)) * v).as_slice())
}

/// The operator `T_left(x)^-1 v`, computed by its series. Returns an error if the operator is
/// singular up to rounding errors, because an eigenvalue of `ad_x` is near `2 pi i k`.
pub(super) fn inverse_by_series<G: LieGroup + ?Sized>(
    group: &G,
    x: &G::Vector,
    v: &G::Vector,
) -> Result<G::Vector, Error> {
    let v = DVector::from_column_slice(v.components());
    let singular = || Law::RegularTangent.broken([format!("{:?}", x.components())], "0");
    let ad = ad(group, x);
    let operator = phi1(&ad);
    if !operator.iter().all(|entry| entry.is_finite()) {
        return Err(singular());
    }
    if turns(&ad) {
        // the rounding error of an oscillation is proportional to its angle in radians
        let rounding = f64::EPSILON * ad.nrows() as f64 * (1.0 + ad.norm());
        let steps = 100 * ad.nrows();
        let svd = SVD::try_new(operator.clone(), false, false, f64::EPSILON, steps);
        let sizes = svd.ok_or_else(singular)?.singular_values;
        // the comparison `>` also rejects NaN
        let regular = sizes.min() > rounding * sizes.max();
        if !regular {
            return Err(singular());
        }
    }
    let solution = operator.lu().solve(&v).filter(|u| u.iter().all(|u| u.is_finite()));
    let solution = solution.ok_or_else(singular)?;
    Ok(G::Vector::from_components(solution.as_slice()))
}

/// The operator `T_left(x) v = v - c_2 [x, v] + c_3 [x, [x, v]]` with the Stumpff functions of
/// `z(x)`. The function `z` is a quadratic form.
pub(super) fn cubic<G: LieGroup>(
    group: &G,
    form: impl Fn(&G::Vector) -> f64,
    x: &G::Vector,
    v: &G::Vector,
) -> G::Vector {
    let z = form(x);
    if z > FAR {
        // for a large angle, only the mean over a full turn is accurate; it is the part that
        // commutes with x
        let unit = x.clone() * x.largest().recip();
        let twice = group.bracket(&unit, &group.bracket(&unit, v));
        return v.clone() + twice * form(&unit).recip();
    }
    let c = Stumpff::at(z);
    let once = group.bracket(x, v);
    v.clone() - once.clone() * c.c2 + group.bracket(x, &once) * c.c3
}

/// The operator `T_left(x)^-1 v = v + [x, v]/2 + d [x, [x, v]]`, where [`inverse_tangent`] at
/// `z(x)` computes `d`. It is singular at `z = (2 pi k)^2`, `k > 0`, up to the rounding error of
/// `z`. The magnitudes of the terms of `z` have the sum `size`.
pub(super) fn cubic_inverse<G: LieGroup>(
    group: &G,
    [z, size]: [f64; 2],
    x: &G::Vector,
    v: &G::Vector,
) -> Result<G::Vector, Error> {
    let singular = || Law::RegularTangent.broken([format!("{:?}", x.components())], "0");
    let d = inverse_tangent(z, size).filter(|_| z <= FAR).ok_or_else(singular)?;
    let once = group.bracket(x, v);
    Ok(v.clone() + once.clone() * 0.5 + group.bracket(x, &once) * d)
}

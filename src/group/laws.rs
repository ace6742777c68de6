//! The laws of a Lie group, as checks for any implementation of [`LieGroup`].
//!
//! The two sides of a law may differ by a tolerance that is relative to their sizes. The tolerances
//! are suitable for vectors with components between -1 and 1.

use super::{Coordinates, LieGroup, TranslationSplit};
use crate::Error;
use nalgebra::{DMatrix, DVector};

/// A violated law of a group, with the two sides of its equation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{law} fails: {sides} differ by {defect:e}, relative to their size")]
pub struct BrokenGroupLaw {
    /// The law, as a formula.
    pub law: &'static str,
    /// The relative difference of the sides. It is infinite if a side does not exist.
    pub defect: f64,
    /// The two sides, or the error of a side that does not exist.
    pub sides: String,
}

type Check = Result<(), BrokenGroupLaw>;

/// Checks all laws on three vectors.
///
/// ```
/// use affinor::group::{Se3, laws};
/// use nalgebra::Vector6;
/// let [x, y, z] = [0.1, -0.7, 0.4].map(|a| Vector6::from_fn(|i, _| a - 0.1 * i as f64));
/// laws::all(&Se3, &x, &y, &z)?;
/// # Ok::<(), laws::BrokenGroupLaw>(())
/// ```
///
/// # Errors
/// The first law that is violated.
pub fn all<G: LieGroup>(
    group: &G,
    x: &G::Vector,
    y: &G::Vector,
    z: &G::Vector,
) -> Result<(), BrokenGroupLaw> {
    axioms(group, x, y, z)?;
    exponential(group, x)?;
    interpolation(group, x, y)?;
    adjoint(group, x, y, z)?;
    tangents(group, &(x.clone() * 2.0), z)?;
    // checks a vector that is so short that closed forms use their series
    tangents(group, &(x.clone() * 1e-5), z)
}

/// Checks the group axioms for `exp(x)`, `exp(y)`, `exp(z)`.
fn axioms<G: LieGroup>(group: &G, x: &G::Vector, y: &G::Vector, z: &G::Vector) -> Check {
    let (g, h, k) = (group.exp(x), group.exp(y), group.exp(z));
    let e = group.identity();
    // compares by matrices first, because inverse and logarithm, which other comparisons use, may
    // be wrong
    let equal = |law, g: &G::Element, h| near(law, &group.matrix(g), &group.matrix(h), 1e-12);
    equal("g e = g", &group.compose(&g, &e), &g)?;
    equal("e g = g", &group.compose(&e, &g), &g)?;
    equal("g^-1 g = e", &group.compose(&group.inverse(&g), &g), &e)?;
    let law = "log(e) = 0";
    close(law, &exists(law, group.log(&e))?, &(x.clone() * 0.0), 1e-14)?;
    same("g e = g", group, &group.compose(&g, &e), &g, 1e-13)?;
    same("e g = g", group, &group.compose(&e, &g), &g, 1e-13)?;
    same("g g^-1 = e", group, &group.compose(&g, &group.inverse(&g)), &e, 1e-12)?;
    same("exp(0) = e", group, &group.exp(&(x.clone() * 0.0)), &e, 1e-14)?;
    let [gh, hk] = [group.compose(&g, &h), group.compose(&h, &k)];
    same("(g h) k = g (h k)", group, &group.compose(&gh, &k), &group.compose(&g, &hk), 1e-11)
}

/// Checks `exp` and `log`, and that `exp(t x)` is the one-parameter group (25) with velocity `x` at
/// the identity.
fn exponential<G: LieGroup>(group: &G, x: &G::Vector) -> Check {
    let g = group.exp(x);
    let log = exists("log(exp(x)) = x", group.log(&g))?;
    close("log(exp(x)) = x", &log, x, 1e-11)?;
    same("exp(log(g)) = g", group, &group.exp(&log), &g, 1e-11)?;
    let part = |t: f64| group.exp(&(x.clone() * t));
    let product = group.compose(&part(0.3), &part(0.7));
    same("exp(0.3 x) exp(0.7 x) = exp(x)", group, &product, &g, 1e-11)?;
    same("exp(-x) = exp(x)^-1", group, &part(-1.0), &group.inverse(&g), 1e-11)?;
    let difference = |h: f64| (group.matrix(&part(h)) - group.matrix(&part(-h))) / (2.0 * h);
    let velocity = (difference(1e-4) * 4.0 - difference(2e-4)) / 3.0;
    near("exp(d/dt exp(t x) at 0) = exp(x), of matrices", &velocity.exp(), &group.matrix(&g), 1e-9)
}

/// Checks `between`, `interpolate` and `mean` for `exp(x)` and `exp(y)`.
fn interpolation<G: LieGroup>(group: &G, x: &G::Vector, y: &G::Vector) -> Check {
    // uses elements that are close to each other, because a product of distant elements may have no
    // logarithm
    let [g, h] = [x, y].map(|x| group.exp(&(x.clone() * 0.3)));
    same("g (g^-1 h) = h", group, &group.compose(&g, &group.between(&g, &h)), &h, 1e-12)?;
    let at = |t: f64| exists("interpolate(g, h, t)", group.interpolate(&g, &h, t));
    same("interpolate(g, h, 0) = g", group, &at(0.0)?, &g, 1e-12)?;
    same("interpolate(g, h, 1) = h", group, &at(1.0)?, &h, 1e-11)?;
    let law = "mean(g, h) = interpolate(g, h, 1/2)";
    let mean = exists(law, group.mean(&[g.clone(), h.clone()]))?;
    same(law, group, &mean, &at(0.5)?, 1e-11)
}

/// Checks that `Ad` is a representation by automorphisms and the exponential of `ad`, that `g
/// exp(v) g^-1 = exp(Ad_g v)`, and the Jacobi identity.
fn adjoint<G: LieGroup>(group: &G, x: &G::Vector, y: &G::Vector, v: &G::Vector) -> Check {
    let (g, h) = (group.exp(x), group.exp(y));
    let twice = group.adjoint(&g, &group.adjoint(&h, v));
    close("Ad_gh = Ad_g Ad_h", &group.adjoint(&group.compose(&g, &h), v), &twice, 1e-11)?;
    let matrix = group.operator_matrix(|v| group.adjoint(&g, v));
    near("Ad_exp(x) = exp(ad_x)", &matrix, &ad(group, x).exp(), 1e-11)?;
    let moved = group.bracket(&group.adjoint(&g, y), &group.adjoint(&g, v));
    let image = group.adjoint(&g, &group.bracket(y, v));
    close("Ad_g [y, v] = [Ad_g y, Ad_g v]", &image, &moved, 1e-11)?;
    let conjugate = group.compose(&group.compose(&g, &group.exp(v)), &group.inverse(&g));
    let image = group.matrix(&group.exp(&group.adjoint(&g, v)));
    near("exp(Ad_g v) = g exp(v) g^-1", &image, &group.matrix(&conjugate), 1e-9)?;
    let paired = |covector: &G::Vector, v: &G::Vector| -> f64 {
        covector.components().iter().zip(v.components()).map(|(h, v)| h * v).sum()
    };
    let [left, right] = [(&group.coadjoint(&g, y), v), (y, &group.adjoint(&g, v))]
        .map(|(h, v)| DMatrix::from_element(1, 1, paired(h, v)));
    near("(Ad*_g h)(v) = h(Ad_g v)", &left, &right, 1e-11)?;
    let law = "Ad*_exp(x) is coadjoint_exp(x)";
    close(law, &group.coadjoint_exp(x, y), &group.coadjoint(&g, y), 1e-11)?;
    let commutator = ad(group, x) * ad(group, y) - ad(group, y) * ad(group, x);
    let law = "ad_[x,y] = ad_x ad_y - ad_y ad_x";
    near(law, &ad(group, &group.bracket(x, y)), &commutator, 1e-12)
}

/// Checks the laws of a [`TranslationSplit`]. The closed forms at `exp(x)`, `exp(y)` and the
/// covector `h` must agree with their definitions.
///
/// # Errors
/// The first law that is violated.
pub fn translations<G: TranslationSplit>(
    group: &G,
    x: &G::Vector,
    y: &G::Vector,
    h: &G::Vector,
) -> Result<(), BrokenGroupLaw> {
    let (g, k) = (group.exp(x), group.linear_part(&group.exp(y)));
    let between = group.between(&group.linear_part(&g), &k);
    same(
        "relative_linear_part(g, k) = k_g^-1 k",
        group,
        &group.relative_linear_part(&g, &k),
        &between,
        1e-14,
    )?;
    let back = group.coadjoint(&group.inverse(&k), h);
    close("coadjoint_inverse(k, h) = Ad*_(k^-1) h", &group.coadjoint_inverse(&k, h), &back, 1e-13)?;
    let products = group.basis().into_iter().map(|e| {
        let translation = group.translational_part(&e)?;
        Some(h.components().iter().zip(translation.components()).map(|(h, p)| h * p).sum())
    });
    let law = "translational_momentum(h) = P* h";
    match (group.translational_momentum(h), products.collect::<Option<Vec<f64>>>()) {
        (Some(along), Some(products)) => {
            close(law, &along, &G::Vector::from_components(&products), 0.0)
        }
        (None, None) => Ok(()),
        sides => Err(BrokenGroupLaw { law, defect: f64::INFINITY, sides: format!("{sides:?}") }),
    }
}

/// Checks the tangent operators at `x`: they agree with their series and their inverses, and they
/// are derivatives of `exp` along `v`.
fn tangents<G: LieGroup>(group: &G, x: &G::Vector, v: &G::Vector) -> Check {
    let g = group.exp(x);
    let n = group.dimension();
    let (mut term, mut series) = (DMatrix::identity(n, n), DMatrix::zeros(n, n));
    for k in 1..=80 {
        series += &term / f64::from(k);
        term = -ad(group, x) * term / f64::from(k);
    }
    let matrix = group.operator_matrix(|v| group.tangent_left(x, v));
    near("T_left(x) = sum (-ad_x)^k/(k+1)!", &matrix, &series, 1e-11)?;
    let [left, right] = [group.tangent_left(x, v), group.tangent_right(x, v)];
    close("T_right(x) = Ad_exp(x) T_left(x)", &right, &group.adjoint(&g, &left), 1e-10)?;
    for (law, found) in [
        ("T_left(x)^-1 T_left(x) = 1", group.tangent_left_inverse(x, &left)),
        ("T_right(x)^-1 T_right(x) = 1", group.tangent_right_inverse(x, &right)),
        (
            "T_left(x) T_left(x)^-1 = 1",
            group.tangent_left_inverse(x, v).map(|u| group.tangent_left(x, &u)),
        ),
    ] {
        close(law, &exists(law, found)?, v, 1e-9)?;
    }
    let moved = |h: f64| group.exp(&(x.clone() + v.clone() * h));
    let from_left = |h: f64| group.between(&g, &moved(h));
    let from_right = |h: f64| group.compose(&moved(h), &group.inverse(&g));
    let slope = |law, path: &dyn Fn(f64) -> G::Element| {
        let [ahead, behind] = [1e-4, -1e-4].map(|h| exists(law, group.log(&path(h))));
        Ok((ahead? - behind?) * 0.5e4)
    };
    let law = "d/dh log(exp(x)^-1 exp(x + h v)) = T_left(x) v";
    close(law, &slope(law, &from_left)?, &left, 1e-6)?;
    let law = "d/dh log(exp(x + h v) exp(x)^-1) = T_right(x) v";
    close(law, &slope(law, &from_right)?, &right, 1e-6)
}

/// Checks that the matrices of elements multiply as the elements do. Not every group satisfies this
/// law, because [`Opposite`](super::Opposite) reverses products.
///
/// # Errors
/// The law, if the group violates it.
pub fn represented<G: LieGroup>(
    group: &G,
    x: &G::Vector,
    y: &G::Vector,
) -> Result<(), BrokenGroupLaw> {
    let (g, h) = (group.exp(x), group.exp(y));
    let product = group.matrix(&g) * group.matrix(&h);
    let law = "matrix(g h) = matrix(g) matrix(h)";
    near(law, &group.matrix(&group.compose(&g, &h)), &product, 1e-12)
}

fn ad<G: LieGroup>(group: &G, x: &G::Vector) -> DMatrix<f64> {
    group.operator_matrix(|v| group.bracket(x, v))
}

fn exists<T>(law: &'static str, side: Result<T, Error>) -> Result<T, BrokenGroupLaw> {
    side.map_err(|error| BrokenGroupLaw { law, defect: f64::INFINITY, sides: error.to_string() })
}

fn near(law: &'static str, a: &DMatrix<f64>, b: &DMatrix<f64>, tolerance: f64) -> Check {
    let defect = (a - b).norm() / (1.0 + a.norm() + b.norm());
    // the comparison `<=` also rejects NaN
    if defect <= tolerance {
        return Ok(());
    }
    Err(BrokenGroupLaw { law, defect, sides: format!("{a}and {b}") })
}

fn close<V: Coordinates>(law: &'static str, x: &V, y: &V, tolerance: f64) -> Check {
    let column = |x: &V| DMatrix::from_column_slice(x.components().len(), 1, x.components());
    near(law, &column(x), &column(y), tolerance)
}

/// Checks that two elements are equal. The matrices are compared, and the logarithm of `g^-1 h`
/// must be small.
fn same<G: LieGroup>(
    law: &'static str,
    group: &G,
    g: &G::Element,
    h: &G::Element,
    tolerance: f64,
) -> Check {
    near(law, &group.matrix(g), &group.matrix(h), tolerance)?;
    let size = 1.0 + group.matrix(g).norm() * group.matrix(&group.inverse(g)).norm();
    let log = exists(law, group.log(&group.between(g, h)))?;
    let defect = DVector::from_column_slice(log.components()).norm() / size;
    if defect <= tolerance {
        return Ok(());
    }
    Err(BrokenGroupLaw { law, defect, sides: format!("{g:?} and {h:?}") })
}

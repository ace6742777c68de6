//! The body and spatial velocity of a path in a group.

use super::fields::right_translate;
use super::{Coordinates, LieGroup};
use crate::Error;
use affinor_tensors::stop::checkpoint;

/// The velocity `g'` of a path, translated to the identity: `g' = L_g* body` (55) and
/// `g' = R_g* spatial` (59).
///
/// For matrices, the velocities are `g^-1 g'` and `g' g^-1`; for rotations, they are `Omega` and
/// `omega`. They are related by `spatial = Ad_g body`, equations (10), (57).
///
/// ```
/// use affinor::group::velocity::Velocity;
/// use affinor::group::{LieGroup, So3};
/// use nalgebra::Vector3;
/// // precession about z at the rate 2 of a top that leans by 0.3 and spins at the rate 5
/// let top = |t: f64| {
///     let turns = [Vector3::z() * (2.0 * t), Vector3::x() * 0.3, Vector3::z() * (5.0 * t)];
///     turns.iter().fold(So3.identity(), |g, x| So3.compose(&g, &So3.exp(x)))
/// };
/// let velocity = Velocity::of_path(&So3, top, 0.0, 0.02)?;
/// let leaning = Vector3::new(0.0, -0.3f64.sin(), 0.3f64.cos());
/// assert!((velocity.spatial - Vector3::z() * 2.0 - leaning * 5.0).norm() < 1e-9);
/// let vertical = Vector3::new(0.0, 0.3f64.sin(), 0.3f64.cos());
/// assert!((velocity.body - vertical * 2.0 - Vector3::z() * 5.0).norm() < 1e-9);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Velocity<V> {
    /// The body velocity `L_{g^-1}* g'`, which consists of the left components.
    pub body: V,
    /// The spatial velocity `R_{g^-1}* g'`, which consists of the right components.
    pub spatial: V,
}

/// The number of samples from which the velocity at one sample is computed.
const WINDOW: usize = 5;
/// The largest number of Newton steps from one sample to the next.
const MAX_STEPS: usize = 20;

impl<V: Coordinates> Velocity<V> {
    /// Computes both velocities from the body velocity at `g`.
    pub fn from_body<G: LieGroup<Vector = V>>(group: &G, g: &G::Element, body: V) -> Self {
        let spatial = group.adjoint(g, &body);
        Velocity { body, spatial }
    }

    /// Computes both velocities from the spatial velocity at `g`.
    pub fn from_spatial<G: LieGroup<Vector = V>>(group: &G, g: &G::Element, spatial: V) -> Self {
        let body = right_translate(group, &spatial, g);
        Velocity { body, spatial }
    }

    /// The velocity of the path `exp(x(t))`, computed from `x` and `dx/dt`. The velocities are
    /// `T_left(x) dx/dt` and `T_right(x) dx/dt`, on which equation (86) is based.
    pub fn in_coordinates<G: LieGroup<Vector = V>>(group: &G, x: &V, rate: &V) -> Self {
        Velocity { body: group.tangent_left(x, rate), spatial: group.tangent_right(x, rate) }
    }

    /// The velocity of a smooth path at the time `t`. It is extrapolated from central differences
    /// of `log(g(t)^-1 g(t + s))` over `step`, half of it and a quarter of it. The error is of
    /// order 6 in `step`, plus rounding errors divided by `step`. A suitable step is a hundredth to
    /// a tenth of the time scale on which the velocity changes.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the logarithm does not exist within `step`.
    pub fn of_path<G: LieGroup<Vector = V>>(
        group: &G,
        path: impl Fn(f64) -> G::Element,
        t: f64,
        step: f64,
    ) -> Result<Self, Error> {
        let g = path(t);
        let back = group.inverse(&g);
        let difference = |h: f64| -> Result<V, Error> {
            let at = |s: f64| group.log(&group.compose(&back, &path(t + s)));
            Ok((at(h)? - at(-h)?) * (0.5 / h))
        };
        let better = |fine: V, coarse: V, share: f64| fine.clone() + (fine - coarse) * share;
        let [coarse, half, quarter] =
            [difference(step)?, difference(0.5 * step)?, difference(0.25 * step)?];
        let second = better(quarter, half.clone(), 1.0 / 3.0);
        let body = better(second, better(half, coarse, 1.0 / 3.0), 1.0 / 15.0);
        Ok(Self::from_body(group, &g, body))
    }

    /// The velocity of a sampled path, at each sample. It is the slope of the polynomial through
    /// the five nearest samples, in canonical coordinates around the sample; at the ends, the
    /// samples are one-sided. The times need not be equidistant. The error is of order 4 in their
    /// distance; for `n < 5` samples, it is of order `n - 1`.
    ///
    /// Coordinates are continued from one sample to the next, so that only consecutive samples must
    /// be near each other. Consecutive rotations must differ by less than a half turn, and the
    /// samples that are used together by less than a whole turn.
    ///
    /// # Errors
    /// [`Error::Shape`] unless there are two or more samples with as many increasing times;
    /// [`Error::Invalid`] and [`Law::RegularTangent`](crate::Law::RegularTangent) for samples that
    /// are too far apart.
    pub fn of_samples<G: LieGroup<Vector = V>>(
        group: &G,
        times: &[f64],
        path: &[G::Element],
    ) -> Result<Vec<Self>, Error> {
        check(times, path.len())?;
        let size = WINDOW.min(path.len());
        let at = |i: usize| {
            let first = i.saturating_sub(size / 2).min(path.len() - size);
            let mut body = V::zeros(group.dimension());
            let back = group.inverse(&path[i]);
            for indices in [(i + 1..first + size).collect::<Vec<_>>(), (first..i).rev().collect()] {
                let mut x = V::zeros(group.dimension());
                for k in indices {
                    x = continued(group, &x, &group.compose(&back, &path[k]))?;
                    body = body
                        + x.clone() * weight(&times[first..first + size], i - first, k - first);
                }
            }
            Ok(Self::from_body(group, &path[i], body))
        };
        (0..path.len()).map(at).collect()
    }
}

fn check(times: &[f64], samples: usize) -> Result<(), Error> {
    let refused = |expected: &str, found: String| {
        Err(Error::Shape { what: "the sampled path", expected: expected.into(), found })
    };
    if samples < 2 || times.len() != samples {
        let found = format!("{samples} samples at {} times", times.len());
        return refused("two or more samples, each with its time", found);
    }
    let late = times.windows(2).find(|pair| !(pair[1] - pair[0] > 0.0 && pair[1].is_finite()));
    let late = late.or_else(|| times[..1].iter().find(|t| !t.is_finite()).map(|_| &times[..2]));
    late.map_or(Ok(()), |t| refused("increasing times", format!("{} after {}", t[1], t[0])))
}

/// The weight of the value at `times[k]` in the slope of the interpolation polynomial at
/// `times[i]`.
fn weight(times: &[f64], i: usize, k: usize) -> f64 {
    let others = (0..times.len()).filter(|m| *m != i && *m != k);
    let ratio = |m: usize| (times[i] - times[m]) / (times[k] - times[m]);
    others.map(ratio).product::<f64>() / (times[k] - times[i])
}

/// The logarithm of `g` near `x`, computed by Newton's method from `x`. At `x = 0`, it is `log`.
fn continued<G: LieGroup>(group: &G, x: &G::Vector, g: &G::Element) -> Result<G::Vector, Error> {
    let mut x = x.clone();
    for _ in 0..MAX_STEPS {
        checkpoint();
        let rest = group.log(&group.compose(&group.exp(&-x.clone()), g))?;
        let step = group.tangent_left_inverse(&x, &rest)?;
        x = x + step.clone();
        // Newton's method converges quadratically, so the remaining error is the square of the step
        if step.largest() <= 1e-12 * (1.0 + x.largest()) {
            return Ok(x);
        }
    }
    let reason =
        format!("the samples are too far apart: no logarithm is found near {:?}", x.components());
    Err(Error::Invalid { what: "logarithm", reason })
}

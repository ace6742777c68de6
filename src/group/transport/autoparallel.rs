//! Autoparallels of a connection on a group, which are geodesics for the Levi-Civita connection.

use super::ParallelTranslation;
use crate::Error;
use crate::group::{Coordinates, LieGroup};
use crate::numerics::ode;
use crate::numerics::shooting::{Equations, newton};
use nalgebra::DVector;

/// The largest number of charts between two output times.
const MAX_CHARTS: f64 = 1e5;

/// A tangent vector of a group with its base point.
#[derive(Clone, Debug)]
pub struct TangentVector<G: LieGroup> {
    /// The element of the group.
    pub base: G::Element,
    /// The vector at the base point, in left components.
    pub left: G::Vector,
}

impl<G: LieGroup> ParallelTranslation<G> {
    /// The autoparallel (B7) that starts at time 0 at `start` with the tangent `n` (left
    /// components). Returns its tangent vector at each of the times.
    ///
    /// The method solves `dn/dt = -Lambda_n n`, and `g' = g n` in the coordinates `g = g_0 exp(x)`,
    /// where `dx/dt = T_left(x)^-1 n`. It changes to a new chart before `x` becomes large, so all
    /// elements belong to the group.
    ///
    /// # Errors
    /// [`Error::Integration`], for example if the autoparallel diverges in finite time.
    #[doc(alias("geodesic"))]
    pub fn autoparallel(
        &self,
        start: &G::Element,
        n: &G::Vector,
        times: &[f64],
        tolerance: f64,
    ) -> Result<Vec<TangentVector<G>>, Error> {
        let (mut t, mut g, mut n) = (0.0, start.clone(), n.clone());
        let mut values = Vec::with_capacity(times.len());
        for &end in times {
            while t != end {
                let next = self.next_chart(t, end, &n)?;
                let (x, tangent) = self.in_chart(&n, t, next, tolerance)?;
                (g, n, t) = (self.group().compose(&g, &self.group().exp(&x)), tangent, next);
            }
            values.push(TangentVector { base: g.clone(), left: n.clone() });
        }
        Ok(values)
    }

    /// The tangent at `from`, in left components, of an autoparallel that reaches `to` at time 1.
    /// For the connections `plus`, `zero` and `minus`, the tangent is the logarithm of
    /// `from^-1 to`.
    ///
    /// Newton's method solves the equation for the end point, starting from the logarithm. Other
    /// solutions may exist.
    ///
    /// # Errors
    /// [`Error::Invalid`] if `from^-1 to` has no logarithm; [`Error::Integration`] if no
    /// autoparallel is found.
    pub fn autoparallel_between(
        &self,
        from: &G::Element,
        to: &G::Element,
        tolerance: f64,
    ) -> Result<G::Vector, Error> {
        let group = self.group();
        let start = group.log(&group.compose(&group.inverse(from), to))?;
        let problem = Between { translation: self, from, there: group.inverse(to), tolerance };
        let reached = newton(&problem, DVector::from_column_slice(start.components()))?;
        if reached.miss.amax() <= tolerance {
            return Ok(G::Vector::from_components(reached.unknowns.as_slice()));
        }
        let reason = format!(
            "no autoparallel found: the nearest one misses the end point by {:e}",
            reached.miss.amax()
        );
        Err(Error::Integration { t: 1.0, reason })
    }

    /// The end of the time interval in which the chart around the current point is used.
    fn next_chart(&self, t: f64, end: f64, n: &G::Vector) -> Result<f64, Error> {
        let ad = self.group().operator_matrix(|v| self.group().bracket(n, v));
        let reach = 0.5 / ad.norm().max(f64::MIN_POSITIVE);
        if (end - t).abs() <= reach {
            return Ok(end);
        }
        if (end - t).abs() < MAX_CHARTS * reach {
            return Ok(t + reach.copysign(end - t));
        }
        Err(Error::Integration {
            t,
            reason: format!("the autoparallel turns too fast to reach t = {end}"),
        })
    }

    /// Integrates the autoparallel that starts at the time `t` from the origin of the chart.
    /// Returns the coordinates and the tangent at the time `end`.
    fn in_chart(
        &self,
        n: &G::Vector,
        t: f64,
        end: f64,
        tolerance: f64,
    ) -> Result<(G::Vector, G::Vector), Error> {
        let d = self.group().dimension();
        let f = |_: f64, y: &DVector<f64>| {
            let slopes = || -> Result<DVector<f64>, Error> {
                let x = G::Vector::from_components(&y.as_slice()[..d]);
                let n = G::Vector::from_components(&y.as_slice()[d..]);
                let position = self.group().tangent_left_inverse(&x, &n)?;
                let tangent = self.generator(&n)? * DVector::from_column_slice(n.components());
                let both = position.components().iter().chain(tangent.iter()).copied();
                Ok(DVector::from_iterator(2 * d, both))
            };
            slopes().unwrap_or_else(|_| DVector::repeat(2 * d, f64::NAN))
        };
        let y0 = std::iter::repeat_n(0.0, d).chain(n.components().iter().copied());
        let y = ode::solve(f, t, DVector::from_iterator(2 * d, y0), &[end], tolerance)?;
        let (x, n) = y[0].as_slice().split_at(d);
        Ok((G::Vector::from_components(x), G::Vector::from_components(n)))
    }
}

/// The equations for an autoparallel between two elements. The unknowns are the tangent at the
/// start, and the miss is the logarithm of the end in the frame of the given end.
struct Between<'t, G: LieGroup> {
    translation: &'t ParallelTranslation<G>,
    from: &'t G::Element,
    /// The inverse of the given end.
    there: G::Element,
    tolerance: f64,
}

impl<G: LieGroup> Equations for Between<'_, G> {
    fn miss(&self, unknowns: &DVector<f64>, tolerance: f64) -> Result<DVector<f64>, Error> {
        let group = self.translation.group();
        let n = G::Vector::from_components(unknowns.as_slice());
        let end = self.translation.autoparallel(self.from, &n, &[1.0], tolerance)?;
        let x = group.log(&group.compose(&self.there, &end[0].base))?;
        Ok(DVector::from_column_slice(x.components()))
    }

    fn sizes(&self) -> DVector<f64> {
        DVector::from_element(self.translation.group().dimension(), 1.0)
    }

    fn allowed(&self, _: &DVector<f64>) -> f64 {
        self.tolerance
    }

    fn is_solved(&self, miss: &DVector<f64>) -> bool {
        miss.amax() <= self.tolerance
    }

    fn tolerances(&self) -> [f64; 2] {
        // uses a smaller tolerance, because differences of end points are computed
        [(1e-3 * self.tolerance).clamp(1e-14, 1e-9); 2]
    }
}

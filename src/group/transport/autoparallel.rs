//! Autoparallels of a connection on a group, which are geodesics for the Levi-Civita connection.

use super::ParallelTranslation;
use crate::Error;
use crate::group::{Coordinates, LieGroup};
use crate::numerics::ode;
use nalgebra::{DMatrix, DVector};

/// The largest number of charts between two output times.
const MAX_CHARTS: f64 = 1e5;
/// The largest number of Newton steps for an autoparallel between two points.
const MAX_STEPS: usize = 50;

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
        let there = group.inverse(to);
        // uses a smaller tolerance, because differences of end points are computed
        let fine = (1e-3 * tolerance).clamp(1e-14, 1e-9);
        let miss = |n: &G::Vector| -> Result<DVector<f64>, Error> {
            let end = self.autoparallel(from, n, &[1.0], fine)?;
            let x = group.log(&group.compose(&there, &end[0].base))?;
            Ok(DVector::from_column_slice(x.components()))
        };
        let mut n = group.log(&group.compose(&group.inverse(from), to))?;
        let mut residual = miss(&n)?;
        for _ in 0..MAX_STEPS {
            if residual.amax() <= tolerance {
                return Ok(n);
            }
            let h = 1e-5 * (1.0 + DVector::from_column_slice(n.components()).amax());
            let mut jacobian = DMatrix::zeros(group.dimension(), group.dimension());
            for (k, e) in group.basis().iter().enumerate() {
                let (ahead, behind) =
                    (miss(&(n.clone() + e.clone() * h))?, miss(&(n.clone() - e.clone() * h))?);
                jacobian.set_column(k, &((ahead - behind) / (2.0 * h)));
            }
            let Some(step) = jacobian.lu().solve(&residual) else { break };
            let step = G::Vector::from_components(step.as_slice());
            // halves a step until it reduces the residual
            let better = (0..20).find_map(|halvings| {
                let next = n.clone() - step.clone() * 0.5f64.powi(halvings);
                let missed = miss(&next).ok()?;
                (missed.norm() < residual.norm()).then_some((next, missed))
            });
            let Some((next, missed)) = better else { break };
            (n, residual) = (next, missed);
        }
        let reason = format!(
            "no autoparallel found: the nearest one misses the end point by {:e}",
            residual.amax()
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

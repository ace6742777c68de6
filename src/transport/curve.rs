//! Parallel translation along the curves of a group.

use crate::dense::to_dmatrix;
use crate::group::{Coordinates, LieGroup, expect_left_frame, series};
use crate::{Connection, Error, ode};
use nalgebra::{DMatrix, DVector};

/// Generators from here on are checked for what rounding leaves of their exponential, and this is too
/// much.
const LARGE: f64 = 1e8;
const NOISE: f64 = 1e-3;

/// A group with a left-invariant connection: what carries vectors along its curves, and the curves
/// that carry their own tangent.
///
/// Vectors are left components, as everywhere: a vector is translated from `p` to `q` by a matrix
/// `B` with `u(q) = B u(p)`, (49).
///
/// ```
/// use affinor::group::{LieGroup, So3};
/// use affinor::transport::ParallelTranslation;
/// use affinor::{Canonical, Connection};
/// use nalgebra::Vector3;
/// let so3 = So3.algebra()?;
/// let full_turn = Vector3::new(0.0, 0.0, std::f64::consts::TAU);
/// let around = |which| -> Result<_, affinor::Error> {
///     let on_group = ParallelTranslation::new(So3, Connection::canonical(&so3, which))?;
///     Ok(on_group.along_subgroup(&full_turn)?.trace())
/// };
/// // once around a closed subgroup: nothing on M(3), half a turn on SO(3), after (71)
/// assert!((around(Canonical::Plus)? - 3.0).abs() < 1e-14);
/// assert!((around(Canonical::Zero)? + 1.0).abs() < 1e-14);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct ParallelTranslation<G> {
    group: G,
    connection: Connection<f64>,
}

impl<G: LieGroup> ParallelTranslation<G> {
    /// Joins a group and a connection on its algebra, in the same basis.
    ///
    /// # Errors
    /// [`Error::Shape`] if the structure constants of the connection's frame are not those of the
    /// group, or the frame has derivations.
    pub fn new(group: G, connection: Connection<f64>) -> Result<Self, Error> {
        expect_left_frame(&group, connection.frame())?;
        Ok(ParallelTranslation { group, connection })
    }

    /// The group.
    pub fn group(&self) -> &G {
        &self.group
    }

    /// The connection.
    pub fn connection(&self) -> &Connection<f64> {
        &self.connection
    }

    /// From `g` to `g exp(x)` along `g exp(s x)`: `exp(-Lambda_x)`, in closed form whether or not
    /// that curve is autoparallel. (51) for `plus`, (71) for `zero`, the identity for `minus`.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::Integration`] for turns so many that rounding leaves nothing of the last.
    pub fn along_subgroup(&self, x: &G::Vector) -> Result<DMatrix<f64>, Error> {
        let generator = self.generator(x)?;
        let carried = series::exp(&generator);
        if generator.amax() < LARGE {
            return Ok(carried);
        }
        let n = generator.nrows();
        let noise = (&carried * series::exp(&-generator) - DMatrix::identity(n, n)).amax();
        if noise < NOISE {
            return Ok(carried);
        }
        let reason = format!("it turns too often, there and back is off by {noise:e}");
        Err(Error::Integration { t: 1.0, reason })
    }

    /// Along a sampled curve: the arcs `g_i exp(s x_i)` from one element to the next, with the
    /// logarithms `x_i`. Exact for curves made of such arcs, of second order in the distance of the
    /// samples for others. A loop gives its holonomy.
    ///
    /// # Errors
    /// [`Error::NoLogarithm`] where two neighbours are too far apart.
    pub fn along_samples(&self, curve: &[G::Element]) -> Result<DMatrix<f64>, Error> {
        let n = self.group.dimension();
        let mut carried = DMatrix::identity(n, n);
        for pair in curve.windows(2) {
            let step = self.group.compose(&self.group.inverse(&pair[0]), &pair[1]);
            carried = self.along_subgroup(&self.group.log(&step)?)? * carried;
        }
        Ok(carried)
    }

    /// Along a curve with the velocity `w(t) = g^-1 g'`, from the first of the times to each of
    /// them: `du/dt = -Lambda_w u` (B5) to a tolerance.
    ///
    /// # Errors
    /// [`Error::Integration`].
    pub fn along_curve(
        &self,
        velocity: impl Fn(f64) -> G::Vector,
        times: &[f64],
        tolerance: f64,
    ) -> Result<Vec<DMatrix<f64>>, Error> {
        let n = self.group.dimension();
        let Some(&start) = times.first() else { return Ok(vec![]) };
        let identity = DMatrix::<f64>::identity(n, n);
        let y0 = DVector::from_column_slice(identity.as_slice());
        let f = |t: f64, y: &DVector<f64>| match self.generator(&velocity(t)) {
            Ok(generator) => {
                let carried = DMatrix::from_column_slice(n, n, y.as_slice());
                DVector::from_column_slice((generator * carried).as_slice())
            }
            Err(_) => DVector::repeat(n * n, f64::NAN),
        };
        let values = ode::solve(f, start, y0, times, tolerance)?;
        Ok(values.iter().map(|y| DMatrix::from_column_slice(n, n, y.as_slice())).collect())
    }

    pub(super) fn generator(&self, w: &G::Vector) -> Result<DMatrix<f64>, Error> {
        to_dmatrix(&self.connection.transport_along(w.components())?)
    }
}

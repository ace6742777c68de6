//! Parallel transport along curves of a group, the generator of the transport, and autoparallels.

mod autoparallel;

pub use autoparallel::TangentVector;

use super::matrices::expect_shape;
use super::{Coordinates, LieGroup, expect_left_frame};
use crate::algebra::frame::{expect_slots, formula};
use crate::numerics::rounding::expect_digits;
use crate::numerics::{exponential, ode};
use crate::{Connection, Error, Law};
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Scalar, Tensor, Up};
use nalgebra::{DMatrix, DVector};

impl<S: Scalar> Connection<S> {
    /// The generator `G` of parallel transport along a curve with the tangent `w`, slots `^i_k`.
    /// The transport equation is `du/dt = G u` with `G^i_k = -Lambda^i_jk w^j`, from (42), (B5).
    ///
    /// # Errors
    /// [`Error::Shape`].
    pub fn transport_along(&self, w: &[S]) -> Result<Tensor<S>, Error> {
        let vector = Tensor::vector(w, Up).with_tolerance(self.affinities().tolerance());
        expect_slots("the direction", &vector, self.frame().dimension(), &[Up])?;
        Ok(formula("-1 L^i_jk w^j -> ^i_k", &[("L", self.affinities()), ("w", &vector)]))
    }

    /// The generator of parallel transport along the autoparallel with the constant tangent `n`,
    /// equation (45).
    ///
    /// The generator is `-ad_n` for `plus`, `-ad_n/2` for `zero`, and 0 for `minus`.
    ///
    /// # Errors
    /// [`Law::ConstantTangent`] unless `Lambda^i_jk n^j n^k = 0` (B7), because otherwise the
    /// tangent of the autoparallel is not constant in this frame. [`Error::Shape`].
    pub fn transport_generator(&self, n: &[S]) -> Result<Tensor<S>, Error> {
        let generator = self.transport_along(n)?;
        let vector = Tensor::vector(n, Up).with_tolerance(self.affinities().tolerance());
        let drift = formula("-1 G^i_k n^k -> ^i", &[("G", &generator), ("n", &vector)]);
        if drift.is_empty() {
            return Ok(generator);
        }
        let drift = drift.to_vector().unwrap_or_default();
        let write = |components: Vec<S>| self.frame().write(components);
        Err(Law::ConstantTangent.broken([write(n.to_vec())], write(drift)))
    }
}

/// If a generator is larger than `LARGE`, the rounding error of the exponential is checked. The
/// error may be at most `NOISE`.
const LARGE: f64 = 1e8;
const NOISE: f64 = 1e-3;

/// A group with a left-invariant connection: parallel transport along curves, and autoparallels.
///
/// Vectors are lists of left components. A matrix `B` transports a vector from `p` to `q`:
/// `u(q) = B u(p)` (49).
///
/// ```
/// use affinor::group::{LieGroup, So3};
/// use affinor::group::transport::ParallelTranslation;
/// use affinor::{CanonicalConnection, Connection};
/// use nalgebra::Vector3;
/// let so3 = So3.algebra()?;
/// let full_turn = Vector3::new(0.0, 0.0, std::f64::consts::TAU);
/// let around = |which| -> Result<_, affinor::Error> {
///     let on_group = ParallelTranslation::new(So3, Connection::canonical(&so3, which))?;
///     Ok(on_group.along_subgroup(&full_turn)?.trace())
/// };
/// // once around a closed subgroup: nothing on M(3), half a turn on SO(3), after (71)
/// assert!((around(CanonicalConnection::Plus)? - 3.0).abs() < 1e-14);
/// assert!((around(CanonicalConnection::Zero)? + 1.0).abs() < 1e-14);
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("parallel transport", "holonomy"))]
#[derive(Clone, Debug)]
pub struct ParallelTranslation<G> {
    group: G,
    connection: Connection<f64>,
}

impl<G: LieGroup> ParallelTranslation<G> {
    /// Combines a group with a connection on its algebra. Both must use the same basis.
    ///
    /// # Errors
    /// [`Error::Shape`] if the structure constants of the connection's frame differ from those of
    /// the group, or if the frame has derivations.
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

    /// The matrix of transport from `g` to `g exp(x)` along the curve `g exp(s x)`. The matrix is
    /// `exp(-Lambda_x)`, whether or not the curve is an autoparallel. It is equation (51) for
    /// `plus`, equation (71) for `zero`, and the identity for `minus`.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::Integration`] if the number of turns is so large that the
    /// rounding error of the angle exceeds a turn.
    pub fn along_subgroup(&self, x: &G::Vector) -> Result<DMatrix<f64>, Error> {
        let generator = self.generator(x)?;
        let carried = exponential::exp(&generator);
        if generator.amax() < LARGE || exponential::balanced(&generator).0.amax() < LARGE {
            return Ok(carried);
        }
        let n = generator.nrows();
        let noise = (&carried * exponential::exp(&-generator) - DMatrix::identity(n, n)).amax();
        if noise < NOISE {
            return Ok(carried);
        }
        let reason = format!(
            "the transported vectors rotate too often: the transport there and back differs from 1 by {noise:e}"
        );
        Err(Error::Integration { t: 1.0, reason })
    }

    /// The matrix of transport along the arcs `exp(s x_1)`, then `exp(x_1) exp(s x_2)`, and so on.
    /// The parameter of each arc is `0 <= s <= 1`.
    ///
    /// # Errors
    /// The errors of [`along_subgroup`](Self::along_subgroup). [`Error::Invalid`] if large matrices
    /// cancel, so that rounding errors may change more than a millionth of the product. This occurs
    /// for long arcs of a noncompact group that return to their start.
    pub fn along_arcs(&self, arcs: &[G::Vector]) -> Result<DMatrix<f64>, Error> {
        let n = self.group.dimension();
        let mut carried = DMatrix::identity(n, n);
        // computes the same product again, with a rounding error in every entry
        let mut rounded = carried.clone();
        let mut signs = signs();
        for x in arcs {
            checkpoint();
            let arc = self.along_subgroup(x)?;
            rounded = arc.map(|entry| entry * (1.0 + f64::EPSILON * signs())) * rounded;
            carried = arc * carried;
        }
        expect_part("arcs", (rounded - &carried).amax() / carried.amax())?;
        Ok(carried)
    }

    /// Transports a vector from the start of a path to its end. The matrix `path` is the matrix of
    /// transport along the path.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::Invalid`] if large numbers cancel, so that rounding errors may
    /// change more than a millionth of the result.
    pub fn carry(&self, path: &DMatrix<f64>, u: &G::Vector) -> Result<DVector<f64>, Error> {
        let n = self.group.dimension();
        expect_shape(path, (n, n))?;
        let u = DVector::from_column_slice(u.components());
        let carried = path * &u;
        let terms = path.abs() * u.abs();
        expect_part("matrix", f64::EPSILON * terms.amax() / carried.amax())?;
        Ok(carried)
    }

    /// The matrix of transport along a sampled curve. The arcs from one element to the next are
    /// `g_i exp(s x_i)`, where `x_i` are the logarithms. The result is exact for curves that
    /// consist of such arcs; otherwise its error is of second order in the distance of the samples.
    /// The result for a loop is its holonomy.
    ///
    /// # Errors
    /// [`Error::Invalid`] if two consecutive samples are too far apart.
    pub fn along_samples(&self, curve: &[G::Element]) -> Result<DMatrix<f64>, Error> {
        let arc = |pair: &[G::Element]| self.group.log(&self.group.between(&pair[0], &pair[1]));
        self.along_arcs(&curve.windows(2).map(arc).collect::<Result<Vec<_>, _>>()?)
    }

    /// The matrices of transport along a curve with the velocity `w(t) = g^-1 g'`, from the first
    /// time to each of the times. The method solves `du/dt = -Lambda_w u` (B5) to a tolerance.
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

    fn generator(&self, w: &G::Vector) -> Result<DMatrix<f64>, Error> {
        Ok(self.connection.transport_along(w.components())?.to_dmatrix()?)
    }
}

/// Returns an error if rounding errors may change a large part of the result.
fn expect_part(what: &str, lost: f64) -> Result<(), Error> {
    expect_digits("parallel translation", lost, |lost| {
        format!(
            "the arcs are too long: rounding errors of the {what} may change the result by {lost} of its size"
        )
    })
}

/// A fixed irregular sequence of signs.
fn signs() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        if state >> 63 == 0 { 1.0 } else { -1.0 }
    }
}

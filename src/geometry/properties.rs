//! Properties of connections and metrics. A property holds, possibly with a value such as a
//! constant, or it fails. A property that fails has a nonzero component as a witness.

mod einstein;
mod invariant;
mod isometries;
mod linear_system;
mod sectional;
mod soliton;

pub use sectional::{Extreme, MAX_SEARCHED};
pub use soliton::Soliton;

pub(super) use invariant::symmetric_invariants;
pub(super) use isometries::triples;
pub(super) use linear_system::LinearSystem;

use crate::Error;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::{Field, Scalar, Tensor};
use std::fmt;

/// The answer to the question whether a property holds.
///
/// ```
/// use affinor::geometry::properties::Property;
/// use affinor::algebra::catalogue;
/// use affinor::{Connection, Metric, Rational};
/// // the Heisenberg group with an orthonormal basis
/// let algebra = catalogue::algebra::<Rational>("heisenberg(3)")?;
/// let metric = Metric::identity(3)?;
/// let levi_civita = Connection::levi_civita(algebra.left_frame(), &metric)?;
/// let Property::Fails(witness) = levi_civita.einstein_constant(&metric)? else { unreachable!() };
/// assert_eq!(witness.to_string(), "Ric_jl - (-1/2) g_jl = 1 at j = 3, l = 3");
/// // yet it is a nilsoliton: Ric = -3/2 + diag(1, 1, 2)
/// let soliton = metric.ricci_soliton(&algebra)?.holds().expect("a nilsoliton");
/// assert_eq!(soliton.constant, Rational::new(-3, 2).expect("2 is not 0"));
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Property<S, T = ()> {
    /// The property holds, with an associated value such as a constant or a derivation.
    Holds(T),
    /// The property fails; the witness proves this.
    Fails(Witness<S>),
}

/// A nonzero component of a tensor. The tensor must vanish if the property holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness<S> {
    /// The formula of the tensor, such as `Ric_jl - (1/2) g_jl`.
    pub equation: String,
    /// The free index letters of the equation, in the order of the indices.
    pub letters: &'static str,
    /// The values of the index letters, from 0.
    pub indices: Vec<usize>,
    /// The value of the component.
    pub residual: S,
}

impl<S, T> Property<S, T> {
    /// The value of the property if it holds; `None` if it fails.
    pub fn holds(self) -> Option<T> {
        match self {
            Property::Holds(value) => Some(value),
            Property::Fails(_) => None,
        }
    }

    /// The witness if the property fails; `None` if it holds.
    pub fn witness(self) -> Option<Witness<S>> {
        match self {
            Property::Holds(_) => None,
            Property::Fails(witness) => Some(witness),
        }
    }

    /// The same answer with another value.
    fn with<U>(self, value: impl FnOnce(T) -> U) -> Property<S, U> {
        match self {
            Property::Holds(held) => Property::Holds(value(held)),
            Property::Fails(witness) => Property::Fails(witness),
        }
    }
}

/// Writes the witness in the form `Ric_jl - (1/2) g_jl = 3 at j = 1, l = 1`.
impl<S: fmt::Display> fmt::Display for Witness<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.equation, self.residual)?;
        for (position, (letter, index)) in self.letters.chars().zip(&self.indices).enumerate() {
            let before = if position == 0 { " at" } else { "," };
            write!(f, "{before} {letter} = {}", index + 1)?;
        }
        Ok(())
    }
}

impl<S: Scalar> Connection<S> {
    /// Whether the torsion vanishes, `tau = 0`.
    pub fn torsion_free(&self) -> Property<S> {
        vanishing(&self.torsion(), "tau^i_jk".into(), "ijk")
    }

    /// Whether the curvature vanishes, `R = 0`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{CanonicalConnection, Connection, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let plus = Connection::canonical(&so3, CanonicalConnection::Plus);
    /// assert!(plus.flat().holds().is_some() && plus.torsion_free().holds().is_none());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("zero curvature"))]
    pub fn flat(&self) -> Property<S> {
        vanishing(self.curvature(), "R^i_jkl".into(), "ijkl")
    }

    /// Whether the metric is parallel, `nabla g = 0`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let round = Metric::identity(3)?;
    /// let connection = Connection::levi_civita(so3.left_frame(), &round)?;
    /// assert!(connection.metric_compatible(&round)?.holds().is_some());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    #[doc(alias("metric connection", "parallel metric"))]
    pub fn metric_compatible(&self, metric: &Metric<S>) -> Result<Property<S>, Error>
    where
        S: Field + Scalar,
    {
        metric.expect_dimension(self.frame().dimension())?;
        Ok(vanishing(&self.nabla(metric.components())?, "(nabla_k g)_ij".into(), "kij"))
    }

    /// Whether the torsion is parallel, `nabla tau = 0`.
    pub fn parallel_torsion(&self) -> Property<S> {
        vanishing(&self.nabla_torsion(), "(nabla_m tau)^i_jk".into(), "imjk")
    }

    /// Whether the curvature is parallel, `nabla R = 0`. If the torsion is parallel too, the space
    /// is locally a reductive homogeneous space with its canonical connection (Kobayashi and
    /// Nomizu, *Foundations II*, section X.2).
    pub fn parallel_curvature(&self) -> Property<S> {
        vanishing(&self.nabla_curvature(), "(nabla_m R)^i_jkl".into(), "imjkl")
    }

    /// Whether the geodesic reflections are affine maps near their centres: `tau = 0` and
    /// `nabla R = 0`.
    pub fn locally_symmetric(&self) -> Property<S> {
        match self.torsion_free() {
            Property::Holds(()) => self.parallel_curvature(),
            fails => fails,
        }
    }
}

/// Whether a tensor is zero. In the witness, `equation` is the formula of the tensor, and `letters`
/// are the index letters of its slots.
fn vanishing<S: Scalar>(
    tensor: &Tensor<S>,
    equation: String,
    letters: &'static str,
) -> Property<S> {
    match tensor.components().next() {
        None => Property::Holds(()),
        Some((at, residual)) => Property::Fails(Witness {
            equation,
            letters,
            indices: at.to_vec(),
            residual: residual.clone(),
        }),
    }
}

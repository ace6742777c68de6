//! Connections: affinities over a frame.

mod canonical;
mod invariance;
mod nonholonomic;

pub use canonical::CanonicalConnection;
pub use nonholonomic::complement_projector;
pub(in crate::geometry) use nonholonomic::{columns, inverse_gram};

use crate::Error;
use crate::algebra::frame::{Frame, expect_numbers, expect_slots};
use crate::algebra::lie_derivative::derivation;
use crate::algebra::{LETTERS, indices};
use affinor_tensors::{Down, Scalar, Tensor, Up};
use std::fmt;
use std::sync::{Arc, OnceLock};

/// A connection, given by its affinities in a frame: `nabla_{e_j} e_k = Lambda^i_jk e_i` (B1).
///
/// The first lower index is the direction, and the second belongs to the differentiated vector.
/// Torsion and curvature are in [`curvature`](crate::geometry::curvature). Quantities that also
/// need a metric are in [`metric_affine`](crate::geometry::metric_affine).
#[derive(Clone, Debug)]
pub struct Connection<S> {
    frame: Frame<S>,
    gamma: Tensor<S>,
    /// The curvature. The first call of [`curvature`](Self::curvature) computes it, and clones
    /// share it.
    pub(super) curvature: Arc<OnceLock<Tensor<S>>>,
    /// The Ricci tensor, if [`ricci`](Self::ricci) has computed it without the curvature.
    pub(super) ricci: Arc<OnceLock<Tensor<S>>>,
}

impl<S: PartialEq> PartialEq for Connection<S> {
    fn eq(&self, other: &Self) -> bool {
        self.frame == other.frame && self.gamma == other.gamma
    }
}

/// Writes the nonzero covariant derivatives `nabla[x, y] = z` of the frame vectors, one per line.
impl<S: Scalar> fmt::Display for Connection<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.frame.write_products(f, &self.gamma, "nabla[", "]", |_, _| true)
    }
}

impl<S: Scalar> Connection<S> {
    /// A connection with the affinities `Lambda^i_jk`, slots `[Up, Down, Down]`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// // the affinities of `plus` are the structure constants
    /// let plus = Connection::new(so3.left_frame().clone(), so3.structure_constants().clone())?;
    /// assert!(plus.curvature().is_empty());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] if the affinities do not fit the frame; [`Error::NotFinite`] if one is NaN
    /// or infinite.
    #[doc(alias("affine connection"))]
    pub fn new(frame: Frame<S>, gamma: Tensor<S>) -> Result<Self, Error> {
        expect_slots("the affinities", &gamma, frame.dimension(), &[Up, Down, Down])?;
        expect_numbers("the affinities", &gamma)?;
        Ok(Self::unchecked(frame, gamma))
    }

    fn unchecked(frame: Frame<S>, gamma: Tensor<S>) -> Self {
        Connection { frame, gamma, curvature: Arc::default(), ricci: Arc::default() }
    }

    /// The frame of the affinities.
    pub fn frame(&self) -> &Frame<S> {
        &self.frame
    }

    /// The affinities `Lambda^i_jk`, slots `[Up, Down, Down]`; `j` is the direction.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let metric = Metric::diagonal([1, 1, 3].map(Rational::from))?;
    /// let connection = Connection::levi_civita(so3.left_frame(), &metric)?;
    /// // Lambda^1_23 = (g_11 - g_22 + g_33)/(2 g_11)
    /// assert_eq!(Some(connection.affinities().get(&[0, 1, 2])), Rational::new(3, 2));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("Christoffel symbols", "christoffel", "connection coefficients", "Gamma"))]
    pub fn affinities(&self) -> &Tensor<S> {
        &self.gamma
    }

    /// The covariant derivative of a tensor of any type,
    /// `(nabla_m T)^i_j = e_m(T^i_j) + Lambda^i_mp T^p_j - Lambda^p_mj T^i_p`. The direction `m` is
    /// the first lower index of the result. In the frame of a homogeneous space, the tensor must be
    /// invariant.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let metric = Metric::diagonal([1, 2, 3].map(Rational::from))?;
    /// let connection = Connection::levi_civita(so3.left_frame(), &metric)?;
    /// assert!(connection.nabla(metric.components())?.is_empty());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] if the dimensions differ; [`Error::Tensor`] if the result is too large for
    /// the indices of a tensor, 64 bits.
    #[doc(alias("covariant derivative"))]
    pub fn nabla(&self, tensor: &Tensor<S>) -> Result<Tensor<S>, Error> {
        let derivative = self.frame.derivative(tensor)?;
        let letters = &LETTERS[..tensor.rank()];
        let sum = format!("d_m{}{}", indices(letters, tensor), derivation("m", tensor));
        let at = tensor.slots().iter().position(|slot| *slot == Down).unwrap_or(tensor.rank());
        let before = indices(&letters[..at], tensor);
        // computes an antisymmetric last pair of indices only once, because nabla T has the
        // symmetries of T
        let pair = tensor.rank().checked_sub(2).filter(|&pair| {
            pair >= at
                && tensor.slots()[pair..] == [Down, Down]
                && tensor.pair_symmetry(pair, pair + 1) == Some(-1)
        });
        let mut behind = String::new();
        for (position, (letter, slot)) in letters.chars().zip(tensor.slots()).enumerate().skip(at) {
            let opens = Some(position) == pair;
            match (opens, pair.is_some_and(|pair| position == pair + 1)) {
                (true, _) => behind += &format!("_[{letter}"),
                (_, true) => behind += &format!("{letter}]"),
                _ => behind += &format!("{}{letter}", if *slot == Up { "^" } else { "_" }),
            }
        }
        let operands = [("d", &derivative), ("L", &self.gamma), ("T", tensor)];
        Ok(affinor_tensors::contract(&format!("{sum} -> {before}_m{behind}"), &operands)?)
    }
}

//! The canonical connections of a Lie group and their family `Lambda = lambda c`.

use super::Connection;
use crate::algebra::LieAlgebra;
use crate::algebra::frame::Frame;
use affinor_tensors::{Field, Scalar};

/// The three canonical (Cartan-Schouten) connections.
///
/// Paraskevopoulos and Natsiavas name the connections `Plus` and `Minus` after the other
/// invariance, so outputs contain both names. All three connections are bi-invariant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CanonicalConnection {
    /// The connection with `lambda = 1`, equation (29), which the paper calls "left invariant
    /// canonical" and uses for M(3). Right-invariant fields are parallel.
    Plus,
    /// The connection with `lambda = 1/2`, equation (31), which the paper calls "symmetric" and
    /// uses for SO(3).
    Zero,
    /// The connection with `lambda = 0`, equation (30), which the paper calls "right invariant
    /// canonical". Left-invariant fields are parallel.
    Minus,
}

impl<S: Scalar> Connection<S> {
    /// The connection `nabla_X Y = lambda [X, Y]` on left-invariant fields: `Lambda = lambda c`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// // the torsion is (2 lambda - 1) c
    /// let connection = Connection::cartan_schouten(&so3, &2.into());
    /// assert_eq!(connection.torsion().get(&[2, 0, 1]), 3.into());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("Cartan-Schouten", "lambda"))]
    pub fn cartan_schouten(algebra: &LieAlgebra<S>, lambda: &S) -> Self {
        Self::in_frame(algebra.left_frame(), lambda)
    }

    /// The connection `Lambda = lambda c` over the structure of any frame.
    pub fn in_frame(frame: &Frame<S>, lambda: &S) -> Self {
        Connection::unchecked(frame.clone(), frame.structure_functions().scale(lambda))
    }
}

impl<S: Field + Scalar> Connection<S> {
    /// The canonical connection `Lambda^i_jk = lambda c^i_jk` in the left-invariant frame, with
    /// `lambda = 1` (`Plus`), `1/2` (`Zero`) or `0` (`Minus`).
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{CanonicalConnection, Connection, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let zero = Connection::canonical(&so3, CanonicalConnection::Zero);
    /// assert!(zero.torsion().is_empty() && !zero.curvature().is_empty());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Panics
    /// For [`CanonicalConnection::Zero`] over a field of characteristic 2. This package has no such
    /// field.
    #[doc(alias("Cartan-Schouten", "canonical connection"))]
    pub fn canonical(algebra: &LieAlgebra<S>, which: CanonicalConnection) -> Self {
        Self::cartan_schouten(algebra, &which.lambda())
    }
}

impl CanonicalConnection {
    /// The factor `lambda` in `Lambda = lambda c`.
    ///
    /// # Panics
    /// See [`Connection::canonical`].
    pub fn lambda<S: Field + Scalar>(self) -> S {
        match self {
            CanonicalConnection::Plus => S::one(),
            CanonicalConnection::Zero => S::from_i64(2).recip().expect("2 is a unit"),
            CanonicalConnection::Minus => S::zero(),
        }
    }

    /// The short name: `plus`, `zero`, `minus`.
    pub fn name(self) -> &'static str {
        match self {
            CanonicalConnection::Plus => "plus",
            CanonicalConnection::Zero => "zero",
            CanonicalConnection::Minus => "minus",
        }
    }

    /// The name of the connection in the paper: equations (29), (31) and (30).
    pub fn paper(self) -> &'static str {
        match self {
            CanonicalConnection::Plus => "left invariant canonical",
            CanonicalConnection::Zero => "symmetric",
            CanonicalConnection::Minus => "right invariant canonical",
        }
    }

    /// The short name on a homogeneous space, and its explanation: `canonical` for `lambda = 0` and
    /// `natural` for `lambda = 1/2` (K. Nomizu, *Amer. J. Math.* 76 (1954) 33-65).
    pub fn on_homogeneous_space(self) -> (&'static str, &'static str) {
        match self {
            CanonicalConnection::Plus => ("lambda", "the family lambda [x,y]_m"),
            CanonicalConnection::Zero => ("natural", "first canonical, torsion-free"),
            CanonicalConnection::Minus => ("canonical", "second canonical"),
        }
    }
}

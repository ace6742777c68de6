//! Algebraic Ricci solitons: nilsolitons and solvsolitons.

use super::Property;
use super::einstein::ratio;
use crate::Error;
use crate::algebra::LieAlgebra;
use crate::algebra::frame::formula;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::stop::stage;
use affinor_tensors::{Field, Scalar, Tensor, contract};

/// The decomposition `Ric = constant Id + derivation` of an algebraic Ricci soliton.
#[derive(Clone, Debug, PartialEq)]
pub struct Soliton<S> {
    /// The constant.
    pub constant: S,
    /// The derivation `D^i_j` of the algebra, slots `[Up, Down]`.
    pub derivation: Tensor<S>,
}

impl<S: Field + Scalar> Metric<S> {
    /// Whether the left-invariant metric is an algebraic Ricci soliton. This holds if the Ricci
    /// endomorphism `Ric^i_j = g^im Ric_mj` is `c Id + D` with a constant `c` and a derivation `D`
    /// of the algebra.
    ///
    /// Such metrics are nilsolitons if the algebra is nilpotent (J. Lauret, *Math. Ann.* 319 (2001)
    /// 715-733), and solvsolitons if it is solvable. If `D = 0`, the metric is Einstein. If the
    /// algebra is abelian, every `c` is possible, and the constant is 0.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Metric, Rational};
    /// let algebra = catalogue::algebra::<Rational>("heisenberg(3)")?;
    /// assert!(Metric::identity(3)?.ricci_soliton(&algebra)?.holds().is_some());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    #[doc(alias("nilsoliton", "solvsoliton"))]
    pub fn ricci_soliton(&self, algebra: &LieAlgebra<S>) -> Result<Property<S, Soliton<S>>, Error> {
        let _stage = stage("Ricci soliton");
        let levi_civita = Connection::levi_civita(algebra.left_frame(), self)?;
        let ricci = levi_civita.ricci().raise(0, self.inverse())?;
        let c = algebra.structure_constants();
        // the defect of Ric as a derivation; the defect of D = Ric - s Id is this tensor plus s c
        let defect = formula(
            "D^i_m c^m_jk - c^i_mk D^m_j - c^i_jm D^m_k -> ^i_[jk]",
            &[("D", &ricci), ("c", c)],
        );
        let opposite = c.map(|value| -value.clone());
        let equation =
            |s: &S| format!("Ric^i_m c^m_jk - c^i_mk Ric^m_j - c^i_jm Ric^m_k + ({s}) c^i_jk");
        let constant = match ratio(&defect, &opposite, equation, "ijk") {
            Property::Holds(constant) => constant,
            Property::Fails(witness) => return Ok(Property::Fails(witness)),
        };
        let scalar = Tensor::identity(algebra.dimension()).scale(&constant);
        let derivation = contract("r^i_j - s^i_j -> ^i_j", &[("r", &ricci), ("s", &scalar)])?;
        Ok(Property::Holds(Soliton { constant, derivation }))
    }
}

//! Connections with given torsion and nonmetricity, and the disformation of a nonmetricity.

use super::contorsion::expect_torsion;
use super::koszul::koszul;
use crate::Error;
use crate::algebra::frame::{Frame, expect_slots, expect_symmetry};
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::{Down, Field, Ring, Tensor, Up, contract};

/// The disformation of a nonmetricity `Q_kij = (nabla_k g)_ij`, slots `^i_jk` as the affinities:
///
/// ```text
/// L_ijk = (Q_ijk - Q_jki - Q_kij) / 2,    L_ijk = L_ikj
/// ```
///
/// with the first index lowered by the metric (J. Beltrán Jiménez, L. Heisenberg and T. Koivisto,
/// *Universe* 5 (2019) 173).
///
/// # Errors
/// [`Error::Shape`]; [`Error::NotFinite`]; [`Error::Symmetry`] unless `Q_kij = Q_kji`.
pub fn disformation<S: Field>(
    metric: &Metric<S>,
    nonmetricity: &Tensor<S>,
) -> Result<Tensor<S>, Error> {
    let n = metric.components().dimension();
    expect_nonmetricity(nonmetricity, n)?;
    let zero = Tensor::zero(n, &[Up, Down, Down])?;
    koszul(metric, &nonmetricity.scale(&S::from_i64(-1)), &zero)
}

fn expect_nonmetricity<S: Ring>(nonmetricity: &Tensor<S>, n: usize) -> Result<(), Error> {
    expect_slots("the nonmetricity", nonmetricity, n, &[Down; 3])?;
    expect_symmetry("the nonmetricity", nonmetricity, [1, 2], 1)
}

impl<S: Field> Connection<S> {
    /// The only connection with this torsion `tau^i_jk` and nonmetricity `Q_kij`, in any frame:
    ///
    /// ```text
    /// Lambda = LeviCivita + K(tau) + L(Q)
    /// ```
    ///
    /// with the [`contorsion`](super::contorsion) and the [`disformation`]. Koszul's formula is linear,
    /// and each summand is its value for one of the three inputs.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::Symmetry`] unless `tau^i_jk = -tau^i_kj` and `Q_kij = Q_kji`.
    pub fn with_torsion_and_nonmetricity(
        frame: &Frame<S>,
        metric: &Metric<S>,
        torsion: &Tensor<S>,
        nonmetricity: &Tensor<S>,
    ) -> Result<Self, Error> {
        let (n, g) = (frame.dimension(), metric.components());
        expect_slots("the metric", g, n, &[Down, Down])?;
        expect_torsion(torsion, n)?;
        expect_nonmetricity(nonmetricity, n)?;
        let derivative = frame.derivative(g)?;
        let d = contract("d_kij - Q_kij -> _kij", &[("d", &derivative), ("Q", nonmetricity)])?;
        let b = [("c", frame.structure()), ("t", torsion)];
        let b = contract("c^i_jk + t^i_jk -> ^i_[jk]", &b)?;
        Connection::new(frame.clone(), koszul(metric, &d, &b)?)
    }

    /// The [`disformation`] of this connection's nonmetricity.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn disformation(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        disformation(metric, &self.nonmetricity(metric)?)
    }
}

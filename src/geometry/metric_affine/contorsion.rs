//! Metric connections with torsion, and the contorsion, their difference from Levi-Civita.

use super::koszul::koszul;
use crate::Error;
use crate::algebra::frame::{Frame, expect_slots, expect_symmetry};
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::{Down, Field, Tensor, Up};

/// The contorsion of a torsion `tau^i_jk`, slots `^i_jk` as the affinities (direction first):
///
/// ```text
/// K_ijk = (tau_ijk + tau_jik + tau_kij) / 2,    K_ijk = -K_kji
/// ```
///
/// with the first index lowered by the metric (F. W. Hehl et al., *Phys. Rep.* 258 (1995) 1-171;
/// J. Beltrán Jiménez, L. Heisenberg and T. Koivisto, *Universe* 5 (2019) 173).
///
/// # Errors
/// [`Error::Shape`]; [`Error::NotFinite`]; [`Error::Symmetry`] unless the torsion is antisymmetric.
pub fn contorsion<S: Field>(metric: &Metric<S>, torsion: &Tensor<S>) -> Result<Tensor<S>, Error> {
    let n = metric.components().dimension();
    expect_torsion(torsion, n)?;
    koszul(metric, &Tensor::zero(n, &[Down; 3])?, torsion)
}

/// Checks the slots and the antisymmetry of a torsion.
pub(super) fn expect_torsion<S: Field>(torsion: &Tensor<S>, n: usize) -> Result<(), Error> {
    expect_slots("the torsion", torsion, n, &[Up, Down, Down])?;
    expect_symmetry("the torsion", torsion, [1, 2], -1)
}

impl<S: Field> Connection<S> {
    /// The only connection compatible with `metric` that has this torsion, slots `^i_jk`, in any
    /// frame: Levi-Civita plus the [`contorsion`].
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Ring, Symbolic};
    /// let so3 = catalogue::algebra("so(3)")?;
    /// // tau = -c: the connection (-), for every left-invariant metric
    /// let metric = Metric::diagonal(["a", "b", "c"].map(Symbolic::parameter))?;
    /// let torsion = so3.structure().scale(&Symbolic::from_i64(-1));
    /// let flat = Connection::with_torsion(so3.left_frame(), &metric, &torsion)?;
    /// assert!(flat.gamma().is_empty());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`contorsion`].
    pub fn with_torsion(
        frame: &Frame<S>,
        metric: &Metric<S>,
        torsion: &Tensor<S>,
    ) -> Result<Self, Error> {
        let nonmetricity = Tensor::zero(frame.dimension(), &[Down; 3])?;
        Self::with_torsion_and_nonmetricity(frame, metric, torsion, &nonmetricity)
    }

    /// The [`contorsion`] of this connection's torsion. A connection compatible with the metric
    /// is Levi-Civita plus it, `K = Lambda - LeviCivita`; any other has a
    /// [`disformation`](Self::disformation) as well.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn contorsion(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        contorsion(metric, &self.torsion())
    }
}

//! Parallel translation along curves of a group, its generator, and autoparallels.

mod autoparallel;
mod curve;

pub use autoparallel::TangentVector;
pub use curve::ParallelTranslation;

use crate::algebra::frame::{expect_slots, formula};
use crate::{Connection, Error};
use affinor_tensors::{Ring, Tensor, Up};

impl<S: Ring> Connection<S> {
    /// The generator of parallel translation along a curve with the tangent `w`, slots `^i_k`:
    /// `du/dt = G u` with `G^i_k = -Lambda^i_jk w^j`, from (42), (B5).
    ///
    /// # Errors
    /// [`Error::Shape`].
    pub fn transport_along(&self, w: &[S]) -> Result<Tensor<S>, Error> {
        let vector = Tensor::vector(w, Up).with_tolerance(self.gamma().tolerance());
        expect_slots("the direction", &vector, self.frame().dimension(), &[Up])?;
        Ok(formula("-1 L^i_jk w^j -> ^i_k", &[("L", self.gamma()), ("w", &vector)]))
    }

    /// The generator along the autoparallel with the constant tangent `n`, (45).
    ///
    /// It is `-ad_n` for `plus`, `-ad_n/2` for `zero`, and 0 for `minus`.
    ///
    /// # Errors
    /// [`Error::NotAutoparallel`] unless `Lambda^i_jk n^j n^k = 0` (B7): else the tangent of the
    /// autoparallel does not stay constant in this frame. [`Error::Shape`].
    pub fn transport_generator(&self, n: &[S]) -> Result<Tensor<S>, Error> {
        let generator = self.transport_along(n)?;
        let vector = Tensor::vector(n, Up).with_tolerance(self.gamma().tolerance());
        let drift = formula("-1 G^i_k n^k -> ^i", &[("G", &generator), ("n", &vector)]);
        if drift.is_empty() {
            return Ok(generator);
        }
        let drift = drift.to_vector().unwrap_or_default();
        let write = |components: Vec<S>| self.frame().write(components);
        Err(Error::NotAutoparallel { n: write(n.to_vec()), residual: write(drift) })
    }
}

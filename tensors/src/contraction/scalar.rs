//! The scalars that tensors of the engine are contracted over.

use super::{KernelThresholds, over};
use crate::scalar::{Jet, Rational, Recorded, Summable, Symbolic, TrackedFloat};
use crate::{Tensor, TensorError};
use num_rational::{BigRational, Ratio};

/// A ring whose tensors can be contracted: the coefficients of algebras, frames and connections.
///
/// For a scalar of your own an empty `impl` suffices.
pub trait Scalar: Summable {
    /// [`contract`](crate::contract()) over this ring.
    ///
    /// # Errors
    /// As there.
    #[doc(hidden)]
    fn contracted(
        paths: &KernelThresholds,
        expression: &str,
        operands: &[(&str, &Tensor<Self>)],
    ) -> Result<Tensor<Self>, TensorError> {
        over(paths, expression, operands)
    }
}

/// The kernels of these scalars are compiled once, in this package, and not again in each package that contracts.
macro_rules! compiled_here {
    ($($scalar:ty),*) => {$(
        impl Scalar for $scalar {
            fn contracted(
                paths: &KernelThresholds,
                expression: &str,
                operands: &[(&str, &Tensor<Self>)],
            ) -> Result<Tensor<Self>, TensorError> {
                over(paths, expression, operands)
            }
        }
    )*};
}
compiled_here!(f64, Rational, Symbolic, TrackedFloat);

impl Scalar for Jet {}
impl Scalar for Recorded {}
impl Scalar for Ratio<i64> {}
impl Scalar for BigRational {}
#[cfg(feature = "num-dual")]
impl Scalar for num_dual::Dual64 {}

//! The scalar types over which tensors can be contracted.

use super::{KernelThresholds, over};
use crate::scalar::{Jet, Rational, Recorded, Summable, Symbolic, TrackedFloat};
use crate::{Tensor, TensorError};
use num_rational::{BigRational, Ratio};

/// A ring whose tensors can be contracted: the coefficients of algebras, frames and connections.
///
/// For a user-defined scalar an empty `impl` suffices.
pub trait Scalar: Summable {
    /// [`contract`](crate::contract()) over this ring.
    ///
    /// # Errors
    /// Those of [`contract`](crate::contract()).
    #[doc(hidden)]
    fn contracted(
        paths: &KernelThresholds,
        expression: &str,
        operands: &[(&str, &Tensor<Self>)],
    ) -> Result<Tensor<Self>, TensorError> {
        over(paths, expression, operands)
    }
}

/// Compiles the kernels of these scalars once, in this package, instead of again in each package
/// that contracts.
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

//! The types of scalars over which tensors can be contracted.

use super::{KernelThresholds, over};
use crate::scalar::{Jet, Rational, Recorded, Summable, Symbolic, TrackedFloat};
use crate::{Tensor, TensorError};
use num_rational::{BigRational, Ratio};

/// A ring whose tensors can be contracted. Algebras, frames and connections have coefficients in
/// such a ring.
///
/// For a user-defined scalar, an empty `impl` suffices.
pub trait Scalar: Summable {
    /// Computes [`contract`](crate::contract()) over this ring.
    ///
    /// # Errors
    /// The errors of [`contract`](crate::contract()).
    #[doc(hidden)]
    fn contracted(
        paths: &KernelThresholds,
        expression: &str,
        operands: &[(&str, &Tensor<Self>)],
    ) -> Result<Tensor<Self>, TensorError> {
        over(paths, expression, operands)
    }
}

/// Compiles the kernels for these scalars once, in this package. Otherwise each package that
/// contracts tensors would compile them again.
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

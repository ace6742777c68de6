//! Scalars: the traits of coefficients, and the types that implement these traits.
//!
//! [`Ring`] and [`Field`] define the arithmetic. They use [`Zero`], [`One`] and the operators of
//! num-traits. Neither requires `Copy` or an order, so that big rationals and rational functions
//! are scalars too. [`Summable`] defines the accumulator of sums of products, and [`Notation`]
//! defines the written form. Tensors are contracted over a [`Scalar`](crate::Scalar).
//!
//! *Zero* always refers to the whole value: the dual number `0 + eps` is not zero
//! ([`Ring::vanishes`]). The functions in [`laws`] test the laws that every scalar must satisfy.
//! They can also test a user-defined scalar.

mod caches;
mod divisors;
#[cfg(feature = "num-dual")]
mod dual;
pub(crate) mod effort;
mod float;
mod jet;
pub mod laws;
mod notation;
mod operators;
mod ratio;
mod rational;
mod recorded;
mod summable;
mod symbolic;
mod tabular;
mod tracked;

use num_traits::{One, Zero};
use std::fmt::{Debug, Display};
use std::ops::{Add, Mul, Neg, Sub};

pub use crate::function::Function;
pub use crate::limits::{Effort, EffortExceeded};
pub use caches::clear_caches;
pub use divisors::divisors_of;
pub use jet::Jet;
pub use notation::{Kind, Notation};
pub use rational::Rational;
use rational::RationalSum;
pub use recorded::{Count, Output, Recorded, Step, StraightLine, derivatives};
pub use summable::{ExactSum, Sum, Summable, Tolerance};
pub(crate) use symbolic::polynomial_factors;
pub use symbolic::{CommonFactors, FreeFunction, PositiveFactors, Symbolic, Variable};
pub use tabular::Tabular;
pub use tracked::TrackedFloat;

/// A commutative ring with 1. Its operators accept values and references. Every `x` must have a
/// negative, so that `x - x` vanishes. Intervals violate this law, and brackets over intervals are
/// rejected.
///
/// The constants `zero()`, `one()` and [`from_i64`](Ring::from_i64) can be combined with every
/// value of the type.
pub trait Ring:
    Clone
    + PartialEq
    + Debug
    + Display
    + Send
    + Sync
    + 'static
    + Zero
    + One
    + Neg<Output = Self>
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a Self, Output = Self>
{
    /// The integer `n` as an element of this ring, which is `n` times one.
    fn from_i64(n: i64) -> Self;

    /// Whether the whole value is zero. Sparse storage uses this test instead of [`Zero::is_zero`],
    /// which some types define only by their leading part.
    fn vanishes(&self) -> bool;

    /// The value `numerator / denominator`; `None` if this quotient does not exist in the ring.
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        (denominator == 1).then(|| Self::from_i64(numerator))
    }
}

/// A ring with inverses of all units.
pub trait Field: Ring {
    /// The multiplicative inverse. It is `None` exactly for non-units.
    fn recip(&self) -> Option<Self>;

    /// The weight of the value as a pivot of an elimination. A pivot with a larger weight is
    /// better. Floats return the magnitude, which is compared with the other entries of its row and
    /// column. Exact scalars prefer short values, so that numbers remain short; their weights are
    /// not positive.
    fn pivot_weight(&self) -> f64;
}

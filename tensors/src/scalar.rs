//! Scalars: the traits of coefficients, and the types that implement them.
//!
//! [`Ring`] and [`Field`] are arithmetic: they build on [`Zero`], [`One`] and the operators of num-traits. Neither requires
//! `Copy` or an order, so that big rationals and rational functions are scalars too. [`Summable`] names the accumulator of
//! sums of products, [`Notation`] the written form. Tensors are contracted over a [`Scalar`](crate::Scalar).
//!
//! *Zero* always means the whole value: the dual number `0 + eps` is not zero ([`Ring::vanishes`]).
//! The functions in [`laws`] test the laws that every scalar obeys; use them to test a user-defined
//! scalar.

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
pub use symbolic::{CommonFactors, FreeFunction, PositiveFactors, Symbolic, Variable};
pub use tabular::Tabular;
pub use tracked::TrackedFloat;

/// A commutative ring with 1, with operators by value and by reference. Every `x` has a negative:
/// `x - x` must vanish. Intervals violate this law, and brackets over them are rejected.
///
/// The constants `zero()`, `one()` and [`from_i64`](Ring::from_i64) combine with every value of the
/// type.
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
    /// The integer `n` as an element of this ring: `n` times one.
    fn from_i64(n: i64) -> Self;

    /// Whether the whole value is zero. Sparse storage uses this test instead of [`Zero::is_zero`],
    /// which some types define by their leading part alone.
    fn vanishes(&self) -> bool;

    /// The value `numerator / denominator`; `None` if this quotient does not exist in the ring.
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        (denominator == 1).then(|| Self::from_i64(numerator))
    }
}

/// A ring in which units can be inverted.
pub trait Field: Ring {
    /// The multiplicative inverse; `None` exactly for non-units.
    fn recip(&self) -> Option<Self>;

    /// The weight of the value as a pivot of an elimination; larger is better. Floats return the
    /// magnitude, which is compared with the other entries of its row and column. Exact scalars
    /// prefer short values, so that numbers stay small; their weights are not positive.
    fn pivot_weight(&self) -> f64;
}

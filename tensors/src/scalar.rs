//! Scalars: the traits every algorithm asks for, weakest first.
//!
//! [`Ring`] is enough for brackets, torsion and curvature; [`Field`] adds division, for metrics
//! and matrix bases. Both stand on num-traits' [`Zero`], [`One`] and the operators. Neither asks
//! for `Copy` or an order, so big rationals and rational functions are scalars like any other.
//!
//! *Zero* here always means the whole value: the dual number `0 + eps` is not zero
//! ([`Ring::vanishes`]). The laws that every scalar must obey are functions in [`laws`].

mod float;
mod jet;
pub mod laws;
mod notation;
mod rational;
mod symbolic;
mod tracked;

use num_traits::{One, Zero};
use std::fmt::{Debug, Display};
use std::ops::{Add, Mul, Neg, Sub};

pub use jet::Jet;
pub use notation::{Kind, Notation};
pub use rational::Rational;
pub use symbolic::Symbolic;
pub use tracked::Tracked;

/// A commutative ring with 1, by value and by reference.
///
/// Constants are free of context: `zero()`, `one()` and [`from_i64`](Ring::from_i64) combine with
/// every other value of the type.
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
    /// What a sum of products is collected in.
    type Sum: Sum<Self>;

    /// The integer `n` of this ring: `n` times one.
    fn from_i64(n: i64) -> Self;

    /// Whether the whole value is zero. Sparsity rests on this, not on [`Zero::is_zero`], which
    /// some types answer by their leading part alone.
    fn vanishes(&self) -> bool;

    /// Whether the value is a number: a float may be infinite or NaN. Exact values always are.
    fn is_number(&self) -> bool {
        true
    }

    /// Whether the value counts as zero beside another one. Exact values do so only when they
    /// vanish; floats up to the tolerance.
    fn negligible(&self, beside: &Self, tolerance: Tolerance) -> bool {
        let _ = (beside, tolerance);
        self.vanishes()
    }

    /// The values as machine integers over one positive denominator, where they have that form.
    ///
    /// A hook for speed: long sums of products then run on machine words and come back through
    /// [`from_quotient`](Ring::from_quotient). `None` (the default) keeps the sums in the ring.
    fn clear_denominators<'a>(
        values: impl Iterator<Item = &'a Self> + Clone,
    ) -> Option<(Vec<i64>, i64)> {
        let _ = values;
        None
    }

    /// The value `numerator / denominator`; `None` where it does not exist in this ring.
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        (denominator == 1).then(|| Self::from_i64(numerator))
    }
}

/// A ring in which units can be inverted.
pub trait Field: Ring {
    /// The multiplicative inverse; `None` exactly for non-units.
    fn recip(&self) -> Option<Self>;

    /// How well the value serves as a pivot of an elimination; larger is better. Floats answer by
    /// magnitude, exact scalars by simplicity, so that numbers stay small.
    fn pivot_weight(&self) -> f64;
}

/// A sum of terms that can tell at the end whether it is zero.
///
/// Exact scalars collect in themselves ([`ExactSum`]); floats also collect the magnitude of their
/// terms, against which the [`Tolerance`] judges; a [`Tracked`] hands its rounding on to the next sum.
pub trait Sum<S>: Clone + Send {
    /// The sum of one term.
    fn term(a: &S) -> Self;
    /// The sum of one product.
    fn product(a: &S, b: &S) -> Self;
    /// Adds one term.
    fn add_term(&mut self, a: &S);
    /// Adds one product.
    fn add_product(&mut self, a: &S, b: &S);
    /// The value, or `None` when it counts as zero.
    fn finish(&self, tolerance: Tolerance) -> Option<S>;
}

/// The sum of an exact scalar: the value itself.
#[derive(Clone, Debug)]
pub struct ExactSum<S>(pub S);

impl<S: Ring> Sum<S> for ExactSum<S> {
    fn term(a: &S) -> Self {
        ExactSum(a.clone())
    }
    fn product(a: &S, b: &S) -> Self {
        ExactSum(a.clone() * b)
    }
    fn add_term(&mut self, a: &S) {
        self.0 = std::mem::replace(&mut self.0, S::zero()) + a;
    }
    fn add_product(&mut self, a: &S, b: &S) {
        self.0 = std::mem::replace(&mut self.0, S::zero()) + &(a.clone() * b);
    }
    fn finish(&self, _: Tolerance) -> Option<S> {
        (!self.0.vanishes()).then(|| self.0.clone())
    }
}

/// When a float counts as zero: `|sum| <= tolerance * (sum of the |terms|)`, of the terms of one sum of products; a
/// [`Tracked`] also when it is the rounding of earlier sums. Exact scalars ignore it.
///
/// ```
/// use affinor_tensors::Tolerance;
/// assert_eq!(Tolerance::default().relative(), 64.0 * f64::EPSILON);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Tolerance(f64);

impl Tolerance {
    /// A relative tolerance; `None` unless `0 <= relative < 1`.
    pub fn new(relative: f64) -> Option<Self> {
        (0.0..1.0).contains(&relative).then_some(Tolerance(relative))
    }

    /// The factor in front of the sum of magnitudes.
    pub fn relative(self) -> f64 {
        self.0
    }

    /// The weaker of two tolerances.
    pub fn weaker(self, other: Self) -> Self {
        Tolerance(self.0.max(other.0))
    }
}

impl Default for Tolerance {
    fn default() -> Self {
        Tolerance(64.0 * f64::EPSILON)
    }
}

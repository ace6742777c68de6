//! Sums of products. They are what contractions and linear algebra need from scalars in addition to
//! arithmetic.

use super::Ring;
use crate::linear::Matrix;
use dashu_int::{IBig, UBig};

/// A ring with sums of products that decide whether they are zero.
///
/// A user-defined scalar chooses its accumulator, which is [`ExactSum`] if the scalar is exact. All
/// methods have defaults.
pub trait Summable: Ring {
    /// The type of the accumulator for sums of products.
    type Sum: Sum<Self>;

    /// Whether values become longer with every operation, as formulas do. In this case, a long sum
    /// is computed in one stage, so that terms that cancel are never stored.
    const GROWS: bool = false;

    /// Whether the value is a finite number. Every exact value is finite, but a float may be
    /// infinite or NaN.
    fn is_number(&self) -> bool {
        true
    }

    /// Whether the value counts as zero compared with the terms of the sum from which it comes, but
    /// is stored because later sums need it ([`Sum::kept`]). Tensors do not show such a component;
    /// only contractions use it.
    fn is_small(&self) -> bool {
        false
    }

    /// Whether the value counts as zero relative to the value `beside`. An exact value must vanish;
    /// a float may be as large as the tolerance allows.
    fn negligible(&self, beside: &Self, tolerance: Tolerance) -> bool {
        let _ = (beside, tolerance);
        self.vanishes()
    }

    /// The values as machine integers over one positive common denominator. Returns `None` if the
    /// values do not have this form.
    ///
    /// This method makes contractions faster. Sums of products are computed in machine integers,
    /// and are converted back by [`from_quotient`](Ring::from_quotient). The default is `None`; in
    /// this case, sums are computed in the ring.
    fn clear_denominators<'a>(
        values: impl Iterator<Item = &'a Self> + Clone,
    ) -> Option<(Vec<i64>, i64)> {
        let _ = values;
        None
    }

    /// The values as integers of any size over one positive common denominator. Returns `None` if
    /// the values do not have this form. Also returns `None` if the common denominator is much
    /// longer than the denominators of the values.
    ///
    /// This method makes contractions faster if machine integers overflow: a component is reduced
    /// to lowest terms only once, and not in each product.
    #[doc(hidden)]
    fn clear_to_big<'a>(
        values: impl Iterator<Item = &'a Self> + Clone,
    ) -> Option<(Vec<IBig>, UBig)> {
        let _ = values;
        None
    }

    /// The value of a quotient of integers of any size. Returns `None` for scalars without
    /// [`clear_to_big`](Self::clear_to_big).
    #[doc(hidden)]
    fn from_big_quotient(numerator: &IBig, denominator: &UBig) -> Option<Self> {
        let _ = (numerator, denominator);
        None
    }

    /// The solution `X` of `A X = B` for a square matrix `A`, computed by a special method of this
    /// scalar. The default is `None`; in this case, the general elimination is used.
    fn solved(matrix: &Matrix<Self>, right: &Matrix<Self>) -> Option<Matrix<Self>> {
        let _ = (matrix, right);
        None
    }
}

/// A sum of terms and products. When it is complete, it decides whether it is zero. The default
/// value is the empty sum.
///
/// For exact scalars, the sum is the value itself ([`ExactSum`]). For floats, it also contains the
/// sum of the magnitudes of the terms, to which the [`Tolerance`] is relative. The result of a sum
/// of [`TrackedFloat`](super::TrackedFloat)s contains the rounding error of the sum.
pub trait Sum<S>: Clone + Default + Send {
    /// Adds one term.
    fn add_term(&mut self, a: &S);
    /// Adds one product.
    fn add_product(&mut self, a: &S, b: &S);
    /// The value of the sum. Returns `None` if it counts as zero.
    fn finish(&self, tolerance: Tolerance) -> Option<S>;

    /// The value for later sums. If the scalar tracks its error, this includes a value that counts
    /// as zero ([`Summable::is_small`]). Returns `None` if the value is exactly zero, or if it
    /// counts as zero and its error is unknown.
    fn kept(&self, tolerance: Tolerance) -> Option<S> {
        self.finish(tolerance)
    }

    /// A sum of one term.
    fn term(a: &S) -> Self {
        let mut sum = Self::default();
        sum.add_term(a);
        sum
    }

    /// A sum of one product.
    fn product(a: &S, b: &S) -> Self {
        let mut sum = Self::default();
        sum.add_product(a, b);
        sum
    }
}

/// The sum of an exact scalar, which is the value itself.
#[derive(Clone, Debug)]
pub struct ExactSum<S>(pub S);

impl<S: Ring> Default for ExactSum<S> {
    fn default() -> Self {
        ExactSum(S::zero())
    }
}

impl<S: Summable> Sum<S> for ExactSum<S> {
    fn add_term(&mut self, a: &S) {
        self.0 = std::mem::replace(&mut self.0, S::zero()) + a;
    }
    fn add_product(&mut self, a: &S, b: &S) {
        self.0 = std::mem::replace(&mut self.0, S::zero()) + &(a.clone() * b);
    }
    fn finish(&self, _: Tolerance) -> Option<S> {
        (!self.0.vanishes()).then(|| self.0.clone())
    }
    fn kept(&self, _: Tolerance) -> Option<S> {
        (!self.0.vanishes() || self.0.is_small()).then(|| self.0.clone())
    }
}

/// The relative tolerance for zero. A sum of products of floats counts as zero if
/// `|sum| <= tolerance * (sum of the |terms|)`.
///
/// A [`TrackedFloat`](super::TrackedFloat) also counts as zero if it consists only of the rounding
/// errors of earlier sums. Exact scalars ignore the tolerance.
///
/// ```
/// use affinor_tensors::Tolerance;
/// assert_eq!(Tolerance::default().relative(), 64.0 * f64::EPSILON);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Tolerance(f64);

impl Tolerance {
    /// A relative tolerance. Returns `None` unless `0 <= relative < 1`.
    pub fn new(relative: f64) -> Option<Self> {
        (0.0..1.0).contains(&relative).then_some(Tolerance(relative))
    }

    /// The factor by which the sum of magnitudes is multiplied.
    pub fn relative(self) -> f64 {
        self.0
    }

    /// Whether a float counts as zero compared with terms whose magnitudes have the sum
    /// `magnitude`. A NaN never counts as zero. If the sum of magnitudes overflows, only zero
    /// itself counts as zero.
    pub(crate) fn covers(self, value: f64, magnitude: f64) -> bool {
        let bound = self.0 * magnitude;
        value == 0.0 || (value.abs() <= bound && bound.is_finite())
    }

    /// The larger of two tolerances.
    pub fn weaker(self, other: Self) -> Self {
        Tolerance(self.0.max(other.0))
    }
}

impl Default for Tolerance {
    fn default() -> Self {
        Tolerance(64.0 * f64::EPSILON)
    }
}

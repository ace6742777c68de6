//! The rationals of the crate num-rational as scalars: [`Ratio<i64>`] and [`BigRational`].
//!
//! [`Rational`] computes sums of products, inverses and pivots, so they are exact. Programs that
//! already use these types need no wrapper type.
//!
//! `Ratio<i64>` is not the exact scalar of this package. If a *result* of a sum of products does
//! not fit two 64-bit words, the sum panics. The operators of the type, as in `a * b`, overflow
//! like those of `i64`. Use [`Rational`] where numbers may become large.

use super::{Field, Rational, RationalSum, Ring, Sum, Summable, Tolerance};
use num_rational::{BigRational, Ratio};
use num_traits::Zero;

/// A sum of rationals of another type. It is collected exactly in [`Rational`].
#[derive(Clone, Debug, Default)]
pub struct RatioSum(RationalSum);

macro_rules! ratio_scalar {
    ($ratio:ty) => {
        impl Sum<$ratio> for RatioSum {
            fn add_term(&mut self, a: &$ratio) {
                self.0.add_term(&a.clone().into());
            }
            fn add_product(&mut self, a: &$ratio, b: &$ratio) {
                self.0.add_product(&a.clone().into(), &b.clone().into());
            }
            /// # Panics
            /// If the sum does not fit the type. The sum never wraps.
            fn finish(&self, tolerance: Tolerance) -> Option<$ratio> {
                let value = self.0.finish(tolerance)?;
                let fitting = <$ratio>::try_from(&value).ok();
                Some(fitting.expect("the sum overflows Ratio<i64>: compute over affinor::Rational"))
            }
        }

        impl Ring for $ratio {
            fn from_i64(n: i64) -> Self {
                Self::from_integer(n.into())
            }
            fn vanishes(&self) -> bool {
                self.is_zero()
            }
            fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
                Self::try_from(&Rational::new(numerator, denominator)?).ok()
            }
        }

        impl Summable for $ratio {
            type Sum = RatioSum;
            fn clear_denominators<'a>(
                values: impl Iterator<Item = &'a Self> + Clone,
            ) -> Option<(Vec<i64>, i64)> {
                let values: Vec<Rational> = values.map(|value| value.clone().into()).collect();
                Rational::clear_denominators(values.iter())
            }
        }

        impl Field for $ratio {
            /// Returns `None` for zero, and for an inverse that does not fit the type.
            fn recip(&self) -> Option<Self> {
                Self::try_from(&Field::recip(&Rational::from(self.clone()))?).ok()
            }
            fn pivot_weight(&self) -> f64 {
                Rational::from(self.clone()).pivot_weight()
            }
        }
    };
}
ratio_scalar!(Ratio<i64>);
ratio_scalar!(BigRational);

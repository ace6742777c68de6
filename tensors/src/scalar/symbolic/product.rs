//! A term of a sum: a number times at most two values.

use super::fraction::Fraction;
use crate::Rational;
use std::sync::Arc;

/// The product `coefficient * factors[0] * factors[1]`.
#[derive(Clone, Debug)]
pub(super) struct Product {
    pub coefficient: Rational,
    pub factors: [Option<Arc<Fraction>>; 2],
}

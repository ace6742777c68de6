//! The arithmetics that compute sums of products. The simplest arithmetic is the ring itself.

use super::{Product, Role};
use crate::{Scalar, Sum, Tolerance};
use std::borrow::Cow;
use std::ops::Neg;

/// A term with its values. It is not yet laid out in rows.
pub(super) struct Term<'t, V: Clone> {
    pub factors: [Factor<'t, V>; 2],
    pub mirrored: bool,
}

/// The entries of a tensor, and the role of each slot.
pub(super) struct Factor<'t, V: Clone> {
    pub roles: &'t [Role],
    pub keys: &'t [u64],
    pub values: Cow<'t, [V]>,
}

/// A component of a result.
pub(super) trait Value: Clone + Send + Neg<Output = Self> {}

impl<S: Clone + Send + Neg<Output = S>> Value for S {}

/// An arithmetic for sums of products.
pub(super) trait Arithmetic<S>: Sync {
    type Value: Clone + Send + Sync;
    type Sum: Clone + Default + Send;
    /// Adds the product `a b`, or the negative of this product.
    fn add_product(&self, sum: &mut Self::Sum, a: &Self::Value, b: &Self::Value, negative: bool);
    /// The value of a sum; `None` if it is zero.
    fn finish(&self, sum: &Self::Sum) -> Option<S>;
}

/// The arithmetic of the ring, which uses its [`Sum`].
pub(super) struct InRing(pub Tolerance);

impl InRing {
    /// The terms. The coefficient of each term is multiplied into its first factor.
    pub fn terms<'t, S: Scalar>(products: &'t [Product<S>]) -> Vec<Term<'t, S>> {
        let term = |product: &'t Product<S>| {
            let (n, d) = (*product.coefficient.numer(), *product.coefficient.denom());
            // a denominator without an inverse cannot occur here, because the notation rejects it
            let coefficient = S::from_quotient(n, d).filter(|_| (n, d) != (1, 1));
            product.with_values(|at, tensor| match &coefficient {
                Some(coefficient) if at == 0 => {
                    tensor.values().iter().map(|value| value.clone() * coefficient).collect()
                }
                _ => Cow::Borrowed(tensor.values()),
            })
        };
        products.iter().map(term).collect()
    }
}

impl<S: Scalar> Arithmetic<S> for InRing {
    type Value = S;
    type Sum = S::Sum;
    fn add_product(&self, sum: &mut S::Sum, a: &S, b: &S, negative: bool) {
        if negative { sum.add_product(&-a.clone(), b) } else { sum.add_product(a, b) }
    }
    fn finish(&self, sum: &S::Sum) -> Option<S> {
        sum.kept(self.0)
    }
}

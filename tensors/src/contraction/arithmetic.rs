//! The arithmetics for sums of products; the simplest one is the ring itself.

use super::{Product, Role};
use crate::{Scalar, Sum, Tolerance};
use std::borrow::Cow;
use std::ops::Neg;

/// A term with its values, before it is laid out in rows.
pub(super) struct Term<'t, V: Clone> {
    pub factors: [Factor<'t, V>; 2],
    pub mirrored: bool,
}

/// The entries of a tensor with the role of each slot.
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
    /// Adds `a b`, or its negative.
    fn add_product(&self, sum: &mut Self::Sum, a: &Self::Value, b: &Self::Value, negative: bool);
    /// The value of a sum; `None` for zero.
    fn finish(&self, sum: &Self::Sum) -> Option<S>;
}

/// Sums in the ring, by its [`Sum`].
pub(super) struct InRing(pub Tolerance);

impl InRing {
    /// The terms with the coefficient multiplied into the first factor.
    pub fn terms<'t, S: Scalar>(products: &'t [Product<S>]) -> Vec<Term<'t, S>> {
        let term = |product: &'t Product<S>| {
            let (n, d) = (*product.coefficient.numer(), *product.coefficient.denom());
            // the notation admits no other denominators
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

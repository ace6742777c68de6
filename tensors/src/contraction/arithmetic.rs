//! The two arithmetics of sums of products: in the ring itself, and in machine integers.

use super::{Product, Role};
use crate::{Ring, Sum, Tolerance};
use std::ops::Neg;

/// A term with its values, before it is laid out in rows.
pub(super) struct Term<'t, V> {
    pub factors: [Factor<'t, V>; 2],
    pub mirrored: bool,
}

/// The entries of a tensor with the role of each slot.
pub(super) struct Factor<'t, V> {
    pub roles: &'t [Role],
    pub keys: &'t [u64],
    pub values: Vec<V>,
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
    pub fn terms<'t, S: Ring>(products: &'t [Product<S>]) -> Vec<Term<'t, S>> {
        let term = |product: &'t Product<S>| {
            let (n, d) = (*product.coefficient.numer(), *product.coefficient.denom());
            // the notation admits no other denominators
            let coefficient = S::from_quotient(n, d).filter(|_| (n, d) != (1, 1));
            product.with_values(|at, tensor| {
                let scaled = |v: &S| match &coefficient {
                    Some(coefficient) if at == 0 => v.clone() * coefficient,
                    _ => v.clone(),
                };
                tensor.values().iter().map(scaled).collect()
            })
        };
        products.iter().map(term).collect()
    }
}

impl<S: Ring> Arithmetic<S> for InRing {
    type Value = S;
    type Sum = S::Sum;
    fn add_product(&self, sum: &mut S::Sum, a: &S, b: &S, negative: bool) {
        if negative { sum.add_product(&-a.clone(), b) } else { sum.add_product(a, b) }
    }
    fn finish(&self, sum: &S::Sum) -> Option<S> {
        sum.kept(self.0)
    }
}

/// Sums of machine integers that do not overflow.
pub(super) struct OnIntegers;

impl Arithmetic<i64> for OnIntegers {
    type Value = i64;
    type Sum = i64;
    fn add_product(&self, sum: &mut i64, a: &i64, b: &i64, negative: bool) {
        *sum += if negative { -(a * b) } else { a * b };
    }
    fn finish(&self, sum: &i64) -> Option<i64> {
        (*sum != 0).then_some(*sum)
    }
}

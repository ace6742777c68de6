//! The two arithmetics of sums of products: in the ring itself, and in machine integers.

use super::{Paths, Product, Role};
use crate::{Ring, Sum, Tolerance};

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

/// Sums of machine integers over one denominator; no sum of the given terms overflows.
pub(super) struct OnIntegers<S> {
    denominator: i64,
    /// The quotients of the numerators from `-kept` to `kept`, which are most frequent; `None` for
    /// zero.
    quotients: Vec<Option<S>>,
    kept: u32,
}

impl<S: Ring> OnIntegers<S> {
    /// Brings all terms over a common denominator. `None` if the scalar has no denominators or a sum
    /// may exceed 64 bits.
    pub fn clear<'t>(
        products: &'t [Product<S>],
        dimension: usize,
        paths: &Paths,
    ) -> Option<(Self, Vec<Term<'t, i64>>)> {
        let mut cleared = Vec::new();
        let mut denominator = 1i64;
        for product in products {
            let factors: Vec<(Vec<i64>, i64)> = product
                .factors
                .iter()
                .map(|(_, tensor)| S::clear_denominators(tensor.values().iter()))
                .collect::<Option<_>>()?;
            let own = *product.coefficient.denom();
            let d = factors.iter().try_fold(own, |d, (_, f)| d.checked_mul(*f))?;
            denominator = denominator.checked_mul(d / num_integer::gcd(d, denominator))?;
            cleared.push((factors, d));
        }
        let mut bound = 0u64;
        let mut terms = Vec::new();
        for (product, (mut factors, d)) in products.iter().zip(cleared) {
            let scale = product.coefficient.numer().checked_mul(denominator / d)?;
            for value in &mut factors.first_mut()?.0 {
                *value = value.checked_mul(scale)?;
            }
            // the number of products in one component: one for each value of the summed letters
            let summed = product.factors.iter().flat_map(|(roles, _)| roles);
            let pairs = summed.filter(|r| matches!(r, Role::Summed(_))).count() / 2;
            let entries = factors.iter().map(|(values, _)| values.len() as u64).max()?;
            let count = (dimension as u64)
                .saturating_pow(pairs as u32)
                .min(entries.saturating_mul(entries));
            // and as many again for the image of a mirrored term
            let count = count.checked_mul(1 + u64::from(product.mirrored))?;
            let largest = |(values, _): &(Vec<i64>, i64)| {
                values.iter().map(|v| v.unsigned_abs()).max().unwrap_or(0)
            };
            let size = factors.iter().map(largest).try_fold(count, u64::checked_mul)?;
            bound = bound.checked_add(size)?;
            let mut values = factors.into_iter().map(|(values, _)| values);
            terms.push(product.with_values(|_, _| values.next().unwrap_or_default()));
        }
        if bound > paths.largest_integer.min(i64::MAX as u64) {
            return None;
        }
        let kept = paths.kept_quotients;
        let quotients = (-i64::from(kept)..=kept.into())
            .map(|n| if n == 0 { None } else { S::from_quotient(n, denominator) })
            .collect();
        Some((OnIntegers { denominator, quotients, kept }, terms))
    }
}

impl<S: Ring> Arithmetic<S> for OnIntegers<S> {
    type Value = i64;
    type Sum = i64;
    fn add_product(&self, sum: &mut i64, a: &i64, b: &i64, negative: bool) {
        *sum += if negative { -(a * b) } else { a * b };
    }
    fn finish(&self, sum: &i64) -> Option<S> {
        let sum = *sum;
        // compared before it becomes an array index, which has 32 bits on some machines
        if sum.unsigned_abs() <= self.kept.into() {
            self.quotients[(sum + i64::from(self.kept)) as usize].clone()
        } else {
            S::from_quotient(sum, self.denominator)
        }
    }
}

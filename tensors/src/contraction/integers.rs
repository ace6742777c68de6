//! Products over one denominator in machine integers.

use super::arithmetic::Term;
use super::{Paths, Product, Role};
use crate::{Ring, threads};

/// How many pieces of a list each thread gets.
const PIECES: usize = 16;

/// All terms over a common denominator, and this denominator. `None` if the scalar has no denominators or a sum may exceed
/// 64 bits.
pub(super) fn clear<'t, S: Ring>(
    products: &'t [Product<S>],
    dimension: usize,
    paths: &Paths,
) -> Option<(Vec<Term<'t, i64>>, i64)> {
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
        let count =
            (dimension as u64).saturating_pow(pairs as u32).min(entries.saturating_mul(entries));
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
    (bound <= paths.largest_integer.min(i64::MAX as u64)).then_some((terms, denominator))
}

/// Sums over a denominator as values of the ring; `None` if one does not exist there.
pub(super) fn quotients<S: Ring>(sums: &[i64], denominator: i64, paths: &Paths) -> Option<Vec<S>> {
    // the most frequent ones, computed once
    let kept = i64::from(paths.kept_quotients);
    let frequent: Vec<Option<S>> =
        (-kept..=kept).map(|sum| S::from_quotient(sum, denominator)).collect();
    let quotient = |sum: &i64| {
        // compared before it becomes an index of a list, which has 32 bits on some machines
        if sum.unsigned_abs() <= kept.unsigned_abs() {
            frequent[(sum + kept) as usize].clone()
        } else {
            S::from_quotient(*sum, denominator)
        }
    };
    if sums.len() < paths.parallel_from || threads::count() == 1 {
        return sums.iter().map(quotient).collect();
    }
    let length = sums.len().div_ceil(PIECES * threads::count()).max(1);
    let pieces: Vec<&[i64]> = sums.chunks(length).collect();
    let of_piece = |(): &mut (), at: u64| {
        let piece = pieces[at as usize].iter();
        piece.map(quotient).collect::<Option<Vec<S>>>()
    };
    let mut values = Vec::with_capacity(sums.len());
    for piece in threads::map(pieces.len() as u64, &threads::States::new(|| ()), of_piece) {
        values.extend(piece?);
    }
    Some(values)
}

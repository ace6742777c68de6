//! The laws of the scalar traits, as functions that test an implementation.
//!
//! Two sides are equal if their difference, which is a [`Sum`], counts as zero. The [`Tolerance`]
//! is relative to the terms of the sum. For exact scalars, this means that the sides are equal.

use super::{Field, Sum, Summable, Tolerance};
use std::fmt::Debug;

/// A law that a scalar violates, with a counterexample.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{law} fails for {values}")]
pub struct Broken {
    /// The law, as a formula.
    pub law: &'static str,
    /// The counterexample: the two sides of an equation, or the operands of another law.
    pub values: String,
}

/// Checks the laws of [`Ring`](super::Ring) on three values.
///
/// ```
/// use affinor_tensors::{Rational, Ring, Tolerance, scalar::laws};
/// let [a, b, c] = [7, -2, 0].map(|n| Rational::from_quotient(n, 3).unwrap());
/// laws::ring(&a, &b, &c, Tolerance::default())?;
/// # Ok::<(), laws::Broken>(())
/// ```
///
/// # Errors
/// The first law that is violated.
pub fn ring<S: Summable>(a: &S, b: &S, c: &S, tolerance: Tolerance) -> Result<(), Broken> {
    addition(a, b, c, tolerance)?;
    multiplication(a, b, c, tolerance)?;
    zero(a, b, tolerance)?;
    sums(a, b, c, tolerance)?;
    integers::<S>(tolerance)?;
    quotients(&[a, b, c], tolerance)
}

/// Checks the laws of [`Ring`](super::Ring) and [`Field`] on three values.
///
/// # Errors
/// The first law that is violated.
pub fn field<S: Field + Summable>(a: &S, b: &S, c: &S, tolerance: Tolerance) -> Result<(), Broken> {
    ring(a, b, c, tolerance)?;
    let one = S::one();
    holds("recip(0) does not exist", S::zero().recip().is_none(), &[a])?;
    match one.recip() {
        Some(x) => same(tolerance, "recip(1) = 1", &x, &one, &[])?,
        None => return holds("recip(1) = 1", false, &[&one]),
    }
    for x in [a, b, c] {
        holds("pivot_weight(a) is a number", !x.pivot_weight().is_nan(), &[x])?;
        if let Some(inverse) = x.recip() {
            same(tolerance, "recip(a) a = 1", &(inverse.clone() * x), &one, &[(&inverse, x)])?;
            match inverse.recip() {
                Some(back) => same(tolerance, "recip(recip(a)) = a", &back, x, &[])?,
                None => return holds("recip(recip(a)) = a", false, &[x, &inverse]),
            }
        }
    }
    // a product must be a unit exactly if both factors are units; this implies that no non-unit has
    // an inverse
    let product = a.clone() * b;
    match (a.recip(), b.recip(), product.recip()) {
        (Some(x), Some(y), Some(z)) => {
            same(tolerance, "recip(a b) = recip(a) recip(b)", &(x.clone() * &y), &z, &[(&x, &y)])
        }
        (x, y, z) => holds(
            "a b is a unit exactly if a and b are",
            z.is_some() == (x.is_some() && y.is_some()),
            &[a, b, &product],
        ),
    }
}

fn addition<S: Summable>(a: &S, b: &S, c: &S, tolerance: Tolerance) -> Result<(), Broken> {
    let one = S::one();
    let terms = [(a, &one), (b, &one), (c, &one)];
    let sum = a.clone() + b;
    let (left, right) = (sum.clone() + c, a.clone() + &(b.clone() + c));
    same(tolerance, "a + b = b + a", &sum, &(b.clone() + a), &terms)?;
    same(tolerance, "(a + b) + c = a + (b + c)", &left, &right, &terms)?;
    same(tolerance, "a + b by value = by reference", &(a.clone() + b.clone()), &sum, &terms)?;
    same(tolerance, "a + 0 = a", &(a.clone() + &S::zero()), a, &[])?;
    same(tolerance, "-(-a) = a", &-(-a.clone()), a, &[])?;
    same(tolerance, "a - b = a + (-b)", &(a.clone() - b), &(a.clone() + &-b.clone()), &terms)
}

fn multiplication<S: Summable>(a: &S, b: &S, c: &S, tolerance: Tolerance) -> Result<(), Broken> {
    let (ab, ac, bc) = (a.clone() * b, a.clone() * c, b.clone() * c);
    let (left, right) = (ab.clone() * c, a.clone() * &bc);
    same(tolerance, "a b = b a", &ab, &(b.clone() * a), &[(a, b)])?;
    same(tolerance, "(a b) c = a (b c)", &left, &right, &[(&ab, c), (a, &bc)])?;
    same(tolerance, "a b by value = by reference", &(a.clone() * b.clone()), &ab, &[(a, b)])?;
    let (left, right) = (a.clone() * &(b.clone() + c), ab.clone() + &ac);
    same(tolerance, "a (b + c) = a b + a c", &left, &right, &[(a, b), (a, c)])?;
    same(tolerance, "a 1 = a", &(a.clone() * &S::one()), a, &[])?;
    same(tolerance, "a 0 = 0", &(a.clone() * &S::zero()), &S::zero(), &[])?;
    same(tolerance, "(-a) b = -(a b)", &(-a.clone() * b), &-ab, &[(a, b)])
}

/// Checks that all tests for zero agree, and that they test the whole value.
fn zero<S: Summable>(a: &S, b: &S, tolerance: Tolerance) -> Result<(), Broken> {
    holds("0 vanishes", S::zero().vanishes(), &[&S::zero()])?;
    holds("1 does not vanish", !S::one().vanishes(), &[&S::one()])?;
    let none = a.clone() + &-a.clone();
    holds("a + (-a) vanishes", none.vanishes(), &[a, &none])?;
    let (sum, product) = (a.clone() + b, a.clone() * b);
    for x in [a, b, &none, &sum, &product] {
        holds("a = a", x.clone() == *x, &[x])?;
        holds("a vanishes exactly if a = 0", x.vanishes() == (*x == S::zero()), &[x])?;
        let term = S::Sum::term(x).finish(tolerance).is_none();
        holds("a vanishes exactly if its sum does", x.vanishes() == term, &[x])?;
    }
    let difference = a.clone() - b;
    holds("a - b vanishes exactly if a = b", difference.vanishes() == (a == b), &[a, b])
}

fn sums<S: Summable>(a: &S, b: &S, c: &S, tolerance: Tolerance) -> Result<(), Broken> {
    let one = S::one();
    let value = |sum: S::Sum| sum.finish(tolerance).unwrap_or_else(S::zero);
    let ab = a.clone() * b;
    let terms = [(a, b), (c, &one)];
    same(tolerance, "term(a) = a", &value(S::Sum::term(a)), a, &[])?;
    same(tolerance, "product(a, b) = a b", &value(S::Sum::product(a, b)), &ab, &[(a, b)])?;
    let expected = ab + c;
    let mut sum = S::Sum::product(a, b);
    sum.add_term(c);
    same(tolerance, "product(a, b).add_term(c) = a b + c", &value(sum), &expected, &terms)?;
    let mut sum = S::Sum::term(c);
    sum.add_product(a, b);
    same(tolerance, "term(c).add_product(a, b) = a b + c", &value(sum), &expected, &terms)?;
    let mut sum = S::Sum::product(a, b);
    sum.add_product(&-b.clone(), a);
    holds("the sum a b + (-b) a is zero", sum.finish(tolerance).is_none(), &[a, b])
}

/// Checks that `from_i64` is the ring homomorphism from the integers.
fn integers<S: Summable>(tolerance: Tolerance) -> Result<(), Broken> {
    let (of, one) = (S::from_i64, S::one());
    same(tolerance, "from_i64(0) = 0", &of(0), &S::zero(), &[])?;
    same(tolerance, "from_i64(1) = 1", &of(1), &one, &[])?;
    let samples = [0, 1, -1, 2, -3, 12, 1 << 31, -(1 << 53) - 1, i64::MAX, i64::MIN];
    for m in samples {
        for n in samples {
            let (x, y) = (of(m), of(n));
            if let Some(sum) = m.checked_add(n) {
                let law = "from_i64(m + n) = from_i64(m) + from_i64(n)";
                same(tolerance, law, &of(sum), &(x.clone() + &y), &[(&x, &one), (&y, &one)])?;
            }
            if let Some(product) = m.checked_mul(n) {
                let law = "from_i64(m n) = from_i64(m) from_i64(n)";
                same(tolerance, law, &of(product), &(x * &y), &[])?;
            }
        }
    }
    Ok(())
}

/// Checks that `from_quotient(n, d)` is n / d, and that it inverts `clear_denominators`.
fn quotients<S: Summable>(values: &[&S], tolerance: Tolerance) -> Result<(), Broken> {
    let parts = [0, 1, -1, 6, -10, i64::MAX, i64::MIN];
    for n in parts {
        holds("n / 0 does not exist", S::from_quotient(n, 0).is_none(), &[n])?;
        let whole = S::from_quotient(n, 1).is_some_and(|x| x == S::from_i64(n));
        holds("from_quotient(n, 1) = from_i64(n)", whole, &[n])?;
        for d in parts {
            if let Some(x) = S::from_quotient(n, d) {
                let product = x * &S::from_i64(d);
                same(tolerance, "from_quotient(n, d) d = n", &product, &S::from_i64(n), &[])?;
            }
        }
    }
    let Some((integers, denominator)) = S::clear_denominators(values.iter().copied()) else {
        return Ok(());
    };
    let law = "clear_denominators preserves the number of values, and the denominator is positive";
    holds(law, integers.len() == values.len() && denominator > 0, values)?;
    for (integer, value) in integers.iter().zip(values) {
        let back = S::from_quotient(*integer, denominator);
        let law = "from_quotient brings back what clear_denominators took";
        holds(law, back.as_ref() == Some(*value), &[*value])?;
    }
    Ok(())
}

/// Checks that two sides are equal up to the tolerance. The tolerance is relative to the magnitudes
/// of the sides and of the given intermediate products.
fn same<S: Summable>(
    tolerance: Tolerance,
    law: &'static str,
    left: &S,
    right: &S,
    products: &[(&S, &S)],
) -> Result<(), Broken> {
    // subtracts `right` by adding its product with -1, because the negative of `right` may not
    // exist in a type of limited range
    let mut difference = S::Sum::term(left);
    difference.add_product(right, &-S::one());
    for (a, b) in products {
        difference.add_product(a, b);
        difference.add_product(a, &-(*b).clone());
    }
    holds(law, difference.finish(tolerance).is_none(), &[left, right])
}

fn holds<T: Debug>(law: &'static str, holds: bool, values: &[T]) -> Result<(), Broken> {
    let values = || values.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>().join(", ");
    holds.then_some(()).ok_or_else(|| Broken { law, values: values() })
}

//! Rational functions over factored denominators, against fractions that are brought to lowest terms by
//! a greatest common divisor after each operation (`zippel_gcd::Frac`).

use crate::common::property::properties;
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Field, Rational, Ring, Sum, Summable, Symbolic, Tolerance};
use num_rational::BigRational;
use num_traits::{One, Zero};
use polycore::{Monomial, Order, Poly};
use proptest::prelude::*;
use std::collections::BTreeMap;
use zippel_gcd::Frac;

const NAMES: [&str; 3] = ["a", "b", "c"];

/// Polynomials that become denominators: irreducible ones, products, powers, and cubes in all
/// variables, which no rule of the engine proves irreducible or factors.
const PARTS: [&str; 12] = [
    "a",
    "a + b",
    "a - b",
    "a*b*c",
    "a^2 + b^2",
    "a^2 - b^2",
    "2*a*b - 3*c^2 + 1",
    "a^3 + b^3",
    "(a + b)^2*(a*c + 1)",
    "a^3*b^3 + c^3",
    "(a^3 + b^3)*(a^3 + c^3 + 2)",
    "a^3 + c^3 + 2",
];

/// A value under test, and the same value by greatest common divisors.
#[derive(Clone, Debug)]
struct Pair(Symbolic, Frac);

/// The polynomial in three variables that equals a value without a denominator.
fn polynomial(value: &Symbolic) -> Poly<BigRational> {
    let terms = value.terms().into_iter().map(|(powers, c)| {
        let mut exponents = vec![0; NAMES.len()];
        for (name, e) in powers {
            exponents[NAMES.iter().position(|n| *n == name.text()).unwrap()] = e;
        }
        (Monomial::new(exponents), BigRational::from(&c))
    });
    Poly::new(terms.collect(), NAMES.len(), Order::GrLex)
}

impl Pair {
    fn of(text: &str) -> Self {
        let value: Symbolic = text.parse().unwrap();
        let fraction = Frac::from(polynomial(&value));
        Pair(value, fraction)
    }

    /// Checks that both are the same quotient in lowest terms.
    fn agrees(&self) -> Result<(), TestCaseError> {
        let Pair(value, fraction) = self;
        let (above, below) = (polynomial(&value.numerator()), polynomial(&value.denominator()));
        prop_assert_eq!(below.monic(), fraction.den().reorder(Order::GrLex), "of {}", value);
        let unit = below.lc().unwrap();
        let above = above.scale(&(BigRational::one() / unit));
        prop_assert_eq!(above, fraction.num().reorder(Order::GrLex), "of {}", value);
        Ok(())
    }
}

/// One step of a computation: an operation with one of the polynomials.
fn steps() -> impl Strategy<Value = Vec<(u8, usize, usize)>> {
    prop::collection::vec((0u8..5, 0..PARTS.len(), 0..PARTS.len()), 1..=5)
}

/// The values after each step; equal values occur again with other histories.
fn history(steps: &[(u8, usize, usize)]) -> Vec<Pair> {
    let parts: Vec<Pair> = PARTS.iter().map(|text| Pair::of(text)).collect();
    let mut values = vec![Pair::of("1")];
    for (kind, p, q) in steps {
        let Pair(v, f) = values.last().unwrap().clone();
        let (Pair(a, x), Pair(b, y)) = (parts[*p].clone(), parts[*q].clone());
        values.push(match kind {
            0 => Pair(v + &(a / &b), f + x / y),
            1 => Pair(v - &(a / &b), f - x / y),
            2 => Pair(v * &(a / &b), f * (x / y)),
            3 => Pair(v / &a + &b.recip().unwrap(), f / x + Frac::one() / y),
            _ if v.vanishes() => Pair(a, x),
            _ => Pair(a / &v + &b, x / f + y),
        });
    }
    values
}

properties! {
    #![cases(12)]

    #[test]
    fn lowest_terms_are_those_of_common_divisors(steps in steps()) {
        for pair in history(&steps) {
            pair.agrees()?;
        }
    }

    /// A sum that is reduced once at its end equals the sum of its partial sums.
    #[test]
    fn sums_at_once_are_sums_in_steps(left in steps(), right in steps()) {
        let (left, right) = (history(&left), history(&right));
        let mut sum = <Symbolic as Summable>::Sum::default();
        let mut expected = Pair::of("0");
        for (Pair(a, x), Pair(b, y)) in left.into_iter().zip(right) {
            sum.add_product(&a, &b);
            sum.add_term(&b);
            expected = Pair(expected.0 + &(a * &b) + &b, expected.1 + x * y.clone() + y);
        }
        let value = sum.finish(Tolerance::default()).unwrap_or_else(Symbolic::zero);
        prop_assert_eq!(&value, &expected.0);
        prop_assert_eq!(value.to_string(), expected.0.to_string());
        expected.agrees()?;
        sum.add_term(&-value);
        prop_assert_eq!(sum.finish(Tolerance::default()), None);
    }

    /// Exponents and coefficients beyond machine integers use another code path, with the same
    /// values.
    #[test]
    fn substitution_commutes_with_sums(steps in steps(), large in 20u32..=60) {
        let power = |name: &str| num_traits::pow(Symbolic::parameter(name), large as usize);
        let scale = Symbolic::constant(Rational::from_digits(&"7".repeat(large as usize)).unwrap());
        let values: BTreeMap<String, Symbolic> =
            [("a".into(), power("a")), ("b".into(), scale * &Symbolic::parameter("b"))].into();
        let image = |value: &Symbolic| value.substitute(&values).unwrap();
        let history = history(&steps[..steps.len().min(3)]);
        for pair in history.windows(2) {
            let [Pair(v, _), Pair(w, _)] = pair else { continue };
            prop_assert_eq!(image(&(v.clone() + w)), image(v) + &image(w));
            prop_assert_eq!(image(&(v.clone() * w)), image(v) * &image(w));
        }
    }
}

/// A full symmetric matrix of symbols.
fn symmetric(n: usize) -> Vec<Vec<Symbolic>> {
    let entry = |i: usize, j: usize| Symbolic::parameter(&format!("g{}{}", i.min(j), i.max(j)));
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

/// The inverse is the adjugate over the determinant, which has 5, 17, 73 terms (OEIS A002135).
#[test]
fn inverses_have_the_determinant_below() {
    for (n, terms) in [(2, 2), (3, 5), (4, 17), (5, 73)] {
        let matrix = Matrix::from_dense(&symmetric(n)).unwrap();
        let determinant = matrix.determinant().unwrap();
        assert_eq!(determinant.terms().len(), terms);
        let inverse = matrix.inverse().unwrap();
        assert_eq!(matrix.mul(&inverse).unwrap(), Matrix::identity(n));
        for (_, _, value) in inverse.entries() {
            assert_eq!(value.denominator(), determinant);
        }
    }
}

/// The determinant of two blocks is not a separate factor: a sum over one block has one factor.
#[test]
fn blocks_have_factors_of_their_own() {
    let [a, b] = ["x*y - z^2", "u*v - w^2"].map(|text| text.parse::<Symbolic>().unwrap());
    let product = (a.clone() * &b).recip().unwrap();
    assert_eq!(product.to_string(), "1/((x*y - z^2)*(u*v - w^2))");
    assert_eq!((product.clone() * &b).to_string(), "1/(x*y - z^2)");
    let half = a.recip().unwrap() + &b.recip().unwrap();
    assert_eq!(half.clone() / &(a + &b), product);
    assert_eq!(half.to_string(), "(u*v - w^2 + x*y - z^2)/((x*y - z^2)*(u*v - w^2))");
}

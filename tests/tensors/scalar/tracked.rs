//! Floats that track their rounding errors: the values of `f64`, the same zero tests within one sum
//! of inputs, and right zero tests beyond.

use crate::common::property::properties;
use affinor_tensors::linear::Matrix;
use affinor_tensors::scalar::{Function, laws};
use affinor_tensors::{
    Down, Field, Notation, Rational, Ring, Scalar, Sum, Summable, Tensor, Tolerance, TrackedFloat,
    Up, contract,
};
use num_traits::Zero;
use proptest::collection::vec;
use proptest::prelude::*;

/// The scalar under test.
type Float = TrackedFloat;

fn float(value: &Rational) -> Float {
    TrackedFloat::from_rational(value).unwrap()
}

/// Whether the value minus its error is the exact value, to the second order of the rounding error.
fn is_right(value: &Float, exact: &Rational) -> bool {
    let exact = exact.to_f64();
    let left = (value.value() - exact) - value.error();
    left.abs() <= 1e-13 * exact.abs() + 1e-3 * value.error().abs()
}

/// Thirds, sevenths and tenths, which are not exact in floats.
fn quotient() -> impl Strategy<Value = Rational> {
    let denominators = prop::sample::select(vec![1i64, 3, 7, 10]);
    (-9i64..=9, denominators).prop_map(|(n, d)| Rational::new(n, d).unwrap())
}

/// A power of ten.
fn scale(exponent: i32) -> Rational {
    let power = Rational::from(10i64.pow(exponent.unsigned_abs()));
    if exponent < 0 { power.recip().unwrap() } else { power }
}

fn scales(n: usize) -> impl Strategy<Value = Vec<Rational>> {
    vec((-8i32..=8).prop_map(scale), n)
}

/// A matrix of quotients with zeros in it.
fn matrix(n: usize) -> impl Strategy<Value = Vec<Vec<Rational>>> {
    let entry = prop_oneof![2 => Just(Rational::from(0)), 3 => quotient()];
    vec(vec(entry, n), n)
}

fn scaled(rows: &[Vec<Rational>], left: &[Rational], right: &[Rational]) -> Matrix<Rational> {
    let row = |(row, l): (&Vec<Rational>, &Rational)| -> Vec<_> {
        row.iter().zip(right).map(|(v, r)| v.clone() * l * r).collect()
    };
    Matrix::from_dense(&rows.iter().zip(left).map(row).collect::<Vec<_>>()).unwrap()
}

fn places<S: Scalar>(matrix: &Matrix<S>) -> Vec<(usize, usize)> {
    matrix.entries().map(|(i, j, _)| (i, j)).collect()
}

/// Random numbers between -1 and 1.
fn noise() -> impl FnMut() -> f64 {
    let mut state = 1u64;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn dense(rows: usize, columns: usize, mut entry: impl FnMut() -> f64) -> Matrix<Float> {
    let rows =
        (0..rows).map(|_| (0..columns).map(|_| entry().into()).collect()).collect::<Vec<_>>();
    Matrix::from_dense(&rows).unwrap()
}

properties! {
    #![cases(256)]

    #[test]
    fn laws([a, b, c] in [quotient(), quotient(), quotient()], [x, y, z] in [-30..30i32, -30..30, -30..30]) {
        let [a, b, c] = [(a, x), (b, y), (c, z)].map(|(v, e)| {
            Float::new(v.to_f64() * f64::from(e).exp2())
        });
        laws::field(&a, &b, &c, Tolerance::default())?;
    }

    /// For one sum of products of inputs the zero test agrees with `f64`, to the last bit of the
    /// tolerance.
    #[test]
    fn one_sum_is_judged_as_in_f64(
        products in vec((-2.0..2.0f64, -2.0..2.0f64), 1..6),
        near in -3..=3i32,
    ) {
        let sum: f64 = products.iter().map(|(a, b)| a * b).sum();
        let size: f64 = products.iter().map(|(a, b)| (a * b).abs()).sum::<f64>() + sum.abs();
        let tolerance = Tolerance::default();
        // the term that brings the sum to the threshold
        let last = -sum * (1.0 + f64::from(near) * f64::EPSILON)
            + tolerance.relative() * size * (1.0 + f64::from(near) * f64::EPSILON);
        let mut plain = <f64 as Summable>::Sum::term(&last);
        let mut tracked = <Float as Summable>::Sum::term(&last.into());
        for (a, b) in products {
            plain.add_product(&a, &b);
            tracked.add_product(&a.into(), &b.into());
        }
        let plain = plain.finish(tolerance).map(Float::from);
        prop_assert_eq!(tracked.finish(tolerance), plain);
    }

    /// Products in two orders, in any units: their difference counts as zero, but other values do
    /// not.
    #[test]
    fn rounding_is_zero_in_later_stages(
        [a, b, c] in [matrix(4), matrix(4), matrix(4)],
        [p, q, r, s] in [scales(4), scales(4), scales(4), scales(4)],
    ) {
        let tensor = |rows: &[Vec<Rational>], left: &[Rational], right: &[Rational]| {
            let rows = scaled(rows, left, right);
            let entries = rows.entries().map(|(i, j, v)| ([i, j], v.clone()));
            Tensor::from_components(4, &[Up, Down], entries).unwrap()
        };
        // units that cancel between the factors
        let inverse = |d: &[Rational]| -> Vec<_> { d.iter().map(|v| v.recip().unwrap()).collect() };
        let a = tensor(&a, &p, &q);
        let b = tensor(&b, &inverse(&q), &r);
        let c = tensor(&c, &inverse(&r), &s);
        let product = |x: &Tensor<Float>, y: &Tensor<Float>| {
            contract("A^i_k B^k_j -> ^i_j", &[("A", x), ("B", y)]).unwrap()
        };
        let [x, y, z] = [&a, &b, &c].map(|t| t.map(float));
        let (left, right) = (product(&product(&x, &y), &z), product(&x, &product(&y, &z)));
        let difference = contract("A^i_j - B^i_j -> ^i_j", &[("A", &left), ("B", &right)])?;
        prop_assert!(difference.is_empty(), "{difference:?}");
        let further = product(&difference, &difference);
        prop_assert!(further.is_empty());

        let both = contract("A^i_k B^k_j -> ^i_j", &[("A", &a), ("B", &b)])?;
        let both = contract("A^i_k B^k_j -> ^i_j", &[("A", &both), ("B", &c)])?;
        let support = |at: Vec<usize>| at;
        let expected: Vec<_> = both.components().map(|(at, _)| support(at.to_vec())).collect();
        let found: Vec<_> = left.components().map(|(at, _)| support(at.to_vec())).collect();
        prop_assert_eq!(found, expected);
        for (at, value) in left.components() {
            prop_assert!(is_right(value, &both.get(&at)), "{value:?} for {}", both.get(&at));
        }
    }

    /// The inverse has the zeros of the exact inverse, in any units of rows and columns, also if
    /// the elimination divides by small entries.
    #[test]
    fn inverses_have_their_zeros(
        rows in (1..=7usize).prop_flat_map(matrix),
        left in scales(7),
        right in scales(7),
    ) {
        let exact = scaled(&rows, &left, &right);
        let found = exact.map(float).inverse();
        let Some(expected) = exact.inverse() else { return Ok(()) };
        let found = found.unwrap();
        prop_assert_eq!(places(&found), places(&expected), "{} for {}", found, expected);
        for (i, j, value) in found.entries() {
            let exact = expected.get(i, j);
            prop_assert!(is_right(value, &exact), "{value:?} for {exact}");
        }
    }

    /// The error belongs to the value, in every operation.
    #[test]
    fn errors_are_those_of_the_values(
        [a, b, c, d] in [quotient(), quotient(), quotient(), quotient()],
        scales in scales(4),
    ) {
        let [a, b, c, d] = [(a, 0), (b, 1), (c, 2), (d, 3)].map(|(v, at)| v * &scales[at]);
        let [x, y, z, w] = [&a, &b, &c, &d].map(float);
        prop_assert!(is_right(&(x * y), &(a.clone() * &b)));
        prop_assert!(is_right(&(x * y + z), &(a.clone() * &b + &c)));
        prop_assert!(is_right(&((x + y) * (z - w)), &((a.clone() + &b) * &(c.clone() - &d))));
        if let (Some(inverse), Some(exact)) = (w.recip(), d.recip()) {
            prop_assert!(is_right(&inverse, &exact));
            prop_assert!(is_right(&((x + y) * inverse), &((a + &b) * &exact)));
        }
    }

    /// Rows that are dependent through rounded products are dependent in floats too.
    #[test]
    fn ranks_of_products(
        n in 2..=6usize,
        a in vec(vec(quotient(), 3), 6),
        b in vec(vec(quotient(), 6), 3),
    ) {
        let [a, b] = [&a[..n], &b[..]].map(|rows| Matrix::from_dense(rows).unwrap());
        let exact = a.mul(&b)?;
        let product = a.map(float).mul(&b.map(float))?;
        prop_assert_eq!(product.rank()?, exact.rank()?);
        // with rounding errors of several stages in every entry
        let square = product.transpose().mul(&product)?;
        prop_assert_eq!(square.rank()?, exact.rank()?);
    }
}

/// The values are those of `f64`, in every computation.
#[test]
fn values_are_those_of_f64() {
    let mut next = noise();
    let [a, b] = [(); 2].map(|()| dense(12, 12, &mut next));
    let plain = |m: &Matrix<Float>| m.map(|v| v.value());
    assert_eq!(plain(&a.mul(&b).unwrap()), plain(&a).mul(&plain(&b)).unwrap());
    assert_eq!(plain(&a.inverse().unwrap()), plain(&a).inverse().unwrap());
    assert_eq!(a.determinant().unwrap().value(), plain(&a).determinant().unwrap());
    let vector: Vec<Float> = (0..12).map(|_| next().into()).collect();
    let values: Vec<f64> = vector.iter().map(|v| v.value()).collect();
    let solution = plain(&a).solve(&values).unwrap().unwrap();
    let found = a.solve(&vector).unwrap().unwrap();
    assert_eq!(found.iter().map(|v| v.value()).collect::<Vec<_>>(), solution);
}

/// The tracked errors do not grow in the elimination of large matrices.
#[test]
fn large_inverses_keep_their_digits() {
    for n in [20, 50, 120] {
        let mut next = noise();
        let a = dense(n, n, &mut next);
        assert_eq!(a.rank().unwrap(), n);
        assert!(!a.determinant().unwrap().is_zero());
        let inverse = a.inverse().unwrap();
        assert_eq!(inverse.entries().count(), n * n);
        let shares = inverse.entries().map(|(_, _, v)| v.error().abs() / v.value().abs());
        assert!(shares.fold(0.0, f64::max) < 1e-8, "{n}");
        let one = a.mul(&inverse).unwrap();
        assert_eq!(places(&one), places(&Matrix::<Float>::identity(n)), "{n}");
        let low = a.mul(&dense(n, n / 2, &mut next)).unwrap().mul(&dense(n / 2, n, &mut next));
        assert_eq!(low.unwrap().rank().unwrap(), n / 2, "{n}");
    }
}

/// NaN or an overflow never counts as zero, and does not affect other entries.
#[test]
fn what_is_no_number_stays() {
    for wild in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
        let value = Float::from(wild);
        assert!(!value.is_number() && !value.vanishes());
        let mut sum = <Float as Summable>::Sum::term(&value);
        sum.add_product(&value, &Float::from(-1.0));
        let sum = sum.finish(Tolerance::default()).unwrap();
        assert!(!sum.is_number() && (sum * Float::zero()).value().is_nan());
    }
    // magnitudes that overflow do not decide
    let large = Float::from(1e308);
    let mut sum = <Float as Summable>::Sum::term(&large);
    sum.add_term(&large);
    sum.add_term(&Float::from(-1.5e308));
    let infinite = sum.finish(Tolerance::default()).unwrap();
    assert!(!infinite.is_number());
    let singular = Matrix::from_dense(&[vec![Float::from(f64::NAN)]]).unwrap();
    assert!(singular.inverse().is_none());
}

/// With zero tolerance only exact zeros count as zero.
#[test]
fn without_a_tolerance_rounding_is_kept() {
    let exactly = Tolerance::new(0.0).unwrap();
    let [tenth, three] = [(1, 10), (3, 1)].map(|(n, d)| float(&Rational::new(n, d).unwrap()));
    let product = tenth * three - float(&Rational::new(3, 10).unwrap());
    let twice = Float::from(2.0) * product;
    assert!(<Float as Summable>::Sum::term(&twice).finish(exactly).is_some());
    assert!(<Float as Summable>::Sum::term(&twice).finish(Tolerance::default()).is_none());
}

/// An argument that a large term has made wrong by some 1e-7 has the function of the right argument, once corrected.
#[test]
fn functions_follow_the_rounding_of_their_arguments() {
    let large = float(&Rational::from(1i64 << 30));
    for function in Function::ALL {
        for n in 1..40 {
            let exact = Rational::new(n, 7).unwrap();
            let argument = float(&exact) + large - large;
            assert!(argument.error() != 0.0 || n % 7 == 0, "{function} {exact}");
            let expected = function.value(exact.to_f64());
            if expected.abs() > 10.0 && function == Function::Tan {
                // next to a pole the second order of the error counts
                continue;
            }
            let found = argument.applied(function);
            assert!(
                (found.corrected() - expected).abs() <= 1e-12 * (1.0 + expected.abs()),
                "{function}({exact}) is {expected}, not {found:?}"
            );
        }
    }
    // the slope of a root is infinite at zero
    assert_eq!(Float::zero().applied(Function::Sqrt).corrected(), 0.0);
    let third = float(&Rational::new(1, 3).unwrap());
    let noise = third + large - large - third;
    assert!(noise.value() != 0.0 && noise.significant(Tolerance::default()).is_none());
}

//! The scalars satisfy the laws, and rationals agree with another implementation.

mod effort;
mod float;
mod jet;
mod recorded;
mod symbolic;
mod tracked;

use crate::common::dual;
use crate::common::property::properties;
use affinor_tensors::scalar::laws;
use affinor_tensors::{
    Field, Notation, Rational, Ring, Scalar, Sum, Summable, Symbolic, Tolerance,
};
use dual::Dual;
use num_bigint::BigInt;
use num_dual::Dual64;
use num_rational::{BigRational, Ratio};
use num_traits::{One, Signed, ToPrimitive, Zero};
use proptest::prelude::*;
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher, Hash, Hasher};
use std::ops::{Add, Div, DivAssign, Mul, SubAssign};

type Test = Result<(), Box<dyn std::error::Error>>;

/// Integers near the limits of 64-bit arithmetic, small ones and random ones.
fn word() -> impl Strategy<Value = i64> {
    let corner = prop::sample::select(vec![i64::MIN, i64::MAX, 1 << 32, 1 << 53, 3_037_000_500]);
    prop_oneof![
        2 => -12i64..=12,
        1 => any::<i64>(),
        2 => (corner, -3i64..=3).prop_map(|(corner, step)| corner.saturating_add(step)),
    ]
}

fn denominator() -> impl Strategy<Value = i64> {
    word().prop_filter("not zero", |n| *n != 0)
}

fn oracle(n: i64, d: i64) -> BigRational {
    BigRational::new(n.into(), d.into())
}

/// A rational and the same number in the other implementation; sometimes beyond 64 bits.
fn pair() -> impl Strategy<Value = (Rational, BigRational)> {
    let quotient = (word(), denominator());
    let small = quotient.prop_map(|(n, d)| (Rational::new(n, d).unwrap(), oracle(n, d)));
    let parts = prop::collection::vec((word(), denominator()), 2..4);
    let big = parts.prop_map(|parts| {
        let product: BigRational = parts.iter().map(|(n, d)| oracle(*n, *d)).product();
        let value = product + oracle(1, 3);
        (Rational::from(value.clone()), value)
    });
    prop_oneof![3 => small, 1 => big]
}

fn rational() -> impl Strategy<Value = Rational> {
    pair().prop_map(|(value, _)| value)
}

/// Floats of many magnitudes such that products of three stay within the range.
fn float() -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => prop::sample::select(vec![0.0, -0.0, 1.0, -1.0, 0.1, 1e-20]),
        3 => -2.0..2.0f64,
        2 => (-2.0..2.0f64, -90..90i32).prop_map(|(x, n)| x * f64::from(n).exp2()),
    ]
}

/// Quotients of polynomials in a and b of low degree.
fn symbolic() -> impl Strategy<Value = Symbolic> {
    let polynomial = || {
        prop::collection::vec((-3i64..=3, 0u32..3, 0u32..2), 0..3).prop_map(|terms| {
            terms.iter().fold(Symbolic::zero(), |sum, (n, p, q)| {
                let power =
                    |name, e| (0..e).fold(Symbolic::one(), |x, _| x * Symbolic::parameter(name));
                sum + Symbolic::from_i64(*n) * power("a", *p) * power("b", *q)
            })
        })
    };
    (polynomial(), polynomial()).prop_map(|(n, d)| match d.recip() {
        Some(inverse) => n * inverse,
        None => n,
    })
}

/// Dual numbers with short binary fractions: sums and products are exact, so an infinitesimal part
/// that cancels leaves no rounding error.
fn dual_number() -> impl Strategy<Value = Dual<true>> {
    let part = || prop_oneof![1 => Just(0.0), 3 => (-64i32..64).prop_map(|n| f64::from(n) / 8.0)];
    (part(), part()).prop_map(|(re, eps)| Dual::new(re, eps))
}

properties! {
    #![cases(256)]

    #[test]
    fn rationals_are_a_field([a, b, c] in [rational(), rational(), rational()]) {
        // zero tolerance, because the scalar is exact
        laws::field(&a, &b, &c, Tolerance::new(0.0).unwrap())?;
    }

    #[test]
    fn floats_are_a_field_up_to_rounding([a, b, c] in [float(), float(), float()]) {
        laws::field(&a, &b, &c, Tolerance::default())?;
    }

    #[test]
    fn dual_numbers_obey_the_laws([a, b, c] in [dual_number(), dual_number(), dual_number()]) {
        laws::field(&a, &b, &c, Tolerance::default())?;
    }

    #[test]
    fn dual_numbers_of_num_dual_obey_the_laws(
        // num-dual's `==` compares real parts only, so these compare both parts, also up to sign
        parts in prop::array::uniform3((1i32..8, -64i32..64)),
    ) {
        let mut offset = -16;
        let [a, b, c] = parts.map(|(re, eps)| {
            offset += 16;
            Dual64::new(f64::from(re + offset) / 8.0, f64::from(eps) / 8.0)
        });
        laws::field(&a, &b, &c, Tolerance::default())?;
    }

    #[test]
    fn the_rationals_of_num_are_fields(
        words in prop::array::uniform3((-999i64..=999, 1i64..=99)),
        [(_, x), (_, y), (_, z)] in [pair(), pair(), pair()],
    ) {
        let exactly = Tolerance::new(0.0).unwrap();
        let [a, b, c] = words.map(|(n, d)| Ratio::new(n, d));
        laws::field(&a, &b, &c, exactly)?;
        laws::field(&x, &y, &z, exactly)?;
    }

    #[test]
    fn every_form_of_an_operator_is_the_same([a, b] in [rational(), rational()], [p, q] in [symbolic(), symbolic()]) {
        forms(&a, &b)?;
        forms(&p, &q)?;
        prop_assert_eq!([&a, &b].into_iter().sum::<Rational>(), &a + &b);
        prop_assert_eq!([p.clone(), q.clone()].into_iter().product::<Symbolic>(), &p * &q);
        prop_assert_eq!(a.to_string().parse::<Rational>()?, a);
        prop_assert_eq!(p.to_string().parse::<Symbolic>()?, p);
    }

    #[test]
    fn arithmetic_agrees_with_num((a, x) in pair(), (b, y) in pair()) {
        prop_assert_eq!(BigRational::from(&(a.clone() + &b)), &x + &y);
        prop_assert_eq!(BigRational::from(&(a.clone() - &b)), &x - &y);
        prop_assert_eq!(BigRational::from(&(a.clone() * &b)), &x * &y);
        prop_assert_eq!(BigRational::from(&-a.clone()), -&x);
        prop_assert_eq!(BigRational::from(&a.clone().abs()), x.abs());
        prop_assert_eq!(a.cmp(&b), x.cmp(&y));
        prop_assert_eq!(a == b, x == y);
        prop_assert_eq!(a.is_negative(), x.is_negative());
        prop_assert_eq!(a.is_integer(), x.is_integer());
        prop_assert_eq!(a.to_i64(), x.is_integer().then(|| x.to_integer().to_i64()).flatten());
        if y.is_zero() {
            prop_assert!(b.recip().is_none());
        } else {
            prop_assert_eq!(BigRational::from(&(a / &b)), x / y);
        }
    }

    #[test]
    fn text_and_conversions_agree_with_num((a, x) in pair(), n in word(), d in denominator()) {
        prop_assert_eq!(a.to_string(), x.to_string());
        prop_assert_eq!(&Rational::from(BigRational::from(&a)), &a);
        let words = x.numer().to_i64().zip(x.denom().to_i64());
        prop_assert_eq!(Ratio::<i64>::try_from(&a).ok().map(Ratio::into_raw), words);
        prop_assert_eq!(Rational::from(Ratio::new_raw(n, d)), Rational::from(oracle(n, d)));
        let digits = x.numer().abs().to_string();
        let integer = Rational::from(BigRational::from(x.numer().abs()));
        prop_assert_eq!(Rational::from_digits(&digits), Some(integer));
    }

    #[test]
    fn equal_values_are_equal_in_form((a, _) in pair(), (b, _) in pair()) {
        let hash = |r: &Rational| {
            let mut hasher = DefaultHasher::new();
            r.hash(&mut hasher);
            hasher.finish()
        };
        let far = Rational::from(i64::MAX) * &Rational::from(i64::MAX) + &b;
        let back = a.clone() + &far - &far;
        prop_assert_eq!(&back, &a);
        prop_assert_eq!(hash(&back), hash(&a));
        let back = a.clone() * &far / &far;
        prop_assert_eq!(&back, &a);
        prop_assert_eq!(hash(&back), hash(&a));
    }

    #[test]
    fn to_f64_is_the_nearest((a, x) in pair(), power in -1200i32..1200) {
        let scale = BigRational::from(BigInt::from(2).pow(power.unsigned_abs()));
        let x = if power < 0 { x / scale } else { x * scale };
        nearest(&Rational::from(x.clone()), &x)?;
        nearest(&a, &BigRational::from(&a))?;
    }

    #[test]
    fn decimals_round_as_the_standard_library_reads_them(n in any::<i64>(), k in 0u32..40) {
        let decimal = BigRational::new(n.into(), BigInt::from(10).pow(k));
        let read: f64 = format!("{n}e-{k}").parse().unwrap();
        prop_assert_eq!(Rational::from(decimal).to_f64(), read);
    }
}

properties! {
    #![cases(48)]
    #[test]
    fn rational_functions_are_a_field([a, b, c] in [symbolic(), symbolic(), symbolic()]) {
        laws::field(&a, &b, &c, Tolerance::new(0.0).unwrap())?;
    }
}

/// `a + b` and the other operations by value, by reference and by assignment.
fn forms<S>(a: &S, b: &S) -> Result<(), TestCaseError>
where
    S: Field + Scalar + Hash + Eq + Default + for<'s> DivAssign<&'s S> + for<'s> SubAssign<&'s S>,
    for<'s> &'s S: Add<S, Output = S> + Add<Output = S> + Mul<Output = S> + Div<Output = S>,
{
    let sum = a.clone() + b;
    prop_assert_eq!(&(a + b), &sum);
    prop_assert_eq!(&(a + b.clone()), &sum);
    prop_assert_eq!(a * b, a.clone() * b);
    let mut back = sum.clone();
    back -= b;
    prop_assert_eq!(&back, a);
    let hash = |value: &S| BuildHasherDefault::<DefaultHasher>::default().hash_one(value);
    prop_assert_eq!(hash(&back), hash(a));
    if !b.vanishes() {
        let mut quotient = a * b;
        quotient /= b;
        prop_assert_eq!(&quotient, a);
        prop_assert_eq!(&(a / b) * b, a.clone());
    }
    prop_assert!(S::default().vanishes());
    Ok(())
}

/// Checks that neither neighbour is closer, and that of two equally close floats the even one is
/// chosen.
fn nearest(value: &Rational, exact: &BigRational) -> Result<(), TestCaseError> {
    let float = value.to_f64();
    if float.is_infinite() {
        let edge = BigInt::from(2).pow(1024) - BigInt::from(2).pow(970);
        prop_assert!(exact.abs() >= BigRational::from(edge));
        prop_assert_eq!(float.is_sign_negative(), exact.is_negative());
        return Ok(());
    }
    let distance = |x: f64| BigRational::from_float(x).map(|x| (x - exact).abs());
    let own = distance(float).unwrap();
    for neighbour in [float.next_up(), float.next_down()] {
        if let Some(other) = distance(neighbour) {
            let even = float.to_bits().is_multiple_of(2);
            prop_assert!(own < other || (own == other && even), "{value}: {float:e}");
        }
    }
    Ok(())
}

#[test]
#[should_panic(expected = "the sum overflows Ratio<i64>")]
fn a_sum_of_word_rationals_panics_rather_than_wraps() {
    let largest = Ratio::from_integer(i64::MAX);
    let mut sum = <Ratio<i64> as Summable>::Sum::product(&largest, &largest);
    sum.add_product(&-largest, &(largest - 1));
    // the products far exceed 64 bits, but their sum does not
    assert_eq!(sum.finish(Tolerance::default()), Some(largest));
    sum.add_term(&largest);
    let _: Option<Ratio<i64>> = sum.finish(Tolerance::default());
}

#[test]
fn conversions_of_scalars() -> Test {
    assert_eq!((Rational::from(2), Symbolic::from(2)), (2i64.into(), Rational::from(2i64).into()));
    let half: Rational = "1/4 + 0.25".parse()?;
    assert_eq!(ToPrimitive::to_i64(&half), None);
    assert_eq!(ToPrimitive::to_f64(&half), Some(0.5));
    assert_eq!(ToPrimitive::to_i64(&(&half * &Rational::from(-4))), Some(-2));
    let large = Rational::from(i64::MAX) + Rational::from(1);
    assert_eq!((large.to_u64(), ToPrimitive::to_i64(&large)), (Some(1 << 63), None));
    let value: Symbolic = "(a^2 - 1)/(a - 1) + sin(b)".parse()?;
    assert_eq!(value.to_latex(), r"a + \sin b + 1");
    assert_eq!("1/0".parse::<Rational>().unwrap_err().to_string(), "division by zero");
    Ok(())
}

#[test]
fn zero_means_the_whole_value() {
    let eps = Dual::<true>::new(0.0, 1.0);
    assert!(!eps.vanishes() && eps != Dual::zero());
    assert!(eps.recip().is_none());
    assert!((eps * eps).vanishes());
    assert!(eps.0.is_zero(), "the premise: num-dual itself looks at the real part alone");
}

#[test]
fn a_zero_that_forgets_a_part_breaks_the_laws() {
    let [a, b] = [Dual::<false>::new(0.0, 1.0), Dual::<false>::new(2.0, 3.0)];
    let broken = laws::ring(&a, &b, &b, Tolerance::default()).unwrap_err();
    assert_eq!(broken.law, "a vanishes exactly if a = 0");
}

#[test]
fn floats_break_the_laws_without_a_tolerance() {
    let exactly = Tolerance::new(0.0).unwrap();
    let broken = laws::ring(&0.1, &0.2, &0.3, exactly).unwrap_err();
    assert_eq!(broken.law, "(a + b) + c = a + (b + c)");
    assert_eq!(broken.to_string(), "(a + b) + c = a + (b + c) fails for 0.6000000000000001, 0.6");
}

#[test]
fn floats_without_a_finite_inverse_are_no_units() {
    for x in [0.0, -0.0, 5e-324, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert_eq!(Field::recip(&x), None, "{x}");
    }
    assert_eq!(Field::recip(&f64::MAX), Some(1.0 / f64::MAX));
}

#[test]
fn a_float_sum_that_overflows_is_not_zero() {
    type FloatSum = <f64 as Summable>::Sum;
    let finish = |sum: FloatSum| sum.finish(Tolerance::default());
    assert_eq!(finish(FloatSum::product(&1e200, &-1e200)), Some(f64::NEG_INFINITY));
    assert!(finish(FloatSum::term(&f64::NAN)).is_some_and(f64::is_nan));
    // finite, although the sum of the magnitudes of its terms overflows
    let mut sum = FloatSum::term(&1.5e308);
    sum.add_term(&-1e308);
    assert_eq!(finish(sum), Some(0.5e308));
    sum.add_term(&-0.5e308);
    assert_eq!(finish(sum), None);
}

#[test]
fn the_ends_of_the_words() -> Test {
    let [min, max] = [i64::MIN, i64::MAX].map(Rational::from);
    assert_eq!((-min.clone()).to_string(), "9223372036854775808");
    assert_eq!(-(-min.clone()), min);
    assert_eq!(-max.clone() - &Rational::one(), min);
    assert_eq!(min.recip().ok_or("unit")?.to_string(), "-1/9223372036854775808");
    assert_eq!(Rational::new(1, i64::MIN), min.recip());
    assert_eq!(Rational::new(i64::MIN, i64::MIN), Some(Rational::one()));
    assert_eq!(Rational::new(i64::MIN, -1), Some(-min.clone()));
    assert_eq!((min.clone() * &min).to_string(), "85070591730234615865843651857942052864");
    assert!(Rational::new(3, 0).is_none());
    assert!(Ratio::<i64>::try_from(&-min.clone()).is_err());
    assert_eq!(Notation::to_f64(&max), Some(2f64.powi(63)));
    // a sum of integers that equals the least number of 128 bits, and one below
    let half = Rational::from(1i64 << 32);
    let mut sum = <Rational as Summable>::Sum::product(&min, &max);
    sum.add_product(&min, &max);
    sum.add_product(&-half.clone(), &half);
    let least = sum.finish(Tolerance::default()).ok_or("not zero")?;
    assert_eq!(least.to_string(), "-170141183460469231731687303715884105728");
    sum.add_term(&-Rational::one());
    let below = sum.finish(Tolerance::default()).ok_or("not zero")?;
    assert_eq!(below - &least, -Rational::one());
    Ok(())
}

#[test]
fn only_digits_are_digits() {
    for text in ["", "-1", "+1", " 1", "1_000", "0x10", "1.0", "١", "-9223372036854775808"] {
        assert!(Rational::from_digits(text).is_none(), "{text}");
    }
    assert_eq!(Rational::from_digits("007"), Some(7.into()));
}

properties! {
    #![cases(256)]

    /// Sums that are reduced once at their end equal the sums in the field, also near the limits of
    /// machine integers.
    #[test]
    fn long_sums_agree_with_num(
        terms in prop::collection::vec((pair(), pair(), any::<bool>()), 1..12),
    ) {
        let mut sum = None::<<Rational as Summable>::Sum>;
        let mut expected = BigRational::from_integer(0.into());
        for ((a, x), (b, y), product) in &terms {
            expected += if *product { x * y } else { x.clone() };
            match (&mut sum, product) {
                (None, true) => sum = Some(Sum::product(a, b)),
                (None, false) => sum = Some(Sum::term(a)),
                (Some(sum), true) => sum.add_product(a, b),
                (Some(sum), false) => sum.add_term(a),
            }
        }
        let value = sum.unwrap().finish(Tolerance::default());
        prop_assert_eq!(value.is_none(), expected == BigRational::from_integer(0.into()));
        prop_assert_eq!(value.unwrap_or_else(|| Rational::from(0)), Rational::from(expected));
    }

    /// Terms and their negatives in any order have the sum zero.
    #[test]
    fn sums_that_cancel_vanish(terms in prop::collection::vec(pair(), 1..8)) {
        let mut sum = <Rational as Summable>::Sum::term(&Rational::from(0));
        terms.iter().for_each(|(a, _)| sum.add_product(a, a));
        terms.iter().rev().for_each(|(a, _)| sum.add_product(&-a.clone(), a));
        prop_assert_eq!(sum.finish(Tolerance::default()), None);
    }
}

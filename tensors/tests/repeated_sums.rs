//! Sums that occur again and again, from values that are dropped and made again.

use crate::common::property;
use affinor_tensors::{Field, Rational, Ring, Sum, Symbolic, Tolerance};
use proptest::prelude::*;
use std::collections::BTreeMap;

const NAMES: [&str; 3] = ["a", "b", "c"];

/// A value by its text, made anew each time.
fn value(at: usize) -> Symbolic {
    const TEXTS: [&str; 9] =
        ["a", "b", "-a", "a + b", "1/a", "c/(a + b)", "(a - b)/(a*c)", "2", "a*b*c + 1/3"];
    TEXTS[at].parse().unwrap()
}

/// The value where the parameters are 2, 3 and 7.
fn number(value: &Symbolic) -> Rational {
    let point =
        NAMES.iter().zip([2, 3, 7]).map(|(name, n)| (name.to_string(), Symbolic::from_i64(n)));
    let number = value.substitute(&point.collect::<BTreeMap<_, _>>()).unwrap();
    number.as_constant().unwrap().clone()
}

type Terms = Vec<(usize, usize)>;

fn terms() -> impl Strategy<Value = Vec<Terms>> {
    // few different sums, and some that are longer than those that are remembered
    let short = prop::collection::vec((0..9usize, 0..9usize), 1..4);
    let long = prop::collection::vec((0..9usize, 0..9usize), 20..30);
    prop::collection::vec(prop_oneof![9 => short, 1 => long], 1..60)
}

fn sum(terms: &Terms, values: &dyn Fn(usize) -> Symbolic) -> Symbolic {
    let mut sum = <Symbolic as Ring>::Sum::default();
    terms.iter().for_each(|(a, b)| sum.add_product(&values(*a), &values(*b)));
    sum.finish(Tolerance::default()).unwrap_or_default()
}

proptest! {
    #![proptest_config(property::cases(64))]

    #[test]
    fn sums_do_not_depend_on_what_was_computed_before(all in terms()) {
        let kept: Vec<Symbolic> = (0..9).map(value).collect();
        for terms in all.iter().chain(all.iter().rev()) {
            let expected = terms.iter().fold(Rational::from(0), |total, (a, b)| {
                total + &(number(&kept[*a]) * &number(&kept[*b]))
            });
            // from the same values, and from values that end with the sum
            let [same, anew] = [sum(terms, &|at| kept[at].clone()), sum(terms, &value)];
            prop_assert_eq!(number(&same), expected.clone());
            prop_assert_eq!(&same, &anew);
            prop_assert_eq!(same.to_string(), anew.to_string());
            prop_assert_eq!(same.to_string().parse::<Symbolic>().unwrap(), same.clone());
            prop_assert_eq!(number(&-same.clone()), -expected.clone());
            let half = Symbolic::constant(Rational::new(1, 2).unwrap());
            prop_assert_eq!(number(&(same * &half)), expected * &half.as_constant().unwrap().clone());
        }
    }
}

/// More different sums than are remembered.
#[test]
fn many_different_sums() {
    let [a, b] = ["a", "b"].map(Symbolic::parameter);
    let text = |n: i64| (a.clone() * &Symbolic::from_i64(n) + &b.recip().unwrap()).to_string();
    let all: Vec<String> = (1..20_000).map(text).collect();
    for (n, found) in (1..20_000).zip(&all).step_by(7) {
        assert_eq!(*found, text(n));
        assert_eq!(*found, if n == 1 { "(a*b + 1)/b".into() } else { format!("({n}*a*b + 1)/b") });
    }
}

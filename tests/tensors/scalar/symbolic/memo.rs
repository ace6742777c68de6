//! Sums that occur repeatedly, from values that are dropped and computed again.

use crate::common::property::properties;
use affinor_tensors::{Field, Rational, Ring, Sum, Summable, Symbolic, Tolerance};
use proptest::prelude::*;
use std::collections::BTreeMap;

const NAMES: [&str; 3] = ["a", "b", "c"];

/// The value of a text, computed anew each time.
fn value(at: usize) -> Symbolic {
    const TEXTS: [&str; 9] =
        ["a", "b", "-a", "a + b", "1/a", "c/(a + b)", "(a - b)/(a*c)", "2", "a*b*c + 1/3"];
    TEXTS[at].parse().unwrap()
}

/// The value at the parameters 2, 3 and 7.
fn number(value: &Symbolic) -> Rational {
    let point =
        NAMES.iter().zip([2, 3, 7]).map(|(name, n)| (name.to_string(), Symbolic::from_i64(n)));
    let number = value.substitute(&point.collect::<BTreeMap<_, _>>()).unwrap();
    number.as_constant().unwrap().clone()
}

type Terms = Vec<(usize, usize)>;

fn terms() -> impl Strategy<Value = Vec<Terms>> {
    // few different sums, and some that are too long to be remembered
    let short = prop::collection::vec((0..9usize, 0..9usize), 1..4);
    let long = prop::collection::vec((0..9usize, 0..9usize), 20..30);
    prop::collection::vec(prop_oneof![9 => short, 1 => long], 1..60)
}

fn sum(terms: &Terms, values: &dyn Fn(usize) -> Symbolic) -> Symbolic {
    let mut sum = <Symbolic as Summable>::Sum::default();
    terms.iter().for_each(|(a, b)| sum.add_product(&values(*a), &values(*b)));
    sum.finish(Tolerance::default()).unwrap_or_default()
}

properties! {
    #![cases(64)]

    #[test]
    fn sums_do_not_depend_on_what_was_computed_before(all in terms()) {
        let kept: Vec<Symbolic> = (0..9).map(value).collect();
        for terms in all.iter().chain(all.iter().rev()) {
            let expected = terms.iter().fold(Rational::from(0), |total, (a, b)| {
                total + &(number(&kept[*a]) * &number(&kept[*b]))
            });
            // from the same values, and from values that are dropped with the sum
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

/// Names of several lengths, ordered by their letters, by their numbers, or by the last digit.
const ORDERED: [&str; 10] =
    ["J1000000", "J1000001", "K", "a", "b2", "b10", "b10c", "omega1", "omega2", "x_1"];

/// A value of two parameters, also with functions and factors in the denominator.
fn shape(at: usize, [x, y]: [&str; 2]) -> Symbolic {
    let text = match at {
        0 => x.to_string(),
        1 => format!("({x} - {y})/(2*{x})"),
        2 => format!("({x}^2 + {x}*{y} - 3)/{y}"),
        3 => format!("-{y}/{x}"),
        4 => format!("{y}/({x} + {y})"),
        5 => format!("1/{x} + 1/{y} + {x}/3"),
        6 => format!("sqrt({x})*{y}"),
        7 => format!("sin({x})/{y}"),
        8 => format!("cos({x}/2) + {y}"),
        _ => format!("2/{x}^2"),
    };
    text.parse().unwrap()
}

type Shapes = Vec<[(usize, usize, usize); 2]>;

fn shapes() -> impl Strategy<Value = Shapes> {
    let one = |most: usize| (0..most, 0..3usize, 0..3usize);
    let plain = prop::collection::vec([one(4), one(4)], 1..5);
    let all = prop::collection::vec([one(10), one(10)], 1..4);
    prop_oneof![2 => plain, 1 => all]
}

/// The sum with these names, as text and in LaTeX; and its negative.
fn written(shapes: &Shapes, names: [&str; 3]) -> [String; 4] {
    let value = |(at, x, y): (usize, usize, usize)| {
        shape(at, [names[x], names[if y == x { (x + 1) % 3 } else { y }]])
    };
    let mut sum = <Symbolic as Summable>::Sum::default();
    shapes.iter().for_each(|[a, b]| sum.add_product(&value(*a), &value(*b)));
    let value = sum.finish(Tolerance::default()).unwrap_or_default();
    let negative = -value.clone();
    [value.to_string(), value.to_latex(), negative.to_string(), negative.to_latex()]
}

properties! {
    #![cases(64)]

    #[test]
    fn sums_in_other_names_are_those_of_a_thread_that_remembers_nothing(
        all in prop::collection::vec(shapes(), 1..6),
        renamed in prop::collection::vec(prop::sample::subsequence(&ORDERED[..], 3).prop_shuffle(), 2..8),
    ) {
        for names in renamed.iter().map(|names| [names[0], names[1], names[2]]) {
            for shapes in &all {
                let fresh = std::thread::scope(|scope| {
                    scope.spawn(|| written(shapes, names)).join().unwrap()
                });
                prop_assert_eq!(written(shapes, names), fresh, "{:?} {:?}", shapes, names);
            }
        }
    }
}

/// There are more different sums than are remembered.
#[test]
fn many_different_sums() {
    let [a, b] = ["a", "b"].map(Symbolic::parameter);
    let text = |n: i64| (a.clone() * &Symbolic::from_i64(n) + &b.recip().unwrap()).to_string();
    let all: Vec<String> = (1..80_000).map(text).collect();
    for (n, found) in (1..80_000).zip(&all).step_by(7) {
        assert_eq!(*found, text(n));
        assert_eq!(*found, if n == 1 { "(a*b + 1)/b".into() } else { format!("({n}*a*b + 1)/b") });
    }
}

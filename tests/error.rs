//! The error messages: each names its witness, and each error class exists in Python.

use crate::common::root;
use affinor::tensors::scalar::ExactSum;
use affinor::tensors::{Ring, Scalar, Summable};
use affinor::{Bracket, Error, Law};
use num_traits::{One, Zero};
use std::collections::BTreeSet;
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// Entries and a residual with values that do not occur in messages otherwise.
fn broken(law: Law) -> (Vec<String>, Error) {
    let count = law.parts().iter().map(|(_, names)| names.len()).sum();
    let at: Vec<_> = (0..count).map(|entry| format!("<{entry}>")).collect();
    (at.clone(), law.broken(at, "<residual>"))
}

#[test]
fn messages_contain_the_whole_witness() {
    for law in Law::ALL {
        let (at, error) = broken(*law);
        let message = error.to_string();
        for entry in &at {
            assert!(message.contains(entry), "{law:?}: {message}");
        }
        assert!(!message.contains(['{', '}']) && !message.contains("  "), "{law:?}: {message}");
        // only the value 0 may be missing
        let silent = [Law::KillingOnSubalgebra, Law::RegularPoint, Law::RegularTangent];
        assert_eq!(message.contains("<residual>"), !silent.contains(law), "{law:?}: {message}");
    }
}

/// A witness with missing or additional entries is printed without a panic.
#[test]
fn messages_accept_any_number_of_entries() {
    for law in Law::ALL {
        let (at, _) = broken(*law);
        for count in 0..at.len() + 2 {
            let entries: Vec<_> = (0..count).map(|entry| entry.to_string()).collect();
            assert!(!law.broken(entries, "").to_string().is_empty());
        }
    }
}

#[test]
fn parts_of_a_witness_have_different_keys() {
    for law in Law::ALL {
        let mut keys = BTreeSet::from(["residual"]);
        for (part, names) in law.parts() {
            assert!(keys.insert(part) && !names.is_empty(), "{law:?}: {part}");
        }
    }
}

#[test]
fn python_has_an_exception_for_each_class() {
    let path = root().join("python/pysrc/affinor/errors.py");
    let classes = std::fs::read_to_string(path).unwrap();
    let kinds = [
        Error::Name(String::new()),
        Error::NoMetric,
        Error::SingularBasis,
        Error::Shape { what: "", expected: String::new(), found: String::new() },
        Error::Degenerate { null: String::new(), components: vec![] },
        Error::Integration { t: 0.0, reason: String::new() },
        Error::Symmetry {
            what: "",
            symmetry: "",
            slots: [1, 2],
            at: vec![],
            residual: String::new(),
        },
    ];
    let laws = Law::ALL.iter().map(|law| broken(*law).1);
    for error in kinds.into_iter().chain(laws) {
        let class = error.class();
        assert!(classes.contains(&format!("class {class}(")), "{error:?}: {class}");
    }
}

/// Intervals with Moore's arithmetic: `x - x` contains zero, but is not zero.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Interval(i64, i64);

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[{}, {}]", self.0, self.1)
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $rule:expr;)+) => {$(
        impl $operator for Interval {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                let rule: fn(Self, Self) -> Self = $rule;
                rule(self, other)
            }
        }
        impl $operator<&Self> for Interval {
            type Output = Self;
            fn $method(self, other: &Self) -> Self {
                $operator::$method(self, *other)
            }
        }
    )+};
}
operators! {
    Add add |a, b| Interval(a.0 + b.0, a.1 + b.1);
    Sub sub |a, b| Interval(a.0 - b.1, a.1 - b.0);
    Mul mul |a, b| {
        let ends = [a.0 * b.0, a.0 * b.1, a.1 * b.0, a.1 * b.1];
        Interval(ends.into_iter().min().unwrap(), ends.into_iter().max().unwrap())
    };
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Interval(-self.1, -self.0)
    }
}

impl Zero for Interval {
    fn zero() -> Self {
        Interval(0, 0)
    }
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl One for Interval {
    fn one() -> Self {
        Interval(1, 1)
    }
}

impl Ring for Interval {
    fn from_i64(n: i64) -> Self {
        Interval(n, n)
    }
    fn vanishes(&self) -> bool {
        self.is_zero()
    }
}

impl Summable for Interval {
    type Sum = ExactSum<Self>;
}

impl Scalar for Interval {}

#[test]
fn numbers_without_negatives_are_refused_in_words() {
    let constants = |width: i64| [(0, 1, 2, Interval(1, 1 + width)), (1, 2, 0, Interval(1, 1))];
    assert!(Bracket::from_constants(["x", "y", "z"], constants(0)).is_ok());
    let error = Bracket::from_constants(["x", "y", "z"], constants(1)).unwrap_err();
    let message =
        "the numbers are not a ring: [1, 2] - [1, 2] = [-1, 1] instead of 0, as with intervals";
    assert_eq!(error.to_string(), message);
    assert!(error.advice().is_some());
}

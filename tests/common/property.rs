//! Properties of random values: how they are tested, on how many cases, and from which seed.
//!
//! A plain `cargo test` draws the same cases on every machine and writes no file. `AFFINOR_FRESH=20
//! cargo test --release` draws twenty times as many, from a new seed for each test. A failure then
//! prints its smallest input, which becomes a separate test, and the seed. `PROPTEST_RNG_SEED` with
//! the same `AFFINOR_FRESH` repeats the failure.

use proptest::prelude::{BoxedStrategy, ProptestConfig, Strategy};
use proptest::test_runner::{RngSeed, TestCaseResult, TestRunner};
use std::any::Any;
use std::fmt::Debug;
use std::hash::{BuildHasher, RandomState};

/// The seed of a plain run.
const SEED: u64 = 2013;

/// The configuration of every property: `n` cases from the fixed seed, or `AFFINOR_FRESH` times `n`
/// from a fresh one.
pub fn cases(n: u32) -> ProptestConfig {
    let given = ProptestConfig::default();
    let fresh = std::env::var("AFFINOR_FRESH").ok().map(|times| {
        let parsed = times.parse().ok().filter(|times| *times > 0);
        parsed.unwrap_or_else(|| panic!("AFFINOR_FRESH={times} is not a positive integer"))
    });
    let times: u32 = fresh.unwrap_or(1);
    let rng_seed = match (given.rng_seed, fresh) {
        (RngSeed::Fixed(seed), _) => RngSeed::Fixed(seed),
        (RngSeed::Random, None) => RngSeed::Fixed(SEED),
        (RngSeed::Random, Some(_)) => {
            let seed = RandomState::new().hash_one(n);
            // printed if the test fails
            eprintln!("repeat these cases: AFFINOR_FRESH={times} PROPTEST_RNG_SEED={seed}");
            RngSeed::Fixed(seed)
        }
    };
    ProptestConfig {
        cases: n.saturating_mul(times),
        max_global_rejects: given.max_global_rejects.saturating_mul(times),
        rng_seed,
        failure_persistence: None,
        ..given
    }
}

/// Tests for random values, written as in `proptest!`.
///
/// The macro `proptest!` compiles the code that draws, runs and shrinks for every test. Here it is
/// compiled once.
macro_rules! properties {
    (
        #![cases($cases:expr)]
        $(
            $(#[$attribute:meta])*
            fn $name:ident($($value:pat in $values:expr),+ $(,)?) $body:block
        )*
    ) => {
        $(
            $(#[$attribute])*
            fn $name() {
                let names = stringify!($($value),+);
                $crate::common::property::check($cases, names, ($($values,)+), |($($value,)+)| {
                    $body
                    Ok(())
                });
            }
        )*
    };
}
#[allow(unused_imports, reason = "not every package has properties")]
pub(crate) use properties;

/// A value of any type.
trait Value: Any + Debug {}

impl<T: Any + Debug> Value for T {}

/// Tests a property on a number of [`cases`] of random values.
///
/// # Panics
/// If a case fails; the message contains the smallest failing values.
pub fn check<S: Strategy<Value: 'static> + 'static>(
    number: u32,
    names: &str,
    values: S,
    holds: impl Fn(S::Value) -> TestCaseResult,
) {
    let values = values.prop_map(|values| Box::new(values) as Box<dyn Value>);
    check_any(number, names, values.boxed(), &|values| {
        let values: Box<dyn Any> = values;
        holds(*values.downcast().expect("the type of what was drawn"))
    });
}

/// [`check`] without the types.
fn check_any(
    number: u32,
    names: &str,
    values: BoxedStrategy<Box<dyn Value>>,
    holds: &dyn Fn(Box<dyn Value>) -> TestCaseResult,
) {
    let mut runner = TestRunner::new(cases(number));
    if let Err(failure) = runner.run(&values, holds) {
        panic!("{failure}\nvalues of ({names})\n{runner}");
    }
}

properties! {
    #![cases(64)]

    #[test]
    #[should_panic(expected = "minimal failing input: (\n    50,\n)\n")]
    fn what_fails_is_seen_and_made_small(x in 0..1000i32) {
        proptest::prop_assert!(x < 50);
    }

    #[test]
    #[should_panic(expected = "index out of bounds")]
    fn panics_are_failures(x in 0..1000usize) {
        proptest::prop_assert!([true; 50][x]);
    }
}

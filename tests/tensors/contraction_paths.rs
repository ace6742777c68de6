//! Every path of the kernel computes what the notation says: tables of all rows, tables of nonempty rows,
//! bisection, one thread and two, integers and the ring, with small tensors and lowered sizes.

use crate::common::cases;
use crate::common::oracle;
use crate::common::property::properties;
use affinor_tensors::contraction::{KernelThresholds, contract_by};
use affinor_tensors::{
    Down, Rational, Scalar, Symbolic, Tensor, TensorError, Up, Variance, contract,
};
use cases::{Case, Values, cases_of_ranks};
use oracle::{oracle, stored};
use proptest::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::LazyLock;

/// One thread and two.
static POOLS: LazyLock<[ThreadPool; 2]> = LazyLock::new(|| {
    [1, 2].map(|threads| ThreadPoolBuilder::new().num_threads(threads).build().unwrap())
});

/// The limits of the tables: no rows, rows up to some multiple of the dimension, all rows.
fn tables(dimension: usize) -> Vec<(u64, u64)> {
    let mut tables = vec![];
    // rows are counted in whole words of 64
    for rows in (0..4).map(|power| 64 * (dimension as u64).pow(power)).chain([0, 1 << 16]) {
        tables.extend([0, 2, 1 << 16].map(|marked| (rows, marked)));
    }
    tables.dedup();
    tables
}

/// Every combination of paths, with the pool it runs in.
fn paths(dimension: usize) -> impl Iterator<Item = (KernelThresholds, &'static ThreadPool)> {
    let arithmetics = [(0, 0), (u64::MAX, 0), (u64::MAX, 2), (u64::MAX, 64)];
    tables(dimension).into_iter().flat_map(move |(direct_rows, marked_words)| {
        let threads = POOLS.iter().zip([usize::MAX, 0]);
        threads.flat_map(move |(pool, parallel_from)| {
            arithmetics.into_iter().zip([0, 1, 7, 1 << 20]).map(move |(arithmetic, round)| {
                let (largest_integer, kept_quotients) = arithmetic;
                let paths = KernelThresholds {
                    direct_rows,
                    marked_words,
                    parallel_from,
                    round,
                    largest_integer,
                    kept_quotients,
                    ..KernelThresholds::default()
                };
                (paths, pool)
            })
        })
    })
}

/// Every path agrees with the oracle, in order, and no zero is stored.
fn agrees<S: Scalar>(case: &Case<S>) -> Result<(), TestCaseError> {
    let (text, operands) = (&case.text, case.operands());
    let expected: Vec<_> = oracle(text, &operands).into_iter().collect();
    for (paths, pool) in paths(operands[0].1.dimension()) {
        let result = pool.install(|| contract_by(&paths, text, &operands))?;
        prop_assert_eq!(&stored(&result), &expected, "{} by {:?}", text, paths);
    }
    Ok(())
}

properties! {
    #![cases(100)]

    #[test]
    fn integers(case in cases_of_ranks(0..9, Values::Integers)) {
        agrees(&case)?;
        let result = contract(&case.text, &case.operands())?;
        prop_assert_eq!(result.slots(), case.slots);
    }

    #[test]
    fn fractions(case in cases_of_ranks(0..9, Values::Fractions)) {
        agrees(&case)?;
    }

    #[test]
    fn words_at_the_edge_of_64_bits(case in cases_of_ranks(0..7, Values::Words)) {
        agrees(&case)?;
    }

    #[test]
    fn beyond_64_bits(case in cases_of_ranks(0..5, Values::Huge)) {
        agrees(&case)?;
    }

    /// A bound between the sizes of small sums, so that either arithmetic is taken.
    #[test]
    fn integers_up_to_a_bound(
        case in cases_of_ranks(0..6, Values::Fractions),
        largest_integer in 0u64..2000,
    ) {
        let expected: Vec<_> = oracle(&case.text, &case.operands()).into_iter().collect();
        let paths = KernelThresholds { largest_integer, ..KernelThresholds::default() };
        let result = contract_by(&paths, &case.text, &case.operands())?;
        prop_assert_eq!(stored(&result), expected, "{}", case.text);
    }

    /// Floats are the same to the last bit on every path, and near the exact values.
    #[test]
    fn floats(case in cases_of_ranks(0..9, Values::Fractions)) {
        let exact = contract(&case.text, &case.operands())?.map(Rational::to_f64);
        let floats = case.floats();
        let floats = floats.operands();
        let bits = |t: &Tensor<f64>| {
            t.components().map(|(at, value)| (at.to_vec(), value.to_bits())).collect::<Vec<_>>()
        };
        let first = contract(&case.text, &floats)?;
        prop_assert_eq!(first.len(), exact.len());
        for ((at, value), (exact_at, exact)) in first.components().zip(exact.components()) {
            prop_assert_eq!(at, exact_at);
            prop_assert!((value - exact).abs() <= 1e-11 * exact.abs().max(1.0));
        }
        for (paths, pool) in paths(first.dimension()) {
            let result = pool.install(|| contract_by(&paths, &case.text, &floats))?;
            prop_assert_eq!(bits(&result), bits(&first), "{} by {:?}", case.text, paths);
        }
    }

    #[test]
    fn dual_numbers(case in cases_of_ranks(0..7, Values::Integers)) {
        agrees(&case.duals())?;
    }
}

properties! {
    #![cases(100)]

    /// Indices far apart, so that accumulators have rows of several words and tables have gaps: the components are those of
    /// the indices themselves.
    #[test]
    fn indices_far_apart(
        case in cases_of_ranks(0..5, Values::Integers),
        step in 1usize..90,
        behind in 1usize..90,
    ) {
        let dimension = (case.operands()[0].1.dimension() * step + behind).min(400);
        let step = step.min((dimension - 1) / case.operands()[0].1.dimension().max(1)).max(1);
        let apart = |tensor: &Tensor<Rational>| {
            let components = tensor.components();
            let components = components.map(|(at, value)| {
                (at.iter().map(|index| index * step).collect::<Vec<_>>(), value.clone())
            });
            Tensor::from_components(dimension, tensor.slots(), components)
        };
        let operands: Vec<_> = case.operands();
        let Ok(wide) = operands.iter().map(|(_, t)| apart(t)).collect::<Result<Vec<_>, _>>() else {
            // too many places for a key
            return Ok(());
        };
        let wide: Vec<_> = operands.iter().zip(&wide).map(|((name, _), t)| (*name, t)).collect();
        let near = contract(&case.text, &operands)?;
        let expected = stored(&apart(&near)?);
        for (marked_words, direct_rows) in [(1 << 22, 1 << 22), (1 << 22, 0), (0, 0)] {
            for (pool, parallel_from) in POOLS.iter().zip([usize::MAX, 0]) {
                let paths =
                    KernelThresholds { marked_words, direct_rows, parallel_from, ..KernelThresholds::default() };
                let far = pool.install(|| contract_by(&paths, &case.text, &wide))?;
                prop_assert_eq!(&stored(&far), &expected, "{} by {:?}", case.text, paths);
            }
        }
    }
}

properties! {
    #![cases(12)]

    /// Parameters and constants side by side, and constants alone, which run on integers.
    #[test]
    fn symbols(case in cases_of_ranks(0..5, Values::Fractions), constants in any::<bool>()) {
        let [a, b] = ["a", "b"].map(Symbolic::parameter);
        let symbols = case.mapped(|at, value| {
            let constant = Symbolic::constant(value.clone());
            match at.iter().sum::<usize>() % 3 {
                1 if !constants => constant * &a,
                2 if !constants => constant + &b,
                _ => constant,
            }
        });
        agrees(&symbols)?;
    }
}

/// The paths of a size are refused nowhere but at `places`.
#[test]
fn places_are_refused_past_their_limit() {
    let identity = Tensor::<Rational>::identity(5);
    let run = |places, text: &str| {
        let paths = KernelThresholds { places, ..KernelThresholds::default() };
        contract_by(&paths, text, &[("d", &identity)])
    };
    let refused = |rank| Err(TensorError::TooLarge { dimension: 5, rank });
    assert_eq!(run(25, "d^a_b -> ^a_b").unwrap(), identity);
    assert_eq!(run(24, "d^a_b -> ^a_b"), refused(2));
    assert_eq!(run(24, "d^a_b d^c_d -> ^a_b^c_d"), refused(4));
    assert_eq!(run(1, "d^p_p ->").unwrap().to_scalar(), Some(Rational::from(5)));
    assert_eq!(run(0, "d^p_p ->"), refused(0));
}

/// The largest accumulators: vectors of a million components, and matrices in dimension 4096.
#[test]
fn the_largest_accumulators() {
    let shift = |n: usize, by: usize, slots: [Variance; 2]| {
        let entries =
            (0..n).step_by(n / 64).map(|i| ([(i + by) % n, i], Rational::from(i as i64 + 1)));
        Tensor::from_components(n, &slots, entries).unwrap()
    };
    let n = 1 << 20;
    let vector = Tensor::from_components(n, &[Up], [([n - n / 64], Rational::from(3))]).unwrap();
    let moved = contract("a^i_j v^j -> ^i", &[("a", &shift(n, n - 1, [Up, Down])), ("v", &vector)]);
    let expected = Rational::from(3 * (n - n / 64 + 1) as i64);
    assert_eq!(stored(&moved.unwrap()), [(vec![n - n / 64 - 1], expected)]);

    let n = 4096;
    let (a, b) = (shift(n, 4095, [Up, Down]), shift(n, 0, [Up, Up]));
    let product = contract("a^i_p b^pj - a^j_p b^pi -> ^[ij]", &[("a", &a), ("b", &b)]).unwrap();
    let above = (0..n).step_by(64).map(|i| {
        let value = Rational::from((i as i64 + 1) * (i as i64 + 1));
        // a moves i to the index before it, and 0 to the last one
        if i > 0 { (vec![i - 1, i], value) } else { (vec![0, 4095], -value) }
    });
    let mut expected: Vec<_> =
        above.flat_map(|(at, value)| [(vec![at[1], at[0]], -value.clone()), (at, value)]).collect();
    expected.sort_by(|x, y| x.0.cmp(&y.0));
    assert_eq!(stored(&product), expected);
}

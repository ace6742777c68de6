//! Every path of the kernel evaluates the notation: tables of all rows, tables of nonempty rows,
//! bisection, one thread and two, integers and ring elements. Small tensors with lowered size
//! limits are tested, and large dimensions with few components at the original limits.

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
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// One thread and two.
static POOLS: LazyLock<[ThreadPool; 2]> = LazyLock::new(|| {
    [1, 2].map(|threads| ThreadPoolBuilder::new().num_threads(threads).build().unwrap())
});

/// The limits of the tables: no rows, rows up to multiples of the dimension, all rows.
fn tables(dimension: usize) -> Vec<(u64, u64)> {
    let mut tables = vec![];
    // rows are counted in full words of 64
    for rows in (0..4).map(|power| 64 * (dimension as u64).pow(power)).chain([0, 1 << 16]) {
        tables.extend([0, 2, 1 << 16].map(|marked| (rows, marked)));
    }
    tables.dedup();
    tables
}

/// Every combination of paths, with the thread pool that runs it.
fn paths(dimension: usize) -> impl Iterator<Item = (KernelThresholds, &'static ThreadPool)> {
    // in the ring, in integers of arbitrary size, and in machine integers
    let never = usize::MAX;
    let arithmetics =
        [(0, 0, never), (0, 0, 0), (u64::MAX, 0, never), (u64::MAX, 2, 0), (u64::MAX, 64, 62)];
    tables(dimension).into_iter().flat_map(move |(direct_rows, marked_words)| {
        let threads = POOLS.iter().zip([usize::MAX, 0]);
        threads.flat_map(move |(pool, parallel_from)| {
            arithmetics.into_iter().zip([0, 3, 1, 7, 1 << 20]).map(move |(arithmetic, round)| {
                let (largest_integer, kept_quotients, denominator_bits) = arithmetic;
                let paths = KernelThresholds {
                    direct_rows,
                    marked_words,
                    parallel_from,
                    round,
                    largest_integer,
                    kept_quotients,
                    denominator_bits,
                    ..KernelThresholds::default()
                };
                (paths, pool)
            })
        })
    })
}

/// Every path agrees with the oracle, including the order, and no zero is stored.
fn agrees<S: Scalar>(case: &Case<S>) -> Result<(), TestCaseError> {
    let (text, operands) = (&case.text, case.operands());
    let expected: Vec<_> = oracle(text, &operands).into_iter().collect();
    prop_assert_eq!(&stored(&contract(text, &operands)?), &expected, "{}", text);
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
        prop_assert_eq!(result.dimension(), case.operands[0].1.dimension());
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

    /// A bound between the sizes of small sums, so that both kinds of arithmetic are used.
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

    /// Floats are the same to the last bit on every path, and close to the exact values.
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

    /// Indices far apart: accumulators have rows of several words, and tables have gaps. The
    /// components must have the right indices.
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
            // the index combinations exceed a key
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

    /// Parameters and constants together, and constants alone, which use integers.
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

/// The paths of a size are errors only at `places`.
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
        // a maps i to the index before it, and 0 to the last one
        if i > 0 { (vec![i - 1, i], value) } else { (vec![0, 4095], -value) }
    });
    let mut expected: Vec<_> =
        above.flat_map(|(at, value)| [(vec![at[1], at[0]], -value.clone()), (at, value)]).collect();
    expected.sort_by(|x, y| x.0.cmp(&y.0));
    assert_eq!(stored(&product), expected);
}

type Test = Result<(), TensorError>;

/// Ranks with the largest dimension whose leading indices, all but two, take at most 2^22 values.
const EDGES: [(usize, usize); 5] = [(4, 2048), (5, 161), (6, 45), (7, 21), (8, 12)];

/// Pseudorandom numbers: D. E. Knuth's MMIX generator.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % bound as u64) as usize
    }
}

/// A few components at random indices, some at the first and the last indices.
fn sparse(n: usize, slots: &[Variance], count: usize, seed: u64) -> Tensor<Rational> {
    let mut numbers = Numbers(seed);
    let components: Vec<_> = (0..count)
        .map(|_| {
            let index = |numbers: &mut Numbers| match numbers.below(6) {
                0 => 0,
                1 => n - 1,
                _ => numbers.below(n),
            };
            let at: Vec<usize> = slots.iter().map(|_| index(&mut numbers)).collect();
            let value = Rational::new(numbers.below(19) as i64 - 9, 1 + numbers.below(3) as i64);
            (at, value.unwrap())
        })
        .collect();
    Tensor::from_components(n, slots, components).unwrap()
}

fn agrees_at_size(text: &str, operands: &[(&str, &Tensor<Rational>)]) {
    let expected: Vec<_> = oracle(text, operands).into_iter().collect();
    let result = contract(text, operands).unwrap();
    assert_eq!(result.len(), expected.len(), "{text} in dimension {}", result.dimension());
    assert_eq!(stored(&result), expected, "{text} in dimension {}", result.dimension());
}

/// Permutations of this number of letters: reversed, rotated, two exchanged.
fn orders(letters: &str) -> Vec<String> {
    let (first, rest) = letters.split_at(1);
    let (head, tail) = letters.split_at(letters.len() - 2);
    let exchanged: String = tail.chars().rev().collect();
    vec![
        letters.chars().rev().collect(),
        format!("{rest}{first}"),
        format!("{head}{exchanged}"),
        format!("{rest}{first}").chars().rev().collect(),
    ]
}

#[test]
fn slots_in_another_order() {
    for (rank, edge) in EDGES {
        for n in [edge, edge + 1] {
            let letters = &"abcdefgh"[..rank];
            let t = sparse(n, &[Down; 8][..rank], 200, rank as u64);
            for order in orders(letters) {
                agrees_at_size(&format!("T_{order} -> _{letters}"), &[("T", &t)]);
                agrees_at_size(&format!("2 T_{order} - T_{letters} -> _{letters}"), &[("T", &t)]);
            }
        }
    }
}

/// The means over permutations of some slots agree with sums by `permute`.
#[test]
fn symmetrisers() -> Test {
    for (rank, edge) in EDGES {
        for n in [edge, edge + 1] {
            let t = sparse(n, &[Down; 8][..rank], 60, 100 + rank as u64);
            for slots in [[0, rank - 1, 1], [rank - 3, rank - 2, rank - 1]] {
                let mut means = [BTreeMap::new(), BTreeMap::new()];
                for (sign, order) in [
                    (1, [0, 1, 2]),
                    (-1, [1, 0, 2]),
                    (-1, [0, 2, 1]),
                    (-1, [2, 1, 0]),
                    (1, [1, 2, 0]),
                    (1, [2, 0, 1]),
                ] {
                    let mut moved: Vec<usize> = (0..rank).collect();
                    (0..3).for_each(|at| moved[slots[at]] = slots[order[at]]);
                    for (at, value) in stored(&t.permute(&moved)?) {
                        for (mean, sign) in means.iter_mut().zip([1, sign]) {
                            let part = value.clone() * &Rational::new(sign, 6).unwrap();
                            let sum: &mut Rational =
                                mean.entry(at.clone()).or_insert(Rational::from(0));
                            *sum = sum.clone() + &part;
                        }
                    }
                }
                let [symmetric, antisymmetric] = means.map(|mean| {
                    let zero = Rational::from(0);
                    mean.into_iter().filter(|(_, value)| *value != zero).collect::<Vec<_>>()
                });
                assert_eq!(stored(&t.symmetrise(&slots)?), symmetric, "{rank} {n} {slots:?}");
                assert_eq!(stored(&t.antisymmetrise(&slots)?), antisymmetric, "{rank} {n}");
            }
        }
    }
    Ok(())
}

/// A declared antisymmetry, of two and of three letters, in the last indices and in the loops.
#[test]
fn declared_antisymmetries() -> Test {
    for (rank, edge) in EDGES {
        for n in [edge, edge + 1] {
            let letters = &"abcdefgh"[..rank];
            let (head, tail) = letters.split_at(rank - 3);
            let t = sparse(n, &[Down; 8][..rank], 60, 200 + rank as u64);
            let last = t.antisymmetrise(&[rank - 3, rank - 2, rank - 1])?;
            let first = t.antisymmetrise(&[0, 1])?;
            for (text, tensor) in [
                (format!("T_{letters} -> _{head}[{tail}]"), &last),
                (format!("T_{tail}{head} -> _{tail}{head}"), &last),
                (format!("T_{head}{tail} -> _[{tail}]{head}"), &last),
                (format!("T_{letters} -> _[ab]{}", &letters[2..]), &first),
            ] {
                let plain = text.replace(['[', ']'], "");
                let expected: Vec<_> = oracle(&plain, &[("T", tensor)]).into_iter().collect();
                assert!(!expected.is_empty());
                let result = contract(&text, &[("T", tensor)])?;
                assert_eq!(stored(&result), expected, "{text} in dimension {n}");
            }
        }
    }
    Ok(())
}

/// Products of two factors: tables of all rows and of nonempty rows at their limits, in either
/// factor.
#[test]
fn products() {
    for (edge, a, b, texts) in [
        // n^3 rows in a table up to 161; n^2 ceil(n/64) words of bits up to 640
        (161, "^--", "^--", ["A^i_jp B^p_kl -> ^i_jkl", "A^p_il B^j_pk -> _i^j_kl"]),
        (640, "^--", "^--", ["A^i_jp B^p_kl -> ^i_jkl", "A^p_il B^j_pk -> _i^j_kl"]),
        (161, "^---", "^--", ["A^p_ijk B^l_pm -> ^l_kjim", "A^i_jkp B^p_lm -> _jkl^i_m"]),
        (45, "^---", "^---", ["A^i_jkp B^p_lmn -> ^i_jklmn", "A^p_ijk B^l_mnp -> _nmkji^l"]),
        (45, "^^--", "^---", ["A^pq_ij B^k_lpq -> _ijl^k", "A^pi_qj B^q_klp -> _klj^i"]),
        (21, "^----", "^---", ["A^p_ijkl B^m_pno -> ^m_ijklno", "A^i_jklp B^p_mno -> _lnmkjo^i"]),
        (
            12,
            "^----",
            "^----",
            ["A^p_ijkl B^m_pnor -> ^m_ijklnor", "A^q_ijkl B^m_nrsq -> _srnlkji^m"],
        ),
    ] {
        for n in [edge, edge + 1] {
            let slots = |marks: &str| -> Vec<Variance> {
                marks.chars().map(|mark| if mark == '^' { Up } else { Down }).collect()
            };
            let (a, b) = (sparse(n, &slots(a), 150, 7), sparse(n, &slots(b), 150, 8));
            for text in texts {
                agrees_at_size(text, &[("A", &a), ("B", &b)]);
            }
        }
    }
}

/// Results of rank 0 to 2 in dimensions for which tables and bit masks would exceed the memory.
#[test]
fn low_ranks_in_high_dimensions() -> Test {
    let components = |n: usize, slots: &[Variance], seed| sparse(n, slots, 120, seed);
    for n in [1 << 20, 1 << 31, (1 << 32) - 1] {
        let (s, t) = (components(n, &[Up, Up], 1), components(n, &[Down, Down], 2));
        let (m, v) = (components(n, &[Up, Down], 3), components(n, &[Down], 4));
        let operands = [("S", &s), ("T", &t), ("M", &m), ("v", &v)];
        for text in
            ["S^pq T_pq ->", "S^pq T_qp ->", "M^p_p ->", "M^p_q M^q_p ->", "S^pq T_pq - M^p_p ->"]
        {
            agrees_at_size(text, &operands);
        }
    }
    for n in [1 << 40, usize::MAX - 1] {
        let (v, w) = (components(n, &[Down], 5), components(n, &[Up], 6));
        agrees_at_size("v_p w^p ->", &[("v", &v), ("w", &w)]);
    }
    for n in [2_642_245, (1 << 16) - 1] {
        let (c, d) = (components(n, &[Up, Down, Down], 7), components(n, &[Up, Up, Down], 8));
        let operands = [("c", &c), ("d", &d)];
        for text in
            ["c^p_pi d^iq_q ->", "c^i_pq d^pq_i ->", "c^p_pi -> _i", "d^pi_p - d^ip_p -> ^i"]
        {
            agrees_at_size(text, &operands);
        }
        let refused = TensorError::TooLarge { dimension: n, rank: 2 };
        assert_eq!(contract("c^p_qi d^qr_p -> _i^r", &operands).unwrap_err(), refused);
    }
    Ok(())
}

/// The largest dimensions of a result: 4096 with two indices, 2^24 with one.
#[test]
fn the_largest_results() -> Test {
    for n in [2049, 4096] {
        let (c, m) = (sparse(n, &[Up, Down, Down], 150, 1), sparse(n, &[Up, Down], 150, 2));
        let operands = [("c", &c), ("m", &m)];
        for text in [
            "m^i_p m^p_j -> ^i_j",
            "c^p_qi c^q_pj -> _ij",
            "c^i_pk m^p_j -> ^i_jk",
            "c^i_jp m^p_k - c^i_pj m^p_k -> _k^i_j",
        ] {
            agrees_at_size(text, &operands);
        }
    }
    for n in [(1 << 24) - 1, 1 << 24] {
        let (m, v) = (sparse(n, &[Up, Down], 150, 3), sparse(n, &[Up], 150, 4));
        let operands = [("m", &m), ("v", &v)];
        agrees_at_size("m^i_p v^p -> ^i", &operands);
        agrees_at_size("2 v^i - m^i_p v^p -> ^i", &operands);
    }
    let past = sparse((1 << 24) + 1, &[Up], 3, 5);
    let refused = |dimension, rank| Err(TensorError::TooLarge { dimension, rank });
    assert_eq!(contract("v^i -> ^i", &[("v", &past)]), refused((1 << 24) + 1, 1));
    let past = sparse(4097, &[Up, Down], 3, 6);
    assert_eq!(contract("m^i_j -> ^i_j", &[("m", &past)]), refused(4097, 2));
    Ok(())
}

/// Keys up to the last one below 2^64.
#[test]
fn keys_near_64_bits() -> Test {
    for (rank, n) in [(5, 4096), (6, 1625), (7, 565), (8, 255)] {
        let letters = &"abcdefgh"[..rank];
        let t = sparse(n, &[Down; 8][..rank], 80, rank as u64);
        let last = Tensor::from_components(n, t.slots(), [(vec![n - 1; rank], Rational::from(3))])?;
        let operands = [("T", &t), ("L", &last)];
        for order in orders(letters) {
            agrees_at_size(&format!("T_{order} + L_{letters} -> _{letters}"), &operands);
        }
        let vector = sparse(n, &[Up], 40, 9);
        let first = &letters[..rank - 1];
        agrees_at_size(&format!("T_{first}p v^p -> _{first}"), &[("T", &t), ("v", &vector)]);
        agrees_at_size(&format!("L_p{first} v^p -> _{first}"), &[("L", &last), ("v", &vector)]);
    }
    for (rank, n) in [(6, 1626), (7, 566), (8, 256)] {
        let refused = TensorError::TooLarge { dimension: n, rank };
        assert_eq!(Tensor::<Rational>::zero(n, &[Down; 8][..rank]).unwrap_err(), refused);
    }
    Ok(())
}

//! The kernel evaluates the notation, over every kind of scalar, up to the limit of machine
//! integers, with threads, and for wide sparse tensors.

mod notation;
mod paths;

use crate::common::cases;
use crate::common::dual;
use crate::common::oracle;
use crate::common::property::properties;
use affinor_tensors::{Down, Rational, Ring, Scalar, Symbolic, Tensor, TensorError, Up, contract};
use cases::{Case, Values, cases};
use dual::Dual;
use oracle::{oracle, stored};
use proptest::collection::vec;
use proptest::prelude::*;

type Test = Result<(), TensorError>;

/// The kernel and the oracle agree to the last bit, including the order, and no zero is stored.
fn agrees<S: Scalar>(case: &Case<S>) -> Result<Tensor<S>, TestCaseError> {
    let result = contract(&case.text, &case.operands())?;
    let expected: Vec<_> = oracle(&case.text, &case.operands()).into_iter().collect();
    prop_assert_eq!(stored(&result), expected, "{}", case.text);
    Ok(result)
}

properties! {
    #![cases(500)]

    /// Small integers are exact in floats, so the zeros agree too.
    #[test]
    fn floats_of_integers(case in cases(Values::Integers)) {
        let exact = contract(&case.text, &case.operands())?.map(Rational::to_f64);
        prop_assert_eq!(contract(&case.text, &case.floats().operands())?, exact);
    }
}

properties! {
    #![cases(100)]

    /// Parameters, constants and fractions of parameters together.
    #[test]
    fn symbols(case in cases(Values::Fractions)) {
        let [a, b] = ["a", "b"].map(Symbolic::parameter);
        let symbols = case.mapped(|at, value| {
            let constant = Symbolic::constant(value.clone());
            match at.iter().sum::<usize>() % 4 {
                0 => constant,
                1 => constant * &a,
                2 => constant + &b,
                _ => constant / &(a.clone() + &b),
            }
        });
        agrees(&symbols)?;
    }

    #[test]
    fn constant_symbols_are_numbers(case in cases(Values::Words)) {
        let exact = contract(&case.text, &case.operands())?;
        let symbols = case.mapped(|_, value| Symbolic::constant(value.clone()));
        let constants = contract(&case.text, &symbols.operands())?;
        prop_assert_eq!(constants, exact.map(|value| Symbolic::constant(value.clone())));
    }
}

/// A tensor whose components are all nonzero and without symmetries.
fn full(rank: usize) -> Tensor<Rational> {
    let slots = [[Up].as_slice(), &[Down; 8]].concat();
    let indices = (0..4usize.pow(rank as u32))
        .map(|n| (0..rank).rev().map(|at| n / 4usize.pow(at as u32) % 4).collect::<Vec<_>>());
    let components = indices.map(|at| {
        let value = at.iter().fold(1, |hash, index| (hash * 5 + index * index + 3) % 11);
        (at, Rational::from(value as i64 - 5))
    });
    Tensor::from_components(4, &slots[..rank], components).unwrap()
}

/// Brackets at every position, over operands that are antisymmetric themselves.
#[test]
fn brackets_keep_the_promise() -> Test {
    let v = full(1);
    let m = full(2);
    let pair = full(3).antisymmetrise(&[1, 2])?;
    let triple = full(4).antisymmetrise(&[1, 2, 3])?;
    let middle = full(4).antisymmetrise(&[1, 2])?;
    let inside = full(5).antisymmetrise(&[2, 3, 4])?;
    let operands =
        [("v", &v), ("m", &m), ("p", &pair), ("t", &triple), ("q", &middle), ("s", &inside)];
    for (text, brackets) in [
        ("p^i_kl -> ^i_kl", "p^i_kl -> ^i_[kl]"),
        ("t^i_jkl -> ^i_jkl", "t^i_jkl -> ^i_[jkl]"),
        ("t^i_jkl -> ^i_jkl", "t^i_jkl -> ^i_j[kl]"),
        ("t^i_jkl -> ^i_jkl", "t^i_jkl -> ^i_[jk]l"),
        ("t^i_jkl -> _jkl^i", "t^i_jkl -> _[jkl]^i"),
        ("t^i_jkl -> _jk^i_l", "t^i_jkl -> _[jk]^i_l"),
        ("q^i_jkl -> ^i_jkl", "q^i_jkl -> ^i_[jk]l"),
        ("q^i_jkl -> ^i_ljk", "q^i_jkl -> ^i_l[jk]"),
        ("q^i_jkl -> _jk^i_l", "q^i_jkl -> _[jk]^i_l"),
        ("s^i_jmkl -> ^i_jmkl", "s^i_jmkl -> ^i_j[mkl]"),
        ("s^i_jmkl -> ^i_mklj", "s^i_jmkl -> ^i_[mkl]j"),
        ("s^i_jmkl -> _mkl^i_j", "s^i_jmkl -> _[mkl]^i_j"),
        ("p^i_jk m^l_m -> _jk^i^l_m", "p^i_jk m^l_m -> _[jk]^i^l_m"),
        ("p^i_jk m^l_i -> ^l_jk", "p^i_jk m^l_i -> ^l_[jk]"),
        ("2 t^i_jkl v^j - 3 q^i_klj v^j -> ^i_kl", "2 t^i_jkl v^j - 3 q^i_klj v^j -> ^i_[kl]"),
        ("m^i_k m^j_l - m^j_k m^i_l -> _kl^ij", "m^i_k m^j_l - m^j_k m^i_l -> _kl^[ij]"),
        ("m^i_k m^j_l - m^j_k m^i_l -> ^ij_kl", "m^i_k m^j_l - m^j_k m^i_l -> ^[ij]_[kl]"),
    ] {
        let expected = oracle(text, &operands);
        assert!(!expected.is_empty(), "{text}");
        let result = contract(brackets, &operands)?;
        assert_eq!(stored(&result), expected.into_iter().collect::<Vec<_>>(), "{brackets}");
    }
    Ok(())
}

#[test]
fn an_infinitesimal_is_stored_and_its_square_is_not() -> Test {
    let epsilon = Dual::<true>::new(0.0, 1.0);
    let v = Tensor::vector(&[epsilon, Dual::new(2.0, 0.0)], Up);
    let w = Tensor::vector(&[Dual::<true>::new(1.0, 0.0), Dual::new(0.0, 0.0)], Up);
    let outer = contract("v^i w^j -> ^ij", &[("v", &v), ("w", &w)])?;
    assert_eq!(stored(&outer), [(vec![0, 0], epsilon), (vec![1, 0], Dual::new(2.0, 0.0))]);
    let square = contract("v^i v^j -> ^ij", &[("v", &v)])?;
    let cross = Dual::new(0.0, 2.0);
    let four = Dual::new(4.0, 0.0);
    assert_eq!(stored(&square), [(vec![0, 1], cross), (vec![1, 0], cross), (vec![1, 1], four)]);
    let difference = contract("v^i v^j - v^j v^i + v^i w^j -> ^ij", &[("v", &v), ("w", &w)])?;
    assert_eq!(difference, outer);
    Ok(())
}

fn agrees_exactly(text: &str, operands: &[(&str, &Tensor<Rational>)]) {
    let expected: Vec<_> = oracle(text, operands).into_iter().collect();
    assert_eq!(stored(&contract(text, operands).unwrap()), expected, "{text}");
}

/// Integers around the square roots of 2^62 and 2^63, and around 2^63.
fn edge() -> impl Strategy<Value = i64> {
    let corners = [1i64 << 31, 3_037_000_499, 1 << 32, i64::MAX, i64::MIN, 1];
    (prop::sample::select(corners.to_vec()), -2i64..=2, any::<bool>()).prop_map(
        |(corner, step, negative)| {
            let word = corner.saturating_add(step);
            if negative { word.saturating_neg() } else { word }
        },
    )
}

properties! {
    #![cases(300)]

    /// Every way in which few products are added: one term, mirrored terms, sums, coefficients.
    #[test]
    fn no_sum_wraps(a in vec(edge(), 3), b in vec(edge(), 3), d in 1i64..4) {
        let d = Rational::new(1, d).unwrap();
        let vector = |words: &[i64], slot| {
            let words: Vec<_> = words.iter().map(|n| Rational::from(*n) * &d).collect();
            Tensor::vector(&words, slot)
        };
        let (v, w) = (vector(&a, Down), vector(&b, Down));
        let u = vector(&b, Up);
        let operands = [("v", &v), ("w", &w), ("u", &u)];
        for text in [
            "v_k w_l -> _kl",
            "v_k w_l - v_l w_k -> _kl",
            "v_k w_l - v_l w_k -> _[kl]",
            "2 v_k w_l - 2 v_l w_k -> _[kl]",
            "v_j u^i - w_j u^i -> ^i_j",
            "v_i u^i ->",
            "v_i + w_i -> _i",
            "v_i - 3 w_i -> _i",
            "-1 v_i -> _i",
        ] {
            agrees_exactly(text, &operands);
        }
    }
}

#[test]
fn the_last_sum_that_fits_and_the_first_that_does_not() {
    let half = 1i64 << 31;
    for (a, b) in [([half, -half], [half, half]), ([half, half - 1], [half, half])] {
        let [v, w] = [a, b].map(|words| Tensor::vector(&words.map(Rational::from), Down));
        agrees_exactly("v_k w_l - v_l w_k -> _[kl]", &[("v", &v), ("w", &w)]);
        agrees_exactly("v_k w_l + w_k v_l -> _kl", &[("v", &v), ("w", &w)]);
    }
}

/// The result is the same, to the last bit of a float, for any number of threads.
#[test]
fn threads_change_nothing() -> Test {
    let n = 30;
    let hash = |at: [usize; 3]| at.iter().fold(7, |h, i| (h * 31 + i * 17 + 5) % 1009) as i64;
    let exact = Tensor::from_fn(n, [Up, Down, Down], |at| match hash(at) % 6 {
        0 => Rational::new(hash(at) - 500, 1 + hash(at) % 7).unwrap(),
        _ => Rational::from(0),
    })?;
    assert!(exact.len() > 4096, "{} components are too few for threads", exact.len());
    let floats = exact.map(|value| value.to_f64().sin());
    let huge = exact
        .filter_map(|at, value| (at[0] < 3).then(|| value.clone() * &Rational::from(i64::MAX)));
    let texts = [
        "2 c^i_jk - c^i_kj -> ^i_jk",
        "c^i_jk - c^i_kj -> ^i_[jk]",
        "c^i_km c^m_lj - c^i_lm c^m_kj - c^m_kl c^i_mj + c^m_lk c^i_mj -> ^i_j[kl]",
        "c^m_il c^l_jm -> _ij",
    ];
    for text in texts {
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                assert_eq!(rayon::current_num_threads(), threads);
                (contract(text, &[("c", &exact)]), contract(text, &[("c", &floats)]))
            })
        };
        let (serial, parallel) = (run(1), run(2));
        assert!(!serial.0.as_ref().unwrap().is_empty());
        assert_eq!(serial.0, parallel.0, "{text}");
        let bits = |t: &Tensor<f64>| {
            t.components().map(|(at, value)| (at, value.to_bits())).collect::<Vec<_>>()
        };
        assert_eq!(bits(&serial.1?), bits(&parallel.1?), "{text}");
    }
    let sum = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| contract("h^i_jm c^m_kl -> ^i_jkl", &[("h", &huge), ("c", &exact)]))
    };
    assert_eq!(sum(1)?, sum(2)?);
    Ok(())
}

/// Time and memory depend on the number of components: a loop over all `2000^4` index combinations
/// would not end.
#[test]
fn wide_tensors_cost_what_their_components_cost() -> Test {
    let n = 2000;
    let chain = (0..n - 2).map(|i| ([i, i + 1, i + 2], Rational::from(i as i64 % 7 + 1)));
    let c = Tensor::from_components(n, &[Up, Down, Down], chain)?;
    for text in [
        "c^i_km c^m_lj - c^i_lm c^m_kj - c^m_kl c^i_mj -> ^i_jkl",
        "c^m_il c^l_jm -> _ij",
        "c^i_jk - c^i_kj -> ^i_[jk]",
        "c^m_mi -> _i",
    ] {
        let result = contract(text, &[("c", &c)])?;
        assert!(result.len() < 4 * n, "{text}: {} components", result.len());
    }
    let product = contract("c^i_jm c^m_kl -> ^i_jkl", &[("c", &c)])?;
    assert_eq!(product.get(&[3, 4, 6, 7]), c.get(&[3, 4, 5]) * &c.get(&[5, 6, 7]));
    Ok(())
}

/// A tensor of constants and one parameter cannot use machine integers.
#[test]
fn one_parameter_among_constants() -> Test {
    let parameter = Symbolic::parameter("a");
    let m = Tensor::from_fn(3, [Up, Down], |[i, j]| match (i, j) {
        (1, 2) => parameter.clone(),
        _ => Symbolic::from_i64((i + 2 * j) as i64 - 3),
    })?;
    let expected: Vec<_> = oracle("m^i_j m^j_k -> ^i_k", &[("m", &m)]).into_iter().collect();
    assert_eq!(stored(&contract("m^i_j m^j_k -> ^i_k", &[("m", &m)])?), expected);
    Ok(())
}

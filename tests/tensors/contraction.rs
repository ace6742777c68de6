//! The kernel computes what the notation says, over every kind of scalar.

use crate::common::cases;
use crate::common::dual;
use crate::common::oracle;
use crate::common::property::properties;
use affinor_tensors::{Down, Rational, Scalar, Symbolic, Tensor, TensorError, Up, contract};
use cases::{Case, Values, cases};
use dual::Dual;
use oracle::{oracle, stored};
use proptest::prelude::*;

type Test = Result<(), TensorError>;

/// The kernel and the oracle agree to the last bit, in order, and no zero is stored.
fn agrees<S: Scalar>(case: &Case<S>) -> Result<Tensor<S>, TestCaseError> {
    let result = contract(&case.text, &case.operands())?;
    let expected: Vec<_> = oracle(&case.text, &case.operands()).into_iter().collect();
    prop_assert_eq!(stored(&result), expected, "{}", case.text);
    Ok(result)
}

properties! {
    #![cases(500)]

    #[test]
    fn integers(case in cases(Values::Integers)) {
        let result = agrees(&case)?;
        prop_assert_eq!(result.slots(), case.slots);
        prop_assert_eq!(result.dimension(), case.operands[0].1.dimension());
    }

    #[test]
    fn fractions(case in cases(Values::Fractions)) {
        agrees(&case)?;
    }

    #[test]
    fn words_at_the_edge_of_64_bits(case in cases(Values::Words)) {
        agrees(&case)?;
    }

    #[test]
    fn beyond_64_bits(case in cases(Values::Huge)) {
        agrees(&case)?;
    }

    /// Small integers are exact in floats, so even the zeros agree.
    #[test]
    fn floats_of_integers(case in cases(Values::Integers)) {
        let exact = contract(&case.text, &case.operands())?.map(Rational::to_f64);
        prop_assert_eq!(contract(&case.text, &case.floats().operands())?, exact);
    }

    #[test]
    fn floats_of_fractions(case in cases(Values::Fractions)) {
        let exact = contract(&case.text, &case.operands())?.map(Rational::to_f64);
        let result = contract(&case.text, &case.floats().operands())?;
        prop_assert_eq!(result.len(), exact.len());
        for ((at, value), (exact_at, exact)) in result.components().zip(exact.components()) {
            prop_assert_eq!(at, exact_at);
            prop_assert!((value - exact).abs() <= 1e-11 * exact.abs().max(1.0));
        }
    }

    #[test]
    fn dual_numbers(case in cases(Values::Integers)) {
        agrees(&case.duals())?;
    }
}

properties! {
    #![cases(100)]

    /// Parameters, constants and fractions of parameters side by side.
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

/// Every component filled, by no rule that a symmetry could share.
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

/// Brackets at every place, over operands that are antisymmetric themselves.
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

//! Errors of the notation, and their messages.

use crate::common::property::properties;
use affinor_tensors::{Down, Rational, Tensor, TensorError, Up, contract};

/// The operands `v^i`, `w_i`, `m^i_j` and `s` in dimension 2, with all components 1.
fn operands() -> [(&'static str, Tensor<Rational>); 4] {
    let one = || Rational::from(1);
    [
        ("v", Tensor::vector(&[one(), one()], Up)),
        ("w", Tensor::vector(&[one(), one()], Down)),
        ("m", Tensor::from_fn(2, [Up, Down], |_| one()).unwrap()),
        ("s", Tensor::from_fn(2, [], |_| one()).unwrap()),
    ]
}

fn run(text: &str) -> Result<Tensor<Rational>, TensorError> {
    let operands = operands();
    let borrowed: Vec<_> = operands.iter().map(|(name, tensor)| (*name, tensor)).collect();
    contract(text, &borrowed)
}

/// Whether or not the name occurs in the expression.
#[test]
fn operands_have_different_names() {
    let operands = operands();
    let [(_, v), (_, w), ..] = &operands;
    for text in ["v^i -> ^i", "w_i -> _i"] {
        let error = contract(text, &[("v", v), ("w", w), ("v", v)]).unwrap_err().to_string();
        assert_eq!(error, format!("in `{text}`: two operands are called `v`"));
    }
}

#[test]
fn what_does_not_fit_is_refused_with_its_reason() {
    for (text, reason) in [
        ("v^i", "no `->` before the result"),
        ("", "no `->` before the result"),
        ("v^i - > ^i", "no `->` before the result"),
        // terms
        ("-> ^i", "a term has no factor"),
        ("v^i + -> ^i", "a term has no factor"),
        ("v^i - -> ^i", "a term has no factor"),
        ("v^i + + v^i -> ^i", "a term has no factor"),
        ("- - v^i -> ^i", "a term has no factor"),
        ("2 + v^i -> ^i", "a term has no factor"),
        ("2 -> ", "a term has no factor"),
        ("9223372036854775807 2 v^i -> ^i", "a coefficient is too large"),
        ("9223372036854775807 2 v^i + v^i -> ^i", "a coefficient is too large"),
        // names
        ("x^i -> ^i", "no operand is called `x`"),
        ("99999999999999999999 v^i -> ^i", "no operand is called `99999999999999999999`"),
        ("^i -> ^i", "`^i` is not a name with indices"),
        ("v*^i -> ^i", "`v*^i` is not a name with indices"),
        ("1/0 v^i -> ^i", "`1/0` is not a name with indices"),
        ("1/2/3 v^i -> ^i", "`1/2/3` is not a name with indices"),
        ("1/3037000500 1/3037000500 v^i -> ^i", "a coefficient is too large"),
        ("v^i+v^i -> ^i", "`+` is not allowed in the indices `^i+v^i`"),
        ("v^i * w_j -> ^i_j", "`*` is not a name with indices"),
        // variance and rank
        ("v_i -> _i", "the indices of `v` do not match its slots"),
        ("v^ij -> ^ij", "the indices of `v` do not match its slots"),
        ("s^i -> ^i", "the indices of `s` do not match its slots"),
        ("v -> ", "the indices of `v` do not match its slots"),
        ("v^i -> _i", "the index `i` is upper on one side of `->` and lower on the other"),
        ("w_i -> ^i", "the index `i` is upper on one side of `->` and lower on the other"),
        ("v^i v^i -> ", "the index `i` is summed, but not once upper and once lower"),
        ("w_i w_i -> ", "the index `i` is summed, but not once upper and once lower"),
        // letters
        ("v^i -> ", "the letter `i` is neither an index of the result nor summed in a pair"),
        ("m^i_j -> ^i", "the letter `j` is neither an index of the result nor summed in a pair"),
        (
            "m^i_i v^i -> ^i",
            "the letter `i` is neither an index of the result nor summed in a pair",
        ),
        ("m^i_i v^i -> ", "the letter `i` is neither an index of the result nor summed in a pair"),
        ("m^i_i -> ^i", "the letter `i` is neither an index of the result nor summed in a pair"),
        ("m^i_i -> ^i_i", "the index `i` occurs twice in the result"),
        ("v^i -> ^ii", "the index `i` occurs twice in the result"),
        ("v^i -> ^ij", "a term lacks the index `j`"),
        ("m^i_j + v^i -> ^i_j", "a term lacks the index `j`"),
        ("s -> ^i", "a term lacks the index `i`"),
        // marks
        ("v^i -> i", "`i` is not allowed in the indices `i`"),
        ("v^1 -> ^i", "`1` is not allowed in the indices `^1`"),
        ("v^i -> ^i ^j", "` ` is not allowed in the indices `^i ^j`"),
        ("v^i -> ^i -> ^i", "` ` is not allowed in the indices `^i -> ^i`"),
        // brackets
        ("m^i_j -> ^[i_j]", "`_` is not allowed in the indices `^[i_j]`"),
        ("v^i v^j -> ^[ij", "`[` without `]`"),
        ("v^i v^j -> ^ij]", "`]` without `[`"),
        ("v^i v^j -> ^[[ij]]", "`[` is not allowed in the indices `^[[ij]]`"),
        ("v^i v^j -> [ij]", "`[` is not allowed in the indices `[ij]`"),
        ("v^[i] -> ^i", "brackets are allowed in the result only"),
    ] {
        match run(text) {
            Err(TensorError::Notation { expression, error }) => {
                assert_eq!((expression.as_str(), error.to_string().as_str()), (text, reason));
            }
            other => panic!("`{text}`: {other:?}"),
        }
    }
}

#[test]
fn what_fits_is_taken() -> Result<(), TensorError> {
    for (text, value) in [
        ("v^i w_i -> ", 2),
        ("m^i_i->", 2),
        ("s ->", 1),
        ("- s ->", -1),
        ("+ s ->", 1),
        ("- 2 s + 3 s s ->", 1),
        ("+ -2 s - -3 s ->", 1),
        ("2 3 s ->", 6),
        ("s 5 ->", 5),
        ("0 s ->", 0),
        ("s - s ->", 0),
        ("1/2 s + 3/2 s ->", 2),
        ("2 3/2 s s s ->", 3),
        ("4/-2 s ->", -2),
        ("1/2 m^i_j m^j_k m^k_l v^l w_i ->", 8),
        ("9223372036854775807 s + s - 9223372036854775807 s ->", 1),
        ("-9223372036854775808 s + 9223372036854775807 s + s ->", 0),
        ("m^\u{3b1}_\u{3b2} m^\u{3b2}_\u{3b1} ->", 4),
    ] {
        assert_eq!(run(text)?.to_scalar(), Some(Rational::from(value)), "{text}");
    }
    assert_eq!(run("v^i v^j -> ^[i]^[j]")?.len(), 4);
    // the coefficient without a counterpart of the opposite sign
    assert!(run("-9223372036854775808 v^i v^j + v^j v^i -> ^[ij]").is_ok());
    Ok(())
}

#[test]
fn dimensions_must_agree() {
    let [a, b] = [2, 3].map(Tensor::<Rational>::identity);
    let result = contract("a^i_j b^j_k -> ^i_k", &[("a", &a), ("b", &b)]);
    assert_eq!(result, Err(TensorError::Dimension(2, 3)));
    let message = result.unwrap_err().to_string();
    assert_eq!(message, "the operands have different dimensions, 2 and 3");
}

#[test]
fn results_beyond_the_engine_are_refused() {
    let too_large = |dimension, rank| Err(TensorError::TooLarge { dimension, rank });
    // keys of 68 bits
    let square = Tensor::<Rational>::zero(1 << 17, &[Up, Up]).unwrap();
    let result = contract("m^ij m^kl -> ^ijkl", &[("m", &square)]);
    assert_eq!(result, too_large(1 << 17, 4));
    // fits the keys, but exceeds the table over the last two indices
    let vast = Tensor::<Rational>::from_components(1 << 31, &[Up, Down], [([1, 1], 1.into())]);
    let result = contract("m^i_j -> ^i_j", &[("m", &vast.unwrap())]);
    assert_eq!(result, too_large(1 << 31, 2));
    let line = Tensor::<Rational>::from_components(1 << 40, &[Up], [([1], 1.into())]).unwrap();
    assert_eq!(contract("v^i -> ^i", &[("v", &line)]), too_large(1 << 40, 1));
    // nine letters
    let four = Tensor::<Rational>::zero(2, &[Up; 4]).unwrap();
    let five = Tensor::<Rational>::zero(2, &[Up; 5]).unwrap();
    let nine = contract("a^ijkl b^mnpqr -> ^ijklmnpqr", &[("a", &four), ("b", &five)]);
    assert_eq!(nine, too_large(2, 9));
}

properties! {
    #![cases(256)]

    #[test]
    fn no_text_panics(text in ".*", tail in "[vwms]?[\\^_\\[\\]ij>2 +-]*") {
        for text in [format!("{text} -> ^i"), format!("v^i -> {text}"), text, tail.clone()] {
            let _ = run(&text);
        }
        let _ = run(&format!("{tail} -> ^i_j"));
        let _ = run(&format!("m^i_j -> {tail}"));
    }
}

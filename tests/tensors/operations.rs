//! Traces, symmetrizers, raising and lowering agree with explicit sums.

use crate::common::oracle;
use crate::common::property::properties;
use crate::common::tensors;
use affinor_tensors::{Down, Rational, Tensor, TensorError, Up};
use oracle::{oracle, stored};
use proptest::prelude::*;
use tensors::tensors;

type Test = Result<(), TensorError>;

fn integer(n: i64) -> Rational {
    Rational::from(n)
}

#[test]
fn operations_refuse_what_is_no_slot() -> Test {
    let t = Tensor::<Rational>::identity(3);
    let g = Tensor::from_fn(3, [Down, Down], |[i, j]| integer((i == j) as i64))?;
    let slots = |slots: &[usize]| TensorError::Slots { slots: slots.to_vec(), rank: 2 };
    assert_eq!(t.trace(0, 0), Err(slots(&[0, 0])));
    assert_eq!(t.trace(0, 2), Err(slots(&[0, 2])));
    assert_eq!(t.lower(2, &g), Err(slots(&[2])));
    assert_eq!(g.symmetrise(&[1, 1]), Err(slots(&[1, 1])));
    assert_eq!(g.antisymmetrise(&[0, 1, 2]), Err(slots(&[0, 1, 2])));
    assert_eq!(
        g.trace(7, 1).unwrap_err().to_string(),
        "[7, 1] are not different slots, counted from 0, of a tensor of rank 2"
    );
    let notation = |result| matches!(result, Err(TensorError::Notation { .. }));
    assert!(notation(g.trace(0, 1)));
    assert!(notation(t.symmetrise(&[0, 1])));
    assert!(notation(t.raise(0, &g)));
    assert!(notation(t.raise(1, &g)));
    assert!(notation(t.lower(1, &g)));
    let other = Tensor::from_fn(2, [Down, Down], |_| integer(1))?;
    assert_eq!(t.lower(0, &other), Err(TensorError::Dimension(2, 3)));
    Ok(())
}

/// A metric `g` of signature (2,1) with its inverse.
fn metric() -> (Tensor<Rational>, Tensor<Rational>) {
    let rows = |rows: [[i64; 3]; 3], slots| {
        Tensor::from_fn(3, slots, |[i, j]| integer(rows[i][j])).unwrap()
    };
    let lower = rows([[1, 1, 0], [1, 2, 1], [0, 1, 0]], [Down, Down]);
    (lower, rows([[1, 0, -1], [0, 0, 1], [-1, 1, -1]], [Up, Up]))
}

#[test]
fn raising_undoes_lowering() -> Test {
    let (g, inverse) = metric();
    assert_eq!(g.raise(0, &inverse)?, Tensor::identity(3));
    let t = Tensor::from_fn(3, [Up, Down, Up], |[i, j, k]| integer((i * 9 + j * 3 + k) as i64))?;
    let lowered = t.lower(2, &g)?;
    assert_eq!(lowered.slots(), [Up, Down, Down]);
    let expected = oracle("g_ap t^i_j^p -> ^i_ja", &[("g", &g), ("t", &t)]);
    assert_eq!(stored(&lowered), expected.into_iter().collect::<Vec<_>>());
    assert_eq!(lowered.raise(2, &inverse)?, t);
    assert_eq!(t.lower(0, &g)?.raise(0, &inverse)?, t);
    Ok(())
}

/// `t` of rank 3 with all slots lower, summed over all orders of the `slots` with their signs.
fn sum_over_orders(t: &Tensor<Rational>, slots: &[usize], sign: i64) -> Tensor<Rational> {
    let terms: &[(&str, i64)] = match slots {
        [0, 1] => &[("_ijk", 1), ("_jik", sign)],
        [2, 0] => &[("_ijk", 1), ("_kji", sign)],
        [1, 2] => &[("_ijk", 1), ("_ikj", sign)],
        [0, 2, 1] => {
            &[("_ijk", 1), ("_jki", 1), ("_kij", 1), ("_ikj", sign), ("_jik", sign), ("_kji", sign)]
        }
        _ => &[("_ijk", 1)],
    };
    let terms: Vec<_> = terms.iter().map(|(at, sign)| format!("{sign} t{at}")).collect();
    let text = format!("{} -> _ijk", terms.join(" + "));
    let weight = Rational::new(1, terms.len() as i64).unwrap();
    let components = oracle(&text, &[("t", t)]).into_iter().map(|(at, v)| (at, v * &weight));
    Tensor::from_components(t.dimension(), t.slots(), components).unwrap()
}

properties! {
    #![cases(100)]

    #[test]
    fn symmetrisers(t in tensors(3, [Down; 3])) {
        for slots in [&[][..], &[1], &[0, 1], &[2, 0], &[1, 2], &[0, 2, 1]] {
            let (even, odd) = (t.symmetrise(slots)?, t.antisymmetrise(slots)?);
            prop_assert_eq!(&even, &sum_over_orders(&t, slots, 1));
            prop_assert_eq!(&odd, &sum_over_orders(&t, slots, -1));
            // symmetrizers are projections
            prop_assert_eq!(&even.symmetrise(slots)?, &even);
            prop_assert_eq!(&odd.antisymmetrise(slots)?, &odd);
            if slots.len() > 1 {
                prop_assert!(even.antisymmetrise(slots)?.is_empty());
                prop_assert!(odd.symmetrise(slots)?.is_empty());
            }
        }
    }

    #[test]
    fn traces(t in tensors(3, [Up, Down, Up, Down])) {
        let cases = [(0, 1, "t^p_p^i_j -> ^i_j"), (2, 1, "t^i_p^p_j -> ^i_j"), (3, 0, "t^p_i^j_p -> _i^j")];
        for (a, b, text) in cases {
            let expected: Vec<_> = oracle(text, &[("t", &t)]).into_iter().collect();
            let trace = t.trace(a, b)?;
            prop_assert_eq!(stored(&trace), expected);
            prop_assert_eq!(&trace, &t.trace(b, a)?);
        }
    }
}

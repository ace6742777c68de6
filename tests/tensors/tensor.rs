//! Tensors contain their given components in order, also after maps and permutations.

use crate::common::oracle::oracle;
use crate::common::property::properties;
use crate::common::tensors;
use affinor_tensors::{
    Down, Indices, Rational, Ring, Scalar, Symbolic, Tensor, TensorError, Tolerance, Up, contract,
};
use proptest::prelude::*;
use std::collections::BTreeMap;
use tensors::tensors;

type Test = Result<(), TensorError>;

/// The stored components.
fn stored<S: Scalar>(tensor: &Tensor<S>) -> Vec<(Vec<usize>, S)> {
    let components = tensor.components();
    components.map(|(at, value)| (at.to_vec(), value.clone())).collect()
}

fn integer(n: i64) -> Rational {
    Rational::from(n)
}

#[test]
fn components_are_sorted_added_up_and_never_zero() -> Test {
    let given = [([1, 0], 2), ([0, 1], 5), ([1, 0], -3), ([1, 1], 4), ([1, 1], -4), ([0, 0], 0)];
    let given = given.map(|(at, n)| (at, integer(n)));
    let t = Tensor::from_components(2, &[Up, Down], given)?;
    assert_eq!(stored(&t), [(vec![0, 1], integer(5)), (vec![1, 0], integer(-1))]);
    assert_eq!((t.len(), t.rank(), t.dimension(), t.is_empty()), (2, 2, 2, false));
    assert_eq!(t.get(&[1, 1]), integer(0));
    assert_eq!(format!("{t:?}"), "{[0, 1]: 5, [1, 0]: -1}");
    Ok(())
}

#[test]
fn constructors_agree() -> Test {
    let by_rule = Tensor::from_fn(3, [Up, Down], |[i, j]| integer((i == j) as i64))?;
    let entries = (0..3).map(|i| ([i, i], integer(1)));
    assert_eq!(by_rule, Tensor::from_components(3, &[Up, Down], entries)?);
    assert_eq!(by_rule, Tensor::identity(3));
    let v = Tensor::vector(&[integer(0), integer(7)], Down);
    assert_eq!(v, Tensor::from_components(2, &[Down], [([1], integer(7))])?);
    assert_eq!(v.to_vector(), Some(vec![integer(0), integer(7)]));
    assert_eq!((v.to_scalar(), by_rule.to_vector()), (None, None));
    let seven = Tensor::from_fn(5, [], |[]| integer(7))?;
    assert_eq!(seven.to_scalar(), Some(integer(7)));
    assert_eq!(Tensor::<Rational>::zero(5, &[])?.to_scalar(), Some(integer(0)));
    for dimension in [0, 1] {
        let delta = Tensor::<Rational>::identity(dimension);
        assert_eq!(delta.len(), dimension);
    }
    assert!(Tensor::from_fn(0, [Up], |_| integer(1))?.is_empty());
    Ok(())
}

#[test]
fn wrong_indices_are_refused() {
    let build =
        |at: &[usize]| Tensor::from_components(3, &[Up, Down], [(at, integer(0))]).map(|t| t.len());
    assert_eq!(build(&[2, 2]), Ok(0));
    assert_eq!(build(&[0, 3]), Err(TensorError::IndexRange { index: 3, dimension: 3 }));
    assert_eq!(build(&[0]), Err(TensorError::Rank { rank: 2, given: 1 }));
    assert_eq!(build(&[0, 0, 0]), Err(TensorError::Rank { rank: 2, given: 3 }));
}

#[test]
fn rows_are_checked() -> Test {
    let place = |place| Tensor::from_row(3, &[Up, Down], [(place, integer(1))]);
    assert_eq!(stored(&place(8)?), [(vec![2, 2], integer(1))]);
    assert_eq!(place(9).unwrap_err(), TensorError::IndexRange { index: 9, dimension: 9 });
    assert!(Tensor::from_row(0, &[Up], [(0, integer(1))]).is_err());
    let scalar = Tensor::from_row(3, &[], [(0, integer(2)), (0, integer(5))])?;
    assert_eq!(scalar.to_scalar(), Some(integer(7)));
    Ok(())
}

#[test]
fn components_are_found_by_their_indices() -> Test {
    let t = Tensor::from_components(12, &[Up, Down, Down], [([0, 1, 11], integer(5))])?;
    assert_eq!((&t[[0, 1, 11]], &t[[0, 0, 0]]), (&integer(5), &integer(0)));
    assert_eq!(t.try_get(&[0, 1, 11]), Ok(&integer(5)));
    assert_eq!(t.try_get(&[0, 1]), Err(TensorError::Rank { rank: 3, given: 2 }));
    let range = TensorError::IndexRange { index: 12, dimension: 12 };
    assert_eq!(t.try_get(&[0, 1, 12]), Err(range.clone()));
    assert_eq!(t.slice(1, 12), Err(range));
    assert_eq!(t.slice(3, 0), Err(TensorError::Slots { slots: vec![3], rank: 3 }));
    assert_eq!(t.to_string(), "^1_2,12 = 5");
    assert_eq!(Tensor::<Rational>::zero(2, &[Up])?.to_string(), "0");
    assert_eq!(Tensor::from_fn(2, [], |[]| integer(7))?.to_string(), "7");
    let mixed = Tensor::from_components(3, &[Up, Up, Down, Up], [([0, 1, 2, 0], integer(-1))])?;
    assert_eq!(mixed.to_string(), "^12_3^1 = -1");
    let diagonal = Tensor::diagonal([1, 0, 3].map(integer), [Down, Down]);
    assert_eq!(stored(&diagonal), [(vec![0, 0], integer(1)), (vec![2, 2], integer(3))]);
    Ok(())
}

#[test]
#[should_panic(expected = "two tensors of one shape")]
fn sums_of_different_shapes_panic() {
    let _ = Tensor::vector(&[1.0], Up) + Tensor::vector(&[1.0], Down);
}

#[test]
fn sizes_have_limits() {
    let zero =
        |dimension, rank| Tensor::<Rational>::zero(dimension, &vec![Down; rank]).map(|t| t.rank());
    let too_large = |dimension, rank| Err(TensorError::TooLarge { dimension, rank });
    assert_eq!(zero(255, Indices::MAX), Ok(Indices::MAX));
    assert_eq!(zero(256, Indices::MAX), too_large(256, 8));
    assert_eq!(zero(1, Indices::MAX + 1), too_large(1, 9));
    assert_eq!(zero(0, 300), too_large(0, 300));
    assert_eq!(zero(usize::MAX, 1), too_large(usize::MAX, 1));
    assert_eq!(zero(usize::MAX, 0), Ok(0));
    // the key of the last component of the largest tensor is found
    let last = [254; Indices::MAX];
    let t = Tensor::from_components(255, &[Up; Indices::MAX], [(last, integer(1))]).unwrap();
    assert_eq!(stored(&t), [(last.to_vec(), integer(1))]);
}

#[test]
fn symmetries_of_pairs() -> Test {
    let by = |f: fn(i64, i64, i64) -> i64| {
        Tensor::from_fn(3, [Up, Down, Down], |[i, j, k]| integer(f(i as i64, j as i64, k as i64)))
    };
    assert_eq!(by(|i, j, k| (i + 1) * (j + k))?.pair_symmetry(1, 2), Some(1));
    assert_eq!(by(|i, j, k| (i + 1) * (j - k))?.pair_symmetry(1, 2), Some(-1));
    assert_eq!(by(|i, j, k| i + j - k)?.pair_symmetry(1, 2), None);
    // the transposed component is not stored at all
    assert_eq!(by(|_, j, k| (j == 0 && k == 2) as i64)?.pair_symmetry(1, 2), None);
    // slots of different variance have no symmetry, and zero has no sign
    assert_eq!(by(|i, j, _| i * j)?.pair_symmetry(0, 1), None);
    assert_eq!(by(|_, _, _| 0)?.pair_symmetry(1, 2), None);
    // floats are symmetric up to the tolerance
    let float = |error: f64| {
        Tensor::from_fn(2, [Down, Down], |[i, j]| match (i, j) {
            (0, 1) => 0.1 + 0.2 + error,
            (1, 0) => 0.3,
            _ => 1.0,
        })
    };
    assert_eq!(float(0.0)?.pair_symmetry(0, 1), Some(1));
    assert_eq!(float(1e-9)?.pair_symmetry(0, 1), None);
    let loose = float(1e-9)?.with_tolerance(Tolerance::new(1e-6).unwrap());
    assert_eq!(loose.pair_symmetry(0, 1), Some(1));
    Ok(())
}

#[test]
fn permutations_are_checked() {
    let t = Tensor::<Rational>::identity(2);
    for order in [&[0, 0][..], &[0], &[0, 1, 2], &[1, 2]] {
        assert!(t.permute(order).is_err(), "{order:?}");
    }
    assert_eq!(t.permute(&[1, 0]).unwrap().slots(), [Down, Up]);
}

properties! {
    #![cases(100)]

    #[test]
    fn permutations(t in tensors(3, [Up, Down, Up])) {
        let moved = t.permute(&[2, 0, 1])?;
        prop_assert_eq!(moved.slots(), [Up, Up, Down]);
        prop_assert_eq!(moved.len(), t.len());
        for (at, value) in t.components() {
            prop_assert_eq!(&moved.get(&[at[2], at[0], at[1]]), value);
        }
        prop_assert_eq!(moved.permute(&[1, 2, 0])?, t);
    }

    #[test]
    fn arithmetic(t in tensors(3, [Up, Down, Down]), u in tensors(3, [Up, Down, Down]), n in -3i64..4) {
        let (sum, difference) = (&t + &u, &t - &u);
        let multiple = &t * &integer(n);
        for key in 0..27 {
            let at = [key / 9, key / 3 % 3, key % 3];
            prop_assert_eq!(&sum[at], &(&t[at] + &u[at]));
            prop_assert_eq!(&difference[at], &(&t[at] - &u[at]));
            prop_assert_eq!(&multiple[at], &(&t[at] * &integer(n)));
            for (slot, rest) in [(0, [at[1], at[2]]), (1, [at[0], at[2]]), (2, [at[0], at[1]])] {
                prop_assert_eq!(&t.slice(slot, at[slot])?[rest], &t[at]);
            }
        }
        prop_assert_eq!(sum.clone() - u, t);
        prop_assert_eq!(-&difference + difference, Tensor::zero(3, &[Up, Down, Down])?);
        prop_assert_eq!((&sum).into_iter().count(), sum.len());
    }

    #[test]
    fn products_of_several_factors(
        a in tensors(3, [Up, Down]), b in tensors(3, [Up, Down]), c in tensors(3, [Up, Down, Down]),
    ) {
        let operands = [("a", &a), ("b", &b), ("c", &c)];
        for text in [
            "a^i_j b^j_k a^k_l -> ^i_l",
            "c^i_jk a^j_l b^k_m - c^i_kj a^k_l b^j_m -> ^i_lm",
            "a^i_j b^k_l c^l_km a^m_i -> _j",
            "a^p_p b^q_q a^r_s b^s_r ->",
            "a^i_j b^k_l a^m_n - 2 a^m_j b^i_l b^k_n -> ^ikm_jln",
        ] {
            let expected: Vec<_> = oracle(text, &operands).into_iter().collect();
            prop_assert_eq!(stored(&contract(text, &operands)?), expected.clone(), "{}", text);
            let halved = contract(&format!("1/2 {}", text.replace(" - ", " - 1/2 ")), &operands)?;
            prop_assert_eq!(stored(&(halved * &integer(2))), expected, "{}", text);
        }
    }

    #[test]
    fn rows(t in tensors(4, [Up, Down, Down])) {
        let place = |at: &Vec<usize>| at[0] * 16 + at[1] * 4 + at[2];
        let expected: Vec<_> = stored(&t).into_iter().map(|(at, v)| (place(&at), v)).collect();
        prop_assert_eq!(t.to_row(), expected);
        let reversed = t.to_row().into_iter().rev();
        prop_assert_eq!(Tensor::from_row(4, t.slots(), reversed)?, t);
    }

    #[test]
    fn maps(t in tensors(4, [Up, Down]), n in -3i64..4) {
        let by_hand: BTreeMap<_, _> = stored(&t).into_iter().collect();
        let multiple = t.scale(&integer(n));
        let expected = by_hand.iter().map(|(at, v)| (at.clone(), v.clone() * &integer(n)));
        let expected: Vec<_> = expected.filter(|(_, v)| !v.vanishes()).collect();
        prop_assert_eq!(stored(&multiple), expected);
        let above = t.filter_map(|at, v| (at[0] < at[1]).then(|| Symbolic::constant(v.clone())));
        prop_assert_eq!(above.len(), by_hand.keys().filter(|at| at[0] < at[1]).count());
        prop_assert_eq!(above.slots(), t.slots());
        prop_assert!(above.components().all(|(at, v)| v.as_constant() == Some(&t.get(&at))));
        // a map does not store zeros
        let floor = t.map(|v| if v.is_negative() { integer(0) } else { v.clone() });
        prop_assert_eq!(floor.len(), by_hand.values().filter(|v| !v.is_negative()).count());
    }
}

/// Sums of floats use the tolerance of the operands, and results have this tolerance too.
#[test]
fn tolerance_travels() -> Test {
    let strict = Tensor::vector(&[1.0, 2.0], Up);
    let near = Tensor::vector(&[1.0001, 2.0], Up);
    let difference =
        |near: &Tensor<f64>| contract("v^i - w^i -> ^i", &[("v", &strict), ("w", near)]);
    assert_eq!(difference(&near)?.len(), 1);
    let loose = Tolerance::new(1e-3).unwrap();
    let near = near.with_tolerance(loose);
    assert!(difference(&near)?.is_empty());
    assert_eq!(difference(&near)?.tolerance(), loose);
    let t = contract("v^i w^j -> ^ij", &[("v", &strict), ("w", &near)])?;
    for derived in [t.permute(&[1, 0])?, t.map(|v| v * 2.0), t.scale(&3.0), t.symmetrise(&[0, 1])?]
    {
        assert_eq!(derived.tolerance(), loose);
    }
    Ok(())
}

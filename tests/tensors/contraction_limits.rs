//! The kernel at its limits: the edge of machine integers, threads, wide sparse tensors.

use crate::common::oracle;
use crate::common::property::properties;
use affinor_tensors::{Down, Rational, Ring, Symbolic, Tensor, TensorError, Up, contract};
use oracle::{oracle, stored};
use proptest::collection::vec;
use proptest::prelude::*;

type Test = Result<(), TensorError>;

fn agrees(text: &str, operands: &[(&str, &Tensor<Rational>)]) {
    let expected: Vec<_> = oracle(text, operands).into_iter().collect();
    assert_eq!(stored(&contract(text, operands).unwrap()), expected, "{text}");
}

/// Words around the square root of 2^62 and 2^63, and around 2^63 itself.
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

    /// Every way in which few products add up: one term, mirrored terms, sums, coefficients.
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
            agrees(text, &operands);
        }
    }
}

#[test]
fn the_last_sum_that_fits_and_the_first_that_does_not() {
    let half = 1i64 << 31;
    for (a, b) in [([half, -half], [half, half]), ([half, half - 1], [half, half])] {
        let [v, w] = [a, b].map(|words| Tensor::vector(&words.map(Rational::from), Down));
        agrees("v_k w_l - v_l w_k -> _[kl]", &[("v", &v), ("w", &w)]);
        agrees("v_k w_l + w_k v_l -> _kl", &[("v", &v), ("w", &w)]);
    }
}

/// The same, to the last bit of a float, whatever the number of threads.
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

/// Time and memory follow the components: a loop over all `2000^4` places would not end.
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

/// A tensor of constants and one parameter cannot go by machine integers.
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

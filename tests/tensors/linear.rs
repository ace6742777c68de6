//! Linear algebra against closed forms and another algorithm, down to the smallest cases.

use crate::common::dual;
use crate::common::matrices;
use crate::common::property::properties;
use affinor_tensors::linear::{Echelon, LinearError, Matrix};
use affinor_tensors::{Rational, Symbolic, Tolerance};
use dual::Dual;
use matrices::{dense, from_words, same, square};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};
use proptest::prelude::*;

type Test = Result<(), Box<dyn std::error::Error>>;

// ---- closed forms ----

fn hilbert(n: usize) -> Matrix<Rational> {
    dense(n, n, |i, j| Rational::new(1, (i + j + 1) as i64).unwrap())
}

fn binomial(n: usize, k: usize) -> BigInt {
    (0..k).fold(BigInt::one(), |product, i| product * (n - i) / (i + 1))
}

/// The inverse of Hilbert's matrix (M.-D. Choi, *Amer. Math. Monthly* 90 (1983) 301-312).
fn hilbert_inverse(n: usize, i: usize, j: usize) -> BigInt {
    let sign = if (i + j).is_multiple_of(2) { 1 } else { -1 };
    let corner = binomial(i + j, i);
    BigInt::from(i + j + 1)
        * binomial(n + i, n - j - 1)
        * binomial(n + j, n - i - 1)
        * &corner
        * corner
        * sign
}

/// The determinant of Hilbert's matrix: c_n^4 / c_2n with c_n = 1! 2! ... (n-1)!.
fn hilbert_determinant(n: usize) -> BigRational {
    let superfactorial = |n: usize| -> BigInt {
        let factorial = |k: usize| (1..=k).map(BigInt::from).product::<BigInt>();
        (1..n).map(factorial).product()
    };
    BigRational::new(superfactorial(n).pow(4), superfactorial(2 * n))
}

#[test]
fn the_inverse_of_hilberts_matrix_is_integral_and_known() -> Test {
    let inverse = hilbert(30).inverse().ok_or("regular")?;
    for i in 0..30 {
        for j in 0..30 {
            let expected = BigRational::from(hilbert_inverse(30, i, j));
            assert_eq!(BigRational::from(&inverse.get(i, j)), expected, "({i}, {j})");
        }
    }
    let determinant = BigRational::from(&hilbert(30).determinant()?);
    assert_eq!(determinant, hilbert_determinant(30));
    Ok(())
}

#[test]
fn hilberts_matrix_in_floats() -> Test {
    let n = 6;
    let matrix = hilbert(n).map(Rational::to_f64);
    let inverse = matrix.inverse().ok_or("regular")?;
    let expected = |i, j| Rational::from(BigRational::from(hilbert_inverse(n, i, j))).to_f64();
    for i in 0..n {
        for j in 0..n {
            let (value, expected) = (inverse.get(i, j), expected(i, j));
            // the condition number is 1.5e7
            assert!((value / expected - 1.0).abs() < 1.5e7 * f64::EPSILON, "{value} {expected}");
        }
    }
    let expected = Rational::from(hilbert_determinant(n)).to_f64();
    assert!((matrix.determinant()? / expected - 1.0).abs() < 1.5e7 * f64::EPSILON);
    Ok(())
}

#[test]
fn vandermondes_determinant_is_the_product_of_the_differences() -> Test {
    let nodes = [-3, -1, 0, 1, 2, 5, 7];
    let differences = |j: usize| nodes[..j].iter().map(move |x| nodes[j] - x);
    let expected: i64 = (0..nodes.len()).flat_map(differences).product();
    let exact = dense(7, 7, |i, j| Rational::from(i64::pow(nodes[i], j as u32)));
    assert_eq!(exact.determinant()?, expected.into());
    let float = exact.map(Rational::to_f64);
    assert!((float.determinant()? / expected as f64 - 1.0).abs() < 1e-13);
    // interpolation: the coefficients of x^6 - 2x from its values
    let values = nodes.map(|x| (x.pow(6) - 2 * x) as f64);
    let coefficients = float.solve(&values)?.ok_or("regular")?;
    for (value, expected) in coefficients.iter().zip([0.0, -2.0, 0.0, 0.0, 0.0, 0.0, 1.0]) {
        assert!((value - expected).abs() < 1e-9, "{coefficients:?}");
    }
    let names = ["x", "y", "z"].map(Symbolic::parameter);
    let symbolic = dense(3, 3, |i, j| (0..j).fold(Symbolic::one(), |power, _| power * &names[i]));
    let [x, y, z] = &names;
    let expected = (y.clone() - x) * &(z.clone() - x) * &(z.clone() - y);
    assert_eq!(symbolic.determinant()?, expected);
    Ok(())
}

#[test]
fn floats_pivot_on_the_largest_entry() -> Test {
    let matrix = Matrix::from_dense(&[vec![1e-20, 1.0], vec![1.0, 1.0]])?;
    assert_eq!(matrix.solve(&[1.0, 2.0])?, Some(vec![1.0, 1.0]));
    Ok(())
}

#[test]
fn rounding_does_not_raise_the_rank_of_floats() -> Test {
    // sin(i + j) = sin i cos j + cos i sin j; (i - j/3)^3 has four terms
    let sines = dense(25, 25, |i, j| ((i + j) as f64).sin());
    assert_eq!(sines.rank()?, 2);
    assert_eq!(sines.determinant()?, 0.0);
    assert!(sines.inverse().is_none());
    // neighbouring columns are nearly parallel, which magnifies the rounding of the entries
    let cubes = dense(25, 20, |i, j| (i as f64 - j as f64 / 3.0).powi(3));
    let weak = Tolerance::new(1e-9).ok_or("a tolerance")?;
    assert_eq!(cubes.with_tolerance(weak).rank()?, 4);
    let strict = Tolerance::new(0.0).ok_or("a tolerance")?;
    assert!(sines.with_tolerance(strict).rank()? > 2);
    Ok(())
}

/// A small generator of the numbers -9..=9 (xorshift of G. Marsaglia).
fn digits() -> impl FnMut() -> i64 {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 33) as i64 % 19 - 9
    }
}

/// n x n quotients of numbers up to 9, the denominators positive.
fn random_quotients(n: usize) -> Vec<Vec<(i64, i64)>> {
    let mut digit = digits();
    let mut quotient = || (digit(), digit().abs().max(1));
    (0..n).map(|_| (0..n).map(|_| quotient()).collect()).collect()
}

/// The fraction-free elimination of Bareiss on big integers, pivots on the diagonal.
fn bareiss(mut a: Vec<Vec<BigInt>>) -> BigInt {
    let mut previous = BigInt::one();
    for k in 0..a.len() - 1 {
        assert!(!a[k][k].is_zero(), "the example needs no exchange of rows");
        let (top, below) = a.split_at_mut(k + 1);
        let pivot_row = &top[k];
        for row in below {
            for j in k + 1..pivot_row.len() {
                row[j] = (&row[j] * &pivot_row[k] - &row[k] * &pivot_row[j]) / &previous;
            }
        }
        previous = a[k][k].clone();
    }
    a[a.len() - 1][a.len() - 1].clone()
}

fn determinant_agrees_with_bareiss(n: usize) -> Test {
    let quotients = random_quotients(n);
    let matrix = dense(n, n, |i, j| Rational::new(quotients[i][j].0, quotients[i][j].1).unwrap());
    let determinant = matrix.determinant()?;
    // 2520 is the least common multiple of 1..=9
    let cleared = |row: &Vec<(i64, i64)>| row.iter().map(|(p, q)| (p * 2520 / q).into()).collect();
    let integral = bareiss(quotients.iter().map(cleared).collect());
    let expected = BigRational::new(integral, BigInt::from(2520).pow(n as u32));
    assert_eq!(BigRational::from(&determinant), expected);
    Ok(())
}

#[test]
fn the_determinant_of_random_rationals_agrees_with_bareiss() -> Test {
    determinant_agrees_with_bareiss(25)
}

#[test]
#[ignore = "a measurement, for release builds: run with --ignored --nocapture"]
fn the_determinant_of_order_60_is_fast() -> Test {
    determinant_agrees_with_bareiss(60)
}

// ---- the smallest cases ----

#[test]
fn empty_matrices() -> Test {
    let nothing = Matrix::<Rational>::zero(0, 0);
    assert_eq!(nothing.determinant()?, Rational::one());
    assert_eq!(nothing.inverse(), Some(nothing.clone()));
    assert_eq!(nothing.solve(&[])?, Some(vec![]));
    let flat = Matrix::<Rational>::zero(0, 3);
    assert_eq!(flat.nullspace()?, Matrix::identity(3));
    assert_eq!(flat.solve(&[])?, Some(vec![Rational::zero(); 3]));
    assert!(flat.inverse().is_none());
    let tall = Matrix::<Rational>::zero(3, 0);
    assert_eq!((tall.rank()?, tall.nullspace()?), (0, nothing));
    assert_eq!(tall.solve(&[0, 0, 0].map(Rational::from))?, Some(vec![]));
    assert_eq!(tall.solve(&[0, 1, 0].map(Rational::from))?, None);
    assert_eq!(flat.transpose(), tall);
    assert_eq!(tall.mul(&flat)?, Matrix::zero(3, 3));
    assert_eq!(Matrix::<Rational>::zero(2, 2).determinant()?, Rational::zero());
    Ok(())
}

#[test]
fn what_has_no_answer_is_refused() -> Test {
    let row = |n: usize| vec![1.0; n];
    let ragged = Matrix::from_dense(&[row(2), row(3)]).unwrap_err();
    let expected = LinearError::Ragged { row: 1, expected: 2, found: 3 };
    assert_eq!(ragged, expected);
    let outside = Matrix::from_rows(2, [[(2, 1.0)]]).unwrap_err();
    assert_eq!(outside.to_string(), "column 2 is out of range for 2 columns");
    let wide = Matrix::from_dense(&[row(3), row(3)])?;
    assert_eq!(wide.mul(&wide).unwrap_err().to_string(), "shapes 2x3 and 2x3 do not match");
    let sum = wide.add(&wide.transpose());
    assert_eq!(sum.unwrap_err().to_string(), "shapes 2x3 and 3x2 do not match");
    assert!(matches!(wide.solve(&row(3)), Err(LinearError::Shape { .. })));
    assert!(matches!(wide.apply(&row(2)), Err(LinearError::Shape { .. })));
    assert!(matches!(wide.determinant(), Err(LinearError::NotSquare { .. })));
    assert!(wide.inverse().is_none());
    assert_eq!(wide.get(7, 7), 0.0);
    assert_eq!(wide.row(7), []);
    Ok(())
}

#[test]
fn nan_and_infinity_are_no_pivots() -> Test {
    for x in [f64::NAN, f64::INFINITY] {
        let matrix = Matrix::from_dense(&[vec![1.0, x], vec![x, 2.0]])?;
        assert_eq!(matrix.rank(), Err(LinearError::NotInvertible { column: 1 }), "{x}");
        assert!(matrix.inverse().is_none());
        assert!(!matrix.determinant()?.is_finite());
        let mut axis = Echelon::new();
        assert!(axis.insert([(0, 2.0)])?);
        assert!(!axis.contains([(0, x)]), "{x}");
    }
    Ok(())
}

#[test]
fn entries_of_equal_columns_are_added_and_zeros_dropped() -> Test {
    let entries = [(2, 1), (0, 5), (2, -1), (1, 0), (0, 1)].map(|(j, n)| (j, Rational::from(n)));
    let matrix = Matrix::from_rows(3, [entries])?;
    assert_eq!(matrix.row(0), [(0, Rational::from(6))]);
    assert_eq!(matrix.entries().count(), 1);
    assert_eq!(matrix.map(|x| x.clone() - &Rational::from(6)), Matrix::zero(1, 3));
    Ok(())
}

// ---- non-units ----

#[test]
fn dual_numbers_pivot_on_units() -> Test {
    let [o, e, one] =
        [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0)].map(|(re, eps)| Dual::<true>::new(re, eps));
    let matrix = Matrix::from_dense(&[vec![e, one], vec![one, o]])?;
    let inverse = matrix.inverse().ok_or("the determinant is -1")?;
    assert_eq!(inverse, Matrix::from_dense(&[vec![o, one], vec![one, -e]])?);
    let lone = Matrix::from_dense(&[vec![e]])?;
    assert!(lone.inverse().is_none());
    assert_eq!(lone.determinant()?, e);
    assert_eq!(lone.rank(), Err(LinearError::NotInvertible { column: 0 }));
    assert_eq!(Echelon::new().insert([(0, e)]), Err(LinearError::NotInvertible { column: 0 }));
    let singular = Matrix::from_dense(&[vec![one, one], vec![one, one]])?;
    assert_eq!(singular.solve(&[one, one + e])?, None);
    Ok(())
}

properties! {
    #![cases(256)]

    /// d det(A) = the sum over i of det(A with row i of dA): on singular matrices too.
    #[test]
    fn the_determinant_of_dual_numbers_is_the_differential(
        (n, mut a, b) in (1usize..5).prop_flat_map(|n| (Just(n), square(n), square(n))),
        fold in any::<bool>(),
    ) {
        if fold && n > 1 {
            a[n - 1] = a[0].clone();
        }
        let entry = |i: usize, j: usize| Dual::<true>::new(a[i][j] as f64, b[i][j] as f64);
        let determinant = dense(n, n, entry).determinant()?;
        let replaced = |i: usize| {
            let mut rows = a.clone();
            rows[i] = b[i].clone();
            from_words::<Rational>(&rows).determinant().unwrap()
        };
        let differential = (0..n).map(replaced).fold(Rational::zero(), |sum, x| sum + x);
        let value = from_words::<Rational>(&a).determinant()?;
        prop_assert!(same(&determinant.0.re, &value.to_f64()));
        prop_assert!(same(&determinant.0.eps, &differential.to_f64()));
    }
}

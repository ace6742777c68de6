//! Linear algebra is compared with closed forms and another algorithm, down to the smallest cases;
//! its laws over rationals, rational functions and floats.

use crate::common::dual;
use crate::common::matrices;
use crate::common::property::properties;
use affinor_tensors::linear::{Echelon, LinearError, Matrix, Row};
use affinor_tensors::{Field, Notation, Rational, Ring, Scalar, Symbolic, Tolerance};
use dual::Dual;
use matrices::{dense, from_words, same, square};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};
use proptest::collection::vec;
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

/// A matrix of n x n quotients of numbers up to 9, with positive denominators.
fn random_quotients(n: usize) -> Vec<Vec<(i64, i64)>> {
    let mut digit = digits();
    let mut quotient = || (digit(), digit().abs().max(1));
    (0..n).map(|_| (0..n).map(|_| quotient()).collect()).collect()
}

/// Bareiss' fraction-free elimination on big integers, with pivots on the diagonal.
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

fn same_vector<S: Notation + Scalar>(a: &[S], b: &[S]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
}

fn same_matrix<S: Notation + Scalar>(a: &Matrix<S>, b: &Matrix<S>) -> bool {
    let rows = a.to_dense().into_iter().zip(b.to_dense());
    (a.rows(), a.columns()) == (b.rows(), b.columns())
        && rows.into_iter().all(|(a, b)| same_vector(&a, &b))
}

fn square_laws<S: Notation + Scalar>(
    a: &Matrix<S>,
    b: &Matrix<S>,
    x: &[S],
) -> Result<(), TestCaseError> {
    let n = a.rows();
    let determinant = a.determinant()?;
    prop_assert!(same(&a.transpose().determinant()?, &determinant));
    let product = determinant.clone() * &b.determinant()?;
    prop_assert!(same(&a.mul(b)?.determinant()?, &product));
    let images = a.apply(x)?.into_iter().zip(b.apply(x)?);
    let sums: Vec<S> = images.map(|(y, z)| y + &z).collect();
    prop_assert!(same_vector(&a.add(b)?.apply(x)?, &sums));
    prop_assert_eq!(a.add(&a.map(|value| -value.clone()))?, Matrix::zero(n, n));
    let Some(inverse) = a.inverse() else {
        prop_assert!(determinant.vanishes());
        prop_assert!(a.rank()? < n);
        return Ok(());
    };
    prop_assert!(!determinant.vanishes());
    prop_assert_eq!(a.rank()?, n);
    prop_assert!(same_matrix(&a.mul(&inverse)?, &Matrix::identity(n)));
    prop_assert!(same_matrix(&inverse.mul(a)?, &Matrix::identity(n)));
    let solution = a.solve(&a.apply(x)?)?;
    prop_assert!(solution.is_some_and(|y| same_vector(&y, x)));
    Ok(())
}

fn rectangle_laws<S: Notation + Scalar>(a: &Matrix<S>, x: &[S]) -> Result<(), TestCaseError> {
    let (echelon, nullspace) = (a.echelon()?, a.nullspace()?);
    prop_assert_eq!(echelon.rank() + nullspace.rows(), a.columns());
    prop_assert_eq!(nullspace.rank()?, nullspace.rows());
    prop_assert_eq!(a.rank()?, a.transpose().rank()?);
    let image = a.mul(&nullspace.transpose())?;
    prop_assert!(same_matrix(&image, &Matrix::zero(a.rows(), nullspace.rows())));
    let b = a.apply(x)?;
    let solution = a.solve(&b)?;
    prop_assert!(solution.is_some_and(|y| same_vector(&a.apply(&y).unwrap(), &b)));
    is_reduced(&echelon)?;
    let row_space = a.row_space()?;
    for i in 0..a.rows() {
        prop_assert!(echelon.contains(a.row(i).to_vec()));
        let coordinates = echelon.coordinates(a.row(i).to_vec()).unwrap();
        let again = row_space.transpose().apply(&coordinates)?;
        prop_assert!(same_vector(&again, &a.to_dense()[i]));
    }
    Ok(())
}

fn is_reduced<S: Field + Scalar>(echelon: &Echelon<S>) -> Result<(), TestCaseError> {
    prop_assert!(echelon.pivots().is_sorted_by(|a, b| a < b));
    let value = |row: &Row<S>, j| row.iter().find(|(k, _)| *k == j).map(|(_, v)| v.clone());
    for (pivot, row) in echelon.pivots().iter().zip(echelon.rows()) {
        prop_assert_eq!(&row[0], &(*pivot, S::one()));
        prop_assert!(row.is_sorted_by(|a, b| a.0 < b.0));
        let others = echelon.pivots().iter().filter(|other| *other != pivot);
        prop_assert!(others.into_iter().all(|other| value(row, *other).is_none()));
    }
    Ok(())
}

fn rational() -> impl Strategy<Value = Rational> {
    (-9i64..=9, 1i64..=9).prop_map(|(n, d)| Rational::new(n, d).unwrap())
}

/// A matrix of low rank: the product of a tall and a wide matrix, which are sparse every other
/// time.
fn low_rank() -> impl Strategy<Value = (Matrix<Rational>, Vec<Rational>)> {
    (1usize..6, 0usize..4, 1usize..6, any::<bool>()).prop_flat_map(|(m, r, n, sparse)| {
        let entry = move || {
            (rational(), 0..3).prop_map(move |(x, k)| match sparse && k > 0 {
                true => Rational::zero(),
                false => x,
            })
        };
        let factors = (vec(entry(), m * r), vec(entry(), r * n), vec(rational(), n));
        factors.prop_map(move |(a, b, x)| {
            let a = dense(m, r, |i, j| a[i * r + j].clone());
            (a.mul(&dense(r, n, |i, j| b[i * n + j].clone())).unwrap(), x)
        })
    })
}

fn square_of<S: Scalar, T: Strategy<Value = S>>(
    n: usize,
    entry: impl Fn() -> T,
) -> impl Strategy<Value = (Matrix<S>, Matrix<S>, Vec<S>)> {
    (vec(entry(), n * n), vec(entry(), n * n), vec(entry(), n)).prop_map(move |(a, b, x)| {
        let matrix = |a: Vec<S>| dense(n, n, |i, j| a[i * n + j].clone());
        (matrix(a), matrix(b), x)
    })
}

properties! {
    #![cases(256)]

    #[test]
    fn square_rationals((a, b, x) in (0usize..6).prop_flat_map(|n| square_of(n, rational))) {
        square_laws(&a, &b, &x)?;
    }

    #[test]
    fn singular_rationals(rows in (2usize..5).prop_flat_map(square), n in -3i64..=3) {
        let mut rows = rows;
        rows[0] = rows[1].iter().map(|x| x * n).collect();
        let a = from_words::<Rational>(&rows);
        let x: Vec<_> = rows[1].iter().map(|n| Rational::from(*n)).collect();
        prop_assert!(a.inverse().is_none());
        square_laws(&a, &a.transpose(), &x)?;
    }

    #[test]
    fn rectangular_rationals((a, x) in low_rank()) {
        rectangle_laws(&a, &x)?;
    }

    /// Equal subspaces have equal bases, however they were built.
    #[test]
    fn the_echelon_form_is_canonical((a, _) in low_rank(), start in 0usize..6) {
        let mut one_by_one = Echelon::new();
        for i in 0..a.rows() {
            let row = a.row((i + start) % a.rows()).to_vec();
            let independent = !one_by_one.contains(row.clone());
            prop_assert_eq!(one_by_one.insert(row)?, independent);
        }
        is_reduced(&one_by_one)?;
        prop_assert_eq!(one_by_one.rank(), a.rank()?);
        prop_assert_eq!(one_by_one, a.echelon()?);
    }

    #[test]
    fn a_vector_outside_the_image_is_no_right_hand_side((a, x) in low_rank()) {
        // the image is what the left nullspace annihilates
        let left = a.transpose().nullspace()?;
        let mut b = a.apply(&x)?;
        if let Some((i, _)) = left.row(0).first() {
            b[*i] = b[*i].clone() + &Rational::one();
            prop_assert_eq!(a.solve(&b)?, None);
        } else {
            prop_assert!(a.solve(&vec![Rational::one(); a.rows()])?.is_some());
        }
    }

    #[test]
    fn rows_exchanged_change_the_sign(
        (a, _, _) in square_of(5, rational),
        order in Just([0, 1, 2, 3, 4usize]).prop_shuffle(),
    ) {
        let permuted = Matrix::from_rows(5, order.map(|i| a.row(i).to_vec()))?;
        let pairs = (0..5).flat_map(|i| (0..i).map(move |j| (j, i)));
        let inversions = pairs.filter(|(j, i)| order[*j] > order[*i]).count();
        let expected = a.determinant()?;
        let sign = if inversions % 2 == 0 { expected } else { -expected };
        prop_assert_eq!(permuted.determinant()?, sign);
    }

    /// Matrices with strictly dominant diagonals and permuted rows: condition numbers below about
    /// 20.
    #[test]
    fn well_conditioned_floats(
        (a, b, x) in (1usize..9).prop_flat_map(|n| square_of(n, || -1.0..1.0f64)),
        shift in 0usize..8,
    ) {
        let n = a.rows();
        let dominant = |m: &Matrix<f64>| {
            let diagonal = 1.2 * n as f64;
            let entry = |i, j| m.get(i, j) + if i == j { diagonal } else { 0.0 };
            dense(n, n, |i, j| entry((i + shift) % n, j) / diagonal)
        };
        square_laws(&dominant(&a), &dominant(&b), &x)?;
        rectangle_laws(&dominant(&a), &x)?;
    }

    /// The inverse is accurate whatever the units of the basis: the inverse of `D A D` is `D^-1
    /// A^-1 D^-1` to rounding errors, for a symmetric `A` near a diagonal of signs. The other
    /// entries of `A` have various sizes; units can make them the largest of their columns.
    #[test]
    fn units_do_not_matter(
        words in (1usize..8).prop_flat_map(square),
        (signs, sizes) in (vec(any::<bool>(), 8), vec(0i32..50, 64)),
        units in vec(-60i32..60, 8),
    ) {
        let n = words.len();
        let unit = |at: i32| 2f64.powi(at);
        let entry = |i: usize, j: usize| match (i.max(j), i.min(j)) {
            (k, l) if k == l => if signs[k] { 1.0 } else { -1.0 },
            (k, l) => words[k][l] as f64 / (4 * n) as f64 * unit(-sizes[8 * k + l]),
        };
        let exact = |x: f64| Rational::from_f64(x).expect("finite");
        let expected = dense(n, n, |i, j| exact(entry(i, j))).inverse().expect("dominant");
        let scaled = dense(n, n, |i, j| 1.3 * unit(units[i]) * entry(i, j) * unit(units[j]));
        let found = scaled.inverse().ok_or_else(|| TestCaseError::fail("no inverse"))?;
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let found = 1.3 * unit(units[i]) * found.get(i, j) * unit(units[j]);
            let off = found - expected.get(i, j).to_f64();
            prop_assert!(off.abs() <= 1e-14, "{off} in {i}, {j}");
        }
    }

    /// The tolerance distinguishes rounding errors from rank.
    #[test]
    fn floats_have_the_rank_of_the_integers(
        (a, b) in (1usize..7, 1usize..4, 1usize..7)
            .prop_flat_map(|(m, r, n)| (vec(vec(-3i64..=3, r), m), vec(vec(-3i64..=3, n), r))),
    ) {
        let exact = from_words::<Rational>(&a).mul(&from_words(&b))?;
        let float = exact.map(Rational::to_f64);
        prop_assert_eq!(float.rank()?, exact.rank()?);
        let ones = vec![1.0; float.columns()];
        rectangle_laws(&float, &ones)?;
    }
}

fn symbolic() -> impl Strategy<Value = Symbolic> {
    let linear = || {
        (-2i64..=2, -2i64..=2, -2i64..=2).prop_map(|(k, m, n)| {
            let [k, m, n] = [k, m, n].map(Symbolic::from_i64);
            m * Symbolic::parameter("a") + n * Symbolic::parameter("b") + k
        })
    };
    let quotient = (linear(), linear()).prop_map(|(n, d)| match d.recip() {
        Some(inverse) => n * inverse,
        None => n,
    });
    prop_oneof![1 => Just(Symbolic::zero()), 2 => linear(), 1 => quotient]
}

properties! {
    #![cases(24)]
    #[test]
    fn square_rational_functions((a, b, x) in (1usize..4).prop_flat_map(|n| square_of(n, symbolic))) {
        square_laws(&a, &b, &x)?;
    }

    #[test]
    fn rational_functions_of_low_rank((a, x) in (vec(symbolic(), 6), vec(symbolic(), 3))) {
        let [tall, wide] = [(3, 1, 0), (1, 3, 3)]
            .map(|(m, n, start)| dense(m, n, |i, j| a[start + i * n + j].clone()));
        rectangle_laws(&tall.mul(&wide)?, &x)?;
    }
}
